//! Whether the nozzle can be where settings put it: in free space, clear of every wall, and not in the way
//! of its own jet, for every pose within the setup tolerance.

mod between;
mod carried;
mod own_jet;
mod tolerance;

use nalgebra::Vector3;

use crate::jet::Pose;
use crate::problem::equipment::Body;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::scene::swept::{Core, Directions, Swept};
use between::infeasible_between;
pub use between::infeasible_on_way;
use carried::carried_meets;
use own_jet::through_own_body;

/// Why the nozzle cannot be where settings put it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Infeasible {
    /// By how much, m: the larger, the farther from a pose that is feasible.
    pub violation: f64,
    /// What is in the way.
    pub obstacle: Obstacle,
}

/// What is in the way of a nozzle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Obstacle {
    /// The exit is in the material of this part, or fires through a wall of it from behind.
    Material(usize),
    /// This surface is nearer than the clearance, at some pose within the tolerance.
    Surface(u32),
    /// The jet leaves through the nozzle's own body.
    Body,
    /// A part that moves with the nozzle meets this surface, at some pose within the tolerance.
    Carried(u32),
}

/// How near a nozzle comes to a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// m; negative where the body reaches into it.
    pub distance: f64,
    /// Index of the surface.
    pub surface: u32,
}

/// Why settings are infeasible; `None` where they are feasible.
///
/// Of a stroke it is the worst of its stations, or what is in the way between two of them.
pub fn infeasibility(scenario: &Scenario, settings: &Settings) -> Option<Infeasible> {
    if !is_straight(scenario) {
        return worst_standing(standing(scenario), settings)
            .or_else(|| infeasible_between(scenario, settings));
    }
    let beyond = standing(scenario).filter(|it| it.in_run_out);
    if let Some(infeasible) = worst_standing(beyond, settings) {
        return Some(infeasible);
    }
    let pose = Pose::new(&scenario.target.frame, settings);
    let clearance = scenario.problem.nozzle.clearance;
    if let Some(infeasible) = not_in_free_space(scenario, settings, &pose) {
        return Some(infeasible);
    }
    let room = room_for_errors(scenario, settings);
    if let Some(gap) = gap_as_set(scenario, settings, clearance + room)
        && gap.distance <= clearance + room
    {
        let is_near = |gap: &Gap| gap.distance < clearance;
        let obstacle = |gap: &Gap| Obstacle::Surface(gap.surface);
        if is_near(&gap) {
            return Some(Infeasible {
                violation: clearance - gap.distance + room,
                obstacle: obstacle(&gap),
            });
        }
        if room > 0.0
            && let Some(worst) = gap_swept(scenario, settings, clearance)
                .map(|swept| worst_of(gap, swept, room))
                .filter(is_near)
        {
            return Some(Infeasible {
                violation: clearance - worst.distance,
                obstacle: obstacle(&worst),
            });
        }
    }
    carried_meets(scenario, settings)
}

/// Whether what the nozzle sweeps is convex: of a spot, and of a stroke on which it moves straight on without turning.
fn is_straight(scenario: &Scenario) -> bool {
    scenario.stations.is_empty() || scenario.sweep.is_some()
}

/// Half the way of the nozzle, m; 0 for a spot.
fn half_way(scenario: &Scenario) -> Vector3<f64> {
    scenario.sweep.unwrap_or_default()
}

/// Of nozzles that stand still, the one that is infeasible most.
fn worst_standing<'a>(
    scenarios: impl Iterator<Item = &'a Scenario>,
    settings: &Settings,
) -> Option<Infeasible> {
    let each = scenarios.filter_map(|scenario| infeasibility(scenario, settings));
    each.max_by(|a, b| a.violation.total_cmp(&b.violation))
}

/// A stroke at each of its stations.
fn standing(scenario: &Scenario) -> impl Iterator<Item = &Scenario> {
    scenario.stations.iter().map(|station| &station.scenario)
}

/// Infeasible because of what no distance to a wall tells.
fn not_in_free_space(scenario: &Scenario, settings: &Settings, pose: &Pose) -> Option<Infeasible> {
    if scenario.sweep.is_some() {
        let each = standing(scenario).filter_map(|standing| {
            let pose = Pose::new(&standing.target.frame, settings);
            not_in_free_space(standing, settings, &pose)
        });
        return each.max_by(|a, b| a.violation.total_cmp(&b.violation));
    }
    in_material(scenario, settings, pose).or_else(|| through_own_body(scenario, settings, pose))
}

