//! `contacts`, as written.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde_json::json;

use super::form;
use super::quantity::{Fraction, Friction, SignedFraction, Speed};
use super::settings::OneOrRange;
use crate::problem::field::{Field, Needed};
use crate::problem::media::LibraryContact;

/// What may stand under a name in `contacts`: a contact, or, under `use`, names out of the library.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename = "a group of keys")]
pub(in crate::problem) enum ContactsItem {
    /// A single name.
    #[serde(rename = "scalar")]
    Name(String),
    /// Several names.
    #[serde(rename = "list")]
    Names(Vec<Field<String>>),
    /// A contact of its own.
    #[serde(rename = "map")]
    Own(ContactEntry),
}

/// Contacts by name, of which `use` may hold names out of the library instead.
pub(in crate::problem) struct ContactsSchema;

impl JsonSchema for ContactsSchema {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Contacts".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let own = generator.subschema_for::<ContactEntry>();
        let names = form::contact_names();
        json_schema!({
            "type": "object",
            "properties": {
                "use": {
                    "description": "Contacts of the library, `peenpose media`, beside the file's own.",
                    "anyOf": [
                        { "enum": names },
                        { "type": "array", "minItems": 1, "items": { "enum": names } },
                        own,
                    ],
                },
            },
            "additionalProperties": own,
        })
    }
}

/// One friction choice. With restitution that falls with speed, as that of the library does, the best
/// speed no longer follows from the paths, so it is searched like the others, which takes longer.
///
/// ```yaml
/// contacts:
///   dry:   { mu_s: 0.30, mu_d: 0.27, restitution: 0.25 }
///   glass: { mu_s: 0.15, mu_d_ratio: 0.9, restitution: 0.9, tangential_restitution: 0.4, law: kinetic }
///   steel: { mu_s: 0.20, mu_d: 0.18, restitution: { value: 0.5, at: 10 m/s, exponent: 0.25 } }
///   tuned: { mu_s: [0.05, 0.30], mu_d_ratio: 0.9, restitution: 0.25 }
///   oiled: { use: steel-on-steel-oiled, restitution: 0.5 }
/// ```
///
/// `use: [steel-on-steel-dry, steel-on-steel-oiled]` among the names adds contacts of the library,
/// which `peenpose media` lists, under their own names. One that the file gives under the same
/// name is the file's.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
#[schemars(extend(
    "anyOf" = json!([
        { "required": ["use"] },
        { "required": ["mu_s", "mu_d", "restitution"] },
        { "required": ["mu_s", "mu_d_ratio", "restitution"] },
    ]),
    "not" = json!({ "required": ["mu_d", "mu_d_ratio"] }),
))]
pub(in crate::problem) struct ContactEntry {
    /// A contact of the library, `peenpose media`, whose numbers hold where the keys below are
    /// absent; nothing from the library where absent.
    #[serde(rename = "use")]
    #[schemars(with = "Field<form::ContactName>", example = &"steel-on-steel-dry")]
    pub library: Field<String>,
    /// Static friction. A range is searched, but not in the contact of a surface; that of
    /// `use` where absent.
    #[schemars(example = 0.30, example = [0.05, 0.30])]
    pub mu_s: Field<OneOrRange<Friction>>,
    /// Dynamic friction, 0 to `mu_s`; `mu_d_ratio` or that of `use` where absent.
    #[schemars(example = 0.27)]
    pub mu_d: Field<Friction>,
    /// Dynamic over static friction. Instead of `mu_d`, and the only way where `mu_s` is a
    /// range; `mu_d` or that of `use` where absent.
    #[schemars(example = 0.9)]
    pub mu_d_ratio: Field<Fraction>,
    /// Normal coefficient of restitution, or how it falls with speed; that of `use` where
    /// absent.
    #[schemars(example = 0.25)]
    pub restitution: Field<RestitutionEntry>,
    /// Tangential coefficient of restitution: how far a sticking contact springs back
    /// sideways.
    #[schemars(example = 0.4, extend("default" = 0))]
    pub tangential_restitution: Field<SignedFraction>,
    /// The friction law, see [model.md](model.md#contact-laws).
    #[schemars(example = &"kinetic", extend("default" = "stick_slip"))]
    pub law: Field<LawEntry>,
}

/// A coefficient of restitution, constant or falling with speed.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename = "a number such as 0.25, or `{ value: 0.5, at: 10 m/s, exponent: 0.25 }`")]
#[schemars(rename = "RestitutionEntry", untagged, inline)]
pub(in crate::problem) enum RestitutionEntry {
    /// The same at every speed.
    #[serde(rename = "scalar")]
    Constant(Fraction),
    /// Falling with the normal speed.
    #[serde(rename = "map")]
    Falling(FallingEntry),
}

/// Restitution that falls with the normal speed: value (speed / at)^(-exponent), at most 1.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(default)]
pub(in crate::problem) struct FallingEntry {
    /// The coefficient at the speed at which it was measured.
    #[schemars(example = 0.5)]
    pub value: Needed<Fraction>,
    /// That normal speed.
    #[schemars(example = &"10 m/s")]
    pub at: Needed<Speed>,
    /// How steeply it falls; 0.25 is the plastic limit.
    #[schemars(example = 0.25)]
    pub exponent: Needed<Fraction>,
}

impl FallingEntry {
    /// As it would be written for a contact of the library.
    pub fn of(known: &LibraryContact) -> Self {
        Self {
            value: Needed::from(Fraction(known.restitution.value)),
            at: Needed::from(Speed(known.restitution_speed.value)),
            exponent: Needed::from(Fraction(known.restitution_exponent.value)),
        }
    }
}

/// The friction law of a contact.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(inline)]
pub(in crate::problem) enum LawEntry {
    /// Static friction decides whether it sticks, dynamic friction acts while it slips.
    StickSlip,
    /// Dynamic friction until the slip stops.
    Kinetic,
    /// As stick-slip, for shots that cannot spin.
    Irrotational,
    /// Slip even where it would stick; only to compare with published tables.
    AlwaysSlip,
}
