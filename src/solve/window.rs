//! How far each setting may drift alone before a verdict turns.

use rayon::prelude::*;

use super::Solution;
use super::judge::clearance_violation;
use crate::evaluate::Counts;
use crate::jet::{Replicates, purpose};
use crate::problem::setting::{Choice, Range, Setting};
use crate::setup::Setup;
use crate::verdict::{Subject, Verdict};

/// The window of one setting round a choice.
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
    /// The last value at which no verdict has turned, SI.
    pub to: f64,
    /// Width of the interval in which the turn lies, SI; 0 when none turned.
    pub within: f64,
    /// What turns beyond.
    pub turns: Option<Turn>,
}

/// What ends a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Turn {
    /// A verdict that passed fails.
    Verdict(Subject),
    /// The nozzle comes too near to the part.
    Clearance,
}

/// Halvings of the interval in which a verdict turns.
const HALVINGS: usize = 6;
/// Steps of doubling length from the choice outwards.
const DOUBLINGS: i32 = 5;

/// The windows round the best answer, for the verdicts that it passes; none without a pose that fits.
pub fn passing_windows(setup: &Setup, solution: &Solution) -> Vec<Window> {
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
    let fresh = Replicates::without_rim(&setup.problem, purpose::WINDOWS, WINDOW_SHOTS);
    windows(setup, &best.choice, &passing, &fresh)
}

/// Shots behind each verdict of a window at most.
const WINDOW_SHOTS: usize = 4096;

/// The windows of all settings that have a range, each as far as its range goes.
pub fn windows(
    setup: &Setup,
    choice: &Choice,
    passing: &[Subject],
    fresh: &Replicates,
) -> Vec<Window> {
    let settings = Setting::OF_THE_NOZZLE.into_iter().filter_map(|setting| {
        let range = setup.problem.settings.range(setting)?;
        (!range.is_held()).then_some((setting, range))
    });
    let sides: Vec<(Setting, f64)> = settings
        .flat_map(|(setting, Range { min, max })| [(setting, min), (setting, max)])
        .collect();
    let drifts: Vec<Drift> = sides
        .par_iter()
        .map(|&(setting, end)| drift(setup, choice, setting, end, passing, fresh))
        .collect();
    sides
        .chunks_exact(2)
        .zip(drifts.chunks_exact(2))
        .map(|(side, drift)| Window {
            setting: side[0].0,
            down: drift[0],
            up: drift[1],
        })
        .collect()
}

fn drift(
    setup: &Setup,
    choice: &Choice,
    setting: Setting,
    end: f64,
    passing: &[Subject],
    fresh: &Replicates,
) -> Drift {
    let start = setting.of(choice);
    let at = |fraction: f64| start * (1.0 - fraction) + end * fraction;
    let turn = |fraction: f64| turned(setup, &setting.with(choice, at(fraction)), passing, fresh);
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
        let fraction = 0.5_f64.powi(step);
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

/// What turns at a choice among the verdicts that passed: the one that is exceeded most, on no more
/// shots than it takes to tell.
fn turned(setup: &Setup, choice: &Choice, passing: &[Subject], fresh: &Replicates) -> Option<Turn> {
    if clearance_violation(setup, choice).is_some() {
        return Some(Turn::Clearance);
    }
    let mut counts = Counts::none(setup);
    let mut turn = None;
    for sets in fresh.sets.chunks(SETS) {
        counts = counts.plus(&Counts::on(setup, choice, sets));
        let verdicts: Vec<Verdict> = Verdict::on(setup, &counts)
            .into_iter()
            .filter(|verdict| passing.contains(&verdict.subject))
            .collect();
        let failing = verdicts.iter().filter(|verdict| !verdict.passes());
        let worst = failing.max_by(|a, b| a.load().total_cmp(&b.load()));
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

/// Scramblings that are fired together.
const SETS: usize = 8;
