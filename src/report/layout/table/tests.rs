use super::*;
use crate::report::layout::words;

#[test]
fn long_names_get_a_line_of_their_own() {
    let mut table = Table::new(&[("NAMES", Align::Left), ("value", Align::Right)]);
    let long = "part.".repeat(25);
    table.row([long.clone(), "1".into()]);
    table.row(["short".into(), "12".into()]);
    let text = table.render();
    assert!(text.lines().all(|line| length(line) <= WIDTH), "{text}");
    assert!(text.lines().all(|line| line.trim_end() == line));
    assert_eq!(text.matches("part.").count(), 25);
}

#[test]
fn columns_are_aligned_below_their_headings() {
    let mut table = Table::new(&[("NAMES", Align::Left), ("value", Align::Right)]);
    table.row(["a".into(), "1.0".into()]);
    table.row(["bcdef".into(), "12.0".into()]);
    assert_eq!(
        table.render(),
        "NAMES    value\n  a        1.0\n  bcdef   12.0\n"
    );
}

/// A table like that of the effects, with a long name in a column that is not the last.
fn effects(turns: &str) -> Table {
    let mut table = Table::new(&[
        ("MODEL, without", Align::Left),
        ("J", Align::Right),
        ("best settings move", Align::Left),
        ("costing", Align::Right),
        ("turns", Align::Left),
        ("search", Align::Left),
    ]);
    let cells = [
        "rebounds after the first",
        "+0.12 %",
        "aim_across +0.31 mm",
        "x 12",
        turns,
        "without",
    ];
    table.row(cells.map(str::to_owned));
    table
}

#[test]
fn no_column_is_narrower_than_its_longest_word() {
    for turns in [
        "-",
        "hub.bore",
        "cam.flank_of_the_third_lobe",
        "a fairly long name of several words",
    ] {
        for width in 12..=200 {
            let table = effects(turns);
            let text = table.render_in(width);
            assert!(
                text.lines().all(|line| length(line) <= width),
                "{width}\n{text}"
            );
            let cells = table.head.iter().chain(&table.rows[0]);
            for word in cells.flat_map(|cell| words(cell)) {
                let is_whole = text.lines().any(|line| line.contains(&word));
                // What is longer than a line, further in where it stands below, has to be cut.
                assert!(
                    is_whole || length(&word) + 2 * INDENT > width,
                    "{word} in {width}\n{text}"
                );
            }
        }
    }
}

#[test]
fn what_has_no_room_beside_the_others_stands_below_with_its_heading() {
    let text = effects(&"long".repeat(12)).render_in(80);
    let lines: Vec<&str> = text.lines().collect();
    let last = format!("    turns: {}", "long".repeat(12));
    assert_eq!(lines.last(), Some(&last.as_str()), "{text}");
    assert!(lines[1].ends_with("without"), "{text}");
}

#[test]
fn headings_and_texts_are_wrapped_before_anything_moves() {
    let mut table = Table::new(&[
        ("NAMES", Align::Left),
        ("share of all", Align::Right),
        ("why", Align::Left),
    ]);
    table.row(["a".into(), "1.0".into(), "one two three".into()]);
    let expected = "\
NAMES  share of
            all  why
  a         1.0  one two
                 three
";
    assert_eq!(table.render_in(24), expected);
}
