//! The fewest segments of a stroke within which settings hold, where one setting all along does not pass.
//!
//! Which settings pass at which cell of the stroke, a station with half the way to its neighbours, is a table; the
//! fewest pieces that cover all cells follow from it by taking the longest piece again and again, which is exact for
//! intervals. Settings come from searches: of the whole stroke, of cells that nothing passes yet, and of neighbouring
//! pieces together.

use rayon::prelude::*;

use super::answer::Answer;
use super::{Solution, Status, Wanted, best_of, solve};
use crate::control::Control;
use crate::evaluate::evaluate_adaptively;
use crate::feasibility::infeasibility;
use crate::jet::{ValidationSample, purpose};
use crate::problem::setting::{Range, Setting, Settings};
use crate::problem::stroke::{Hold, Stroke};
use crate::scenario::{Scenario, Station};
use crate::verdict::{StationVerdicts, Verdict};

/// A piece of a stroke with settings of its own.
#[derive(Clone, Debug)]
pub struct Segment {
    /// Places of its ends on the whole stroke.
    pub span: [f64; 2],
    /// The settings and what they do there.
    pub answer: Answer,
}

/// Settings, and at which cells they pass.
#[derive(Clone)]
struct Candidate {
    settings: Settings,
    /// The largest violation in each cell; at most 1 where all verdicts pass there.
    violations: Vec<f64>,
    status: Status,
}

impl Candidate {
    fn passes(&self, cell: usize) -> bool {
        self.violations[cell] <= 1.0
    }

    /// How far it passes from a cell on: the first cell at which it does not.
    fn reach(&self, from: usize) -> usize {
        let mut cells = from..self.violations.len();
        cells
            .find(|&cell| !self.passes(cell))
            .unwrap_or(self.violations.len())
    }
}

/// A stroke cut into cells.
struct Cut<'a> {
    scenario: &'a Scenario,
    /// With the effects that are asked for.
    asked: Scenario,
    stroke: &'a Stroke,
    control: &'a Control,
    /// The ends of cells, one more than there are cells.
    ends: Vec<f64>,
    /// What is held all along has these values.
    held: Settings,
    rays: usize,
    poses: usize,
}

