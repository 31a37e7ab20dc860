//! A problem together with its scene: everything that stays the same for every pose.

mod rejection;

use std::path::Path;
use std::sync::Arc;

use nalgebra::Vector3;

use crate::elementary::sin;
use crate::impact::Contact;
use crate::problem::equipment::Role;
use crate::problem::fault::Fault;
use crate::problem::model::{Effect, Model};
use crate::problem::part::{Part, Target};
use crate::problem::setting::Settings;
use crate::problem::stroke::WHOLE;
use crate::problem::{self, Problem, Reading, Source};
use crate::scene::patch::Patch;
use crate::scene::traverse::Traverse;
use crate::scene::{Scene, Walls};

pub use rejection::Rejection;

/// A problem, its scene, its target and the rules of each surface.
#[derive(Clone)]
pub struct Scenario {
    /// What was asked.
    pub problem: Problem,
    /// What is there.
    pub scene: Arc<Scene>,
    /// What is to be peened.
    pub target: Patch,
    /// One for each surface of the scene.
    pub surfaces: Vec<SurfaceLimits>,
    /// The way of the nozzle; absent for a spot.
    pub traverse: Option<Arc<Traverse>>,
    /// Half the way of the nozzle, m, on a stroke on which it moves straight on and nothing turns.
    pub sweep: Option<Vector3<f64>>,
    /// The same at each station of the stroke, where the nozzle stands still, and last at the far ends of a run-out that
    /// is asked for; none for a spot.
    pub stations: Arc<[Station]>,
    /// Whether the nozzle is in the run-out of a stroke: what the target receives there does not count.
    pub in_run_out: bool,
}

/// A place of a stroke.
#[derive(Clone)]
pub struct Station {
    /// -0.5 at the beginning of the stroke, 0.5 at its end.
    pub place: f64,
    /// What there is for a nozzle that stands there.
    pub scenario: Scenario,
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
    /// Standard deviation of the tilt of its normal about each direction in it, rad.
    pub roughness: f64,
    /// Whether hits on it belong to the flight.
    pub deflector: bool,
}

impl Scenario {
    /// Builds the scene of a problem and finds the target in it.
    ///
    /// # Errors
    /// All faults of the geometry.
    pub fn new(problem: Problem, walls: Walls) -> Result<Self, Vec<Fault>> {
        let scene = Scene::build(&problem.parts, walls)?;
        let target = Patch::find(&scene, &problem.target)?;
        Self::assemble(problem, scene, target)
    }

    /// Reads a problem file and builds its scene.
    ///
    /// # Errors
    /// All faults of the file and of the geometry at once, in the order of the text.
    pub fn load(path: &Path) -> Result<(Self, Source), Box<Rejection>> {
        Self::from_reading(problem::read(path))
    }

    /// The same for what came of a problem file.
    pub(crate) fn from_reading(
        reading: Result<Reading, Box<Fault>>,
    ) -> Result<(Self, Source), Box<Rejection>> {
        let reading = reading.map_err(|fault| Rejection::unread(*fault))?;
        let Reading {
            source, mut faults, ..
        } = reading;
        let mut collect = |found: Vec<Fault>| faults.extend(found);
        let scene = reading.scene.and_then(|parts| {
            let scene = Scene::build(&parts, Walls::Exact);
            if let (Err(faults), Some(target)) = (&scene, &reading.target) {
                collect(target_faults(parts, faults, target));
            }
            scene.map_err(&mut collect).ok()
        });
        let target = scene
            .as_ref()
            .zip(reading.target)
            .and_then(|(scene, target)| Patch::find(scene, &target).map_err(&mut collect).ok());
        let unknown = scene.as_ref().map_or_else(Vec::new, |scene| {
            let names = reading.surfaces.iter();
            names.filter_map(|name| unknown(scene, name)).collect()
        });
        let whole = reading.problem.zip(scene).zip(target);
        let scenario = whole.and_then(|((problem, scene), target)| {
            Self::assemble(problem, scene, target)
                .map_err(&mut collect)
                .ok()
        });
        match scenario {
            Some(scenario) => Ok((scenario, source)),
            None => {
                let is_new = |fault: &Fault| faults.iter().all(|known| known.key != fault.key);
                let new: Vec<Fault> = unknown.into_iter().filter(is_new).collect();
                faults.extend(new);
                Err(Rejection::new(source, faults))
            }
        }
    }