/// Infeasible because the exit is in material.
fn in_material(scenario: &Scenario, settings: &Settings, pose: &Pose) -> Option<Infeasible> {
    let part = scenario
        .scene
        .in_material(&pose.exit, &aim(pose, settings))?;
    let thickest = cores(scenario)
        .map(|(_, radius)| radius)
        .fold(0.0, f64::max);
    let depth = scenario.scene.distance_to_part(part, &pose.exit);
    let clearance = scenario.problem.nozzle.clearance;
    Some(Infeasible {
        violation: clearance + thickest + depth + room_for_errors(scenario, settings),
        obstacle: Obstacle::Material(part),
    })
}

/// How much nearer than the clearance the nozzle is to a wall as it is set, m; negative where it is farther off. In
/// material or in the way of its own jet it is the violation.
pub(crate) fn closeness(scenario: &Scenario, settings: &Settings) -> f64 {
    if !is_straight(scenario) {
        let each = standing(scenario).map(|scenario| closeness(scenario, settings));
        return each.fold(f64::NEG_INFINITY, f64::max);
    }
    let pose = Pose::new(&scenario.target.frame, settings);
    let infeasible =
        not_in_free_space(scenario, settings, &pose).or_else(|| carried_meets(scenario, settings));
    if let Some(infeasible) = infeasible {
        return infeasible.violation;
    }
    let gap = gap_as_set(scenario, settings, f64::INFINITY);
    scenario.problem.nozzle.clearance - gap.map_or(f64::MAX, |gap| gap.distance)
}

/// How near the nozzle comes to a surface as it is set; `None` in an empty scene.
pub fn gap(scenario: &Scenario, settings: &Settings) -> Option<Gap> {
    if !is_straight(scenario) {
        let each = standing(scenario).filter_map(|scenario| gap(scenario, settings));
        return each.min_by(|a, b| a.distance.total_cmp(&b.distance));
    }
    gap_as_set(scenario, settings, f64::INFINITY)
}

/// How near it comes with the worst errors within the setup tolerance: a bound from below that is closer
/// than the bulge of an arc over the angles' tolerance, 10 micrometres at 2 deg and 12 mm.
pub fn gap_within_tolerance(scenario: &Scenario, settings: &Settings) -> Option<Gap> {
    if !is_straight(scenario) {
        let each = standing(scenario).filter_map(|it| gap_within_tolerance(it, settings));
        return each.min_by(|a, b| a.distance.total_cmp(&b.distance));
    }
    let gap = gap(scenario, settings)?;
    if !scenario.problem.tolerance.moves_nozzle() {
        return Some(gap);
    }
    let swept = gap_swept(scenario, settings, f64::INFINITY)?;
    Some(worst_of(gap, swept, room_for_errors(scenario, settings)))
}

/// The gap with the worst errors: the body as set is one of all that is swept, and no point of it goes
/// farther than there is room for, which still tells poses apart where what is swept reaches into a wall.
fn worst_of(as_set: Gap, swept: Gap, room: f64) -> Gap {
    if as_set.distance <= swept.distance {
        return as_set;
    }
    Gap {
        distance: swept.distance.max(as_set.distance - room),
        ..swept
    }
}

/// The point at which the jet's axis is aimed, m.
fn aim(pose: &Pose, settings: &Settings) -> nalgebra::Point3<f64> {
    pose.exit + pose.direction * settings.standoff
}

/// What must not touch a wall, each with a radius round it, m: the nozzle's body, and the disc of an exit that is wider
/// than that; without a body the disc grown by the radius of a shot.
fn cores(scenario: &Scenario) -> impl Iterator<Item = (Core, f64)> + '_ {
    let problem = &scenario.problem;
    let bodies = problem.nozzle.body.iter().map(|body| match *body {
        Body::Ball { radius } => (Core::Exit, radius),
        Body::Capsule {
            length,
            radius,
            direction,
        } => (Core::Line { length, direction }, radius),
    });
    let disc = Core::Disc {
        radius: problem.jet.exit_diameter / 2.0,
    };
    let grown_by = match problem.nozzle.body.is_empty() {
        true => problem.shot.radius,
        false => 0.0,
    };
    let exit = is_exit_bare(scenario).then_some((disc, grown_by));
    bodies.chain(exit)
}

