//! Verdicts at the stations of a stroke, where the nozzle stands still.

use rayon::prelude::*;

use super::Verdict;
use crate::evaluate::{LargestImpulses, ViolationCounts};
use crate::jet::{Draw, Replicate, purpose};
use crate::problem::Problem;
use crate::problem::setting::Settings;
use crate::scenario::{Scenario, Station};

/// The verdicts at one station.
#[derive(Clone, Debug, PartialEq)]
pub struct StationVerdicts {
    /// -0.5 at the beginning of the stroke, 0.5 at its end.
    pub place: f64,
    /// One for each goal and each secondary surface.
    pub verdicts: Vec<Verdict>,
}

/// Shots at a station at most.
const SHOTS: usize = 16_384;
/// Replicates that are fired together, until they decide every verdict.
const SETS: u32 = 4;

/// A station of which more shots may still turn a verdict.
struct Open<'a> {
    station: &'a Station,
    counts: ViolationCounts,
    verdicts: Vec<Verdict>,
}

impl StationVerdicts {
    /// The verdicts at every station of a stroke; none for a spot.
    pub fn all(scenario: &Scenario, settings: &Settings) -> Vec<Self> {
        let stations: Vec<&Station> = scenario.stations.iter().collect();
        Self::at(&stations, &scenario.problem, settings)
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
        Self {
            station,
            counts: ViolationCounts::none(&station.scenario),
            verdicts: Vec::new(),
        }
    }

    fn is_decided(&self) -> bool {
        !self.verdicts.is_empty() && self.verdicts.iter().all(Verdict::is_beyond_doubt)
    }

    fn fire(&mut self, settings: &Settings, sets: &[Replicate]) {
        let scenario = &self.station.scenario;
        for set in sets {
            let impulses = LargestImpulses::of(scenario, settings, &set.jet.shots);
            let counts = impulses.counts(scenario, settings.speed);
            self.counts = self.counts.plus(&counts);
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
