//! The lines and words of a text mesh.

use std::io::BufRead;

use super::defect::{Defect, LONGEST_LINE};
use super::fault::{MeshFault, Place};

/// What some editors put before the first line.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// What fills the rest of a block on old media, and what ended a text on old systems.
const PADDING: [u8; 2] = [0, 0x1a];

/// Reads a file line by line through one buffer. A line ends in LF, CR LF or CR.
pub(super) struct Lines<R> {
    source: R,
    buffer: Vec<u8>,
    /// A line that was read but not yet wanted.
    ahead: Option<Vec<u8>>,
    number: u64,
    /// Whether the last line ended in CR, so that an LF behind it belongs to its end.
    after_cr: bool,
    /// Whether the end of the first line was CR and no more.
    has_cr_ends: bool,
}

/// One line of a file.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    pub text: &'a [u8],
    /// From 1.
    pub number: u64,
}

impl<R: BufRead> Lines<R> {
    pub fn new(source: R) -> Self {
        Self {
            source,
            buffer: Vec::new(),
            ahead: None,
            number: 0,
            after_cr: false,
            has_cr_ends: false,
        }
    }

    /// The next line, without its end; `None` at the end of the file. A line that ends in `\` goes on
    /// in the next one, provided that it is one of numbers and that the next one begins with a number:
    /// names and paths may end in `\`, too.
    pub fn next_continued(
        &mut self,
        is_of_numbers: impl Fn(&[u8]) -> bool,
    ) -> Result<Option<Line<'_>>, MeshFault> {
        let more = self.advance()?;
        let number = self.number;
        while let Some(before) = self.buffer.trim_ascii_end().strip_suffix(b"\\")
            && is_of_numbers(before)
        {
            let kept = before.len();
            let mut ahead = Vec::new();
            if !self.append(&mut ahead)? {
                self.buffer.truncate(kept);
                break;
            }
            if !goes_on(&ahead) {
                self.buffer.truncate(kept);
                self.ahead = Some(ahead);
                break;
            }
            self.buffer.truncate(kept);
            self.buffer.push(b' ');
            self.buffer.extend(ahead);
            if self.buffer.len() > LONGEST_LINE {
                return Err(Defect::LineTooLong.at(Place::Line(self.number)));
            }
        }
        Ok(more.then_some(Line {
            text: &self.buffer,
            number,
        }))
    }

    /// The next line that is not blank; a fault if there is none.
    pub fn next_filled(&mut self, expected: &'static str) -> Result<Line<'_>, MeshFault> {
        if !self.skip_blank()? {
            return Err(self.ends_early(expected));
        }
        Ok(Line {
            text: &self.buffer,
            number: self.number,
        })
    }

    /// Goes to the next line that is not blank, which [`Lines::current`] then gives; false if there
    /// is none.
    pub fn skip_blank(&mut self) -> Result<bool, MeshFault> {
        loop {
            if !self.advance()? {
                return Ok(false);
            }
            if !self.buffer.trim_ascii().is_empty() {
                return Ok(true);
            }
        }
    }

    /// The line that was read last.
    pub fn current(&self) -> Line<'_> {
        Line {
            text: &self.buffer,
            number: self.number,
        }
    }

    /// The fault of a file that ends here.
    pub fn ends_early(&self, expected: &'static str) -> MeshFault {
        Defect::EndsEarly { expected }.at(Place::Line(self.number.max(1)))
    }

    /// Number of lines read.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// The source, just behind the last line that was read.
    pub fn into_source(mut self) -> Result<R, MeshFault> {
        // In a file whose lines end in CR, an LF is the first byte of what follows.
        if self.after_cr && !self.has_cr_ends {
            self.pass_over_lf()?;
        }
        Ok(self.source)
    }

    /// Reads the next line into the buffer; false at the end of the file.
    fn advance(&mut self) -> Result<bool, MeshFault> {
        if let Some(ahead) = self.ahead.take() {
            self.buffer = ahead;
            return Ok(true);
        }
        let mut buffer = std::mem::take(&mut self.buffer);
        buffer.clear();
        let more = self.append(&mut buffer);
        self.buffer = buffer;
        more
    }

    /// Appends a line to a buffer; false at the end of the file.
    fn append(&mut self, line: &mut Vec<u8>) -> Result<bool, MeshFault> {
        let here = Place::Line(self.number + 1);
        let had_cr = self.after_cr;
        let has_lf = self.pass_over_lf()?;
        if self.number == 1 && had_cr {
            self.has_cr_ends = !has_lf;
        }
        let mut read = 0;
        loop {
            let bytes = self.source.fill_buf();
            let bytes = bytes.map_err(|error| Defect::from(error).at(here))?;
            if bytes.is_empty() {
                break;
            }
            let end = bytes.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
            let text = &bytes[..end.unwrap_or(bytes.len())];
            let padding = match line.is_empty() {
                true => text.iter().take_while(|it| PADDING.contains(it)).count(),
                false => 0,
            };
            line.extend_from_slice(&text[padding..]);
            self.after_cr = end.is_some_and(|end| bytes[end] == b'\r');
            let used = text.len() + usize::from(end.is_some());
            self.source.consume(used);
            read += used;
            let ends = line.len() + usize::from(end.is_some());
            if ends > LONGEST_LINE {
                return Err(Defect::LineTooLong.at(here));
            }
            if end.is_some() {
                break;
            }
        }
        if read == 0 {
            return Ok(false);
        }
        self.number += 1;
        if self.number == 1 && line.starts_with(BYTE_ORDER_MARK) {
            line.drain(..BYTE_ORDER_MARK.len());
        }
        Ok(true)
    }

    /// Whether the rest of a line end that began with CR stood here.
    fn pass_over_lf(&mut self) -> Result<bool, MeshFault> {
        if !std::mem::take(&mut self.after_cr) {
            return Ok(false);
        }
        let here = Place::Line(self.number + 1);
        let bytes = self.source.fill_buf();
        let bytes = bytes.map_err(|error| Defect::from(error).at(here))?;
        let is_lf = bytes.first() == Some(&b'\n');
        if is_lf {
            self.source.consume(1);
        }
        Ok(is_lf)
    }
}

