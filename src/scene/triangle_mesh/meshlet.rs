//! Meshlets: small groups of neighbouring triangles that lie nearly in one plane.
//!
//! The wall of a bore is a thousand slender facets, and a lance in the bore is about as far from each of them. The
//! box of a slanting facet says little about how far that is, but one look along the normal of a group of them says it
//! for all, to the depth of the arc that they span.

use nalgebra::{Point3, Vector3};
use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::math::Vector;

use super::plane;
use crate::elementary::extremes;

/// A group of triangles that lie nearly in one plane.
#[derive(Clone)]
pub(in crate::scene) struct Meshlet {
    triangles: Vec<u32>,
    /// Corner points of them, each once, m.
    corners: Vec<Vector>,
    /// Nearly their normal; 0 where they have none.
    normal: Vector,
    /// The least and the largest height of a corner along that, m.
    heights: (f64, f64),
}

impl Meshlet {
    /// Groups triangles that are given in bundles of neighbours, in the order of a tree.
    pub fn grouped<'a>(
        bundles: impl Iterator<Item = &'a [u32]>,
        corners: impl Fn(u32) -> [Point3<f64>; 3],
        slack: f64,
    ) -> Vec<Self> {
        let mut groups: Vec<Group> = Vec::new();
        for bundle in bundles {
            let next = Group::of(bundle, &corners, slack);
            match groups.last_mut() {
                Some(group) if group.takes(&next) => group.add(next),
                _ => groups.push(next),
            }
        }
        groups.into_iter().map(|it| it.meshlet(&corners)).collect()
    }

    /// The indices of its triangles.
    pub fn triangles(&self) -> &[u32] {
        &self.triangles
    }

    /// The index of one in the middle of them.
    pub fn middle(&self) -> u32 {
        self.triangles[self.triangles.len() / 2]
    }

    /// Its box, loosened by `slack` (m).
    pub fn bounds(&self, slack: f64) -> Aabb {
        Aabb::from_points(self.corners.iter().copied()).loosened(slack)
    }

    /// Nearly its normal, away from a point, and how far along that its nearest point is, m.
    pub fn plane_from(&self, point: Vector) -> (Vector, f64) {
        let (low, high) = self.heights;
        if 2.0 * point.dot(self.normal) < low + high {
            (self.normal, low)
        } else {
            (-self.normal, -high)
        }
    }

    /// How far along a direction its nearest point is, m.
    pub fn nearest_along(&self, direction: Vector) -> f64 {
        let along = self.corners.iter().map(|corner| corner.dot(direction));
        along.fold(f64::INFINITY, f64::min)
    }
}

/// What becomes a meshlet when nothing can be added.
struct Group {
    triangles: Vec<u32>,
    bounds: Aabb,
    /// Unit normals of its triangles.
    normals: Vec<Vector3<f64>>,
}

impl Group {
    fn of(bundle: &[u32], corners: impl Fn(u32) -> [Point3<f64>; 3], slack: f64) -> Self {
        let each = bundle.iter().map(|&index| corners(index));
        let points = each.clone().flatten().map(|point| point.coords.into());
        Self {
            triangles: bundle.to_vec(),
            bounds: Aabb::from_points(points).loosened(slack),
            normals: each.map(|corners| plane::normal(&corners)).collect(),
        }
    }

    /// Whether another one is beside it and lies nearly in its plane.
    fn takes(&self, other: &Self) -> bool {
        let normals = || self.normals.iter().chain(&other.normals);
        let mean = normals().sum::<Vector3<f64>>().normalize();
        self.triangles.len() + other.triangles.len() <= MOST_TRIANGLES
            && self.bounds.intersects(&other.bounds)
            && normals().all(|normal| normal.dot(&mean) >= LEAST_COSINE)
    }

    fn add(&mut self, other: Self) {
        self.triangles.extend(other.triangles);
        self.normals.extend(other.normals);
        self.bounds.merge(&other.bounds);
    }

    fn meshlet(self, corners: impl Fn(u32) -> [Point3<f64>; 3]) -> Meshlet {
        let points = self.triangles.iter().flat_map(|&index| corners(index));
        let mut once: Vec<Vector> = Vec::new();
        for point in points.map(|point| point.coords.into()) {
            if !once.contains(&point) {
                once.push(point);
            }
        }
        let normal = self.normals.iter().sum::<Vector3<f64>>();
        let normal: Vector = normal.try_normalize(0.0).unwrap_or_default().into();
        Meshlet {
            triangles: self.triangles,
            heights: extremes(once.iter().map(|corner| corner.dot(normal))),
            corners: once,
            normal,
        }
    }
}

/// Triangles of a meshlet, at most.
const MOST_TRIANGLES: usize = 16;
/// Cosine of the largest angle between one of its normals and their mean, 3 deg.
const LEAST_COSINE: f64 = 0.9986;
