//! How well J of one pose is known after how much time: by shots, sampling and walls.

use std::borrow::Cow;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::leaks::Leaks;
use super::plan::Plan;
use super::sampling::Sampling;
use super::timing;
use crate::control::Clock;
use crate::elementary::square;
use crate::jet::{Replicates, ShotSample, purpose};
use crate::objective::{Sums, Tally};
use crate::problem::fault::Fault;
use crate::problem::part::Shape;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::scene;

/// One way to compute J, with more and more shots.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PoseCurve {
    /// How the shots are drawn.
    pub sampling: Sampling,
    /// What they are traced against.
    pub walls: Walls,
    /// Triangles of the scene; they stand in for exact walls only where distances are measured.
    pub triangles: usize,
    /// By how much J is above that of the first way on the same shots, relative to it: what more
    /// shots do not cure.
    pub bias: f64,
    /// Standard error of that.
    pub bias_standard_error: f64,
    /// Rays at edges of the mesh that were lost, for shots that fly as points; absent for others.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub leaks: Option<Leaks>,
    /// By the number of shots.
    pub points: Vec<PosePoint>,
}

/// One number of shots.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PosePoint {
    /// Shots.
    pub shots: usize,
    /// Time that J takes on one thread, with shots drawn before, s: from a median of repeats.
    pub seconds: f64,
    /// Root mean square of (J - reference) / reference over many samples of this size.
    pub error: f64,
}

/// What shots are traced against.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Walls {
    /// Planes and cylinders, where parts are not meshes.
    Exact,
    /// The triangles of mesh files.
    Mesh,
    /// Triangles instead of planes and cylinders.
    Facets {
        /// Angle by which their chords turn at most, deg.
        chord_angle_deg: f64,
    },
    /// Triangles, for shots that fly as points.
    Points,
    /// The same, with rays cast by parry.
    Parry,
}

/// Chord angles of the meshes that exact walls are compared with, deg.
const CHORD_ANGLES: [f64; 3] = [4.0, 1.0, 0.25];
/// The same of the mesh at which both engines cast rays of points, deg.
const POINTS_CHORD_ANGLE: f64 = 1.0;
/// Fewest shots, and by how much they rise from point to point.
const FEWEST_SHOTS: usize = 16;
const RISE: usize = 4;

/// Shots in a slice of a longer time.
const TIMED_SHOTS: usize = 4096;

/// Every way to compute J; those that were reached when a request to end came.
pub(super) fn curves(
    scenario: &Scenario,
    settings: &Settings,
    reference: f64,
    plan: &Plan,
) -> Result<Vec<PoseCurve>, Vec<Fault>> {
    let ways = ways(scenario, settings)?;
    let mut curves = Vec::new();
    for (number, sampling) in Sampling::ALL.into_iter().enumerate() {
        if plan.is_stopped() {
            break;
        }
        plan.tell("J of a pose", number, Sampling::ALL.len());
        curves.extend(curves_of(sampling, &ways, reference, plan));
    }
    Ok(curves)
}

/// One way to trace shots.
struct Way<'a> {
    walls: Walls,
    scenario: Cow<'a, Scenario>,
    settings: &'a Settings,
    leaks: Option<Leaks>,
}

/// All of them; the first is the one that the search uses.
fn ways<'a>(scenario: &'a Scenario, settings: &'a Settings) -> Result<Vec<Way<'a>>, Vec<Fault>> {
    let mut ways = Vec::new();
    for walls in models(scenario) {
        let scenario = built(scenario, walls)?;
        let are_points = matches!(walls, Walls::Points | Walls::Parry);
        ways.push(Way {
            walls,
            leaks: are_points.then(|| Leaks::of(&scenario, settings)),
            scenario,
            settings,
        });
    }
    Ok(ways)
}

/// The walls worth comparing: where every part is a mesh there is nothing but the meshes.
fn models(scenario: &Scenario) -> Vec<Walls> {
    let is_mesh = |shape: &Shape| matches!(shape, Shape::Mesh { .. });
    if scenario
        .problem
        .parts
        .iter()
        .all(|part| is_mesh(&part.shape))
    {
        return vec![Walls::Mesh, Walls::Points, Walls::Parry];
    }
    let facets = |chord_angle_deg| Walls::Facets { chord_angle_deg };
    std::iter::once(Walls::Exact)
        .chain(CHORD_ANGLES.map(facets))
        .chain([Walls::Points, Walls::Parry])
        .collect()
}

