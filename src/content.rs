//! What the bytes of a file are, told before the reader of any format sees them: text in one of its
//! encodings, or a file of another kind that only bears the name.

mod foreign;
mod utf16;

pub(crate) use foreign::Foreign;
pub(crate) use utf16::Utf16;

/// Bytes at the beginning of a file that are enough to tell.
pub(crate) const HEAD: usize = 1024;

/// UTF-8's byte order mark, which some editors put before a text.
const UTF8_MARK: &[u8] = b"\xef\xbb\xbf";

/// What the bytes of a file are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Content {
    /// Nothing that is known here: UTF-8 text, or a format of its own.
    Plain,
    /// Text of 16 bit units.
    Utf16(ByteOrder),
    /// A file of another kind.
    Foreign(Foreign),
}

/// Which byte of a unit comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ByteOrder {
    /// The low one.
    Little,
    /// The high one.
    Big,
}

impl Content {
    /// Tells from the first [`HEAD`] bytes, or from all where there are fewer.
    pub fn of(head: &[u8]) -> Self {
        if let Some(order) = utf16::order(head) {
            return Self::Utf16(order);
        }
        Foreign::of(head).map_or(Self::Plain, Self::Foreign)
    }
}

/// A short file as text, without a byte order mark and with LF for every line end.
///
/// # Errors
/// The kind of the file, if it is no text.
pub(crate) fn text(bytes: &[u8]) -> Result<Vec<u8>, Foreign> {
    let head = &bytes[..bytes.len().min(HEAD)];
    let decoded = match Content::of(head) {
        Content::Plain => bytes.strip_prefix(UTF8_MARK).unwrap_or(bytes).to_vec(),
        Content::Utf16(order) => utf16::decoded(bytes, order),
        Content::Foreign(foreign) => return Err(foreign),
    };
    Ok(with_lf(decoded))
}

/// The text with LF for each lone CR; CR LF stays.
fn with_lf(mut text: Vec<u8>) -> Vec<u8> {
    for at in 0..text.len() {
        if text[at] == b'\r' && text.get(at + 1) != Some(&b'\n') {
            text[at] = b'\n';
        }
    }
    // What fills the rest of a block on old media.
    let padding = text.iter().rev().take_while(|it| matches!(it, 0 | 0x1a));
    text.truncate(text.len() - padding.count());
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The text in UTF-16.
    fn utf16(text: &str, order: ByteOrder) -> Vec<u8> {
        let units = text.encode_utf16();
        match order {
            ByteOrder::Little => units.flat_map(u16::to_le_bytes).collect(),
            ByteOrder::Big => units.flat_map(u16::to_be_bytes).collect(),
        }
    }

    #[test]
    fn text_is_the_same_in_every_encoding() {
        let meant = "format: 1\ntitle: größer als 1, und zwar um ein Stück 😀\n";
        let mut written = vec![
            meant.as_bytes().to_vec(),
            [UTF8_MARK, meant.as_bytes()].concat(),
        ];
        for order in [ByteOrder::Little, ByteOrder::Big] {
            written.push(utf16(&format!("\u{feff}{meant}"), order));
            written.push(utf16(meant, order));
        }
        for bytes in written {
            let found = text(&bytes).map(|text| String::from_utf8_lossy(&text).into_owned());
            assert_eq!(found.as_deref(), Ok(meant), "{bytes:?}");
        }
    }

    #[test]
    fn line_ends_of_cr_become_lf_and_those_of_cr_lf_stay() {
        for (written, read) in [
            (&b"a\rb\r\rc"[..], &b"a\nb\n\nc"[..]),
            (b"a\r\nb\r", b"a\r\nb\n"),
            (b"a\r\r\nb", b"a\n\r\nb"),
            (b"a\n\0\0\x1a", b"a\n"),
        ] {
            assert_eq!(text(written).as_deref(), Ok(read));
        }
    }

    #[test]
    fn files_of_another_kind_are_no_text() {
        let gzip = text(&[0x1f, 0x8b, 8, 0, 0, 0]).expect_err("it is no text");
        assert_eq!(gzip.to_string(), "this is a gzip archive: unpack it");
    }
}
