//! A problem together with its scene: everything that stays the same for every pose.

use crate::impact::{Contact, Sphere};
use crate::problem::Problem;
use crate::problem::equipment::Role;
use crate::problem::fault::Fault;
use crate::scene::patch::Patch;
use crate::scene::{Scene, Walls};

/// A problem, its scene, its target and the rules of each surface.
#[derive(Clone)]
pub struct Setup {
    /// What was asked.
    pub problem: Problem,
    /// What is there.
    pub scene: Scene,
    /// What is to be peened.
    pub target: Patch,
    /// One for each surface of the scene.
    pub surfaces: Vec<SurfaceLimits>,
}

/// What holds for one surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceLimits {
    /// Normal impulse that it may take, N s; no limit when absent.
    pub allow: Option<f64>,
    /// Share of all shots that may exceed it.
    pub share: f64,
    /// Weight of its impacts in the objective.
    pub weight: f64,
    /// Its own contact, whatever contact is chosen.
    pub contact: Option<Contact>,
    /// Whether hits on it belong to the flight.
    pub deflector: bool,
}

impl Setup {
    /// Builds the scene of a problem and finds the target in it.
    ///
    /// # Errors
    /// All faults of the geometry.
    pub fn new(problem: Problem, walls: Walls) -> Result<Self, Vec<Fault>> {
        let scene = Scene::build(&problem.parts, walls)?;
        let target = Patch::find(&scene, &problem.target)?;
        let surfaces = surface_limits(&problem, &scene)?;
        Ok(Self {
            problem,
            scene,
            target,
            surfaces,
        })
    }

    /// The mean shot.
    pub fn sphere(&self) -> Sphere {
        Sphere {
            radius: self.problem.shot.radius,
            density: self.problem.shot.density,
        }
    }
}

fn surface_limits(problem: &Problem, scene: &Scene) -> Result<Vec<SurfaceLimits>, Vec<Fault>> {
    let rebound = problem.goals.rebound;
    let usual = SurfaceLimits {
        allow: rebound.map(|goal| goal.allow),
        share: rebound.map_or(DEFAULT_REBOUND_SHARE, |goal| goal.share),
        weight: rebound.map_or(1.0, |goal| goal.weight),
        contact: None,
        deflector: false,
    };
    let mut limits = vec![usual; scene.surfaces().len()];
    let mut faults = Vec::new();
    for rule in &problem.surfaces {
        match scene.surface_named(&rule.surface) {
            Ok(index) => {
                limits[index as usize] = SurfaceLimits {
                    allow: rule.allow.or(usual.allow),
                    share: rule.share.unwrap_or(usual.share),
                    weight: rule.weight.unwrap_or(usual.weight),
                    contact: rule.contact,
                    deflector: rule.role == Role::Deflector,
                };
            }
            Err(fault) => faults.push(Fault {
                key: format!("surfaces.{}", rule.surface),
                ..fault
            }),
        }
    }
    if faults.is_empty() {
        Ok(limits)
    } else {
        Err(faults)
    }
}

/// Share of the shots that may exceed a surface's own limit when no general one is given.
const DEFAULT_REBOUND_SHARE: f64 = 0.01;
