//! `peenpose impact`: one impact on a flat surface, or the tables of Zohdi's paper.

use std::fmt::Display;

use peenpose::impact::zohdi::{self, Row};
use peenpose::impact::{Contact, ContactFault, Law, Oblique, Outcome, Regime, Restitution, Sphere};
use peenpose::units::{Dimension, parse, parse_number};
use serde::Serialize;

/// Work out one impact of a shot on a flat surface.
///
/// Without flags it is the case of Zohdi's paper with mu_s = 0.3. Angles are measured from the
/// surface: 90 deg is perpendicular.
#[derive(Debug, clap::Args)]
pub struct ImpactArgs {
    /// Speed of the shot.
    #[arg(
        long,
        value_name = "SPEED",
        allow_hyphen_values = true,
        default_value = "10 m/s"
    )]
    speed: String,

    /// Angle between its path and the surface, above 0 deg and up to 90 deg.
    #[arg(
        long,
        value_name = "ANGLE",
        allow_hyphen_values = true,
        default_value = "60 deg"
    )]
    angle: String,

    /// Spin about the axis across the plane of motion; rolling forwards is negative.
    #[arg(
        long,
        value_name = "SPIN",
        allow_hyphen_values = true,
        default_value = "0 rad/s"
    )]
    spin: String,

    /// Radius of the shot.
    #[arg(
        long,
        value_name = "LENGTH",
        allow_hyphen_values = true,
        default_value = "0.5 mm"
    )]
    radius: String,

    /// Density of the shot.
    #[arg(
        long,
        value_name = "DENSITY",
        allow_hyphen_values = true,
        default_value = "7000 kg/m3"
    )]
    density: String,

    /// Static friction.
    #[arg(
        long,
        value_name = "NUMBER",
        allow_hyphen_values = true,
        default_value = "0.3"
    )]
    mu_s: String,

    /// Dynamic friction, at most the static one [default: 0.9 times the static friction]
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    mu_d: Option<String>,

    /// Normal coefficient of restitution, 0 to 1.
    #[arg(
        long,
        value_name = "NUMBER",
        allow_hyphen_values = true,
        default_value = "0.25"
    )]
    restitution: String,

    /// Tangential restitution of a contact that sticks, -1 to 1; 0 is the paper's model.
    #[arg(
        long,
        value_name = "NUMBER",
        allow_hyphen_values = true,
        default_value = "0"
    )]
    tangential_restitution: String,

    /// Friction law. always_slip creates energy; it is there to compare with the paper.
    #[arg(long, default_value = Law::StickSlip.name(), value_parser = Law::ALL.map(Law::name))]
    law: String,

    /// Print a table of the paper, as it should be.
    #[arg(long, value_enum, conflicts_with_all = [
        "speed", "angle", "spin", "radius", "density", "mu_s", "mu_d", "restitution",
        "tangential_restitution", "law",
    ])]
    table: Option<Table>,

    /// Print the table as it was published: with the slip formula where the contact sticks.
    #[arg(long, requires = "table")]
    as_published: bool,

    /// Print JSON in SI units.
    #[arg(long)]
    json: bool,
}

/// A table of Zohdi's paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Table {
    /// Table 1: velocities and spin after the impact.
    Zohdi1,
    /// Table 2: impulses and energies.
    Zohdi2,
}

/// The text for standard output.
///
/// # Errors
/// Every flag with a value that cannot be, one to a line.
pub fn run(args: &ImpactArgs) -> Result<String, String> {
    if let Some(table) = args.table {
        return table_text(table, args.as_published, args.json);
    }
    let shot = shot(args)?;
    let outcome = shot
        .outcome()
        .ok_or("the shot does not reach the surface: raise --speed or --angle")?;
    if args.json {
        to_json(&ImpactJson::new(&shot, &outcome))
    } else {
        Ok(impact_text(&shot, &outcome))
    }
}

