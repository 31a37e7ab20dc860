//! Joins open edges whose ends are apart by no more than the file's precision.
//!
//! Programs that mesh each face by itself, or that write f32 far from the origin, give one corner
//! slightly different coordinates in each triangle. The cracks are too narrow for any shot, but a mesh
//! that is full of them does not tell inside from outside.

use nalgebra::{Point3, center, distance};
use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};

use super::clusters::Clusters;
use super::precision::precision;
use crate::scene::mesh::{Mesh, open_edges};

/// Edges shorter than this many times the distance of their ends are the shape, not a crack.
const SHORTEST: f64 = 4.0;
/// Edges that are tried as the other side of a crack; where more are as near, they are no cracks.
const MOST_PARTNERS: usize = 64;

/// What was joined.
pub(super) struct Weld {
    /// Corners that took the place of another.
    pub corners: usize,
    /// The largest distance of one from its new place, m.
    pub apart: f64,
    /// The place of the first, m.
    pub near: Point3<f64>,
}

/// Joins the corners at cracks, so that open edges become edges of two triangles; a corner takes the
/// place of the first one that it is joined with. A mesh without cracks is left as it is.
///
/// No corner moves by more than the file's precision, however many are joined in a row, and no
/// triangle loses two of its corners to one place.
pub(super) fn weld(mesh: &mut Mesh, metres_per_unit: f64) -> Option<Weld> {
    let edges = open_edges(mesh);
    if edges.is_empty() {
        return None;
    }
    let limit = precision(mesh, metres_per_unit);
    let cracks = cracks(mesh, &edges, limit);
    if cracks.is_empty() {
        return None;
    }
    let mut clusters = Clusters::new(mesh, limit);
    for crack in &cracks {
        clusters.join(crack);
    }
    let places = clusters.places();
    apply(mesh, &places)
}

/// Puts every corner in its place.
fn apply(mesh: &mut Mesh, places: &[u32]) -> Option<Weld> {
    let at = |corner: u32| mesh.vertices[corner as usize];
    let moved = (0..).zip(places).filter(|(corner, place)| corner != *place);
    let mut weld: Option<Weld> = None;
    for (corner, &place) in moved {
        let (from, to) = (at(corner), at(place));
        let weld = weld.get_or_insert(Weld {
            corners: 0,
            apart: 0.0,
            near: to,
        });
        weld.corners += 1;
        weld.apart = weld.apart.max(distance(&from, &to));
    }
    if weld.is_some() {
        for triangle in &mut mesh.triangles {
            triangle.corners = triangle.corners.map(|corner| places[corner as usize]);
        }
    }
    weld
}

/// Two open edges side by side: the ends that belong together.
pub(super) struct Crack {
    pub ends: [[u32; 2]; 2],
}

/// Pairs of open edges, each in one pair at most, the narrowest first.
fn cracks(mesh: &Mesh, edges: &[[u32; 2]], limit: f64) -> Vec<Crack> {
    let at = |corner: u32| mesh.vertices[corner as usize];
    let middle = |[from, to]: [u32; 2]| center(&at(from), &at(to));
    let slack = |[from, to]: [u32; 2]| limit.min(distance(&at(from), &at(to)) / SHORTEST);
    let boxes = edges.iter().map(|&edge| {
        let middle = middle(edge).coords.into();
        Aabb::new(middle, middle)
    });
    let tree = Bvh::from_iter(BvhBuildStrategy::Binned, boxes.enumerate());
    let mut pairs: Vec<(f64, u32, u32)> = Vec::new();
    for (number, &edge) in (0..).zip(edges) {
        let slack = slack(edge);
        let around = middle(edge).coords.into();
        let around = Aabb::new(around, around).loosened(slack);
        for other in tree.intersect_aabb(&around).take(MOST_PARTNERS) {
            if other > number {
                let (_, apart) = facing_ends(mesh, edge, edges[other as usize]);
                if apart <= slack {
                    pairs.push((apart, number, other));
                }
            }
        }
    }
    pairs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut is_taken = vec![false; edges.len()];
    let mut cracks = Vec::new();
    for (_, one, other) in pairs {
        let (one, other) = (one as usize, other as usize);
        if !is_taken[one] && !is_taken[other] {
            (is_taken[one], is_taken[other]) = (true, true);
            let (ends, _) = facing_ends(mesh, edges[one], edges[other]);
            cracks.push(Crack { ends });
        }
    }
    cracks
}

/// The ends of two edges that face each other, and the larger of their distances.
fn facing_ends(mesh: &Mesh, [a, b]: [u32; 2], [c, d]: [u32; 2]) -> ([[u32; 2]; 2], f64) {
    let apart = |ends: [[u32; 2]; 2]| {
        let apart = ends.map(|[one, other]| {
            distance(&mesh.vertices[one as usize], &mesh.vertices[other as usize])
        });
        (ends, apart[0].max(apart[1]))
    };
    let (along, across) = (apart([[a, c], [b, d]]), apart([[a, d], [b, c]]));
    if along.1 <= across.1 { along } else { across }
}

#[cfg(test)]
mod tests;
