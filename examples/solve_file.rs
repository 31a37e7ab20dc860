//! Solves a problem file and prints what a shop would set.
//!
//!     cargo run --release --example solve_file -- problems/keyway.yaml

use std::path::Path;
use std::process::ExitCode;

use peenpose::control::Control;
use peenpose::study::{Extras, Study};

fn main() -> ExitCode {
    let file = std::env::args().nth(1);
    let file = file.as_deref().unwrap_or("problems/keyway.yaml");

    // Opening checks everything and builds the scene. All faults come at once, with their places.
    let study = match Study::open(Path::new(file)) {
        Ok(study) => study,
        Err(rejection) => {
            eprintln!("{rejection}");
            return ExitCode::FAILURE;
        }
    };

    // The search: one answer for each contact, the best first.
    let Some(record) = study.solve(Extras::default(), &Control::default()) else {
        eprintln!("{file}: no contact to choose");
        return ExitCode::FAILURE;
    };
    println!("{}: {:?}", study.problem().title, record.status);
    for answer in &record.choices {
        let settings = &answer.settings;
        print!(
            "{:8} incidence {:5.1} deg, azimuth {:6.1} deg, standoff {:5.2} mm, speed {:5.2} m/s: ",
            answer.contact,
            settings.incidence_deg,
            settings.azimuth_deg,
            settings.standoff_m * 1e3,
            settings.speed_m_s,
        );
        // What these settings do, measured on shots that the search has not seen.
        match &answer.objective {
            Some(objective) => println!(
                "J {:.5} +- {:.5}, {}",
                objective.total,
                objective.standard_error,
                if answer.passes { "passes" } else { "fails" },
            ),
            None => println!("the nozzle does not fit"),
        }
    }
    ExitCode::SUCCESS
}
