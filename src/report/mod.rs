//! Reports, made from the record alone.

mod layout;
mod number;
mod sheet;

pub use sheet::sheet;
