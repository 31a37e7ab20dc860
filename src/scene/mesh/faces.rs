//! The smooth faces of a mesh: what triangles are left together when it is cut along its sharp edges, and where flat faces go over
//! into fillets.

use std::collections::HashMap;

use nalgebra::{Matrix3, Point3, SymmetricEigen, Vector3};
use parry3d_f64::math::Vector;
use parry3d_f64::query::PointQuery;
use parry3d_f64::shape::Triangle as ParryTriangle;

use super::Mesh;

/// Neighbours whose normals differ by less than this are on one smooth face, rad.
pub const SHARP: f64 = std::f64::consts::PI / 6.0;

/// The faces of a mesh, each as smooth within as asked for, and on one surface.
#[derive(Clone, Debug, PartialEq)]
pub struct SmoothFaces {
    /// The face of each triangle.
    pub of: Vec<u32>,
    /// The faces, in the order of their first triangles.
    pub list: Vec<SmoothFace>,
}

/// A smooth face.
#[derive(Clone, Debug, PartialEq)]
pub struct SmoothFace {
    /// Index of its surface.
    pub surface: u32,
    /// How many triangles it has.
    pub triangles: usize,
    /// m2.
    pub area: f64,
    /// Smallest coordinates, m.
    pub low: Point3<f64>,
    /// Largest coordinates, m.
    pub high: Point3<f64>,
    /// A point on it, m: in the middle of the triangle nearest to its centre.
    pub at: Point3<f64>,
    /// What it looks like.
    pub form: Form,
}

/// What a smooth face looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// Flat.
    Plane {
        /// Unit normal on its front.
        normal: Vector3<f64>,
    },
    /// Round about an axis.
    Cylinder {
        /// Unit vector along the axis.
        axis: Vector3<f64>,
        /// m.
        radius: f64,
        /// Whether its front looks to the axis: a hole.
        is_hole: bool,
    },
    /// Anything else.
    Free,
}

/// Neighbours whose normals differ by less lie in one plane, rad: files have seven digits.
const COPLANAR: f64 = 3e-3;
/// Facets of one curved face differ less in width; a flat face is many times as wide as the first facet of a fillet.
const ALIKE: f64 = 8.0;
/// What is smaller than this beside a smooth neighbour is a part of it.
const CRUMB: f64 = 2e-3;

/// Normals of a plane differ by less, rad; so do those of a cylinder from the plane across its axis.
const FLAT: f64 = 0.01;
/// How far corners may lie from a cylinder, as a share of its radius.
const ROUND: f64 = 0.01;

impl Mesh {
    /// The smooth faces: neighbours whose normals differ by less than `limit`, rad, are on one. A flat face ends where it goes
    /// over into a fillet, too: there it is many times as wide as the next facet.
    pub fn smooth_faces(&self, limit: f64) -> SmoothFaces {
        let edges = self.smooth_edges(limit);
        let mut flat = Groups::new(self.triangles.len());
        for edge in edges.iter().filter(|edge| edge.turn < COPLANAR) {
            flat.join(edge.triangles);
        }
        let mut facets: Vec<Vec<u32>> = vec![Vec::new(); self.triangles.len()];
        for triangle in 0..self.triangles.len() as u32 {
            facets[flat.leader(triangle) as usize].push(triangle);
        }
        let mut faces = flat.clone();
        // Which of two facets is much wider than the other, if one is; those that meet in several edges are looked at once.
        let mut wider: HashMap<[u32; 2], Option<u32>> = HashMap::new();
        // A facet with a neighbour of about its width is one of many on a curved face.
        let mut is_curved = vec![false; self.triangles.len()];
        for edge in &edges {
            let pair = edge.triangles.map(|triangle| flat.leader(triangle));
            let wider = *wider.entry(pair).or_insert_with(|| {
                let [from, to] = edge.ends.map(|end| self.vertices[end as usize]);
                let along = (to - from).normalize();
                let [a, b] = pair.map(|facet| self.width(&facets[facet as usize], &along));
                (a.max(b) > ALIKE * a.min(b)).then_some(if a > b { pair[0] } else { pair[1] })
            });
            if wider.is_none() && pair[0] != pair[1] {
                for facet in pair {
                    is_curved[facet as usize] = true;
                }
            }
        }
        for edge in &edges {
            let pair = edge.triangles.map(|triangle| flat.leader(triangle));
            let wider = wider.get(&pair).copied().flatten();
            if wider.is_none_or(|wider| is_curved[wider as usize]) {
                faces.join(edge.triangles);
            }
        }
        self.join_crumbs(&edges, &mut faces);
        let mut numbers = vec![u32::MAX; self.triangles.len()];
        let mut members: Vec<Vec<u32>> = Vec::new();
        let of = (0..self.triangles.len() as u32).map(|triangle| {
            let first = faces.leader(triangle) as usize;
            if numbers[first] == u32::MAX {
                numbers[first] = members.len() as u32;
                members.push(Vec::new());
            }
            members[numbers[first] as usize].push(triangle);
            numbers[first]
        });
        let of = of.collect();
        SmoothFaces {
            list: members.iter().map(|members| self.face(members)).collect(),
            of,
        }
    }

