//! What comes out of the nozzle: its pose, and the shots of the jet.

mod deviate;
mod focus;
mod fresh;
mod mixture;
mod point;
mod pose;
pub mod purpose;
mod quantile;
mod replicates;
mod samples;
mod scouts;

pub use deviate::{Deviate, speed_variance};
pub use focus::Focus;
pub use fresh::{Draw, Fresh, Unfocused};
pub use point::Stream;
pub(crate) use point::normal_pair;
pub(crate) use pose::Aim;
pub use pose::Pose;
pub use replicates::{Replicate, Replicates};
pub use samples::Samples;
pub(crate) use scouts::Scouts;
