//! The model that was asked for, and what each effect does.

use serde::{Deserialize, Serialize};

use super::answer::{SettingsRecord, subject_name};
use crate::problem::model::{Effect, Model};
use crate::scenario::Scenario;
use crate::solve::Ablation;

/// The model behind a result.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ModelRecord {
    /// `auto`, `full`, or the effects that were asked for.
    pub asked: Vec<String>,
    /// Effects that the problem has and that were not asked for.
    pub searched_without: Vec<String>,
    /// What the effects do, as far as that was measured.
    pub effects: Vec<EffectRecord>,
}

/// What one effect does: the model without it against the whole model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EffectRecord {
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
    /// The model of a problem, and what its effects do as far as that was measured.
    pub fn new(scenario: &Scenario, ablations: &[Ablation]) -> Self {
        let name = |effect: &Effect| effect.name().to_owned();
        Self {
            asked: match &scenario.problem.model {
                Model::Auto => vec!["auto".into()],
                Model::Full => vec!["full".into()],
                Model::Only(effects) => effects.iter().map(name).collect(),
            },
            searched_without: scenario.unasked().iter().map(name).collect(),
            effects: ablations
                .iter()
                .map(|ablation| EffectRecord::new(scenario, ablation))
                .collect(),
        }
    }
}

impl EffectRecord {
    fn new(scenario: &Scenario, ablation: &Ablation) -> Self {
        let turned = ablation.turned.iter();
        Self {
            effect: ablation.effect.name().into(),
            description: ablation.effect.description().into(),
            change: ablation.change,
            largest_change: ablation.largest_change,
            turned: turned
                .map(|&subject| subject_name(scenario, subject))
                .collect(),
            settings_with: SettingsRecord::new(&ablation.best_with),
            settings_without: SettingsRecord::new(&ablation.best_without),
            regret: ablation.regret,
            relative_rays: ablation.relative_rays,
            left_out: ablation.left_out,
        }
    }
}
