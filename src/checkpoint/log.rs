//! The file of a checkpoint: a line for each piece of work, only ever added to.
//!
//! Each line is a checksum of the rest of it, the key of the work, and what came out, as JSON: one
//! digit that was changed on a disk would otherwise be another answer.

use std::collections::HashMap;
use std::fmt;
use std::fs::{File, OpenOptions, TryLockError, create_dir_all};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use sha2::{Digest, Sha256};

use super::Key;

/// Name of the file in its folder.
const NAME: &str = "checkpoint.txt";
/// Its first line.
const HEADING: &str = "peenpose checkpoint 2\n";
/// What may be lost when a run is killed: work of so long.
const AT_LEAST_EVERY: Duration = Duration::from_secs(1);
const MOST_UNWRITTEN: usize = 1 << 16;
/// Bytes of the largest file that is kept and read, as it is read whole.
pub const LARGEST_FILE: u64 = 1_000_000_000;

/// Why work cannot be kept.
#[derive(Debug)]
pub enum Trouble {
    /// The file cannot be read or written.
    File(PathBuf, io::Error),
    /// Another run uses it.
    InUse(PathBuf),
    /// It has more than [`LARGEST_FILE`] bytes.
    TooLarge(PathBuf),
    /// It does not begin as such files do.
    Foreign(PathBuf),
    /// A line before its end is damaged.
    Damaged(PathBuf, usize),
}

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(path, error) => {
                write!(f, "cannot keep work in {}: {error}", path.display())
            }
            Self::InUse(path) => write!(f, "{} is in use by another run", path.display()),
            Self::TooLarge(path) => write!(
                f,
                "{} is too large for a checkpoint, of which at most {} MB are read",
                path.display(),
                LARGEST_FILE / 1_000_000
            ),
            Self::Foreign(path) => write!(f, "{} is not a checkpoint", path.display()),
            Self::Damaged(path, line) => write!(
                f,
                "{}:{line}: the checkpoint is damaged; remove it to begin anew",
                path.display()
            ),
        }
    }
}

impl std::error::Error for Trouble {}

/// The file of a checkpoint, at its end.
pub(super) struct Log {
    path: PathBuf,
    file: File,
    /// Bytes in it.
    length: u64,
    unwritten: String,
    written: Instant,
    added: usize,
    failure: Option<io::Error>,
}

impl Log {
    /// Opens the file in a folder, or makes both; gives what is in it. A line that was not finished
    /// is cut off.
    pub fn open(folder: &Path) -> Result<(Self, HashMap<Key, String>), Trouble> {
        let path = folder.join(NAME);
        let failed = |error| Trouble::File(path.clone(), error);
        create_dir_all(folder).map_err(failed)?;
        let mut options = OpenOptions::new();
        let options = options.read(true).write(true).create(true).truncate(false);
        let mut file = options.open(&path).map_err(failed)?;
        file.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => Trouble::InUse(path.clone()),
            TryLockError::Error(error) => failed(error),
        })?;
        let mut bytes = Vec::new();
        let mut readable = (&mut file).take(LARGEST_FILE + 1);
        readable.read_to_end(&mut bytes).map_err(failed)?;
        if bytes.len() as u64 > LARGEST_FILE {
            return Err(Trouble::TooLarge(path));
        }
        if HEADING.as_bytes().starts_with(&bytes) {
            bytes.clear();
        }
        let finished = bytes.iter().rposition(|&byte| byte == b'\n');
        let whole = &bytes[..finished.map_or(0, |last| last + 1)];
        let known = if bytes.is_empty() {
            HashMap::new()
        } else {
            read(whole, &path)?
        };
        let length = whole.len() as u64;
        file.set_len(length).map_err(failed)?;
        file.seek(SeekFrom::End(0)).map_err(failed)?;
        let unwritten = if bytes.is_empty() { HEADING } else { "" };
        let log = Self {
            path,
            file,
            length,
            unwritten: unwritten.to_owned(),
            written: Instant::now(),
            added: 0,
            failure: None,
        };
        Ok((log, known))
    }

    /// Adds a line; a failure to write it is kept for [`Log::finish`].
    pub fn add(&mut self, key: &Key, value: &str) {
        if self.failure.is_some() {
            return;
        }
        self.unwritten += &line(key, value);
        self.added += 1;
        if self.unwritten.len() > MOST_UNWRITTEN || self.written.elapsed() > AT_LEAST_EVERY {
            self.write();
        }
    }

    /// Lines added.
    pub fn added(&self) -> usize {
        self.added
    }

    /// Writes what is left; says what failed, now or earlier.
    pub fn finish(&mut self) -> Result<(), Trouble> {
        if self.failure.is_none() {
            self.write();
        }
        let failure = self.failure.take();
        failure.map_or(Ok(()), |error| Err(Trouble::File(self.path.clone(), error)))
    }

    fn write(&mut self) {
        self.length += self.unwritten.len() as u64;
        self.failure = if self.length > LARGEST_FILE {
            let most = format!("it would exceed {} MB", LARGEST_FILE / 1_000_000);
            Some(io::Error::new(io::ErrorKind::FileTooLarge, most))
        } else {
            let written = self.file.write_all(self.unwritten.as_bytes());
            written.and_then(|()| self.file.sync_data()).err()
        };
        self.unwritten.clear();
        self.written = Instant::now();
    }
}

/// The values of whole lines.
fn read(bytes: &[u8], path: &Path) -> Result<HashMap<Key, String>, Trouble> {
    let lines = bytes
        .strip_prefix(HEADING.as_bytes())
        .ok_or_else(|| Trouble::Foreign(path.to_owned()))?;
    let lines = lines.split(|&byte| byte == b'\n');
    let lines = (2..).zip(lines).filter(|(_, line)| !line.is_empty());
    lines
        .map(|(number, line)| entry(line).ok_or_else(|| Trouble::Damaged(path.to_owned(), number)))
        .collect()
}

fn line(key: &Key, value: &str) -> String {
    let work = format!("{:032x} {value}", u128::from_be_bytes(*key));
    format!("{} {work}\n", checksum(&work))
}

fn entry(line: &[u8]) -> Option<(Key, String)> {
    let (sum, work) = std::str::from_utf8(line).ok()?.split_once(' ')?;
    if sum != checksum(work) {
        return None;
    }
    let (key, value) = work.split_once(' ')?;
    let key = u128::from_str_radix(key, 16).ok()?.to_be_bytes();
    Some((key, value.to_owned()))
}

/// Sixteen digits, by which a changed line passes for a whole one once in 2^64 times.
fn checksum(work: &str) -> String {
    let mut first = [0; 8];
    first.copy_from_slice(&Sha256::digest(work)[..8]);
    format!("{:016x}", u64::from_be_bytes(first))
}
