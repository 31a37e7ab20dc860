//! What comes out of the nozzle: its pose, and the shots of the jet.

mod pose;
mod sample;

pub use pose::Pose;
pub(crate) use pose::Aim;
pub use sample::{Deviate, Samples, Stream};
