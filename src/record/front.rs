//! The trade-off between target error, tangential risk and rebound, in a record.

use serde::{Deserialize, Serialize};

use super::answer::{ObjectiveRecord, SettingsRecord, subject_name};
use crate::elementary::hypot;
use crate::scenario::Scenario;
use crate::solve::{Answer, Front};
use crate::verdict::Verdict;

/// One answer of the trade-off; none of the others is better in everything.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrontRecord {
    /// Whether it is the recommended one.
    pub recommended: bool,
    /// Name of the contact.
    pub contact: String,
    /// Static friction.
    pub mu_s: f64,
    /// The settings.
    pub settings: SettingsRecord,
    /// The terms of the objective with their weights.
    pub objective: ObjectiveRecord,
    /// Goals and surfaces whose verdicts fail.
    pub fails: Vec<String>,
}

impl FrontRecord {
    /// The records of a front, from the least target error on.
    pub fn all(scenario: &Scenario, front: &Front) -> Vec<Self> {
        let answers = front.answers.iter().enumerate();
        answers
            .filter_map(|(index, answer)| {
                Self::new(scenario, answer, front.recommended == Some(index))
            })
            .collect()
    }

    fn new(scenario: &Scenario, answer: &Answer, recommended: bool) -> Option<Self> {
        let settings = &answer.settings;
        let contact = &scenario.problem.contacts[settings.contact];
        let failing = answer.verdicts.iter().filter(|verdict| !verdict.passes());
        Some(Self {
            recommended,
            contact: contact.name.clone(),
            mu_s: contact.at(settings.static_friction).static_friction,
            settings: SettingsRecord::new(settings),
            objective: ObjectiveRecord::new(answer.evaluation.as_ref()?),
            fails: failing
                .map(|verdict: &Verdict| subject_name(scenario, verdict.subject))
                .collect(),
        })
    }

    /// Target error (normal impulse and misses), tangential risk and rebound, each with its
    /// standard error.
    pub fn objectives(&self) -> [(f64, f64); 3] {
        let it = &self.objective;
        let [normal, tangential, rebound, miss] = it.term_standard_errors;
        [
            (it.normal_impulse + it.miss, hypot(normal, miss)),
            (it.tangential_impulse, tangential),
            (it.rebound, rebound),
        ]
    }
}