    /// How wide a flat piece is across a direction in its plane, on average: its area over its length.
    fn width(&self, members: &[u32], along: &Vector3<f64>) -> f64 {
        let (mut area, mut low, mut high) = (0.0, f64::INFINITY, f64::NEG_INFINITY);
        for triangle in members.iter().map(|&index| &self.triangles[index as usize]) {
            area += self.doubled_area(triangle).norm() / 2.0;
            for corner in self.corners(triangle) {
                let place = corner.coords.dot(along);
                low = place.min(low);
                high = place.max(high);
            }
        }
        area / (high - low)
    }

    /// Edges between triangles of one surface that go on smoothly.
    fn smooth_edges(&self, limit: f64) -> Vec<SmoothEdge> {
        let sides = self.sorted_sides();
        let pairs = sides.chunk_by(|a, b| a.ends == b.ends);
        let edges = pairs.filter_map(|pair| {
            let [a, b] = pair else { return None };
            let surface = |triangle: u32| self.triangles[triangle as usize].surface;
            // A sliver without an area belongs to both of its neighbours.
            let turn = self.turn(a, b);
            let turn = if turn.is_nan() { 0.0 } else { turn };
            (surface(a.triangle) == surface(b.triangle) && turn < limit).then_some(SmoothEdge {
                triangles: [a.triangle, b.triangle],
                ends: a.ends,
                turn,
            })
        });
        edges.collect()
    }

    /// Joins what is small beside a smooth neighbour with it: a facet that is cut short is no face.
    fn join_crumbs(&self, edges: &[SmoothEdge], faces: &mut Groups) {
        let areas = faces.areas(self);
        let whole = faces.clone();
        for edge in edges {
            let [a, b] = edge
                .triangles
                .map(|triangle| areas[whole.leader(triangle) as usize]);
            if a.min(b) < CRUMB * a.max(b) {
                faces.join(edge.triangles);
            }
        }
    }

    fn face(&self, members: &[u32]) -> SmoothFace {
        let triangles = || members.iter().map(|&index| &self.triangles[index as usize]);
        let corners = || triangles().flat_map(|triangle| self.corners(triangle));
        let first = self.vertices[self.triangles[members[0] as usize].corners[0] as usize];
        let (low, high) = corners().fold((first, first), |(low, high), it| {
            (low.inf(&it), high.sup(&it))
        });
        let (mut area, mut centre) = (0.0, Vector3::zeros());
        for triangle in triangles() {
            let own = self.doubled_area(triangle).norm() / 2.0;
            area += own;
            centre += self.centre(triangle).coords * own;
        }
        let centre = Point3::from(centre / area.max(f64::MIN_POSITIVE));
        let centres = triangles().map(|triangle| self.centre(triangle));
        let at = centres.min_by(|a, b| (a - centre).norm().total_cmp(&(b - centre).norm()));
        SmoothFace {
            surface: self.triangles[members[0] as usize].surface,
            triangles: members.len(),
            area,
            low,
            high,
            at: at.unwrap_or(first),
            form: self.form(members),
        }
    }

