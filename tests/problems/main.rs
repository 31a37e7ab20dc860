//! Problem files: what is read, refused and warned of.

#[path = "../common/mod.rs"]
mod common;

mod bad_files;
mod fuzzed;
mod library;
mod problem_file;
mod schema;
mod shipped_problems;
mod warnings;
