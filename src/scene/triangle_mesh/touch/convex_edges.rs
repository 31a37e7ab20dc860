//! Which edges and corners of a triangle a sphere can touch before it touches the faces there.
//!
//! A sphere touches an edge of two triangles on the side only on which the edge stands out. Where
//! the two form a flat or a hollow, the face of one of them comes first. A corner can be touched
//! only on a side on which an edge there stands out.

use nalgebra::{Point3, Vector3};

/// Edges (bits 0 to 2, bit i from corner i to the next) and corners (bits 3 to 5) of a triangle
/// that a sphere may touch, in front and behind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ConvexEdges {
    pub front: u8,
    pub behind: u8,
}

/// Sine of the angle by which the triangles at an edge must be folded for the hollow side to be
/// left out.
pub(super) const CLEAR_FOLD: f64 = 1e-3;
/// Sine of the angle up to which two triangles may count as one face.
const FLAT_FOLD: f64 = 1e-6;

impl ConvexEdges {
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
) -> Vec<ConvexEdges> {
    let mut folds = vec![ConvexEdges::NONE; triangles.len()];
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The folds of two triangles along the x axis, the second one raised by an angle, rad.
    fn hinge(raised: f64, second: [u32; 3], has_plane: [bool; 2]) -> Vec<ConvexEdges> {
        let (sin, cos) = raised.sin_cos();
        let vertices = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.3, -1.0, 0.0],
            [0.3, 4.0 * cos, 4.0 * sin],
        ];
        let vertices = vertices.map(Point3::from);
        folds(&vertices, &[[1, 0, 2], second], &has_plane, 1e-9)
    }

    /// Whether the shared edge, that of the first corner, stands out in front and behind.
    fn shared(folds: &[ConvexEdges]) -> [bool; 2] {
        let [front, behind] = [folds[0].front, folds[0].behind].map(|bits| bits & 1 == 1);
        assert_eq!(folds[1].front & 1 == 1, front);
        assert_eq!(folds[1].behind & 1 == 1, behind);
        [front, behind]
    }

    #[test]
    fn edges_stand_out_on_the_side_of_the_ridge() {
        let both = [true; 2];
        let of = |raised: f64| shared(&hinge(raised, [0, 1, 3], both));
        assert_eq!(of(0.5), [false, true]);
        assert_eq!(of(-0.5), [true, false]);
        assert_eq!(of(2e-3), [false, true]);
        // Below a thousandth neither side is surely hollow, and what is flat stands out nowhere.
        assert_eq!(of(5e-4), [true, true]);
        assert_eq!(of(-5e-4), [true, true]);
        assert_eq!(of(0.0), [false, false]);
        // The far corner, 4 away, is not to be more than 1e-9 beside the plane.
        assert_eq!(of(2e-10), [false, false]);
        assert_eq!(of(3e-10), [true, true]);
        // Folded over, wound alike, or without a plane nothing is clear.
        let folded = hinge(std::f64::consts::PI, [0, 1, 3], both);
        assert_eq!(shared(&folded), [true, true]);
        assert_eq!(shared(&hinge(0.5, [1, 0, 3], both)), [true, true]);
        for has_plane in [[true, false], [false, true]] {
            assert_eq!(shared(&hinge(0.0, [0, 1, 3], has_plane)), [true, true]);
        }
    }

    #[test]
    fn the_far_corners_of_both_triangles_must_be_in_one_plane() {
        let is_flat = |[near, far]: [f64; 2], raised: f64| {
            let (sin, cos) = raised.sin_cos();
            let vertices = [
                [0.0, 0.0, 0.0],
                [1.0, 0.0, 0.0],
                [0.3, -near, 0.0],
                [0.3, far * cos, far * sin],
            ];
            let vertices = vertices.map(Point3::from);
            let folds = folds(&vertices, &[[1, 0, 2], [0, 1, 3]], &[true; 2], 1e-9);
            shared(&folds) == [false, false]
        };
        for sizes in [[10.0, 0.1], [0.1, 10.0]] {
            assert!(is_flat(sizes, 0.9e-10), "{sizes:?}");
            assert!(!is_flat(sizes, 1.1e-10), "{sizes:?}");
        }
    }

    #[test]
    fn corners_stand_out_where_an_edge_at_them_does() {
        // Every other edge is open and stands out; so do all corners of a triangle.
        let folds = hinge(0.0, [0, 1, 3], [true; 2]);
        assert_eq!(folds[0].front, 0b11_1110);
        assert_eq!(folds[1].behind, 0b11_1110);
        // On a closed body only the outside has any: here the corner of a block.
        let vertices = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let folds = super::folds(&vertices.map(Point3::from), &faces, &[true; 4], 1e-9);
        for of_face in folds {
            assert_eq!((of_face.front, of_face.behind), (0b11_1111, 0));
        }
    }

    #[test]
    fn edges_of_many_triangles_stand_out_on_both_sides() {
        let vertices = [
            [0.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 1.0],
        ];
        let faces = [[1, 0, 2], [0, 1, 3], [0, 1, 4]];
        let folds = folds(&vertices.map(Point3::from), &faces, &[true; 3], 1e-9);
        assert_eq!(folds, [ConvexEdges::ALL; 3]);
    }
}
