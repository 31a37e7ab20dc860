//! Rays against triangle meshes, over parry's bounding volume hierarchy.
//!
//! parry's own triangle test lets rays through that pass exactly over an edge or a vertex, and a
//! ray cannot be told to ignore the facet that it starts from. So the tree is parry's and the test
//! is the watertight one of Woop, Benthin and Wald (Journal of Computer Graphics Techniques 2,
//! 2013), in f64: two facets that share an edge compute the same number for it, with opposite
//! signs, so no ray slips between them.

use nalgebra::{Point3, Vector3};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy, BvhLeafCost};

use super::LIFT;
use super::mesh::Mesh;
use super::prism::Start;
use super::ray::{Crossing, Ray, Spot};

/// A mesh that is ready for rays.
#[derive(Clone)]
pub struct Facets {
    tree: Bvh,
    corners: Vec<[u32; 3]>,
    surfaces: Vec<u32>,
    vertices: Vec<Point3<f64>>,
    slack: f64,
}

impl Facets {
    /// Prepares a mesh whose surfaces have the indices `surface_base` onwards. `slack` is the
    /// distance within which two points count as one, m.
    pub fn new(mesh: Mesh, surface_base: u32, slack: f64) -> Self {
        let boxes: Vec<Aabb> = mesh
            .triangles
            .iter()
            .map(|triangle| {
                let [a, b, c] = mesh.corners(triangle);
                let low = a.coords.inf(&b.coords).inf(&c.coords).add_scalar(-slack);
                let high = a.coords.sup(&b.coords).sup(&c.coords).add_scalar(slack);
                Aabb::new(low.into(), high.into())
            })
            .collect();
        Self {
            tree: Bvh::from_leaves(BvhBuildStrategy::Ploc, &boxes),
            corners: mesh.triangles.iter().map(|t| t.corners).collect(),
            surfaces: mesh
                .triangles
                .iter()
                .map(|t| surface_base + t.surface)
                .collect(),
            vertices: mesh.vertices,
            slack,
        }
    }

    /// Number of triangles.
    pub fn count(&self) -> usize {
        self.corners.len()
    }

    /// parry's tree over the triangles, for other walks than rays.
    pub(super) fn tree(&self) -> &Bvh {
        &self.tree
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
        let (index, Nearest { t, front, .. }) = self.tree.find_best(
            limit,
            |node, _| {
                let (a, b) = (
                    (node.mins() - origin) * inverse,
                    (node.maxs() - origin) * inverse,
                );
                let (near, far) = (a.min(b).max_element(), a.max(b).min_element());
                // The factor covers the rounding of the products above.
                if far * (1.0 + 4.0 * f64::EPSILON) >= near && far >= 0.0 {
                    near
                } else {
                    f64::MAX
                }
            },
            |index, nearest| {
                if start.piece == Some(index) {
                    return None;
                }
                let corners = self.corners(index);
                if start.front.is_some() && lies_on(&ray.origin, &corners, self.slack) {
                    let [a, b, c] = corners;
                    let approach = ray.direction.dot(&(b - a).cross(&(c - a)));
                    return start.enters(approach).then_some(Nearest {
                        t: 0.0,
                        front: approach < 0.0,
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
                (t > 0.0 && t + farther < nearest).then_some(Nearest { t, front, farther })
            },
        )?;
        let [a, b, c] = self.corners(index);
        let normal = (b - a).cross(&(c - a)).normalize();
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
}

/// Whether a point is within `slack` of a triangle.
#[inline]
fn lies_on(point: &Point3<f64>, corners: &[Point3<f64>; 3], slack: f64) -> bool {
    let [a, b, c] = *corners;
    let apart = |axis: usize| {
        let (low, high) = (
            a[axis].min(b[axis]).min(c[axis]),
            a[axis].max(b[axis]).max(c[axis]),
        );
        point[axis] < low - slack || point[axis] > high + slack
    };
    if apart(0) || apart(1) || apart(2) {
        return false;
    }
    let area_normal = (b - a).cross(&(c - a));
    let twice_area = area_normal.norm();
    let inside = |from: Point3<f64>, to: Point3<f64>| {
        let edge = to - from;
        edge.cross(&(point - from)).dot(&area_normal) >= -slack * edge.norm() * twice_area
    };
    (point - a).dot(&area_normal).abs() <= slack * twice_area
        && inside(a, b)
        && inside(b, c)
        && inside(c, a)
}

struct Nearest {
    t: f64,
    front: bool,
    /// Where a ray passes over the edge between a facet that it sees and one that it sees from
    /// behind, the one behind counts as farther.
    farther: f64,
}

impl BvhLeafCost for Nearest {
    fn cost(&self) -> f64 {
        self.t + self.farther
    }
}

/// 1/x without an infinity, so that 0 times it stays 0 in the box test.
fn reciprocal(x: f64) -> f64 {
    if x.abs() < 1e-200 {
        1e200_f64.copysign(x)
    } else {
        1.0 / x
    }
}

/// The change of coordinates that turns a ray into the positive z axis.
struct Shear {
    origin: Vector3<f64>,
    axes: [usize; 3],
    shear: [f64; 3],
}

impl Shear {
    fn new(ray: &Ray) -> Self {
        let direction = ray.direction;
        let z = direction.iamax();
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        if direction[z] < 0.0 {
            std::mem::swap(&mut x, &mut y);
        }
        Self {
            origin: ray.origin.coords,
            axes: [x, y, z],
            shear: [
                direction[x] / direction[z],
                direction[y] / direction[z],
                1.0 / direction[z],
            ],
        }
    }

    /// Signed distance to the plane of the triangle where the ray's line crosses the triangle, or
    /// passes its edges by at most the margin of that side, and whether it crosses from the front.
    #[inline]
    fn crossing(
        &self,
        corners: &[Point3<f64>; 3],
        margin: impl Fn(bool) -> f64,
    ) -> Option<(f64, bool)> {
        let [x, y, z] = self.axes;
        let sheared = corners.map(|corner| {
            let p = corner.coords - self.origin;
            [
                p[x] - self.shear[0] * p[z],
                p[y] - self.shear[1] * p[z],
                self.shear[2] * p[z],
            ]
        });
        let [a, b, c] = sheared;
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        let outside = (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0);
        let determinant = u + v + w;
        let front = determinant > 0.0;
        if determinant == 0.0 || outside && beyond(corners, [u, v, w], determinant, margin(front)) {
            return None;
        }
        let t = (u * a[2] + v * b[2] + w * c[2]) / determinant;
        Some((t, front))
    }
}

/// Whether a point of a triangle's plane, given by its barycentric coordinates times
/// `determinant`, lies beyond an edge by more than `margin`.
#[inline]
fn beyond(corners: &[Point3<f64>; 3], weights: [f64; 3], determinant: f64, margin: f64) -> bool {
    // Far enough for any triangle that is higher than a million margins.
    const CLEARLY: f64 = -1e-6;
    let shares = weights.map(|weight| weight / determinant);
    if shares.iter().any(|&share| share < CLEARLY) {
        return true;
    }
    let [a, b, c] = *corners;
    let twice_area = (b - a).cross(&(c - a)).norm();
    let opposite = [c - b, a - c, b - a];
    let mut sides = shares.iter().zip(opposite);
    sides.any(|(share, edge)| share * twice_area < -margin * edge.norm())
}
