//! The search of the library: held to the common shots, and as it is shipped.

use std::time::Instant;

use peenpose::jet::Samples;
use peenpose::objective::Tally;
use peenpose::setup::Setup;
use peenpose::solve::{Control, Shortcuts, solve};
use rayon::ThreadPoolBuilder;

use crate::objective::{SHOTS, Step};

/// Decides on the common shots, and reports on as few others as can be.
pub fn on_common_shots(setup: &Setup, shots: &Samples) -> Step {
    let control = Control {
        most_shots: SHOTS,
        fresh_shots: 1,
        shortcuts: Shortcuts {
            focus: false,
            ..Shortcuts::default()
        },
        ..Control::default()
    };
    run(setup, shots, &control)
}

/// Raises the shots as far as it sees fit; its poses are not comparable with those of others.
pub fn whole(setup: &Setup, shots: &Samples) -> Step {
    run(setup, shots, &Control::default())
}

fn run(setup: &Setup, shots: &Samples, control: &Control) -> Step {
    let one_thread = ThreadPoolBuilder::new().num_threads(1).build();
    let start = Instant::now();
    let solution = match one_thread {
        Ok(pool) => pool.install(|| solve(setup, control)),
        Err(_) => solve(setup, control),
    };
    let seconds = start.elapsed().as_secs_f64();
    let choice = solution.answers[0].choice;
    let tally = Tally::trace(setup, &choice, choice.speed, &shots.deviates);
    Step {
        evaluations: solution.poses,
        seconds,
        objective: tally.terms(&setup.problem.goals, choice.speed).total(),
        choice,
    }
}
