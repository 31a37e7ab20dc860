//! Reports, made from a record or a chart alone.

mod chart;
pub mod export;
pub mod figure;
mod files;
mod finding;
mod layout;
mod map;
mod number;
mod series;
mod sheet;
pub mod table;

pub use chart::chart;
pub use files::files;
pub use map::{MapView, map};
pub use sheet::sheet;