/// Finds the best settings of a stroke, or the fewest segments of it with settings of their own where the problem lets
/// something change and one setting does not pass; the best answer is then that of the segment that limits it.
pub fn solve_stroke(scenario: &Scenario, control: &Control) -> (Solution, Vec<Segment>) {
    let stroke = scenario.problem.stroke.as_ref();
    let Some(stroke) = stroke.filter(|stroke| stroke.hold != Hold::All) else {
        return (solve(scenario, control), Vec::new());
    };
    let mut whole = best_of(
        scenario,
        control,
        Wanted {
            passing: false,
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
    let segments = cut.segments(&candidates, &pieces);
    whole.status = pieces
        .iter()
        .map(|piece| candidates[piece.candidate].status)
        .find(|&status| status != Status::Converged)
        .unwrap_or(Status::Converged);
    if control.is_stopped() {
        whole.status = Status::Interrupted;
    }
    whole.rays += cut.rays;
    whole.poses += cut.poses;
    let combined = combined(&segments);
    let contact = combined.settings.contact;
    whole
        .answers
        .retain(|answer| answer.settings.contact != contact);
    whole.answers.insert(0, combined);
    (whole, segments)
}

/// Cells with the same settings.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    from: usize,
    /// The first cell behind it.
    to: usize,
    candidate: usize,
}

impl<'a> Cut<'a> {
    fn new(
        scenario: &'a Scenario,
        stroke: &'a Stroke,
        control: &'a Control,
        held: Settings,
    ) -> Self {
        let places: Vec<f64> = scenario.stations.iter().map(|it| it.place).collect();
        let between = places.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let ends = [-0.5].into_iter().chain(between).chain([0.5]).collect();
        Self {
            scenario,
            asked: scenario.as_asked(),
            stroke,
            control,
            ends,
            held,
            rays: 0,
            poses: 0,
        }
    }

    fn cells(&self) -> usize {
        self.ends.len() - 1
    }

    /// The stroke from one cell to another, with what is held all along held.
    fn part(&self, from: usize, to: usize) -> Scenario {
        let mut part = self
            .scenario
            .part_of_stroke([self.ends[from], self.ends[to]], to - from + 1);
        if let Hold::Some { settings, .. } = &self.stroke.hold {
            let ranges = &mut part.problem.ranges;
            for setting in settings {
                ranges.set(*setting, Range::held(setting.of(&self.held)));
            }
        }
        part
    }

    /// Settings rounded to what is worth programming.
    fn rounded(&self, settings: &Settings) -> Settings {
        let mut rounded = *settings;
        let is_held = |setting: &Setting| match &self.stroke.hold {
            Hold::All => true,
            Hold::Some { settings, .. } => settings.contains(setting),
        };
        for &(setting, step) in &self.stroke.steps {
            if let Some(range) = self.scenario.problem.ranges.range(setting)
                && !is_held(&setting)
            {
                let value = (setting.of(settings) / step).round() * step;
                rounded = setting.with(&rounded, value.clamp(range.min, range.max));
            }
        }
        rounded
    }

    /// Where settings pass.
    fn candidate(&self, settings: &Settings, status: Status) -> Candidate {
        let settings = self.rounded(settings);
        let mut places: Vec<f64> = self.ends.clone();
        places.extend(self.scenario.stations.iter().map(|it| it.place));
        places.sort_by(f64::total_cmp);
        places.dedup();
        let stations: Vec<Station> = places
            .par_iter()
            .map(|&place| Station {
                place,
                scenario: self.asked.standing_at(place),
            })
            .collect();
        let violations = violations_at(&stations, &self.asked, &settings);
        let in_cell = |cell: usize| {
            let pairs = places.iter().zip(&violations);
            let inside =
                pairs.filter(|(place, _)| (self.ends[cell]..=self.ends[cell + 1]).contains(*place));
            inside.map(|(_, violation)| *violation).fold(0.0, f64::max)
        };
        Candidate {
            settings,
            violations: (0..self.cells()).map(in_cell).collect(),
            status,
        }
    }

    /// Searches a part of the stroke.
    fn search(&mut self, from: usize, to: usize) -> Vec<Candidate> {
        let part = self.part(from, to);
        // What they come to is verified at all places of the cells.
        let control = Control {
            most_shots: self.control.most_shots.min(FEW_SHOTS),
            validation_shots: self.control.first_validation_shots(),
            ..self.control.clone()
        };
        let wanted = Wanted {
            passing: true,
            ablations: false,
        };
        let solution = best_of(&part, &control, wanted);
        self.rays += solution.rays;
        self.poses += solution.poses;
        let answers = solution.answers.iter();
        let fitting = answers.filter(|answer| answer.evaluation.is_some());
        fitting
            .map(|answer| self.candidate(&answer.settings, solution.status))
            .collect()
    }

    /// Searches the cells at which no candidate passes.
    fn fill(&mut self, candidates: &mut Vec<Candidate>) {
        for cell in 0..self.cells() {
            let is_passed = candidates.iter().any(|candidate| candidate.passes(cell));
            if !is_passed && !self.control.is_stopped() {
                candidates.extend(self.search(cell, cell + 1));
            }
        }
    }

    /// The fewest pieces: with one contact, if one of them passes everywhere.
    fn cover(&self, candidates: &[Candidate]) -> Vec<Piece> {
        let contacts = &self.scenario.problem.ranges.contact;
        let with_one = contacts.iter().filter_map(|&contact| {
            let pieces = self.pieces(candidates, |it| it.settings.contact == contact)?;
            let passes = |piece: &Piece| candidates[piece.candidate].reach(piece.from) >= piece.to;
            pieces.iter().all(passes).then_some(pieces)
        });
        let fewest = with_one.min_by_key(Vec::len);
        let holds_contact = matches!(self.stroke.hold, Hold::Some { contact: true, .. });
        fewest
            .or_else(|| {
                holds_contact
                    .then(|| self.least_failing(candidates))
                    .flatten()
            })
            .or_else(|| self.pieces(candidates, |_| true))
            .unwrap_or_default()
    }

    /// The pieces of the contact that fails at the fewest cells.
    fn least_failing(&self, candidates: &[Candidate]) -> Option<Vec<Piece>> {
        let contacts = self.scenario.problem.ranges.contact.iter();
        let each = contacts
            .filter_map(|&contact| self.pieces(candidates, |it| it.settings.contact == contact));
        each.min_by_key(|pieces| {
            let fails = |piece: &Piece| candidates[piece.candidate].reach(piece.from) < piece.to;
            pieces.iter().filter(|piece| fails(piece)).count()
        })
    }

    /// The longest piece from each cell on; where nothing passes, the one with the least violation there.
    fn pieces(
        &self,
        candidates: &[Candidate],
        counts: impl Fn(&Candidate) -> bool,
    ) -> Option<Vec<Piece>> {
        let counted = || candidates.iter().enumerate().filter(|(_, it)| counts(it));
        let mut pieces: Vec<Piece> = Vec::new();
        let mut from = 0;
        while from < self.cells() {
            let farthest = counted().map(|(_, it)| it.reach(from)).max()?;
            // Of those that reach as far the first one: searches rank them.
            let (candidate, to) = if farthest > from {
                let (index, _) = counted().find(|(_, it)| it.reach(from) == farthest)?;
                (index, farthest)
            } else {
                let (index, _) = counted()
                    .min_by(|(_, a), (_, b)| a.violations[from].total_cmp(&b.violations[from]))?;
                (index, from + 1)
            };
            match pieces.last_mut() {
                Some(last) if last.candidate == candidate => last.to = to,
                _ => pieces.push(Piece {
                    from,
                    to,
                    candidate,
                }),
            }
            from = to;
        }
        Some(pieces)
    }

    /// Searches neighbouring pieces together, as settings that pass in both may be others than those of either.
    fn merge(&mut self, candidates: &mut Vec<Candidate>, pieces: &mut Vec<Piece>) {
        let mut index = 0;
        while index + 1 < pieces.len() && !self.control.is_stopped() {
            let (from, to) = (pieces[index].from, pieces[index + 1].to);
            let found = self.search(from, to);
            let fits = |it: &Candidate| it.reach(from) >= to;
            candidates.extend(found.iter().cloned());
            if found.iter().any(fits) {
                *pieces = self.cover(candidates);
                index = 0;
            } else {
                index += 1;
            }
        }
        let again = self.cover(candidates);
        if again.len() < pieces.len() {
            *pieces = again;
        }
    }

    /// The answers of pieces.
    fn segments(&self, candidates: &[Candidate], pieces: &[Piece]) -> Vec<Segment> {
        let validation = ValidationSample::new(
            &self.scenario.problem,
            purpose::ANSWERS,
            self.control.first_validation_shots(),
        );
        let segment = |piece: &Piece| {
            let part = self.part(piece.from, piece.to).as_asked();
            let settings = candidates[piece.candidate].settings;
            let evaluation = infeasibility(&part, &settings)
                .is_none()
                .then(|| evaluate_adaptively(&part, &settings, &validation));
            Segment {
                span: [self.ends[piece.from], self.ends[piece.to]],
                answer: Answer::evaluated(&part, &settings, evaluation),
            }
        };
        pieces.par_iter().map(segment).collect()
    }
}

/// Most shots at a pose of the search of a part.
const FEW_SHOTS: usize = 1024;

/// The largest violation of some settings at each station.
fn violations_at(stations: &[Station], asked: &Scenario, settings: &Settings) -> Vec<f64> {
    let fits = |station: &Station| infeasibility(&station.scenario, settings).is_none();
    let fitting: Vec<bool> = stations.par_iter().map(fits).collect();
    let pairs = stations.iter().zip(&fitting);
    let open: Vec<&Station> = pairs
        .filter_map(|(station, fits)| fits.then_some(station))
        .collect();
    let mut verdicts = StationVerdicts::at(&open, &asked.problem, settings).into_iter();
    let violation = |fits: &bool| {
        let at_station = fits.then(|| verdicts.next()).flatten();
        at_station.map_or(f64::MAX, |station| {
            let violations = station.verdicts.iter().map(Verdict::violation);
            violations.fold(0.0, f64::max)
        })
    };
    fitting.iter().map(violation).collect()
}

/// The answer of the segment that limits the stroke, with the worst verdict of all segments on each subject.
fn combined(segments: &[Segment]) -> Answer {
    let limiting = segments.iter().max_by(|a, b| {
        let key = |it: &Segment| {
            (
                it.answer.evaluation.is_none(),
                it.answer.largest_violation(),
            )
        };
        let ((a_blocked, a), (b_blocked, b)) = (key(a), key(b));
        a_blocked.cmp(&b_blocked).then(a.total_cmp(&b))
    });
    let limiting = limiting.expect("a stroke has a segment");
    let mut combined = limiting.answer.clone();
    let global = |segment: &Segment, place: f64| {
        let [from, to] = segment.span;
        from + (to - from) * (place + 0.5)
    };
    combined.stations = segments
        .iter()
        .flat_map(|segment| {
            segment.answer.stations.iter().map(|station| {
                let place = global(segment, station.place);
                let verdicts = station.verdicts.iter().map(|verdict| Verdict {
                    place: Some(place),
                    ..*verdict
                });
                StationVerdicts {
                    place,
                    verdicts: verdicts.collect(),
                    rays: station.rays,
                }
            })
        })
        .collect();
    for verdict in &mut combined.verdicts {
        verdict.place = verdict.place.map(|place| global(limiting, place));
        for segment in segments {
            let others = segment.answer.verdicts.iter();
            let subject = verdict.subject;
            for other in others.filter(|it| it.subject == subject) {
                let here = (verdict.violation(), verdict.share());
                if (other.violation(), other.share()) > here {
                    *verdict = *other;
                    // Of a segment as a whole it is in its middle.
                    verdict.place = Some(global(segment, other.place.unwrap_or(0.0)));
                }
            }
        }
    }
    combined
}
