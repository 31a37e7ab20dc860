//! The best settings known of every problem of the suite.

use std::error::Error;
use std::path::{Path, PathBuf};

use peenpose::problem::setting::{Setting, Settings};
use peenpose::scenario::Scenario;

use super::root;

/// Shipped problems that are part of the suite.
pub const SHIPPED: [&str; 6] = [
    "keyway",
    "keyway-long",
    "keyway-blind",
    "firtree",
    "gear-root",
    "deflector",
];
const FILE: &str = "tests/data/suite.csv";

/// The best settings known of a problem: of all contacts, those that pass before others.
#[derive(Clone, Debug)]
pub struct KnownBest {
    pub problem: String,
    pub settings: Settings,
    /// J on many shots.
    pub objective: f64,
    pub passes: bool,
    /// The largest share of violating shots over what is allowed, as the search reported it.
    pub violation: f64,
    /// What found them.
    pub origin: String,
}

/// Names and files of all problems.
pub fn problems() -> Vec<(String, PathBuf)> {
    let shipped = SHIPPED.map(|name| root().join("problems").join(name).with_extension("yaml"));
    let folder = root().join("tests/suite");
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut own: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    own.retain(|path| path.extension().is_some_and(|ending| ending == "yaml"));
    own.sort();
    let name = |path: &Path| {
        path.file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into()
    };
    let all = shipped.into_iter().chain(own);
    all.map(|path| (name(&path), path)).collect()
}

pub fn scenario(path: &Path) -> Result<Scenario, Box<dyn Error>> {
    Ok(Scenario::load(path)?.0.as_asked())
}

impl KnownBest {
    pub fn all() -> Result<Vec<Self>, Box<dyn Error>> {
        let text = std::fs::read_to_string(root().join(FILE)).unwrap_or_default();
        text.lines().skip(1).map(Self::parse).collect()
    }

    fn parse(line: &str) -> Result<Self, Box<dyn Error>> {
        let fields: Vec<&str> = line.split(',').collect();
        let [
            problem,
            contact,
            numbers @ ..,
            objective,
            passes,
            violation,
            origin,
        ] = &fields[..]
        else {
            return Err(format!("too few columns: {line}").into());
        };
        let mut settings = Settings {
            contact: contact.parse()?,
            ..Settings::ZERO
        };
        for (setting, text) in Setting::ALL.into_iter().zip(numbers) {
            settings = setting.with(&settings, text.parse()?);
        }
        Ok(Self {
            problem: (*problem).into(),
            settings,
            objective: objective.parse()?,
            passes: passes.parse()?,
            violation: violation.parse()?,
            origin: (*origin).into(),
        })
    }

    /// Writes the table, SI units and radians.
    pub fn write(all: &[Self]) -> Result<(), Box<dyn Error>> {
        let names = Setting::ALL.map(Setting::name).join(",");
        let mut text = format!("problem,contact,{names},J,passes,violation,origin\n");
        for best in all {
            let numbers = Setting::ALL.map(|setting| format!("{:e}", setting.of(&best.settings)));
            text += &format!(
                "{},{},{},{:.6e},{},{:.4},{}\n",
                best.problem,
                best.settings.contact,
                numbers.join(","),
                best.objective,
                best.passes,
                best.violation,
                best.origin,
            );
        }
        Ok(std::fs::write(root().join(FILE), text)?)
    }
}
