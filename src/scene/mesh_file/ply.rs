//! PLY: the elements `vertex` and `face`, in text and in both binary forms.

use std::io::BufRead;

use super::assembly::{ALL, Assembly};
use super::defect::Defect;
use super::fault::{MeshFault, Place};
use super::lines::Lines;
use super::ply_header::{self, Element, Encoding, Scalar};
use super::ply_numbers::{Binary, Numbers, Text};
use super::{MOST_CORNERS, MOST_TRIANGLES};

/// Reads a PLY file into the assembly.
pub(super) fn read(source: impl BufRead, assembly: &mut Assembly) -> Result<(), MeshFault> {
    let mut lines = Lines::new(source);
    let header = ply_header::read(&mut lines)?;
    let here = Place::Line(lines.number());
    let missing = |missing| Defect::NotInHeader { missing }.at(here);
    let position = |name| {
        header
            .elements
            .iter()
            .position(|element| element.name == name)
    };
    let vertices = position("vertex").ok_or_else(|| missing("element `vertex`"))?;
    let faces = position("face").ok_or_else(|| missing("element `face`"))?;
    if vertices > faces {
        return Err(missing("element `vertex` before the element `face`"));
    }
    // Each of its faces gives at least one triangle; a promise of too many need not be read.
    if header.elements[faces].count > MOST_TRIANGLES as u64 {
        return Err(Defect::TooManyTriangles.at(Place::File));
    }
    let plan = Plan::new(&header.elements[vertices], &header.elements[faces]).map_err(missing)?;
    let mut reader = Reader {
        assembly,
        vertices: Vec::new(),
        corners: Vec::new(),
        plan,
    };
    let elements = &header.elements[..=faces];
    match header.encoding {
        Encoding::Text => reader.elements(elements, &mut Text::new(lines)),
        encoding => {
            let little_endian = encoding == Encoding::LittleEndian;
            reader.elements(elements, &mut Binary::new(lines, little_endian))
        }
    }
}

/// Which properties are wanted.
struct Plan {
    coordinates: [usize; 3],
    corners: usize,
}

impl Plan {
    /// The wanted properties, or the one that is missing.
    fn new(vertex: &Element, face: &Element) -> Result<Self, &'static str> {
        let coordinate = |name, missing| {
            vertex
                .position(&[name])
                .filter(|position| vertex.properties[*position].length.is_none())
                .ok_or(missing)
        };
        let corners = face
            .position(&["vertex_indices", "vertex_index"])
            .filter(|position| {
                let property = &face.properties[*position];
                property.length.is_some() && !matches!(property.value, Scalar::F32 | Scalar::F64)
            });
        Ok(Self {
            coordinates: [
                coordinate("x", "property `x` of the vertices")?,
                coordinate("y", "property `y` of the vertices")?,
                coordinate("z", "property `z` of the vertices")?,
            ],
            corners: corners.ok_or("list of integers `vertex_indices` of the faces")?,
        })
    }
}

struct Reader<'a> {
    assembly: &'a mut Assembly,
    /// Number in the mesh of each vertex of the file.
    vertices: Vec<u32>,
    corners: Vec<u32>,
    plan: Plan,
}

