//! What a smooth face looks like: flat, round about an axis, or anything else.

use nalgebra::{Matrix3, Point3, SymmetricEigen, Vector3};

use crate::scene::mesh::Mesh;

/// What a smooth face looks like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// Flat.
    Plane {
        /// Unit normal on its front.
        normal: Vector3<f64>,
    },
    /// Round about an axis.
    Cylinder {
        /// Unit vector along the axis.
        axis: Vector3<f64>,
        /// m.
        radius: f64,
        /// Whether its front looks to the axis: a hole.
        is_hole: bool,
    },
    /// Anything else.
    Free,
}

/// Normals of a plane differ by less, rad; so do those of a cylinder from the plane across its axis.
const FLAT: f64 = 0.01;
/// How far corners may lie from a cylinder, as a share of its radius.
const ROUND: f64 = 0.01;

impl Mesh {
    /// What some triangles look like together.
    pub(super) fn form(&self, members: &[u32]) -> Form {
        let triangles = || members.iter().map(|&index| &self.triangles[index as usize]);
        let normals: Vec<Vector3<f64>> = triangles()
            .filter_map(|triangle| self.doubled_area(triangle).try_normalize(0.0))
            .collect();
        let mean: Vector3<f64> = triangles()
            .map(|triangle| self.doubled_area(triangle))
            .sum();
        if let Some(normal) = mean.try_normalize(0.0)
            && normals
                .iter()
                .all(|it| it.cross(&normal).norm() < FLAT && it.dot(&normal) > 0.0)
        {
            return Form::Plane { normal };
        }
        // The axis of a cylinder is across all of its normals.
        let spread: Matrix3<f64> = normals.iter().map(|it| it * it.transpose()).sum();
        let eigen = SymmetricEigen::new(spread);
        let least = eigen.eigenvalues.imin();
        let axis: Vector3<f64> = eigen.eigenvectors.column(least).into_owned();
        let axis = axis * axis[axis.iamax()].signum();
        if normals.iter().any(|it| it.dot(&axis).abs() > FLAT) {
            return Form::Free;
        }
        let points: Vec<Point3<f64>> = triangles().flat_map(|it| self.corners(it)).collect();
        let Some((through, radius)) = circle(&points, &axis) else {
            return Form::Free;
        };
        let outwards = |point: &Point3<f64>| {
            let from = point - through;
            from - axis * from.dot(&axis)
        };
        if points
            .iter()
            .any(|it| (outwards(it).norm() - radius).abs() > ROUND * radius)
        {
            return Form::Free;
        }
        let facing: f64 = triangles()
            .map(|it| self.doubled_area(it).dot(&outwards(&self.centre(it))))
            .sum();
        Form::Cylinder {
            axis,
            radius,
            is_hole: facing < 0.0,
        }
    }
}

/// The axis of a cylinder through points, by a point of it, and its radius: the circle of least squares across the axis.
fn circle(points: &[Point3<f64>], axis: &Vector3<f64>) -> Option<(Point3<f64>, f64)> {
    let u = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
    let v = axis.cross(&u);
    let origin = points[0];
    let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for point in points {
        let from = point - origin;
        let row = Vector3::new(from.dot(&u), from.dot(&v), 1.0);
        matrix += row * row.transpose();
        right += row * (row.x * row.x + row.y * row.y);
    }
    let solved = matrix.try_inverse()? * right;
    let (x, y) = (solved.x / 2.0, solved.y / 2.0);
    let radius = (solved.z + x * x + y * y).sqrt();
    radius.is_finite().then(|| (origin + u * x + v * y, radius))
}
