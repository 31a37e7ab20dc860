//! Where results and failures go.

use std::fs::File;
use std::io::{ErrorKind, IsTerminal, Read, Write};
use std::path::Path;
use std::process::ExitCode;

use peenpose::problem::{Source, render_warnings};
use peenpose::record::{LARGEST_FILE, Record};
use peenpose::report::figure::Figure;
use peenpose::report::{files, sheet};
use peenpose::setup::{Rejection, Setup};

/// Exit status of a full answer that fails a verdict.
const FAILS: u8 = 1;
/// The file of a result in its folder.
pub const RESULT: &str = "result.json";
/// Exit status of bad input or failure.
pub const BAD_INPUT: u8 = 2;

/// Why a command gave no result.
pub struct Failure(String);

impl From<String> for Failure {
    fn from(message: String) -> Self {
        Self(format!("error: {message}\n"))
    }
}

impl From<Box<Rejection>> for Failure {
    fn from(rejection: Box<Rejection>) -> Self {
        Self(rejection.render(is_colorful(&std::io::stderr())))
    }
}

impl Failure {
    /// Shows it on stderr.
    pub fn report(&self) -> ExitCode {
        // Nothing can be done when even stderr is closed.
        let _ = std::io::stderr().write_all(self.0.as_bytes());
        ExitCode::from(BAD_INPUT)
    }
}

/// Tells something on stderr that is neither result nor failure.
pub fn note(message: &str) {
    // Nothing can be done when even stderr is closed.
    let _ = writeln!(std::io::stderr(), "note: {message}");
}

/// Shows on stderr what parses but can hardly be meant; tells how many warnings there are.
pub fn warnings(setup: &Setup, source: &Source) -> usize {
    let found = peenpose::warnings::of(setup, source);
    let stderr = std::io::stderr();
    let text = render_warnings(source, &found, is_colorful(&stderr));
    // Nothing can be done when even stderr is closed.
    let _ = stderr.lock().write_all(text.as_bytes());
    found.len()
}

/// Shows a warning on stderr.
pub fn warn(message: &str) {
    let _ = writeln!(std::io::stderr(), "warning: {message}");
}

/// Prints a text to stdout.
pub fn text(text: String) -> Result<ExitCode, Failure> {
    bytes(text.as_bytes())
}

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

/// Prints a record as a sheet or as JSON, and writes it with all reports into a folder if there is
/// one.
pub fn record(record: &Record, json: bool, out: Option<&Path>) -> Result<ExitCode, Failure> {
    let as_json = record
        .to_json()
        .map_err(|error| format!("cannot write the result as JSON: {error}"))?;
    if let Some(folder) = out {
        write(folder, RESULT, as_json.as_bytes())?;
        reports(record, folder)?;
    }
    text(if json { as_json } else { sheet(record) })?;
    Ok(if record.passes() {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(FAILS)
    })
}

/// Writes all reports on a record into a folder; gives the names of their files.
pub fn reports(record: &Record, folder: &Path) -> Result<Vec<String>, Failure> {
    let files = files(record).map_err(|error| format!("cannot make the reports: {error}"))?;
    let written = files.into_iter().map(|(name, contents)| {
        write(folder, &name, &contents)?;
        Ok(name)
    });
    written.collect()
}

/// Reads a result back.
pub fn read_record(path: &Path) -> Result<Record, Failure> {
    let text = limited_text(path, LARGEST_FILE)?;
    let record = Record::from_json(&text)
        .map_err(|error| format!("{} is not a result: {error}", path.display()))?;
    Ok(record)
}

/// Reads a text of at most so many bytes.
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

/// Finds out before the work whether results can be written into a folder.
pub fn prepare(out: Option<&Path>) -> Result<(), Failure> {
    let Some(folder) = out else {
        return Ok(());
    };
    std::fs::create_dir_all(folder)
        .and_then(|()| temporary().tempfile_in(folder))
        .map(drop)
        .map_err(|error| Failure::from(format!("cannot write into {}: {error}", folder.display())))
}

/// A word of a command that a shell reads as one.
pub fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,+:".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

/// Writes a file in one go: whoever looks sees the old file or the new one.
pub fn write(folder: &Path, name: &str, contents: &[u8]) -> Result<(), Failure> {
    let path = folder.join(name);
    let written = || {
        std::fs::create_dir_all(folder)?;
        let mut file = temporary().tempfile_in(folder)?;
        file.write_all(contents)?;
        file.as_file().sync_all()?;
        file.persist(&path).map_err(|error| error.error)
    };
    written().map(drop).map_err(|error: std::io::Error| {
        Failure::from(format!("cannot write {}: {error}", path.display()))
    })
}

/// Writes a figure as SVG and PNG.
pub fn figure(folder: &Path, stem: &str, figure: &Figure) -> Result<(), Failure> {
    let png = figure.png().map_err(|fault| fault.to_string())?;
    write(folder, &format!("{stem}.svg"), figure.svg.as_bytes())?;
    write(folder, &format!("{stem}.png"), &png)
}

/// A temporary file that may be read by whom the umask lets; usually nobody else may.
fn temporary() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder
}

/// Whether colours make sense on a stream.
pub fn is_colorful(stream: &impl IsTerminal) -> bool {
    stream.is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}
