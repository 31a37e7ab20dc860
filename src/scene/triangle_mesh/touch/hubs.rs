//! Corners at which many triangles meet.
//!
//! A sphere that touches a cone at its tip touches all triangles there, none sooner than another. It is
//! enough to look at one of them where the others are known to be no nearer.

use nalgebra::{Point3, Vector3};

use crate::elementary::{asin, cos};
use crate::scene::bvh8::{Bvh8, Marks};
use crate::scene::ray::Ray;
use crate::scene::triangle_packet::TrianglePacket;

/// So many triangles are many.
const MANY: usize = 64;
/// A sphere has to be by so much (rad) inside the cone over a tip: rounding does not take it out of that,
/// nor does a face count as touched from there.
const INSIDE: f64 = 1e-3;

/// The tip of a cone of triangles.
#[derive(Clone)]
struct Hub {
    tip: Point3<f64>,
    /// Unit vector out of the cone.
    axis: Vector3<f64>,
    /// The tip is the point of all triangles nearest to whatever is over it within this angle of the axis.
    least_cosine: f64,
}

/// The tips of a mesh at which many triangles of one surface meet.
#[derive(Clone)]
pub(super) struct Hubs {
    hubs: Vec<Hub>,
    /// The hub of each triangle, if it has one.
    of_triangles: Vec<u32>,
    /// Marks the leaves whose triangles are all of one hub.
    pub marks: Marks,
}

impl Hubs {
    /// `None` if a mesh has none; `surfaces` are those of its triangles.
    pub fn new(
        vertices: &[Point3<f64>],
        triangles: &[[u32; 3]],
        surfaces: &[u32],
        tree: &Bvh8,
        bundles: &[TrianglePacket],
    ) -> Option<Self> {
        let mut counts = vec![0_usize; vertices.len()];
        for &corner in triangles.iter().flatten() {
            counts[corner as usize] += 1;
        }
        let mut fans: Vec<(u32, u32)> = Vec::new();
        for (index, corners) in (0..).zip(triangles) {
            let with_many = |corner: &u32| counts[*corner as usize] >= MANY;
            let corners = corners.iter().copied().filter(with_many);
            if let Some(most) = corners.max_by_key(|&corner| (counts[corner as usize], corner)) {
                fans.push((most, index));
            }
        }
        fans.sort_unstable();
        let mut hubs = Vec::new();
        let mut of_triangles = vec![Marks::NONE; triangles.len()];
        for fan in fans.chunk_by(|one, other| one.0 == other.0) {
            let tip = vertices[fan[0].0 as usize];
            let of_fan = || fan.iter().map(|&(_, triangle)| triangle as usize);
            let surface = surfaces[fan[0].1 as usize];
            if of_fan().any(|triangle| surfaces[triangle] != surface) {
                continue;
            }
            let ends = of_fan().flat_map(|triangle| triangles[triangle]);
            let edges = ends.map(|end| vertices[end as usize] - tip);
            if let Some(hub) = Hub::new(tip, edges) {
                of_fan().for_each(|triangle| of_triangles[triangle] = hubs.len() as u32);
                hubs.push(hub);
            }
        }
        if hubs.is_empty() {
            return None;
        }
        let mark = |bundle: &TrianglePacket| {
            let mut hubs = bundle
                .triangles()
                .iter()
                .map(|&it| of_triangles[it as usize]);
            let first = hubs.next().unwrap_or(Marks::NONE);
            if hubs.all(|hub| hub == first) {
                first
            } else {
                Marks::NONE
            }
        };
        Some(Self {
            marks: tree.marks(bundles.iter().map(mark).collect()),
            hubs,
            of_triangles,
        })
    }

    /// The mark of the leaves that have nothing for a sphere of `radius` (m) which heads for a triangle and
    /// touches it when its centre is there: it touches the tip before anything else of them.
    pub fn reached(
        &self,
        triangle: u32,
        centre: &Point3<f64>,
        radius: f64,
        slack: f64,
    ) -> Option<u32> {
        let mark = self.of_triangles[triangle as usize];
        let hub = self.hubs.get(mark as usize)?;
        let offset = centre - hub.tip;
        let distance = offset.norm();
        let touches = (distance - radius).abs() <= slack;
        let is_over = offset.dot(&hub.axis) >= hub.least_cosine * distance;
        (touches && is_over).then_some(mark)
    }

