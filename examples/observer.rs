//! Watches a search: prints how far it is, and ends it when it is good enough.
//!
//!     cargo run --release --example observer -- problems/keyway.yaml 0.02

use std::error::Error;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use peenpose::scenario::Scenario;
use peenpose::solve::{Control, Progress, solve};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (file, enough) = match &arguments[..] {
        [] => ("problems/keyway.yaml", 0.0),
        [file] => (file.as_str(), 0.0),
        [file, enough, ..] => (file.as_str(), enough.parse()?),
    };
    let (scenario, _source) = Scenario::load(Path::new(file))?;

    // The search calls this from any of its threads.
    let stop = AtomicBool::new(false);
    let watch = |progress: Progress| {
        let best = progress.best.unwrap_or(f64::INFINITY);
        println!("{:6} poses: J {best:.6}", progress.poses);
        if best <= enough {
            stop.store(true, Ordering::Relaxed);
        }
    };

    let control = Control {
        stop: &stop,
        watch: &watch,
        ..Control::default()
    };
    let solution = solve(&scenario, &control);
    println!("{:?} after {} rays", solution.status, solution.rays);
    Ok(())
}
