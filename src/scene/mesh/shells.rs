//! The shells of a mesh: what hangs together along edges, whether it wraps round a volume, and which way
//! its fronts look.

use nalgebra::{Point3, Vector3};

use super::groups::Groups;
use super::seams::are_seams;
use super::{Mesh, Triangle};
use crate::elementary::power;
use crate::scene::winding::Winding;

/// Open edges of a shell that together are shorter than this share of the mesh's diagonal are damage.
const SMALL_HOLES: f64 = 0.1;
/// So many missing triangles are damage, however large they are.
const MOST_MISSING: usize = 10;
/// A volume below this share of that of a ball with the same surface is a sheet of two sides.
const FLAT: f64 = 1e-6;

/// The shells of a mesh.
#[derive(Clone, Debug)]
pub(in crate::scene) struct Shells {
    /// The shell of each triangle.
    pub of: Vec<u32>,
    pub list: Vec<Shell>,
}

/// What hangs together along edges of two triangles.
#[derive(Clone, Debug, Default)]
pub(in crate::scene) struct Shell {
    /// Volume, m3; negative where fronts look inwards.
    pub volume: f64,
    /// Area, m2.
    pub area: f64,
    /// The largest area that its holes can have, m2.
    pub hole_area: f64,
    /// Length of all open edges, m.
    hole_length: f64,
    /// Loops of open edges.
    holes: usize,
    /// Those of them that are a triangle.
    missing_triangles: usize,
    /// Whether neighbours agree on their front.
    pub agrees: bool,
    /// Whether it wraps round a volume, but for damage.
    pub is_solid: bool,
    /// Whether its triangles looked into that volume in the file.
    pub was_inside_out: bool,
}

impl Shells {
    pub fn of(mesh: &Mesh) -> Self {
        let edges = Edges::of(mesh);
        let of = components(mesh.triangles.len(), &edges);
        let count = of
            .iter()
            .map(|&shell| shell as usize + 1)
            .max()
            .unwrap_or(0);
        let mut list = vec![
            Shell {
                agrees: true,
                ..Shell::default()
            };
            count
        ];
        let mut centres = vec![(0.0, Vector3::zeros()); count];
        for (triangle, &shell) in mesh.triangles.iter().zip(&of) {
            let area = mesh.doubled_area(triangle).norm() / 2.0;
            list[shell as usize].area += area;
            let (weight, moment) = &mut centres[shell as usize];
            *weight += area;
            *moment += mesh.centre(triangle).coords * area;
        }
        for (triangle, &shell) in mesh.triangles.iter().zip(&of) {
            let (weight, moment) = centres[shell as usize];
            let centre = moment / f64::max(weight, f64::MIN_POSITIVE);
            let [a, b, c] = mesh.corners(triangle).map(|corner| corner.coords - centre);
            list[shell as usize].volume += a.dot(&b.cross(&c)) / 6.0;
        }
        let mut shells = Self { of, list };
        shells.find_holes(mesh, &edges);
        let diagonal = mesh
            .bounds()
            .map_or(0.0, |(low, high)| nalgebra::distance(&low, &high));
        for shell in &mut shells.list {
            let only_triangles =
                shell.missing_triangles == shell.holes && shell.holes <= MOST_MISSING;
            let is_damage = only_triangles || shell.hole_length < SMALL_HOLES * diagonal;
            let ball = power(shell.area, 1.5) / (6.0 * std::f64::consts::PI.sqrt());
            shell.is_solid = shell.agrees && is_damage && shell.volume.abs() > FLAT * ball;
        }
        shells
    }

    /// The open edges of each shell, as loops.
    fn find_holes(&mut self, mesh: &Mesh, edges: &Edges) {
        let mut open: Vec<(u32, [u32; 2])> = Vec::new();
        for uses in edges.sides.chunk_by(|a, b| a.ends == b.ends) {
            let mut by_shell: Vec<(u32, i32)> = uses
                .iter()
                .map(|side| (self.of[side.triangle as usize], side.direction()))
                .collect();
            by_shell.sort_unstable();
            for group in by_shell.chunk_by(|a, b| a.0 == b.0) {
                let sum: i32 = group.iter().map(|(_, direction)| direction).sum();
                if group.len() == 2 && sum != 0 {
                    self.list[group[0].0 as usize].agrees = false;
                } else if sum != 0 {
                    open.push((group[0].0, uses[0].ends));
                }
            }
        }
        let ends: Vec<[u32; 2]> = open.iter().map(|(_, ends)| *ends).collect();
        let seams = are_seams(mesh, &ends);
        let mut holes: Vec<(u32, [u32; 2])> = open
            .into_iter()
            .zip(seams)
            .filter_map(|(edge, is_seam)| (!is_seam).then_some(edge))
            .collect();
        holes.sort_unstable();
        for group in holes.chunk_by(|a, b| a.0 == b.0) {
            let ends: Vec<[u32; 2]> = group.iter().map(|(_, ends)| *ends).collect();
            let shell = &mut self.list[group[0].0 as usize];
            for (length, edges) in loops(mesh, &ends) {
                shell.holes += 1;
                shell.missing_triangles += usize::from(edges == 3);
                shell.hole_length += length;
                // No loop of this length encloses more.
                shell.hole_area += length * length / (4.0 * std::f64::consts::PI);
            }
        }
    }

