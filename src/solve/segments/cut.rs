//! A stroke cut into cells, and which settings pass at which of them.

use rayon::prelude::*;

use super::Segment;
use super::candidate::{Candidate, are_alike};
use super::rounding::{fits, rounded};
use crate::control::Control;
use crate::evaluate::{Evaluation, evaluate_adaptively};
use crate::feasibility::infeasibility;
use crate::jet::{ValidationSample, purpose};
use crate::problem::setting::{Range, Settings};
use crate::problem::stroke::{Hold, Stroke};
use crate::scenario::{Scenario, Station};
use crate::solve::answer::Answer;
use crate::solve::{Status, Wanted, best_of};
use crate::verdict::{StationVerdicts, Verdict};

/// A stroke cut into cells.
pub struct Cut<'a> {
    pub(super) scenario: &'a Scenario,
    /// With the effects that are asked for.
    asked: Scenario,
    stroke: &'a Stroke,
    pub(super) control: &'a Control,
    /// The ends of cells, one more than there are cells.
    ends: Vec<f64>,
    /// What is held all along has these values.
    held: Settings,
    validation: ValidationSample,
    /// Work done by searches of parts, and to tell where settings pass.
    pub rays: usize,
    /// See `rays`.
    pub poses: usize,
}

/// Cells with the same settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    pub from: usize,
    /// The first cell behind it.
    pub to: usize,
    pub candidate: usize,
}

