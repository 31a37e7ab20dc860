//! Rays against triangle meshes.
//!
//! parry's own triangle test lets rays through that pass exactly over an edge or a vertex, and a
//! ray cannot be told to ignore the facet that it starts from. So the test of a triangle is ours,
//! and so is the tree for rays, which are most of the work; distances take parry's.

mod plane;
mod slide;
mod touch;

use std::sync::OnceLock;

use nalgebra::{Point3, Vector3};
use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use rayon::prelude::*;

use super::LIFT;
use super::bundle::{Bundle, WideShear};
use super::mesh::Mesh;
use super::ray::{Crossing, Ray, Spot};
use super::start::Start;
use super::triangle::{Shear, Weights, lies_on, passes_over};
use super::wide_tree::WideTree;
use plane::{GRAZING, Plane};
use touch::Plates;

/// A mesh that is ready for rays.
#[derive(Clone)]
pub struct Facets {
    tree: WideTree,
    /// The triangles of each of its leaves.
    bundles: Vec<Bundle>,
    /// The same triangles for spheres, made when the first one comes.
    plates: OnceLock<Vec<Plates>>,
    /// For other walks than rays.
    distance_tree: Bvh,
    /// Whether its leaves are the bundles rather than single triangles.
    bundled: bool,
    corners: Vec<[u32; 3]>,
    surfaces: Vec<u32>,
    vertices: Vec<Point3<f64>>,
    /// Unit normals on the fronts.
    normals: Vec<Vector3<f64>>,
    slack: f64,
    /// Rounding of a plane's crossing distance stays below this for rays that do not graze it.
    doubt: f64,
    /// What a weight may lose to an edge that a ray passes by a lift, m².
    doubtful_weight: f64,
}

impl Facets {
    /// Prepares a mesh whose surfaces have the indices `surface_base` onwards. `slack` is the
    /// distance within which two points count as one, m.
    pub fn new(mesh: Mesh, surface_base: u32, slack: f64) -> Self {
        let corners = |index: u32| mesh.corners(&mesh.triangles[index as usize]);
        let (tree, leaves) = WideTree::new(mesh.triangles.len(), corners, slack);
        let bounds = |triangles: &[u32]| {
            let corners = triangles.iter().flat_map(|&index| corners(index));
            let bounds = Aabb::from_points(corners.map(|corner| corner.coords.into()));
            bounds.loosened(slack)
        };
        let bundled = mesh.triangles.len() > LARGE_MESH;
        let distance_tree = if bundled {
            let boxes = leaves.iter().map(|leaf| bounds(leaf));
            Bvh::from_iter(BvhBuildStrategy::Binned, boxes.enumerate())
        } else {
            let boxes = (0..mesh.triangles.len() as u32).map(|index| bounds(&[index]));
            Bvh::from_iter(BvhBuildStrategy::Ploc, boxes.enumerate())
        };
        Self {
            distance_tree,
            bundled,
            plates: OnceLock::new(),
            bundles: leaves
                .par_iter()
                .map(|leaf| Bundle::new(leaf, corners))
                .collect(),
            tree,
            corners: mesh.triangles.iter().map(|t| t.corners).collect(),
            surfaces: mesh
                .triangles
                .iter()
                .map(|t| surface_base + t.surface)
                .collect(),
            normals: mesh
                .triangles
                .iter()
                .map(|triangle| plane::normal(&mesh.corners(triangle)))
                .collect(),
            doubtful_weight: doubtful_weight(&mesh, slack),
            vertices: mesh.vertices,
            slack,
            doubt: DOUBT * slack,
        }
    }

    /// Number of triangles.
    pub fn count(&self) -> usize {
        self.corners.len()
    }

    /// parry's tree, for other walks than rays.
    pub(super) fn distance_tree(&self) -> &Bvh {
        &self.distance_tree
    }

