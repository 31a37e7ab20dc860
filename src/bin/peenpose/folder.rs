//! Files that a run writes: all of them before the first takes its place.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use peenpose::atomic::temporary;
use peenpose::report::figure::Figure;
use tempfile::TempPath;

use crate::output::Failure;

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

/// Writes one file: whoever looks sees the old file or the new one.
pub fn write(folder: &Path, name: &str, contents: &[u8]) -> Result<(), Failure> {
    let mut files = Staged::new(folder);
    files.add(name, contents);
    files.put()
}

/// The folder of a file, which is here if its path names none.
pub fn folder_of(file: &Path) -> &Path {
    match file.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Files that are whole on the disk, but not yet under their names.
///
/// A disk that runs full must not leave a folder with a part of this run and a part of an earlier one.
pub struct Staged<'a> {
    folder: &'a Path,
    files: Vec<(String, TempPath)>,
    /// What cannot be written, by reason.
    failed: BTreeMap<String, Vec<String>>,
}

impl<'a> Staged<'a> {
    /// No file yet.
    pub fn new(folder: &'a Path) -> Self {
        Self {
            folder,
            files: Vec::new(),
            failed: BTreeMap::new(),
        }
    }

    /// Writes a file under another name.
    pub fn add(&mut self, name: &str, contents: &[u8]) {
        let written = || {
            std::fs::create_dir_all(self.folder)?;
            let mut file = temporary().tempfile_in(self.folder)?;
            file.write_all(contents)?;
            file.as_file().sync_all()?;
            if self.folder.join(name).is_dir() {
                return Err(io::ErrorKind::IsADirectory.into());
            }
            Ok(file.into_temp_path())
        };
        match written() {
            Ok(file) => self.files.push((name.to_owned(), file)),
            Err(error) => self.fail(name, &error),
        }
    }

    /// Writes a figure as SVG and PNG.
    pub fn add_figure(&mut self, stem: &str, figure: &Figure) {
        self.add(&format!("{stem}.svg"), figure.svg.as_bytes());
        let name = format!("{stem}.png");
        match figure.png() {
            Ok(png) => self.add(&name, &png),
            Err(fault) => self.fail(&name, &io::Error::other(fault)),
        }
    }

    /// Names of the files that are ready.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.files.iter().map(|(name, _)| name.as_str())
    }

    /// Which of some names, none of them among these files, are files in the folder.
    pub fn left_over(&self, names: impl Iterator<Item = String>) -> Vec<String> {
        let is_new = |name: &String| self.names().any(|staged| staged == name);
        names
            .filter(|name| !is_new(name) && self.folder.join(name).is_file())
            .collect()
    }

    /// Whether all files are ready.
    pub fn is_whole(&self) -> bool {
        self.failed.is_empty()
    }

    /// Puts the files in their places; a file that is there already is replaced in one go. If some
    /// could not be written and others would replace older ones, all older ones stay.
    ///
    /// # Errors
    /// Every file that is not there, with the reason.
    pub fn put(mut self) -> Result<(), Failure> {
        let place = |name: &str| self.folder.join(name);
        let replaces = |(name, _): &(String, TempPath)| place(name).exists();
        let keeps_older = !self.failed.is_empty() && self.files.iter().any(replaces);
        if !keeps_older {
            for (name, file) in std::mem::take(&mut self.files) {
                if let Err(error) = file.persist(place(&name)) {
                    self.fail(&name, &error.error);
                }
            }
        }
        if self.failed.is_empty() {
            return Ok(());
        }
        let folder = self.folder;
        let paths = |names: &Vec<String>| -> String {
            let paths: Vec<PathBuf> = names.iter().map(|name| folder.join(name)).collect();
            let shown: Vec<String> = paths.iter().map(|it| it.display().to_string()).collect();
            shown.join(", ")
        };
        let each = self.failed.iter();
        let mut reasons: Vec<String> = each
            .map(|(reason, names)| format!("cannot write {}: {reason}", paths(names)))
            .collect();
        if keeps_older {
            reasons.push(format!(
                "the files of an earlier run in {} stay as they are",
                folder.display()
            ));
        }
        Err(Failure::all(&reasons))
    }

    fn fail(&mut self, name: &str, error: &io::Error) {
        // What comes with the path of a temporary file would be another reason for each.
        let reason = match (error.raw_os_error(), error.kind()) {
            (None, kind) if kind != io::ErrorKind::Other => kind.to_string(),
            _ => error.to_string(),
        };
        self.failed.entry(reason).or_default().push(name.to_owned());
    }
}
