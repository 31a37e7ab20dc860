//! `peenpose chart`: speed against accuracy on the problem at hand.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use peenpose::chart::{BesidePoint, Chart, LARGEST_TABLE, Plan};
use peenpose::control::Control;
use peenpose::record::LARGEST_FILE;
use peenpose::report;
use peenpose::report::figure::Figure;
use peenpose::report::table::Table;
use peenpose::study::quoted;

use crate::args::ChartArgs;
use crate::folder::Staged;
use crate::output::{self, Failure, both, limited_text};
use crate::progress::Watcher;
use crate::result;
use crate::start;

/// The file of a chart in its folder.
const CHART: &str = "chart.json";

/// Measures a problem file and writes figures, tables and a text.
pub fn run(args: &ChartArgs) -> Result<ExitCode, Failure> {
    let beside = beside(&args.beside)?;
    let clock = start::clock();
    let study = start::open(&args.start, &args.file, &[], Some(&args.out))?;
    let watcher = Watcher::new(args.start.quiet);
    let plan = Plan {
        most_shots: args.most_shots as usize,
        seeds: args.seeds.into(),
        control: Control {
            clock,
            ..watcher.control()
        },
        ..Plan::default()
    };
    let chart = study.chart(command(args, study.problem().seed), beside, &plan);
    watcher.finish();
    let chart = chart.map_err(|refusal| refusal.to_string())?;
    let json = chart
        .to_json()
        .map_err(|error| format!("cannot write the chart as JSON: {error}"))?;
    let sheet = report::chart(&chart);
    // What is printed is not lost whatever becomes of the folder.
    let printed = output::text(&sheet);
    let mut files = Staged::new(&args.out);
    files.add(CHART, json.as_bytes());
    files.add("chart.txt", sheet.as_bytes());
    let drawn = add_drawn(&chart, &mut files);
    let stale = if files.is_whole() && drawn.is_ok() {
        stale(&files, &args.out)
    } else {
        Vec::new()
    };
    both(both(printed, drawn), files.put())
        .and_then(|code| result::remove(&args.out, &stale).map(|()| code))
}

/// The files of an earlier chart in the folder that this one has no successor for.
fn stale(files: &Staged, folder: &Path) -> Vec<String> {
    let named = |name: &str| ["csv", "svg", "png"].map(|ending| format!("{name}.{ending}"));
    let left_over = files.left_over(
        ["pose", "search", "effect"]
            .iter()
            .flat_map(|name| named(name)),
    );
    let earlier = || {
        let text = limited_text(&folder.join(CHART), LARGEST_FILE).ok()?;
        let chart = Chart::from_json(&text).ok()?;
        let tables = Table::of_chart(&chart).ok()?;
        let figures = Figure::of_chart(&chart).ok()?;
        let names = tables.iter().map(|table| table.name);
        let names = names.chain(figures.iter().map(|figure| figure.name));
        Some(names.flat_map(named).collect::<Vec<String>>())
    };
    if left_over.is_empty() {
        return left_over;
    }
    let theirs = earlier().unwrap_or_default();
    left_over
        .into_iter()
        .filter(|name| theirs.contains(name))
        .collect()
}

/// Adds tables and figures.
fn add_drawn(chart: &Chart, files: &mut Staged) -> Result<(), Failure> {
    let tables = Table::of_chart(chart).map_err(|error| format!("cannot make tables: {error}"))?;
    for Table { name, csv } in tables {
        files.add(&format!("{name}.csv"), csv.as_bytes());
    }
    for figure in Figure::of_chart(chart).map_err(|fault| fault.to_string())? {
        files.add_figure(figure.name, &figure);
    }
    Ok(())
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
fn command(args: &ChartArgs, seed: u64) -> String {
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
            " --most-shots {} --seeds {} --seed {seed}",
            args.most_shots, args.seeds
        )
}