    /// The same without some effects; what depends on the speed is taken at some settings.
    #[must_use]
    pub fn without(&self, effects: &[Effect], settings: &Settings) -> Self {
        let mut reduced = self.clone();
        let normal_speed = settings.speed * sin(settings.incidence);
        for effect in effects {
            effect.remove_from(&mut reduced.problem, normal_speed);
        }
        for surface in &mut reduced.surfaces {
            if effects.contains(&Effect::Roughness) {
                surface.roughness = 0.0;
            }
            if effects.contains(&Effect::FallingRestitution)
                && let Some(contact) = &mut surface.contact
            {
                contact.restitution = contact.restitution.held_at(normal_speed);
            }
        }
        reduced.with_stations()
    }

    /// The same for a nozzle that stands still at a place of the stroke.
    #[must_use]
    pub fn standing_at(&self, place: f64) -> Self {
        let mut standing = self.clone();
        standing.stations = Arc::new([]);
        standing.problem.stroke = None;
        standing.sweep = None;
        let Some(traverse) = standing.traverse.take() else {
            return standing;
        };
        standing.in_run_out = place.abs() > 0.5;
        standing.target.frame = traverse.frame_at(place);
        if let Some(turn) = traverse.turn_at(place) {
            let bodies = standing.problem.nozzle.body.iter_mut();
            bodies.for_each(|body| body.turn(&turn));
        }
        standing
    }

    /// A station at a place of the stroke.
    pub fn station(&self, place: f64) -> Station {
        Station {
            place,
            scenario: self.standing_at(place),
        }
    }

    /// The places of the stations at which a stroke mostly fails first: its ends and its middle; none for a spot.
    pub fn ends_and_middle(&self) -> Vec<f64> {
        let within = self.stations.iter().filter(|it| !it.scenario.in_run_out);
        let places: Vec<f64> = within.map(|it| it.place).collect();
        match places[..] {
            [] | [_, _] => places,
            [first, .., last] => vec![first, places[places.len() / 2], last],
            [only] => vec![only],
        }
    }

    /// A part of the stroke, between two places, with so many stations besides its ends' own.
    #[must_use]
    pub fn part_of_stroke(&self, span: [f64; 2], stations: usize) -> Self {
        let mut part = self.clone();
        if let (Some(traverse), Some(stroke)) = (&self.traverse, &mut part.problem.stroke) {
            let traverse = traverse.part(span);
            stroke.stations = stations + 1;
            part.target.frame = traverse.frame_at(0.0);
            part.traverse = Some(Arc::new(traverse));
        }
        part.with_stations()
    }

    fn with_stations(mut self) -> Self {
        let Some((stroke, traverse)) = self.problem.stroke.as_ref().zip(self.traverse.as_ref())
        else {
            return self;
        };
        let last = (stroke.stations - 1) as f64;
        let places = (0..stroke.stations).map(|index| index as f64 / last - 0.5);
        // What is passed in the run-out is looked at as closely as the rest, with at most as many stations.
        let run_out = stroke.run_out.unwrap_or(0.0);
        let wanted = (traverse.places_in(run_out) * last).ceil();
        let count = wanted.min(stroke.stations as f64) as usize;
        let ends = WHOLE.into_iter().zip(traverse.reaches_ends());
        let ends = ends.filter_map(|(end, is_reached)| is_reached.then_some(end));
        let beyond = ends.flat_map(|end| {
            let shares = (1..=count).map(|index| index as f64 / count as f64);
            shares.map(move |share| traverse.beyond(end, run_out * share))
        });
        let stations = places.chain(beyond).map(|place| self.station(place));
        let (stations, sweep) = (stations.collect(), traverse.sweep());
        self.stations = stations;
        self.sweep = sweep;
        self
    }

    /// The effects that the problem has and that its model does not name.
    pub fn unasked(&self) -> Vec<Effect> {
        let Model::Only(named) = &self.problem.model else {
            return Vec::new();
        };
        let effects = self.problem.effects().into_iter();
        effects.filter(|effect| !named.contains(effect)).collect()
    }

    /// The same without the effects that are not asked for; what depends on the speed becomes what
    /// it is at the middle of all settings.
    #[must_use]
    pub fn as_asked(&self) -> Self {
        self.without(&self.unasked(), &self.problem.ranges.middle())
    }

