//! What was taken from the library, and where those numbers are from.

use serde::{Deserialize, Serialize};

use crate::impact::Contact;
use crate::problem::Problem;
use crate::problem::equipment::Shot;
use crate::problem::media::{LibraryContact, Number};

/// The medium that the file names.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MediumRecord {
    /// Its designation.
    pub name: String,
    /// Where its diameter is from; absent where the file gives another radius.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diameter: Option<OriginRecord>,
    /// Where its density is from; absent where the file gives another.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub density: Option<OriginRecord>,
}

/// A contact that takes numbers from the library.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LibraryContactRecord {
    /// Its name in the file, or that of the surface that has it.
    pub contact: String,
    /// Its name in the library.
    pub library: String,
    /// Where static friction is from; absent where the file gives another.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mu_s: Option<OriginRecord>,
    /// Where dynamic friction is from; absent where the file gives another.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mu_d: Option<OriginRecord>,
    /// Where restitution is from; absent where the file gives another.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution: Option<OriginRecord>,
    /// Where it is from how that falls with speed; absent where the file gives another.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution_exponent: Option<OriginRecord>,
}

/// Where a number is from.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct OriginRecord {
    /// Whether nobody vouches for it.
    pub assumed: bool,
    /// The source, or why it was assumed.
    pub source: String,
}

impl MediumRecord {
    /// The medium of a shot.
    pub(super) fn of(shot: &Shot) -> Option<Self> {
        let medium = shot.medium?;
        Some(Self {
            name: medium.name.into(),
            diameter: origin(&medium.diameter, 2.0 * shot.radius),
            density: origin(&medium.density, shot.density),
        })
    }
}

impl LibraryContactRecord {
    /// The contacts of a problem that take numbers from the library: those that may be chosen, then those of
    /// single surfaces.
    pub(super) fn all(problem: &Problem) -> Vec<Self> {
        let chosen = problem.contacts.iter().filter_map(|settings| {
            let record = Self::new(&settings.name, settings.library?, &settings.contact);
            let searched = !settings.static_friction.is_held();
            Some(if searched {
                Self {
                    mu_s: None,
                    mu_d: None,
                    ..record
                }
            } else {
                record
            })
        });
        let own = problem
            .surfaces
            .iter()
            .filter_map(|rule| Some(Self::new(&rule.surface, rule.library?, &rule.contact?)));
        chosen.chain(own).collect()
    }

    fn new(name: &str, known: &LibraryContact, contact: &Contact) -> Self {
        let is_known = contact.restitution == known.restitution_law();
        let of_law = |number: &Number| origin(number, number.value).filter(|_| is_known);
        Self {
            contact: name.into(),
            library: known.name.into(),
            mu_s: origin(&known.static_friction, contact.static_friction),
            mu_d: origin(&known.dynamic_friction, contact.dynamic_friction),
            restitution: of_law(&known.restitution),
            restitution_exponent: of_law(&known.restitution_exponent),
        }
    }
}

/// Where the library's number is from, if it is the one in use.
fn origin(known: &Number, in_use: f64) -> Option<OriginRecord> {
    (known.value == in_use).then(|| OriginRecord {
        assumed: known.source.is_assumed(),
        source: known.source.to_string(),
    })
}
