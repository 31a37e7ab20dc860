//! The library: shot that can be bought, and contacts that somebody has measured.
//!
//! Problem files take from it with `use`. Every number says where it is from, or that it is
//! assumed.
//!
//! ```
//! use peenpose::problem::media;
//!
//! let shot = media::medium("S110").unwrap();
//! assert_eq!(shot.diameter.value, 110.0 * 2.54e-6);
//! assert!(shot.diameter.source.to_string().starts_with("SAE J444"));
//! ```

use std::fmt;

use crate::impact::Restitution;

/// Shot that can be bought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    /// Its designation, such as `S110`.
    pub name: &'static str,
    /// What it is made of.
    pub material: &'static str,
    /// Nominal diameter, m.
    pub diameter: Number,
    /// Density, kg/m3.
    pub density: Number,
}

/// Friction and restitution of a pair of materials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LibraryContact {
    /// Its name, such as `steel-on-steel-dry`.
    pub name: &'static str,
    /// Static friction.
    pub static_friction: Number,
    /// Dynamic friction.
    pub dynamic_friction: Number,
    /// Normal coefficient of restitution at the speed at which it was measured.
    pub restitution: Number,
    /// That normal speed, m/s.
    pub restitution_speed: Number,
    /// How steeply restitution falls with the normal speed.
    pub restitution_exponent: Number,
}

impl LibraryContact {
    /// Restitution as it falls with speed: shot arrives much faster than what it was measured on.
    pub fn restitution_law(&self) -> Restitution {
        Restitution::Falling {
            reference: self.restitution.value,
            speed: self.restitution_speed.value,
            exponent: self.restitution_exponent.value,
        }
    }
}

/// A number and where it is from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    /// In SI.
    pub value: f64,
    /// Where it is from.
    pub source: Origin,
}

/// Where a number is from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// Somebody has published it.
    Published(&'static str),
    /// Nobody vouches for it; why it was chosen.
    Assumed(&'static str),
}

impl Origin {
    /// Whether nobody vouches for the number.
    pub fn is_assumed(self) -> bool {
        matches!(self, Self::Assumed(_))
    }
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Published(source) => f.write_str(source),
            Self::Assumed(reason) => write!(f, "assumed: {reason}"),
        }
    }
}

/// All shot, by material and size.
pub fn media() -> &'static [Medium] {
    MEDIA
}

/// All contacts.
pub fn contacts() -> &'static [LibraryContact] {
    CONTACTS
}

/// The medium of this name.
pub fn medium(name: &str) -> Option<&'static Medium> {
    MEDIA.iter().find(|medium| medium.name == name)
}

/// The contact of this name.
pub fn contact(name: &str) -> Option<&'static LibraryContact> {
    CONTACTS.iter().find(|contact| contact.name == name)
}

use Origin::{Assumed, Published};

const fn number(value: f64, source: Origin) -> Number {
    Number { value, source }
}

/// 1e-4 inch, m.
const TEN_THOUSANDTH: f64 = 2.54e-6;
/// 1e-3 inch, m.
const THOUSANDTH: f64 = 2.54e-5;

const fn cast_steel(name: &'static str, size: u32) -> Medium {
    Medium {
        name,
        material: "cast steel",
        diameter: number(
            size as f64 * TEN_THOUSANDTH,
            Published("SAE J444: opening of the nominal sieve, the number in 1e-4 inch"),
        ),
        density: number(
            7800.0,
            Published(
                "Nakonieczny, Borkowski & Wymyslowski, ICSP-8 (2002), table 1; \
                 IS 4606 asks for at least 7400 kg/m3, as voids take room",
            ),
        ),
    }
}

const fn cut_wire(name: &'static str, size: u32) -> Medium {
    Medium {
        name,
        material: "cut wire, conditioned",
        diameter: number(
            size as f64 * THOUSANDTH,
            Published("SAE J441: mean diameter of the wire, the number in 1e-3 inch"),
        ),
        density: number(
            7860.0,
            Published("Spajic d.o.o., cast steel shot and grit vs. cut wire shot: 7.86 kg/dm3"),
        ),
    }
}

/// Ceramic beads of a size range in um.
const fn ceramic(name: &'static str, from: u32, to: u32) -> Medium {
    Medium {
        name,
        material: "ceramic (zirconia)",
        diameter: number(
            (from + to) as f64 / 2.0 * 1e-6,
            Assumed(
                "middle of the range from the size in its name to the next one, as Z425 is 425 to \
                 600 um in Metal Finishing News 4 (11/2003)",
            ),
        ),
        density: number(
            3760.0,
            Published("AZoM, article 4272, table 2: relative density of a bead 3.76"),
        ),
    }
}

const fn glass(name: &'static str, size: u32) -> Medium {
    Medium {
        name,
        material: "glass (soda-lime)",
        diameter: number(
            size as f64 * 1e-5,
            Published("SAE J1173: approximate nominal diameter, the number in 1e-2 mm"),
        ),
        density: number(
            2500.0,
            Published("Hanu Surface, data of Potters impact beads: 2.45 to 2.55 g/cm3"),
        ),
    }
}