impl Reader<'_> {
    fn elements(
        &mut self,
        elements: &[Element],
        numbers: &mut impl Numbers,
    ) -> Result<(), MeshFault> {
        let surface = self.assembly.surface(ALL);
        for element in elements
            .iter()
            .filter(|element| !element.properties.is_empty())
        {
            for count in 0..element.count {
                if !numbers.next_element()? {
                    let expected = match element.name.as_str() {
                        "vertex" => "another vertex",
                        "face" => "another face",
                        _ => "another element",
                    };
                    let place = numbers.place(&element.name, count);
                    return Err(Defect::EndsEarly { expected }.at(place));
                }
                match element.name.as_str() {
                    "vertex" => self.vertex(element, numbers),
                    "face" => self.face(element, numbers, surface),
                    _ => pass_over(element, numbers),
                }
                .and_then(|()| numbers.end_element())
                .map_err(|defect| defect.at(numbers.place(&element.name, count)))?;
            }
        }
        Ok(())
    }

    fn vertex(&mut self, element: &Element, numbers: &mut impl Numbers) -> Result<(), Defect> {
        let mut coordinates = [0.0; 3];
        for (position, property) in element.properties.iter().enumerate() {
            if property.length.is_some() {
                list(property, numbers, |_| Ok(()))?;
                continue;
            }
            let value = numbers.next(property.value)?;
            for (coordinate, wanted) in coordinates.iter_mut().zip(self.plan.coordinates) {
                if wanted == position {
                    *coordinate = value;
                }
            }
        }
        self.vertices.push(self.assembly.vertex(coordinates)?);
        Ok(())
    }

    fn face(
        &mut self,
        element: &Element,
        numbers: &mut impl Numbers,
        surface: u32,
    ) -> Result<(), Defect> {
        self.corners.clear();
        for (position, property) in element.properties.iter().enumerate() {
            if property.length.is_none() {
                numbers.next(property.value)?;
                continue;
            }
            list(property, numbers, |value| {
                if position != self.plan.corners {
                    return Ok(());
                }
                let index = value as i64;
                let corner = usize::try_from(index)
                    .ok()
                    .and_then(|index| self.vertices.get(index))
                    .ok_or(Defect::NoSuchVertex {
                        index,
                        vertices: self.vertices.len(),
                        first: 0,
                    })?;
                self.corners.push(*corner);
                if self.corners.len() > MOST_CORNERS {
                    return Err(Defect::TooManyCorners {
                        corners: self.corners.len(),
                    });
                }
                Ok(())
            })?;
        }
        if self.corners.len() < 3 {
            let corners = self.corners.len().to_string();
            return Err(Defect::unexpected(
                "a face of at least three corners",
                corners.as_bytes(),
            ));
        }
        self.assembly.face(&self.corners, surface)
    }
}

/// Reads a list and hands over its values.
fn list(
    property: &ply_header::Property,
    numbers: &mut impl Numbers,
    mut take: impl FnMut(f64) -> Result<(), Defect>,
) -> Result<(), Defect> {
    let Some(length) = property.length else {
        return Ok(());
    };
    let length = numbers.next(length)?;
    if length < 0.0 {
        let length = length.to_string();
        return Err(Defect::unexpected(
            "the length of a list",
            length.as_bytes(),
        ));
    }
    for _ in 0..length as u64 {
        take(numbers.next(property.value)?)?;
    }
    Ok(())
}

