//! From a problem file to a checked problem, or to everything that is wrong with it.

use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::sync::Arc;

use serde::Deserialize;

use super::Problem;
use super::change::{Change, Template};
use super::check::{self, Checked};
use super::duplicate_keys;
use super::fault::{Fault, Span};
use super::fault_code::FaultCode;
use super::faults::Faults;
use super::file::ProblemFile;
use super::part::{Part, Shape, Target};
use super::reader::Reader;
use super::size::{self, LARGEST_FILE};
use super::source::Source;
use super::yaml::{self, Value};
use crate::content::{self, Foreign};

/// What came of a problem file.
#[derive(Clone, Debug)]
pub struct Reading {
    /// The file itself.
    pub source: Source,
    /// Everything that is wrong with it, in the order of the text.
    pub faults: Vec<Fault>,
    /// The parts, whenever `scene` itself is sound.
    pub scene: Option<Vec<Part>>,
    /// The target, whenever `target` itself is sound.
    pub target: Option<Target>,
    /// The surfaces that the file has rules for. Those of mesh files show only when these are read.
    pub surfaces: Vec<String>,
    /// The problem: there exactly when nothing is wrong.
    pub problem: Option<Problem>,
}

impl Reading {
    /// The same with what is in some mesh files, by their names in the problem file; others are read from the
    /// disk.
    #[must_use]
    pub fn with_meshes(mut self, meshes: &[(&str, Arc<[u8]>)]) -> Self {
        let folder = self.source.path.parent().unwrap_or(Path::new(""));
        let of_problem = self.problem.iter_mut().flat_map(|it| &mut it.parts);
        for part in self.scene.iter_mut().flatten().chain(of_problem) {
            if let Shape::Mesh { file, .. } = &mut part.shape {
                let given = meshes
                    .iter()
                    .find(|(name, _)| folder.join(name) == file.path);
                file.contents = given.map(|(_, contents)| Arc::clone(contents));
            }
        }
        self
    }
}

/// Reads a problem file.
///
/// # Errors
/// A [`Fault`] when the file cannot be read at all; what is wrong inside it is in
/// [`Reading::faults`].
pub fn read(path: &Path) -> Result<Reading, Box<Fault>> {
    read_bytes(&bytes_of(path)?, path)
}

/// Reads a problem file of which some values are changed.
///
/// # Errors
/// See [`read`]; also where a value cannot be changed.
pub fn read_changed(path: &Path, changes: &[Change]) -> Result<Reading, Box<Fault>> {
    let bytes = bytes_of(path)?;
    let content = content::text(&bytes).ok();
    let text = content.as_deref().map(std::str::from_utf8);
    let template = match text {
        Some(Ok(text)) if !changes.is_empty() && bytes.len() as u64 <= LARGEST_FILE => {
            Template::new(text).ok()
        }
        _ => None,
    };
    // What is wrong with the file itself comes first.
    let Some(template) = template else {
        return read_bytes(&bytes, path);
    };
    let changed = template
        .with(changes)
        .map_err(|fault| Box::new(Fault::at_key(FaultCode::NotChangeable, "", fault)))?;
    let mut reading = read_text(changed.text(), path)?;
    reading.source.changes = changes.to_vec();
    Ok(reading)
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, Box<Fault>> {
    let unreadable = |error: std::io::Error| {
        let reason = match error.kind() {
            std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
            std::io::ErrorKind::IsADirectory => "it is a folder, not a file".to_owned(),
            _ => error.to_string(),
        };
        let message = format!("cannot read {}: {reason}", path.display());
        Box::new(Fault::at_key(FaultCode::FileUnreadable, "", message))
    };
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(LARGEST_FILE + 1).read_to_end(&mut bytes))
        .map_err(unreadable)?;
    Ok(bytes)
}

/// Reads a problem from a text, as if it stood in the file `path`.
///
/// # Errors
/// A [`Fault`] when the text is too long for a problem file.
pub fn read_text(text: &str, path: &Path) -> Result<Reading, Box<Fault>> {
    read_bytes(text.as_bytes(), path)
}

