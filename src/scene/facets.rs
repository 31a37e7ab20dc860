//! Rays against triangle meshes, over parry's bounding volume hierarchy.
//!
//! parry's own triangle test lets rays through that pass exactly over an edge or a vertex, and a
//! ray cannot be told to ignore the facet that it starts from. So the tree is parry's and the test
//! of a triangle is ours.

use std::ops::Range;

use nalgebra::{Point3, Vector3};
use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhLeafCost};

use super::LIFT;
use super::mesh::{Mesh, Triangle};
use super::ray::{Crossing, Ray, Spot};
use super::start::Start;
use super::triangle::{Shear, lies_on};

/// A mesh that is ready for rays.
#[derive(Clone)]
pub struct Facets {
    tree: Bvh,
    /// Triangles in a leaf of the tree.
    bundle: usize,
    corners: Vec<[u32; 3]>,
    surfaces: Vec<u32>,
    vertices: Vec<Point3<f64>>,
    /// Unit normals on the fronts, and the distances of the planes from the origin, m.
    planes: Vec<(Vector3<f64>, f64)>,
    slack: f64,
    /// Rounding of a plane's crossing distance stays below this for rays that do not graze it.
    doubt: f64,
}

impl Facets {
    /// Prepares a mesh whose surfaces have the indices `surface_base` onwards. `slack` is the
    /// distance within which two points count as one, m.
    pub fn new(mesh: Mesh, surface_base: u32, slack: f64) -> Self {
        let mut mesh = mesh;
        let bundle = if mesh.triangles.len() > LARGE_MESH {
            order_along_curve(&mut mesh);
            BUNDLE
        } else {
            1
        };
        let boxes = mesh.triangles.chunks(bundle).map(|triangles| {
            let corners = triangles.iter().flat_map(|triangle| mesh.corners(triangle));
            let bounds = Aabb::from_points(corners.map(|corner| corner.coords.into()));
            bounds.loosened(slack)
        });
        Self {
            tree: Bvh::from_iter(BvhBuildStrategy::Ploc, boxes.enumerate()),
            bundle,
            corners: mesh.triangles.iter().map(|t| t.corners).collect(),
            surfaces: mesh
                .triangles
                .iter()
                .map(|t| surface_base + t.surface)
                .collect(),
            planes: mesh.triangles.iter().map(|t| plane(&mesh, t)).collect(),
            vertices: mesh.vertices,
            slack,
            doubt: DOUBT * slack,
        }
    }

    /// Number of triangles.
    pub fn count(&self) -> usize {
        self.corners.len()
    }

    /// parry's tree over bundles of triangles, for other walks than rays.
    pub(super) fn tree(&self) -> &Bvh {
        &self.tree
    }

    /// The triangles in a leaf of the tree.
    pub(super) fn bundle(&self, leaf: u32) -> Range<u32> {
        let first = leaf as usize * self.bundle;
        first as u32..(first + self.bundle).min(self.count()) as u32
    }

    /// The corner points of a triangle.
    pub fn corners(&self, index: u32) -> [Point3<f64>; 3] {
        self.corners[index as usize].map(|corner| self.vertices[corner as usize])
    }

    /// The surface of a triangle.
    pub fn surface(&self, index: u32) -> u32 {
        self.surfaces[index as usize]
    }

