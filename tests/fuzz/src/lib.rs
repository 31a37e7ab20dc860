//! What each fuzz target does with its input.
//!
//! Plain functions, so that `cargo test --test problems fuzzed` replays with the stable compiler what the
//! fuzzer found.

pub mod beside;
mod bytes;
pub mod checkpoint;
mod checkpoint_edit;
pub mod impact;
pub mod mesh_file;
pub mod problem;
pub mod ray_caster;
pub mod record;
mod record_edit;
pub mod solve;
mod solve_problem;
mod triangles;
pub mod units;