fn read_bytes(bytes: &[u8], path: &Path) -> Result<Reading, Box<Fault>> {
    if bytes.len() as u64 > LARGEST_FILE {
        let message = format!("{} is too large for a problem file", path.display());
        return Err(Box::new(
            Fault::at_key(FaultCode::FileTooLarge, "", message)
                .expecting("at most 1 MB; meshes belong into files of their own"),
        ));
    }
    let content = match content::text(bytes) {
        Ok(content) => content,
        Err(foreign) => {
            let text = String::from_utf8_lossy(bytes).into_owned();
            return Ok(Source::new(path, bytes, text).refused(not_a_problem(foreign)));
        }
    };
    let text = String::from_utf8_lossy(&content).into_owned();
    let mut source = Source::new(path, bytes, text);
    Ok(match std::str::from_utf8(&content) {
        Err(error) => source.refused(not_utf8(&content, error.valid_up_to())),
        Ok(text) => match yaml::parse(text) {
            Err(fault) => source.refused(*fault),
            Ok(root) if root.value == Value::Null => source.refused(empty()),
            Ok(mut root) => match size::fault_of(&root) {
                Some(fault) => source.refused(fault),
                None => {
                    let repeated = duplicate_keys::take_out(&mut root);
                    source.index(&root);
                    understand(source, &root, repeated)
                }
            },
        },
    })
}

/// Reads and checks a parsed file, of which some faults are known.
fn understand(source: Source, root: &yaml::Node, known: Vec<Fault>) -> Reading {
    let faults = Faults::new(&source);
    known.into_iter().for_each(|fault| faults.push(fault));
    // The reader has recorded why there is no file, if there is none.
    let checked = match ProblemFile::deserialize(Reader::new(root, &faults)) {
        Ok(file) => check::check(&file, &source.path, &faults),
        Err(_) => Checked {
            scene: None,
            target: None,
            surfaces: Vec::new(),
            problem: None,
        },
    };
    let faults = faults.into_sorted();
    let problem = checked.problem.filter(|_| faults.is_empty());
    Reading {
        faults,
        scene: checked.scene,
        target: checked.target,
        surfaces: checked.surfaces,
        problem,
        source,
    }
}

impl Source {
    /// A reading of which nothing could be made.
    fn refused(self, fault: Fault) -> Reading {
        Reading {
            source: self,
            faults: vec![fault],
            scene: None,
            target: None,
            surfaces: Vec::new(),
            problem: None,
        }
    }
}

fn empty() -> Fault {
    let fault = Fault::at_key(FaultCode::FileEmpty, "", "the file is empty");
    at_the_beginning(fault.expecting("a problem that starts with `format: 1`"))
}

/// A fault of a file of another kind.
fn not_a_problem(foreign: Foreign) -> Fault {
    let fault = Fault::at_key(FaultCode::NotUtf8, "", foreign.to_string());
    at_the_beginning(fault.expecting("a text file saved with the encoding UTF-8"))
}

fn at_the_beginning(mut fault: Fault) -> Fault {
    fault.at = Some(Span {
        line: 1,
        column: 1,
        start: 0,
        end: 0,
    });
    fault
}

/// A fault of the first byte that is not UTF-8, placed in the text that replaces it.
fn not_utf8(content: &[u8], valid: usize) -> Fault {
    let before = String::from_utf8_lossy(&content[..valid]);
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    let mut fault = Fault::at_key(FaultCode::NotUtf8, "", "the file is not UTF-8 text")
        .expecting("a text file saved with the encoding UTF-8");
    fault.at = Some(Span {
        line: before.matches('\n').count() + 1,
        column: before[line_start..].chars().count() + 1,
        start: valid,
        end: valid + char::REPLACEMENT_CHARACTER.len_utf8(),
    });
    fault
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_byte_that_is_not_text_is_shown_in_its_place() {
        let content = "a: 1\nbö: ".as_bytes();
        let fault = not_utf8(&[content, b"\xff\n"].concat(), content.len());
        // The byte becomes a replacement character of three bytes.
        let expected = Span {
            line: 2,
            column: 5,
            start: 10,
            end: 13,
        };
        assert_eq!(fault.at, Some(expected));
    }
}
