//! What rounding may do in the tree: every allowance for it, in one place.

/// Allowances for rounding, each of them a proven bound: no leaf that a ray may meet is passed over.
pub(super) struct Tolerances {
    /// Relative rounding of a distance to the side of a box: of a difference, of an inverse and of their
    /// product.
    pub side: f64,
    /// Boxes are larger than the triangles in them by this, in coordinates where the mesh reaches from -1 to 1:
    /// it covers the rounding of a ray's origin and of the sides.
    pub margin: f64,
    /// Radii are taken larger by this share: origins moved by them have as much more rounding, which the margin
    /// does not cover, and normals of slabs are as much longer than 1.
    pub radius: f64,
    /// Height of a ray over a slab, by how far its origin is along any axis: once for each component of it, and
    /// those of a normal add up to 1.74 at most.
    pub height_at_origin: f64,
    /// The same by how far along the ray it is: 5 in what it rises, 4 in what it starts from, 2 in their sum.
    pub height_along_ray: f64,
    /// The same by the width of the slab's box along the normal: 5 in what the ray starts from, and 2 in the
    /// height of the planes.
    pub height_across_box: f64,
    /// More than rounding makes of a distance of a sphere to boxes and slabs, as a share of all lengths that it
    /// is computed from.
    pub sphere: f64,
    /// Takes more off the distance of a sphere than its rounding to single precision may add.
    pub shorter: f64,
    /// The planes of a bar are at right angles, or counted as far as they are, but for the rounding of their
    /// normals: bars are by as much nearer than they seem.
    pub oblique: f64,
}

/// Relative rounding of a single operation on the boxes, which are in single precision.
const UNIT: f64 = 0.5 * f32::EPSILON as f64;

pub(super) const TOLERANCES: Tolerances = Tolerances {
    side: 8.0 * UNIT,
    margin: 3.0 * UNIT,
    radius: 4.0 * UNIT,
    height_at_origin: 2.0 * UNIT,
    height_along_ray: 12.0 * UNIT,
    height_across_box: 8.0 * UNIT,
    sphere: 64.0 * f64::EPSILON,
    shorter: 1.0 - f32::EPSILON as f64,
    oblique: 1.0 + 8.0 * f32::EPSILON as f64,
};
