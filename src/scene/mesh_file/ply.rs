//! PLY: the elements `vertex` and `face`, in text and in both binary forms.

use std::io::BufRead;

use super::assembly::{ALL, Assembly};
use super::defect::Defect;
use super::fault::{MeshFault, Place};
use super::lines::Lines;
use super::mending::Mending;
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
    let is_last = faces + 1 == header.elements.len();
    match header.encoding {
        Encoding::Text => reader.all(elements, is_last, &mut Text::new(lines)),
        encoding => {
            let little_endian = encoding == Encoding::LittleEndian;
            let mut numbers = Binary::new(lines, little_endian)?;
            reader.all(elements, is_last, &mut numbers)
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
    /// Reads the elements up to the faces; `is_last` where no other follows these.
    fn all(
        &mut self,
        elements: &[Element],
        is_last: bool,
        numbers: &mut impl Numbers,
    ) -> Result<(), MeshFault> {
        let surface = self.assembly.surface(ALL);
        self.elements(elements, surface, numbers)?;
        let Some(faces) = elements.last().filter(|_| is_last) else {
            return Ok(());
        };
        if faces.count == 0 {
            self.uncounted_faces(faces, surface, numbers)
        } else {
            let trailing = numbers.trailing()?;
            trailing.into_iter().for_each(|it| self.assembly.mended(it));
            Ok(())
        }
    }

    /// Reads faces to the end of a file whose writer left their number at 0.
    fn uncounted_faces(
        &mut self,
        element: &Element,
        surface: u32,
        numbers: &mut impl Numbers,
    ) -> Result<(), MeshFault> {
        let mut held = 0;
        while numbers.next_element()? {
            self.face(element, numbers, surface)
                .and_then(|()| numbers.end_element())
                .map_err(|defect| defect.at(numbers.place(&element.name, held)))?;
            held += 1;
        }
        if held > 0 {
            self.assembly
                .mended(Mending::Recounted { promised: 0, held });
        }
        Ok(())
    }

    fn elements(
        &mut self,
        elements: &[Element],
        surface: u32,
        numbers: &mut impl Numbers,
    ) -> Result<(), MeshFault> {
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
                    let fault = Defect::EndsEarly { expected }.at(place);
                    if element.name != "face" || count == 0 {
                        return Err(fault);
                    }
                    // Faces that make a closed mesh are all there, whatever the header says.
                    self.assembly.mended(Mending::Recounted {
                        promised: element.count,
                        held: count,
                    });
                    self.assembly.must_close(fault);
                    return Ok(());
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
mod tests;