impl<'a> Cut<'a> {
    pub fn new(
        scenario: &'a Scenario,
        stroke: &'a Stroke,
        control: &'a Control,
        held: Settings,
    ) -> Self {
        let within = scenario
            .stations
            .iter()
            .filter(|it| !it.scenario.in_run_out);
        let places: Vec<f64> = within.map(|it| it.place).collect();
        let between = places.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let ends = [-0.5].into_iter().chain(between).chain([0.5]).collect();
        Self {
            scenario,
            asked: scenario.as_asked(),
            stroke,
            control,
            ends,
            held,
            validation: ValidationSample::new(
                &scenario.problem,
                purpose::ANSWERS,
                control.first_validation_shots(),
            ),
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

    /// Where settings pass.
    pub fn candidate(&mut self, settings: &Settings, status: Status) -> Candidate {
        let mut places: Vec<f64> = self.ends.clone();
        places.extend(self.scenario.stations.iter().map(|it| it.place));
        places.sort_by(f64::total_cmp);
        places.dedup();
        let stations: Vec<Station> = places
            .par_iter()
            .map(|&place| self.asked.station(place))
            .collect();
        let settings = rounded(
            settings,
            self.stroke,
            &self.scenario.problem.ranges,
            &stations,
        );
        let (violations, rays) = violations_at(&stations, &self.asked, &settings);
        self.rays += rays;
        let in_cell = |cell: usize| {
            let pairs = places.iter().zip(&violations);
            // The run-out belongs to the first and to the last cell.
            let inside = pairs.filter(|(place, _)| {
                let place = place.clamp(-0.5, 0.5);
                (self.ends[cell]..=self.ends[cell + 1]).contains(&place)
            });
            inside.map(|(_, violation)| *violation).fold(0.0, f64::max)
        };
        Candidate {
            settings,
            violations: (0..self.cells()).map(in_cell).collect(),
            status,
        }
    }

    /// Searches a part of the stroke, for one contact alone if that is told.
    fn search(&mut self, from: usize, to: usize, contact: Option<usize>) -> Vec<Candidate> {
        let mut part = self.part(from, to);
        if let Some(contact) = contact {
            part.problem.ranges.contact = vec![contact];
        }
        // What they come to is verified at all places of the cells.
        let control = Control {
            most_shots: self.control.most_shots.min(FEW_SHOTS),
            validation_shots: self.control.first_validation_shots(),
            ..self.control.clone()
        };
        let wanted = Wanted {
            ablations: false,
            ..Wanted::ALL
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

    fn holds_contact(&self) -> bool {
        matches!(self.stroke.hold, Hold::Some { contact: true, .. })
    }

    /// The contacts of which one has to pass at all cells: each alone where it is held all along, else any.
    fn choices(&self) -> Vec<Option<usize>> {
        let contacts = self.scenario.problem.ranges.contact.iter();
        match self.holds_contact() {
            true => contacts.copied().map(Some).collect(),
            false => vec![None],
        }
    }

    /// The cells at which no candidate passes, of a contact if one is told.
    fn open_cells(&self, candidates: &[Candidate], contact: Option<usize>) -> Vec<usize> {
        let counts = |it: &Candidate| contact.is_none_or(|contact| it.settings.contact == contact);
        let is_passed = |cell| candidates.iter().any(|it| counts(it) && it.passes(cell));
        (0..self.cells()).filter(|&cell| !is_passed(cell)).collect()
    }

    /// Searches the cells at which no candidate passes; where the contact is held all along, none of the contact that passes at most
    /// of them: what another one passes is of no use to it. Where a search has found nothing for a cell, none is made for cells like it.
    pub fn fill(&mut self, candidates: &mut Vec<Candidate>) {
        let mut searched: Vec<(usize, Option<usize>)> = Vec::new();
        while !self.control.is_stopped() {
            let choices = self.choices().into_iter();
            let open = choices.map(|contact| (contact, self.open_cells(candidates, contact)));
            let Some((contact, open)) = open.min_by_key(|(_, open)| open.len()) else {
                break;
            };
            let is_new = |&cell: &usize| {
                let mut before = searched.iter().filter(|(_, of)| *of == contact);
                before.all(|&(other, _)| other != cell && !are_alike(candidates, [other, cell]))
            };
            let Some(cell) = open.into_iter().find(is_new) else {
                break;
            };
            searched.push((cell, contact));
            candidates.extend(self.search(cell, cell + 1, contact));
        }
    }

    /// The fewest pieces: with one contact, if one of them passes everywhere.
    pub fn cover(&self, candidates: &[Candidate]) -> Vec<Piece> {
        let contacts = &self.scenario.problem.ranges.contact;
        let with_one = contacts.iter().filter_map(|&contact| {
            let pieces = self.pieces(candidates, |it| it.settings.contact == contact)?;
            (failing(candidates, &pieces) == 0).then_some(pieces)
        });
        let fewest = with_one.min_by_key(Vec::len);
        fewest
            .or_else(|| {
                self.holds_contact()
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
        each.min_by_key(|pieces| failing(candidates, pieces))
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
    pub fn merge(&mut self, candidates: &mut Vec<Candidate>, pieces: &mut Vec<Piece>) {
        let mut index = 0;
        while index + 1 < pieces.len() && !self.control.is_stopped() {
            let (from, to) = (pieces[index].from, pieces[index + 1].to);
            let found = self.search(from, to, None);
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
    pub fn segments(&self, candidates: &[Candidate], pieces: &[Piece]) -> Vec<Segment> {
        let segment = |piece: &Piece| {
            let part = self.part(piece.from, piece.to).as_asked();
            let settings = candidates[piece.candidate].settings;
            let evaluation = self.evaluated(&part, &settings);
            Segment {
                span: [self.ends[piece.from], self.ends[piece.to]],
                answer: Answer::evaluated(&part, &settings, evaluation),
            }
        };
        pieces.par_iter().map(segment).collect()
    }

    /// J of some settings over a piece; `None` where they do not fit.
    pub fn objective(&mut self, settings: &Settings, piece: Piece) -> Option<f64> {
        let part = self.part(piece.from, piece.to).as_asked();
        let evaluation = self.evaluated(&part, settings)?;
        self.rays += evaluation.rays;
        self.poses += 1;
        Some(evaluation.terms.total())
    }

    /// What settings do on a part of the stroke, on the same shots for all of them.
    fn evaluated(&self, part: &Scenario, settings: &Settings) -> Option<Evaluation> {
        infeasibility(part, settings)
            .is_none()
            .then(|| evaluate_adaptively(part, settings, &self.validation))
    }
}

/// How many pieces fail.
fn failing(candidates: &[Candidate], pieces: &[Piece]) -> usize {
    let fails = |piece: &&Piece| candidates[piece.candidate].reach(piece.from) < piece.to;
    pieces.iter().filter(fails).count()
}

/// Most shots at a pose of the search of a part.
const FEW_SHOTS: usize = 1024;

/// The largest violation of some settings at each station, and the rays that told it.
fn violations_at(stations: &[Station], asked: &Scenario, settings: &Settings) -> (Vec<f64>, usize) {
    let fitting = stations.par_iter().map(|it| fits(it, settings));
    let fitting: Vec<bool> = fitting.collect();
    let pairs = stations.iter().zip(&fitting);
    let open: Vec<&Station> = pairs
        .filter_map(|(station, fits)| fits.then_some(station))
        .collect();
    let verdicts = StationVerdicts::at(&open, &asked.problem, settings);
    let rays = verdicts.iter().map(|station| station.rays).sum();
    let mut verdicts = verdicts.into_iter();
    let violation = |fits: &bool| {
        let at_station = fits.then(|| verdicts.next()).flatten();
        at_station.map_or(f64::MAX, |station| {
            Verdict::largest_violation(&station.verdicts)
        })
    };
    (fitting.iter().map(violation).collect(), rays)
}
