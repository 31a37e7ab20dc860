//! What comes out of the nozzle: its pose, and the shots of the jet.

mod point;
mod pose;
pub mod purpose;
mod sample;

pub use point::Stream;
pub(crate) use point::normal_pair;
pub(crate) use pose::Aim;
pub use pose::Pose;
pub use sample::{Deviate, Draw, Replicate, Replicates, Samples, speed_variance};
