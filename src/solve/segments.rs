//! The fewest segments of a stroke within which settings hold, where one setting all along does not pass.
//!
//! Which settings pass at which cell of the stroke, a station with half the way to its neighbours, is a table; the
//! fewest pieces that cover all cells follow from it by taking the longest piece again and again, which is exact for
//! intervals. Settings come from searches: of the whole stroke, of cells that nothing passes yet, and of neighbouring
//! pieces together. What a piece need not change of the one before it stays.

mod candidate;
mod continuity;
mod cut;
mod rounding;

use super::answer::Answer;
use super::{Solution, Status, Wanted, best_of, solve};
use crate::control::Control;
use crate::problem::stroke::{Hold, Leg, place_in};
use crate::scenario::Scenario;
use crate::verdict::{StationVerdicts, Verdict};
use candidate::Candidate;
use cut::Cut;

/// A piece of a stroke with settings of its own.
#[derive(Clone, Debug)]
pub struct Segment {
    /// Places of its ends on the whole stroke.
    pub span: [f64; 2],
    /// The settings and what they do there.
    pub answer: Answer,
}

impl Segment {
    /// Its settings alone.
    pub fn leg(&self) -> Leg {
        Leg {
            span: self.span,
            settings: self.answer.settings,
        }
    }
}

/// Finds the best settings of a stroke, or the fewest segments of it with settings of their own where the problem lets
/// something change and one setting does not pass; the best answer is then that of the segment that limits it.
pub fn solve_stroke(scenario: &Scenario, control: &Control) -> (Solution, Vec<Segment>) {
    let stroke = scenario.problem.stroke.as_ref();
    let Some(stroke) = stroke.filter(|stroke| stroke.hold != Hold::All) else {
        return (solve(scenario, control), Vec::new());
    };
    // What is far from passing is cut, and nobody asks how exactly its J is known.
    let mut whole = best_of(
        scenario,
        control,
        Wanted {
            passing: false,
            failing: false,
            ..Wanted::ALL
        },
    );
    let Some(best) = whole.answers.first().filter(|best| !best.passes()) else {
        return (whole, Vec::new());
    };
    let mut cut = Cut::new(scenario, stroke, control, best.settings);
    let mut candidates: Vec<Candidate> = whole
        .answers
        .iter()
        .filter(|answer| answer.evaluation.is_some())
        .map(|answer| cut.candidate(&answer.settings, whole.status))
        .collect();
    cut.fill(&mut candidates);
    let mut pieces = cut.cover(&candidates);
    cut.merge(&mut candidates, &mut pieces);
    cut.continue_settings(&mut candidates, &mut pieces);
    let segments = cut.segments(&candidates, &pieces);
    whole.rays += cut.rays + segments.iter().map(|it| it.answer.rays()).sum::<usize>();
    whole.poses += cut.poses;
    // Where the nozzle fits nowhere there is none.
    if let Some(combined) = combined(&segments) {
        whole.status = pieces
            .iter()
            .map(|piece| candidates[piece.candidate].status)
            .find(|&status| status != Status::Converged)
            .unwrap_or(Status::Converged);
        if control.is_stopped() {
            whole.status = Status::Interrupted;
        }
        let contact = combined.settings.contact;
        let is_other = |answer: &Answer| answer.settings.contact != contact;
        whole.answers.retain(is_other);
        whole.answers.insert(0, combined);
    }
    (whole, segments)
}

/// The answer of the segment that limits the stroke, with the worst verdict of all segments on each subject.
fn combined(segments: &[Segment]) -> Option<Answer> {
    let limiting = segments.iter().max_by(|a, b| {
        let is_blocked = |it: &Segment| it.answer.evaluation.is_none();
        let violation = |it: &Segment| it.answer.largest_violation();
        let by_violation = violation(a).total_cmp(&violation(b));
        is_blocked(a).cmp(&is_blocked(b)).then(by_violation)
    })?;
    let mut combined = limiting.answer.clone();
    let on_stroke = |segment: &Segment, verdict: &Verdict| Verdict {
        place: verdict.place.map(|place| place_in(segment.span, place)),
        ..*verdict
    };
    let stations = segments.iter().flat_map(|segment| {
        let stations = segment.answer.stations.iter();
        stations.map(|station| StationVerdicts {
            place: place_in(segment.span, station.place),
            rays: station.rays,
            verdicts: station
                .verdicts
                .iter()
                .map(|verdict| on_stroke(segment, verdict))
                .collect(),
        })
    });
    combined.stations = stations.collect();
    for verdict in &mut combined.verdicts {
        *verdict = on_stroke(limiting, verdict);
        let subject = verdict.subject;
        for segment in segments {
            let others = segment.answer.verdicts.iter();
            for other in others.filter(|it| it.subject == subject) {
                if other.is_worse_than(verdict) {
                    // Of a segment as a whole it is in its middle.
                    let place = other.place.unwrap_or(0.0);
                    *verdict = on_stroke(
                        segment,
                        &Verdict {
                            place: Some(place),
                            ..*other
                        },
                    );
                }
            }
        }
    }
    Some(combined)
}