    /// The triangles in a leaf of parry's tree.
    pub(super) fn leaf(&self, leaf: u32) -> impl Iterator<Item = u32> + '_ {
        let bundle = self
            .bundled
            .then(|| self.bundles[leaf as usize].triangles());
        let single = (!self.bundled).then_some(leaf);
        bundle.into_iter().flatten().copied().chain(single)
    }

    /// The corner points of a triangle.
    pub fn corners(&self, index: u32) -> [Point3<f64>; 3] {
        self.corners[index as usize].map(|corner| self.vertices[corner as usize])
    }

    /// The same, from where rays have just found the triangle.
    #[inline(always)]
    fn corners_of(&self, facet: Facet) -> [Point3<f64>; 3] {
        self.bundles[facet.leaf as usize].corners(facet.lane)
    }

    /// The surface of a triangle.
    pub fn surface(&self, index: u32) -> u32 {
        self.surfaces[index as usize]
    }

    /// Whether any of its triangles is of a surface.
    pub fn has_surface(&self, surface: u32) -> bool {
        self.surfaces.contains(&surface)
    }

    /// The first crossing of a ray nearer than `limit`, and the front normal there. Of crossings
    /// at the same distance it is that of the triangle with the lowest index.
    ///
    /// `leaving` is the spot that the ray starts from; `on_this_part` says whether it is on this
    /// mesh.
    pub fn first_crossing(
        &self,
        ray: &Ray,
        leaving: Option<Spot>,
        on_this_part: bool,
        limit: f64,
    ) -> Option<(Crossing, Vector3<f64>)> {
        let start = Start::of(leaving, on_this_part);
        let Nearest {
            t, front, facet, ..
        } = self.nearest(ray, &start, limit)?;
        let index = facet.index;
        let corners = self.corners_of(facet);
        let plane = Plane::new(self.normals[index as usize], &corners);
        let distance = plane.refined(t, ray, &corners);
        let crossing = Crossing {
            distance,
            above: plane.above(distance, front, &ray.origin),
            front,
            piece: index,
            surface: self.surface(index),
        };
        (distance < limit).then_some((crossing, plane.normal))
    }

    /// The nearest crossing of a ray within `limit`.
    #[inline(always)]
    fn nearest(&self, ray: &Ray, start: &Start, limit: f64) -> Option<Nearest> {
        let shear = WideShear::new(&Shear::new(ray));
        let mut best = Nearest {
            t: limit,
            front: true,
            facet: Facet::default(),
            farther: 0.0,
        };
        self.tree.walk(ray, limit, |leaf, starts_inside| {
            let bundle = &self.bundles[leaf as usize];
            let (weights, crossed) = bundle.weights(&shear, self.doubtful_weight);
            let near = if starts_inside && start.front.is_some() {
                bundle.near(&ray.origin, self.slack)
            } else {
                0
            };
            let mut lanes = crossed | near;
            while lanes != 0 {
                let lane = lanes.trailing_zeros() as usize;
                lanes &= lanes - 1;
                let index = bundle.triangles()[lane];
                if start.piece == Some(index) {
                    continue;
                }
                let weights = weights.of(lane);
                let facet = Facet { index, leaf, lane };
                let found = if near >> lane & 1 == 1 {
                    self.crossing_from_near(facet, ray, &weights, start)
                } else {
                    self.crossing(facet, ray, &weights, weights.distance(), start)
                };
                if let Some(found) = found {
                    best.improve(found);
                }
            }
            best.cost()
        });
        (best.cost() < limit).then_some(best)
    }

    /// Where a ray crosses a triangle on which it may start.
    #[inline(always)]
    fn crossing_from_near(
        &self,
        facet: Facet,
        ray: &Ray,
        weights: &Weights,
        start: &Start,
    ) -> Option<Nearest> {
        let corners = self.corners_of(facet);
        let plane = Plane::new(self.normals[facet.index as usize], &corners);
        let height = plane.height(&ray.origin);
        let approach = ray.direction.dot(&plane.normal);
        let starts_near = start.front.is_some() && height.abs() <= self.slack;
        if starts_near && lies_on(&ray.origin, &corners, self.slack) {
            return start.enters(approach).then_some(Nearest {
                t: 0.0,
                front: approach < 0.0,
                facet,
                farther: 0.0,
            });
        }
        let distance = -height / approach;
        let behind = approach.abs() > GRAZING && distance < -self.doubt;
        if (behind && !starts_near) || !weights.may_cross(self.doubtful_weight) {
            return None;
        }
        // So near, the weights may put it on the wrong side of the start.
        let is_clear = distance.is_finite() && distance.abs() > 0.0;
        let t = if is_clear {
            distance
        } else {
            weights.distance()
        };
        self.crossing(facet, ray, weights, t, start)
    }

    /// Where a ray that may cross a triangle on which it does not start does so.
    #[inline(always)]
    fn crossing(
        &self,
        facet: Facet,
        ray: &Ray,
        weights: &Weights,
        t: f64,
        start: &Start,
    ) -> Option<Nearest> {
        let front = weights.front();
        let (margin, farther) = if start.sees(front) {
            (self.slack * LIFT, 0.0)
        } else {
            (0.0, self.slack)
        };
        let is_seen = margin > 0.0;
        let crosses = || weights.crosses(|| self.corners_of(facet), margin);
        let normal = self.normals[facet.index as usize];
        let approach = ray.direction.dot(&normal);
        let (t, meets) = if approach.abs() <= GRAZING {
            let corners = self.corners_of(facet);
            let runs_along = Start::runs_along(approach);
            let meets = if is_seen {
                crosses() || (!runs_along && passes_over(ray, &corners, front, margin))
            } else {
                !runs_along && crosses()
            };
            let t = Plane::new(normal, &corners).over_triangle(t, ray, &corners);
            (t, meets && t > 0.0)
        } else {
            let meets = t > 0.0 && crosses();
            let may_slide_off = meets && !is_seen && weights.is_near_edge();
            (
                t,
                meets && !(may_slide_off && self.slides_off(facet.index, ray, t)),
            )
        };
        meets.then_some(Nearest {
            t,
            front,
            facet,
            farther,
        })
    }
}

