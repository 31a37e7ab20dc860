//! Wavefront OBJ: `v` and `f`, and `g`, `o` or `usemtl` for names; textures, normals, lines and
//! free-form surfaces are passed over. The comment `# deflection 0.01` says how far triangles may be from the
//! surface that they were made from, in the file's unit.

use std::io::BufRead;

use super::assembly::Assembly;
use super::defect::Defect;
use super::fault::MeshFault;
use super::lines::{self, Line, Lines, coordinates, words};
use super::obj_names::{self, Labels};

/// Reads an OBJ file into the assembly.
pub(super) fn read(source: impl BufRead, assembly: &mut Assembly) -> Result<(), MeshFault> {
    let mut reader = Reader {
        assembly,
        vertices: Vec::new(),
        corners: Vec::new(),
        surface: None,
        labels: Labels::default(),
    };
    let mut lines = Lines::new(source);
    while let Some(line) = lines.next_continued(is_of_numbers)? {
        reader.statement(line)?;
    }
    obj_names::name_surfaces(assembly);
    Ok(())
}

/// Whether a line holds numbers, and neither names nor paths nor a comment.
fn is_of_numbers(line: &[u8]) -> bool {
    const KEYWORDS: [&[u8]; 15] = [
        b"v", b"vn", b"vt", b"vp", b"f", b"fo", b"l", b"p", b"deg", b"bmat", b"curv", b"curv2",
        b"surf", b"parm", b"trim",
    ];
    let keyword = words(line).next().unwrap_or_default();
    KEYWORDS.contains(&keyword)
}

/// What a comment says of how far triangles may be from the surface that they were made from.
fn deflection(comment: &[u8]) -> Option<f64> {
    let mut words = words(comment);
    let is_told = words.next()? == b"deflection";
    let number = std::str::from_utf8(words.next()?).ok()?;
    let length: f64 = number.parse().ok()?;
    (is_told && length > 0.0 && length.is_finite()).then_some(length)
}

struct Reader<'a> {
    assembly: &'a mut Assembly,
    /// Number in the mesh of each `v` so far.
    vertices: Vec<u32>,
    /// Corners of the face being read.
    corners: Vec<u32>,
    /// Number of the surface that faces go to, once the first does.
    surface: Option<u32>,
    /// What the file calls these faces.
    labels: Labels,
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
            // `fo` is the older word.
            b"f" | b"fo" => self.face(line, rest),
            b"g" | b"o" | b"usemtl" => {
                let name = lines::name(rest);
                match keyword {
                    b"g" => self.labels.group = name,
                    b"o" => self.labels.object = name,
                    _ => self.labels.material = name,
                }
                self.surface = None;
                Ok(())
            }
            b"#" => {
                if let Some(deflection) = deflection(rest) {
                    self.assembly.deflects_by(deflection);
                }
                Ok(())
            }
            [] | [b'#', ..] => Ok(()),
            [b'a'..=b'z' | b'A'..=b'Z' | b'_', ..] if keyword.is_ascii() => Ok(()),
            _ => Err(line.unexpected("an OBJ statement such as `v`, `f` or `g`")),
        }
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
            None => *self
                .surface
                .insert(self.assembly.surface(&self.labels.key())),
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
