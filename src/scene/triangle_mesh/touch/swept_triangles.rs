//! The triangles of a leaf as a moving sphere meets them, four at once: which of them it may touch
//! before what it touches so far.

use nalgebra::{Point3, Vector3};
use wide::f64x4;

use super::contact::{FARTHEST, Sphere, SweptTriangle};
use super::convex_edges::ConvexEdges;
use crate::scene::lanes::splat;

/// The planes of one to four triangles and of their edges.
#[derive(Clone)]
pub(in crate::scene::triangle_mesh) struct SweptTriangles {
    /// Unit normals by coordinate, and distances of the planes from the origin, m.
    normal: [f64x4; 3],
    height: f64x4,
    /// Unit vectors inwards from each edge, by coordinate, and how far along them the triangle
    /// begins, m.
    inward: [[f64x4; 3]; 3],
    begin: [f64x4; 3],
    /// Folds in front and behind; above 0 where there are any.
    folded: [f64x4; 2],
    folds: [ConvexEdges; 4],
    backwards: [u8; 4],
    /// A bit for each triangle without a plane to judge by: it may always be touched.
    unclear: u32,
}

/// A triangle and what was found out about it.
pub(super) struct Ready {
    pub plate: SweptTriangle,
    pub folds: ConvexEdges,
}

/// A [`Sphere`] for four triangles at once.
pub(super) struct WideSphere {
    origin: [f64x4; 3],
    direction: [f64x4; 3],
    radius: f64x4,
    slack: f64x4,
    margin: f64x4,
}

impl WideSphere {
    #[inline(always)]
    pub fn new(sphere: &Sphere) -> Self {
        Self {
            origin: splat(sphere.ray.origin.coords),
            direction: splat(sphere.ray.direction),
            radius: f64x4::splat(sphere.radius),
            slack: f64x4::splat(sphere.slack),
            margin: f64x4::splat(sphere.widest_margin + sphere.slack),
        }
    }
}

/// Which of four triangles a sphere may touch, a bit for each.
pub(super) struct Reached {
    pub touched: u32,
    /// Whether their planes are in reach from the start.
    pub near: u32,
    /// How far the centre travels at least before it may touch each, m.
    pub enters: [f64; 4],
}

#[inline(always)]
fn dot(a: &[f64x4; 3], b: &[f64x4; 3]) -> f64x4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl SweptTriangles {
    pub(super) fn new(ready: &[Ready]) -> Self {
        let mut plates = Self {
            normal: [f64x4::ZERO; 3],
            height: f64x4::ZERO,
            inward: [[f64x4::ZERO; 3]; 3],
            begin: [f64x4::ZERO; 3],
            folded: [f64x4::ZERO; 2],
            folds: [ConvexEdges::ALL; 4],
            backwards: [0; 4],
            unclear: 0,
        };
        for (lane, Ready { plate, folds }) in ready.iter().enumerate() {
            let first = plate.corners[0].coords;
            plates.height.as_mut_array()[lane] = plate.normal.dot(&first);
            for axis in 0..3 {
                plates.normal[axis].as_mut_array()[lane] = plate.normal[axis];
            }
            for (edge, inward) in plate.inward.iter().enumerate() {
                for axis in 0..3 {
                    plates.inward[edge][axis].as_mut_array()[lane] = inward[axis];
                }
                let begin = plate.corners.map(|corner| corner.coords.dot(inward));
                plates.begin[edge].as_mut_array()[lane] = begin[0].min(begin[1]).min(begin[2]);
            }
            plates.folded[0].as_mut_array()[lane] = f64::from(folds.front);
            plates.folded[1].as_mut_array()[lane] = f64::from(folds.behind);
            plates.folds[lane] = *folds;
            plates.backwards[lane] = plate.backwards;
            plates.unclear |= u32::from(!plate.clear) << lane;
        }
        plates
    }

    /// One of the triangles, given its corners.
    #[inline(always)]
    pub(super) fn plate(
        &self,
        lane: usize,
        corners: [Point3<f64>; 3],
    ) -> (SweptTriangle, ConvexEdges) {
        let of = |wide: &[f64x4; 3]| {
            Vector3::new(
                wide[0].as_array()[lane],
                wide[1].as_array()[lane],
                wide[2].as_array()[lane],
            )
        };
        let plate = SweptTriangle {
            corners,
            normal: of(&self.normal),
            inward: [
                of(&self.inward[0]),
                of(&self.inward[1]),
                of(&self.inward[2]),
            ],
            backwards: self.backwards[lane],
            clear: self.unclear >> lane & 1 == 0,
        };
        (plate, self.folds[lane])
    }

    /// Which triangles the sphere may touch within `limit`; with `all_folds` any edge and corner
    /// may be touched.
    #[inline(always)]
    pub(super) fn reached(&self, sphere: &WideSphere, limit: f64, all_folds: bool) -> Reached {
        let (zero, slack) = (f64x4::ZERO, sphere.slack);
        let reach = sphere.radius + slack;
        let height = dot(&self.normal, &sphere.origin) - self.height;
        let approach = dot(&self.normal, &sphere.direction);
        let in_front = height.simd_ge(zero);
        let height = height.abs();
        let sinking = in_front.select(-approach, approach);
        let sinks = sinking.simd_gt(zero);
        let inverse = f64x4::ONE / sinking.abs().fast_max(f64x4::splat(1e-30));
        let near = height.simd_le(reach);

        // When the centre comes to the near side of the body around the triangle, to the plane and
        // to the far side, or back to the near side.
        let gap = height - reach;
        let enters = (gap * inverse).fast_max(zero);
        let limit = f64x4::splat(limit.min(FARTHEST));
        let in_time = (near | sinks) & enters.simd_le(limit);
        if in_time.to_bitmask() == 0 {
            return Reached {
                touched: self.unclear,
                near: self.unclear,
                enters: [0.0; 4],
            };
        }
        let leaves = sinks.select(height + reach, -gap) * inverse;
        let all = f64x4::splat(f64::from(u8::from(all_folds)));
        let here = (in_front.select(self.folded[0], self.folded[1]) + all).simd_gt(zero);
        let beyond = (in_front.select(self.folded[1], self.folded[0]) + all).simd_gt(zero) & sinks;
        let crosses_first = (height - slack) * inverse;
        let crosses_last = (height + slack) * inverse;
        let from = here.select(enters, crosses_first.fast_max(zero));
        let to = (beyond | !sinks)
            .select(leaves, crosses_last)
            .fast_min(limit);
        let mut on_edges = (here | beyond) & from.simd_le(to);

        let face_first = enters;
        let face_last = (height - sphere.radius + slack) * inverse;
        let mut on_face = sinks & face_last.simd_ge(zero);
        for edge in 0..3 {
            let inside = dot(&self.inward[edge], &sphere.origin) - self.begin[edge];
            let faster = dot(&self.inward[edge], &sphere.direction);
            let past = (inside + faster * from).fast_max(inside + faster * to);
            on_edges &= past.simd_ge(-reach);
            let past = (inside + faster * face_first).fast_max(inside + faster * face_last);
            on_face &= past.simd_ge(-sphere.margin);
        }
        let touched = in_time & (on_face | on_edges);
        // A plane that is not clear says nothing about when.
        let enters = if self.unclear == 0 { enters } else { zero };
        Reached {
            enters: enters.to_array(),
            touched: touched.to_bitmask() | self.unclear,
            near: near.to_bitmask() | self.unclear,
        }
    }
}
