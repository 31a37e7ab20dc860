//! `peenpose export`: scene, paths and hits for other programs.

use std::ffi::OsStr;
use std::path::Path;
use std::process::ExitCode;

use peenpose::report::export::{Format, export};

use crate::args::ExportArgs;
use crate::folder::{self, folder_of};
use crate::output::{self, Failure};
use crate::result::{self, RESULT};
use crate::start;

/// Writes one file in the format that its name asks for.
pub fn run(args: &ExportArgs) -> Result<ExitCode, Failure> {
    start::use_threads(None)?;
    let format = format_of(&args.out)?;
    let result = if args.result.is_dir() {
        args.result.join(RESULT)
    } else {
        args.result.clone()
    };
    let shown = result.display();
    let folder = folder_of(&args.out);
    folder::prepare(Some(folder))?;
    let record = result::read(&result)?;
    let contents = export(&record, format).ok_or_else(|| {
        format!("{shown} holds no surfaces, paths and hits; `--out` of this version writes them")
    })?;
    let contents = contents.map_err(|error| format!("cannot export {shown}: {error}"))?;
    let name = args.out.file_name().unwrap_or_default().to_string_lossy();
    folder::write(folder, &name, &contents)?;
    output::text(format!("{}\n", args.out.display()))
}

fn format_of(file: &Path) -> Result<Format, String> {
    let ending = file.extension().and_then(OsStr::to_str).unwrap_or_default();
    Format::with_ending(ending).ok_or_else(|| {
        let endings = Format::ALL.map(|format| format!(".{}", format.ending()));
        format!(
            "--out {}: expected a name that ends with one of {}",
            file.display(),
            endings.join(", ")
        )
    })
}