    /// Turns the shells that are inside out, and gives them: those whose fronts look into the volume that
    /// they wrap round, unless they are the walls of a cavity in another one.
    pub fn turn_inside_out(&mut self, mesh: &mut Mesh) -> Vec<u32> {
        let solid = (0..self.list.len() as u32).filter(|&it| self.list[it as usize].is_solid);
        let mut solid: Vec<u32> = solid.collect();
        if solid.iter().all(|&it| self.list[it as usize].volume > 0.0) {
            return Vec::new();
        }
        let size = |shell: &u32| self.list[*shell as usize].volume.abs();
        solid.sort_by(|a, b| size(b).total_cmp(&size(a)).then(a.cmp(b)));
        let rooms: Vec<Room> = solid
            .iter()
            .map(|&shell| Room::of(mesh, &self.of, shell))
            .collect();
        let mut turned: Vec<bool> = Vec::with_capacity(solid.len());
        for (place, &shell) in solid.iter().enumerate() {
            // The smallest of the larger shells that hold it.
            let at = &rooms[place].corner;
            let outer = (0..place).rev().find(|&outer| rooms[outer].holds(mesh, at));
            let is_inwards = self.list[shell as usize].volume < 0.0;
            turned.push(outer.map_or(is_inwards, |outer| turned[outer]));
        }
        let mut which: Vec<u32> = solid
            .into_iter()
            .zip(turned)
            .filter_map(|(shell, turned)| turned.then_some(shell))
            .collect();
        which.sort_unstable();
        for (triangle, shell) in mesh.triangles.iter_mut().zip(&self.of) {
            if which.binary_search(shell).is_ok() {
                let Triangle { corners, .. } = triangle;
                corners.swap(1, 2);
            }
        }
        for &shell in &which {
            let shell = &mut self.list[shell as usize];
            shell.volume = -shell.volume;
            shell.was_inside_out = true;
        }
        which
    }
}

/// What a shell wraps round.
struct Room {
    low: Point3<f64>,
    high: Point3<f64>,
    corner: Point3<f64>,
    tree: Winding,
}

impl Room {
    fn of(mesh: &Mesh, shells: &[u32], shell: u32) -> Self {
        let all = (0..mesh.triangles.len() as u32).zip(shells);
        let own: Vec<u32> = all
            .filter_map(|(triangle, &of)| (of == shell).then_some(triangle))
            .collect();
        let corners = |index: u32| mesh.corners(&mesh.triangles[index as usize]);
        let points = || own.iter().flat_map(|&index| corners(index));
        let corner = points().next().unwrap_or_default();
        Self {
            low: points().fold(corner, |low, point| low.inf(&point)),
            high: points().fold(corner, |high, point| high.sup(&point)),
            corner,
            tree: Winding::new(&own, corners),
        }
    }

    fn holds(&self, mesh: &Mesh, point: &Point3<f64>) -> bool {
        let in_box = (0..3).all(|i| self.low[i] < point[i] && point[i] < self.high[i]);
        let corners = |index: u32| mesh.corners(&mesh.triangles[index as usize]);
        in_box && self.tree.number(point, corners).abs() > 0.5
    }
}

/// The sides of all triangles, those of one edge side by side.
struct Edges {
    sides: Vec<Side>,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Side {
    ends: [u32; 2],
    triangle: u32,
    backwards: bool,
}

impl Side {
    fn direction(self) -> i32 {
        if self.backwards { -1 } else { 1 }
    }
}

impl Edges {
    fn of(mesh: &Mesh) -> Self {
        let mut sides = Vec::with_capacity(3 * mesh.triangles.len());
        for (number, triangle) in (0..).zip(&mesh.triangles) {
            let [a, b, c] = triangle.corners;
            for (from, to) in [(a, b), (b, c), (c, a)] {
                sides.push(Side {
                    ends: [from.min(to), from.max(to)],
                    triangle: number,
                    backwards: from > to,
                });
            }
        }
        sides.sort_unstable();
        Self { sides }
    }
}

/// The component of each triangle along edges of exactly two triangles.
fn components(triangles: usize, edges: &Edges) -> Vec<u32> {
    let mut groups = Groups::new(triangles);
    for uses in edges.sides.chunk_by(|a, b| a.ends == b.ends) {
        if let [one, other] = uses {
            groups.join([one.triangle, other.triangle]);
        }
    }
    groups.numbered().0
}

/// Length, m, and number of edges of each loop that some edges form together.
fn loops(mesh: &Mesh, edges: &[[u32; 2]]) -> Vec<(f64, usize)> {
    let mut vertices: Vec<u32> = edges.iter().flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    let place = |vertex: u32| vertices.partition_point(|&it| it < vertex) as u32;
    let mut groups = Groups::new(vertices.len());
    for [a, b] in edges {
        groups.join([place(*a), place(*b)]);
    }
    let mut found: Vec<(f64, usize)> = vec![(0.0, 0); vertices.len()];
    for [a, b] in edges {
        let (length, count) = &mut found[groups.leader(place(*a)) as usize];
        *length += nalgebra::distance(&mesh.vertices[*a as usize], &mesh.vertices[*b as usize]);
        *count += 1;
    }
    found.retain(|(_, count)| *count > 0);
    found
}
