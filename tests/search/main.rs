//! The search: its answers, its stability, its maps and trade-offs.

#[path = "../common/mod.rs"]
mod common;
#[path = "../../examples/common/mod.rs"]
mod examples;
#[path = "../../examples/common/suite.rs"]
#[allow(dead_code, reason = "the table is written by the example alone")]
mod suite_known;

mod best_known;
mod deflector;
mod determinism;
mod effects;
mod engines;
mod map;
mod pareto;
mod shortcuts;
mod stability;
mod starting;
mod strokes;
mod suite;
