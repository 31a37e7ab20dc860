//! Generalised winding numbers: how often triangles wrap round a point, holes or not.
//!
//! 1 inside a closed surface whose fronts look outwards, 0 outside, and close to that where a little of
//! the surface is missing (Jacobson and others 2013). Triangles far away count as one dipole per node of
//! a tree (Barill and others 2018), so that a query takes the logarithm of their number.

use nalgebra::{Point3, Vector3};

use crate::elementary::atan2;

/// A node this many times farther away than its radius counts as one dipole: the error of a query then
/// stays below a hundredth.
const FAR: f64 = 4.0;
/// Triangles of a leaf, at most.
const LEAF: usize = 8;

/// A tree over some triangles of a mesh.
#[derive(Clone, Debug)]
pub(super) struct Winding {
    nodes: Vec<Node>,
    /// Indices of the triangles, those of a leaf side by side.
    order: Vec<u32>,
}

#[derive(Clone, Debug)]
struct Node {
    /// Mean of the triangles' centres, weighted by their areas, m.
    centre: Vector3<f64>,
    /// Sum of area times normal, m2.
    dipole: Vector3<f64>,
    /// Squared distance, m2, beyond which the dipole is enough.
    far: f64,
    /// Its triangles in the order of the tree.
    triangles: std::ops::Range<u32>,
    /// The node that follows all of its descendants.
    next: u32,
}

/// What a triangle adds to the sums of a node.
#[derive(Clone, Copy)]
struct Piece {
    index: u32,
    centre: Vector3<f64>,
    area: Vector3<f64>,
}

impl Winding {
    /// Prepares the triangles with these indices; `corners` gives the corners of one, m.
    pub fn new(triangles: &[u32], corners: impl Fn(u32) -> [Point3<f64>; 3] + Sync) -> Self {
        let mut pieces: Vec<Piece> = triangles
            .iter()
            .map(|&index| {
                let [a, b, c] = corners(index);
                Piece {
                    index,
                    centre: (a.coords + b.coords + c.coords) / 3.0,
                    area: (b - a).cross(&(c - a)) / 2.0,
                }
            })
            .collect();
        let nodes = grow(&mut pieces, 0, &corners);
        Self {
            nodes,
            order: pieces.iter().map(|piece| piece.index).collect(),
        }
    }

    /// The winding number of a point.
    pub fn number(&self, at: &Point3<f64>, corners: impl Fn(u32) -> [Point3<f64>; 3]) -> f64 {
        let mut angle = 0.0;
        let mut index = 0;
        while let Some(node) = self.nodes.get(index) {
            let away = node.centre - at.coords;
            let squared = away.norm_squared();
            if squared > node.far {
                angle += node.dipole.dot(&away) / (squared * squared.sqrt());
                index = node.next as usize;
                continue;
            }
            index += 1;
            if node.next as usize == index {
                let range = node.triangles.start as usize..node.triangles.end as usize;
                let seen = self.order[range].iter();
                angle += solid_angles(seen.map(|&triangle| half_angle(&corners(triangle), at)));
            }
        }
        angle / (4.0 * std::f64::consts::PI)
    }
}

/// The nodes over some pieces, each followed by its descendants; pieces are put in the order of the leaves.
fn grow(
    pieces: &mut [Piece],
    first: u32,
    corners: &(impl Fn(u32) -> [Point3<f64>; 3] + Sync),
) -> Vec<Node> {
    let count = pieces.len() as u32;
    let mut node = summed(pieces, first..first + count, corners);
    if pieces.len() <= LEAF {
        node.next = 1;
        return vec![node];
    }
    let low = pieces
        .iter()
        .map(|piece| piece.centre)
        .reduce(|a, b| a.inf(&b));
    let high = pieces
        .iter()
        .map(|piece| piece.centre)
        .reduce(|a, b| a.sup(&b));
    let axis = low.zip(high).map_or(0, |(low, high)| (high - low).imax());
    let middle = pieces.len() / 2;
    pieces.select_nth_unstable_by(middle, |a, b| {
        a.centre[axis]
            .total_cmp(&b.centre[axis])
            .then(a.index.cmp(&b.index))
    });
    let (left, right) = pieces.split_at_mut(middle);
    let (left_first, right_first) = (first, first + middle as u32);
    let (left, right) = if count as usize > ALONE {
        rayon::join(
            || grow(left, left_first, corners),
            || grow(right, right_first, corners),
        )
    } else {
        (
            grow(left, left_first, corners),
            grow(right, right_first, corners),
        )
    };
    let mut nodes = vec![node];
    for child in [left, right] {
        let base = nodes.len() as u32;
        nodes.extend(child.into_iter().map(|node| Node {
            next: node.next + base,
            ..node
        }));
    }
    nodes[0].next = nodes.len() as u32;
    nodes
}

/// Up to this many triangles one thread sorts alone.
const ALONE: usize = 1 << 14;

