//! Rays of `model: auto`, and its time on one thread, over those of the whole model, on the shipped problems.
//!
//! ```sh
//! cargo run --release --example models -- 10
//! ```
//!
//! The argument is the number of seeds. Both models of a seed run one after the other on one thread, the
//! first of them in turn; ratios are those of sums over the seeds.

#[path = "common/mod.rs"]
mod common;

use std::env;
use std::error::Error;
use std::time::Instant;

use peenpose::control::Control;
use peenpose::problem::model::Model;
use peenpose::scenario::Scenario;
use peenpose::solve::{Solution, solve};

use common::suite::SHIPPED;
use common::variant::path;

fn main() -> Result<(), Box<dyn Error>> {
    let seeds: u64 = env::args().nth(1).map_or(Ok(10), |text| text.parse())?;
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    println!("problem       full s  auto/full time  auto/full rays  largest change of J");
    for file in ["plate"].into_iter().chain(SHIPPED) {
        let (mut scenario, _) = Scenario::load(&path(&format!("{file}.yaml")))?;
        let (mut seconds, mut rays, mut apart) = ([0.0; 2], [0; 2], 0.0_f64);
        for seed in 1..=seeds {
            scenario.problem.seed = seed;
            let mut objectives = [0.0; 2];
            for turn in 0..2 {
                let index = (turn + seed as usize) % 2;
                scenario.problem.model = [Model::Auto, Model::Full][index].clone();
                let started = Instant::now();
                let solution = one_thread.install(|| solve(&scenario, &Control::default()));
                seconds[index] += started.elapsed().as_secs_f64();
                rays[index] += solution.rays;
                objectives[index] = objective(&solution)?;
            }
            apart = apart.max((objectives[0] / objectives[1] - 1.0).abs());
        }
        println!(
            "{file:12}  {:6.3}  {:14.3}  {:14.3}  {apart:19.5}",
            seconds[1] / seeds as f64,
            seconds[0] / seconds[1],
            rays[0] as f64 / rays[1] as f64,
        );
    }
    Ok(())
}

fn objective(solution: &Solution) -> Result<f64, &'static str> {
    let best = solution.answers.first();
    let best = best.and_then(|best| best.evaluation.as_ref());
    Ok(best.ok_or("the nozzle fits nowhere")?.terms.total())
}
