//! The header of a PLY file: which elements follow, and of which numbers each is made.

use std::io::BufRead;

use super::defect::Defect;
use super::fault::{MeshFault, Place};
use super::lines::{Line, Lines};

/// How the numbers behind the header are written.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// A kind of number.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// One property of an element: a number, or a list behind its length.
pub(super) struct Property {
    pub name: String,
    pub length: Option<Scalar>,
    pub value: Scalar,
}

/// So many things made of the same properties.
pub(super) struct Element {
    pub name: String,
    pub count: u64,
    pub properties: Vec<Property>,
}

/// What the header says.
pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
}

/// Most lines that a header may have; a file without `end_header` is given up there.
const MOST_LINES: u64 = 10_000;

/// Reads up to and including `end_header`.
pub(super) fn read(lines: &mut Lines<impl BufRead>) -> Result<Header, MeshFault> {
    let magic = lines.next_filled("`ply`")?;
    if magic.text.trim_ascii() != b"ply" {
        return Err(magic.unexpected("`ply` as the first line"));
    }
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    loop {
        let line = lines.next_filled("the rest of the PLY header, up to `end_header`,")?;
        let words: Vec<&[u8]> = line.words().take(6).collect();
        match words[..] {
            [b"comment" | b"obj_info", ..] => {}
            [b"format", name, b"1.0"] => encoding = Some(Encoding::of(name, line)?),
            [b"element", name, count] => {
                let element = Element::new(name, count, line)?;
                if elements.iter().any(|other| other.name == element.name) {
                    return Err(line.unexpected("an element that is not there twice"));
                }
                elements.push(element);
            }
            [b"property", ..] => {
                let property = Property::new(&words[1..], line)?;
                match elements.last_mut() {
                    Some(element)
                        if element
                            .properties
                            .iter()
                            .all(|other| other.name != property.name) =>
                    {
                        element.properties.push(property);
                    }
                    Some(_) => return Err(line.unexpected("a property that is not there twice")),
                    None => return Err(line.unexpected("an `element` before its properties")),
                }
            }
            [b"end_header"] => break,
            _ => {
                return Err(
                    line.unexpected("a line of a PLY 1.0 header such as `element` or `property`")
                );
            }
        }
        if line.number > MOST_LINES {
            return Err(line.unexpected("`end_header`"));
        }
    }
    let encoding = encoding.ok_or_else(|| {
        let missing = "line `format ... 1.0`";
        Defect::NotInHeader { missing }.at(Place::Line(lines.number()))
    })?;
    Ok(Header { encoding, elements })
}

impl Encoding {
    fn of(name: &[u8], line: Line) -> Result<Self, MeshFault> {
        match name {
            b"ascii" => Ok(Self::Text),
            b"binary_little_endian" => Ok(Self::LittleEndian),
            b"binary_big_endian" => Ok(Self::BigEndian),
            _ => {
                Err(line
                    .unexpected("format `ascii`, `binary_little_endian` or `binary_big_endian`"))
            }
        }
    }
}

impl Element {
    fn new(name: &[u8], count: &[u8], line: Line) -> Result<Self, MeshFault> {
        let count = std::str::from_utf8(count)
            .ok()
            .and_then(|count| count.parse().ok());
        Ok(Self {
            name: String::from_utf8_lossy(name).into_owned(),
            count: count.ok_or_else(|| line.unexpected("a number of elements"))?,
            properties: Vec::new(),
        })
    }

    /// Where a property stands among the others.
    pub fn position(&self, names: &[&str]) -> Option<usize> {
        self.properties
            .iter()
            .position(|property| names.contains(&property.name.as_str()))
    }
}

impl Property {
    fn new(words: &[&[u8]], line: Line) -> Result<Self, MeshFault> {
        let scalar = |word| Scalar::of(word).ok_or_else(|| line.unexpected("a PLY number type"));
        let (length, value, name) = match *words {
            [b"list", length, value, name] => (Some(scalar(length)?), scalar(value)?, name),
            [value, name] => (None, scalar(value)?, name),
            _ => return Err(line.unexpected("`property`, its type and its name")),
        };
        if matches!(length, Some(Scalar::F32 | Scalar::F64)) {
            return Err(line.unexpected("a list whose length is an integer"));
        }
        Ok(Self {
            name: String::from_utf8_lossy(name).into_owned(),
            length,
            value,
        })
    }
}

impl Scalar {
    fn of(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_have_as_many_lines_as_is_bearable() {
        let header = |lines: u64| {
            let comments = "comment\n".repeat(lines as usize - 3);
            let text = format!("ply\n{comments}format ascii 1.0\nend_header\n");
            let read = read(&mut Lines::new(text.as_bytes()));
            read.map(|header| header.elements.len())
        };
        for lines in [3, 100, MOST_LINES, MOST_LINES + 1] {
            assert_eq!(header(lines).ok(), Some(0), "{lines}");
        }
        // Given up behind the first line that is too many and does not end it.
        let fault = header(MOST_LINES + 2).expect_err("it is too long");
        let line = format!("line {}", MOST_LINES + 1);
        assert!(fault.to_string().contains(&line), "{fault}");
        assert!(header(3 * MOST_LINES).is_err());
    }
}