    fn form(&self, members: &[u32]) -> Form {
        let triangles = || members.iter().map(|&index| &self.triangles[index as usize]);
        let normals: Vec<Vector3<f64>> = triangles()
            .filter_map(|triangle| self.doubled_area(triangle).try_normalize(0.0))
            .collect();
        let mean: Vector3<f64> = triangles()
            .map(|triangle| self.doubled_area(triangle))
            .sum();
        if let Some(normal) = mean.try_normalize(0.0)
            && normals
                .iter()
                .all(|it| it.cross(&normal).norm() < FLAT && it.dot(&normal) > 0.0)
        {
            return Form::Plane { normal };
        }
        // The axis of a cylinder is across all of its normals.
        let spread: Matrix3<f64> = normals.iter().map(|it| it * it.transpose()).sum();
        let eigen = SymmetricEigen::new(spread);
        let least = eigen.eigenvalues.imin();
        let axis: Vector3<f64> = eigen.eigenvectors.column(least).into_owned();
        let axis = axis * axis[axis.iamax()].signum();
        if normals.iter().any(|it| it.dot(&axis).abs() > FLAT) {
            return Form::Free;
        }
        let points: Vec<Point3<f64>> = triangles().flat_map(|it| self.corners(it)).collect();
        let Some((through, radius)) = circle(&points, &axis) else {
            return Form::Free;
        };
        let outwards = |point: &Point3<f64>| {
            let from = point - through;
            from - axis * from.dot(&axis)
        };
        if points
            .iter()
            .any(|it| (outwards(it).norm() - radius).abs() > ROUND * radius)
        {
            return Form::Free;
        }
        let facing: f64 = triangles()
            .map(|it| self.doubled_area(it).dot(&outwards(&self.centre(it))))
            .sum();
        Form::Cylinder {
            axis,
            radius,
            is_hole: facing < 0.0,
        }
    }

    /// The triangles nearest to a point, and how far they are, m; several where it lies on an edge of theirs.
    pub(in crate::scene) fn nearest_triangles(
        &self,
        to: &Point3<f64>,
        slack: f64,
    ) -> (Vec<usize>, f64) {
        let centre: Vector = to.coords.into();
        let distances = self.triangles.iter().map(|triangle| {
            let [a, b, c] = self.corners(triangle).map(|corner| corner.coords.into());
            let projection = ParryTriangle::new(a, b, c).project_local_point(centre, true);
            (projection.point - centre).length()
        });
        let distances: Vec<f64> = distances.collect();
        let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
        let near = distances
            .iter()
            .enumerate()
            .filter(|(_, it)| **it <= least + slack);
        (near.map(|(index, _)| index).collect(), least)
    }
}

/// The axis of a cylinder through points, by a point of it, and its radius: the circle of least squares across the axis.
fn circle(points: &[Point3<f64>], axis: &Vector3<f64>) -> Option<(Point3<f64>, f64)> {
    let u = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
    let v = axis.cross(&u);
    let origin = points[0];
    let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for point in points {
        let from = point - origin;
        let row = Vector3::new(from.dot(&u), from.dot(&v), 1.0);
        matrix += row * row.transpose();
        right += row * (row.x * row.x + row.y * row.y);
    }
    let solved = matrix.try_inverse()? * right;
    let (x, y) = (solved.x / 2.0, solved.y / 2.0);
    let radius = (solved.z + x * x + y * y).sqrt();
    radius.is_finite().then(|| (origin + u * x + v * y, radius))
}

/// An edge over which a surface goes on smoothly.
struct SmoothEdge {
    triangles: [u32; 2],
    /// Its vertices.
    ends: [u32; 2],
    /// By how much the normal turns there, rad.
    turn: f64,
}

/// Triangles that belong together.
#[derive(Clone)]
struct Groups(Vec<u32>);

impl Groups {
    fn new(triangles: usize) -> Self {
        Self((0..triangles as u32).collect())
    }

