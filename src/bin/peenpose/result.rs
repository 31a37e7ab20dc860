//! A result: printed, written into a folder with all reports on it, and read back.

use std::io::IsTerminal;
use std::path::Path;
use std::process::ExitCode;

use peenpose::record::{LARGEST_FILE, Record};
use peenpose::report::{brief, files, names, program, sheet};

use crate::folder::Staged;
use crate::output::{self, Failure, both, limited_text};

/// Exit status of a full answer that fails a verdict.
const FAILS: u8 = 1;
/// The file of a result in its folder.
pub const RESULT: &str = "result.json";

/// How a result is printed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// As JSON.
    Json,
    /// As the whole sheet.
    Sheet,
    /// As the head of the sheet.
    Brief,
}

impl Form {
    /// What was asked for; a terminal is shown the head of the sheet, pipes and files get all of it.
    pub fn new(json: bool, full: bool) -> Self {
        match (json, full || !std::io::stdout().is_terminal()) {
            (true, _) => Self::Json,
            (false, true) => Self::Sheet,
            (false, false) => Self::Brief,
        }
    }
}

/// Prints a record as a sheet or as JSON, then writes it with all reports into a folder if there is
/// one: what is printed is not lost whatever becomes of the folder.
///
/// Of a stroke there are programs for every exposure.
pub fn report(
    record: &Record,
    form: Form,
    out: Option<&Path>,
    exposures: &[u32],
) -> Result<ExitCode, Failure> {
    let as_json = record
        .to_json()
        .map_err(|error| format!("cannot write the result as JSON: {error}"))?;
    let printed = match form {
        Form::Json => output::text(&as_json),
        Form::Sheet => output::text(sheet(record)),
        Form::Brief => output::highlighted(&brief(record)),
    };
    let written = out.map_or(Ok(()), |folder| write(record, &as_json, exposures, folder));
    both(printed, written)?;
    Ok(if record.passes() {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(FAILS)
    })
}

fn write(record: &Record, json: &str, exposures: &[u32], folder: &Path) -> Result<(), Failure> {
    let mut files = Staged::new(folder);
    files.add(RESULT, json.as_bytes());
    let made = add_reports(record, exposures, &mut files);
    let stale = if files.is_whole() && made.is_ok() {
        stale(&files, folder)
    } else {
        Vec::new()
    };
    both(made, files.put())?;
    remove(folder, &stale)
}

/// The files of an earlier result in a folder that a new one has no successor for. Only that result tells
/// which of them its run has written; what has such a name otherwise belongs to somebody else.
fn stale(files: &Staged, folder: &Path) -> Vec<String> {
    let mut left_over = files.left_over(names());
    let result = folder.join(RESULT);
    if left_over.is_empty() || !result.exists() {
        return Vec::new();
    }
    match read(&result).map(|earlier| peenpose::report::files(&earlier)) {
        Ok(Ok(theirs)) => {
            left_over.retain(|name| theirs.iter().any(|(written, _)| written == name));
            left_over
        }
        _ => {
            let shown: Vec<String> = left_over
                .iter()
                .map(|name| folder.join(name).display().to_string())
                .collect();
            output::warn(&format!(
                "{} may be of an earlier run: its result cannot be read any more",
                shown.join(", ")
            ));
            Vec::new()
        }
    }
}

/// Removes files of an earlier run.
pub fn remove(folder: &Path, names: &[String]) -> Result<(), Failure> {
    let removed = names.iter().map(|name| {
        let path = folder.join(name);
        let shown = path.display().to_string();
        std::fs::remove_file(path)
            .map_err(|error| format!("cannot remove {shown}, which is of an earlier run: {error}"))
    });
    let failed: Vec<String> = removed.filter_map(Result::err).collect();
    if failed.is_empty() {
        Ok(())
    } else {
        Err(Failure::all(&failed))
    }
}

/// Adds all reports on a record.
pub fn add_reports(record: &Record, exposures: &[u32], staged: &mut Staged) -> Result<(), Failure> {
    let cannot = |error: std::io::Error| format!("cannot make the reports: {error}");
    let mut files = files(record).map_err(cannot)?;
    if let Some(stroke) = &record.stroke {
        for &exposure in exposures.iter().filter(|&&exposure| exposure > 1) {
            files.extend(program::files(stroke, exposure).map_err(cannot)?);
        }
    } else if !exposures.is_empty() {
        let fault = "--exposure is for strokes, and the problem has none";
        return Err(fault.to_owned().into());
    }
    for (name, contents) in files {
        staged.add(&name, &contents);
    }
    Ok(())
}

/// Reads a result back.
pub fn read(path: &Path) -> Result<Record, Failure> {
    let text = limited_text(path, LARGEST_FILE)?;
    let record = Record::from_json(&text).map_err(|fault| format!("{} {fault}", path.display()))?;
    Ok(record)
}
