//! The program from outside, its documents and its packages.

#[path = "../common/mod.rs"]
mod common;

mod campaigns;
mod changes;
mod comfort;
mod command_line;
mod documents;
mod extremes;
mod limits;
mod nothing_is_lost;
mod same_bits;
mod supply_chain;
mod surfaces;
