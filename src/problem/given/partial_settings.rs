//! Settings that become known one after the other: held in the file, those of an answer, given by name.

use std::fmt;

use super::{check, contact_named};
use crate::problem::Problem;
use crate::problem::setting::{Setting, Settings};

const ALL: [Setting; Setting::ALL.len()] = Setting::ALL;

/// Settings for a problem, some of which may yet be unknown.
#[derive(Clone, Debug)]
pub struct PartialSettings<'a> {
    problem: &'a Problem,
    values: [Option<f64>; ALL.len()],
    contact: Option<usize>,
    /// The friction coefficient that was asked for by name.
    friction_asked: Option<f64>,
}

/// Why settings are not yet complete.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Incomplete {
    /// These are unknown; `contact` among them.
    Missing(Vec<&'static str>),
    /// `mu_s` was asked for, and the file says something else of this contact.
    FrictionIsHeld(String),
    /// They are known and wrong.
    Wrong(String),
}

impl fmt::Display for Incomplete {
    fn fmt(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Missing(names) => {
                write!(formatter, "the file leaves {} open", names.join(", "))
            }
            Self::FrictionIsHeld(contact) => write!(
                formatter,
                "mu_s: the friction of contact `{contact}` is fixed in the file, not a range"
            ),
            Self::Wrong(fault) => formatter.write_str(fault),
        }
    }
}

impl<'a> PartialSettings<'a> {
    /// What the file holds at one value.
    pub fn held(problem: &'a Problem) -> Self {
        let held = |setting| {
            let range = problem.ranges.range(setting)?;
            range.is_held().then_some(range.min)
        };
        let contact = match problem.ranges.contact[..] {
            [only] => Some(only),
            _ => None,
        };
        Self {
            problem,
            values: ALL.map(held),
            contact,
            friction_asked: None,
        }
    }

    /// All settings of an answer.
    pub fn take(&mut self, settings: &Settings) {
        self.values = ALL.map(|setting| Some(setting.of(settings)));
        self.contact = Some(settings.contact);
    }

    /// One value (SI), whatever it was before.
    pub fn set(&mut self, setting: Setting, value: f64) {
        *self.value(setting) = Some(value);
        if setting == Setting::StaticFriction {
            self.friction_asked = Some(value);
        }
    }

    /// The contact of that name.
    ///
    /// # Errors
    /// There is none.
    pub fn set_contact(&mut self, name: &str) -> Result<(), String> {
        self.contact = Some(contact_named(name, self.problem)?);
        Ok(())
    }

    /// Takes a value where none is known; tells whether one was.
    pub fn fill(&mut self, setting: Setting, value: f64) -> bool {
        let known = self.value(setting);
        let was_known = known.is_some();
        known.get_or_insert(value);
        was_known
    }

    fn value(&mut self, setting: Setting) -> &mut Option<f64> {
        &mut self.values[setting as usize]
    }

    /// All of them, within what a problem file may say.
    ///
    /// # Errors
    /// Some are unknown, or wrong.
    pub fn complete(&self) -> Result<Settings, Incomplete> {
        let mut missing: Vec<&'static str> = Vec::new();
        let mut settings = Settings::ZERO;
        for (setting, value) in ALL.into_iter().zip(self.values) {
            settings = setting.with(&settings, value.unwrap_or_default());
            if value.is_none() && setting != Setting::StaticFriction {
                missing.push(setting.name());
            }
        }
        let Some(contact) = self.contact else {
            missing.push("contact");
            return Err(Incomplete::Missing(missing));
        };
        settings.contact = contact;
        let contact = &self.problem.contacts[contact];
        let friction = contact.static_friction;
        if friction.is_held() {
            if self
                .friction_asked
                .is_some_and(|asked| asked != friction.min)
            {
                return Err(Incomplete::FrictionIsHeld(contact.name.clone()));
            }
            settings.static_friction = friction.min;
        } else if self.values[Setting::StaticFriction as usize].is_none() {
            missing.push(Setting::StaticFriction.name());
        }
        if !missing.is_empty() {
            return Err(Incomplete::Missing(missing));
        }
        check(&settings).map_err(Incomplete::Wrong)?;
        Ok(settings)
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::problem::change::Change;
    use crate::study::Study;

    #[test]
    fn what_is_missing_is_named_and_friction_is_that_of_the_contact() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("problems/plate.yaml");
        let contacts = "{ dry: { mu_s: 0.25, mu_d: 0.2, restitution: 0.5 }, \
            greased: { mu_s: [0.1, 0.3], mu_d_ratio: 0.9, restitution: 0.5 } }";
        let changes = [
            Change::new("contacts", contacts).unwrap(),
            Change::new("settings.incidence", "[30 deg, 60 deg]").unwrap(),
        ];
        let study = Study::open_changed(&file, &changes).unwrap();
        let mut partial = PartialSettings::held(study.problem());
        let missing = |names: &[&'static str]| Err(Incomplete::Missing(names.to_vec()));
        assert_eq!(partial.complete(), missing(&["incidence", "contact"]));
        assert!(!partial.fill(Setting::Incidence, 1.0));
        assert!(partial.fill(Setting::Incidence, 2.0));
        partial.set_contact("greased").unwrap();
        assert_eq!(partial.complete(), missing(&["mu_s"]));
        partial.set(Setting::StaticFriction, 0.2);
        let settings = partial.complete().unwrap();
        assert_eq!((settings.incidence, settings.static_friction), (1.0, 0.2));

        // The friction of a held contact is no choice: that of an answer to an earlier file is dropped.
        partial.set_contact("dry").unwrap();
        let held = Err(Incomplete::FrictionIsHeld("dry".into()));
        assert_eq!(partial.complete(), held);
        partial.set(Setting::StaticFriction, 0.25);
        assert!(partial.complete().is_ok());
        let mut taken = PartialSettings::held(study.problem());
        taken.take(&Settings {
            contact: 0,
            ..settings
        });
        assert_eq!(taken.complete().unwrap().static_friction, 0.25);
        assert!(
            partial
                .set_contact("grease")
                .unwrap_err()
                .contains("did you mean `greased`?")
        );
    }
}
