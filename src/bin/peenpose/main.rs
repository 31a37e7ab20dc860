//! The command line: each command is one short function over the public library.

// What is printed has the same bits on every machine.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod args;
mod campaign;
mod chart;
mod check;
mod checkpoint;
mod evaluate;
mod export;
mod folder;
mod impact;
mod init;
mod map;
mod media;
mod output;
mod progress;
mod report;
mod result;
mod schema;
mod settings;
mod shell;
mod solve;
mod start;
mod surfaces;

use std::process::ExitCode;

use clap::Parser;

use args::{Arguments, Command};
use output::Failure;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let outcome = match &arguments.command {
        Command::Campaign(args) => campaign::run(&args.command),
        Command::Solve(args) => solve::run(args),
        Command::Evaluate(args) => evaluate::run(args),
        Command::Map(args) => map::run(args),
        Command::Report(args) => report::run(args),
        Command::Export(args) => export::run(args),
        Command::Chart(args) => chart::run(args),
        Command::Check(args) => check::run(args),
        Command::Completions(args) => shell::completions(args),
        Command::Man(args) => shell::man(args),
        Command::Impact(args) => impact::run(args)
            .map_err(Failure::from)
            .and_then(output::text),
        Command::Init(args) => init::run(args),
        Command::Media(args) => media::run(args),
        Command::Surfaces(args) => surfaces::run(args),
        Command::Schema => schema::run(),
    };
    match outcome {
        Ok(code) => code,
        Err(failure) => failure.report(),
    }
}
