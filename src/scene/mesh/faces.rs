//! The smooth faces of a mesh: what triangles are left together when it is cut along its sharp edges, and where flat faces go over
//! into fillets.

mod form;

use std::collections::HashMap;

use nalgebra::{Point3, Vector3};
use parry3d_f64::math::Vector;
use parry3d_f64::query::PointQuery;
use parry3d_f64::shape::Triangle as ParryTriangle;

use super::Mesh;
use super::groups::Groups;
use crate::elementary::extremes;
pub use form::Form;

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

/// Neighbours whose normals differ by less lie in one plane, rad: files have seven digits.
const COPLANAR: f64 = 3e-3;
/// Facets of one curved face differ less in width; a flat face is many times as wide as the first facet of a fillet.
const ALIKE: f64 = 8.0;
/// What is smaller than this beside a smooth neighbour is a part of it.
const CRUMB: f64 = 2e-3;

impl Mesh {
    /// The smooth faces: neighbours whose normals differ by less than `limit`, rad, are on one. A flat face ends where it goes
    /// over into a fillet, too: there it is many times as wide as the next facet.
    pub fn smooth_faces(&self, limit: f64) -> SmoothFaces {
        let edges = self.smooth_edges(limit);
        let flat = edges.iter().filter(|edge| edge.turn < COPLANAR);
        let (facet_of, count) = self.joined_by(flat);
        let pair_of = |edge: &SmoothEdge| edge.triangles.map(|it| facet_of[it as usize]);
        let facets = members(&facet_of, count);
        // Which of two facets is much wider than the other, if one is; those that meet in several edges are looked at once.
        let mut wider: HashMap<[u32; 2], Option<u32>> = HashMap::new();
        // A facet with a neighbour of about its width is one of many on a curved face.
        let mut is_curved = vec![false; count];
        for edge in &edges {
            let pair = pair_of(edge);
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
        let goes_on = |edge: &&SmoothEdge| {
            let wider = wider.get(&pair_of(edge)).copied().flatten();
            wider.is_none_or(|wider| is_curved[wider as usize])
        };
        let (faces, count) = self.joined_by(edges.iter().filter(goes_on));
        // What is small beside a smooth neighbour belongs to it: a facet that is cut short is no face.
        let areas: Vec<f64> = members(&faces, count)
            .iter()
            .map(|it| self.area(it))
            .collect();
        let is_crumb = |edge: &&SmoothEdge| {
            let [a, b] = edge.triangles.map(|it| areas[faces[it as usize] as usize]);
            a.min(b) < CRUMB * a.max(b)
        };
        let joined = edges.iter().filter(|edge| goes_on(edge) || is_crumb(edge));
        let (of, count) = self.joined_by(joined);
        SmoothFaces {
            list: members(&of, count).iter().map(|it| self.face(it)).collect(),
            of,
        }
    }

    /// The group of each triangle where those on both sides of some edges belong together, and how many groups there are.
    fn joined_by<'a>(&self, edges: impl Iterator<Item = &'a SmoothEdge>) -> (Vec<u32>, usize) {
        let mut groups = Groups::new(self.triangles.len());
        edges.for_each(|edge| groups.join(edge.triangles));
        groups.numbered()
    }

    /// m2.
    fn area(&self, members: &[u32]) -> f64 {
        let triangles = members.iter().map(|&index| &self.triangles[index as usize]);
        triangles.map(|it| self.doubled_area(it).norm() / 2.0).sum()
    }

    /// How wide a flat piece is across a direction in its plane, on average: its area over its length.
    fn width(&self, members: &[u32], along: &Vector3<f64>) -> f64 {
        let triangles = members.iter().map(|&index| &self.triangles[index as usize]);
        let corners = triangles.flat_map(|it| self.corners(it));
        let (low, high) = extremes(corners.map(|corner| corner.coords.dot(along)));
        self.area(members) / (high - low)
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

    fn face(&self, members: &[u32]) -> SmoothFace {
        let triangles = || members.iter().map(|&index| &self.triangles[index as usize]);
        let corners = || triangles().flat_map(|triangle| self.corners(triangle));
        let first = self.vertices[self.triangles[members[0] as usize].corners[0] as usize];
        let (low, high) = corners().fold((first, first), |(low, high), it| {
            (low.inf(&it), high.sup(&it))
        });
        let area = self.area(members);
        let weighed = |it| self.centre(it).coords * (self.doubled_area(it).norm() / 2.0);
        let centre: Vector3<f64> = triangles().map(weighed).sum();
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

/// An edge over which a surface goes on smoothly.
struct SmoothEdge {
    triangles: [u32; 2],
    /// Its vertices.
    ends: [u32; 2],
    /// By how much the normal turns there, rad.
    turn: f64,
}

/// The triangles of each group.
fn members(of: &[u32], count: usize) -> Vec<Vec<u32>> {
    let mut members = vec![Vec::new(); count];
    for (triangle, group) in (0..).zip(of) {
        members[*group as usize].push(triangle);
    }
    members
}

#[cfg(test)]
mod tests;
