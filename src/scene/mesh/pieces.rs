//! The pieces of a mesh that do not hang together.

use nalgebra::Point3;

use super::Mesh;
use super::groups::Groups;

/// A piece is tiny when the box round it is this much shorter than the one round the mesh.
const TINY: f64 = 0.01;

/// How many pieces are tiny, and the first corner of the first; `None` where none is.
pub(in crate::scene) fn tiny_pieces(mesh: &Mesh) -> Option<(usize, Point3<f64>)> {
    let (low, high) = mesh.bounds()?;
    let limit = TINY * (high - low).norm();
    let mut groups = Groups::new(mesh.vertices.len());
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.corners;
        groups.join([a, b]);
        groups.join([b, c]);
    }
    let mut boxes: Vec<Option<(Point3<f64>, Point3<f64>)>> = vec![None; mesh.vertices.len()];
    for triangle in &mesh.triangles {
        let piece = groups.leader(triangle.corners[0]) as usize;
        for point in mesh.corners(triangle) {
            let (low, high) = boxes[piece].unwrap_or((point, point));
            boxes[piece] = Some((low.inf(&point), high.sup(&point)));
        }
    }
    let pieces = boxes.iter().zip(&mesh.vertices);
    let tiny = pieces.filter(|(bounds, _)| {
        let bounds = bounds.as_ref();
        bounds.is_some_and(|(low, high)| (high - low).norm() < limit)
    });
    let mut places = tiny.map(|(_, place)| *place).peekable();
    let first = *places.peek()?;
    Some((places.count(), first))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::mesh::Triangle;

    #[test]
    fn pieces_are_tiny_beside_the_whole() {
        let found = |size: f64| {
            // A long strip of two triangles, and a piece of some size at its end.
            let vertices = [
                [0.0, 0.0],
                [100.0, 0.0],
                [0.0, 1.0],
                [100.0, 1.0],
                [50.0, 2.0],
                [50.0 + size, 2.0],
                [50.0, 2.0 + size],
            ];
            let triangle = |corners: [u32; 3]| Triangle {
                corners,
                surface: 0,
            };
            let mesh = Mesh {
                vertices: vertices.map(|[x, y]| Point3::new(x, y, 0.0)).to_vec(),
                triangles: [[0, 1, 2], [2, 1, 3], [4, 5, 6]].map(triangle).to_vec(),
                surfaces: vec!["all".to_owned()],
            };
            tiny_pieces(&mesh)
        };
        // A hundredth of the diagonal is 1; that of the piece is sqrt(2) times its size.
        assert_eq!(found(0.7), Some((1, Point3::new(50.0, 2.0, 0.0))));
        assert_eq!(found(0.72), None);
    }
}