    /// The same as a search needs it: where J does not depend on what follows the first impact, paths end
    /// there. What the whole model is asked for is left as it is.
    #[must_use]
    pub fn as_searched(&self) -> Self {
        let costs = |limits: &SurfaceLimits| limits.allow.is_some() && limits.weight > 0.0;
        let mut searched = self.clone();
        if self.problem.model != Model::Full && !self.surfaces.iter().any(costs) {
            searched.problem.paths.impacts = 1;
        }
        searched.with_stations()
    }

    /// Whether the paths of shots stay the same when every speed is multiplied by one factor.
    pub fn speed_scales_out(&self, contact: usize) -> bool {
        let own = self.surfaces.iter().filter_map(|limits| limits.contact);
        self.problem.contacts[contact].contact.is_scale_free()
            && own.into_iter().all(|contact| contact.is_scale_free())
    }

    /// The contact of the mean shot with a surface of the scene: its own one, or the chosen one.
    pub fn contact_on(&self, surface: u32, settings: &Settings) -> Contact {
        self.surfaces[surface as usize]
            .contact
            .unwrap_or_else(|| self.problem.contacts[settings.contact].at(settings.static_friction))
    }

    fn assemble(problem: Problem, mut scene: Scene, mut target: Patch) -> Result<Self, Vec<Fault>> {
        let surfaces = surface_limits(&problem, &scene, target.surface)?;
        scene.settle(&target);
        let stroke = problem.stroke.as_ref();
        let traverse = stroke
            .map(|stroke| Traverse::find(&scene, &target, &problem, stroke))
            .transpose()?;
        if let Some(traverse) = &traverse {
            target.frame = traverse.frame_at(0.0);
        }
        let scenario = Self {
            problem,
            scene: Arc::new(scene),
            target,
            surfaces,
            traverse: traverse.map(Arc::new),
            sweep: None,
            stations: Arc::new([]),
            in_run_out: false,
        };
        Ok(scenario.with_stations())
    }
}

/// What is wrong with the target, where its part can be built although others cannot.
fn target_faults(mut parts: Vec<Part>, faults: &[Fault], target: &Target) -> Vec<Fault> {
    let is_damaged = |part: &Part| {
        let block = format!("scene.{}.", part.name);
        faults.iter().any(|fault| fault.key.starts_with(&block))
    };
    let holds_target = |part: &Part| target.surface.starts_with(&format!("{}.", part.name));
    parts.retain(|part| holds_target(part) && !is_damaged(part));
    if parts.is_empty() {
        return Vec::new();
    }
    Scene::build(&parts, Walls::Exact)
        .and_then(|scene| Patch::find(&scene, target))
        .err()
        .unwrap_or_default()
}

/// What is wrong with a rule for a surface that the scene does not have.
fn unknown(scene: &Scene, surface: &str) -> Option<Fault> {
    let fault = scene.surface_named(surface).err()?;
    Some(Fault {
        key: format!("surfaces.{surface}"),
        ..*fault
    })
}

fn surface_limits(
    problem: &Problem,
    scene: &Scene,
    target: u32,
) -> Result<Vec<SurfaceLimits>, Vec<Fault>> {
    let rebound = problem.goals.rebound;
    let usual = SurfaceLimits {
        allow: rebound.map(|goal| goal.allow),
        share: rebound.map_or(DEFAULT_REBOUND_SHARE, |goal| goal.share),
        weight: rebound.map_or(1.0, |goal| goal.weight),
        contact: None,
        roughness: 0.0,
        deflector: false,
    };
    let mut limits = vec![usual; scene.surfaces().len()];
    let mut faults = Vec::new();
    for rule in &problem.surfaces {
        let fault_on_target = rule.fault_on_target();
        match scene.surface_named(&rule.surface) {
            Ok(index) if index == target && fault_on_target.is_some() => {
                faults.extend(fault_on_target);
            }
            Ok(index) => {
                limits[index as usize] = SurfaceLimits {
                    allow: rule.allow.or(usual.allow),
                    share: rule.share.unwrap_or(usual.share),
                    weight: rule.weight.unwrap_or(usual.weight),
                    contact: rule.contact,
                    roughness: rule.roughness,
                    deflector: rule.role == Role::Deflector,
                };
            }
            Err(_) => faults.extend(unknown(scene, &rule.surface)),
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
