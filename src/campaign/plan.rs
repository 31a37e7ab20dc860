//! The cases of a campaign, each with a name that follows from its content.

use std::collections::{BTreeMap, HashSet};
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::axis::{Axis, Values};
use super::file::{self, CampaignFile, Cases};
use crate::jet::sobol;
use crate::problem::change::{Change, Template};
use crate::problem::fault::Fault;
use crate::problem::fault_code::FaultCode;
use crate::problem::part::Shape;
use crate::problem::{Reading, Source, read_text, sha256};
use crate::record::mesh_name;
use crate::scenario::Rejection;

/// One problem of a campaign.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Case {
    /// The first 16 hexadecimal digits of a SHA-256 of its problem (which holds the seed), its meshes and the version of the
    /// program.
    pub id: String,
    /// The value of each key, as it stands in a problem file.
    pub values: Vec<String>,
}

/// What there is to solve.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Plan {
    /// The problem file that all cases are made from.
    pub base: PathBuf,
    /// Keys that are varied.
    pub keys: Vec<String>,
    /// The cases, each once.
    pub cases: Vec<Case>,
    /// Cases that were left out, as they are the same as earlier ones.
    pub repeated: usize,
    /// What is wrong with the first case, in words, if anything is.
    pub faults_of_first: Option<String>,
}

/// More cases than a folder should hold.
const MOST_CASES: usize = 1_000_000;
/// Digits of a case's name.
const DIGITS: usize = 16;

impl Plan {
    /// The cases of a campaign file.
    ///
    /// # Errors
    /// All faults of the file, those of the problem that it starts from, and keys that cannot be varied.
    pub fn read(path: &Path) -> Result<Self, Box<Rejection>> {
        let CampaignFile { base, cases } = file::read(path)?;
        let (keys, rows) = rows(cases).map_err(refusal)?;
        let base = base
            .canonicalize()
            .map_err(|error| refusal(format!("base: cannot read {}: {error}", base.display())))?;
        let maker = Maker::new(&base, &keys)?;
        let faults_of_first = maker.check_first(&rows)?;
        let ids: Result<Vec<String>, String> = rows.par_iter().map(|row| maker.id(row)).collect();
        let mut seen = HashSet::new();
        let asked = rows.len();
        let cases: Vec<Case> = ids
            .map_err(refusal)?
            .into_iter()
            .zip(rows)
            .filter(|(id, _)| seen.insert(id.clone()))
            .map(|(id, values)| Case { id, values })
            .collect();
        Ok(Self {
            base,
            keys,
            repeated: asked - cases.len(),
            cases,
            faults_of_first,
        })
    }
}

/// Why there is no plan.
fn refusal(message: String) -> Box<Rejection> {
    Rejection::unread(Fault::at_key(FaultCode::NotChangeable, "", message))
}

/// Keys, and the values of each case.
type Rows = (Vec<String>, Vec<Vec<String>>);

fn rows(cases: Cases) -> Result<Rows, String> {
    match cases {
        Cases::Grid(axes) => {
            let values: Vec<&[String]> = axes.iter().map(|axis| listed(&axis.values)).collect();
            let count = values
                .iter()
                .try_fold(1_usize, |count, it| count.checked_mul(it.len()));
            let count = limited(count)?;
            let row = |number: usize| {
                // The last key changes first.
                let mut left = number;
                let mut row: Vec<String> = values
                    .iter()
                    .rev()
                    .map(|values| {
                        let value = values[left % values.len()].clone();
                        left /= values.len();
                        value
                    })
                    .collect();
                row.reverse();
                row
            };
            let rows = (0..count).map(row).collect();
            Ok((names(axes), rows))
        }
        Cases::Sobol { axes, count, seed } => {
            let coordinates = |index| {
                axes.iter()
                    .zip(0..)
                    .map(move |(axis, number)| axis.values.at(sobol(index, number, seed)))
            };
            let rows = (0..count)
                .map(|index| coordinates(index).collect())
                .collect();
            Ok((names(axes), rows))
        }
        Cases::Table(path) => table(&path),
    }
}

fn names(axes: Vec<Axis>) -> Vec<String> {
    axes.into_iter().map(|axis| axis.key).collect()
}

fn listed(values: &Values) -> &[String] {
    match values {
        Values::Listed(values) => values,
        Values::Between(_) => &[],
    }
}

fn limited(count: Option<usize>) -> Result<usize, String> {
    count
        .filter(|&count| count <= MOST_CASES)
        .ok_or_else(|| format!("the campaign has too many cases; expected at most {MOST_CASES}"))
}