/// The impact that was asked for.
fn shot(args: &ImpactArgs) -> Result<Oblique, String> {
    let mut faults = Vec::new();
    let mut flags = Flags {
        faults: &mut faults,
    };
    let speed = flags.positive("speed", Dimension::Speed, &args.speed);
    let angle = flags.angle(&args.angle);
    let spin = flags.spin(&args.spin);
    let radius = flags.positive("radius", Dimension::Length, &args.radius);
    let density = flags.positive("density", Dimension::Density, &args.density);
    let static_friction = flags.number("mu-s", &args.mu_s);
    let dynamic_friction = match &args.mu_d {
        Some(text) => flags.number("mu-d", text),
        None => static_friction.map(|friction| zohdi::DYNAMIC_RATIO * friction),
    };
    let restitution = flags.number("restitution", &args.restitution);
    let tangential_restitution =
        flags.number("tangential-restitution", &args.tangential_restitution);
    let law = Law::ALL.into_iter().find(|law| law.name() == args.law);

    if law.is_some_and(|law| !law.spins()) && spin.is_some_and(|spin| spin != 0.0) {
        flags.fault("spin", "a shot under the irrotational law does not spin");
    }

    // What could not be read stands in as 0, which is always allowed, to check the rest.
    let contact = Contact {
        law: law.unwrap_or_default(),
        static_friction: static_friction
            .or(dynamic_friction.filter(|friction| *friction >= 0.0))
            .unwrap_or(0.0),
        dynamic_friction: dynamic_friction.unwrap_or(0.0),
        restitution: Restitution::Constant(restitution.unwrap_or(0.0)),
        tangential_restitution: tangential_restitution.unwrap_or(0.0),
    };
    for fault in contact.faults() {
        let follows_from_static =
            args.mu_d.is_none() && matches!(fault, ContactFault::DynamicFriction(_));
        if !follows_from_static {
            flags.fault(flag_of(&fault), fault);
        }
    }
    match (speed, angle, spin, radius, density) {
        (Some(speed), Some(angle), Some(spin), Some(radius), Some(density))
            if faults.is_empty() =>
        {
            Ok(Oblique {
                sphere: Sphere { radius, density },
                contact,
                speed,
                angle,
                spin,
            })
        }
        _ => Err(faults.join("\n")),
    }
}

/// Reads flags and keeps what is wrong with them.
struct Flags<'a> {
    faults: &'a mut Vec<String>,
}

impl Flags<'_> {
    fn fault(&mut self, flag: &str, fault: impl Display) {
        self.faults.push(format!("--{flag}: {fault}"));
    }

    fn quantity(&mut self, flag: &str, dimension: Dimension, text: &str) -> Option<f64> {
        parse(dimension, text)
            .map_err(|fault| self.fault(flag, fault))
            .ok()
    }

    fn positive(&mut self, flag: &str, dimension: Dimension, text: &str) -> Option<f64> {
        let value = self.quantity(flag, dimension, text)?;
        if value > 0.0 {
            return Some(value);
        }
        self.fault(flag, format!("`{text}` must be above 0"));
        None
    }

    fn angle(&mut self, text: &str) -> Option<f64> {
        let value = self.quantity("angle", Dimension::Angle, text)?;
        if value > 0.0 && value <= std::f64::consts::FRAC_PI_2 {
            return Some(value);
        }
        self.fault(
            "angle",
            format!("`{text}` must be above 0 deg and at most 90 deg, the perpendicular"),
        );
        None
    }

    fn spin(&mut self, text: &str) -> Option<f64> {
        let number = text.trim().strip_suffix("rad/s").and_then(parse_number);
        if number.is_none() {
            self.fault(
                "spin",
                format!("`{text}` is not a spin; expected one such as `100 rad/s`"),
            );
        }
        number.filter(|value| value.is_finite())
    }

    fn number(&mut self, flag: &str, text: &str) -> Option<f64> {
        let number = parse_number(text);
        if number.is_none() {
            self.fault(flag, format!("`{text}` is not a number"));
        }
        number
    }
}

fn flag_of(fault: &ContactFault) -> &'static str {
    match fault {
        ContactFault::StaticFriction(_) => "mu-s",
        ContactFault::DynamicFriction(_) | ContactFault::DynamicAboveStatic { .. } => "mu-d",
        ContactFault::TangentialRestitution(_) => "tangential-restitution",
        ContactFault::Restitution(_)
        | ContactFault::ReferenceSpeed(_)
        | ContactFault::Exponent(_) => "restitution",
    }
}

const fn regime_name(regime: Regime) -> &'static str {
    match regime {
        Regime::Stick => "stick",
        Regime::Slip => "slip",
    }
}

