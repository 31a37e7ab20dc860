//! Moving spheres against triangle meshes.

mod contact;
mod convex_edges;
mod hubs;
mod swept_triangles;

use nalgebra::{Point3, Vector3};

use super::TriangleMesh;
use crate::scene::LIFT;
use crate::scene::ray::{Crossing, HitId, Ray};
use contact::{Placed, Sphere, SweptTriangle, Touch};
use convex_edges::{CLEAR_FOLD, ConvexEdges};
use hubs::Hubs;
use swept_triangles::{Ready, SweptTriangles, WideSphere};

/// What spheres need to know of a mesh besides its bundles.
#[derive(Clone)]
pub(super) struct Touchable {
    /// The triangles of each bundle.
    plates: Vec<SweptTriangles>,
    hubs: Option<Hubs>,
}

impl TriangleMesh {
    /// The first contact of a sphere of `radius` (m) whose centre moves along `ray`, nearer than
    /// `limit`; and the unit normal there, from the point of contact to the centre.
    ///
    /// The distance is that which the centre travels, and the front that on which the centre is
    /// then. Faces come before edges and corners within the slack, then of touches at the same
    /// distance the triangle whose normal is nearer, then the one with the lowest index.
    ///
    /// A triangle that the sphere touches or overlaps at its start is hit at once if the centre
    /// heads towards it, and never otherwise: the distance to it, a convex body, then only grows.
    /// The piece of `leaving`, if it is `on_this_part`, is not hit, unless it was left at an edge and the
    /// sphere heads into the face beside that.
    #[inline(always)]
    pub fn first_touch(
        &self,
        ray: &Ray,
        radius: f64,
        leaving: Option<HitId>,
        on_this_part: bool,
        limit: f64,
    ) -> Option<(Crossing, Vector3<f64>)> {
        let touchable = self.touchable.get_or_init(|| self.build_touchable());
        let mut search = Search {
            facets: self,
            touchable,
            sphere: Sphere::new(ray, radius, self.slack),
            left: leaving.filter(|_| on_this_part).map(|hit_id| hit_id.piece),
            // In a clear fold, spheres of this size are far enough off one face when they come to
            // the other: rounding cannot make them miss both.
            all_folds: radius * (CLEAR_FOLD * CLEAR_FOLD / 4.0) <= self.slack,
            overlaps: false,
        };
        let mut first = search.run(limit);
        if search.overlaps {
            // What stands out and what does not counts for spheres that start outside.
            search.all_folds = true;
            first = search.run(limit);
        }
        first.map(|Found { touch, index }| {
            let crossing = Crossing {
                distance: touch.distance,
                above: 0.0,
                front: touch.front,
                piece: index,
                surface: self.surface(index),
            };
            (crossing, touch.normal)
        })
    }

    /// The same with the unit normal on the front, as that of crossings is.
    #[inline(always)]
    pub fn first_contact(
        &self,
        ray: &Ray,
        radius: f64,
        leaving: Option<HitId>,
        on_this_part: bool,
        limit: f64,
    ) -> Option<(Crossing, Vector3<f64>)> {
        let (crossing, normal) = self.first_touch(ray, radius, leaving, on_this_part, limit)?;
        Some((crossing, if crossing.front { normal } else { -normal }))
    }

    /// On one thread: made behind a lock, where a thread that shares work out may take up other work
    /// that waits for the same lock.
    fn build_touchable(&self) -> Touchable {
        let flat = LIFT * self.slack;
        let shapes: Vec<SweptTriangle> = (0..self.count() as u32)
            .map(|index| plate(self.corners(index), self.corners[index as usize], flat))
            .collect();
        let clear: Vec<bool> = shapes.iter().map(|plate| plate.clear).collect();
        let folds = convex_edges::folds(&self.vertices, &self.corners, &clear, flat);
        let ready = |&index: &u32| Ready {
            plate: shapes[index as usize],
            folds: folds[index as usize],
        };
        let bundles = self.bundles.iter();
        let plates = bundles.map(|bundle| {
            let triangles: Vec<Ready> = bundle.triangles().iter().map(ready).collect();
            SweptTriangles::new(&triangles)
        });
        Touchable {
            plates: plates.collect(),
            hubs: Hubs::new(
                &self.vertices,
                &self.corners,
                &self.surfaces,
                &self.tree,
                &self.bundles,
            ),
        }
    }
}

/// A touch of a triangle.
struct Found {
    touch: Touch,
    index: u32,
}

impl Found {
    /// Whether this one counts and not another one at the same distance.
    fn comes_before(&self, other: &Self) -> bool {
        let (here, there) = (self.touch.facing, other.touch.facing);
        here > there || (here == there && self.index < other.index)
    }
}

/// The search for what a sphere touches first.
struct Search<'a> {
    facets: &'a TriangleMesh,
    touchable: &'a Touchable,
    sphere: Sphere<'a>,
    left: Option<u32>,
    /// Whether edges and corners count that do not stand out.
    all_folds: bool,
    /// Whether the sphere was found to overlap a triangle at its start.
    overlaps: bool,
}