/// The rows of a table, with a column for each key. A column `id` says nothing: names follow from what is in the others.
fn table(path: &Path) -> Result<Rows, String> {
    let cannot = |error: csv::Error| format!("cases: cannot read {}: {error}", path.display());
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .from_path(path)
        .map_err(cannot)?;
    let heading: Vec<String> = reader
        .headers()
        .map_err(cannot)?
        .iter()
        .map(str::to_owned)
        .collect();
    let is_key = |column: &usize| heading[*column] != super::folder::ID;
    let columns: Vec<usize> = (0..heading.len()).filter(is_key).collect();
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(cannot)?;
        rows.push(
            columns
                .iter()
                .map(|&column| record[column].to_owned())
                .collect(),
        );
        limited(Some(rows.len()))?;
    }
    Ok((
        columns
            .into_iter()
            .map(|column| heading[column].clone())
            .collect(),
        rows,
    ))
}

/// Makes problems of cases.
pub(super) struct Maker<'a> {
    base: &'a Path,
    keys: &'a [String],
    template: Template,
    /// Names and checksums of the meshes; `None` where they change from case to case.
    meshes: Option<BTreeMap<String, String>>,
}

impl<'a> Maker<'a> {
    /// From a problem file without faults.
    pub fn new(base: &'a Path, keys: &'a [String]) -> Result<Self, Box<Rejection>> {
        let reading = crate::problem::read(base).map_err(|fault| Rejection::unread(*fault))?;
        if reading.problem.is_none() {
            return Err(Rejection::new(reading.source, reading.faults));
        }
        let template = Template::new(&reading.source.text).map_err(refusal)?;
        let is_same = !keys.iter().any(|key| key.starts_with("scene"));
        let meshes = is_same.then(|| sums(&reading));
        Ok(Self {
            base,
            keys,
            template,
            meshes,
        })
    }

    /// What a case changes.
    pub fn changes(&self, values: &[String]) -> Result<Vec<Change>, String> {
        let pairs = self.keys.iter().zip(values);
        pairs.map(|(key, value)| Change::new(key, value)).collect()
    }

    /// The name of a case.
    pub fn id(&self, values: &[String]) -> Result<String, String> {
        let changed = self.template.with(&self.changes(values)?)?;
        match &self.meshes {
            Some(meshes) => Ok(id(changed.text(), meshes)),
            None => {
                let reading =
                    read_text(changed.text(), self.base).map_err(|fault| fault.to_string())?;
                Ok(id(changed.text(), &sums(&reading)))
            }
        }
    }

    /// Refuses keys that no problem file has: all cases would fail of them, as the first one does. Tells other faults of that.
    fn check_first(&self, rows: &[Vec<String>]) -> Result<Option<String>, Box<Rejection>> {
        let Some(first) = rows.first() else {
            return Err(refusal("the campaign has no case".to_owned()));
        };
        let changed = self
            .changes(first)
            .and_then(|it| self.template.with(&it))
            .map_err(refusal)?;
        let reading =
            read_text(changed.text(), self.base).map_err(|fault| Rejection::unread(*fault))?;
        let is_of_keys =
            |fault: &Fault| matches!(fault.rule, FaultCode::UnknownKey | FaultCode::MisplacedKey);
        match reading.faults.iter().any(is_of_keys) {
            true => Err(Rejection::new(reading.source, reading.faults)),
            false if reading.faults.is_empty() => Ok(None),
            false => Ok(Some(
                Rejection::new(reading.source, reading.faults).render(false),
            )),
        }
    }
}

/// The name of a case with this problem and these meshes.
pub(super) fn id(text: &str, meshes: &BTreeMap<String, String>) -> String {
    let mut content = format!(
        "{}\n{}\n",
        env!("CARGO_PKG_VERSION"),
        sha256(text.as_bytes())
    );
    for (name, sha256) in meshes {
        content += &format!("{sha256} {name}\n");
    }
    let mut id = sha256(content.as_bytes());
    id.truncate(DIGITS);
    id
}

/// Names and checksums of the meshes of a problem; one that cannot be read has none, which is a fault of its case.
fn sums(reading: &Reading) -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    for part in reading.scene.iter().flatten() {
        if let Shape::Mesh { file, .. } = &part.shape {
            let Source { path, .. } = &reading.source;
            if let Ok(bytes) = std::fs::read(&file.path) {
                found.insert(mesh_name(path, &file.path), sha256(&bytes));
            }
        }
    }
    found
}
