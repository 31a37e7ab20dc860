//! Corners of a mesh that become one.

use nalgebra::{Point3, distance};

use super::weld::Crack;
use crate::scene::mesh::Mesh;

/// Disjoint sets of corners; at first each corner is one.
pub(super) struct Clusters<'a> {
    mesh: &'a Mesh,
    /// Triangles at each corner.
    around: Around,
    /// The longest diagonal of the box round a cluster, m.
    limit: f64,
    /// An earlier corner of the same cluster, or the corner itself where it is the first.
    leaders: Vec<u32>,
    /// The next corner of the same cluster, the first after the last.
    next: Vec<u32>,
    /// At the first corner of a cluster: the box round all its corners, and how many uses by triangles
    /// these have.
    boxes: Vec<(Point3<f64>, Point3<f64>)>,
    uses: Vec<u32>,
}

impl<'a> Clusters<'a> {
    pub fn new(mesh: &'a Mesh, limit: f64) -> Self {
        let around = Around::new(mesh);
        let corners = 0..mesh.vertices.len() as u32;
        Self {
            mesh,
            limit,
            leaders: corners.clone().collect(),
            next: corners.clone().collect(),
            boxes: mesh.vertices.iter().map(|&it| (it, it)).collect(),
            uses: corners.map(|it| around.of(it).len() as u32).collect(),
            around,
        }
    }

    /// Joins both ends of a crack, or none.
    pub fn join(&mut self, crack: &Crack) {
        let leaders = crack.ends.map(|ends| ends.map(|end| self.leader(end)));
        let [[a, b], [c, d]] = leaders;
        let (one, other) = ((a.min(b), a.max(b)), (c.min(d), c.max(d)));
        // Where both ends would come to lie in one cluster, the edge would vanish.
        let is_one_place = [a, b].iter().any(|leader| [c, d].contains(leader));
        if !is_one_place && self.may_join(one) && self.may_join(other) {
            self.unite(one);
            self.unite(other);
        }
    }

    /// The first corner of the cluster of each corner.
    pub fn places(mut self) -> Vec<u32> {
        let corners = 0..self.leaders.len() as u32;
        corners.map(|corner| self.leader(corner)).collect()
    }

    fn leader(&mut self, corner: u32) -> u32 {
        let mut at = corner;
        while self.leaders[at as usize] != at {
            let next = self.leaders[at as usize];
            self.leaders[at as usize] = self.leaders[next as usize];
            at = next;
        }
        at
    }

    fn may_join(&mut self, (first, second): (u32, u32)) -> bool {
        let (low, high) = self.joint_box(first, second);
        first == second
            || distance(&low, &high) <= self.limit && !self.share_a_triangle(first, second)
    }

    /// Whether a triangle has corners in both clusters; it would lose its area.
    fn share_a_triangle(&mut self, first: u32, second: u32) -> bool {
        let (few, other) = if self.uses[first as usize] <= self.uses[second as usize] {
            (first, second)
        } else {
            (second, first)
        };
        let mut corner = few;
        loop {
            for index in 0..self.around.of(corner).len() {
                let triangle = self.around.of(corner)[index];
                let corners = self.mesh.triangles[triangle as usize].corners;
                if corners.iter().any(|&it| self.leader(it) == other) {
                    return true;
                }
            }
            corner = self.next[corner as usize];
            if corner == few {
                return false;
            }
        }
    }

    fn unite(&mut self, (first, second): (u32, u32)) {
        if first != second {
            self.boxes[first as usize] = self.joint_box(first, second);
            self.uses[first as usize] += self.uses[second as usize];
            self.leaders[second as usize] = first;
            self.next.swap(first as usize, second as usize);
        }
    }

    fn joint_box(&self, one: u32, other: u32) -> (Point3<f64>, Point3<f64>) {
        let (a, b) = (self.boxes[one as usize], self.boxes[other as usize]);
        (a.0.inf(&b.0), a.1.sup(&b.1))
    }
}

/// The triangles at each corner of a mesh.
struct Around {
    /// Where those of a corner start, and behind the last where they end.
    starts: Vec<u32>,
    triangles: Vec<u32>,
}

impl Around {
    fn new(mesh: &Mesh) -> Self {
        let mut starts = vec![0; mesh.vertices.len() + 1];
        for triangle in &mesh.triangles {
            for corner in triangle.corners {
                starts[corner as usize] += 1;
            }
        }
        let mut sum = 0;
        for start in &mut starts {
            sum += *start;
            *start = sum;
        }
        let mut triangles = vec![0; sum as usize];
        // From behind, so that each start comes down to where it belongs.
        for (number, triangle) in (0..mesh.triangles.len() as u32).zip(&mesh.triangles).rev() {
            for corner in triangle.corners {
                starts[corner as usize] -= 1;
                triangles[starts[corner as usize] as usize] = number;
            }
        }
        Self { starts, triangles }
    }

    fn of(&self, corner: u32) -> &[u32] {
        let corner = corner as usize;
        &self.triangles[self.starts[corner] as usize..self.starts[corner + 1] as usize]
    }
}