    /// The first crossing of a ray nearer than `limit`, and the front normal there.
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
        let start = Start {
            piece: leaving.filter(|_| on_this_part).map(|spot| spot.piece),
            front: leaving.map(|spot| spot.front),
        };
        let shear = Shear::new(ray);
        let origin: Vector = ray.origin.coords.into();
        let inverse = Vector::from(<[f64; 3]>::from(ray.direction).map(reciprocal));
        let (_, found) = self.tree.find_best(
            limit,
            |node, _| {
                let (mins, maxs) = (node.mins(), node.maxs());
                let mut near = f64::NEG_INFINITY;
                let mut far = f64::INFINITY;
                for axis in 0..3 {
                    let a = (mins[axis] - origin[axis]) * inverse[axis];
                    let b = (maxs[axis] - origin[axis]) * inverse[axis];
                    near = larger(near, smaller(a, b));
                    far = smaller(far, larger(a, b));
                }
                // The factor covers the rounding of the products above.
                if far * (1.0 + 4.0 * f64::EPSILON) >= near && far >= 0.0 {
                    near
                } else {
                    f64::MAX
                }
            },
            |leaf, nearest| {
                let mut best: Option<Nearest> = None;
                for index in self.bundle(leaf) {
                    let limit = best.as_ref().map_or(nearest, Nearest::cost);
                    best = self.crossing(index, ray, &shear, &start, limit).or(best);
                }
                best
            },
        )?;
        let Nearest {
            t, front, index, ..
        } = found;
        let (normal, _) = self.planes[index as usize];
        Some((
            Crossing {
                distance: t,
                front,
                piece: index,
                surface: self.surface(index),
            },
            normal,
        ))
    }

    /// Where a ray crosses one triangle, if that is nearer than `limit`.
    #[inline]
    fn crossing(
        &self,
        index: u32,
        ray: &Ray,
        shear: &Shear,
        start: &Start,
        limit: f64,
    ) -> Option<Nearest> {
        if start.piece == Some(index) {
            return None;
        }
        let (normal, offset) = &self.planes[index as usize];
        let height = ray.origin.coords.dot(normal) - offset;
        let approach = ray.direction.dot(normal);
        let starts_near = start.front.is_some() && height.abs() <= self.slack;
        if !starts_near && approach.abs() > GRAZING {
            let t = -height / approach;
            if t < -self.doubt || t > limit + self.doubt {
                return None;
            }
        }
        let corners = self.corners(index);
        if starts_near && lies_on(&ray.origin, &corners, self.slack) {
            return start.enters(approach).then_some(Nearest {
                t: 0.0,
                front: approach < 0.0,
                index,
                farther: 0.0,
            });
        }
        let (t, front) = shear.crossing(&corners, |front| {
            if start.sees(front) {
                self.slack * LIFT
            } else {
                0.0
            }
        })?;
        let farther = if start.sees(front) { 0.0 } else { self.slack };
        (t > 0.0 && t + farther < limit).then_some(Nearest {
            t,
            front,
            index,
            farther,
        })
    }
}

/// Sine of the angle between ray and facet below which distances are left to the exact test.
const GRAZING: f64 = 1e-3;
/// How many slacks the distance to a plane may be off by rounding: far less, for such angles.
const DOUBT: f64 = 16.0;

/// The plane of a triangle: its unit normal and its distance from the origin along it.
fn plane(mesh: &Mesh, triangle: &Triangle) -> (Vector3<f64>, f64) {
    let normal = mesh.doubled_area(triangle).normalize();
    (normal, mesh.centre(triangle).coords.dot(&normal))
}

/// Meshes with more triangles share leaves, which takes a quarter of the memory.
const LARGE_MESH: usize = 200_000;
/// Triangles in a leaf of a large mesh.
const BUNDLE: usize = 4;

/// Brings triangles that lie near each other together, along a Morton curve.
fn order_along_curve(mesh: &mut Mesh) {
    let Some((low, high)) = mesh.bounds() else {
        return;
    };
    let extent = (high - low).max().max(f64::MIN_POSITIVE);
    let mut triangles = std::mem::take(&mut mesh.triangles);
    triangles.sort_by_cached_key(|triangle| {
        let place = (mesh.centre(triangle) - low) / extent;
        place
            .map(|share| spread_bits((share * MORTON_CELLS) as u32))
            .iter()
            .enumerate()
            .fold(0_u64, |code, (axis, bits)| code | bits << axis)
    });
    mesh.triangles = triangles;
}

/// Cells of the Morton curve along an axis.
const MORTON_CELLS: f64 = ((1 << 21) - 1) as f64;

/// Puts two zero bits before each of the lowest 21 bits.
fn spread_bits(cell: u32) -> u64 {
    let mut bits = u64::from(cell);
    bits = (bits | bits << 32) & 0x001F_0000_0000_FFFF;
    bits = (bits | bits << 16) & 0x001F_0000_FF00_00FF;
    bits = (bits | bits << 8) & 0x100F_00F0_0F00_F00F;
    bits = (bits | bits << 4) & 0x10C3_0C30_C30C_30C3;
    (bits | bits << 2) & 0x1249_2492_4924_9249
}

struct Nearest {
    t: f64,
    front: bool,
    index: u32,
    /// Where a ray passes over the edge between a facet that it sees and one that it sees from
    /// behind, the one behind counts as farther.
    farther: f64,
}

impl BvhLeafCost for Nearest {
    fn cost(&self) -> f64 {
        self.t + self.farther
    }
}

/// The smaller of two numbers; unlike `f64::min` a single instruction, as there is no NaN here.
#[inline]
fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The larger of two numbers, likewise.
#[inline]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// 1/x without an infinity, so that 0 times it stays 0 in the box test.
fn reciprocal(x: f64) -> f64 {
    if x.abs() < 1e-200 {
        1e200_f64.copysign(x)
    } else {
        1.0 / x
    }
}
