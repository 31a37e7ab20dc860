//! Tolerance windows: how far each setting may drift alone before a verdict changes.

use rayon::prelude::*;

use super::Solution;
use crate::control::Cancel;
use crate::elementary::whole_power;
use crate::evaluate::{LargestImpulses, ViolationCounts};
use crate::feasibility::{Obstacle, infeasibility};
use crate::jet::{Replicate, Replicates, purpose};
use crate::problem::setting::{Range, Setting, Settings};
use crate::scenario::Scenario;
use crate::verdict::{Subject, Verdict};

/// The tolerance window of one setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Window {
    /// The setting.
    pub setting: Setting,
    /// Downwards.
    pub down: Drift,
    /// Upwards.
    pub up: Drift,
}

/// How far a setting may drift one way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drift {
    /// The last value at which no verdict has changed, SI.
    pub to: f64,
    /// Width of the interval in which one changes, SI; 0 when none does.
    pub within: f64,
    /// What changes beyond.
    pub turns: Option<Turn>,
}

/// What ends a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Turn {
    /// A verdict that passed fails.
    Verdict(Subject),
    /// The nozzle comes too near to the part.
    Clearance,
    /// The nozzle leaves free space.
    FreeSpace,
}

/// Halvings of the interval in which a verdict changes.
const HALVINGS: usize = 6;
/// Steps of doubling length from the answer outwards.
const DOUBLINGS: i32 = 5;

/// The windows round the best answer, for the verdicts that it passes; none without a pose that fits, and
/// none of those that are not known when the request to end comes.
pub fn passing_windows(scenario: &Scenario, solution: &Solution, cancel: &Cancel) -> Vec<Window> {
    let Some(best) = solution.answers.first() else {
        return Vec::new();
    };
    if best.evaluation.is_none() {
        return Vec::new();
    }
    let passing: Vec<Subject> = best
        .verdicts
        .iter()
        .filter(|verdict| verdict.passes())
        .map(|verdict| verdict.subject)
        .collect();
    let validation =
        Replicates::without_boundary(&scenario.problem, purpose::WINDOWS, WINDOW_SHOTS);
    windows(scenario, &best.settings, &passing, &validation, cancel)
}

/// Shots behind each verdict of a window at most.
const WINDOW_SHOTS: usize = 4096;

/// The windows of all settings that have a range, each as far as its range goes.
pub fn windows(
    scenario: &Scenario,
    settings: &Settings,
    passing: &[Subject],
    validation: &Replicates,
    cancel: &Cancel,
) -> Vec<Window> {
    let is_stopped = || cancel.is_set();
    let ranges: Vec<(Setting, Range)> = Setting::OF_THE_NOZZLE
        .into_iter()
        .filter_map(|setting| Some((setting, scenario.problem.ranges.range(setting)?)))
        .filter(|(_, range)| !range.is_held())
        .collect();
    let shares_paths = scenario.speed_scales_out(settings.contact);
    let window = |&(setting, Range { min, max }): &(Setting, Range)| {
        // A window that is cut short says nothing.
        let drift = |end: f64, shots: &mut dyn Shots| {
            drift(scenario, settings, (setting, end), passing, shots, cancel)
        };
        let (down, up) = if setting == Setting::Speed && shares_paths {
            let mut shots = Recorded::of(scenario, settings, validation);
            (drift(min, &mut shots), drift(max, &mut shots))
        } else {
            let traced = || Traced {
                scenario,
                validation,
            };
            rayon::join(|| drift(min, &mut traced()), || drift(max, &mut traced()))
        };
        (!is_stopped()).then_some(Window { setting, down, up })
    };
    ranges.par_iter().filter_map(window).collect()
}

/// Shots that show which verdicts would change, replicate by replicate.
trait Shots {
    /// What some of them do; `None` beyond the last.
    fn counts(&mut self, settings: &Settings, part: usize) -> Option<ViolationCounts>;
}

/// Replicates that are fired together.
const SETS: usize = 2;

/// Impulses of replicates that are fired together; `None` beyond the last.
fn largest_impulses(
    scenario: &Scenario,
    settings: &Settings,
    validation: &Replicates,
    part: usize,
) -> Option<Vec<LargestImpulses>> {
    let sets = validation.sets.chunks(SETS).nth(part)?.par_iter();
    let largest_impulses =
        |set: &Replicate| LargestImpulses::of(scenario, settings, &set.jet.shots);
    Some(sets.map(largest_impulses).collect())
}

