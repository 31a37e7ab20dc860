//! The impacts of shots that fly side by side, and what becomes of the shots.

use super::{RayPacket, mask};
use crate::impact::{Coefficients, Contact, Friction, collide};
use crate::jet::ShotSample;
use crate::scene::lanes::{LANES, Lane, components, padded, put};
use crate::trace::{Tracer, energy, rough};
use crate::triple::{Triple, dot};

/// What impacts do, side by side; what is true is 1, what is not 0. (With numbers of one size
/// throughout, compilers see that loops over them can be worked on several at once.)
pub(crate) struct Impacts {
    /// N*, N s.
    pub normal: Lane,
    /// f*, N s.
    pub tangential: Lane,
    pub sticks: Lane,
    /// Whether there is one that counts: a surface is hit, and it is no deflector.
    pub counts: Lane,
    pub(in crate::trace) deflected: Lane,
    /// Why the flight ends here; see [`path_state`].
    pub(super) path_state: Lane,
}

impl Impacts {
    pub fn none() -> Self {
        let zeros = [0.0; LANES];
        Self {
            normal: zeros,
            tangential: zeros,
            sticks: zeros,
            counts: zeros,
            deflected: zeros,
            path_state: zeros,
        }
    }

    /// Whether a shot has met a surface.
    pub(in crate::trace) fn is_met(&self, index: usize) -> bool {
        self.path_state[index] != path_state::LEFT
    }
}

/// When paths end for their number of impacts.
pub(super) struct Rules {
    pub most_impacts: f64,
    /// With so few the rest of the hits were on deflectors: the shot is caught between them.
    pub too_few_impacts: f64,
}

/// Why a flight ends, as numbers that are computed side by side.
pub(super) mod path_state {
    use crate::trace::End;

    pub const GOES_ON: f64 = 0.0;
    pub const LEFT: f64 = 1.0;
    pub const STAYS: f64 = 2.0;
    pub const SPENT: f64 = 3.0;
    pub const LIMIT: f64 = 4.0;

    pub fn end(path_state: f64) -> End {
        match path_state {
            STAYS => End::Stays,
            SPENT => End::Spent,
            LIMIT => End::Limit,
            _ => End::Left,
        }
    }
}

impl RayPacket {
    /// Marks the hits that belong to the flight.
    pub(super) fn mark_deflections(&mut self, tracer: &Tracer) {
        for i in 0..self.rays.count {
            let surface = self.hits.surface[i] as usize;
            self.impacts.deflected[i] = mask(tracer.scenario.surfaces[surface].deflector);
        }
    }

    /// Lets the shots rebound from surfaces with one contact.
    #[inline(always)]
    pub(super) fn collide(&mut self, only: &Coefficients, rules: &Rules) {
        for i in 0..padded(self.rays.count) {
            let contact = Coefficients {
                restitution: self.restitution[i],
                holds: self.holds[i],
                slides: self.slides[i],
                ..*only
            };
            self.rebound(i, components(&self.hits.normal, i), &contact, rules);
        }
    }

    /// Lets the shots rebound where contacts differ, or where surfaces are rough.
    pub(super) fn collide_one_by_one(
        &mut self,
        tracer: &Tracer,
        shots: &[ShotSample],
        flight: u32,
        rules: &Rules,
    ) {
        for i in 0..self.rays.count {
            let sample = &shots[self.shot[i] as usize];
            let contact = tracer.contact_with(self.hits.surface[i] as usize, sample);
            let normal = self.normal_of_impact(i, tracer, sample, flight, &contact);
            let contact = coefficients(&contact, components(&self.velocity, i), normal);
            self.rebound(i, normal, &contact, rules);
        }
    }

    /// The normal that a shot finds, tilted by chance where the surface is rough.
    fn normal_of_impact(
        &self,
        i: usize,
        tracer: &Tracer,
        sample: &ShotSample,
        flight: u32,
        contact: &Contact,
    ) -> Triple {
        let normal = components(&self.hits.normal, i);
        let roughness = tracer.scenario.surfaces[self.hits.surface[i] as usize].roughness;
        if roughness == 0.0 {
            return normal;
        }
        let velocity = components(&self.velocity, i);
        let rolling = components(&self.rolling, i);
        let tilt = rough::tilt(sample, flight, roughness);
        rough::normal_of_impact(normal, tilt, velocity, |normal| {
            let contact = coefficients(contact, velocity, normal);
            let normal_speed = dot(velocity, normal);
            collide(&contact, velocity, rolling, normal, normal_speed).velocity
        })
    }

    /// Lets one shot rebound, and decides what becomes of it.
    #[inline(always)]
    fn rebound(&mut self, i: usize, normal: Triple, contact: &Coefficients, rules: &Rules) {
        let velocity = components(&self.velocity, i);
        let rolling = components(&self.rolling, i);
        let normal_speed = dot(velocity, normal);
        let after = collide(contact, velocity, rolling, normal, normal_speed);
        let met = (self.hits.distance[i] < f64::INFINITY) & (normal_speed < 0.0);
        let counts = met & (self.impacts.deflected[i] == 0.0);
        let number = self.number[i] + mask(counts);
        let spent = energy(after.velocity, after.rolling) < self.least_energy[i];
        let last = (number == rules.most_impacts) | (number == rules.too_few_impacts);
        let mut path_state = if last {
            path_state::LIMIT
        } else {
            path_state::GOES_ON
        };
        path_state = if spent { path_state::SPENT } else { path_state };
        path_state = if after.departure == 0.0 {
            path_state::STAYS
        } else {
            path_state
        };
        path_state = if met { path_state } else { path_state::LEFT };
        self.impacts.normal[i] = self.mass[i] * after.normal;
        self.impacts.tangential[i] = self.mass[i] * after.tangential;
        self.impacts.sticks[i] = mask(after.sticks);
        self.impacts.counts[i] = mask(counts);
        self.impacts.path_state[i] = path_state;
        self.number[i] = number;
        put(&mut self.velocity, i, after.velocity);
        put(&mut self.rolling, i, after.rolling);
    }
}

/// A contact at the speed with which a shot meets a surface.
fn coefficients(contact: &Contact, velocity: Triple, normal: Triple) -> Coefficients {
    let normal_speed = dot(velocity, normal);
    let restitution = contact.restitution.at(-normal_speed);
    Friction::of(contact).at(restitution)
}
