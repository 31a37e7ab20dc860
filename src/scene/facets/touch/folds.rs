//! Which edges and corners of a triangle a sphere can touch before it touches the faces there.
//!
//! A sphere touches an edge of two triangles on the side only on which the edge stands out. Where
//! the two form a flat or a hollow, the face of one of them comes first. A corner can be touched
//! only on a side on which an edge there stands out.

use nalgebra::{Point3, Vector3};

/// Edges (bits 0 to 2, bit i from corner i to the next) and corners (bits 3 to 5) of a triangle
/// that a sphere may touch, in front and behind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Folds {
    pub front: u8,
    pub behind: u8,
}

/// Sine of the angle by which the triangles at an edge must be folded for the hollow side to be
/// left out.
pub(super) const CLEAR_FOLD: f64 = 1e-3;
/// Sine of the angle up to which two triangles may count as one face.
const FLAT_FOLD: f64 = 1e-6;

impl Folds {
    /// Everything may be touched.
    pub const ALL: Self = Self {
        front: 0b11_1111,
        behind: 0b11_1111,
    };
    const NONE: Self = Self {
        front: 0,
        behind: 0,
    };

    /// The mask of one side.
    #[inline(always)]
    pub fn of(self, front: bool) -> u8 {
        if front { self.front } else { self.behind }
    }

    fn add(&mut self, bit: u32, sides: Sides) {
        self.front |= u8::from(sides.front) << bit;
        self.behind |= u8::from(sides.behind) << bit;
    }
}

/// The sides of a surface on which an edge or a vertex stands out.
#[derive(Clone, Copy, Default)]
struct Sides {
    front: bool,
    behind: bool,
}

impl Sides {
    const BOTH: Self = Self {
        front: true,
        behind: true,
    };

    fn add(&mut self, other: Self) {
        self.front |= other.front;
        self.behind |= other.behind;
    }
}

/// One triangle's use of an edge: the vertices with the lower one first, the triangle, and its
/// corner where the edge starts.
type Use = (u32, u32, u32, u32);

/// What may be touched of each triangle. `has_plane` tells for each whether rounding leaves it a
/// plane to judge by; `flat` is how far a vertex may be beside the plane of a neighbouring triangle
/// (m) for the two to count as one face.
pub(super) fn folds(
    vertices: &[Point3<f64>],
    triangles: &[[u32; 3]],
    has_plane: &[bool],
    flat: f64,
) -> Vec<Folds> {
    let mut folds = vec![Folds::NONE; triangles.len()];
    let mut at_vertices = vec![Sides::default(); vertices.len()];
    let uses = uses_of_edges(triangles);
    for same in uses.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let sides = match same {
            [one, other] if has_plane[one.2 as usize] && has_plane[other.2 as usize] => {
                sides(vertices, triangles, *one, *other, flat)
            }
            _ => Sides::BOTH,
        };
        for &(low, high, triangle, corner) in same {
            folds[triangle as usize].add(corner, sides);
            at_vertices[low as usize].add(sides);
            at_vertices[high as usize].add(sides);
        }
    }
    for (folds, corners) in folds.iter_mut().zip(triangles) {
        for (bit, &vertex) in (3..).zip(corners) {
            folds.add(bit, at_vertices[vertex as usize]);
        }
    }
    folds
}

fn uses_of_edges(triangles: &[[u32; 3]]) -> Vec<Use> {
    let mut uses = Vec::with_capacity(3 * triangles.len());
    for (triangle, corners) in (0..).zip(triangles) {
        for corner in 0..3 {
            let (a, b) = (corners[corner], corners[(corner + 1) % 3]);
            uses.push((a.min(b), a.max(b), triangle, corner as u32));
        }
    }
    uses.sort_unstable();
    uses
}

/// Where the edge of two triangles stands out; on both sides when that is not clear.
fn sides(
    vertices: &[Point3<f64>],
    triangles: &[[u32; 3]],
    one: Use,
    other: Use,
    flat: f64,
) -> Sides {
    let corner = |of: Use, offset: u32| {
        let corners = triangles[of.2 as usize];
        corners[((of.3 + offset) % 3) as usize]
    };
    let runs_alike = corner(one, 0) == corner(other, 0);
    let [a, b, c, d] = [
        corner(one, 0),
        corner(one, 1),
        corner(one, 2),
        corner(other, 2),
    ]
    .map(|vertex| vertices[vertex as usize]);
    let along = (b - a).normalize();
    let across = |point: Point3<f64>| (point - a) - along * (point - a).dot(&along);
    let (inner, outer) = (across(c), across(d));
    if runs_alike {
        return Sides::BOTH;
    }
    let front: Vector3<f64> = along.cross(&inner).normalize();
    let rise = outer.dot(&front);
    let sine = rise / outer.norm();
    let unfolded = outer.dot(&inner) < 0.0 && sine.abs() <= FLAT_FOLD;
    if unfolded && rise.abs() <= flat && sine.abs() * inner.norm() <= flat {
        return Sides::default();
    }
    // Written so that what is not a number counts as standing out.
    let (hollow_in_front, hollow_behind) = (sine >= CLEAR_FOLD, sine <= -CLEAR_FOLD);
    Sides {
        front: !hollow_in_front,
        behind: !hollow_behind,
    }
}
