//! What it costs to leave the model to the program: times to solve the shipped problems with
//! `model: auto`, with the whole model, and with only the effects that turned out to matter.
//!
//! ```sh
//! cargo run --release --example models
//! ```

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use peenpose::problem::model::Model;
use peenpose::scenario::Scenario;
use peenpose::solve::{Control, Solution, solve};

const FILES: [&str; 6] = [
    "plate",
    "keyway",
    "keyway-long",
    "keyway-blind",
    "firtree",
    "gear-root",
];
/// Turns, each with all models one after the other; the median counts.
const TURNS: usize = 5;

fn main() -> Result<(), Box<dyn Error>> {
    println!("problem       auto s  auto/whole  auto/by hand  J auto/J whole  searched without");
    for file in FILES {
        let path = format!("{}/problems/{file}.yaml", env!("CARGO_MANIFEST_DIR"));
        let (scenario, _) = Scenario::load(Path::new(&path))?;
        let (_, auto) = timed(&scenario, Model::Auto);
        let left_out = auto.ladder.left_out();
        let by_hand = scenario.without(&left_out, &auto.answers[0].settings);
        let models = [
            (&scenario, Model::Auto),
            (&scenario, Model::Full),
            (&by_hand, Model::Full),
        ];
        let mut seconds = [const { Vec::new() }; 3];
        for _ in 0..TURNS {
            for ((scenario, model), seconds) in models.iter().zip(&mut seconds) {
                seconds.push(timed(scenario, model.clone()).0);
            }
        }
        let [auto_s, full_s, by_hand_s] = seconds.map(median);
        let (_, full) = timed(&scenario, Model::Full);
        println!(
            "{file:12}  {auto_s:6.3}  {:10.2}  {:12.2}  {:14.4}  {}",
            auto_s / full_s,
            auto_s / by_hand_s,
            objective(&auto)? / objective(&full)?,
            left_out
                .iter()
                .map(|e| e.name())
                .collect::<Vec<_>>()
                .join(", "),
        );
    }
    Ok(())
}

fn timed(scenario: &Scenario, model: Model) -> (f64, Solution) {
    let mut scenario = scenario.clone();
    scenario.problem.model = model;
    let started = Instant::now();
    let solution = solve(&scenario, &Control::default());
    (started.elapsed().as_secs_f64(), solution)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn objective(solution: &Solution) -> Result<f64, &'static str> {
    let best = solution
        .answers
        .first()
        .and_then(|best| best.evaluation.as_ref());
    Ok(best.ok_or("the nozzle fits nowhere")?.terms.total())
}
