//! The lines and words of a text mesh.

use std::io::{BufRead, Read};

use super::defect::{Defect, LONGEST_LINE};
use super::fault::{MeshFault, Place};

/// What some editors put before the first line.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Reads a file line by line through one buffer.
pub(super) struct Lines<R> {
    source: R,
    buffer: Vec<u8>,
    number: u64,
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
            number: 0,
        }
    }

    /// The next line, without its end; `None` at the end of the file.
    pub fn next(&mut self) -> Result<Option<Line<'_>>, MeshFault> {
        self.buffer.clear();
        let more = self.append()?;
        Ok(more.then_some(Line {
            text: &self.buffer,
            number: self.number,
        }))
    }

    /// As [`Lines::next`]; a line that ends in `\` goes on in the next one, unless it is a comment.
    pub fn next_continued(&mut self) -> Result<Option<Line<'_>>, MeshFault> {
        self.buffer.clear();
        let more = self.append()?;
        let number = self.number;
        while self.buffer.last() == Some(&b'\\') && self.buffer[0] != b'#' {
            self.buffer.pop();
            self.buffer.push(b' ');
            self.append()?;
        }
        Ok(more.then_some(Line {
            text: &self.buffer,
            number,
        }))
    }

    /// The next line that is not blank; a fault if there is none.
    pub fn next_filled(&mut self, expected: &'static str) -> Result<Line<'_>, MeshFault> {
        loop {
            self.buffer.clear();
            if !self.append()? {
                return Err(Defect::EndsEarly { expected }.at(Place::Line(self.number.max(1))));
            }
            if !self.buffer.trim_ascii().is_empty() {
                return Ok(Line {
                    text: &self.buffer,
                    number: self.number,
                });
            }
        }
    }

    /// Number of lines read.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// The source, just behind the last line that was read.
    pub fn into_source(self) -> R {
        self.source
    }

    /// Appends a line to the buffer; false at the end of the file.
    fn append(&mut self) -> Result<bool, MeshFault> {
        let here = Place::Line(self.number + 1);
        let room = (LONGEST_LINE + 1).saturating_sub(self.buffer.len());
        let read = (&mut self.source)
            .take(room as u64)
            .read_until(b'\n', &mut self.buffer)
            .map_err(|error| Defect::from(error).at(here))?;
        if self.buffer.len() > LONGEST_LINE {
            return Err(Defect::LineTooLong.at(here));
        }
        if read == 0 {
            return Ok(false);
        }
        self.number += 1;
        for end in [b'\n', b'\r'] {
            if self.buffer.last() == Some(&end) {
                self.buffer.pop();
            }
        }
        if self.number == 1 && self.buffer.starts_with(BYTE_ORDER_MARK) {
            self.buffer.drain(..BYTE_ORDER_MARK.len());
        }
        Ok(true)
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

/// A name, with something visible where it would move the cursor of a terminal.
pub(super) fn name(text: &[u8]) -> String {
    let text = String::from_utf8_lossy(text.trim_ascii());
    text.replace(char::is_control, "\u{fffd}")
}

/// A number in Rust's notation, which includes `nan` and `inf`: what it is worth is checked later.
pub(super) fn number(word: &[u8]) -> Option<f64> {
    std::str::from_utf8(word).ok()?.parse().ok()
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
mod tests {
    use super::*;

    /// How long the lines of a text are, or the line of the fault.
    fn lengths(text: &[u8]) -> Result<Vec<usize>, MeshFault> {
        let mut lines = Lines::new(text);
        let mut lengths = Vec::new();
        while let Some(line) = lines.next()? {
            lengths.push(line.text.len());
        }
        Ok(lengths)
    }

    #[test]
    fn lines_are_as_long_as_is_bearable() {
        // Their ends count.
        let line = |letters: usize, end: &str| {
            let mut text = vec![b'#'; letters];
            text.extend(end.bytes());
            text
        };
        for end in ["", "\n", "\r\n"] {
            let letters = LONGEST_LINE - end.len();
            assert_eq!(lengths(&line(letters, end)).ok(), Some(vec![letters]));
            let fault = lengths(&line(letters + 1, end)).expect_err("it is too long");
            assert_eq!(fault.defect, Defect::LineTooLong, "{end:?}");
        }
        let mut text = b"v 0 0 0\n".to_vec();
        text.extend(line(LONGEST_LINE, "\n"));
        let fault = lengths(&text).expect_err("the second is too long");
        assert_eq!(
            fault.to_string(),
            Defect::LineTooLong.at(Place::Line(2)).to_string()
        );
    }

    #[test]
    fn continued_lines_are_together_as_long_as_one_may_be() {
        let continued = |letters: usize| {
            let text = format!("f\\\n{}\n", "1".repeat(letters));
            let mut lines = Lines::new(text.as_bytes());
            let length = lines.next_continued()?.map(|line| line.text.len());
            Ok::<_, MeshFault>(length)
        };
        // The first gives two, a letter and the blank between the two.
        let room = LONGEST_LINE - 3;
        assert_eq!(continued(room).ok(), Some(Some(LONGEST_LINE - 1)));
        let fault = continued(room + 1).expect_err("it is too long");
        assert_eq!(fault.defect, Defect::LineTooLong);
    }
}