/// What is seen in them with shots of some speed, m/s.
fn counts(
    scenario: &Scenario,
    largest_impulses: &[LargestImpulses],
    speed: f64,
) -> ViolationCounts {
    let each = largest_impulses
        .iter()
        .map(|largest_impulses| largest_impulses.counts(scenario, speed));
    ViolationCounts::together(scenario, each)
}

/// Shots that are traced at all settings.
struct Traced<'a> {
    scenario: &'a Scenario,
    validation: &'a Replicates,
}

impl Shots for Traced<'_> {
    fn counts(&mut self, settings: &Settings, part: usize) -> Option<ViolationCounts> {
        let largest_impulses = largest_impulses(self.scenario, settings, self.validation, part)?;
        Some(counts(self.scenario, &largest_impulses, settings.speed))
    }
}

/// Shots at settings that differ in the speed only, on which their paths do not depend.
struct Recorded<'a> {
    scenario: &'a Scenario,
    settings: &'a Settings,
    validation: &'a Replicates,
    /// Those that were asked for.
    seen: Vec<Vec<LargestImpulses>>,
}

impl<'a> Recorded<'a> {
    fn of(scenario: &'a Scenario, settings: &'a Settings, validation: &'a Replicates) -> Self {
        Self {
            scenario,
            settings,
            validation,
            seen: Vec::new(),
        }
    }
}

impl Shots for Recorded<'_> {
    fn counts(&mut self, settings: &Settings, part: usize) -> Option<ViolationCounts> {
        if part == self.seen.len() {
            let largest_impulses =
                largest_impulses(self.scenario, self.settings, self.validation, part)?;
            self.seen.push(largest_impulses);
        }
        Some(counts(self.scenario, self.seen.get(part)?, settings.speed))
    }
}

fn drift(
    scenario: &Scenario,
    settings: &Settings,
    (setting, end): (Setting, f64),
    passing: &[Subject],
    shots: &mut dyn Shots,
    cancel: &Cancel,
) -> Drift {
    let start = setting.of(settings);
    let at = |fraction: f64| start * (1.0 - fraction) + end * fraction;
    let mut turn = |fraction: f64| {
        if cancel.is_set() {
            return None;
        }
        turned(
            scenario,
            &setting.with(settings, at(fraction)),
            passing,
            shots,
        )
    };
    if start == end {
        return Drift {
            to: end,
            within: 0.0,
            turns: None,
        };
    }
    let mut good = 0.0;
    let mut bad = None;
    for step in (0..=DOUBLINGS).rev() {
        let fraction = whole_power(0.5, step);
        match turn(fraction) {
            Some(turn) => {
                bad = Some((fraction, turn));
                break;
            }
            None => good = fraction,
        }
    }
    let Some((mut beyond, mut turns)) = bad else {
        return Drift {
            to: end,
            within: 0.0,
            turns: None,
        };
    };
    for _ in 0..HALVINGS {
        let middle = 0.5 * (good + beyond);
        match turn(middle) {
            Some(turn) => (beyond, turns) = (middle, turn),
            None => good = middle,
        }
    }
    Drift {
        to: at(good),
        within: (at(beyond) - at(good)).abs(),
        turns: Some(turns),
    }
}

/// The verdict that changes at some settings: the one with the highest utilisation, on no more
/// shots than it takes to tell.
fn turned(
    scenario: &Scenario,
    settings: &Settings,
    passing: &[Subject],
    shots: &mut dyn Shots,
) -> Option<Turn> {
    if let Some(infeasible) = infeasibility(scenario, settings) {
        return Some(match infeasible.obstacle {
            Obstacle::Surface(_) => Turn::Clearance,
            Obstacle::Material(_) | Obstacle::Body => Turn::FreeSpace,
        });
    }
    let mut all = ViolationCounts::none(scenario);
    let mut turn = None;
    for part in 0.. {
        let Some(counts) = shots.counts(settings, part) else {
            break;
        };
        all = all.plus(&counts);
        let verdicts: Vec<Verdict> = Verdict::on(scenario, &all)
            .into_iter()
            .filter(|verdict| passing.contains(&verdict.subject))
            .collect();
        let failing = verdicts.iter().filter(|verdict| !verdict.passes());
        let worst = failing.max_by(|a, b| a.utilisation().total_cmp(&b.utilisation()));
        turn = worst.map(|verdict| Turn::Verdict(verdict.subject));
        let is_clear = match worst {
            Some(worst) => worst.is_beyond_doubt(),
            None => verdicts.iter().all(Verdict::is_beyond_doubt),
        };
        if is_clear {
            break;
        }
    }
    turn
}
