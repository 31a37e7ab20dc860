//! The smooth faces of a mesh as a table.

use super::layout::{Align, Block, Table};
use super::number::{count, plain};
use crate::digits::significant;
use crate::scene::mesh::{Form, Mesh, SmoothFace, SmoothFaces};

/// The largest faces, with a point of each; lengths in the unit of the file.
pub fn faces(mesh: &Mesh, faces: &SmoothFaces, most: usize) -> String {
    let mut block = Block::default();
    let mut table = Table::new(&[
        ("FACE", Align::Right),
        ("surface", Align::Left),
        ("form", Align::Left),
        ("area", Align::Right),
        ("triangles", Align::Right),
        ("size x y z", Align::Left),
        ("at: a point on it", Align::Left),
    ]);
    for (number, face) in largest(faces).into_iter().take(most) {
        table.row([
            (number + 1).to_string(),
            mesh.surfaces[face.surface as usize].clone(),
            form(&face.form),
            significant(face.area, 4),
            count(face.triangles),
            listed((face.high - face.low).into(), 4),
            format!("[{}]", listed_with(", ", face.at.coords.into(), 6)),
        ]);
    }
    block.table(table);
    let hidden = faces.list.len().saturating_sub(most);
    let rest = match hidden {
        0 => String::new(),
        hidden => format!(" {hidden} smaller ones are not shown."),
    };
    block.paragraph(&format!(
        "{} faces, lengths in the unit of the file.{rest} In a problem file a point names a face: regions: {{ floor: \
         {{ at: [x, y, z] }} }}.",
        faces.list.len()
    ));
    block.into_text()
}

/// The faces by their areas, each with its number.
pub(super) fn largest(faces: &SmoothFaces) -> Vec<(usize, &SmoothFace)> {
    let mut order: Vec<(usize, &SmoothFace)> = faces.list.iter().enumerate().collect();
    order.sort_by(|a, b| b.1.area.total_cmp(&a.1.area));
    order
}

fn form(form: &Form) -> String {
    match form {
        Form::Plane { normal } => format!("plane, normal {}", listed((*normal).into(), 3)),
        Form::Cylinder {
            axis,
            radius,
            is_hole,
        } => {
            let kind = if *is_hole { "hole" } else { "cylinder" };
            let radius = plain(*radius);
            format!(
                "{kind}, radius {radius}, axis {}",
                listed((*axis).into(), 3)
            )
        }
        Form::Free => "curved".to_owned(),
    }
}

/// What is below this share of the largest number beside it is rounding.
const NOTHING: f64 = 1e-4;

fn listed(numbers: [f64; 3], digits: i32) -> String {
    listed_with(" ", numbers, digits)
}

fn listed_with(between: &str, numbers: [f64; 3], digits: i32) -> String {
    let scale = numbers.iter().fold(0.0_f64, |most, it| most.max(it.abs()));
    let shown = numbers.map(|number| {
        let number = if number.abs() < NOTHING * scale {
            0.0
        } else {
            number
        };
        crate::digits::rounded(number, digits)
    });
    shown.join(between)
}
