//! How the triangles of a mesh hang together: holes, forks, winding, volume.

use nalgebra::{Point3, Vector3};

use super::Mesh;

/// How the triangles of a mesh hang together; triangles share an edge if they share its vertices.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Topology {
    /// Edges of one triangle only: the rims of holes.
    pub open_edges: usize,
    /// Edges of more than two triangles.
    pub non_manifold_edges: usize,
    /// Edges of two triangles that run along them in the same direction, so that their fronts
    /// look to different sides.
    pub inconsistent_edges: usize,
    /// Triangles with the same three corners as an earlier one, in whatever order.
    pub duplicate_triangles: usize,
    /// Volume, m3; negative where the triangles' fronts look inwards. Only a closed and consistently
    /// wound mesh has a volume; otherwise the number means nothing.
    pub signed_volume: f64,
}

impl Topology {
    /// Whether every edge joins exactly two triangles. Two bodies that touch along an edge do not
    /// count as closed.
    pub fn is_closed(&self) -> bool {
        self.open_edges == 0 && self.non_manifold_edges == 0
    }

    /// Whether neighbouring triangles agree on which side is the front.
    pub fn is_consistently_wound(&self) -> bool {
        self.inconsistent_edges == 0
    }
}

/// A topology together with places of what is wrong.
pub(in crate::scene) struct Findings {
    pub topology: Topology,
    pub non_manifold: EdgeFinding,
    pub inconsistent: EdgeFinding,
}

/// How many edges of a kind there are, and the first of them.
#[derive(Default)]
pub(in crate::scene) struct EdgeFinding {
    pub count: usize,
    pub ends: Option<[u32; 2]>,
}

impl EdgeFinding {
    fn add(&mut self, edge: DirectedEdge) {
        self.count += 1;
        self.ends.get_or_insert(edge.ends());
    }

    /// The middle of the first edge, m.
    pub fn middle(&self, mesh: &Mesh) -> Option<Point3<f64>> {
        let [a, b] = self.ends?;
        let a = mesh.vertices.get(a as usize)?;
        let b = mesh.vertices.get(b as usize)?;
        Some(nalgebra::center(a, b))
    }
}

/// Both ends of an edge and its direction in eight bytes: a million triangles have three million.
/// The order puts the uses of one edge side by side.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct DirectedEdge(u64);

impl DirectedEdge {
    /// Vertex numbers must stay below 2^31; a mesh of that many vertices would take over 50 GB.
    fn new(from: u32, to: u32) -> Self {
        let (low, high) = (from.min(to), from.max(to));
        Self(u64::from(low) << 32 | u64::from(high) << 1 | u64::from(from > to))
    }

    fn backwards(self) -> bool {
        self.0 & 1 == 1
    }

    fn ends(self) -> [u32; 2] {
        [
            (self.0 >> 32) as u32,
            ((self.0 & u64::from(u32::MAX)) >> 1) as u32,
        ]
    }

    fn joins_the_same(&self, other: &Self) -> bool {
        self.0 >> 1 == other.0 >> 1
    }
}

/// Examines every edge of a mesh; by sorting, which needs 24 bytes a triangle and no hash table.
pub(in crate::scene) fn examine(mesh: &Mesh) -> Findings {
    let mut open_edges = 0;
    let (mut non_manifold, mut inconsistent) = Default::default();
    let edges = sorted_edges(mesh);
    for uses in edges.chunk_by(DirectedEdge::joins_the_same) {
        match *uses {
            [_] => open_edges += 1,
            [one, other] if one.backwards() == other.backwards() => {
                EdgeFinding::add(&mut inconsistent, one);
            }
            [_, _] => {}
            _ => EdgeFinding::add(&mut non_manifold, uses[0]),
        }
    }
    drop(edges);
    let topology = Topology {
        open_edges,
        non_manifold_edges: non_manifold.count,
        inconsistent_edges: inconsistent.count,
        duplicate_triangles: duplicates(mesh).len(),
        signed_volume: signed_volume(mesh),
    };
    Findings {
        topology,
        non_manifold,
        inconsistent,
    }
}

/// The edges of one triangle only.
pub(in crate::scene) fn open_edges(mesh: &Mesh) -> Vec<[u32; 2]> {
    let edges = sorted_edges(mesh);
    let uses = edges.chunk_by(DirectedEdge::joins_the_same);
    let open = uses.filter(|uses| uses.len() == 1);
    open.map(|uses| uses[0].ends()).collect()
}

fn sorted_edges(mesh: &Mesh) -> Vec<DirectedEdge> {
    let mut edges = Vec::with_capacity(3 * mesh.triangles.len());
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.corners;
        edges.extend([
            DirectedEdge::new(a, b),
            DirectedEdge::new(b, c),
            DirectedEdge::new(c, a),
        ]);
    }
    edges.sort_unstable();
    edges
}

/// Positions of the triangles that have the same three corners as an earlier one, ascending.
pub(in crate::scene) fn duplicates(mesh: &Mesh) -> Vec<u32> {
    let mut by_corners: Vec<([u32; 3], u32)> = (0..)
        .zip(&mesh.triangles)
        .map(|(position, triangle)| {
            let mut corners = triangle.corners;
            corners.sort_unstable();
            (corners, position)
        })
        .collect();
    by_corners.sort_unstable();
    let mut repeated: Vec<u32> = by_corners
        .windows(2)
        .filter(|pair| pair[0].0 == pair[1].0)
        .map(|pair| pair[1].1)
        .collect();
    repeated.sort_unstable();
    repeated
}

/// Sum of the tetrahedra over the triangles, seen from the first vertex for the sake of digits.
fn signed_volume(mesh: &Mesh) -> f64 {
    let Some(origin) = mesh.vertices.first() else {
        return 0.0;
    };
    mesh.triangles
        .iter()
        .map(|triangle| {
            let [a, b, c]: [Vector3<f64>; 3] = mesh.corners(triangle).map(|corner| corner - origin);
            a.dot(&b.cross(&c)) / 6.0
        })
        .sum()
}
