//! Sweeps one setting and holds the others: what the jet does from 55 to 80 degrees, as CSV.
//!
//!     cargo run --release --example sweep -- problems/keyway.yaml > sweep.csv

use std::error::Error;
use std::path::Path;

use peenpose::control::Control;
use peenpose::evaluate::evaluate;
use peenpose::feasibility::infeasibility;
use peenpose::jet::{Replicates, purpose};
use peenpose::scenario::Scenario;
use peenpose::solve::solve;
use peenpose::verdict::Verdict;

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1);
    let file = file.as_deref().unwrap_or("problems/keyway.yaml");
    let (scenario, _source) = Scenario::load(Path::new(file))?;
    let best = solve(&scenario, &Control::default()).answers[0].settings;

    // The same fresh shots at every angle, so that differences are not noise.
    let shots = Replicates::new(&scenario.problem, purpose::ANSWERS, 16_384);
    println!("incidence_deg,fits,J,standard_error,mean_normal_impulse_N_s,passes");
    for incidence_deg in 55..=80 {
        let mut settings = best;
        settings.incidence = f64::from(incidence_deg).to_radians();
        let found = evaluate(&scenario, &settings, &shots);
        let fits = infeasibility(&scenario, &settings).is_none();
        println!(
            "{incidence_deg},{fits},{:.6},{:.6},{:.4e},{}",
            found.terms.total(),
            found.standard_error,
            found.target.normal_impulse.mean,
            fits && Verdict::all(&scenario, &found).iter().all(Verdict::passes),
        );
    }
    Ok(())
}
