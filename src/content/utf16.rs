//! Text of 16 bit units, turned into UTF-8 on the way.

use std::io::{self, Read};

use super::ByteOrder;

/// Units at the beginning that must be letters of Western Europe where no mark tells the order.
const SURE: usize = 32;
/// As [`SURE`], of a text that is shorter.
const FEWEST: usize = 4;

/// The order of the bytes, if this is the beginning of such a text.
pub(super) fn order(head: &[u8]) -> Option<ByteOrder> {
    match head {
        // With two zeros behind it, it is the mark of UTF-32.
        [0xff, 0xfe, 0, 0, ..] => None,
        [0xff, 0xfe, ..] => Some(ByteOrder::Little),
        [0xfe, 0xff, ..] => Some(ByteOrder::Big),
        _ => {
            let (units, _) = head.as_chunks::<2>();
            let units = &units[..units.len().min(SURE)];
            let is_letter = |letter: u8, zero: u8| {
                zero == 0 && (letter >= b' ' || letter.is_ascii_whitespace())
            };
            let is = |order: ByteOrder| {
                units.iter().all(|&[first, second]| match order {
                    ByteOrder::Little => is_letter(first, second),
                    ByteOrder::Big => is_letter(second, first),
                })
            };
            let orders = [ByteOrder::Little, ByteOrder::Big];
            orders
                .into_iter()
                .find(|order| units.len() >= FEWEST && is(*order))
        }
    }
}

/// A short text as UTF-8, without its mark.
pub(super) fn decoded(bytes: &[u8], order: ByteOrder) -> Vec<u8> {
    let mut text = Vec::with_capacity(bytes.len());
    // Reading from memory does not fail.
    let _ = Utf16::new(bytes, order).read_to_end(&mut text);
    text
}

/// Reads UTF-16 as UTF-8, without its mark; what is no letter becomes U+FFFD.
pub(crate) struct Utf16<R> {
    source: R,
    order: ByteOrder,
    /// Bytes as they were read; the first of a unit waits here for the second.
    raw: Vec<u8>,
    /// The first half of a letter beyond 16 bits.
    high: Option<u16>,
    /// Letters that wait to be fetched, and how many of their bytes were.
    ready: Vec<u8>,
    fetched: usize,
    is_first: bool,
}

impl<R: Read> Utf16<R> {
    pub fn new(source: R, order: ByteOrder) -> Self {
        Self {
            source,
            order,
            raw: Vec::new(),
            high: None,
            ready: Vec::new(),
            fetched: 0,
            is_first: true,
        }
    }

    /// Decodes some more; false at the end.
    fn refill(&mut self) -> io::Result<bool> {
        const CHUNK: u64 = 1 << 16;
        self.ready.clear();
        self.fetched = 0;
        let waiting = self.raw.len();
        let mut raw = std::mem::take(&mut self.raw);
        (&mut self.source).take(CHUNK).read_to_end(&mut raw)?;
        let is_end = raw.len() == waiting;
        let (units, rest) = raw.as_chunks::<2>();
        for unit in units {
            let unit = match self.order {
                ByteOrder::Little => u16::from_le_bytes(*unit),
                ByteOrder::Big => u16::from_be_bytes(*unit),
            };
            self.take(unit);
        }
        self.raw = rest.to_vec();
        if is_end && (self.high.take().is_some() | !std::mem::take(&mut self.raw).is_empty()) {
            self.push(char::REPLACEMENT_CHARACTER);
        }
        Ok(!is_end || !self.ready.is_empty())
    }

    fn take(&mut self, unit: u16) {
        const MARK: u16 = 0xfeff;
        if std::mem::take(&mut self.is_first) && unit == MARK {
            return;
        }
        let waiting = self.high.take();
        let letter = |units: &[u16]| char::decode_utf16(units.iter().copied()).next();
        if let Some(high) = waiting {
            if let Some(Ok(letter)) = letter(&[high, unit]) {
                return self.push(letter);
            }
            self.push(char::REPLACEMENT_CHARACTER);
        }
        match letter(&[unit]) {
            Some(Ok(letter)) => self.push(letter),
            // The first half of a letter, whose second half comes next.
            _ if unit < 0xdc00 => self.high = Some(unit),
            _ => self.push(char::REPLACEMENT_CHARACTER),
        }
    }

    fn push(&mut self, letter: char) {
        let mut bytes = [0; 4];
        self.ready.extend(letter.encode_utf8(&mut bytes).bytes());
    }
}

impl<R: Read> Read for Utf16<R> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        while self.fetched == self.ready.len() {
            if !self.refill()? {
                return Ok(0);
            }
        }
        let rest = &self.ready[self.fetched..];
        let count = rest.len().min(into.len());
        into[..count].copy_from_slice(&rest[..count]);
        self.fetched += count;
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gives one byte at a time.
    struct Drops<'a>(&'a [u8]);

    impl Read for Drops<'_> {
        fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
            let count = self.0.len().min(into.len()).min(1);
            into[..count].copy_from_slice(&self.0[..count]);
            self.0 = &self.0[count..];
            Ok(count)
        }
    }

    fn text(units: &[u16], order: ByteOrder) -> String {
        let bytes: Vec<u8> = match order {
            ByteOrder::Little => units.iter().flat_map(|it| it.to_le_bytes()).collect(),
            ByteOrder::Big => units.iter().flat_map(|it| it.to_be_bytes()).collect(),
        };
        let mut text = String::new();
        let mut source = Utf16::new(Drops(&bytes), order);
        source.read_to_string(&mut text).expect("it is UTF-8");
        assert_eq!(text.as_bytes(), decoded(&bytes, order));
        text
    }

    #[test]
    fn letters_of_one_and_of_two_units_are_read() {
        let meant = "a\u{e4}\u{20ac}\u{1f600}z";
        let mut units: Vec<u16> = meant.encode_utf16().collect();
        for order in [ByteOrder::Little, ByteOrder::Big] {
            assert_eq!(text(&units, order), meant);
        }
        units.insert(0, 0xfeff);
        assert_eq!(text(&units, ByteOrder::Big), meant);
    }

    #[test]
    fn halves_of_letters_are_replaced() {
        for (units, expected) in [
            (&[0xd83d, 0x61][..], "\u{fffd}a"),
            (&[0xd83d, 0xd83d, 0xde00], "\u{fffd}\u{1f600}"),
            (&[0xde00, 0x61], "\u{fffd}a"),
            (&[0x61, 0xd83d], "a\u{fffd}"),
        ] {
            assert_eq!(text(units, ByteOrder::Little), expected, "{units:x?}");
        }
        assert_eq!(decoded(b"a\0b", ByteOrder::Little), "a\u{fffd}".as_bytes());
        assert_eq!(decoded(b"", ByteOrder::Little), b"");
    }

    #[test]
    fn the_order_is_told_with_and_without_a_mark() {
        for (head, expected) in [
            (&b"\xff\xfes\0"[..], Some(ByteOrder::Little)),
            (b"\xfe\xff\0s", Some(ByteOrder::Big)),
            (b"s\0o\0l\0i\0", Some(ByteOrder::Little)),
            (b"\0s\0o\0l\0i", Some(ByteOrder::Big)),
            (b"s\0o\0l\0", None),
            (b"solid a\n", None),
            (b"\0\0\0\0\0\0\0\0", None),
            (b"\xff\xfe\0\0s\0\0\0", None),
        ] {
            assert_eq!(order(head), expected, "{head:?}");
        }
    }
}
