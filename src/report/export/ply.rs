//! Stanford's polygon format, binary: triangles, and hits as vertices without any.

use super::piece::{Cells, Piece};

/// The file; comments say the unit, as the format has none.
pub(super) fn write(pieces: &[Piece]) -> Vec<u8> {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    let (mut vertex_count, mut face_count) = (0, 0);
    for piece in pieces {
        let triangles: &[[u32; 3]] = match &piece.cells {
            Cells::Triangles(triangles) => triangles,
            Cells::Points(_) => &[],
            Cells::Lines(_) => continue,
        };
        for corners in triangles {
            faces.push(3);
            let corners = corners.map(|corner| vertex_count + corner);
            faces.extend(corners.iter().flat_map(|corner| corner.to_le_bytes()));
        }
        face_count += triangles.len();
        for point in &piece.points {
            vertices.extend(point.iter().flat_map(|x| x.to_le_bytes()));
            vertices.extend(piece.color);
        }
        vertex_count += piece.points.len() as u32;
    }
    let header = format!(
        "ply\nformat binary_little_endian 1.0\ncomment peenpose {}\ncomment coordinates in m\n\
         comment vertices without a face are hits\n\
         element vertex {vertex_count}\nproperty float x\nproperty float y\nproperty float z\n\
         property uchar red\nproperty uchar green\nproperty uchar blue\n\
         element face {face_count}\nproperty list uchar uint vertex_indices\nend_header\n",
        env!("CARGO_PKG_VERSION"),
    );
    [header.into_bytes(), vertices, faces].concat()
}
