//! Wavefront OBJ: `v`, `f`, `g` and `o`; textures, normals, materials, lines and free-form surfaces
//! are passed over.

use std::io::BufRead;

use super::assembly::{ALL, Assembly};
use super::defect::Defect;
use super::fault::MeshFault;
use super::lines::{self, Line, Lines, coordinates, words};

/// Reads an OBJ file into the assembly.
pub(super) fn read(source: impl BufRead, assembly: &mut Assembly) -> Result<(), MeshFault> {
    let mut reader = Reader {
        assembly,
        vertices: Vec::new(),
        corners: Vec::new(),
        surface: None,
        name: ALL.to_owned(),
        grouped: false,
    };
    let mut lines = Lines::new(source);
    while let Some(line) = lines.next_continued()? {
        reader.statement(line)?;
    }
    Ok(())
}

struct Reader<'a> {
    assembly: &'a mut Assembly,
    /// Number in the mesh of each `v` so far.
    vertices: Vec<u32>,
    /// Corners of the face being read.
    corners: Vec<u32>,
    /// Number of the surface that faces go to, once the first does.
    surface: Option<u32>,
    /// Its name.
    name: String,
    /// Whether there was a `g`: then `o` counts no longer.
    grouped: bool,
}

impl Reader<'_> {
    fn statement(&mut self, line: Line) -> Result<(), MeshFault> {
        let text = line.text.trim_ascii();
        let (keyword, rest) = match text.iter().position(u8::is_ascii_whitespace) {
            Some(end) => text.split_at(end),
            None => (text, &[][..]),
        };
        match keyword {
            b"v" => self.vertex(line, rest),
            b"f" => self.face(line, rest),
            b"g" => {
                if !self.grouped {
                    self.grouped = true;
                    self.assembly.forget_surfaces();
                }
                self.enter(rest);
                Ok(())
            }
            b"o" if !self.grouped => {
                self.enter(rest);
                Ok(())
            }
            [] | [b'#', ..] => Ok(()),
            [b'a'..=b'z' | b'A'..=b'Z' | b'_', ..] if keyword.is_ascii() => Ok(()),
            _ => Err(line.unexpected("an OBJ statement such as `v`, `f` or `g`")),
        }
    }

    fn enter(&mut self, name: &[u8]) {
        self.name = match lines::name(name) {
            name if name.is_empty() => ALL.to_owned(),
            name => name,
        };
        self.surface = None;
    }

    fn vertex(&mut self, line: Line, rest: &[u8]) -> Result<(), MeshFault> {
        let vertex = coordinates(&mut words(rest))
            .and_then(|coordinates| self.assembly.vertex(coordinates))
            .map_err(|defect| line.fault(defect))?;
        self.vertices.push(vertex);
        Ok(())
    }

    fn face(&mut self, line: Line, rest: &[u8]) -> Result<(), MeshFault> {
        self.corners.clear();
        for word in words(rest).take_while(|word| word[0] != b'#') {
            let corner = self.corner(word).map_err(|defect| line.fault(defect))?;
            self.corners.push(corner);
        }
        if self.corners.len() < 3 {
            return Err(line.unexpected("a face of at least three corners"));
        }
        let surface = match self.surface {
            Some(surface) => surface,
            None => *self.surface.insert(self.assembly.surface(&self.name)),
        };
        self.assembly
            .face(&self.corners, surface)
            .map_err(|defect| line.fault(defect))
    }

    /// `7`, `7/2`, `7//3` or `7/2/3`; negative numbers count back from the last vertex.
    fn corner(&self, word: &[u8]) -> Result<u32, Defect> {
        let vertex = word.split(|letter| *letter == b'/').next().unwrap_or(word);
        let index: i64 = std::str::from_utf8(vertex)
            .ok()
            .and_then(|digits| digits.parse().ok())
            .ok_or_else(|| Defect::unexpected("the number of a vertex", word))?;
        let position = match index {
            1.. => usize::try_from(index - 1).ok(),
            _ => usize::try_from(index.unsigned_abs())
                .ok()
                .filter(|back| *back > 0)
                .and_then(|back| self.vertices.len().checked_sub(back)),
        };
        position
            .and_then(|position| self.vertices.get(position).copied())
            .ok_or(Defect::NoSuchVertex {
                index,
                vertices: self.vertices.len(),
                first: 1,
            })
    }
}