fn summed(
    pieces: &[Piece],
    triangles: std::ops::Range<u32>,
    corners: &impl Fn(u32) -> [Point3<f64>; 3],
) -> Node {
    let (mut weight, mut moment, mut dipole) = (0.0, Vector3::zeros(), Vector3::zeros());
    for piece in pieces {
        let area = piece.area.norm();
        weight += area;
        moment += piece.centre * area;
        dipole += piece.area;
    }
    let centre = if weight > 0.0 {
        moment / weight
    } else {
        pieces
            .first()
            .map_or(Vector3::zeros(), |piece| piece.centre)
    };
    let farthest = pieces
        .iter()
        .flat_map(|piece| corners(piece.index))
        .map(|corner| (corner.coords - centre).norm_squared())
        .fold(0.0, f64::max);
    Node {
        centre,
        dipole,
        far: FAR * FAR * farthest,
        triangles,
        next: 0,
    }
}

/// The sum of the solid angles of a leaf, from their halves: small ones are multiplied as complex numbers,
/// and take one arctangent together.
fn solid_angles(halves: impl Iterator<Item = [f64; 2]>) -> f64 {
    /// The tangent of the largest that is multiplied: all eight of a leaf stay below half a turn.
    const SMALL: f64 = 0.4;
    const { assert!(LEAF <= 8) };
    let mut product = [1.0, 0.0];
    let mut large = 0.0;
    for [sum, volume] in halves {
        if sum > 0.0 && volume.abs() <= SMALL * sum {
            let [real, imaginary] = product;
            product = [
                real * sum - imaginary * volume,
                real * volume + imaginary * sum,
            ];
        } else {
            large += atan2(volume, sum);
        }
    }
    2.0 * (large + atan2(product[1], product[0]))
}

/// Half of the solid angle under which a triangle is seen from a point, as that of a complex number, positive from
/// behind its front (Van Oosterom and Strackee 1983).
fn half_angle(corners: &[Point3<f64>; 3], from: &Point3<f64>) -> [f64; 2] {
    let [a, b, c] = corners.map(|corner| corner - from);
    let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
    let volume = a.dot(&b.cross(&c));
    let sum = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
    [sum, volume]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::tessellate;

    fn solid_angle(corners: &[Point3<f64>; 3], from: &Point3<f64>) -> f64 {
        solid_angles([half_angle(corners, from)].into_iter())
    }

    #[test]
    fn the_octant_of_a_sphere_is_an_eighth() {
        let corners = [
            Point3::new(1.0, 0.0, 0.0),
            Point3::new(0.0, 1.0, 0.0),
            Point3::new(0.0, 0.0, 1.0),
        ];
        let angle = solid_angle(&corners, &Point3::origin());
        assert!((angle - std::f64::consts::FRAC_PI_2).abs() < 1e-14);
        let [a, b, c] = corners;
        let back = solid_angle(&[a, c, b], &Point3::origin());
        assert!((back + std::f64::consts::FRAC_PI_2).abs() < 1e-14);
    }

    /// The tree against the plain sum over all triangles, inside, outside and close to the surface.
    #[test]
    fn the_tree_agrees_with_the_sum_over_all_triangles() {
        // A sphere of 20 000 facets.
        let (rings, sectors) = (100_u32, 100_u32);
        let at = |ring: u32, sector: u32| {
            let polar = std::f64::consts::PI * f64::from(ring) / f64::from(rings);
            let turn = std::f64::consts::TAU * f64::from(sector % sectors) / f64::from(sectors);
            Point3::new(
                polar.sin() * turn.cos(),
                polar.sin() * turn.sin(),
                polar.cos(),
            )
        };
        let mut triangles = Vec::new();
        for ring in 0..rings {
            for sector in 0..sectors {
                let [a, b] = [at(ring, sector), at(ring, sector + 1)];
                let [c, d] = [at(ring + 1, sector), at(ring + 1, sector + 1)];
                triangles.extend([[a, c, b], [b, c, d]]);
            }
        }
        let corners = |index: u32| triangles[index as usize];
        let all: Vec<u32> = (0..triangles.len() as u32).collect();
        let tree = Winding::new(&all, corners);
        for step in 0..200 {
            let direction = crate::scene::nearest::spiral_direction(step, 200);
            for height in [0.0, 0.5, 0.95, 0.999, 1.001, 1.1, 3.0] {
                let from = Point3::from(direction * height);
                let sum: f64 = triangles.iter().map(|it| solid_angle(it, &from)).sum();
                let expected = sum / (4.0 * std::f64::consts::PI);
                let found = tree.number(&from, corners);
                assert!(
                    (found - expected).abs() < 0.01,
                    "{height}: {found} {expected}"
                );
            }
        }
    }

    #[test]
    fn a_block_wraps_once_round_what_is_inside() {
        let mesh = tessellate::block(Point3::origin(), Point3::new(1.0, 2.0, 3.0));
        let all: Vec<u32> = (0..12).collect();
        let corners = |index: u32| mesh.corners(&mesh.triangles[index as usize]);
        let tree = Winding::new(&all, corners);
        let at = |x, y, z| tree.number(&Point3::new(x, y, z), corners);
        assert!((at(0.3, 0.4, 0.5) - 1.0).abs() < 1e-12);
        assert!(at(0.3, 0.4, 3.5).abs() < 1e-12);
        assert!(at(30.0, 0.4, 3.5).abs() < 1e-3);
    }
}
