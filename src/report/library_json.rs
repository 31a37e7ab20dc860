//! The library of shot and contacts as JSON.

use serde::Serialize;

use crate::problem::media::{self, LibraryContact, Medium, Number};

/// What a problem file may `use`, with the source of every number, as JSON text.
///
/// # Errors
/// None is expected: every number in the library is finite.
pub fn library_json() -> Result<String, serde_json::Error> {
    serde_json::to_string_pretty(&LibraryJson {
        shot: media::media().iter().map(MediumJson::from).collect(),
        contacts: media::contacts().iter().map(ContactJson::from).collect(),
    })
}

#[derive(Serialize)]
struct LibraryJson {
    shot: Vec<MediumJson>,
    contacts: Vec<ContactJson>,
}

#[derive(Serialize)]
struct MediumJson {
    name: &'static str,
    material: &'static str,
    diameter_m: NumberJson,
    density_kg_m3: NumberJson,
}

#[derive(Serialize)]
struct ContactJson {
    name: &'static str,
    mu_s: NumberJson,
    mu_d: NumberJson,
    restitution: NumberJson,
    restitution_at_m_s: NumberJson,
    restitution_exponent: NumberJson,
}

#[derive(Serialize)]
struct NumberJson {
    value: f64,
    assumed: bool,
    source: String,
}

impl From<&Medium> for MediumJson {
    fn from(medium: &Medium) -> Self {
        Self {
            name: medium.name,
            material: medium.material,
            diameter_m: medium.diameter.into(),
            density_kg_m3: medium.density.into(),
        }
    }
}

impl From<&LibraryContact> for ContactJson {
    fn from(contact: &LibraryContact) -> Self {
        Self {
            name: contact.name,
            mu_s: contact.static_friction.into(),
            mu_d: contact.dynamic_friction.into(),
            restitution: contact.restitution.into(),
            restitution_at_m_s: contact.restitution_speed.into(),
            restitution_exponent: contact.restitution_exponent.into(),
        }
    }
}

impl From<Number> for NumberJson {
    fn from(number: Number) -> Self {
        Self {
            value: number.value,
            assumed: number.source.is_assumed(),
            source: number.source.to_string(),
        }
    }
}
