//! Tolerance windows: how far each setting may drift alone before a verdict changes.

use rayon::prelude::*;

use super::answer::Answer;
use crate::control::Cancel;
use crate::elementary::whole_power;
use crate::evaluate::{LargestImpulses, ViolationCounts};
use crate::feasibility::infeasibility;
use crate::jet::{Replicate, Replicates, purpose};
use crate::problem::setting::{Range, Setting, Settings};
use crate::scenario::{Scenario, Station};
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
pub fn passing_windows(scenario: &Scenario, best: &Answer, cancel: &Cancel) -> Vec<Window> {
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
    // Of a stroke, where it fails first: at its ends, in its middle, and where a verdict is the worst.
    let mut places = scenario.ends_and_middle();
    places.extend(best.verdicts.iter().filter_map(|it| it.place));
    places.sort_by(f64::total_cmp);
    places.dedup();
    let stations: Vec<Station> = places
        .iter()
        .map(|&place| scenario.station(place))
        .collect();
    let mut standing: Vec<&Scenario> = stations.iter().map(|it| &it.scenario).collect();
    if standing.is_empty() {
        standing.push(scenario);
    }
    let asked = Asked {
        scenario,
        standing,
        passing: &passing,
        cancel,
    };
    asked.windows(&best.settings, &validation)
}

/// What windows are asked of.
struct Asked<'a> {
    scenario: &'a Scenario,
    /// A spot itself, or some stations of a stroke: a verdict turns where it turns at one of them.
    standing: Vec<&'a Scenario>,
    /// Verdicts that pass.
    passing: &'a [Subject],
    cancel: &'a Cancel,
}

/// Shots behind each verdict of a window at most.
const WINDOW_SHOTS: usize = 4096;

/// The windows of all settings that have a range, each as far as its range goes; of a stroke as a whole.
pub fn windows(
    scenario: &Scenario,
    settings: &Settings,
    passing: &[Subject],
    validation: &Replicates,
    cancel: &Cancel,
) -> Vec<Window> {
    let asked = Asked {
        scenario,
        standing: vec![scenario],
        passing,
        cancel,
    };
    asked.windows(settings, validation)
}

impl Asked<'_> {
    fn windows(&self, settings: &Settings, validation: &Replicates) -> Vec<Window> {
        let ranges: Vec<(Setting, Range)> = Setting::OF_THE_NOZZLE
            .into_iter()
            .filter_map(|setting| Some((setting, self.scenario.problem.ranges.range(setting)?)))
            .filter(|(_, range)| !range.is_held())
            .collect();
        let shares_paths = self.scenario.speed_scales_out(settings.contact);
        let window = |&(setting, Range { min, max }): &(Setting, Range)| {
            // A window that is cut short says nothing.
            let drift =
                |end: f64, shots: &mut dyn Shots| self.drift(settings, (setting, end), shots);
            let standing = &self.standing;
            let (down, up) = if setting == Setting::Speed && shares_paths {
                let mut shots = Recorded::of(standing, settings, validation);
                (drift(min, &mut shots), drift(max, &mut shots))
            } else {
                let traced = || Traced {
                    standing,
                    validation,
                };
                rayon::join(|| drift(min, &mut traced()), || drift(max, &mut traced()))
            };
            (!self.cancel.is_set()).then_some(Window { setting, down, up })
        };
        ranges.par_iter().filter_map(window).collect()
    }
}

/// Shots that show which verdicts would change, replicate by replicate.
trait Shots {
    /// What some of them do, at each station; `None` beyond the last.
    fn counts(&mut self, settings: &Settings, part: usize) -> Option<Vec<ViolationCounts>>;
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
    standing: &'a [&'a Scenario],
    validation: &'a Replicates,
}

impl Shots for Traced<'_> {
    fn counts(&mut self, settings: &Settings, part: usize) -> Option<Vec<ViolationCounts>> {
        let at = |scenario: &&Scenario| {
            let largest_impulses = largest_impulses(scenario, settings, self.validation, part)?;
            Some(counts(scenario, &largest_impulses, settings.speed))
        };
        self.standing.iter().map(at).collect()
    }
}

/// Shots at settings that differ in the speed only, on which their paths do not depend.
struct Recorded<'a> {
    standing: &'a [&'a Scenario],
    settings: &'a Settings,
    validation: &'a Replicates,
    /// Those that were asked for, of each station.
    seen: Vec<Vec<Vec<LargestImpulses>>>,
}

impl<'a> Recorded<'a> {
    fn of(
        standing: &'a [&'a Scenario],
        settings: &'a Settings,
        validation: &'a Replicates,
    ) -> Self {
        Self {
            standing,
            settings,
            validation,
            seen: Vec::new(),
        }
    }
}

impl Shots for Recorded<'_> {
    fn counts(&mut self, settings: &Settings, part: usize) -> Option<Vec<ViolationCounts>> {
        if part == self.seen.len() {
            let at = |scenario: &&Scenario| {
                largest_impulses(scenario, self.settings, self.validation, part)
            };
            let of_all = self.standing.iter().map(at).collect::<Option<_>>()?;
            self.seen.push(of_all);
        }
        let pairs = self.standing.iter().zip(self.seen.get(part)?);
        let counts = pairs.map(|(scenario, impulses)| counts(scenario, impulses, settings.speed));
        Some(counts.collect())
    }
}

impl Asked<'_> {
    fn drift(
        &self,
        settings: &Settings,
        (setting, end): (Setting, f64),
        shots: &mut dyn Shots,
    ) -> Drift {
        let start = setting.of(settings);
        let at = |fraction: f64| start * (1.0 - fraction) + end * fraction;
        let mut turn = |fraction: f64| {
            if self.cancel.is_set() {
                return None;
            }
            self.turned(&setting.with(settings, at(fraction)), shots)
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
    fn turned(&self, settings: &Settings, shots: &mut dyn Shots) -> Option<Turn> {
        if let Some(infeasible) = infeasibility(self.scenario, settings) {
            return Some(match infeasible.obstacle.is_near_wall() {
                true => Turn::Clearance,
                false => Turn::FreeSpace,
            });
        }
        let none = || ViolationCounts::none(self.standing[0]);
        let mut all: Vec<ViolationCounts> = self.standing.iter().map(|_| none()).collect();
        let mut turn = None;
        for part in 0.. {
            let Some(counts) = shots.counts(settings, part) else {
                break;
            };
            let pairs = all.iter().zip(&counts);
            all = pairs.map(|(all, counts)| all.plus(counts)).collect();
            let each = self.standing.iter().zip(&all);
            let verdicts: Vec<Verdict> = each
                .flat_map(|(scenario, all)| Verdict::on(scenario, all))
                .filter(|verdict| self.passing.contains(&verdict.subject))
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
}
