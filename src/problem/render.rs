//! Faults for people: each with the line of the file, or each on a line of its own.

use std::fmt::Write as _;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Origin, Renderer, Snippet};

use super::fault::{Fault, Span};
use super::source::Source;
use super::warning::Warning;
use crate::printable;

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
    let path = shown_path(source);
    let reports = faults.iter().map(|fault| report(source, &path, fault));
    let mut text = rendered(reports.take(MOST_SHOWN), color);
    if faults.len() > MOST_SHOWN {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "... and {} more faults", faults.len() - MOST_SHOWN);
    }
    text
}

/// Shows every warning with the line that it is about.
pub fn render_warnings(source: &Source, warnings: &[Warning], color: bool) -> String {
    let path = shown_path(source);
    let report = |warning: &'_ Warning| {
        let title = shown(&format!("{}: {}", warning.key, warning.message));
        let group = Group::with_title(Level::WARNING.primary_title(title));
        let group = match warning.at {
            Some(at) => group.element(snippet(source, &path, at, None)),
            None => group.element(Origin::path(path.clone())),
        };
        group.element(Level::HELP.message(shown(&warning.help)))
    };
    rendered(warnings.iter().map(report), color)
}

fn rendered<'a>(reports: impl Iterator<Item = Group<'a>>, color: bool) -> String {
    let renderer = if color {
        Renderer::styled()
    } else {
        Renderer::plain()
    };
    let renderer = renderer.decor_style(DecorStyle::Ascii);
    let texts = reports.map(|report| format!("{}\n\n", renderer.render(&[report])));
    texts.collect()
}

fn shown_path(source: &Source) -> String {
    printable::line(&source.path.display().to_string()).into_owned()
}

/// What titles and labels say, whatever of the file they quote.
fn shown(text: &str) -> String {
    printable::lines(text).into_owned()
}

/// A place in the text, with what is said there.
fn snippet<'a>(
    source: &'a Source,
    path: &'a str,
    at: Span,
    label: Option<String>,
) -> Snippet<'a, Annotation<'a>> {
    let end = at.end.min(source.text.len());
    let mut mark = AnnotationKind::Primary.span(at.start.min(end)..end);
    if let Some(label) = label {
        mark = mark.label(label);
    }
    Snippet::source(source.text.as_str())
        .path(path)
        .annotation(mark)
}

fn report<'a>(source: &'a Source, path: &'a str, fault: &'a Fault) -> Group<'a> {
    let title = match fault.key.as_str() {
        "" => shown(&fault.message),
        key => shown(&format!("{key}: {}", fault.message)),
    };
    let expected = fault
        .expected
        .as_deref()
        .map(|expected| shown(&format!("expected {expected}")));
    let mut group = Group::with_title(Level::ERROR.primary_title(title));
    match fault.at {
        Some(at) => {
            group = group.element(snippet(source, path, at, expected));
        }
        None => {
            group = group.element(Origin::path(path));
            if let Some(expected) = expected {
                group = group.element(Level::NOTE.message(expected));
            }
        }
    }
    if let Some(suggestion) = &fault.suggestion {
        let message = shown(&format!("did you mean `{suggestion}`?"));
        group = group.element(Level::HELP.message(message));
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
    printable::line(&line).into_owned()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::problem::fault_code::FaultCode;

    #[test]
    fn of_very_many_faults_the_rest_is_counted() {
        let shown = |count: usize| {
            let reading = crate::problem::read_text("format: 2", Path::new("any.yaml"));
            let source = reading.expect("it is short enough").source;
            let fault = Fault::at_key(FaultCode::UnknownFormat, "format", "wrong");
            render(&source, &vec![fault; count], false)
        };
        for count in [1, MOST_SHOWN] {
            let text = shown(count);
            assert_eq!(text.matches("format: wrong").count(), count);
            assert!(!text.contains("more faults"), "{count}");
        }
        let text = shown(MOST_SHOWN + 7);
        assert_eq!(text.matches("format: wrong").count(), MOST_SHOWN);
        assert!(text.ends_with("... and 7 more faults\n"));
    }

    #[test]
    fn a_fault_on_one_line_tells_its_place_and_moves_no_cursor() {
        let reading = crate::problem::read_text("format: 2", Path::new("any.yaml"));
        let source = reading.expect("it is short enough").source;
        let mut fault = Fault::at_key(FaultCode::UnknownFormat, "format", "wrong\u{1b}[2J\nindeed");
        let message = "format: wrong\u{241b}[2J\u{240a}indeed";
        let line = one_line(&source, &fault);
        assert_eq!(line, format!("any.yaml: {message}"));
        fault.at = Some(Span {
            line: 3,
            column: 9,
            start: 0,
            end: 1,
        });
        let line = one_line(&source, &fault);
        assert_eq!(line, format!("any.yaml:3:9: {message}"));
    }
}
