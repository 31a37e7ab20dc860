//! What of a mesh is seen from a direction, pixel by pixel.

use nalgebra::{Point2, Point3, Vector3};

use crate::elementary::extremes;
use crate::scene::mesh::Mesh;

/// A square picture from far away, in which the whole mesh has room.
pub(super) struct View {
    right: Vector3<f64>,
    up: Vector3<f64>,
    towards: Vector3<f64>,
    /// What is nearer than a plane across y is left out.
    cut: Option<f64>,
    /// Where the picture is, along `right` and against `up`; and pixels per length.
    corner: [f64; 2],
    scale: f64,
    /// Pixels on a side.
    size: usize,
}

/// A point of the picture: across, down, and towards the eye.
struct Place {
    at: Point2<f64>,
    depth: f64,
    y: f64,
}

impl View {
    /// From this direction, which must not be z; cut open at a plane across y.
    pub fn new(mesh: &Mesh, towards: Vector3<f64>, cut: Option<f64>, size: usize) -> Self {
        let towards = towards.normalize();
        let right = Vector3::z().cross(&towards).normalize();
        let up = towards.cross(&right);
        let ends = |along: &Vector3<f64>| {
            let places = mesh.vertices.iter().map(|it| it.coords.dot(along));
            extremes(places)
        };
        let ((left, end), (bottom, top)) = (ends(&right), ends(&up));
        let wide = (end - left).max(top - bottom).max(f64::MIN_POSITIVE);
        Self {
            right,
            up,
            towards,
            cut,
            corner: [0.5 * (left + end - wide), -0.5 * (top + bottom + wide)],
            scale: size as f64 / wide,
            size,
        }
    }

    /// The direction towards the eye.
    pub fn towards(&self) -> Vector3<f64> {
        self.towards
    }

    fn place(&self, point: &Point3<f64>) -> Place {
        let along = [point.coords.dot(&self.right), -point.coords.dot(&self.up)];
        Place {
            at: Point2::from([0, 1].map(|axis| (along[axis] - self.corner[axis]) * self.scale)),
            depth: point.coords.dot(&self.towards),
            y: point.y,
        }
    }

    /// The triangle that each pixel sees, row by row.
    pub fn seen(&self, mesh: &Mesh) -> Vec<Option<usize>> {
        let nothing = (f64::NEG_INFINITY, None);
        let mut nearest = vec![nothing; self.size * self.size];
        for (index, triangle) in mesh.triangles.iter().enumerate() {
            let corners = mesh.corners(triangle).map(|it| self.place(&it));
            self.draw(&corners, |pixel, depth| {
                if depth > nearest[pixel].0 {
                    nearest[pixel] = (depth, Some(index));
                }
            });
        }
        nearest.into_iter().map(|(_, triangle)| triangle).collect()
    }

    /// Visits the pixels of a triangle whose middle lies in it, with their depth.
    fn draw(&self, corners: &[Place; 3], mut visit: impl FnMut(usize, f64)) {
        let [a, b, c] = corners.each_ref().map(|it| it.at);
        let area = cross(a, b, c);
        if area == 0.0 {
            return;
        }
        let pixels = |axis: usize| {
            let (low, high) = extremes([a, b, c].into_iter().map(|it| it[axis]));
            let last = (high - 0.5).floor();
            // Negative numbers become 0.
            (low - 0.5).ceil() as usize..((last + 1.0) as usize).min(self.size)
        };
        let (rows, columns) = (pixels(1), pixels(0));
        for row in rows {
            for column in columns.clone() {
                let at = Point2::new(column as f64 + 0.5, row as f64 + 0.5);
                let shares =
                    [cross(b, c, at), cross(c, a, at), cross(a, b, at)].map(|it| it / area);
                if shares.iter().any(|share| *share < 0.0) {
                    continue;
                }
                let mean = |of: fn(&Place) -> f64| {
                    let pairs = shares.iter().zip(corners);
                    pairs.map(|(share, corner)| share * of(corner)).sum::<f64>()
                };
                let is_nearer = |cut: f64| (mean(|it| it.y) - cut) * self.towards.y > 0.0;
                if !self.cut.is_some_and(is_nearer) {
                    visit(row * self.size + column, mean(|it| it.depth));
                }
            }
        }
    }
}

/// Twice the area of a triangle, with its sign.
fn cross(a: Point2<f64>, b: Point2<f64>, c: Point2<f64>) -> f64 {
    (b - a).perp(&(c - a))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::tessellate::block;

    fn cube() -> Mesh {
        block(Point3::origin(), Point3::new(1.0, 1.0, 1.0))
    }

    /// How many pixels see each side: `x_min`, `x_max`, `y_min`, ...
    fn pixels(view: &View) -> [usize; 6] {
        let mesh = cube();
        let mut pixels = [0; 6];
        for triangle in view.seen(&mesh).into_iter().flatten() {
            pixels[mesh.triangles[triangle].surface as usize] += 1;
        }
        pixels
    }

    #[test]
    fn the_sides_towards_the_eye_are_seen_and_those_behind_are_not() {
        let eye = Vector3::new(1.0, -1.0, 1.0);
        let view = View::new(&cube(), eye, None, 200);
        let [left, right, front, back, below, above] = pixels(&view);
        assert_eq!([left, back, below], [0, 0, 0]);
        // Each is as large as the cosine of its angle to the eye makes it.
        let area = view.scale * view.scale / 3.0_f64.sqrt();
        for seen in [right, front, above] {
            assert!((seen as f64 / area - 1.0).abs() < 0.01, "{seen} of {area}");
        }
    }

    #[test]
    fn beyond_a_plane_its_insides_are_seen() {
        let view = View::new(&cube(), Vector3::new(1.0, -1.0, 1.0), Some(0.5), 200);
        let [left, right, front, back, below, above] = pixels(&view);
        assert_eq!(front, 0);
        assert!(
            [left, right, back, below, above]
                .iter()
                .all(|&seen| seen > 0)
        );
    }
}
