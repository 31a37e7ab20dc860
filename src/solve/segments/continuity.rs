//! Segments that keep what their neighbours have, where that is as good.

use super::candidate::Candidate;
use super::cut::{Cut, Piece};
use crate::problem::setting::{Setting, Settings};

impl Cut<'_> {
    /// Gives each segment what may stay as the one before it has it, then what may already be as the one behind it has
    /// it: setting by setting, where everything passes with it and J of the segment stays within the accuracy of what
    /// it was. What ties is not changed under way.
    pub fn continue_settings(&mut self, candidates: &mut Vec<Candidate>, pieces: &mut [Piece]) {
        let count = pieces.len();
        let onwards = (1..count).map(|index| (index, index - 1));
        let back = (1..count).rev().map(|index| (index - 1, index));
        for (index, beside) in onwards.chain(back) {
            let wanted = candidates[pieces[beside].candidate].settings;
            let settled = (beside > index && index > 0)
                .then(|| candidates[pieces[index - 1].candidate].settings);
            let own = &candidates[pieces[index].candidate];
            let may_change = |setting: &Setting| {
                let is_settled =
                    settled.is_some_and(|it| setting.of(&it) == setting.of(&own.settings));
                !is_settled && setting.of(&wanted) != setting.of(&own.settings)
            };
            let settings: Vec<Setting> = Setting::ALL.into_iter().filter(may_change).collect();
            if wanted.contact == own.settings.contact
                && let Some(kept) = self.with_settings_of(&wanted, &settings, own, pieces[index])
            {
                pieces[index].candidate = candidates.len();
                candidates.push(kept);
            }
        }
    }

    /// The same candidate with as many of these settings of another one as it may have; `None` where it may have none.
    fn with_settings_of(
        &mut self,
        wanted: &Settings,
        settings: &[Setting],
        own: &Candidate,
        piece: Piece,
    ) -> Option<Candidate> {
        if settings.is_empty() || own.reach(piece.from) < piece.to {
            return None;
        }
        let most = self.objective(&own.settings, piece)? * (1.0 + self.scenario.problem.accuracy);
        let mut kept = None;
        for setting in settings {
            if self.control.is_stopped() {
                break;
            }
            let from: &Candidate = kept.as_ref().unwrap_or(own);
            let changed = setting.with(&from.settings, setting.of(wanted));
            // J of a piece takes less than verdicts all along.
            if self.objective(&changed, piece).is_none_or(|it| it > most) {
                continue;
            }
            let candidate = self.candidate(&changed, own.status);
            if candidate.settings == changed && candidate.reach(piece.from) >= piece.to {
                kept = Some(candidate);
            }
        }
        kept
    }
}
