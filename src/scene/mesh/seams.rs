//! Open edges told apart: seams, where other triangles go on without sharing the corners, and rims.

use nalgebra::Point3;
use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};

use super::Mesh;
use super::topology::open_edges;

/// Edges that are this near to each other, as a share of the longest side of the mesh, are one seam:
/// ten roundings of single precision.
const SEAM: f64 = 1e-6;

/// The open edges of a mesh, each by its two ends.
pub(in crate::scene) struct Rims {
    /// Along these, other triangles with an open edge go on.
    pub seams: Vec<[Point3<f64>; 2]>,
    /// Along these there is nothing.
    pub holes: Vec<[Point3<f64>; 2]>,
}

/// Tells the open edges of a mesh apart.
pub(in crate::scene) fn rims(mesh: &Mesh) -> Rims {
    let edges = open_edges(mesh);
    let is_seam = are_seams(mesh, &edges);
    let (mut seams, mut holes) = (Vec::new(), Vec::new());
    for (edge, is_seam) in edges.into_iter().zip(is_seam) {
        let ends = edge.map(|corner| mesh.vertices[corner as usize]);
        if is_seam { &mut seams } else { &mut holes }.push(ends);
    }
    Rims { seams, holes }
}

/// Which of some edges are seams: others of them go on there.
pub(super) fn are_seams(mesh: &Mesh, edges: &[[u32; 2]]) -> Vec<bool> {
    let ends = |edge: &[u32; 2]| edge.map(|corner| mesh.vertices[corner as usize]);
    let edges: Vec<[Point3<f64>; 2]> = edges.iter().map(ends).collect();
    let slack = SEAM * mesh.bounds().map_or(0.0, |(low, high)| (high - low).max());
    let bounds = |points: &[Point3<f64>]| {
        let points = points.iter().map(|point| point.coords.into());
        Aabb::from_points(points).loosened(slack)
    };
    let boxes = edges.iter().map(|edge| bounds(edge));
    let tree = Bvh::from_iter(BvhBuildStrategy::Binned, boxes.enumerate());
    let goes_on = |number: usize, edge: &[Point3<f64>; 2]| {
        let middle = nalgebra::center(&edge[0], &edge[1]);
        let around = bounds(&[middle]);
        let others = tree.intersect_aabb(&around);
        let mut others = others.filter(|&other| other as usize != number);
        others.any(|other| distance(&middle, &edges[other as usize]) <= slack)
    };
    let numbered = edges.iter().enumerate();
    numbered
        .map(|(number, edge)| goes_on(number, edge))
        .collect()
}

/// The distance of a point from a line between two others.
fn distance(point: &Point3<f64>, [from, to]: &[Point3<f64>; 2]) -> f64 {
    let edge = to - from;
    let share = (point - from).dot(&edge) / edge.norm_squared();
    let nearest = from + edge * share.clamp(0.0, 1.0);
    nalgebra::distance(point, &nearest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_to_the_edge_and_its_ends() {
        let edge = [Point3::new(1.0, 1.0, 0.0), Point3::new(11.0, 1.0, 0.0)];
        for (point, expected) in [
            ([4.0, 5.0, 3.0], 5.0),
            ([14.0, 5.0, 0.0], 5.0),
            ([-2.0, 1.0, 4.0], 5.0),
            ([6.0, 1.0, 0.0], 0.0),
        ] {
            assert_eq!(distance(&point.into(), &edge), expected, "{point:?}");
        }
    }
}
