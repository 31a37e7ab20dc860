//! Rays, and what they meet.

use nalgebra::{Point3, Vector3};

/// A ray with a unit direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts, m.
    pub origin: Point3<f64>,
    /// Unit direction.
    pub direction: Vector3<f64>,
}

#[cfg(test)]
impl Ray {
    /// From a point along a unit vector.
    pub fn of(origin: [f64; 3], direction: [f64; 3]) -> Self {
        Self {
            origin: origin.into(),
            direction: direction.into(),
        }
    }
}

/// What a ray meets first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance along the ray, m.
    pub distance: f64,
    /// The place, m.
    pub point: Point3<f64>,
    /// Unit normal towards the side that the ray comes from.
    pub normal: Vector3<f64>,
    /// Index of the surface in the scene.
    pub surface: u32,
    /// The exact spot, for the ray that leaves it.
    pub hit_id: HitId,
}

/// The piece of the scene that a ray starts from, so that it is not hit again at distance 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HitId {
    /// Index of the part in the scene.
    pub part: u32,
    /// Index of the wall or triangle in the part.
    pub piece: u32,
    /// Whether the ray runs on the front of that piece.
    pub front: bool,
}

/// A ray through one piece of a part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing {
    pub distance: f64,
    /// How far the ray starts above the piece already where it is hit at once, m; 0 elsewhere.
    pub above: f64,
    pub front: bool,
    pub piece: u32,
    pub surface: u32,
}