fn built(scenario: &Scenario, walls: Walls) -> Result<Cow<'_, Scenario>, Vec<Fault>> {
    let chord_angle = match walls {
        Walls::Exact | Walls::Mesh => return Ok(Cow::Borrowed(scenario)),
        Walls::Facets { chord_angle_deg } => chord_angle_deg.to_radians(),
        Walls::Points | Walls::Parry => POINTS_CHORD_ANGLE.to_radians(),
    };
    let mut problem = scenario.problem.clone();
    problem.paths.shot_size &= !matches!(walls, Walls::Points | Walls::Parry);
    let walls = match walls {
        Walls::Parry => scene::Walls::Parry { chord_angle },
        _ => scene::Walls::TriangleMesh { chord_angle },
    };
    Scenario::new(problem, walls).map(Cow::Owned)
}

/// What one set of shots tells about one way.
struct Outcome {
    /// Mean squares of the relative error of J over all blocks of each size.
    mean_squares: Vec<f64>,
    /// J on all shots of the set.
    objective: f64,
}

fn curves_of(sampling: Sampling, ways: &[Way], reference: f64, plan: &Plan) -> Vec<PoseCurve> {
    let rising = std::iter::successors(Some(FEWEST_SHOTS), |shots| Some(shots * RISE));
    let sizes: Vec<usize> = rising
        .take_while(|&shots| shots <= plan.most_shots.max(FEWEST_SHOTS))
        .collect();
    let draw = |number: usize| {
        let stream = Replicates::stream(purpose::CHART_SCATTER, number as u32);
        sampling.draw(&ways[0].scenario.problem, stream, sizes[sizes.len() - 1])
    };
    let sets: Vec<Vec<Outcome>> = (0..plan.replicates)
        .into_par_iter()
        .map(|number| {
            let samples = draw(number);
            let outcome = |way: &Way| way.outcome(&samples.shots, sizes.len(), reference);
            ways.iter().map(outcome).collect()
        })
        .collect();
    let samples = draw(0);
    let curve = |(index, way): (usize, &Way)| {
        let biases = sets
            .iter()
            .map(|set| set[index].objective / set[0].objective - 1.0);
        let (bias, bias_standard_error) = mean(biases);
        let points = sizes.iter().enumerate().map(|(level, &shots)| {
            let squares = sets.iter().map(|set| set[index].mean_squares[level]);
            PosePoint {
                shots,
                seconds: way.seconds(
                    &plan.control.clock,
                    &samples.shots[..shots.min(samples.shots.len())],
                ),
                error: mean(squares).0.sqrt(),
            }
        });
        PoseCurve {
            sampling,
            walls: way.walls,
            triangles: way.scenario.scene.triangles(),
            bias,
            bias_standard_error,
            leaks: way.leaks,
            points: points.collect(),
        }
    };
    ways.iter().enumerate().map(curve).collect()
}

impl Way<'_> {
    /// Every aligned block of Sobol points is as good as the first one, so that a set of many shots
    /// holds many blocks of few: enough of them to meet rare violations as often as it happens.
    fn outcome(&self, shots: &[ShotSample], levels: usize, reference: f64) -> Outcome {
        let objective = |sums: &Sums| sums.terms(&self.scenario.problem.goals).total();
        let together = |blocks: &[Sums]| {
            blocks
                .iter()
                .fold(Sums::default(), |total, block| total.plus(block))
        };
        let mut blocks: Vec<Sums> = shots
            .chunks(FEWEST_SHOTS)
            .map(|block| self.sums(block))
            .collect();
        let mut mean_squares = Vec::new();
        for _ in 0..levels {
            let squares = blocks
                .iter()
                .map(|block| square(objective(block) / reference - 1.0));
            mean_squares.push(mean(squares).0);
            blocks = blocks.chunks(RISE).map(together).collect();
        }
        Outcome {
            mean_squares,
            objective: objective(&together(&blocks)),
        }
    }

    fn seconds(&self, clock: &Clock, shots: &[ShotSample]) -> f64 {
        let slices: Vec<&[ShotSample]> = shots.chunks(TIMED_SHOTS).collect();
        timing::seconds(clock, &slices, |slice| {
            self.sums(slice).terms(&self.scenario.problem.goals)
        })
    }

    fn sums(&self, shots: &[ShotSample]) -> Sums {
        let tally = Tally::trace(&self.scenario, self.settings, self.settings.speed, shots);
        tally.sums(&self.scenario.problem.goals, self.settings.speed)
    }
}

/// Mean and its standard error, 0 for a single value.
fn mean(values: impl ExactSizeIterator<Item = f64> + Clone) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.clone().sum::<f64>() / count;
    let squares: f64 = values.map(|value| square(value - mean)).sum();
    (mean, (squares / (count * (count - 1.0).max(1.0))).sqrt())
}
