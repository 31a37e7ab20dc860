//! The folder of a campaign: what is planned, and what has come of it so far.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::plan::{self, Case, Maker, Plan};
use super::table;
use crate::atomic;
use crate::control::Control;
use crate::record::{Record, mesh_sha256};
use crate::report::table::Table;
use crate::study::{Extras, Study};

/// The column of names in `cases.csv` and `table.csv`.
pub(super) const ID: &str = "id";
const PLAN: &str = "plan.json";
const CASES: &str = "cases.csv";
const RESULTS: &str = "results";
/// Format of the folder.
const FORMAT: u32 = 1;

/// A campaign that is planned.
#[derive(Clone, Debug)]
pub struct CampaignFolder {
    folder: PathBuf,
    plan: Plan,
}

/// What `plan.json` holds.
#[derive(Serialize, Deserialize)]
struct PlanRecord {
    campaign: u32,
    version: String,
    /// The problem file, from this folder on.
    base: PathBuf,
    keys: Vec<String>,
}

/// What has come of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CaseStatus {
    /// There is a result, whether it passes or not.
    Done,
    /// There is none yet.
    Missing,
    /// Its problem has faults.
    Faulty,
}

/// Every so many-th case: the one of `number`, from 1 on, of `of` shards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    number: usize,
    of: usize,
}

impl Shard {
    /// All cases.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    fn holds(self, index: usize) -> bool {
        index % self.of == self.number - 1
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let shard = text.split_once('/').and_then(|(number, of)| {
            let (number, of) = (number.parse().ok()?, of.parse().ok()?);
            (1..=of).contains(&number).then_some(Self { number, of })
        });
        shard.ok_or_else(|| format!("`{text}` is no shard such as `3/8`: the third of eight"))
    }
}

/// What a run of cases has come to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Outcome {
    /// Cases solved now.
    pub solved: usize,
    /// Cases that were found to have faults now.
    pub faulty: usize,
    /// Cases that were there before.
    pub kept: usize,
    /// Cases that were left out, as the run was asked to end.
    pub left: usize,
}

impl CampaignFolder {
    /// Writes a plan into a folder. What was solved there before stays: a case that is planned again need not be solved
    /// again.
    ///
    /// # Errors
    /// The folder cannot be written.
    pub fn create(folder: &Path, plan: Plan) -> Result<Self, String> {
        let cannot =
            |error: std::io::Error| format!("cannot write into {}: {error}", folder.display());
        fs::create_dir_all(folder.join(RESULTS)).map_err(cannot)?;
        let here = folder.canonicalize().map_err(cannot)?;
        let record = PlanRecord {
            campaign: FORMAT,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            base: relative(&plan.base, &here),
            keys: plan.keys.clone(),
        };
        let cases = table::cases(&plan).map_err(cannot)?;
        write(folder, CASES, cases.csv.as_bytes())?;
        let json = serde_json::to_string_pretty(&record).map_err(|error| cannot(error.into()))?;
        write(folder, PLAN, (json + "\n").as_bytes())?;
        Ok(Self {
            folder: folder.to_owned(),
            plan,
        })
    }

    /// Opens a planned folder.
    ///
    /// # Errors
    /// It has no plan, one of another version, or one that cannot be read.
    pub fn open(folder: &Path) -> Result<Self, String> {
        let path = folder.join(PLAN);
        let text = fs::read_to_string(&path).map_err(|error| {
            format!(
                "cannot read {}: {error}; `peenpose campaign plan` makes it",
                path.display()
            )
        })?;
        let record: PlanRecord = serde_json::from_str(&text)
            .map_err(|error| format!("{} is no plan: {error}", path.display()))?;
        let version = env!("CARGO_PKG_VERSION");
        if (record.campaign, record.version.as_str()) != (FORMAT, version) {
            return Err(format!(
                "{} is of version {}, and this is {version}: plan again",
                path.display(),
                record.version
            ));
        }
        let cases = folder.join(CASES);
        let cannot = |error: csv::Error| format!("cannot read {}: {error}", cases.display());
        let mut reader = csv::Reader::from_path(&cases).map_err(cannot)?;
        let heading = reader.headers().map_err(cannot)?;
        if heading.get(0) != Some(ID) || !heading.iter().skip(1).eq(record.keys.iter()) {
            return Err(format!(
                "{} has other columns than {PLAN} has keys: plan again",
                cases.display()
            ));
        }
        let case = |row: Result<csv::StringRecord, csv::Error>| {
            let row = row.map_err(cannot)?;
            let mut cells = row.iter().map(str::to_owned);
            Ok(Case {
                id: cells.next().unwrap_or_default(),
                values: cells.collect(),
            })
        };
        Ok(Self {
            plan: Plan {
                base: folder.join(record.base),
                keys: record.keys,
                cases: reader.records().map(case).collect::<Result<_, String>>()?,
                repeated: 0,
                faults_of_first: None,
            },
            folder: folder.to_owned(),
        })
    }