impl Search<'_> {
    #[inline(always)]
    fn run(&mut self, limit: f64) -> Option<Found> {
        let Sphere {
            ray, radius, slack, ..
        } = self.sphere;
        let wide = WideSphere::new(&self.sphere);
        let mut best: Option<Found> = None;
        let mut cost = limit;
        let tree = &self.facets.tree;
        let flat = tree.flat_sphere(ray, radius);
        let mut walk = tree.walk(&flat);
        walk.start(&tree.entered(&flat, limit));
        let hubs = self.touchable.hubs.as_ref();
        if let Some((hubs, left)) = hubs.zip(self.left)
            && let Some(mark) = hubs.left(left, ray, radius, slack)
        {
            walk.pass_by(&hubs.marks, mark);
        }
        while let Some((leaf, starts_inside)) = walk.next() {
            let bundle = &self.facets.bundles[leaf as usize];
            let plates = &self.touchable.plates[leaf as usize];
            let reached = plates.reached(&wide, cost, self.all_folds);
            let near = if starts_inside && reached.near != 0 {
                reached.near & bundle.near(&ray.origin, radius + slack)
            } else {
                0
            };
            let mut lanes = (reached.touched | near) & bundle.occupied();
            while lanes != 0 {
                let lane = lanes.trailing_zeros() as usize;
                lanes &= lanes - 1;
                let index = bundle.triangles()[lane];
                if reached.enters[lane] > cost {
                    continue;
                }
                let near = near >> lane & 1 == 1;
                let (plate, folds) = plates.plate(lane, bundle.corners(lane));
                if let Some(touch) = self.touch(&plate, folds, index, near, cost) {
                    let farther = if touch.on_face { 0.0 } else { slack };
                    let other = touch.distance + farther;
                    let found = Found { touch, index };
                    let comes_first = best.as_ref().is_some_and(|best| found.comes_before(best));
                    if other < cost || (other == cost && comes_first) {
                        cost = other;
                        walk.end_at(cost);
                        let there = ray.origin + ray.direction * found.touch.distance;
                        if let Some(hubs) = hubs
                            && let Some(mark) = hubs.reached(index, &there, radius, slack)
                        {
                            walk.pass_by(&hubs.marks, mark);
                        }
                        best = Some(found);
                    }
                }
            }
        }
        best
    }

    /// Where the sphere touches a triangle; it need not be told of touches beyond `limit`.
    #[inline(always)]
    fn touch(
        &mut self,
        plate: &SweptTriangle,
        folds: ConvexEdges,
        index: u32,
        near: bool,
        limit: f64,
    ) -> Option<Touch> {
        let folds = if self.all_folds {
            ConvexEdges::ALL
        } else {
            folds
        };
        let placed = if near {
            self.sphere.placed(plate, folds)
        } else {
            Placed::Apart
        };
        self.overlaps |= matches!(placed, Placed::Overlapping);
        if self.left == Some(index) {
            return match placed {
                Placed::Touching(touch) => touch.filter(|touch| self.sphere.is_another(touch)),
                Placed::Apart | Placed::Overlapping => None,
            };
        }
        match placed {
            Placed::Apart => self.sphere.touch(plate, folds, limit),
            Placed::Touching(touch) => touch,
            Placed::Overlapping => None,
        }
    }
}

/// A triangle as spheres meet it, clear if rounding moves its plane by less than `flat` (m) at its
/// corners.
fn plate(corners: [Point3<f64>; 3], vertices: [u32; 3], flat: f64) -> SweptTriangle {
    let edges = [0, 1, 2].map(|corner| corners[(corner + 1) % 3] - corners[corner]);
    let lengths = edges.map(|edge| edge.norm());
    // The two shorter edges tell the plane best.
    let longest = (0..3).fold(0, |longest, edge| {
        if lengths[edge] > lengths[longest] {
            edge
        } else {
            longest
        }
    });
    let [one, other] = [(longest + 1) % 3, (longest + 2) % 3];
    let area_normal = edges[one].cross(&edges[other]);
    let doubled_area = area_normal.norm();
    let tilt = f64::EPSILON * lengths[one] * lengths[other] / doubled_area;
    let has_plane = tilt < WORST_TILT;
    let normal = if has_plane {
        area_normal / doubled_area
    } else {
        Vector3::zeros()
    };
    let clear = has_plane && tilt * lengths[longest] <= flat;
    SweptTriangle {
        corners,
        normal,
        clear,
        inward: edges.map(|edge| normal.cross(&edge).try_normalize(0.0).unwrap_or_default()),
        backwards: (0..3).fold(0, |bits, corner| {
            let backwards = vertices[corner] > vertices[(corner + 1) % 3];
            bits | u8::from(backwards) << corner
        }),
    }
}

/// Triangles whose normals may be off by more than this (rad) have no plane.
const WORST_TILT: f64 = 1e-4;

#[cfg(test)]
mod tests;