static MEDIA: &[Medium] = &[
    cast_steel("S70", 70),
    cast_steel("S110", 110),
    cast_steel("S170", 170),
    cast_steel("S230", 230),
    cast_steel("S280", 280),
    cast_steel("S330", 330),
    cast_steel("S390", 390),
    cast_steel("S460", 460),
    cast_steel("S550", 550),
    cast_steel("S660", 660),
    cast_steel("S780", 780),
    cut_wire("CW-12", 12),
    cut_wire("CW-14", 14),
    cut_wire("CW-17", 17),
    cut_wire("CW-20", 20),
    cut_wire("CW-23", 23),
    cut_wire("CW-28", 28),
    cut_wire("CW-32", 32),
    cut_wire("CW-35", 35),
    cut_wire("CW-41", 41),
    cut_wire("CW-47", 47),
    cut_wire("CW-54", 54),
    cut_wire("CW-62", 62),
    cut_wire("CW-80", 80),
    ceramic("Z100", 100, 150),
    ceramic("Z150", 150, 210),
    ceramic("Z210", 210, 300),
    ceramic("Z300", 300, 425),
    ceramic("Z425", 425, 600),
    glass("GB-20", 20),
    glass("GB-25", 25),
    glass("GB-35", 35),
    glass("GB-50", 50),
    glass("GB-70", 70),
];

const KIRK: Origin = Published(
    "Kirk, The Shot Peener 38/2 (2024): half of the energy comes back after a fall of 1 m, and \
     much the same for shot; it falls with speed",
);
const KIRK_OTHMER: Origin =
    Published("Kirk-Othmer Encyclopedia of Chemical Technology, quoted: hard steel on hard steel");
const KIRK_OTHMER_OILED: Origin = Published(
    "Kirk-Othmer Encyclopedia of Chemical Technology, quoted: hard steel on hard steel with a thin \
     film of light mineral oil",
);
const DAVIS: Origin = Published(
    "Davis, Concise Metals Data Handbook, table 14.1, quoted by Lawrence Berkeley Laboratory: \
     steel 1032 on steel 1032",
);
const KHARAZ: Origin = Published(
    "Kharaz, Gorham & Salman, Powder Technology 120 (2001) 281-291: 5 mm sphere on thick glass, \
     3.9 m/s",
);
const CHART: &str =
    "Schneider & Company, Coefficient of Friction Reference Chart: middle of 0.5 to 0.7";
const CHART_GREASED: &str =
    "Schneider & Company, Coefficient of Friction Reference Chart: middle of 0.2 to 0.3";
const AS_ZOHDI: Origin = Assumed("0.9 of static friction, as in Zohdi (2015)");
const LIKE_STEEL: Origin = Assumed("as of steel on steel");

/// How restitution falls where metal yields.
const PLASTIC: Number = number(
    0.25,
    Assumed("1/4, the limit of full plasticity (Johnson, Contact Mechanics, 1985)"),
);
/// Of steel balls that fall 1 m.
const AFTER_A_FALL: Number = number(4.43, KIRK);
/// The same of pairs taken to be like them.
const AS_AFTER_A_FALL: Number = number(4.43, LIKE_STEEL);

/// A contact whose restitution is that of steel on steel.
const fn like_steel(
    name: &'static str,
    static_friction: Number,
    dynamic_friction: Number,
) -> LibraryContact {
    LibraryContact {
        name,
        static_friction,
        dynamic_friction,
        restitution: number(0.71, LIKE_STEEL),
        restitution_speed: AS_AFTER_A_FALL,
        restitution_exponent: PLASTIC,
    }
}

const fn steel_on_steel(
    name: &'static str,
    static_friction: f64,
    dynamic_friction: f64,
    source: Origin,
) -> LibraryContact {
    LibraryContact {
        name,
        static_friction: number(static_friction, source),
        dynamic_friction: number(dynamic_friction, source),
        restitution: number(0.71, KIRK),
        restitution_speed: AFTER_A_FALL,
        restitution_exponent: PLASTIC,
    }
}

static CONTACTS: &[LibraryContact] = &[
    steel_on_steel("steel-on-steel-clean", 0.78, 0.42, KIRK_OTHMER),
    steel_on_steel("steel-on-steel-dry", 0.31, 0.23, DAVIS),
    steel_on_steel("steel-on-steel-oiled", 0.23, 0.10, KIRK_OTHMER_OILED),
    like_steel(
        "glass-on-metal-dry",
        number(0.6, Published(CHART)),
        number(0.54, AS_ZOHDI),
    ),
    like_steel(
        "glass-on-metal-greased",
        number(0.25, Published(CHART_GREASED)),
        number(0.225, AS_ZOHDI),
    ),
    LibraryContact {
        name: "alumina-on-glass-dry",
        static_friction: number(0.092, KHARAZ),
        dynamic_friction: number(0.092, KHARAZ),
        restitution: number(0.98, KHARAZ),
        restitution_speed: number(3.9, KHARAZ),
        restitution_exponent: PLASTIC,
    },
];