    /// The first triangle that is known to be of the same group.
    fn leader(&self, triangle: u32) -> u32 {
        let mut at = triangle;
        while self.0[at as usize] != at {
            at = self.0[at as usize];
        }
        at
    }

    fn join(&mut self, triangles: [u32; 2]) {
        let leaders = triangles.map(|triangle| self.leader(triangle));
        let first = leaders[0].min(leaders[1]);
        // Ways are kept short.
        for mut at in triangles {
            while at != first {
                let next = self.0[at as usize];
                self.0[at as usize] = first;
                at = next;
                if at == self.0[at as usize] {
                    self.0[at as usize] = first;
                    break;
                }
            }
        }
    }

    /// The area of each group, m2, at its first triangle.
    fn areas(&self, mesh: &Mesh) -> Vec<f64> {
        let mut areas = vec![0.0; self.0.len()];
        for (index, triangle) in (0..).zip(&mesh.triangles) {
            areas[self.leader(index) as usize] += mesh.doubled_area(triangle).norm() / 2.0;
        }
        areas
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::part::{Ends, Keyway};
    use crate::scene::profile::Profile;
    use crate::scene::tessellate;

    /// The faces of a hole of 12 mm with both ends closed, without the names of its surfaces.
    fn faces(chord_angle: f64) -> SmoothFaces {
        let ends = Ends {
            near_closed: true,
            far_closed: true,
        };
        let mut mesh = tessellate::prism(&Profile::circle(12e-3), 0.03, ends, chord_angle);
        mesh.triangles.iter_mut().for_each(|it| it.surface = 0);
        mesh.smooth_faces(SHARP)
    }

    #[test]
    fn a_closed_hole_has_three_faces() {
        let faces = faces(0.1);
        assert_eq!(faces.list.len(), 3);
        let round = faces
            .list
            .iter()
            .find(|it| matches!(it.form, Form::Cylinder { .. }))
            .unwrap();
        let Form::Cylinder {
            axis,
            radius,
            is_hole,
        } = round.form
        else {
            unreachable!()
        };
        assert!(is_hole && (radius - 6e-3).abs() < 1e-9 && (axis.z.abs() - 1.0).abs() < 1e-9);
        assert!((round.area / (std::f64::consts::TAU * 6e-3 * 0.03) - 1.0).abs() < 1e-3);
        let flat = faces
            .list
            .iter()
            .filter(|it| matches!(it.form, Form::Plane { .. }));
        assert_eq!(flat.count(), 2);
        assert_eq!(
            faces.of.len(),
            faces.list.iter().map(|it| it.triangles).sum::<usize>()
        );
    }

    /// With fillets, into which floor and walls go over without an edge, and without.
    #[test]
    fn a_keyway_has_the_faces_of_its_drawing() {
        for (root_radius, chord_angle) in [(0.0, 0.02), (0.2e-3, 0.02), (1e-3, 0.1)] {
            assert_faces(root_radius, chord_angle);
        }
    }

    fn assert_faces(root_radius: f64, chord_angle: f64) {
        let keyway = Keyway {
            bore: 30e-3,
            width: 8e-3,
            depth: 3.3e-3,
            length: 40e-3,
            root_radius,
        };
        let profile = Profile::keyway(&keyway);
        let mut mesh = tessellate::prism(&profile, 0.04, Ends::default(), chord_angle);
        let names = mesh.surfaces.len();
        mesh.triangles.iter_mut().for_each(|it| it.surface = 0);
        let faces = mesh.smooth_faces(SHARP);
        assert_eq!(faces.list.len(), names);
        // A point on the floor is on one face, one on its edge on two.
        let near = |x: f64| {
            let (found, gap) = mesh.nearest_triangles(&Point3::new(x, 18.3e-3, 0.011), 1e-9);
            assert!(gap < 1e-9, "{gap}");
            let mut found: Vec<u32> = found.iter().map(|&it| faces.of[it]).collect();
            found.sort_unstable();
            found.dedup();
            found.len()
        };
        let edge = 4e-3 - root_radius;
        assert_eq!((near(1e-3), near(edge)), (1, 2));
    }
}