    /// What is planned.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    fn results(&self) -> PathBuf {
        self.folder.join(RESULTS)
    }

    /// What has come of a case.
    pub fn status(&self, case: &Case) -> CaseStatus {
        if self.results().join(result_of(case)).exists() {
            CaseStatus::Done
        } else if self.results().join(fault_of(case)).exists() {
            CaseStatus::Faulty
        } else {
            CaseStatus::Missing
        }
    }

    /// How many cases have come to this.
    pub fn count(&self, wanted: CaseStatus) -> usize {
        let cases = self.plan.cases.iter();
        cases.filter(|case| self.status(case) == wanted).count()
    }

    /// The result of a case; `None` where there is none.
    ///
    /// # Errors
    /// What is there is no result.
    pub fn record(&self, case: &Case) -> Result<Option<Record>, String> {
        let path = self.results().join(result_of(case));
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(format!("cannot read {}: {error}", path.display())),
        };
        Record::from_json(&text)
            .map(Some)
            .map_err(|fault| format!("{} {fault}", path.display()))
    }

    /// Solves the cases of a shard that are missing, as many at a time as there are threads; `after` is told of each. Those that
    /// are under way when the run is asked to end are left.
    ///
    /// # Errors
    /// The problem file has changed since it was planned, or results cannot be written.
    pub fn run(
        &self,
        shard: Shard,
        control: &Control,
        after: &(dyn Fn(&Case, CaseStatus) + Sync),
    ) -> Result<Outcome, String> {
        let maker = Maker::new(&self.plan.base, &self.plan.keys).map_err(|it| it.to_string())?;
        let of_shard: Vec<&Case> = self
            .plan
            .cases
            .iter()
            .enumerate()
            .filter(|(index, _)| shard.holds(*index))
            .map(|(_, case)| case)
            .collect();
        let missing: Vec<&Case> = of_shard
            .iter()
            .copied()
            .filter(|case| self.status(case) == CaseStatus::Missing)
            .collect();
        let solved = missing.par_iter().with_max_len(1).map(|case| {
            if control.is_stopped() {
                return Ok(CaseStatus::Missing);
            }
            let status = self.solve(&maker, case, control)?;
            after(case, status);
            Ok(status)
        });
        let solved: Vec<CaseStatus> = solved.collect::<Result<_, String>>()?;
        let count = |wanted: CaseStatus| solved.iter().filter(|status| **status == wanted).count();
        Ok(Outcome {
            solved: count(CaseStatus::Done),
            faulty: count(CaseStatus::Faulty),
            kept: of_shard.len() - missing.len(),
            left: count(CaseStatus::Missing),
        })
    }

    fn solve(&self, maker: &Maker, case: &Case, control: &Control) -> Result<CaseStatus, String> {
        let stale = || {
            format!(
                "{}: the problem file or a mesh is not what was planned: plan again",
                case.id
            )
        };
        let changes = maker.changes(&case.values)?;
        let (name, contents, status) = match Study::open_changed(&self.plan.base, &changes) {
            Ok(study) => {
                let meshes: BTreeMap<String, String> =
                    mesh_sha256(study.scenario(), study.source());
                if plan::id(&study.source().text, &meshes) != case.id {
                    return Err(stale());
                }
                let record = study.solve(Extras::default(), control);
                let record = record.filter(|_| !control.is_stopped());
                let Some(record) = record else {
                    return Ok(CaseStatus::Missing);
                };
                let json = record.to_json().map_err(|error| error.to_string())?;
                (result_of(case), json, CaseStatus::Done)
            }
            Err(rejection) => {
                if maker.id(&case.values)? != case.id {
                    return Err(stale());
                }
                (fault_of(case), rejection.render(false), CaseStatus::Faulty)
            }
        };
        write(&self.results(), &name, contents.as_bytes())?;
        Ok(status)
    }

    /// The table of all cases, in the order of the plan: the same whoever has solved them, and when.
    ///
    /// # Errors
    /// A result cannot be read.
    pub fn gather(&self) -> Result<Table, String> {
        let records = self.plan.cases.par_iter().map(|case| self.record(case));
        let records: Vec<Option<Record>> = records.collect::<Result<_, _>>()?;
        let statuses: Vec<CaseStatus> = self
            .plan
            .cases
            .iter()
            .map(|case| self.status(case))
            .collect();
        table::gathered(&self.plan, &records, &statuses).map_err(|error| error.to_string())
    }
}

/// The file of a case's result.
fn result_of(case: &Case) -> String {
    format!("{}.json", case.id)
}

/// The file of what is wrong with a case's problem.
fn fault_of(case: &Case) -> String {
    format!("{}.fault.txt", case.id)
}

/// A path from a folder on; both are absolute.
fn relative(path: &Path, folder: &Path) -> PathBuf {
    let shared = path
        .components()
        .zip(folder.components())
        .take_while(|(a, b)| a == b)
        .count();
    // Another disk has nothing in common.
    if shared == 0 {
        return path.to_owned();
    }
    let up = folder
        .components()
        .skip(shared)
        .map(|_| std::path::Component::ParentDir);
    up.chain(path.components().skip(shared)).collect()
}

fn write(folder: &Path, name: &str, contents: &[u8]) -> Result<(), String> {
    atomic::write(folder, name, contents)
        .map_err(|error| format!("cannot write {}: {error}", folder.join(name).display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_hold_every_case_once() {
        for text in ["0/3", "4/3", "1", "a/b", "1/0", "-1/3"] {
            assert!(text.parse::<Shard>().is_err(), "{text}");
        }
        for index in 0..20 {
            let shards = (1..=3).map(|number| format!("{number}/3").parse::<Shard>().unwrap());
            assert_eq!(shards.filter(|shard| shard.holds(index)).count(), 1);
        }
    }

    #[test]
    fn a_path_is_told_from_the_folder() {
        for (path, folder, wanted) in [
            ("/a/b/keyway.yaml", "/a/study", "../b/keyway.yaml"),
            ("/a/study/keyway.yaml", "/a/study", "keyway.yaml"),
            ("/a/keyway.yaml", "/a/b/c", "../../keyway.yaml"),
        ] {
            assert_eq!(
                relative(Path::new(path), Path::new(folder)),
                Path::new(wanted)
            );
        }
    }
}
