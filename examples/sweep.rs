//! Sweeps one setting and holds the others: what the jet does from 55 to 80 degrees, as CSV.
//!
//!     cargo run --release --example sweep -- problems/keyway.yaml > sweep.csv

use std::error::Error;
use std::path::Path;

use peenpose::control::Control;
use peenpose::study::{Extras, Study};

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1);
    let file = file.as_deref().unwrap_or("problems/keyway.yaml");
    let study = Study::open(Path::new(file))?;
    let (extras, control) = (Extras::default(), Control::default());
    let best = study
        .solve(extras, &control)
        .ok_or("no contact to choose")?
        .best;
    let contacts = study.problem().contacts.iter();
    let contact = contacts
        .map(|it| &it.name)
        .position(|name| *name == best.contact);

    println!("incidence_deg,fits,J,standard_error,mean_normal_impulse_N_s,passes");
    for incidence_deg in 55..=80 {
        let mut settings = best.settings.settings();
        settings.contact = contact.unwrap_or_default();
        settings.static_friction = best.contact_values.mu_s;
        settings.incidence = f64::from(incidence_deg).to_radians();
        // The same validation shots at every angle, so that differences are not noise.
        let record = study.evaluate(&settings, 16_384, extras, &control);
        let found = record.ok_or("no contact to evaluate")?.best;
        if let (Some(objective), Some(target)) = (found.objective, found.target) {
            println!(
                "{incidence_deg},{},{:.6},{:.6},{:.4e},{}",
                found.feasible,
                objective.total,
                objective.standard_error,
                target.normal_impulse.mean,
                found.passes,
            );
        }
    }
    Ok(())
}
