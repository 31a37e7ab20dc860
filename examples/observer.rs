//! Watches a search: prints how far it is, and ends it when it is good enough.
//!
//!     cargo run --release --example observer -- problems/keyway.yaml 0.02

use std::error::Error;
use std::path::Path;
use std::sync::Arc;

use peenpose::control::{Cancel, Control, Progress};
use peenpose::study::{Extras, Study};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (file, enough) = match &arguments[..] {
        [] => ("problems/keyway.yaml", 0.0),
        [file] => (file.as_str(), 0.0),
        [file, enough, ..] => (file.as_str(), enough.parse()?),
    };
    let study = Study::open(Path::new(file))?;

    // The search calls this from any of its threads.
    let cancel = Cancel::default();
    let asked = cancel.clone();
    let observer = move |progress: Progress| {
        if let Progress::Search { poses, best } = progress {
            let best = best.unwrap_or(f64::INFINITY);
            println!("{poses:6} poses: J {best:.6}");
            if best <= enough {
                asked.end();
            }
        }
    };

    let control = Control {
        cancel,
        observer: Some(Arc::new(observer)),
        ..Control::default()
    };
    let record = study.solve(Extras::default(), &control);
    let record = record.ok_or("no contact to choose")?;
    println!("{:?} after {} rays", record.status, record.work.rays);
    Ok(())
}
