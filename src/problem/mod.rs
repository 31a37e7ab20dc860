//! What the user asked: a problem file, checked and turned into SI.
//!
//! The text becomes a tree of nodes with their places (`yaml`), the tree a plain mirror of the
//! file (`reader`, `file`), and the mirror a checked [`Problem`] (`check`). Faults are collected on
//! the way, so that one run shows all of them.
//!
//! ```
//! use std::path::Path;
//! use peenpose::problem;
//!
//! let reading = problem::read_text("format: 1\nshot: { radius: 0.5 }", Path::new("keyway.yaml"))?;
//! assert!(reading.problem.is_none());
//! let radius = reading.faults.iter().find(|fault| fault.key == "shot.radius").unwrap();
//! assert_eq!(
//!     problem::one_line(&reading.source, radius),
//!     "keyway.yaml:2:17: shot.radius: `0.5` has no unit; expected a length such as `0.5 mm`; \
//!      did you mean `0.5 mm`?"
//! );
//! # Ok::<(), Box<peenpose::problem::fault::Fault>>(())
//! ```

pub mod change;
pub mod curve;
pub mod equipment;
pub mod fault;
pub mod fault_code;
pub mod goal;
pub mod media;
pub mod model;
pub mod part;
pub mod setting;
pub mod size;
pub mod stroke;
pub mod warning;

mod check;
pub(crate) use limit::Limit;
mod duplicate_keys;
#[cfg(test)]
pub(crate) mod example;
mod faults;
mod field;
mod file;
pub mod given;
mod key_index;
mod length_unit;
mod limit;
mod name;
mod reader;
mod reading;
mod render;
mod schema;
mod source;
mod warning_code;
pub(crate) mod yaml;

pub use length_unit::LengthUnit;
pub use reading::{Reading, read, read_changed, read_text};
pub use render::{one_line, render, render_warnings};
pub use schema::schema;
pub use source::Source;
pub(crate) use source::sha256;

use equipment::{
    Calibration, ContactChoice, CoverageWish, Jet, Nozzle, PathLimits, Shot, SurfaceRule,
};
use goal::Goals;
use model::Model;
use part::{Part, Target};
use setting::{SettingRanges, Tolerance};
use stroke::Stroke;

/// A checked problem in SI units. Nothing downstream checks it again.
#[derive(Clone, Debug)]
pub struct Problem {
    /// Title of the file, or its name where it has none.
    pub title: String,
    /// Named parts, in the order of the file.
    pub parts: Vec<Part>,
    /// What is to be peened.
    pub target: Target,
    /// The shot.
    pub shot: Shot,
    /// The jet.
    pub jet: Jet,
    /// Which pressure gives which speed, where that is known.
    pub calibration: Option<Calibration>,
    /// The body that carries the jet.
    pub nozzle: Nozzle,
    /// Every contact of the file, in its order.
    pub contacts: Vec<ContactChoice>,
    /// What may be searched.
    pub ranges: SettingRanges,
    /// What must be reached.
    pub goals: Goals,
    /// Where one surface differs.
    pub surfaces: Vec<SurfaceRule>,
    /// When a path ends.
    pub paths: PathLimits,
    /// Where the nozzle travels while it peens; absent for a spot.
    pub stroke: Option<Stroke>,
    /// What is to be said about coverage, if anything.
    pub coverage: Option<CoverageWish>,
    /// How exactly a shop can set it.
    pub tolerance: Tolerance,
    /// Which effects are modelled.
    pub model: Model,
    /// Accuracy asked for, relative to J.
    pub accuracy: f64,
    /// Seed of every sample.
    pub seed: u64,
}