/// Whether the exit is wider than every piece of the body round it, or has none.
fn is_exit_bare(scenario: &Scenario) -> bool {
    let problem = &scenario.problem;
    let radii = problem.nozzle.body.iter().map(|body| match *body {
        Body::Ball { radius } | Body::Capsule { radius, .. } => radius,
    });
    radii.fold(0.0, f64::max) < problem.jet.exit_diameter / 2.0 || problem.nozzle.body.is_empty()
}

fn gap_as_set(scenario: &Scenario, settings: &Settings, limit: f64) -> Option<Gap> {
    let pose = Pose::new(&scenario.target.frame, settings);
    let nozzle = &scenario.problem.nozzle;
    if !is_exit_bare(scenario) && scenario.sweep.is_none() {
        let found = scenario
            .scene
            .clearance(nozzle, &pose.exit, &pose.direction, limit);
        return found.map(|(distance, surface)| Gap { distance, surface });
    }
    let swept = |core| Swept {
        aims: tolerance::aims_as_set(scenario, settings, &pose),
        directions: Directions::new(&[pose.direction]),
        core,
    };
    nearest(scenario, limit, 0.0, swept)
}

fn gap_swept(scenario: &Scenario, settings: &Settings, limit: f64) -> Option<Gap> {
    let pose = Pose::new(&scenario.target.frame, settings);
    let poses = tolerance::poses(scenario, settings);
    let directions: Vec<Vector3<f64>> = poses.iter().map(|pose| pose.direction).collect();
    let directions = Directions::new(&directions);
    let swept = |core| Swept {
        aims: tolerance::aims(scenario, settings, &pose),
        directions: directions.clone(),
        core,
    };
    nearest(
        scenario,
        limit,
        tolerance::sag(scenario, reach(scenario, settings)),
        swept,
    )
}

/// The nearest surface to any of the cores.
fn nearest(
    scenario: &Scenario,
    limit: f64,
    sag: f64,
    swept: impl Fn(Core) -> Swept,
) -> Option<Gap> {
    let mut nearest: Option<Gap> = None;
    for (core, radius) in cores(scenario) {
        let grown = radius + sag;
        let bound = nearest.map_or(limit, |gap| gap.distance) + grown;
        let found = scenario.scene.distance_to_swept(&swept(core), bound);
        if let Some((distance, surface)) = found {
            nearest = Some(Gap {
                distance: distance - grown,
                surface,
            });
        }
    }
    nearest
}

/// The farthest point of the body from the aim point, m.
fn reach(scenario: &Scenario, settings: &Settings) -> f64 {
    let lengths = cores(scenario).map(|(core, _)| match core {
        // A lance in a fixed direction is shifted, not turned.
        Core::Line {
            direction: Some(_), ..
        } => 0.0,
        core => core.length(),
    });
    settings.standoff + scenario.problem.tolerance.standoff + lengths.fold(0.0, f64::max)
}

/// No point of the body moves by more than this, m, while settings err within their tolerance.
fn room_for_errors(scenario: &Scenario, settings: &Settings) -> f64 {
    let tolerance = &scenario.problem.tolerance;
    let shifts = [
        tolerance.aim_along,
        tolerance.aim_across,
        tolerance.aim_above,
    ];
    let shifted = shifts.iter().map(|it| it * it).sum::<f64>().sqrt();
    reach(scenario, settings) * tolerance::turn(scenario) + tolerance.standoff + shifted
}

impl Obstacle {
    /// Whether it is a wall that is nearer than the clearance; else the nozzle does not stand in free space.
    pub fn is_near_wall(&self) -> bool {
        matches!(self, Self::Surface(_))
    }

    /// What is in the way, in words: `the nozzle's exit is inside "hub"`.
    pub fn reason(&self, scenario: &Scenario) -> String {
        match *self {
            Self::Material(part) => {
                let name = scenario
                    .problem
                    .parts
                    .get(part)
                    .map_or("", |part| &part.name);
                format!("the nozzle's exit is inside {name}")
            }
            Self::Surface(surface) => format!(
                "the nozzle comes too near to {}",
                scenario.scene.surfaces()[surface as usize]
            ),
            Self::Body => "the jet leaves through the nozzle's own body".into(),
            Self::Carried(surface) => format!(
                "a part on the nozzle meets {}",
                scenario.scene.surfaces()[surface as usize]
            ),
        }
    }
}
