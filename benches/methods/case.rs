//! The problems that methods are compared on, and the runs of all methods on the shots of one seed.

use std::error::Error;

use peenpose::problem::setting::{Range, Settings};
use peenpose::scenario::Scenario;

use crate::common::known::Known;
use crate::common::suite::{self, KnownBest};
use crate::common::variant::{Shots, Variant, allow_every_share, contact_named};
use crate::objective::{Limits, Objective, Speed, Step, shots};
use crate::{annealing, gradient, line, model, population, sampling, shipped, simplex, swarm};

/// A problem with its best settings known.
pub struct Case {
    pub name: &'static str,
    pub scenario: Scenario,
    pub known: Settings,
}

/// How a method went about one problem on the shots of one seed.
pub struct Run {
    pub speed: Speed,
    pub method: &'static str,
    pub seed: u64,
    pub steps: Vec<Step>,
    /// The least J that is known on these shots.
    pub reference: f64,
}

/// Goes on until the objective says that the run is over, or until it has settled.
struct Method {
    name: &'static str,
    run: fn(&Objective, u32),
}

const fn method(name: &'static str, run: fn(&Objective, u32)) -> Method {
    Method { name, run }
}

const METHODS: [Method; 14] = [
    method("Sobol 64 + Nelder-Mead (argmin)", simplex::screened),
    method("Nelder-Mead multistart (argmin)", simplex::multistart),
    method("Nelder-Mead once (argmin)", simplex::once),
    method("particle swarm (argmin)", swarm::particle_swarm),
    method(
        "simulated annealing (argmin)",
        annealing::simulated_annealing,
    ),
    method("L-BFGS multistart (argmin)", gradient::lbfgs),
    method("L-BFGS-B multistart (basin)", gradient::lbfgsb),
    method("CMA-ES with restarts (basin)", population::cma_es),
    method(
        "differential evolution (basin)",
        population::differential_evolution,
    ),
    method("BOBYQA multistart (basin)", model::bobyqa),
    method("COBYLA multistart (basin)", model::cobyla),
    method("DIRECT (basin)", sampling::direct),
    method("Sobol points alone", sampling::sobol),
    method("Brent (argmin)", line::brent),
];
/// Methods that need a single free setting.
const ON_A_LINE: [&str; 1] = ["Brent (argmin)"];

pub const SHIPPED: &str = "peenpose, 1024 shots at most";
pub const SHIPPED_WHOLE: &str = "peenpose, as shipped";

/// All problems, or those whose name contains `only`.
pub fn cases(known: &[Known], only: &str) -> Result<Vec<Case>, Box<dyn Error>> {
    let exact = |file| Variant {
        file,
        tolerance: false,
        shots: Shots::Points,
    };
    let whole = Variant {
        file: "keyway.yaml",
        tolerance: true,
        shots: Shots::Spheres,
    };
    let shipped = case("keyway as shipped, oiled", whole, "oiled", known)?;
    let short = case("keyway, oiled", exact("keyway.yaml"), "oiled", known)?;
    let long = case("long, damp", exact("keyway-long.yaml"), "damp", known)?;
    let mut line = case(
        "keyway, oiled, incidence only",
        exact("keyway.yaml"),
        "oiled",
        known,
    )?;
    let ranges = &mut line.scenario.problem.ranges;
    ranges.azimuth = Range::held(line.known.azimuth);
    ranges.standoff = Range::held(line.known.standoff);
    let mut cases = vec![short, long, line, shipped];
    let known = KnownBest::all()?;
    for name in HARD {
        cases.push(of_suite(name, &known)?);
    }
    cases.retain(|case| case.name.contains(only));
    Ok(cases)
}

/// Problems of the suite on which searches went wrong: regions apart, a needle, a lance in a bore that it nearly fills.
const HARD: [&str; 3] = ["bridge", "groove-wall", "lance-in-small-bore"];

fn of_suite(name: &'static str, known: &[KnownBest]) -> Result<Case, Box<dyn Error>> {
    let path = suite::problems().into_iter().find(|it| it.0 == name);
    let (_, path) = path.ok_or("no such problem in the suite")?;
    let best = known.iter().find(|it| it.problem == name);
    let known = best.ok_or("no best settings are known")?.settings;
    let (mut scenario, _) = Scenario::load(&path)?;
    allow_every_share(&mut scenario);
    let ranges = &mut scenario.problem.ranges;
    ranges.contact = vec![known.contact];
    let friction = &mut scenario.problem.contacts[known.contact].static_friction;
    *friction = Range::held(known.static_friction);
    Ok(Case {
        name,
        scenario,
        known,
    })
}

fn case(
    name: &'static str,
    variant: Variant,
    contact: &str,
    known: &[Known],
) -> Result<Case, Box<dyn Error>> {
    let mut scenario = variant.scenario()?;
    let index = contact_named(&scenario.problem, contact).ok_or("unknown contact")?;
    scenario.problem.ranges.contact = vec![index];
    let known = known
        .iter()
        .find(|known| known.is_of(&variant) && known.contact == contact)
        .ok_or("no best settings are known")?
        .settings(&scenario.problem)?;
    Ok(Case {
        name,
        scenario,
        known,
    })
}

/// Evaluations of the thorough run that finds the least J on the shots of a seed.
const THOROUGH: usize = 5000;
/// A run is over within this share of it.
const GOOD_ENOUGH: f64 = 0.001;

impl Case {
    /// All methods on the shots of one seed.
    pub fn runs(&self, seed: u64, budget: usize) -> Vec<Run> {
        let mut scenario = self.scenario.clone();
        scenario.problem.seed = seed;
        let shots = shots(&scenario);
        let limits = Limits {
            evaluations: THOROUGH,
            objective: 0.0,
        };
        let thorough = Objective::new(&scenario, Speed::Removed, &shots, limits);
        simplex::thorough(&thorough, 0);
        let steps = thorough.into_steps();
        let reference = steps.last().map_or(f64::INFINITY, |step| step.objective);
        let run = |speed, method, steps| Run {
            speed,
            method,
            seed,
            steps,
            reference,
        };
        let limits = Limits {
            evaluations: budget,
            objective: reference * (1.0 + GOOD_ENOUGH),
        };
        let mut runs = Vec::new();
        for speed in [Speed::Searched, Speed::Removed] {
            for method in &METHODS {
                let objective = Objective::new(&scenario, speed, &shots, limits);
                if objective.dimensions() == 1 || !ON_A_LINE.contains(&method.name) {
                    (method.run)(&objective, seed as u32);
                    runs.push(run(speed, method.name, objective.into_steps()));
                }
            }
        }
        let held = shipped::on_common_shots(&scenario, &shots);
        runs.push(run(Speed::Removed, SHIPPED, vec![held]));
        let whole = shipped::whole(&scenario, &shots);
        runs.push(run(Speed::Removed, SHIPPED_WHOLE, vec![whole]));
        runs
    }
}
