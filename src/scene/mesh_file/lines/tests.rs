use super::*;

/// How long the lines of a text are, or the line of the fault.
fn lengths(text: &[u8]) -> Result<Vec<usize>, MeshFault> {
    let mut lines = Lines::new(text);
    let mut lengths = Vec::new();
    while let Some(line) = lines.next_continued(|_| false)? {
        lengths.push(line.text.len());
    }
    Ok(lengths)
}

#[test]
fn lines_are_as_long_as_is_bearable() {
    // Their ends count as one letter.
    let line = |letters: usize, end: &str| {
        let mut text = vec![b'#'; letters];
        text.extend(end.bytes());
        text
    };
    for end in ["", "\n", "\r\n", "\r"] {
        let letters = LONGEST_LINE - usize::from(!end.is_empty());
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
        let length = lines.next_continued(|_| true)?.map(|line| line.text.len());
        Ok::<_, MeshFault>(length)
    };
    // The first gives two, a letter and the blank between the two.
    let room = LONGEST_LINE - 2;
    assert_eq!(continued(room).ok(), Some(Some(LONGEST_LINE)));
    let fault = continued(room + 1).expect_err("it is too long");
    assert_eq!(fault.defect, Defect::LineTooLong);
}

#[test]
fn lines_end_in_whatever_editors_write() {
    let texts = |bytes: &[u8]| {
        // Every place for the end of a buffer.
        (1..=bytes.len().max(1))
            .map(|size| {
                let mut lines = Lines::new(std::io::BufReader::with_capacity(size, bytes));
                let mut texts = Vec::new();
                while let Some(line) = lines.next_continued(|_| false).expect("it can be read") {
                    texts.push((line.number, String::from_utf8_lossy(line.text).into_owned()));
                }
                texts
            })
            .reduce(|one, other| {
                assert_eq!(one, other, "{bytes:?}");
                one
            })
    };
    let expected = ["a", "b", "", "c"].map(str::to_owned);
    let expected: Vec<(u64, String)> = (1..).zip(expected).collect();
    for bytes in [
        "a\nb\n\nc",
        "a\r\nb\r\n\r\nc\r\n",
        "a\rb\r\rc\r",
        "a\rb\n\r\nc\n",
    ] {
        assert_eq!(
            texts(bytes.as_bytes()).as_ref(),
            Some(&expected),
            "{bytes:?}"
        );
    }
    let marked = texts(b"\xef\xbb\xbfa\nb\n\nc\n\0\0\0\x1a\0").expect("it has bytes");
    assert_eq!(marked[..4], expected);
    assert_eq!(marked[4..], [(5, String::new())]);
}

#[test]
fn what_follows_a_line_keeps_its_first_byte() {
    for (bytes, rest) in [
        (&b"a\nb\n\nrest"[..], &b"\nrest"[..]),
        (b"a\r\nb\r\n\nrest", b"\nrest"),
        (b"a\rb\r\nrest", b"\nrest"),
        (b"a\rb\rrest", b"rest"),
    ] {
        let mut lines = Lines::new(bytes);
        for _ in 0..2 {
            lines.next_continued(|_| false).expect("it can be read");
        }
        assert_eq!(lines.into_source().ok(), Some(rest), "{bytes:?}");
    }
}

#[test]
fn only_numbers_go_on_in_the_next_line() {
    let texts = |text: &str| {
        let mut lines = Lines::new(text.as_bytes());
        let mut texts = Vec::new();
        let of_numbers = |line: &[u8]| line.starts_with(b"f");
        while let Some(line) = lines.next_continued(of_numbers).expect("it can be read") {
            texts.push((line.number, String::from_utf8_lossy(line.text).into_owned()));
        }
        texts
    };
    let line = |number: u64, text: &str| (number, text.to_owned());
    assert_eq!(
        texts("f 1 \\\n2 \\ \n 3\nf"),
        [line(1, "f 1  2   3"), line(4, "f")]
    );
    assert_eq!(texts("g a\\\n1\n"), [line(1, "g a\\"), line(2, "1")]);
    assert_eq!(
        texts("f 1 2 3\\\nf 4\n"),
        [line(1, "f 1 2 3"), line(2, "f 4")]
    );
    assert_eq!(texts("f 1 2 3\\"), [line(1, "f 1 2 3")]);
}

#[test]
fn numbers_are_those_of_rust_and_fortran() {
    for (word, value) in [
        ("1.5e-3", 1.5e-3),
        ("1.5D-03", 1.5e-3),
        ("-2d0", -2.0),
        ("+.5", 0.5),
    ] {
        assert_eq!(number(word.as_bytes()), Some(value), "{word}");
    }
    for word in ["", "d", "1,5", "1.5-3", "0x10", "1_000"] {
        assert_eq!(number(word.as_bytes()), None, "{word}");
    }
}
