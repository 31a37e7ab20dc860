//! Shots that fly side by side, impact after impact.
//!
//! The same paths as [`Tracer`](super::Tracer) follows one by one, to the last bit in f64, many
//! times faster.

mod impacts;

use multiversion::multiversion;
use nalgebra::Vector3;

use super::vacancies::Vacancies;
use super::{End, MOST_DEFLECTIONS, Tracer, energy};
use crate::jet::Deviate;
use crate::precision::{Real, Triple, along, unit};
use crate::scene::lanes::{LANES, Lane, any, components, padded, put};
use crate::scene::rays::{Hits, Rays};
use crate::scene::stand::Stands;
use impacts::{Impacts, Rules, fate};

/// Up to [`LANES`] shots in flight, side by side.
pub(crate) struct Volley<R> {
    /// Their rays to the next impacts.
    pub rays: Rays<R>,
    /// What these meet.
    pub hits: Hits<R>,
    /// What the impacts there do.
    pub impacts: Impacts<R>,
    /// Index of each shot among those that were fired together.
    pub shot: [u32; LANES],
    /// How many impacts it has had; hits on deflectors do not count.
    pub number: Lane<R>,
    /// What it stands for.
    pub weight: Lane<R>,
    /// Whether it is one that the jet fires, and not one drawn towards the rim.
    pub of_jet: Lane<R>,
    /// Factor on its speed.
    pub speed: Lane<R>,
    /// Velocity of the centre, m/s.
    pub velocity: [Lane<R>; 3],
    /// R w, m/s.
    pub rolling: [Lane<R>; 3],
    mass: Lane<R>,
    least_energy: Lane<R>,
    /// The chosen contact as this shot meets it, when it is the same everywhere.
    restitution: Lane<R>,
    holds: Lane<R>,
    slides: Lane<R>,
}

/// Is told what happens to the shots of a volley.
pub(crate) trait Witness<R> {
    /// All shots in flight have come to their next impact, or left.
    fn impacts(&mut self, volley: &Volley<R>);

    /// A shot's path has ended after so many rays.
    fn ends(&mut self, shot: usize, end: End, rays: usize);
}

/// Fires `deviates` together, at most [`LANES`]; returns the number of rays.
pub(crate) fn fire<R: Real, W: Witness<R>>(
    tracer: &Tracer,
    volley: &mut Volley<R>,
    deviates: &[Deviate],
    witness: &mut W,
) -> usize {
    if tracer.setup.scene.has_exact_walls() {
        fire_at_walls(tracer, volley, deviates, witness)
    } else {
        fire_at_facets(tracer, volley, deviates, witness)
    }
}

#[multiversion(targets(
    "x86_64+avx+avx2+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+bmi1+bmi2+fma",
    "x86_64+avx+avx2+bmi1+bmi2+fma"
))]
fn fire_at_walls<R: Real, W: Witness<R>>(
    tracer: &Tracer,
    volley: &mut Volley<R>,
    deviates: &[Deviate],
    witness: &mut W,
) -> usize {
    volley.fly(tracer, deviates, witness)
}

/// Without AVX-512, for which some processors slow down all that they do; the walk through a tree
/// gains nothing from it.
#[multiversion(targets("x86_64+avx+avx2+bmi1+bmi2+fma"))]
fn fire_at_facets<R: Real, W: Witness<R>>(
    tracer: &Tracer,
    volley: &mut Volley<R>,
    deviates: &[Deviate],
    witness: &mut W,
) -> usize {
    volley.fly(tracer, deviates, witness)
}

impl<R: Real> Volley<R> {
    pub fn none() -> Self {
        let zeros = [R::ZERO; LANES];
        Self {
            rays: Rays::none(),
            hits: Hits::none(),
            impacts: Impacts::none(),
            shot: [0; LANES],
            number: zeros,
            weight: zeros,
            of_jet: zeros,
            speed: [R::ONE; LANES],
            velocity: [zeros; 3],
            rolling: [zeros; 3],
            mass: zeros,
            least_energy: zeros,
            restitution: zeros,
            holds: zeros,
            slides: zeros,
        }
    }

    /// Puts shots at the exit.
    #[inline(always)]
    fn load(&mut self, tracer: &Tracer, deviates: &[Deviate]) {
        let frame = &tracer.setup.target.frame;
        let as_asked = deviates.iter().all(Deviate::leaves_pose);
        self.rays.count = deviates.len().min(LANES);
        self.rays.leaving = None;
        self.rays.are_spheres = tracer.radius > 0.0;
        for (i, deviate) in deviates.iter().take(LANES).enumerate() {
            let ray = if as_asked {
                tracer.pose.shot(deviate)
            } else {
                tracer.aim.shot(frame, deviate)
            };
            put(&mut self.rays.origin, i, narrow(&ray.origin.coords));
            put(&mut self.rays.direction, i, narrow(&ray.direction));
            let velocity = ray.direction * (tracer.speed * deviate.speed);
            put(&mut self.velocity, i, narrow(&velocity));
            put(&mut self.rolling, i, [R::ZERO; 3]);
            self.rays.radius[i] = R::of(tracer.radius * deviate.size);
            self.shot[i] = i as u32;
            self.number[i] = R::ZERO;
            self.weight[i] = R::of(deviate.weight);
            self.of_jet[i] = truth(deviate.of_jet);
            self.speed[i] = R::of(deviate.speed);
            self.mass[i] = R::of(tracer.mass * deviate.mass());
            if let Some(contact) = &tracer.only_contact {
                let (restitution, factor) =
                    (contact.restitution + deviate.restitution, deviate.friction);
                self.restitution[i] = R::of(restitution.clamp(0.0, 1.0));
                self.holds[i] = R::of(contact.friction.holds * factor);
                self.slides[i] = R::of(contact.friction.slides * factor);
            }
        }
        self.rays.stands = tracer.moves_parts.then(|| stands(tracer, deviates));
        let share = R::of(tracer.setup.problem.paths.least_energy);
        for i in 0..padded(self.rays.count) {
            self.least_energy[i] = share * energy(components(&self.velocity, i), [R::ZERO; 3]);
        }
    }

