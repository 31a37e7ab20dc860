//! The objective, its terms and the verdicts over two settings, all others held.

mod standard;

pub use standard::standard_maps;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::control::Control;
use crate::evaluate::{LargestImpulses, ViolationCounts};
use crate::feasibility::infeasibility;
use crate::jet::{Replicates, Samples, ShotSample, purpose};
use crate::objective::Terms;
use crate::problem::Problem;
use crate::problem::setting::{Range, Setting, Settings};
use crate::scenario::Scenario;
use crate::verdict::{Subject, Verdict};

/// What two settings do while all others are held.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// The lower axis.
    pub x: Axis,
    /// The left axis.
    pub y: Axis,
    /// Shots at each place, the same for all of them.
    pub shots: usize,
    /// What verdicts are given on.
    pub subjects: Vec<Subject>,
    /// Row by row, from the first y; within a row from the first x.
    pub places: Vec<Place>,
}

/// What is known of one place of a map.
#[derive(Clone, Debug, PartialEq)]
pub enum Place {
    /// The map was asked to stop before.
    Unknown,
    /// The nozzle does not fit.
    Blocked,
    /// The nozzle fits.
    Open(Cell),
}

/// One axis of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The setting that varies.
    pub setting: Setting,
    /// Its values, SI.
    pub values: Vec<f64>,
}

/// What a place of a map does where the nozzle fits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// The terms of the objective.
    pub terms: Terms,
    /// The subjects whose verdicts fail.
    pub failing: Vec<Subject>,
    /// Share of the first hits on target that stick; `None` where there is none.
    pub share_sticking: Option<f64>,
}

impl Place {
    /// What the place does; `None` where the nozzle does not fit or nothing is known.
    pub fn cell(&self) -> Option<&Cell> {
        match self {
            Self::Open(cell) => Some(cell),
            Self::Unknown | Self::Blocked => None,
        }
    }
}

impl Axis {
    /// A setting over a range, both ends included.
    pub fn over(setting: Setting, range: Range, steps: usize) -> Self {
        let last = steps.saturating_sub(1).max(1) as f64;
        let value = |step: usize| range.at(step as f64 / last);
        Self {
            setting,
            values: (0..steps).map(value).collect(),
        }
    }
}

impl Map {
    /// The map of two settings, all others as in `settings`, on `shots` shots of the jet (one where all shots
    /// are the same).
    ///
    /// Where the paths do not depend on the speed they are traced once for all of its values. Rows,
    /// columns or places that are in the checkpoint are taken from there.
    pub fn of(
        scenario: &Scenario,
        settings: &Settings,
        x: Axis,
        y: Axis,
        shots: usize,
        control: &Control,
    ) -> Self {
        let shots = common_shots(&scenario.problem, shots);
        let kind = format!("map {x:?} {y:?}");
        let page = control.checkpoint.as_deref();
        let page = page.map(|checkpoint| checkpoint.page(&kind, scenario, &shots));
        let columns = x.values.len();
        let place = |index: usize| {
            let across = x.setting.with(settings, x.values[index % columns]);
            y.setting.with(&across, y.values[index / columns])
        };
        let count = columns * y.values.len();
        let shares_paths = scenario.speed_scales_out(settings.contact);
        let groups: Vec<Vec<usize>> = if shares_paths && x.setting == Setting::Speed {
            let row = |first: usize| (first..first + columns).collect();
            (0..count).step_by(columns.max(1)).map(row).collect()
        } else if shares_paths && y.setting == Setting::Speed {
            let column = |first: usize| (first..count).step_by(columns).collect();
            (0..columns).map(column).collect()
        } else {
            (0..count).map(|index| vec![index]).collect()
        };
        let cells_of = |group: &Vec<usize>| {
            if control.is_stopped() {
                return Vec::new();
            }
            let work = || cells_on_one_path(scenario, group, place, &shots);
            let are_sound = |cells: &Vec<Option<Cell>>| {
                cells.len() == group.len() && cells.iter().flatten().all(Cell::is_sound)
            };
            let known = page.as_ref().zip(group.first());
            let recalled =
                known.and_then(|(page, &first)| page.recall(&place(first), &[], are_sound));
            recalled.unwrap_or_else(|| {
                let cells = work();
                if let Some((page, &first)) = known {
                    page.keep(&place(first), &[], &cells);
                }
                cells
            })
        };
        let found: Vec<Vec<Option<Cell>>> = groups.par_iter().map(cells_of).collect();
        let mut places = vec![Place::Unknown; count];
        for (group, cells) in groups.iter().zip(found) {
            for (&index, cell) in group.iter().zip(cells) {
                places[index] = cell.map_or(Place::Blocked, Place::Open);
            }
        }
        Self {
            x,
            y,
            shots: shots.len(),
            subjects: subjects(scenario),
            places,
        }
    }
}

impl Cell {
    /// Whether shots can do this.
    fn is_sound(&self) -> bool {
        let share = self.share_sticking.unwrap_or_default();
        self.terms.are_sound() && (0.0..=1.0).contains(&share)
    }
}

/// The cells of places that differ in nothing but a speed on which no path depends; `None` where the
/// nozzle does not fit.
fn cells_on_one_path(
    scenario: &Scenario,
    group: &[usize],
    place: impl Fn(usize) -> Settings,
    shots: &[ShotSample],
) -> Vec<Option<Cell>> {
    let Some(&first) = group.first() else {
        return Vec::new();
    };
    let settings = place(first);
    if infeasibility(scenario, &settings).is_some() {
        return vec![None; group.len()];
    }
    let largest_impulses = LargestImpulses::of(scenario, &settings, shots);
    let cell = |&index: &usize| Some(cell(scenario, &largest_impulses, place(index).speed));
    group.iter().map(cell).collect()
}

/// The cell at a launch speed, m/s.
fn cell(scenario: &Scenario, largest_impulses: &LargestImpulses, speed: f64) -> Cell {
    let verdicts = Verdict::on(scenario, &largest_impulses.counts(scenario, speed));
    let failing = verdicts.iter().filter(|verdict| !verdict.passes());
    Cell {
        terms: largest_impulses.terms(scenario, speed),
        failing: failing.map(|verdict| verdict.subject).collect(),
        share_sticking: largest_impulses.share_sticking(),
    }
}

/// The shots of every place: others than those that a search decides on.
fn common_shots(problem: &Problem, shots: usize) -> Vec<ShotSample> {
    let count = if problem.has_one_ray() { 1 } else { shots };
    let stream = Replicates::stream(purpose::WINDOWS, 0);
    Samples::new(problem, stream, count).shots
}

/// What verdicts are given on in a problem.
fn subjects(scenario: &Scenario) -> Vec<Subject> {
    let verdicts = Verdict::on(scenario, &ViolationCounts::none(scenario));
    verdicts.iter().map(|verdict| verdict.subject).collect()
}
