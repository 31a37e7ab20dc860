//! `peenpose init`: a problem file to start from.

use std::io::{BufRead, IsTerminal};
use std::path::Path;
use std::process::ExitCode;

use clap::ValueEnum;
use peenpose::problem;

use crate::args::InitArgs;
use crate::folder::{Staged, folder_of};
use peenpose::study::quoted;

use crate::output::{Failure, aside as note, text};

/// What editors look for beside the file; its first line says so.
const SCHEMA: &str = "peenpose.schema.json";
/// What the part of the template for meshes looks like, to be replaced.
const MESH: (&str, &str) = ("sample-slot.obj", include_str!("sample-slot.obj"));

/// What the part is like.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Template {
    /// A groove in a bore, by its dimensions
    Keyway,
    /// Any part, as a mesh file from CAD
    Mesh,
    /// A flat plate
    Plate,
    /// A groove that is peened over its whole length
    Stroke,
}

impl Template {
    const fn text(self) -> &'static str {
        match self {
            Self::Keyway => include_str!("keyway.yaml"),
            Self::Mesh => include_str!("mesh.yaml"),
            Self::Plate => include_str!("plate.yaml"),
            Self::Stroke => include_str!("../../../../problems/keyway-stroke.yaml"),
        }
    }
}

/// Writes a problem file.
pub fn run(args: &InitArgs) -> Result<ExitCode, Failure> {
    let template = match args.kind {
        Some(kind) => kind,
        None if std::io::stdin().is_terminal() && std::io::stdout().is_terminal() => ask()?,
        None => Template::Keyway,
    };
    match &args.out {
        Some(path) => write_all(template, path, args.force),
        None => {
            if template == Template::Mesh {
                note(&format!(
                    "note: the file refers to a mesh, {}; `--out FILE` writes a sample of it as well\n",
                    MESH.0
                ));
            }
            text(template.text())
        }
    }
}

/// Writes the file and what belongs to it; nothing at all if something else is in the way.
fn write_all(template: Template, path: &Path, force: bool) -> Result<ExitCode, Failure> {
    let name = path
        .file_name()
        .and_then(|name| name.to_str())
        .ok_or_else(|| format!("{} cannot be the name of a file", path.display()))?;
    let folder = folder_of(path);
    let schema = format!("{:#}\n", problem::schema());
    let mut files = vec![(name, template.text()), (SCHEMA, schema.as_str())];
    if template == Template::Mesh {
        files.push(MESH);
    }
    if !force {
        for (name, contents) in &files {
            refuse_to_overwrite(&folder.join(name), contents)?;
        }
    }
    let mut staged = Staged::new(folder);
    for (name, contents) in &files {
        staged.add(name, contents.as_bytes());
    }
    staged.put()?;
    let shown = quoted(&path.display().to_string());
    let beside: Vec<&str> = files[1..].iter().map(|(name, _)| *name).collect();
    note(&format!(
        "wrote {shown}, and beside it {}\nnext: edit it, then\n  peenpose check {shown}\n  peenpose solve {shown}\n",
        beside.join(" and "),
    ));
    Ok(ExitCode::SUCCESS)
}

/// A file with the same contents is not in the way.
fn refuse_to_overwrite(path: &Path, contents: &str) -> Result<(), Failure> {
    match std::fs::read(path) {
        Ok(found) if found == contents.as_bytes() => Ok(()),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(()),
        _ => Err(Failure::from(format!(
            "{} is there already; `--force` writes over it",
            path.display()
        ))),
    }
}

fn ask() -> Result<Template, Failure> {
    note("What is the part like? keyway, mesh or plate [keyway]: ");
    let mut answer = String::new();
    std::io::stdin()
        .lock()
        .read_line(&mut answer)
        .map_err(|error| format!("cannot read the answer: {error}"))?;
    match answer.trim() {
        "" => Ok(Template::Keyway),
        answer => Template::from_str(answer, true)
            .map_err(|_| format!("`{answer}` is none of keyway, mesh and plate").into()),
    }
}
