//! The box round a mesh: in a scene of several parts most rays pass by most of them.

use nalgebra::Point3;

use crate::scene::lanes::{LANES, larger, padded, smaller};
use crate::scene::mesh::Mesh;
use crate::scene::rays::{Hits, Rays};

/// The box round a mesh.
#[derive(Clone, Copy)]
pub(super) struct BoundingBox {
    low: Point3<f64>,
    high: Point3<f64>,
    /// By how much shots may miss it, m.
    margin: f64,
}

impl BoundingBox {
    /// Of a mesh, loosened by `slack` (m).
    pub fn of(mesh: &Mesh, slack: f64) -> Self {
        let (low, high) = mesh.bounds().unwrap_or_default();
        let margin = 2.0 * slack;
        Self { low, high, margin }
    }

    /// The same with more room all round, by a share of its longest side.
    pub fn grown(&self, share: f64) -> Self {
        let margin = self.margin + share * (self.high - self.low).max();
        Self { margin, ..*self }
    }

    /// Of each ray whether it comes to the box before it meets what it has hit so far: shots that have a size as soon as
    /// they touch it.
    #[inline(always)]
    pub fn reached(&self, rays: &Rays, hits: &Hits) -> [bool; LANES] {
        let mut reached = [false; LANES];
        for (index, reached) in reached.iter_mut().take(padded(rays.count)).enumerate() {
            let radius = if rays.are_spheres {
                rays.radius[index]
            } else {
                0.0
            };
            let (mut first, mut last) = (0.0, hits.distance[index]);
            for axis in 0..3 {
                let origin = rays.origin[axis][index];
                let margin = radius + self.margin + origin.abs() * ROUNDING;
                let inverse = 1.0 / rays.direction[axis][index];
                let low = (self.low[axis] - margin - origin) * inverse;
                let high = (self.high[axis] + margin - origin) * inverse;
                // A ray along a side of this box, for which one of them is not a number, is beside the mesh.
                first = larger(smaller(low, high), first);
                last = smaller(larger(low, high), last);
            }
            *reached = first <= last;
        }
        reached
    }
}

/// By more than what share of the coordinates the places where a ray meets the sides may be off.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::jet::sobol;
    use crate::scene::lanes::put;
    use crate::scene::tessellate;
    use crate::scene::triangle_mesh::TriangleMesh;

    const SLACK: f64 = 1e-12;
    const RADIUS: f64 = 0.2;

    fn block() -> TriangleMesh {
        let low = Point3::new(-1.0, 2.0, -0.5);
        let mesh = tessellate::block(low, low + Vector3::new(3.0, 1.0, 2.0));
        TriangleMesh::new(mesh, 0, SLACK)
    }

    /// Whether each of some shots comes to the block within a distance, and whether it may by its box.
    fn compared(shots: &[([f64; 3], [f64; 3])], within: f64) -> Vec<(bool, bool)> {
        let block = block();
        let (mut rays, mut hits) = (Rays::none(), Hits::none());
        rays.count = shots.len();
        rays.are_spheres = true;
        rays.radius = [RADIUS; LANES];
        hits.distance = [within; LANES];
        for (index, &(origin, direction)) in shots.iter().enumerate() {
            put(&mut rays.origin, index, origin);
            let direction = Vector3::from(direction).normalize();
            put(&mut rays.direction, index, direction.into());
        }
        let reached = block.bounding_box.reached(&rays, &hits);
        let touches = |index| {
            let touch = block.first_touch(&rays.at(index), RADIUS, None, false, within);
            touch.is_some()
        };
        (0..shots.len())
            .map(|index| (touches(index), reached[index]))
            .collect()
    }

    #[test]
    fn shots_that_touch_a_block_come_to_its_box() {
        let (mut touching, mut passing) = (0, 0);
        for first in 0..40 {
            let shot = |index: u32| {
                let spread = |axis| 12.0 * sobol(first * 100 + index, axis, 5) - 6.0;
                ([0, 1, 2].map(spread), [3, 4, 5].map(spread))
            };
            let shots: Vec<_> = (0..100).map(shot).collect();
            for (touches, comes) in compared(&shots, 5.0) {
                assert!(comes || !touches);
                touching += u32::from(touches);
                passing += u32::from(!comes);
            }
        }
        // Few come to the box and miss its edges and corners.
        assert!(
            touching > 100 && touching + passing > 3_900,
            "{touching} {passing}"
        );
    }

    #[test]
    fn shots_that_graze_a_side_come_to_the_box_and_those_beside_it_do_not() {
        let beside = 2.0 - RADIUS;
        for (height, comes) in [
            (beside + 1e-9, true),
            (beside, true),
            (beside - 1e-9, false),
        ] {
            let along = ([-5.0, height, 0.3], [1.0, 0.0, 0.0]);
            let away = ([0.0, height, 0.3], [0.0, -1.0, 0.0]);
            let found = compared(&[along, away], f64::INFINITY);
            assert_eq!([found[0].1, found[1].1], [comes; 2], "{height}");
        }
        // What is met before is nearer.
        let ahead = ([-5.0, 2.5, 0.3], [1.0, 0.0, 0.0]);
        let gap = 4.0 - RADIUS;
        assert_eq!(compared(&[ahead], gap - 1e-9), [(false, false)]);
        assert_eq!(compared(&[ahead], gap + 1e-9), [(true, true)]);
    }
}
