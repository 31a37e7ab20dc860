//! The numbers behind the header of a PLY file, as text or as bytes.

use std::io::BufRead;

use super::defect::Defect;
use super::fault::{MeshFault, Place};
use super::lines::{Lines, number, words};
use super::mending::Mending;
use super::ply_header::Scalar;

/// A stream of numbers behind a header.
pub(super) trait Numbers {
    /// Goes to the next element; false if the file ends there.
    fn next_element(&mut self) -> Result<bool, MeshFault>;
    /// The next number of the element; every integer type fits into f64.
    fn next(&mut self, scalar: Scalar) -> Result<f64, Defect>;
    /// Checks that nothing is left of the element.
    fn end_element(&self) -> Result<(), Defect>;
    /// What stands behind the last element.
    fn trailing(&mut self) -> Result<Option<Mending>, MeshFault>;
    /// Where the element of this number (from 0) stands.
    fn place(&self, kind: &str, number: u64) -> Place;
}

/// One element a line.
pub(super) struct Text<R> {
    lines: Lines<R>,
    line: Vec<u8>,
    read: usize,
}

impl<R: BufRead> Text<R> {
    pub fn new(lines: Lines<R>) -> Self {
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
        let more = self.lines.skip_blank()?;
        if more {
            self.line.extend_from_slice(self.lines.current().text);
        }
        Ok(more)
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

    fn end_element(&self) -> Result<(), Defect> {
        match self.line[self.read..].trim_ascii() {
            [] => Ok(()),
            rest => Err(Defect::unexpected("the end of the line", rest)),
        }
    }

    fn trailing(&mut self) -> Result<Option<Mending>, MeshFault> {
        let more = self.lines.skip_blank()?;
        let line = self.lines.number();
        Ok(more.then_some(Mending::TrailingLines { line }))
    }

    fn place(&self, _kind: &str, _number: u64) -> Place {
        Place::Line(self.lines.number())
    }
}

/// Elements side by side, without a break.
pub(super) struct Binary<R> {
    source: R,
    little_endian: bool,
}

impl<R: BufRead> Binary<R> {
    pub fn new(lines: Lines<R>, little_endian: bool) -> Result<Self, MeshFault> {
        Ok(Self {
            source: lines.into_source()?,
            little_endian,
        })
    }

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

    fn end_element(&self) -> Result<(), Defect> {
        Ok(())
    }

    fn trailing(&mut self) -> Result<Option<Mending>, MeshFault> {
        /// One line end does no harm.
        const LINE_END: u64 = 2;
        let bytes = std::io::copy(&mut self.source, &mut std::io::sink());
        let bytes = bytes.map_err(|error| Defect::from(error).at(Place::File))?;
        Ok((bytes > LINE_END).then_some(Mending::TrailingBytes { bytes }))
    }

    fn place(&self, kind: &str, number: u64) -> Place {
        match kind {
            "vertex" => Place::Vertex(number),
            "face" => Place::Face(number),
            _ => Place::File,
        }
    }
}
