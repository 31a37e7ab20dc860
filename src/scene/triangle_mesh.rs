//! Rays against triangle meshes.
//!
//! parry's own triangle test lets rays through that pass exactly over an edge or a vertex, and a
//! ray cannot be told to ignore the facet that it starts from. So the test of a triangle is ours,
//! and so is the tree for rays, which are most of the work; distances take parry's.

mod bounding_box;
mod crossing;
mod many;
mod meshlet;
mod plane;
mod slide;
mod touch;

use std::sync::OnceLock;

use nalgebra::{Point3, Vector3};
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use rayon::prelude::*;

use super::LIFT;
use super::bvh8::Bvh8;
use super::lanes::LANES;
use super::mesh::Mesh;
use super::rays::{Hits, Rays};
use super::triangle_packet::TrianglePacket;
use bounding_box::BoundingBox;
use touch::Touchable;

pub(super) use many::{cross, touch};
pub(super) use meshlet::Meshlet;

/// A mesh that is ready for rays.
#[derive(Clone)]
pub struct TriangleMesh {
    tree: Bvh8,
    bounding_box: BoundingBox,
    /// The triangles of each of its leaves.
    bundles: Vec<TrianglePacket>,
    /// What spheres need besides, made when the first one comes.
    touchable: OnceLock<Touchable>,
    /// For other walks than rays; its leaves are the meshlets.
    distance_tree: Bvh,
    meshlets: Vec<Meshlet>,
    corners: Vec<[u32; 3]>,
    surfaces: Vec<u32>,
    vertices: Vec<Point3<f64>>,
    slack: f64,
    /// What a weight may lose to an edge that a ray passes by a lift, m².
    doubtful_weight: f64,
    /// Whether its fronts look towards free space, as is taken for granted until a target tells.
    pub(super) fronts_are_free: bool,
}

impl TriangleMesh {
    /// Prepares a mesh whose surfaces have the indices `surface_base` onwards. `slack` is the
    /// distance within which two points count as one, m.
    pub fn new(mesh: Mesh, surface_base: u32, slack: f64) -> Self {
        let corners = |index: u32| mesh.corners(&mesh.triangles[index as usize]);
        let (tree, leaves) = Bvh8::new(mesh.triangles.len(), corners, slack);
        let meshlets = Meshlet::grouped(leaves.iter().map(|leaf| &leaf[..]), corners, slack);
        let boxes = meshlets.iter().map(|meshlet| meshlet.bounds(slack));
        Self {
            distance_tree: Bvh::from_iter(BvhBuildStrategy::Binned, boxes.enumerate()),
            meshlets,
            touchable: OnceLock::new(),
            bundles: leaves
                .par_iter()
                .map(|leaf| TrianglePacket::new(leaf, corners, plane::normal))
                .collect(),
            tree,
            bounding_box: BoundingBox::of(&mesh, slack),
            corners: mesh.triangles.iter().map(|t| t.corners).collect(),
            surfaces: mesh
                .triangles
                .iter()
                .map(|t| surface_base + t.surface)
                .collect(),
            doubtful_weight: doubtful_weight(&mesh, slack),
            fronts_are_free: true,
            vertices: mesh.vertices,
            slack,
        }
    }

    /// Number of triangles.
    pub fn count(&self) -> usize {
        self.corners.len()
    }

    /// parry's tree, for other walks than rays.
    pub(super) fn distance_tree(&self) -> &Bvh {
        &self.distance_tree
    }

    /// A leaf of parry's tree.
    pub(super) fn meshlet(&self, leaf: u32) -> &Meshlet {
        &self.meshlets[leaf as usize]
    }

    /// The corner points of all triangles, each once.
    pub(super) fn vertices(&self) -> &[Point3<f64>] {
        &self.vertices
    }

    /// The corner points of a triangle.
    pub fn corners(&self, index: u32) -> [Point3<f64>; 3] {
        self.corners[index as usize].map(|corner| self.vertices[corner as usize])
    }

    /// The unit normal on the front of a triangle.
    pub fn normal(&self, index: u32) -> Vector3<f64> {
        plane::normal(&self.corners(index))
    }

    /// Of each ray whether it comes to the box of the mesh, grown by a share of its longest side, before it meets what it
    /// has hit so far.
    #[inline(always)]
    pub(super) fn reached(&self, bulge: f64, rays: &Rays, hits: &Hits) -> [bool; LANES] {
        self.bounding_box.grown(bulge).reached(rays, hits)
    }

    /// The surface of a triangle.
    pub fn surface(&self, index: u32) -> u32 {
        self.surfaces[index as usize]
    }

    /// Whether any of its triangles is of a surface.
    pub fn has_surface(&self, surface: u32) -> bool {
        self.surfaces.contains(&surface)
    }
}

/// What the weights of a triangle of this mesh may lose, m², to an edge that a ray passes by a
/// lift: edges as the ray sees them are at most twice as long as they are.
fn doubtful_weight(mesh: &Mesh, slack: f64) -> f64 {
    let longest = mesh.bounds().map_or(0.0, |(low, high)| (high - low).norm());
    2.0 * longest * LIFT * slack
}

#[cfg(test)]
pub(super) mod tests;
