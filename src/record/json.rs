//! JSON with a line for each key, but lists of numbers on one line; and what is needed to read it.

use std::borrow::Cow;
use std::io::{self, Write};

use serde::Serialize;
use serde_json::ser::{Formatter, Serializer};

use crate::printable::{acts, line};

/// A value as JSON text.
pub(super) fn text(value: &impl Serialize) -> Result<String, serde_json::Error> {
    let mut bytes = Vec::new();
    value.serialize(&mut Serializer::with_formatter(
        &mut bytes,
        Lines::default(),
    ))?;
    bytes.push(b'\n');
    String::from_utf8(bytes).map_err(serde::ser::Error::custom)
}

/// Breaks lines before keys and before objects in a list.
#[derive(Default)]
struct Lines {
    /// The brackets that are open.
    open: Vec<Bracket>,
}

/// An open bracket.
struct Bracket {
    is_list: bool,
    /// Whether there is a line break inside it.
    is_broken: bool,
}

impl Lines {
    fn open<W: ?Sized + Write>(&mut self, writer: &mut W, bracket: u8) -> io::Result<()> {
        self.open.push(Bracket {
            is_list: bracket == b'[',
            is_broken: false,
        });
        writer.write_all(&[bracket])
    }

    fn close<W: ?Sized + Write>(&mut self, writer: &mut W, bracket: u8) -> io::Result<()> {
        if self.open.pop().is_some_and(|opened| opened.is_broken) {
            self.new_line(writer)?;
        }
        writer.write_all(&[bracket])
    }

    fn break_line<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        if let Some(innermost) = self.open.last_mut() {
            innermost.is_broken = true;
        }
        self.new_line(writer)
    }

    fn new_line<W: ?Sized + Write>(&self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b"\n")?;
        (0..self.open.len()).try_for_each(|_| writer.write_all(b"  "))
    }
}

impl Formatter for Lines {
    fn begin_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.open(writer, b'[')
    }

    fn end_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b']')
    }

    fn begin_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        if self.open.last().is_some_and(|around| around.is_list) {
            self.break_line(writer)?;
        }
        self.open(writer, b'{')
    }

    fn end_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.close(writer, b'}')
    }

    fn begin_object_key<W: ?Sized + Write>(
        &mut self,
        writer: &mut W,
        first: bool,
    ) -> io::Result<()> {
        if !first {
            writer.write_all(b",")?;
        }
        self.break_line(writer)
    }

    /// What acts on a terminal is written as an escape wherever JSON would leave it as it is.
    fn write_string_fragment<W: ?Sized + Write>(
        &mut self,
        writer: &mut W,
        fragment: &str,
    ) -> io::Result<()> {
        let mut rest = fragment;
        while let Some((at, c)) = rest.char_indices().find(|&(_, c)| acts(c)) {
            let (before, after) = rest.split_at(at);
            write!(writer, "{before}\\u{:04x}", u32::from(c))?;
            rest = &after[c.len_utf8()..];
        }
        writer.write_all(rest.as_bytes())
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b": ")
    }
}

/// A JSON text whose strings, once read, hold nothing that acts on a terminal.
pub(super) fn printable(text: &str) -> Cow<'_, str> {
    let may_act = |c: char| c == '\\' || (acts(c) && !matches!(c, '\n' | '\r' | '\t'));
    if !text.contains(may_act) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find(may_act) {
        let (before, special) = rest.split_at(at);
        shown.push_str(before);
        let (length, replaced) = match special.strip_prefix('\\') {
            Some(_) => escape(special),
            None => {
                let length = special.chars().next().map_or(1, char::len_utf8);
                (length, line(&special[..length]))
            }
        };
        shown.push_str(&replaced);
        rest = &special[length..];
    }
    shown.push_str(rest);
    Cow::Owned(shown)
}

