//! What is shown: texts, notes, warnings and failures. Nothing that acts on a terminal passes.

use std::fs::File;
use std::io::{ErrorKind, IsTerminal, Read, Write};
use std::path::Path;
use std::process::ExitCode;

use peenpose::printable;
use peenpose::problem::render_warnings;
use peenpose::scenario::Rejection;
use peenpose::study::Study;

/// Exit status of bad input or failure.
pub const BAD_INPUT: u8 = 2;

/// Why a command gave no result.
pub struct Failure(String);

impl From<String> for Failure {
    fn from(message: String) -> Self {
        Self::all(&[message])
    }
}

impl From<Box<Rejection>> for Failure {
    fn from(rejection: Box<Rejection>) -> Self {
        Self(rejection.render(is_colorful(&std::io::stderr())))
    }
}

impl Failure {
    /// A failure for several reasons, each on a line.
    pub fn all(reasons: &[String]) -> Self {
        let line = |reason: &String| format!("error: {}\n", printable::lines(reason));
        Self(reasons.iter().map(line).collect())
    }

    /// Shows it on stderr.
    pub fn report(&self) -> ExitCode {
        tell(&self.0);
        ExitCode::from(BAD_INPUT)
    }
}

/// The first outcome if both are good, or else all that failed.
pub fn both<T>(first: Result<T, Failure>, second: Result<(), Failure>) -> Result<T, Failure> {
    match (first, second) {
        (Err(first), Err(second)) => Err(Failure(first.0 + &second.0)),
        (Ok(_), Err(failure)) => Err(failure),
        (first, Ok(())) => first,
    }
}

/// Shows a text on stderr as it is.
fn tell(text: &str) {
    // Nothing can be done when even stderr is closed.
    let _ = std::io::stderr().write_all(text.as_bytes());
}

/// Shows a text on stderr that is neither result nor failure.
pub fn aside(text: &str) {
    tell(&printable::lines(text));
}

/// Tells something on stderr that is neither result nor failure.
pub fn note(message: &str) {
    aside(&format!("note: {message}\n"));
}

/// Shows on stderr what parses but can hardly be meant; tells how many warnings there are.
pub fn warnings(study: &Study) -> usize {
    let found = study.check();
    tell(&render_warnings(
        study.source(),
        &found,
        is_colorful(&std::io::stderr()),
    ));
    found.len()
}

/// Shows a warning on stderr.
pub fn warn(message: &str) {
    aside(&format!("warning: {message}\n"));
}

/// Prints a text to stdout.
pub fn text(text: impl AsRef<str>) -> Result<ExitCode, Failure> {
    bytes(printable::lines(text.as_ref()).as_bytes())
}

/// Prints a sheet to a terminal: headings in bold, verdicts in green or red.
pub fn highlighted(sheet: &str) -> Result<ExitCode, Failure> {
    let plain = printable::lines(sheet);
    if !is_colorful(&std::io::stdout()) {
        return bytes(plain.as_bytes());
    }
    let mut colored = String::with_capacity(plain.len());
    for line in plain.lines() {
        let words = WORDS.iter().find(|(word, _)| line.contains(word));
        match words {
            Some((word, color)) => {
                colored += &line.replacen(word, &format!("\x1b[{color}m{word}\x1b[0m"), 1);
            }
            None if line.starts_with(|c: char| c.is_ascii_uppercase()) => {
                colored += &format!("\x1b[1m{line}\x1b[0m");
            }
            None => colored += line,
        }
        colored.push('\n');
    }
    bytes(colored.as_bytes())
}

/// Words of a sheet that catch the eye, with their colours: green, red and yellow, in bold.
const WORDS: [(&str, &str); 6] = [
    ("PASS", "1;32"),
    ("FAIL", "1;31"),
    ("NO FEASIBLE POSE", "1;31"),
    ("BUDGET SPENT", "1;33"),
    ("INTERRUPTED", "1;33"),
    ("beware", "1;33"),
];

/// Prints bytes to stdout. A reader that has gone away is not a failure.
pub fn bytes(bytes: &[u8]) -> Result<ExitCode, Failure> {
    let mut stdout = std::io::stdout();
    match stdout.write_all(bytes).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::from(format!("cannot write the result: {error}")))
        }
        _ => Ok(ExitCode::SUCCESS),
    }
}

/// Reads a text of at most this many bytes.
pub fn limited_text(path: &Path, most_bytes: u64) -> Result<String, String> {
    let shown = path.display();
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(most_bytes + 1).read_to_end(&mut bytes))
        .map_err(|error| format!("cannot read {shown}: {error}"))?;
    if bytes.len() as u64 > most_bytes {
        let most = most_bytes / 1_000_000;
        return Err(format!("{shown} is too large; expected at most {most} MB"));
    }
    String::from_utf8(bytes).map_err(|_| format!("cannot read {shown}: it is not UTF-8 text"))
}

/// Whether colours make sense on a stream.
pub fn is_colorful(stream: &impl IsTerminal) -> bool {
    stream.is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}
