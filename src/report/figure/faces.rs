//! The smooth faces of a mesh, seen from a corner, with their numbers.

use std::fmt::Write as _;

use nalgebra::{Point3, Vector3};

use crate::elementary::extremes;
use crate::report::faces::largest;
use crate::scene::mesh::{Mesh, SmoothFaces};

/// Width of the picture.
const WIDTH: f64 = 900.0;
const MARGIN: f64 = 20.0;
/// Turns from face to face by this share of the circle of colours, which comes back to no colour soon.
const GOLDEN: f64 = 137.508;

/// All triangles, the farthest first; the largest faces have a number.
pub(super) fn svg(mesh: &Mesh, faces: &SmoothFaces, most: usize) -> String {
    let towards = Vector3::new(1.0, -1.4, 0.9).normalize();
    let right = Vector3::z().cross(&towards).normalize();
    let up = towards.cross(&right);
    let flat = |point: &Point3<f64>| [point.coords.dot(&right), -point.coords.dot(&up)];
    let ends = |axis: usize| {
        let along = mesh.vertices.iter().map(|it| flat(it)[axis]);
        extremes(along)
    };
    let ((left, end), (top, bottom)) = (ends(0), ends(1));
    let scale = (WIDTH - 2.0 * MARGIN) / (end - left).max(bottom - top).max(f64::MIN_POSITIVE);
    let place = |point: &Point3<f64>| {
        let [x, y] = flat(point);
        [(x - left) * scale + MARGIN, (y - top) * scale + MARGIN]
    };
    let height = (bottom - top) * scale + 2.0 * MARGIN;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height:.1}\" font-family=\"sans-serif\" \
         font-size=\"14\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    let depth = |index: &usize| mesh.centre(&mesh.triangles[*index]).coords.dot(&towards);
    let mut order: Vec<usize> = (0..mesh.triangles.len()).collect();
    order.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
    for index in order {
        let triangle = &mesh.triangles[index];
        let normal = mesh
            .doubled_area(triangle)
            .try_normalize(0.0)
            .unwrap_or(towards);
        let light = 45.0 + 35.0 * normal.dot(&towards).abs();
        let hue = (f64::from(faces.of[index]) * GOLDEN).rem_euclid(360.0);
        let corners = mesh.corners(triangle).map(|it| {
            let [x, y] = place(&it);
            format!("{x:.1},{y:.1}")
        });
        // Writing to a string cannot fail.
        let _ = writeln!(
            svg,
            "<polygon points=\"{}\" fill=\"hsl({hue:.0} 45% {light:.0}%)\" stroke=\"hsl({hue:.0} 45% {light:.0}%)\" \
             stroke-width=\"0.4\"/>",
            corners.join(" ")
        );
    }
    for (number, face) in largest(faces).into_iter().take(most) {
        let [x, y] = place(&face.at);
        let _ = writeln!(
            svg,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\" stroke=\"white\" stroke-width=\"3\" \
             paint-order=\"stroke\">{}</text>",
            number + 1
        );
    }
    svg + "</svg>\n"
}
