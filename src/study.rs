//! One door to all that can be asked about a problem.

mod command;

use std::path::Path;
use std::sync::Arc;

use crate::chart::{BesidePoint, Chart, Plan, Refusal, measure};
use crate::control::Control;
use crate::jet::{Draw, purpose};
use crate::map::{Axis, Map};
use crate::problem::change::Change;
use crate::problem::fault::Fault;
use crate::problem::setting::Settings;
use crate::problem::warning::Warning;
use crate::problem::{self, Problem, Source};
use crate::record::{FrontRecord, Record, RunInfo, StatusRecord, WorkRecord};
use crate::scenario::{Rejection, Scenario};
use crate::scene::Walls;
use crate::solve::{Answer, Segment, front, passing_windows, solve_stroke};
use crate::unknowns::Unknowns;
use crate::{evaluate, validity, warnings};
pub use command::quoted;

/// A problem file, checked, with its scene: what there is to solve.
#[derive(Clone)]
pub struct Study {
    scenario: Scenario,
    source: Source,
}

/// What a result holds besides the answer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Extras {
    /// The trade-off between target error, tangential risk and rebound.
    pub pareto: bool,
    /// What pictures are drawn from.
    pub evidence: bool,
}

/// Of several segments of a stroke the one whose settings are the best answer's.
fn limiting<'a>(segments: &'a [Segment], best: &Answer) -> Option<&'a Segment> {
    let is_limiting = |segment: &&Segment| segment.answer.settings == best.settings;
    (segments.len() > 1)
        .then(|| segments.iter().find(is_limiting))
        .flatten()
}

/// Stations of a segment at which its windows are looked at, less one.
const STATIONS: usize = 2;

/// Chords that stand in for arcs turn by at most this angle, rad.
const CHORD_ANGLE: f64 = std::f64::consts::PI / 180.0;

impl Study {
    /// Reads a problem file and its meshes and builds the scene.
    ///
    /// # Errors
    /// All faults of the file and of the geometry at once, in the order of the text.
    pub fn open(path: &Path) -> Result<Self, Box<Rejection>> {
        let (scenario, source) = Scenario::load(path)?;
        Ok(Self { scenario, source })
    }

    /// The same for a file of which some values are changed.
    ///
    /// # Errors
    /// See [`Self::open`]; also where a value cannot be changed.
    pub fn open_changed(path: &Path, changes: &[Change]) -> Result<Self, Box<Rejection>> {
        let (scenario, source) = Scenario::from_reading(problem::read_changed(path, changes))?;
        Ok(Self { scenario, source })
    }

    /// The same for a text that stands in no file; `path` is what messages call it and whose folder its
    /// meshes are in.
    ///
    /// # Errors
    /// See [`Self::open`].
    pub fn from_text(text: &str, path: &Path) -> Result<Self, Box<Rejection>> {
        Self::from_memory(text, path, &[])
    }

    /// The same with what is in its mesh files, by the names that the text has for them: nothing is read from
    /// the disk but what is not among them.
    ///
    /// # Errors
    /// See [`Self::open`].
    pub fn from_memory(
        text: &str,
        path: &Path,
        meshes: &[(&str, Arc<[u8]>)],
    ) -> Result<Self, Box<Rejection>> {
        let reading = problem::read_text(text, path).map(|reading| reading.with_meshes(meshes));
        let (scenario, source) = Scenario::from_reading(reading)?;
        Ok(Self { scenario, source })
    }

    /// The same with a problem that was changed in code, and its scene built anew.
    ///
    /// # Errors
    /// All faults of the geometry.
    pub fn with_problem(self, problem: Problem) -> Result<Self, Vec<Fault>> {
        Ok(Self {
            scenario: Scenario::new(problem, Walls::Exact)?,
            source: self.source,
        })
    }

    /// The problem.
    pub fn problem(&self) -> &Problem {
        &self.scenario.problem
    }

    /// The problem together with its scene.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// The text that was read.
    pub fn source(&self) -> &Source {
        &self.source
    }

    /// The same with another seed of all samples.
    #[must_use]
    pub fn with_seed(mut self, seed: u64) -> Self {
        self.scenario.problem.seed = seed;
        self
    }

    /// The same with another accuracy, relative to J.
    #[must_use]
    pub fn with_accuracy(mut self, accuracy: f64) -> Self {
        self.scenario.problem.accuracy = accuracy;
        self
    }

    /// The same with one contact to choose from, by its index in the problem.
    #[must_use]
    pub fn with_contact(mut self, contact: usize) -> Self {
        self.scenario.problem.ranges.contact = vec![contact];
        self
    }

