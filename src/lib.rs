//! peenpose finds nozzle settings for precision shot peening deep inside keyways, bores and slots.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod impact;
pub mod problem;
pub mod units;
