//! The search: its answers, its stability, its maps and trade-offs.

#[path = "../common/mod.rs"]
mod common;
#[path = "../../examples/common/mod.rs"]
mod examples;

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