    /// The same with every ray cast by parry at meshes, for shots that fly as points: the reference for the
    /// casts of this crate. Exact walls become triangles whose chords turn by a degree at most.
    ///
    /// # Errors
    /// Where a part cannot be turned into triangles.
    pub fn with_parry_rays(self) -> Result<Self, Vec<Fault>> {
        let mut problem = self.scenario.problem;
        problem.paths.shot_size = false;
        let walls = Walls::Parry {
            chord_angle: CHORD_ANGLE,
        };
        Ok(Self {
            scenario: Scenario::new(problem, walls)?,
            source: self.source,
        })
    }

    /// Whether parry casts the rays.
    pub fn has_parry_rays(&self) -> bool {
        self.scenario.scene.has_parry_rays()
    }

    /// Valid input that is probably a mistake, in the order of the text.
    pub fn check(&self) -> Vec<Warning> {
        warnings::of(&self.scenario, &self.source)
    }

    /// Finds the best settings; `None` where the problem has no contact to choose.
    pub fn solve(&self, extras: Extras, control: &Control) -> Option<Record> {
        let began = control.clock.seconds();
        let (solution, segments) = solve_stroke(&self.scenario, control);
        let asked = self.scenario.as_asked();
        let front = extras
            .pareto
            .then(|| front(&asked, &solution.answers, control));
        let status = match control.is_stopped() {
            true => StatusRecord::Interrupted,
            false => solution.status.into(),
        };
        let finishing = control.of_finishing();
        let best = solution.answers.first()?;
        let windows = match limiting(&segments, best) {
            Some(limiting) => {
                let part = asked.part_of_stroke(limiting.span, STATIONS);
                passing_windows(&part, &limiting.answer, &finishing.cancel)
            }
            None => passing_windows(&asked, best, &finishing.cancel),
        };
        let notes = validity::notes(&asked, &best.settings, best.evaluation.as_ref());
        let unknowns = (best.evaluation.is_some() && !finishing.is_stopped())
            .then(|| Unknowns::of(&asked, &best.settings))
            .flatten();
        let run = RunInfo {
            source: &self.source,
            status,
            spread: Some(solution.spread),
            command: command::solve(self, extras),
            segments: &segments,
            ablations: &solution.ablations,
            work: WorkRecord {
                poses: solution.poses + front.as_ref().map_or(0, |front| front.poses),
                shots_per_pose: solution.shots_per_pose,
                rays: solution.rays + front.as_ref().map_or(0, |front| front.rays),
                seconds: control.clock.seconds() - began,
            },
        };
        let mut record = Record::new(&asked, &solution.answers, &windows, notes, unknowns, run)?;
        if let Some(front) = &front {
            record.front = FrontRecord::all(&asked, front);
        }
        Some(match extras.evidence {
            true => record.with_evidence(&asked, best, &finishing),
            false => record,
        })
    }

    /// Evaluates given settings on `shots` validation shots.
    pub fn evaluate(
        &self,
        settings: &Settings,
        shots: usize,
        extras: Extras,
        control: &Control,
    ) -> Option<Record> {
        let began = control.clock.seconds();
        let asked = self.scenario.as_asked();
        let draw = Draw::new(&asked.problem, purpose::ANSWERS, shots);
        let evaluation = evaluate::evaluate_streamed(&asked, settings, &draw);
        let fired = evaluation.shots;
        let answers = [Answer::evaluated(&asked, settings, Some(evaluation))];
        let rays = answers[0].rays();
        let notes = validity::notes(&asked, settings, answers[0].evaluation.as_ref());
        let unknowns = Unknowns::of(&asked, settings);
        let run = RunInfo {
            source: &self.source,
            status: StatusRecord::Evaluated,
            spread: None,
            command: command::evaluate(self, settings, shots),
            segments: &[],
            ablations: &[],
            work: WorkRecord {
                poses: 1,
                shots_per_pose: fired,
                rays,
                seconds: control.clock.seconds() - began,
            },
        };
        let record = Record::new(&asked, &answers, &[], notes, unknowns, run)?;
        Some(match extras.evidence {
            true => record.with_evidence(&asked, &answers[0], &control.of_finishing()),
            false => record,
        })
    }

    /// The objective and the verdicts over two settings, the others held, on `shots` shots at each place.
    pub fn map(
        &self,
        settings: &Settings,
        [x, y]: [Axis; 2],
        shots: usize,
        control: &Control,
    ) -> Map {
        Map::of(&self.scenario.as_asked(), settings, x, y, shots, control)
    }

    /// Speed against accuracy, measured on this problem; `command` makes it again.
    ///
    /// # Errors
    /// When there is nothing to measure.
    pub fn chart(
        &self,
        command: String,
        beside: Vec<BesidePoint>,
        plan: &Plan,
    ) -> Result<Chart, Refusal> {
        let asked = self.scenario.as_asked();
        measure(&asked, &self.source, command, beside, plan)
    }
}
