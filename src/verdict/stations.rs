//! Verdicts at the stations of a stroke, where the nozzle stands still.

use rayon::prelude::*;

use super::Verdict;
use crate::evaluate::{LargestImpulses, ViolationCounts};
use crate::jet::{Draw, Replicate, purpose};
use crate::problem::Problem;
use crate::problem::setting::Settings;
use crate::problem::stroke::WHOLE;
use crate::scenario::{Scenario, Station};

/// The verdicts at one station.
#[derive(Clone, Debug, PartialEq)]
pub struct StationVerdicts {
    /// -0.5 at the beginning of the stroke, 0.5 at its end.
    pub place: f64,
    /// One for each goal and each secondary surface.
    pub verdicts: Vec<Verdict>,
    /// Rays traced to tell them.
    pub rays: usize,
}

/// Shots at a station at most.
const SHOTS: usize = 16_384;
/// Replicates that are fired together, until they decide every verdict.
const SETS: u32 = 4;

/// How often the way between two stations is halved where a verdict turns between them.
const HALVINGS: usize = 2;
/// A verdict that uses up so much of what is allowed may fail between two stations at which it passes.
const NEAR: f64 = 0.5;

/// The places between neighbours of which a verdict passes at one and fails at the other, and on either side of where a
/// verdict that passes is used up most.
fn doubtful(found: &[StationVerdicts]) -> Vec<f64> {
    let within = |station: &&StationVerdicts| station.place.abs() <= WHOLE[1];
    let within: Vec<&StationVerdicts> = found.iter().filter(within).collect();
    let subjects = within.first().map_or(0, |first| first.verdicts.len());
    let mut is_doubtful = vec![false; within.len().saturating_sub(1)];
    for subject in 0..subjects {
        let at = |station: usize| &within[station].verdicts[subject];
        for (gap, doubt) in is_doubtful.iter_mut().enumerate() {
            *doubt |= at(gap).passes() != at(gap + 1).passes();
        }
        let worst = (0..within.len()).reduce(|worst, it| match at(it).is_worse_than(at(worst)) {
            true => it,
            false => worst,
        });
        if let Some(worst) = worst.filter(|&it| at(it).passes() && at(it).violation() > NEAR) {
            for gap in worst.saturating_sub(1)..=worst {
                if let Some(doubt) = is_doubtful.get_mut(gap) {
                    *doubt = true;
                }
            }
        }
    }
    let gaps = is_doubtful.iter().zip(within.windows(2));
    let open = gaps.filter(|(doubt, _)| **doubt);
    open.map(|(_, pair)| 0.5 * (pair[0].place + pair[1].place))
        .collect()
}

/// A station of which more shots may still turn a verdict.
struct Open<'a> {
    station: &'a Station,
    counts: ViolationCounts,
    verdicts: Vec<Verdict>,
    rays: usize,
}

impl StationVerdicts {
    /// The verdicts at every station of a stroke, and between those where one turns or nearly does; none for a spot.
    pub fn all(scenario: &Scenario, settings: &Settings) -> Vec<Self> {
        let stations: Vec<&Station> = scenario.stations.iter().collect();
        let mut found = Self::at(&stations, &scenario.problem, settings);
        for _ in 0..HALVINGS {
            found.sort_by(|a, b| a.place.total_cmp(&b.place));
            let added: Vec<Station> = doubtful(&found)
                .into_iter()
                .map(|place| scenario.station(place))
                .collect();
            let added: Vec<&Station> = added.iter().collect();
            found.extend(Self::at(&added, &scenario.problem, settings));
        }
        found.sort_by(|a, b| a.place.total_cmp(&b.place));
        found
    }

    /// The verdicts at some stations of a problem, on the same shots.
    pub fn at(stations: &[&Station], problem: &Problem, settings: &Settings) -> Vec<Self> {
        let mut all: Vec<Open> = stations.iter().copied().map(Open::new).collect();
        let draw = Draw::new(problem, purpose::ANSWERS, SHOTS).without_boundary();
        for first in (0..draw.sets()).step_by(SETS as usize) {
            if all.iter().all(Open::is_decided) {
                break;
            }
            let numbers = first..draw.sets().min(first + SETS);
            let sets: Vec<Replicate> = numbers.into_par_iter().map(|it| draw.set(it)).collect();
            let open = all.par_iter_mut().filter(|it| !it.is_decided());
            open.for_each(|it| it.fire(settings, &sets));
        }
        all.into_iter().map(Open::close).collect()
    }
}

impl<'a> Open<'a> {
    fn new(station: &'a Station) -> Self {
        let counts = ViolationCounts::none(&station.scenario);
        Self {
            station,
            verdicts: Verdict::on(&station.scenario, &counts),
            counts,
            rays: 0,
        }
    }

    fn is_decided(&self) -> bool {
        // Where nothing is asked, as in a run-out without limits beside it, no shot tells anything.
        let is_fired_at = self.counts.shots > 0;
        let decides = |verdict: &Verdict| is_fired_at && verdict.is_beyond_doubt();
        self.verdicts.iter().all(decides)
    }

    fn fire(&mut self, settings: &Settings, sets: &[Replicate]) {
        let scenario = &self.station.scenario;
        for set in sets {
            let impulses = LargestImpulses::of(scenario, settings, &set.jet.shots);
            let counts = impulses.counts(scenario, settings.speed);
            self.counts = self.counts.plus(&counts);
            self.rays += impulses.rays();
        }
        self.verdicts = Verdict::on(scenario, &self.counts);
    }

    fn close(self) -> StationVerdicts {
        let place = self.station.place;
        let verdicts = self.verdicts.into_iter().map(|verdict| Verdict {
            place: Some(place),
            ..verdict
        });
        StationVerdicts {
            place,
            verdicts: verdicts.collect(),
            rays: self.rays,
        }
    }
}

impl StationVerdicts {
    /// The verdicts on a whole stroke, each at its worst station where that is worse than the whole.
    pub fn worst(whole: Vec<Verdict>, stations: &[Self]) -> Vec<Verdict> {
        let worst = |verdict: Verdict| {
            let of_stations = stations.iter().flat_map(|station| &station.verdicts);
            let same = of_stations.filter(|it| it.subject == verdict.subject);
            same.fold(verdict, |worst, other| {
                if other.is_worse_than(&worst) {
                    *other
                } else {
                    worst
                }
            })
        };
        whole.into_iter().map(worst).collect()
    }
}