fn impact_text(shot: &Oblique, outcome: &Outcome) -> String {
    let sticking = match shot.stick_angle() {
        Some(angle) => [
            decimals(angle.tan(), 5),
            format!(
                "so from {} deg without spin",
                decimals(angle.to_degrees(), 4)
            ),
        ],
        None => ["never".to_owned(), String::new()],
    };
    let [threshold, threshold_angle] = sticking;
    let energy = |value: f64| decimals(1e6 * value, 4);
    let row = |name: &str, value: String, unit: &str| [name.to_owned(), value, unit.to_owned()];
    let rows = [
        row("regime", regime_name(outcome.regime).to_owned(), ""),
        row(
            "normal impulse N*",
            decimals(1e6 * outcome.normal_impulse, 4),
            "uN.s",
        ),
        row(
            "tangential impulse f*",
            decimals(1e6 * outcome.tangential_impulse, 4),
            "uN.s",
        ),
        row(
            "normal velocity v_n'",
            decimals(outcome.normal_velocity, 4),
            "m/s",
        ),
        row(
            "tangential velocity v_t'",
            decimals(outcome.tangential_velocity, 4),
            "m/s",
        ),
        row(
            "rebound angle theta'",
            decimals(outcome.angle.to_degrees(), 4),
            "deg",
        ),
        row("spin w'", decimals(outcome.spin, 4), "rad/s"),
        row(
            "energy of translation before",
            energy(outcome.before.translation),
            "uJ",
        ),
        row(
            "energy of translation after",
            energy(outcome.after.translation),
            "uJ",
        ),
        row(
            "energy of rotation before",
            energy(outcome.before.rotation),
            "uJ",
        ),
        row(
            "energy of rotation after",
            energy(outcome.after.rotation),
            "uJ",
        ),
        row(
            "energy after / before",
            decimals(outcome.energy_ratio(), 4),
            "",
        ),
        row("sticks from tan(theta)", threshold, &threshold_angle),
    ];
    let width = |column: usize| {
        let cells = rows.iter().map(|row| row[column].len());
        cells.max().unwrap_or(0)
    };
    let (names, values) = (width(0), width(1));
    let lines = rows.iter().map(|[name, value, unit]| {
        let line = format!("{name:names$}  {value:>values$}  {unit}");
        format!("{}\n", line.trim_end())
    });
    lines.collect()
}

/// A number with that many decimals; 0 has no sign.
fn decimals(value: f64, places: usize) -> String {
    let text = format!("{value:.places$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.chars().all(|c| matches!(c, '0' | '.')) => digits.to_owned(),
        _ => text,
    }
}

fn table_text(table: Table, as_published: bool, json: bool) -> Result<String, String> {
    let law = if as_published {
        Law::AlwaysSlip
    } else {
        Law::StickSlip
    };
    let rows = zohdi::rows(law);
    let note = note(as_published);
    if json {
        return match table {
            Table::Zohdi1 => to_json(&TableJson {
                law: law.name(),
                rows: rows.iter().map(VelocitiesJson::new).collect(),
                note,
            }),
            Table::Zohdi2 => to_json(&TableJson {
                law: law.name(),
                rows: rows.iter().map(EnergiesJson::new).collect(),
                note,
            }),
        };
    }
    let mut lines = match table {
        Table::Zohdi1 => velocities(&rows),
        Table::Zohdi2 => energies(&rows),
    };
    lines.push_str(&format!("\n{note}\n"));
    Ok(lines)
}

/// Why the published tables and the paper's own check disagree.
fn note(as_published: bool) -> String {
    let least = decimals(zohdi::least_sticking_friction(), 5);
    if as_published {
        format!(
            "As published: the slip formula (Eq. 23) in every row. By the paper's own check \
             (Eq. 22) the rows with mu_s >= {least} stick; the formula makes their contact points \
             leave backwards and their energy rise with friction, from nowhere."
        )
    } else {
        format!(
            "Rows with mu_s >= {least} stick (Eq. 22), so more friction changes nothing there. \
             The published rows apply the slip formula (Eq. 23) all the same: their contact points \
             leave backwards and their energy rises with friction, from nowhere. --as-published \
             prints them."
        )
    }
}

/// Table 1.
fn velocities(rows: &[Row]) -> String {
    let header = [
        "mu_s",
        "regime",
        "v_n' m/s",
        "v_t' m/s",
        "theta' deg",
        "w_z' rad/s",
    ];
    aligned(&header, rows, |row| {
        let out = &row.outcome;
        vec![
            decimals(row.static_friction, 3),
            regime_name(out.regime).to_owned(),
            decimals(out.normal_velocity, 4),
            decimals(out.tangential_velocity, 4),
            decimals(out.angle.to_degrees(), 4),
            decimals(out.spin, 4),
        ]
    })
}

