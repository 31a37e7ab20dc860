//! Many rays side by side, and what they meet.

use nalgebra::{Point3, Vector3};

use super::lanes::{LANES, Lane, components, put};
use super::nozzle_frame::NozzleFrames;
use super::ray::{Crossing, HitId, Ray};

/// Rays side by side; all of them start on a surface, or none.
pub struct Rays {
    /// How many there are; what stands beyond has no meaning.
    pub count: usize,
    /// Where they start, m.
    pub origin: [Lane; 3],
    /// Unit directions.
    pub direction: [Lane; 3],
    /// Whether the shots have a size; their centres move along the rays.
    pub are_spheres: bool,
    /// Radii of the shots, m.
    pub radius: Lane,
    /// The spots that they start from, if they do.
    pub leaving: Option<HitIds>,
    /// The stands of their nozzles, where parts of the scene move with these.
    pub nozzle_frames: Option<Box<NozzleFrames>>,
}

/// Spots side by side.
#[derive(Clone)]
pub struct HitIds {
    /// Index of the part in the scene.
    pub part: [u32; LANES],
    /// Index of the wall or triangle in the part.
    pub piece: [u32; LANES],
    /// Whether the ray runs on the front of that piece.
    pub front: [bool; LANES],
}

/// What the rays meet first.
pub struct Hits {
    /// Distances, m; infinite where nothing is met.
    pub distance: Lane,
    /// How far the rays start above what they meet at once, m; 0 elsewhere.
    pub above: Lane,
    /// The places, m.
    pub point: [Lane; 3],
    /// Unit normals towards the side that the rays come from.
    pub normal: [Lane; 3],
    /// Indices of the surfaces in the scene.
    pub surface: [u32; LANES],
    /// The exact spots.
    pub hit_ids: HitIds,
}

impl HitIds {
    pub(super) fn none() -> Self {
        Self {
            part: [0; LANES],
            piece: [0; LANES],
            front: [true; LANES],
        }
    }

    /// One of them.
    pub fn at(&self, index: usize) -> HitId {
        HitId {
            part: self.part[index],
            piece: self.piece[index],
            front: self.front[index],
        }
    }

    /// Sets one of them.
    pub fn set(&mut self, index: usize, hit_id: HitId) {
        self.part[index] = hit_id.part;
        self.piece[index] = hit_id.piece;
        self.front[index] = hit_id.front;
    }
}

impl Rays {
    /// No rays yet.
    pub fn none() -> Self {
        // Numbers that no arithmetic stumbles over, beyond the rays that there are.
        let mut direction = [[0.0; LANES]; 3];
        direction[2] = [1.0; LANES];
        Self {
            count: 0,
            origin: [[0.0; LANES]; 3],
            direction,
            are_spheres: false,
            radius: [0.0; LANES],
            leaving: None,
            nozzle_frames: None,
        }
    }

    /// Leaves out all but some of them, which are given in order.
    pub(super) fn keep(&mut self, which: &[usize]) {
        self.count = which.len();
        for (to, &from) in which.iter().enumerate() {
            for lane in self.origin.iter_mut().chain(&mut self.direction) {
                lane[to] = lane[from];
            }
            self.radius[to] = self.radius[from];
            if let Some(leaving) = &mut self.leaving {
                leaving.set(to, leaving.at(from));
            }
        }
    }

    /// One of them.
    pub fn at(&self, index: usize) -> Ray {
        Ray {
            origin: Point3::from(components(&self.origin, index)),
            direction: Vector3::from(components(&self.direction, index)),
        }
    }
}

impl Hits {
    /// No hits yet.
    pub fn none() -> Self {
        Self {
            distance: [f64::INFINITY; LANES],
            above: [0.0; LANES],
            point: [[0.0; LANES]; 3],
            normal: [[0.0; LANES]; 3],
            surface: [0; LANES],
            hit_ids: HitIds::none(),
        }
    }

    /// Sets one of them, on the part of an index in the scene; `normal` is that on the front.
    #[inline(always)]
    pub(super) fn set(
        &mut self,
        index: usize,
        part: u32,
        crossing: &Crossing,
        normal: Vector3<f64>,
    ) {
        self.distance[index] = crossing.distance;
        self.above[index] = crossing.above;
        self.surface[index] = crossing.surface;
        put(&mut self.normal, index, [normal.x, normal.y, normal.z]);
        let (piece, front) = (crossing.piece, crossing.front);
        self.hit_ids.set(index, HitId { part, piece, front });
    }
}
