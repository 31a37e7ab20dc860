//! The search of the library: held to the common shots, and as it is shipped.

use std::time::Instant;

use peenpose::control::{Control, Shortcuts};
use peenpose::jet::Samples;
use peenpose::objective::Tally;
use peenpose::scenario::Scenario;
use peenpose::solve::solve;
use rayon::ThreadPoolBuilder;

use crate::objective::{SHOTS, Step};

/// Decides on the common shots, and reports on as few others as can be.
pub fn on_common_shots(scenario: &Scenario, shots: &Samples) -> Step {
    let control = Control {
        most_shots: SHOTS,
        validation_shots: 1,
        shortcuts: Shortcuts {
            importance: false,
            ..Shortcuts::default()
        },
        ..Control::default()
    };
    run(scenario, shots, &control)
}

/// Raises the shots as far as it sees fit; its poses are not comparable with those of others.
pub fn whole(scenario: &Scenario, shots: &Samples) -> Step {
    run(scenario, shots, &Control::default())
}

fn run(scenario: &Scenario, shots: &Samples, control: &Control) -> Step {
    let one_thread = ThreadPoolBuilder::new().num_threads(1).build();
    let start = Instant::now();
    let solution = match one_thread {
        Ok(pool) => pool.install(|| solve(scenario, control)),
        Err(_) => solve(scenario, control),
    };
    let seconds = start.elapsed().as_secs_f64();
    let settings = solution.answers[0].settings;
    let tally = Tally::trace(scenario, &settings, settings.speed, &shots.shots);
    Step {
        evaluations: solution.poses,
        seconds,
        objective: tally.terms(&scenario.problem.goals, settings.speed).total(),
        settings,
    }
}