/// Table 2.
fn energies(rows: &[Row]) -> String {
    let header = [
        "mu_s", "regime", "N* uN.s", "f* uN.s", "W_T uJ", "W_T' uJ", "W_R uJ", "W_R' uJ", "W'/W",
    ];
    aligned(&header, rows, |row| {
        let out = &row.outcome;
        let micro = |value: f64| decimals(1e6 * value, 4);
        vec![
            decimals(row.static_friction, 3),
            regime_name(out.regime).to_owned(),
            micro(out.normal_impulse),
            micro(out.tangential_impulse),
            micro(out.before.translation),
            micro(out.after.translation),
            micro(out.before.rotation),
            micro(out.after.rotation),
            decimals(out.energy_ratio(), 4),
        ]
    })
}

/// Right-aligned columns under their headings.
fn aligned(header: &[&str], rows: &[Row], cells: impl Fn(&Row) -> Vec<String>) -> String {
    let mut lines = vec![header.iter().map(|&text| text.to_owned()).collect()];
    lines.extend(rows.iter().map(cells));
    let mut text = String::new();
    for line in &lines {
        let padded = line.iter().enumerate().map(|(column, cell)| {
            let column = lines.iter().filter_map(|line| line.get(column));
            let width = column.map(String::len).max().unwrap_or(0);
            format!("{cell:>width$}")
        });
        text.push_str(&padded.collect::<Vec<_>>().join("  "));
        text.push('\n');
    }
    text
}

fn to_json(value: &impl Serialize) -> Result<String, String> {
    serde_json::to_string_pretty(value)
        .map(|text| text + "\n")
        .map_err(|fault| fault.to_string())
}

#[derive(Serialize)]
struct ImpactJson {
    law: &'static str,
    speed_m_s: f64,
    angle_rad: f64,
    spin_rad_s: f64,
    radius_m: f64,
    #[serde(rename = "density_kg_m3")]
    density: f64,
    static_friction: f64,
    dynamic_friction: f64,
    restitution: f64,
    tangential_restitution: f64,
    regime: &'static str,
    #[serde(rename = "normal_impulse_N_s")]
    normal_impulse: f64,
    #[serde(rename = "tangential_impulse_N_s")]
    tangential_impulse: f64,
    normal_velocity_after_m_s: f64,
    tangential_velocity_after_m_s: f64,
    angle_after_rad: f64,
    spin_after_rad_s: f64,
    #[serde(rename = "translation_energy_before_J")]
    translation_before: f64,
    #[serde(rename = "translation_energy_after_J")]
    translation_after: f64,
    #[serde(rename = "rotation_energy_before_J")]
    rotation_before: f64,
    #[serde(rename = "rotation_energy_after_J")]
    rotation_after: f64,
    energy_ratio: f64,
    /// Null when the contact never sticks.
    stick_tangent: Option<f64>,
    stick_angle_rad: Option<f64>,
}

impl ImpactJson {
    fn new(shot: &Oblique, outcome: &Outcome) -> Self {
        let contact = &shot.contact;
        let stick_angle = shot.stick_angle();
        Self {
            law: contact.law.name(),
            speed_m_s: shot.speed,
            angle_rad: shot.angle,
            spin_rad_s: shot.spin,
            radius_m: shot.sphere.radius,
            density: shot.sphere.density,
            static_friction: contact.static_friction,
            dynamic_friction: contact.dynamic_friction,
            restitution: contact.restitution.at(shot.speed * shot.angle.sin()),
            tangential_restitution: contact.tangential_restitution,
            regime: regime_name(outcome.regime),
            normal_impulse: outcome.normal_impulse,
            tangential_impulse: outcome.tangential_impulse,
            normal_velocity_after_m_s: outcome.normal_velocity,
            tangential_velocity_after_m_s: outcome.tangential_velocity,
            angle_after_rad: outcome.angle,
            spin_after_rad_s: outcome.spin,
            translation_before: outcome.before.translation,
            translation_after: outcome.after.translation,
            rotation_before: outcome.before.rotation,
            rotation_after: outcome.after.rotation,
            energy_ratio: outcome.energy_ratio(),
            stick_tangent: stick_angle.map(f64::tan),
            stick_angle_rad: stick_angle,
        }
    }
}

#[derive(Serialize)]
struct TableJson<T> {
    law: &'static str,
    rows: Vec<T>,
    note: String,
}

#[derive(Serialize)]
struct VelocitiesJson {
    static_friction: f64,
    regime: &'static str,
    normal_velocity_after_m_s: f64,
    tangential_velocity_after_m_s: f64,
    angle_after_rad: f64,
    spin_after_rad_s: f64,
}