    #[inline(always)]
    fn fly<W: Witness<R>>(
        &mut self,
        tracer: &Tracer,
        deviates: &[Deviate],
        witness: &mut W,
    ) -> usize {
        self.load(tracer, deviates);
        let most_impacts = tracer.setup.problem.paths.impacts as f64;
        let (mut rays, mut flights) = (0, 0);
        while self.rays.count > 0 {
            rays += self.rays.count;
            flights += 1;
            let rules = Rules {
                most_impacts: R::of(most_impacts),
                too_few_impacts: R::of(f64::from(flights) - f64::from(MOST_DEFLECTIONS)),
            };
            tracer.setup.scene.first_hits(&self.rays, &mut self.hits);
            if tracer.has_deflectors {
                self.mark_deflections(tracer);
            }
            match &tracer.only_contact {
                Some(only) if !tracer.has_rough_surfaces => {
                    self.collide(&only.friction.at(only.restitution), &rules);
                }
                _ => self.collide_one_by_one(tracer, deviates, flights, &rules),
            }
            witness.impacts(self);
            self.end_paths(flights, witness);
            if !tracer.setup.problem.paths.spin {
                self.rolling = [[R::ZERO; LANES]; 3];
            }
            self.leave();
        }
        rays
    }

    /// Drops the shots whose paths have ended; the last of the others take their lanes.
    #[inline(always)]
    fn end_paths<W: Witness<R>>(&mut self, flights: u32, witness: &mut W) {
        let goes_on = R::of(fate::GOES_ON);
        let fates = &self.impacts.fate[..self.rays.count];
        if !any(fates, |fate| fate != goes_on) {
            return;
        }
        for (&fate, &shot) in fates.iter().zip(&self.shot) {
            if fate != goes_on {
                witness.ends(shot as usize, fate::end(fate), flights as usize);
            }
        }
        let vacancies = Vacancies::among(fates.len(), |lane| fates[lane] == goes_on);
        self.rays.count = vacancies.left;
        vacancies.fill_all(&mut self.velocity);
        vacancies.fill_all(&mut self.rolling);
        vacancies.fill_all(&mut self.hits.point);
        if self.rays.are_spheres {
            vacancies.fill_all(&mut self.hits.normal);
            vacancies.fill(&mut self.rays.radius);
        }
        vacancies.fill_all([
            &mut self.number,
            &mut self.weight,
            &mut self.of_jet,
            &mut self.speed,
            &mut self.mass,
            &mut self.least_energy,
            &mut self.restitution,
            &mut self.holds,
            &mut self.slides,
        ]);
        if let Some(stands) = &mut self.rays.stands {
            vacancies.fill_all(stands.lanes_mut());
        }
        vacancies.fill(&mut self.shot);
        vacancies.fill(&mut self.hits.spots.part);
        vacancies.fill(&mut self.hits.spots.piece);
        vacancies.fill(&mut self.hits.spots.front);
    }

    /// From the places of contact to the centres of the shots.
    #[inline(always)]
    fn rise_by_radius(&mut self) {
        for i in 0..padded(self.rays.count) {
            let (point, normal) = (
                components(&self.rays.origin, i),
                components(&self.hits.normal, i),
            );
            put(
                &mut self.rays.origin,
                i,
                along(point, normal, self.rays.radius[i]),
            );
        }
    }

    /// The rays on which the shots leave the surfaces that they have hit.
    #[inline(always)]
    fn leave(&mut self) {
        self.rays.origin = self.hits.point;
        if self.rays.are_spheres {
            self.rise_by_radius();
        }
        self.rays.leaving = Some(self.hits.spots.clone());
        for i in 0..padded(self.rays.count) {
            put(
                &mut self.rays.direction,
                i,
                unit(components(&self.velocity, i)),
            );
        }
    }
}

/// Where the nozzle really stands for each shot.
fn stands<R: Real>(tracer: &Tracer, deviates: &[Deviate]) -> Box<Stands<R>> {
    let mut stands = Box::new(Stands::none());
    for (i, deviate) in deviates.iter().take(LANES).enumerate() {
        stands.set(i, &tracer.stand(deviate));
    }
    stands
}

/// 1 for what is true, 0 for what is not.
#[inline(always)]
pub(crate) fn truth<R: Real>(holds: bool) -> R {
    if holds { R::ONE } else { R::ZERO }
}

/// A vector in the precision of the flight.
#[inline(always)]
fn narrow<R: Real>(vector: &Vector3<f64>) -> Triple<R> {
    [R::of(vector.x), R::of(vector.y), R::of(vector.z)]
}
