//! The legacy format of VTK, as text: every piece in one set of poly data.

use std::fmt::Write;

use super::piece::{Cells, Piece};

/// The file. Cells come as vertices, lines, polygons: the order in which VTK numbers them.
pub(super) fn write(pieces: &[Piece]) -> Vec<u8> {
    let mut points = String::new();
    // By what they are made of: their lines, how many numbers those hold, piece and N* of each.
    let mut kinds: [Kind; 3] = Default::default();
    let mut count = 0;
    for (number, piece) in pieces.iter().enumerate() {
        for [x, y, z] in &piece.points {
            points += &format!("{x} {y} {z}\n");
        }
        match &piece.cells {
            Cells::Points(impulses) => {
                for (index, &impulse) in (0..).zip(impulses) {
                    kinds[0].push([count + index], number, impulse);
                }
            }
            Cells::Lines(lines) => {
                for line in lines {
                    kinds[1].push(line.map(|end| count + end), number, 0.0);
                }
            }
            Cells::Triangles(triangles) => {
                for corners in triangles {
                    kinds[2].push(corners.map(|corner| count + corner), number, 0.0);
                }
            }
        }
        count += piece.points.len() as u32;
    }
    let names: String = pieces
        .iter()
        .map(|piece| encoded(&piece.name) + "\n")
        .collect();
    let mut text = format!(
        "# vtk DataFile Version 3.0\npeenpose {}: coordinates in m, impulses in N s\nASCII\n\
         DATASET POLYDATA\nFIELD FieldData 1\npiece_names 1 {} string\n{names}\
         POINTS {count} float\n{points}",
        env!("CARGO_PKG_VERSION"),
        pieces.len(),
    );
    for (kind, keyword) in kinds.iter().zip(["VERTICES", "LINES", "POLYGONS"]) {
        if kind.count > 0 {
            text += &format!("{keyword} {} {}\n{}", kind.count, kind.numbers, kind.cells);
        }
    }
    let cells: usize = kinds.iter().map(|kind| kind.count).sum();
    let all = |of: fn(&Kind) -> &str| kinds.iter().map(of).collect::<String>();
    text += &format!(
        "CELL_DATA {cells}\nSCALARS piece int 1\nLOOKUP_TABLE default\n{}\
         SCALARS normal_impulse_N_s float 1\nLOOKUP_TABLE default\n{}",
        all(|kind| &kind.pieces),
        all(|kind| &kind.impulses),
    );
    text.into_bytes()
}

/// Cells of one kind.
#[derive(Default)]
struct Kind {
    count: usize,
    /// How many numbers `cells` holds.
    numbers: usize,
    cells: String,
    pieces: String,
    impulses: String,
}

impl Kind {
    fn push<const N: usize>(&mut self, corners: [u32; N], piece: usize, impulse: f32) {
        self.count += 1;
        self.numbers += 1 + N;
        self.cells += &N.to_string();
        for corner in corners {
            self.cells += &format!(" {corner}");
        }
        self.cells.push('\n');
        self.pieces += &format!("{piece}\n");
        self.impulses += &format!("{impulse}\n");
    }
}

/// A text in which bytes that VTK reads otherwise are written as `%20`.
fn encoded(text: &str) -> String {
    let mut encoded = String::new();
    for byte in text.bytes() {
        if byte.is_ascii_graphic() && byte != b'%' && byte != b'"' {
            encoded.push(char::from(byte));
        } else {
            // Writing to a string cannot fail.
            let _ = write!(encoded, "%{byte:02X}");
        }
    }
    encoded
}
