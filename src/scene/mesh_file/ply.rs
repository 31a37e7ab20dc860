//! PLY: the elements `vertex` and `face`, in text and in both binary forms.

use std::io::BufRead;

use super::assembly::{ALL, Assembly};
use super::fault::{Defect, MeshFault, Place};
use super::lines::{Lines, number, words};
use super::ply_header::{self, Element, Encoding, Scalar};
use super::{MOST_CORNERS, MOST_TRIANGLES};

/// Reads a PLY file of so many bytes into the assembly.
pub(super) fn read(
    source: impl BufRead,
    bytes: u64,
    assembly: &mut Assembly,
) -> Result<(), MeshFault> {
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
    let plan = Plan::new(&header.elements[vertices], &header.elements[faces]).map_err(missing)?;
    for element in &header.elements[vertices..=faces] {
        if element.count > bytes || element.count > 3 * MOST_TRIANGLES as u64 {
            return Err(Defect::TooManyTriangles.at(here));
        }
    }
    let mut reader = Reader {
        assembly,
        vertices: Vec::new(),
        corners: Vec::new(),
        plan,
    };
    let elements = &header.elements[..=faces];
    match header.encoding {
        Encoding::Text => reader.elements(elements, &mut Text::new(lines)),
        encoding => reader.elements(
            elements,
            &mut Binary {
                source: lines.into_source(),
                little_endian: encoding == Encoding::LittleEndian,
            },
        ),
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

/// A stream of numbers behind a header.
trait Numbers {
    /// Goes to the next element; false if the file ends there.
    fn next_element(&mut self) -> Result<bool, MeshFault>;
    /// The next number of the element; every integer type fits into f64.
    fn next(&mut self, scalar: Scalar) -> Result<f64, Defect>;
    /// Where the element of this number (from 0) stands.
    fn place(&self, kind: &str, number: u64) -> Place;
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

/// One element a line.
struct Text<R> {
    lines: Lines<R>,
    line: Vec<u8>,
    read: usize,
}

impl<R: BufRead> Text<R> {
    fn new(lines: Lines<R>) -> Self {
        Self {
            lines,
            line: Vec::new(),
            read: 0,
        }
    }
}

impl<R: BufRead> Numbers for Text<R> {
    fn next_element(&mut self) -> Result<bool, MeshFault> {
        self.line.clear();
        self.read = 0;
        let line = self.lines.next()?;
        self.line
            .extend_from_slice(line.map_or(&[], |line| line.text));
        Ok(line.is_some())
    }

    fn next(&mut self, scalar: Scalar) -> Result<f64, Defect> {
        let rest = &self.line[self.read..];
        let word = words(rest).next().unwrap_or_default();
        let start = rest.len() - rest.trim_ascii_start().len();
        self.read = (self.read + start + word.len()).min(self.line.len());
        let value = number(word).ok_or_else(|| Defect::unexpected("another number", word))?;
        match scalar {
            Scalar::F32 | Scalar::F64 => Ok(value),
            _ if value.fract() == 0.0 => Ok(value),
            _ => Err(Defect::unexpected("a whole number", word)),
        }
    }

    fn place(&self, _kind: &str, _number: u64) -> Place {
        Place::Line(self.lines.number())
    }
}

/// Elements side by side, without a break.
struct Binary<R> {
    source: R,
    little_endian: bool,
}

impl<R: BufRead> Binary<R> {
    fn bytes<const N: usize>(&mut self) -> Result<[u8; N], Defect> {
        let mut bytes = [0; N];
        self.source
            .read_exact(&mut bytes)
            .map_err(|error| match error.kind() {
                std::io::ErrorKind::UnexpectedEof => Defect::EndsEarly {
                    expected: "another number",
                },
                _ => error.into(),
            })?;
        if !self.little_endian {
            bytes.reverse();
        }
        Ok(bytes)
    }
}

impl<R: BufRead> Numbers for Binary<R> {
    fn next_element(&mut self) -> Result<bool, MeshFault> {
        let ahead = self.source.fill_buf();
        let ahead = ahead.map_err(|error| Defect::from(error).at(Place::File))?;
        Ok(!ahead.is_empty())
    }

    fn next(&mut self, scalar: Scalar) -> Result<f64, Defect> {
        Ok(match scalar {
            Scalar::I8 => i8::from_le_bytes(self.bytes()?).into(),
            Scalar::U8 => u8::from_le_bytes(self.bytes()?).into(),
            Scalar::I16 => i16::from_le_bytes(self.bytes()?).into(),
            Scalar::U16 => u16::from_le_bytes(self.bytes()?).into(),
            Scalar::I32 => i32::from_le_bytes(self.bytes()?).into(),
            Scalar::U32 => u32::from_le_bytes(self.bytes()?).into(),
            Scalar::F32 => f32::from_le_bytes(self.bytes()?).into(),
            Scalar::F64 => f64::from_le_bytes(self.bytes()?),
        })
    }

    fn place(&self, kind: &str, number: u64) -> Place {
        match kind {
            "vertex" => Place::Vertex(number),
            "face" => Place::Face(number),
            _ => Place::File,
        }
    }
}