impl VelocitiesJson {
    fn new(row: &Row) -> Self {
        let out = &row.outcome;
        Self {
            static_friction: row.static_friction,
            regime: regime_name(out.regime),
            normal_velocity_after_m_s: out.normal_velocity,
            tangential_velocity_after_m_s: out.tangential_velocity,
            angle_after_rad: out.angle,
            spin_after_rad_s: out.spin,
        }
    }
}

#[derive(Serialize)]
struct EnergiesJson {
    static_friction: f64,
    regime: &'static str,
    #[serde(rename = "normal_impulse_N_s")]
    normal_impulse: f64,
    #[serde(rename = "tangential_impulse_N_s")]
    tangential_impulse: f64,
    #[serde(rename = "translation_energy_before_J")]
    translation_before: f64,
    #[serde(rename = "translation_energy_after_J")]
    translation_after: f64,
    #[serde(rename = "rotation_energy_before_J")]
    rotation_before: f64,
    #[serde(rename = "rotation_energy_after_J")]
    rotation_after: f64,
    energy_ratio: f64,
}

impl EnergiesJson {
    fn new(row: &Row) -> Self {
        let out = &row.outcome;
        Self {
            static_friction: row.static_friction,
            regime: regime_name(out.regime),
            normal_impulse: out.normal_impulse,
            tangential_impulse: out.tangential_impulse,
            translation_before: out.before.translation,
            translation_after: out.after.translation,
            rotation_before: out.before.rotation,
            rotation_after: out.after.rotation,
            energy_ratio: out.energy_ratio(),
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::{ImpactArgs, run};

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        args: ImpactArgs,
    }

    fn result(flags: &[&str]) -> Result<String, String> {
        let words = ["impact"].into_iter().chain(flags.iter().copied());
        run(&Line::try_parse_from(words).unwrap().args)
    }

    #[test]
    fn without_flags_it_is_the_case_of_the_paper() {
        let text = result(&[]).unwrap();
        for line in [
            "regime                             stick",
            "tangential velocity v_t'          3.5714  m/s",
            "energy after / before             0.2254",
            "sticks from tan(theta)           0.76190  so from 37.3039 deg without spin",
        ] {
            assert!(text.lines().any(|found| found == line), "{text}");
        }
    }

    #[test]
    fn every_fault_is_named_at_once() {
        let text = result(&[
            "--speed",
            "10",
            "--angle",
            "100 deg",
            "--spin",
            "-5",
            "--mu-s",
            "x",
            "--mu-d",
            "-1",
            "--restitution",
            "2",
        ])
        .unwrap_err();
        let flags: Vec<&str> = text
            .lines()
            .filter_map(|line| line.split_once(':'))
            .map(|(flag, _)| flag)
            .collect();
        assert_eq!(
            flags,
            [
                "--speed",
                "--angle",
                "--spin",
                "--mu-s",
                "--mu-d",
                "--restitution"
            ],
            "{text}"
        );
    }

    #[test]
    fn json_is_in_si() {
        let text = result(&["--mu-s", "0", "--speed", "36 km/h", "--json"]).unwrap();
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(json["speed_m_s"], 10.0);
        assert_eq!(json["regime"], "slip");
        assert_eq!(json["stick_angle_rad"], serde_json::Value::Null);
        let energy = json["translation_energy_before_J"].as_f64().unwrap();
        assert!((energy - 183.2596e-6).abs() < 1e-10);
    }

    #[test]
    fn tables_are_right_unless_they_shall_be_as_published() {
        let row = |flags: &[&str]| {
            let text = result(flags).unwrap();
            let line = text.lines().find(|line| line.starts_with("0.300"));
            line.unwrap()
                .split_whitespace()
                .map(str::to_owned)
                .collect::<Vec<_>>()
        };
        assert_eq!(
            row(&["--table", "zohdi1"]),
            [
                "0.300",
                "stick",
                "2.1651",
                "3.5714",
                "31.2250",
                "-7142.8571"
            ]
        );
        assert_eq!(
            row(&["--table", "zohdi1", "--as-published"]),
            [
                "0.300",
                "slip",
                "2.1651",
                "2.0772",
                "46.1870",
                "-14614.1787"
            ]
        );
        assert_eq!(
            row(&["--table", "zohdi2", "--as-published"]),
            [
                "0.300", "slip", "39.6769", "10.7128", "183.2596", "16.4972", "0.0000", "39.1395",
                "0.3036"
            ]
        );
    }
}
