//! Strokes: what the machine does so that the nozzle peens a whole feature, and what that gives.

mod program;
mod run_out;
mod spot;

pub use program::{Program, Waypoint};
pub use run_out::RunOut;
pub use spot::Spot;