/// What the weights of a triangle of this mesh may lose, m², to an edge that a ray passes by a
/// lift: edges as the ray sees them are at most twice as long as they are.
fn doubtful_weight(mesh: &Mesh, slack: f64) -> f64 {
    let longest = mesh.bounds().map_or(0.0, |(low, high)| (high - low).norm());
    2.0 * longest * LIFT * slack
}

/// A triangle and where it is among the bundles.
#[derive(Clone, Copy, Default)]
struct Facet {
    index: u32,
    leaf: u32,
    lane: usize,
}

struct Nearest {
    t: f64,
    front: bool,
    facet: Facet,
    /// Where a ray passes over the edge between a facet that it sees and one that it sees from
    /// behind, the one behind counts as farther.
    farther: f64,
}

impl Nearest {
    #[inline(always)]
    fn cost(&self) -> f64 {
        self.t + self.farther
    }

    /// Takes another crossing that is nearer, or as near and of a triangle with a lower index.
    #[inline(always)]
    fn improve(&mut self, other: Self) {
        let (cost, so_far) = (other.cost(), self.cost());
        if cost < so_far || (cost == so_far && other.facet.index < self.facet.index) {
            *self = other;
        }
    }
}

/// How many slacks the distance to a plane may be off by rounding: far less, for such angles.
const DOUBT: f64 = 16.0;

/// In meshes with more triangles distances share the bundles: parry's better tree over single
/// triangles takes time with the square of those that lie alike, as the facets of a prism do.
const LARGE_MESH: usize = 20_000;

#[cfg(test)]
mod tests;