fn pass_over(element: &Element, numbers: &mut impl Numbers) -> Result<(), Defect> {
    for property in &element.properties {
        match property.length {
            Some(_) => list(property, numbers, |_| Ok(()))?,
            None => drop(numbers.next(property.value)?),
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::mesh::Mesh;

    fn mesh(bytes: &[u8]) -> Result<Mesh, Defect> {
        let mut assembly = Assembly::new(1.0);
        read(bytes, &mut assembly).map_err(|fault| fault.defect)?;
        assembly.finish()
    }

    fn header(encoding: &str, kind: &str, faces: usize, indices: &str) -> String {
        format!(
            "ply\nformat {encoding} 1.0\nelement vertex 3\nproperty {kind} x\nproperty float y\n\
             property float z\nelement face {faces}\nproperty list {indices} vertex_indices\n\
             end_header\n"
        )
    }

    #[test]
    fn every_kind_of_number_is_read() {
        // The x coordinates -3, 7 and 100, or without a sign 3, 7 and 100.
        let signed = [-3_i8, 7, 100];
        let unsigned = [3_u8, 7, 100];
        let bytes = |number: &[u8], is_little: bool| {
            let mut number = number.to_vec();
            if !is_little {
                number.reverse();
            }
            number
        };
        for (names, kind) in [
            (["char", "int8"], 0),
            (["uchar", "uint8"], 1),
            (["short", "int16"], 2),
            (["ushort", "uint16"], 3),
            (["int", "int32"], 4),
            (["uint", "uint32"], 5),
            (["float", "float32"], 6),
            (["double", "float64"], 7),
        ] {
            let encoded = |corner: usize| match kind {
                0 => signed[corner].to_le_bytes().to_vec(),
                1 => unsigned[corner].to_le_bytes().to_vec(),
                2 => i16::from(signed[corner]).to_le_bytes().to_vec(),
                3 => u16::from(unsigned[corner]).to_le_bytes().to_vec(),
                4 => i32::from(signed[corner]).to_le_bytes().to_vec(),
                5 => u32::from(unsigned[corner]).to_le_bytes().to_vec(),
                6 => f32::from(signed[corner]).to_le_bytes().to_vec(),
                _ => f64::from(signed[corner]).to_le_bytes().to_vec(),
            };
            let first = if matches!(kind, 1 | 3 | 5) { 3.0 } else { -3.0 };
            for name in names {
                for (encoding, is_little) in
                    [("binary_little_endian", true), ("binary_big_endian", false)]
                {
                    let mut file = header(encoding, name, 1, "uchar ushort").into_bytes();
                    for (corner, number) in unsigned.into_iter().enumerate() {
                        file.extend(bytes(&encoded(corner), is_little));
                        let y = f32::from(number) * 2.0;
                        file.extend(bytes(&y.to_le_bytes(), is_little));
                        let z = f32::from(number % 2) - 0.5;
                        file.extend(bytes(&z.to_le_bytes(), is_little));
                    }
                    file.push(3);
                    for corner in [0_u16, 1, 2] {
                        file.extend(bytes(&corner.to_le_bytes(), is_little));
                    }
                    let found = mesh(&file).unwrap_or_else(|defect| panic!("{name}: {defect:?}"));
                    let expected = [[first, 6.0, 0.5], [7.0, 14.0, 0.5], [100.0, 200.0, -0.5]];
                    let expected = expected.map(nalgebra::Point3::from);
                    assert_eq!(found.vertices, expected, "{name}, {encoding}");
                    // A file that is cut short says so.
                    let short = mesh(&file[..file.len() - 1]);
                    assert!(
                        matches!(
                            short,
                            Err(Defect::EndsEarly {
                                expected: "another number"
                            })
                        ),
                        "{short:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn faces_have_three_corners_to_as_many_as_are_bearable() {
        // The last corner of a face is no vertex; the fault of the size comes first.
        let found = |corners: usize| {
            let face: String = (1..corners)
                .map(|corner| format!(" {}", corner % 3))
                .collect();
            let head = header("ascii", "double", 1, "int int");
            mesh(format!("{head}0 0 0\n1 0 0\n0 1 0\n{corners}{face} 9\n").as_bytes())
        };
        for corners in [1, 3, MOST_CORNERS, MOST_CORNERS + 1] {
            let found = found(corners);
            assert!(matches!(found, Err(Defect::NoSuchVertex { index: 9, .. })));
        }
        assert!(matches!(
            found(MOST_CORNERS + 2),
            Err(Defect::TooManyCorners { corners }) if corners == MOST_CORNERS + 1
        ));
        let corners = |face: &str| {
            let head = header("ascii", "double", 1, "int int");
            mesh(format!("{head}0 0 0\n1 0 0\n0 1 0\n{face}\n").as_bytes())
        };
        assert!(matches!(corners("2 0 1"), Err(Defect::Unexpected { .. })));
        assert!(corners("3 0 1 2").is_ok());
    }

    #[test]
    fn a_promise_of_too_many_faces_is_not_read() {
        let found = |faces: usize| mesh(header("ascii", "double", faces, "int int").as_bytes());
        let too_many = |faces: usize| matches!(found(faces), Err(Defect::TooManyTriangles));
        assert!(!too_many(MOST_TRIANGLES));
        assert!(too_many(MOST_TRIANGLES + 1));
        assert!(too_many(MOST_TRIANGLES + 2));
    }

    #[test]
    fn vertices_come_before_faces() {
        let file = "ply\nformat ascii 1.0\nelement face 0\nproperty list int int vertex_indices\n\
                    element vertex 0\nproperty float x\nproperty float y\nproperty float z\n\
                    end_header\n";
        let Err(Defect::NotInHeader { missing }) = mesh(file.as_bytes()) else {
            panic!("the order is wrong");
        };
        assert_eq!(missing, "element `vertex` before the element `face`");
    }
}
