//! Reports, made from a record or a chart alone, and the library as a table.

mod chart;
pub mod export;
mod faces;
pub mod figure;
mod files;
mod finding;
mod layout;
mod library;
mod library_json;
mod map;
mod motion;
mod number;
mod page;
pub mod program;
mod series;
pub(crate) mod sheet;
pub mod table;
mod typeset;

pub use chart::chart;
pub use faces::faces;
pub use files::{files, names};
pub use library::library;
pub use library_json::library_json;
pub use map::{MapView, map};
pub use page::{PageFault, page};
pub use sheet::{LINES, brief, sheet};
