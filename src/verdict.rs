//! Whether settings pass: one verdict for each goal and each secondary surface.

mod interval;
mod share_estimate;
mod stations;

pub(crate) use share_estimate::{Asked, ShareEstimate};
pub use stations::StationVerdicts;

use serde::{Deserialize, Serialize};

use crate::evaluate::{Evaluation, ViolationCounts};
use crate::feasibility::{Infeasible, gap_within_tolerance};
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use interval::Count;

/// What a verdict is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Subject {
    /// N* of first hits on target.
    NormalImpulse,
    /// f* of first hits on target.
    TangentialImpulse,
    /// First hits off the target.
    Miss,
    /// Impacts on one surface of the scene.
    Surface(u32),
    /// The distance of the nozzle from every surface, at the worst pose within the tolerance.
    Clearance,
    /// The side of every surface on which the nozzle and its line of fire are.
    FreeSpace,
}

/// The share of shots that break a goal, against what is allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    /// What it is about.
    pub subject: Subject,
    /// Shots that break the goal.
    pub broken: usize,
    /// Shots that were counted.
    pub counted: usize,
    /// Share that may break it.
    pub allowed: f64,
    /// Whether all shots are the same, so that the share has no error.
    pub is_exact: bool,
    /// The place of the station that it is about, -0.5 to 0.5; absent for a spot, and for a stroke as a whole.
    pub place: Option<f64>,
}

/// Of what shots do, and which share of them may: the goals, then every surface that has a limit. In the run-out of a
/// stroke the goals of the target do not count.
pub(crate) fn allowed_shares(scenario: &Scenario) -> impl Iterator<Item = (Subject, f64)> {
    let goals = &scenario.problem.goals;
    let tangential = goals.tangential_impulse;
    let of_target = [
        Some((Subject::Miss, goals.miss.share)),
        Some((Subject::NormalImpulse, goals.normal_impulse.share)),
        tangential.map(|goal| (Subject::TangentialImpulse, goal.share)),
    ];
    let counts = !scenario.in_run_out;
    let of_target = of_target.into_iter().flatten().filter(move |_| counts);
    let surfaces = scenario.surfaces.iter().enumerate();
    let limited = surfaces.filter(|(_, limits)| limits.allow.is_some() && !limits.deflector);
    of_target.chain(limited.map(|(index, limits)| (Subject::Surface(index as u32), limits.share)))
}

impl Verdict {
    /// All verdicts on an evaluation: the goals, then every surface that has a limit.
    pub fn all(scenario: &Scenario, evaluation: &Evaluation) -> Vec<Self> {
        Self::on(scenario, &ViolationCounts::of(evaluation))
    }

    /// The same on what was counted.
    pub fn on(scenario: &Scenario, counts: &ViolationCounts) -> Vec<Self> {
        let verdict = |(subject, allowed)| {
            let (broken, counted) = match subject {
                Subject::NormalImpulse => (counts.off_target, counts.hits),
                Subject::TangentialImpulse => (counts.over_limit, counts.hits),
                Subject::Surface(index) => (counts.over[index as usize], counts.shots),
                _ => (counts.shots - counts.hits, counts.shots),
            };
            Self {
                subject,
                broken,
                counted,
                allowed,
                is_exact: counts.is_exact,
                place: None,
            }
        };
        allowed_shares(scenario).map(verdict).collect()
    }

    /// The verdicts on the nozzle, from why its settings are infeasible, if they are: one that is inside the
    /// material may be too near to its walls as well.
    pub fn of_pose(
        scenario: &Scenario,
        settings: &Settings,
        infeasible: Option<&Infeasible>,
    ) -> [Self; 2] {
        let is_near = |it: &Infeasible| it.obstacle.is_near_wall();
        let clearance = scenario.problem.nozzle.clearance;
        let is_nearer =
            || gap_within_tolerance(scenario, settings).is_some_and(|gap| gap.distance < clearance);
        let too_near = infeasible.is_some_and(|it| is_near(it) || is_nearer());
        let is_hidden = infeasible.is_some_and(|it| !is_near(it));
        let verdict = |subject, is_broken| Self {
            subject,
            broken: usize::from(is_broken),
            counted: 1,
            allowed: 0.0,
            is_exact: true,
            place: None,
        };
        [
            verdict(Subject::Clearance, too_near),
            verdict(Subject::FreeSpace, is_hidden),
        ]
    }

    /// Share of the counted shots that break the goal; 0 when none was counted.
    pub fn share(&self) -> f64 {
        self.broken as f64 / self.counted.max(1) as f64
    }

    /// Whether the share is allowed. With nothing to count a goal of the target is not met.
    pub fn passes(&self) -> bool {
        self.counted > 0 && self.share() <= self.allowed
    }

    /// What is left of the allowed share; negative when it is exceeded.
    pub fn margin(&self) -> f64 {
        self.allowed - self.share()
    }

    /// 95 % interval of the share: of the binomial distribution (mid-P); 0 to 3/n where no shot broke
    /// the goal.
    pub fn interval(&self) -> [f64; 2] {
        if self.is_exact {
            return [self.share(); 2];
        }
        self.count().interval_95()
    }

    fn count(&self) -> Count {
        Count {
            broken: self.broken,
            counted: self.counted,
        }
    }

    /// Standard error of the share, relative to it; 0 where no shot breaks the goal.
    pub(crate) fn relative_error(&self) -> f64 {
        if self.is_exact || self.broken == 0 {
            return 0.0;
        }
        ((1.0 - self.share()) / self.broken as f64).sqrt()
    }

    /// Whether the interval lies on one side of what is allowed.
    pub fn is_certain(&self) -> bool {
        let [low, high] = self.interval();
        high <= self.allowed || low > self.allowed
    }

    /// Whether more shots of the same kind would not turn it: they had to be three standard errors off.
    pub fn is_beyond_doubt(&self) -> bool {
        self.is_exact || self.count().is_far_from(self.allowed)
    }

    /// The share over what is allowed, finite: above 1 where it fails.
    pub fn violation(&self) -> f64 {
        match (self.passes(), self.allowed > 0.0) {
            (true, false) => 0.0,
            (_, true) if self.counted > 0 => self.utilisation(),
            (_, true) => 1.0 / self.allowed,
            (false, false) => 1.0 + self.broken.max(1) as f64,
        }
    }

    /// The largest of some verdicts' violations.
    pub fn largest_violation(verdicts: &[Self]) -> f64 {
        verdicts.iter().map(Self::violation).fold(0.0, f64::max)
    }

    /// Whether it violates more than another on the same subject.
    pub fn is_worse_than(&self, other: &Self) -> bool {
        (self.violation(), self.share()) > (other.violation(), other.share())
    }

    /// How much of the allowed share is used up: 1 is the limit.
    pub fn utilisation(&self) -> f64 {
        if self.allowed > 0.0 {
            self.share() / self.allowed
        } else if self.broken > 0 {
            f64::INFINITY
        } else {
            0.0
        }
    }
}
