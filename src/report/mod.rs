//! Reports, made from a record or a chart alone.

mod chart;
pub mod export;
pub mod figure;
mod files;
mod finding;
mod layout;
mod number;
mod page;
mod series;
mod sheet;
pub mod table;

pub use chart::chart;
pub use files::files;
pub use page::{PageFault, page};
pub use sheet::sheet;
