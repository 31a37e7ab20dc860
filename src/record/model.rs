//! Which effects were searched with, and what each of them does.

use serde::{Deserialize, Serialize};

use super::answer::{SettingsRecord, subject_name};
use crate::precision::Precision;
use crate::problem::model::{Effect, Model};
use crate::scenario::Scenario;
use crate::solve::{Ladder, Rung};

/// The model behind a result.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ModelRecord {
    /// `auto`, `full`, or the effects that were asked for.
    pub asked: Vec<String>,
    /// Effects that the search did without.
    pub searched_without: Vec<String>,
    /// How often one was put back because the whole model disagreed.
    pub put_back: usize,
    /// In which precision the search traced paths, `f64` or `f32`; figures are always f64.
    #[serde(default)]
    pub precision: Precision,
    /// What the effects do, as far as that was measured.
    pub effects: Vec<RungRecord>,
}

/// What one effect does: the model without it against the whole model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RungRecord {
    /// Its name.
    pub effect: String,
    /// What it is, for people.
    pub description: String,
    /// Change of J without it at the leading settings, relative.
    pub change: f64,
    /// The largest such change over the leading settings of all contacts.
    pub largest_change: f64,
    /// Verdicts that turn without it.
    pub turned: Vec<String>,
    /// The best settings nearby with it.
    pub settings_with: SettingsRecord,
    /// The best settings nearby without it.
    pub settings_without: SettingsRecord,
    /// By how much J of the whole model is higher at the latter, relative.
    pub regret: f64,
    /// Rays of a pose without it over rays with it; in results of older versions the same of times.
    #[serde(alias = "relative_time")]
    pub relative_rays: f64,
    /// Whether the search did without it.
    pub left_out: bool,
}

impl ModelRecord {
    /// The record of a ladder.
    pub fn new(scenario: &Scenario, ladder: &Ladder) -> Self {
        let name = |effect: &Effect| effect.name().to_owned();
        Self {
            asked: match &ladder.model {
                Model::Auto => vec!["auto".into()],
                Model::Full => vec!["full".into()],
                Model::Only(effects) => effects.iter().map(name).collect(),
            },
            searched_without: ladder.left_out().iter().map(name).collect(),
            put_back: ladder.put_back,
            precision: ladder.precision,
            effects: ladder
                .rungs
                .iter()
                .map(|rung| RungRecord::new(scenario, rung))
                .collect(),
        }
    }
}

impl RungRecord {
    fn new(scenario: &Scenario, rung: &Rung) -> Self {
        let turned = rung.turned.iter();
        Self {
            effect: rung.effect.name().into(),
            description: rung.effect.description().into(),
            change: rung.change,
            largest_change: rung.largest_change,
            turned: turned
                .map(|&subject| subject_name(scenario, subject))
                .collect(),
            settings_with: SettingsRecord::new(&rung.best_with),
            settings_without: SettingsRecord::new(&rung.best_without),
            regret: rung.regret,
            relative_rays: rung.relative_rays,
            left_out: rung.left_out,
        }
    }
}
