//! `peenpose chart`: speed against accuracy on the problem at hand.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use peenpose::chart::{BesidePoint, Control, LARGEST_TABLE, measure};
use peenpose::report;
use peenpose::report::figure::Figure;
use peenpose::report::table::Table;
use peenpose::setup::Setup;

use crate::args::ChartArgs;
use crate::output::{self, Failure, limited_text, quoted};
use crate::progress::Watcher;
use crate::start;

/// Measures a problem file and writes figures, tables and a text.
pub fn run(args: &ChartArgs) -> Result<ExitCode, Failure> {
    let beside = beside(&args.beside)?;
    let (setup, source) = start::load(&args.start, &args.file, Some(&args.out))?;
    let setup = setup.as_asked();
    let watcher = Watcher::new(args.start.quiet);
    let control = Control {
        most_shots: args.most_shots as usize,
        seeds: args.seeds.into(),
        stop: &watcher.stop,
        watch: &|step| watcher.show_step(step),
        ..Control::default()
    };
    let command = command(args, &setup);
    let chart = measure(&setup, &source, command, beside, &control);
    watcher.finish();
    let chart = chart.map_err(|refusal| refusal.to_string())?;
    let json = chart
        .to_json()
        .map_err(|error| format!("cannot write the chart as JSON: {error}"))?;
    let sheet = report::chart(&chart);
    output::write(&args.out, "chart.json", json.as_bytes())?;
    output::write(&args.out, "chart.txt", sheet.as_bytes())?;
    let tables =
        Table::of_chart(&chart).map_err(|error| format!("cannot write tables: {error}"))?;
    for Table { name, csv } in tables {
        output::write(&args.out, &format!("{name}.csv"), csv.as_bytes())?;
    }
    for figure in Figure::of_chart(&chart).map_err(|fault| fault.to_string())? {
        output::figure(&args.out, figure.name, &figure)?;
    }
    output::text(sheet)
}

/// The points of all tables.
fn beside(paths: &[PathBuf]) -> Result<Vec<BesidePoint>, String> {
    let tables: Result<Vec<Vec<BesidePoint>>, String> =
        paths.iter().map(|path| beside_table(path)).collect();
    Ok(tables?.concat())
}

fn beside_table(path: &Path) -> Result<Vec<BesidePoint>, String> {
    let text = limited_text(path, LARGEST_TABLE)?;
    BesidePoint::read_all(&text).map_err(|fault| format!("{}:{fault}", path.display()))
}

/// The command that makes the chart again.
fn command(args: &ChartArgs, setup: &Setup) -> String {
    let file = |path: &Path| quoted(&path.display().to_string());
    let mut command = format!(
        "peenpose chart {} --out {}",
        file(&args.file),
        file(&args.out)
    );
    for path in &args.beside {
        command += &format!(" --beside {}", file(path));
    }
    command
        + &format!(
            " --most-shots {} --seeds {} --seed {}",
            args.most_shots, args.seeds, setup.problem.seed
        )
}
