//! `peenpose completions` and `peenpose man`: made from the same definitions as `--help`.

use std::process::ExitCode;

use clap::{Command, CommandFactory};
use clap_mangen::Man;
use peenpose::problem::fault::nearest_name;

use crate::args::{Arguments, CompletionsArgs, ManArgs};
use crate::folder::Staged;
use crate::output::{self, Failure};

/// Prints completions for a shell.
pub fn completions(args: &CompletionsArgs) -> Result<ExitCode, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut command(), "peenpose", &mut script);
    output::bytes(&script)
}

/// Prints a page of the manual, or writes all of them into a folder.
pub fn man(args: &ManArgs) -> Result<ExitCode, Failure> {
    let command = command();
    let whole = page(command.clone())?;
    let mut pages = vec![("peenpose".to_owned(), whole)];
    for of in command.get_subcommands().filter(|it| !it.is_hide_set()) {
        // Pages are found as `man peenpose-solve`.
        pages.push((format!("peenpose-{}", of.get_name()), page(of.clone())?));
    }
    if let Some(folder) = &args.out {
        let mut files = Staged::new(folder);
        for (name, page) in &pages {
            files.add(&format!("{name}.1"), page);
        }
        files.put()?;
        return Ok(ExitCode::SUCCESS);
    }
    let name = match &args.command {
        Some(of) => format!("peenpose-{of}"),
        None => "peenpose".into(),
    };
    let found = pages.iter().find(|(page, _)| *page == name);
    let (_, page) = found.ok_or_else(|| unknown(&args.command))?;
    output::bytes(page)
}

fn unknown(name: &Option<String>) -> String {
    let name = name.as_deref().unwrap_or_default();
    let command = command();
    let names: Vec<&str> = command.get_subcommands().map(Command::get_name).collect();
    let nearest = nearest_name(name, names.iter().copied()).map_or_else(String::new, |nearest| {
        format!("; did you mean `{nearest}`?")
    });
    let names = names.join(", ");
    format!("there is no command `{name}`; expected one of {names}{nearest}")
}

fn command() -> Command {
    let mut command = Arguments::command();
    // Fills in what options inherit.
    command.build();
    command
}

fn page(command: Command) -> Result<Vec<u8>, String> {
    let mut page = Vec::new();
    Man::new(command)
        .render(&mut page)
        .map_err(|error| format!("cannot write the manual: {error}"))?;
    Ok(page)
}
