//! What a search spends, and what makes it faster: neither changes the answer by more than it is accurate.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use peenpose::checkpoint::Checkpoint;
use peenpose::control::{Control, Shortcuts};
use peenpose::problem::setting::Range;
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::solve::{Solution, Status, solve};
use serde_json::Value;
use tempfile::TempDir;

use crate::common::shipped;

fn searched(scenario: &Scenario, shortcuts: Shortcuts) -> Solution {
    let control = Control {
        shortcuts,
        ..Control::default()
    };
    solve(scenario, &control)
}

/// J of each contact in the order of the file, with its standard error.
fn objectives(solution: &Solution) -> Vec<(f64, f64)> {
    let mut answers: Vec<_> = solution.answers.iter().collect();
    answers.sort_by_key(|answer| answer.settings.contact);
    let evaluations = answers.into_iter().filter_map(|it| it.evaluation.as_ref());
    evaluations
        .map(|it| (it.terms.total(), it.standard_error))
        .collect()
}

#[test]
fn poses_that_clearly_lose_end_early_which_saves_rays_and_keeps_the_answers() {
    let to_the_end = Shortcuts {
        early_ends: false,
        ..Shortcuts::default()
    };
    for file in ["keyway.yaml", "keyway-long.yaml"] {
        let scenario = shipped::scenario(file).as_asked();
        let (early, late) = (
            searched(&scenario, Shortcuts::default()),
            searched(&scenario, to_the_end),
        );
        let (left, right) = (objectives(&early), objectives(&late));
        assert_eq!(left.len(), right.len(), "{file}");
        // The best contact is searched to the accuracy, others as far as it takes to rank them.
        let best = |all: &[(f64, f64)]| all.iter().map(|it| it.0).fold(f64::INFINITY, f64::min);
        let (a, b) = (best(&left), best(&right));
        let error = left.iter().chain(&right).map(|it| it.1).fold(0.0, f64::max);
        let tolerated = scenario.problem.accuracy * a + 2.0 * error;
        assert!((a - b).abs() <= tolerated, "{file}: {left:?} {right:?}");
        assert!(
            early.rays < late.rays,
            "{file}: {} {}",
            early.rays,
            late.rays
        );
    }
}

#[test]
fn a_search_that_with_an_importance_density_needs_fewer_shots() {
    let without = Shortcuts {
        importance: false,
        ..Shortcuts::default()
    };
    let (mut rays, mut shots) = ([0; 2], [0; 2]);
    for seed in 1..=8 {
        let mut scenario = shipped::scenario("keyway.yaml").as_asked();
        scenario.problem.seed = seed;
        for (index, shortcuts) in [Shortcuts::default(), without].into_iter().enumerate() {
            let solution = searched(&scenario, shortcuts);
            assert_eq!(solution.status, Status::Converged, "{seed}");
            rays[index] += solution.rays;
            shots[index] = shots[index].max(solution.shots_per_pose);
        }
    }
    assert!(
        rays[0] < rays[1] && shots[0] < shots[1],
        "{rays:?} {shots:?}"
    );
}

/// A long slot of which one setting is searched for one contact, to more digits than any number of shots
/// can tell: of 39 such searches this one alone is not within the error of its figures at the end.
fn demanding() -> Scenario {
    let mut problem = crate::common::keyway(200e-3);
    problem.ranges.azimuth = Range::held(0.0);
    problem.ranges.standoff = Range::held(8e-3);
    problem.ranges.contact = vec![2];
    problem.paths.impacts = IMPACTS;
    problem.accuracy = 1e-7;
    Scenario::new(problem, Walls::Exact).unwrap()
}

const IMPACTS: usize = 2;
/// Fewer than a search takes by itself that is asked for this much.
const MOST_SHOTS: usize = 1 << 14;

/// The rays of each pose that a search has judged, from what it has written down.
fn rays_of_poses(checkpoint: &Path) -> Vec<usize> {
    let text = fs::read_to_string(checkpoint).unwrap();
    let outcomes = text.lines().skip(1).map(|line| {
        let outcome = line.splitn(3, ' ').nth(2).unwrap();
        serde_json::from_str::<Value>(outcome).unwrap()
    });
    let rays = outcomes.filter_map(|outcome| outcome["rays"].as_u64());
    rays.map(|rays| rays as usize).collect()
}

#[test]
fn a_search_that_cannot_be_accurate_enough_stops_at_the_most_shots() {
    // Without an importance density; even so a search ends before where its shots happen to tell nothing more.
    let solved = (20..32).map(|seed| {
        let mut scenario = demanding();
        scenario.problem.seed = seed;
        let folder = TempDir::new().unwrap();
        let checkpoint = Arc::new(Checkpoint::open(folder.path(), &scenario).unwrap());
        let control = Control {
            checkpoint: Some(Arc::clone(&checkpoint)),
            shortcuts: Shortcuts {
                importance: false,
                ..Shortcuts::default()
            },
            most_shots: MOST_SHOTS,
            ..Control::default()
        };
        let solution = solve(&scenario, &control);
        checkpoint.finish().unwrap();
        let rays = rays_of_poses(&folder.path().join("checkpoint.txt"));
        (solution, rays)
    });
    let mut longest = solved.filter(|(it, _)| it.shots_per_pose == MOST_SHOTS);
    let (_, rays) = longest.next().expect("some of them go on to the end");
    let most = rays.iter().max().unwrap();
    // A shot takes as many rays as it may have impacts, at most.
    assert!((MOST_SHOTS..=IMPACTS * MOST_SHOTS).contains(most), "{most}");
}
