//! Solves a problem file and prints what a shop would set.
//!
//!     cargo run --release --example solve_file -- problems/keyway.yaml

use std::path::Path;
use std::process::ExitCode;

use peenpose::control::Control;
use peenpose::scenario::Scenario;
use peenpose::solve::solve;

fn main() -> ExitCode {
    let file = std::env::args().nth(1);
    let file = file.as_deref().unwrap_or("problems/keyway.yaml");

    // Reading checks everything and builds the scene. All faults come at once, with their places.
    let (scenario, _source) = match Scenario::load(Path::new(file)) {
        Ok(loaded) => loaded,
        Err(rejection) => {
            eprintln!("{rejection}");
            return ExitCode::FAILURE;
        }
    };

    // The search: one answer for each contact, the best first.
    let solution = solve(&scenario, &Control::default());
    println!("{}: {:?}", scenario.problem.title, solution.status);
    for answer in &solution.answers {
        let settings = &answer.settings;
        print!(
            "{:8} incidence {:5.1} deg, azimuth {:6.1} deg, standoff {:5.2} mm, speed {:5.2} m/s: ",
            scenario.problem.contacts[settings.contact].name,
            settings.incidence.to_degrees(),
            settings.azimuth.to_degrees(),
            settings.standoff * 1e3,
            settings.speed,
        );
        // What these settings do, measured on shots that the search has not seen.
        match &answer.evaluation {
            Some(evaluation) => println!(
                "J {:.5} +- {:.5}, {}",
                evaluation.terms.total(),
                evaluation.standard_error,
                if answer.passes() { "passes" } else { "fails" },
            ),
            None => println!("the nozzle does not fit"),
        }
    }
    ExitCode::SUCCESS
}
