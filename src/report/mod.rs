//! Reports, made from the record alone.

mod sheet;

pub use sheet::sheet;
