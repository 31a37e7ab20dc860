//! Reports, made from a record or a chart alone.

mod chart;
pub mod figure;
mod finding;
mod layout;
mod map;
mod number;
mod series;
mod sheet;
pub mod table;

pub use chart::chart;
pub use map::{MapView, map};
pub use sheet::sheet;