/// Whether a line begins with more numbers, or is blank.
fn goes_on(line: &[u8]) -> bool {
    match line.trim_ascii_start().first() {
        Some(first) => first.is_ascii_digit() || b"+-.\\#".contains(first),
        None => true,
    }
}

impl<'a> Line<'a> {
    pub fn words(self) -> impl Iterator<Item = &'a [u8]> {
        words(self.text)
    }

    /// A fault of this line.
    pub fn fault(self, defect: Defect) -> MeshFault {
        defect.at(Place::Line(self.number))
    }

    /// A fault of this line that shows the line.
    pub fn unexpected(self, expected: &'static str) -> MeshFault {
        self.fault(Defect::unexpected(expected, self.text))
    }
}

pub(super) fn words(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split(u8::is_ascii_whitespace)
        .filter(|word| !word.is_empty())
}

/// A name, with something visible where it would move the cursor of a terminal. Bytes that are not
/// UTF-8 are letters of Western Europe, as old programs write them.
pub(super) fn name(text: &[u8]) -> String {
    let text = text.trim_ascii();
    let text = match std::str::from_utf8(text) {
        Ok(text) => text.to_owned(),
        Err(_) => text.iter().map(|byte| char::from(*byte)).collect(),
    };
    text.replace(char::is_control, "\u{fffd}")
}

/// A number in Rust's notation, which includes `nan` and `inf`, or in that of Fortran (`1.0D+00`): what
/// it is worth is checked later.
pub(super) fn number(word: &[u8]) -> Option<f64> {
    let word = std::str::from_utf8(word).ok()?;
    let of_fortran = || word.replace(['d', 'D'], "e").parse().ok();
    word.parse().ok().or_else(of_fortran)
}

/// The next three words as coordinates.
pub(super) fn coordinates<'a>(
    words: &mut impl Iterator<Item = &'a [u8]>,
) -> Result<[f64; 3], Defect> {
    let mut coordinates = [0.0; 3];
    for coordinate in &mut coordinates {
        let word = words.next().unwrap_or_default();
        *coordinate = number(word)
            .ok_or_else(|| Defect::unexpected("three coordinates with decimal points", word))?;
    }
    Ok(coordinates)
}

#[cfg(test)]
mod tests;
