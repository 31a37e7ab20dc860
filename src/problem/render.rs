//! Faults for people: each with the line of the file, or each on a line of its own.

use std::fmt::Write as _;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};

use super::fault::Fault;
use super::source::Source;

/// More faults than this are only counted: nobody reads them before mending the first ones.
const MOST_SHOWN: usize = 100;

/// Shows every fault with the line that it stands in, as compilers do; of very many the first 100.
///
/// ```
/// use std::path::Path;
///
/// let reading = peenpose::problem::read_text("format: 2", Path::new("keyway.yaml"))?;
/// let text = peenpose::problem::render(&reading.source, &reading.faults, false);
/// assert!(text.contains("format: 2"));
/// # Ok::<(), Box<peenpose::problem::fault::Fault>>(())
/// ```
pub fn render(source: &Source, faults: &[Fault], color: bool) -> String {
    let renderer = if color {
        Renderer::styled()
    } else {
        Renderer::plain()
    };
    let renderer = renderer.decor_style(DecorStyle::Ascii);
    let path = source.path.display().to_string();
    let mut text = String::new();
    for fault in faults.iter().take(MOST_SHOWN) {
        let report = [report(source, &path, fault)];
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}\n", renderer.render(&report));
    }
    if faults.len() > MOST_SHOWN {
        let _ = writeln!(text, "... and {} more faults", faults.len() - MOST_SHOWN);
    }
    text
}

fn report<'a>(source: &'a Source, path: &'a str, fault: &'a Fault) -> Group<'a> {
    let title = match fault.key.as_str() {
        "" => fault.message.clone(),
        key => format!("{key}: {}", fault.message),
    };
    let expected = fault
        .expected
        .as_deref()
        .map(|expected| format!("expected {expected}"));
    let mut group = Group::with_title(Level::ERROR.primary_title(title));
    match fault.at {
        Some(at) => {
            let end = at.end.min(source.text.len());
            let mut mark = AnnotationKind::Primary.span(at.start.min(end)..end);
            if let Some(expected) = expected {
                mark = mark.label(expected);
            }
            group = group.element(
                Snippet::source(source.text.as_str())
                    .path(path)
                    .annotation(mark),
            );
        }
        None => {
            group = group.element(Origin::path(path));
            if let Some(expected) = expected {
                group = group.element(Level::NOTE.message(expected));
            }
        }
    }
    if let Some(suggestion) = &fault.suggestion {
        group = group.element(Level::HELP.message(format!("did you mean `{suggestion}`?")));
    }
    group
}

/// One fault on one line: `file:line:column: key: what is wrong; expected ...`.
pub fn one_line(source: &Source, fault: &Fault) -> String {
    let path = source.path.display();
    let line = match fault.at {
        Some(at) => format!("{path}:{}:{}: {fault}", at.line, at.column),
        None => format!("{path}: {fault}"),
    };
    // Names out of the file must not move the cursor of a terminal.
    line.replace(char::is_control, "\u{fffd}")
}
