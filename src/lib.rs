//! peenpose finds nozzle settings for precision shot peening deep inside keyways, bores and slots.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod evaluate;
pub mod impact;
pub mod jet;
pub mod objective;
pub mod problem;
pub mod scene;
pub mod setup;
pub mod trace;
pub mod units;
