//! What comes out of the nozzle: its pose, and the shots of the jet.

mod importance;
mod mixture;
mod pilot_run;
mod pose;
pub mod purpose;
mod qmc_point;
mod quantile;
mod replicates;
mod samples;
mod shot_sample;
mod validation;

pub use importance::ImportanceDensity;
pub(crate) use pilot_run::PilotRun;
pub(crate) use pose::Aim;
pub use pose::Pose;
pub use qmc_point::Stream;
pub(crate) use qmc_point::{normal_pair, sobol};
pub use replicates::{Replicate, Replicates};
pub use samples::Samples;
pub use shot_sample::{ShotSample, speed_variance};
pub use validation::{Draw, PendingReplicate, ValidationSample};