    /// The same for a sphere that leaves a triangle along a ray.
    pub fn left(&self, triangle: u32, ray: &Ray, radius: f64, slack: f64) -> Option<u32> {
        let mark = self.reached(triangle, &ray.origin, radius, slack)?;
        let offset = ray.origin - self.hubs[mark as usize].tip;
        (ray.direction.dot(&offset) >= 0.0).then_some(mark)
    }
}

impl Hub {
    /// `None` where every sphere touches a face or an edge sooner than the tip.
    fn new(tip: Point3<f64>, edges: impl Iterator<Item = Vector3<f64>> + Clone) -> Option<Self> {
        let edges = edges.filter_map(|edge| edge.try_normalize(0.0));
        let axis = -edges.clone().sum::<Vector3<f64>>().try_normalize(0.0)?;
        let highest = edges.map(|edge| edge.dot(&axis)).fold(-1.0, f64::max);
        // As far as the steepest edge is turned away from the axis by more than a right angle.
        let widest = asin(-highest) - INSIDE;
        (widest > 0.0).then_some(Self {
            tip,
            axis,
            least_cosine: cos(widest),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::mesh::{Mesh, Triangle};
    use crate::scene::triangle_mesh::TriangleMesh;

    const SLACK: f64 = 1e-12;

    /// The hubs of a cone of this many triangles with its tip at this height, each of a surface.
    fn hubs(count: u32, height: f64, surface: impl Fn(u32) -> u32) -> Option<Hubs> {
        let rim = |place: u32| {
            let angle = std::f64::consts::TAU * f64::from(place) / f64::from(count);
            Point3::new(angle.cos(), angle.sin(), 0.0)
        };
        let triangle = |index: u32| Triangle {
            corners: [index, (index + 1) % count, count],
            surface: surface(index),
        };
        let mut vertices: Vec<_> = (0..count).map(rim).collect();
        vertices.push(Point3::new(0.0, 0.0, height));
        let mesh = Mesh {
            vertices,
            triangles: (0..count).map(triangle).collect(),
            ..Mesh::default()
        };
        TriangleMesh::new(mesh, 0, SLACK).build_touchable().hubs
    }

    #[test]
    fn tips_of_many_triangles_of_one_surface_are_hubs() {
        let count = MANY as u32;
        assert!(hubs(count, 0.5, |_| 0).is_some());
        assert!(hubs(count - 1, 0.5, |_| 0).is_none());
        assert!(hubs(count, 0.5, |index| index / 40).is_none());
        assert!(hubs(count, 0.0, |_| 0).is_none(), "it is flat");
    }

    /// Edges fall by 45 degrees: so far from the axis the tip is the nearest point of all.
    #[test]
    fn spheres_over_a_tip_pass_its_triangles() {
        let hubs = hubs(100, 1.0, |_| 0).expect("it has a tip");
        let (radius, tip) = (0.1, Point3::new(0.0, 0.0, 1.0));
        for (degrees, gap, is_at_tip) in [
            (0.0, 0.0, true),
            (44.8, 0.0, true),
            (45.2, 0.0, false),
            (180.0, 0.0, false),
            (10.0, 2.0 * SLACK, false),
            (10.0, -2.0 * SLACK, false),
        ] {
            let (sine, cosine) = f64::to_radians(degrees).sin_cos();
            let offset = Vector3::new(sine, 0.0, cosine) * (radius + gap);
            let centre = tip + offset;
            let reached = hubs.reached(7, &centre, radius, SLACK);
            assert_eq!(reached.is_some(), is_at_tip, "{degrees}, {gap}");
            for (direction, leaves) in [(offset, true), (-offset, false)] {
                let direction = direction.normalize();
                let origin = centre;
                let left = hubs.left(7, &Ray { origin, direction }, radius, SLACK);
                assert_eq!(left.is_some(), is_at_tip && leaves, "{degrees}, {gap}");
            }
        }
    }
}
