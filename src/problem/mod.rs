//! What the user asked: a problem file, checked and turned into SI.

pub mod equipment;
pub mod fault;
pub mod goal;
pub mod part;
pub mod setting;

use equipment::{ContactChoice, Jet, Nozzle, PathLimits, Shot, SurfaceRule};
use goal::Goals;
use part::{Part, Target};
use setting::{Settings, Tolerance};

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
    /// The body that carries the jet.
    pub nozzle: Nozzle,
    /// Every contact of the file, in its order.
    pub contacts: Vec<ContactChoice>,
    /// What may be searched.
    pub settings: Settings,
    /// What must be reached.
    pub goals: Goals,
    /// Where one surface differs.
    pub surfaces: Vec<SurfaceRule>,
    /// When a path ends.
    pub paths: PathLimits,
    /// How exactly a shop can set it.
    pub tolerance: Tolerance,
    /// Accuracy asked for, relative to J.
    pub accuracy: f64,
    /// Seed of every sample.
    pub seed: u64,
}