/// The bytes of an escape and what stands for it: the same, or the sign of what acts.
fn escape(text: &str) -> (usize, Cow<'_, str>) {
    let whole = |length: usize| text.get(..length).unwrap_or(text);
    let (length, character) = match text.as_bytes().get(1) {
        Some(b'n') => (2, Some('\n')),
        Some(b'r') => (2, Some('\r')),
        Some(b't') => (2, Some('\t')),
        Some(b'b') => (2, Some('\u{8}')),
        Some(b'f') => (2, Some('\u{c}')),
        Some(b'u') => {
            let digits = text.get(2..6);
            let code = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok());
            (whole(6).len(), code.and_then(char::from_u32))
        }
        Some(byte) if byte.is_ascii() => (2, None),
        _ => (1, None),
    };
    match character.filter(|&c| acts(c)) {
        Some(c) => (length, line(c.encode_utf8(&mut [0; 4])).into_owned().into()),
        None => (whole(length).len(), whole(length).into()),
    }
}

/// The path of the key whose value stands at a place, such as `best.verdicts[2].share`.
pub(super) fn key_at(text: &str, line: usize, column: usize) -> String {
    let before: usize = text
        .split_inclusive('\n')
        .take(line.saturating_sub(1))
        .map(str::len)
        .sum();
    let end = (before + column).min(text.len());
    let mut path: Vec<Step> = Vec::new();
    let mut last = String::new();
    let mut bytes = text.as_bytes()[..end].iter();
    while let Some(byte) = bytes.next() {
        match byte {
            b'"' => {
                let mut string = Vec::new();
                while let Some(&byte) = bytes.next().filter(|&&byte| byte != b'"') {
                    string.push(byte);
                    if byte == b'\\' {
                        string.extend(bytes.next());
                    }
                }
                last = String::from_utf8_lossy(&string).into_owned();
            }
            b':' => {
                if let Some(Step::Key(key)) = path.last_mut() {
                    *key = std::mem::take(&mut last);
                }
            }
            // The last byte belongs to the value before it.
            b',' if bytes.len() > 0 => match path.last_mut() {
                Some(Step::Item(index)) => *index += 1,
                Some(Step::Key(key)) => key.clear(),
                None => {}
            },
            b'{' => path.push(Step::Key(String::new())),
            b'[' => path.push(Step::Item(0)),
            b'}' | b']' if bytes.len() > 0 => {
                path.pop();
            }
            _ => {}
        }
    }
    let mut shown = String::new();
    for step in path {
        match step {
            Step::Key(key) if key.is_empty() => {}
            Step::Key(key) if shown.is_empty() => shown = key,
            Step::Key(key) => shown += &format!(".{key}"),
            Step::Item(index) => shown += &format!("[{index}]"),
        }
    }
    shown
}

/// One step on the way to a key.
enum Step {
    Key(String),
    Item(usize),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_read_back_acts_on_no_terminal_and_stays_json() {
        let text = "{\"a\": \"x\\u001b[2J\\n\\\"\\\\n\\u00e9\u{202e}\",\r\n\t\"b\\u0000\": 1}";
        let shown = printable(text);
        let value: serde_json::Value = serde_json::from_str(&shown).expect("still JSON");
        assert_eq!(value["a"], "x\u{241b}[2J\u{240a}\"\\n\u{e9}\u{fffd}");
        assert_eq!(value["b\u{2400}"], 1);
        // Broken escapes are left to the reader.
        for broken in ["\"\\", "\"\\u12", "\"\\u\u{e9}\u{e9}", "\"\\\u{202e}"] {
            let _ = printable(broken);
        }
    }

    #[test]
    fn a_key_is_found_by_the_place_of_its_value() {
        let text = "{\n \"a\": 1,\n \"b\": {\"c,:{\": [1, {\"d\": null}], \"e\": 2}\n}";
        let at = |sign: &str| {
            let offset = text.find(sign).expect("it is there") + sign.len();
            let before = &text[..offset];
            let line = before.matches('\n').count() + 1;
            let column = offset - before.rfind('\n').map_or(0, |at| at + 1);
            key_at(text, line, column)
        };
        assert_eq!(at("\"a\": 1"), "a");
        assert_eq!(at("null"), "b.c,:{[1].d");
        assert_eq!(at("\"e\": 2"), "b.e");
        assert_eq!(key_at("", 1, 0), "");
        assert_eq!(key_at("nonsense", 9, 99), "");
    }
}
