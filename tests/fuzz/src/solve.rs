//! Whole small searches: the result is finite, can be written and read back, and can be shown.

use std::path::Path;

use peenpose::control::Control;
use peenpose::problem::{self, Source};
use peenpose::record::{FrontRecord, Record, RunInfo, WorkRecord};
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::solve::{Answer, Solution, front, passing_windows, solve};
use peenpose::unknowns::Unknowns;
use peenpose::{report, validity, warnings};

use super::bytes::Bytes;
use super::solve_problem::{self, Written};

pub fn run(data: &[u8]) {
    let mut bytes = Bytes(data);
    let (wanted, most_shots) = (bytes.byte(), *bytes.of(&[64, 64, 128]));
    let Written { problem, mesh } = solve_problem::write(&mut bytes);
    let folder = tempfile::tempdir().expect("there is room for a folder");
    let file = folder.path().join("any.yaml");
    std::fs::write(&file, &problem).expect("there is room for a problem");
    std::fs::write(folder.path().join("part.obj"), mesh).expect("there is room for a mesh");
    let (scenario, source) = match Scenario::load(&file) {
        Ok(loaded) => loaded,
        Err(rejection) => {
            assert!(!rejection.faults.is_empty());
            return;
        }
    };
    let _ = problem::render_warnings(&source, &warnings::of(&scenario, &source), false);
    let control = Control {
        most_shots,
        validation_shots: 128,
        ..Control::default()
    };
    let solution = solve(&scenario, &control);
    let scenario = scenario.as_asked();
    assert_eq!(
        solution.answers.len(),
        scenario.problem.ranges.contact.len(),
        "{problem}"
    );
    for answer in &solution.answers {
        is_legal(&scenario, answer, &problem);
    }
    let mut record = recorded(&scenario, &source, &solution);
    match wanted {
        0..20 => {
            let front = front(&scenario, &solution.answers, &control);
            record.front = FrontRecord::all(&scenario, &front);
        }
        20..40 => {
            record = record.with_evidence(
                &scenario,
                &solution.answers[0],
                &peenpose::control::Control::default(),
            )
        }
        _ => {}
    }
    let text = record
        .to_json()
        .expect("every number of a record is finite");
    let back =
        Record::from_json(&text).unwrap_or_else(|error| panic!("{error}:\n{problem}\n{text}"));
    assert!(back == record, "{problem}\n{text}");
    let at_random = folder.path().display().to_string();
    let sheet = report::sheet(&record).replace(&at_random, "");
    assert!(
        !sheet.contains("NaN") && !sheet.contains("inf "),
        "{problem}\n{sheet}"
    );
    report::page(&record).expect("a page can be made of every record");
}

/// Settings are within their ranges, and figures are shares.
pub fn is_legal(scenario: &Scenario, answer: &Answer, problem: &str) {
    let (ranges, settings) = (&scenario.problem.ranges, &answer.settings);
    for (range, value) in [
        (ranges.incidence, settings.incidence),
        (ranges.azimuth, settings.azimuth),
        (ranges.standoff, settings.standoff),
        (ranges.speed, settings.speed),
        (ranges.aim_along, settings.aim_along),
        (ranges.aim_across, settings.aim_across),
        (ranges.aim_above, settings.aim_above),
    ] {
        let off = 1e-9 * range.max.abs().max(range.min.abs());
        assert!(
            range.min - off <= value && value <= range.max + off,
            "{value}: {problem}"
        );
    }
    assert!(answer.violation >= 0.0, "{} {problem}", answer.violation);
    for verdict in &answer.verdicts {
        assert!((0.0..=1.0).contains(&verdict.share()), "{problem}");
        let [low, high] = verdict.interval();
        assert!(
            0.0 <= low && low <= high && high <= 1.0,
            "{low} to {high}: {problem}"
        );
    }
}

/// What a sound problem file of exact walls says.
pub fn sound(text: &str) -> (Scenario, Source) {
    let reading = problem::read_text(text, Path::new("any.yaml")).expect("short enough");
    let problem = reading.problem.expect("the problem is sound");
    let scenario = Scenario::new(problem, Walls::Exact).expect("the problem is sound");
    (scenario, reading.source)
}

/// As `peenpose solve` makes it.
pub fn recorded(scenario: &Scenario, source: &Source, solution: &Solution) -> Record {
    let best = &solution.answers[0];
    let notes = validity::notes(scenario, &best.settings, best.evaluation.as_ref());
    let fits = best.evaluation.is_some();
    let unknowns = fits
        .then(|| Unknowns::of(scenario, &best.settings))
        .flatten();
    let run = RunInfo {
        segments: &[],
        ablations: &solution.ablations,
        source,
        status: solution.status.into(),
        spread: None,
        command: "peenpose solve any.yaml".into(),
        work: WorkRecord {
            poses: solution.poses,
            shots_per_pose: solution.shots_per_pose,
            rays: solution.rays,
            seconds: 0.0,
        },
    };
    let windows = passing_windows(
        scenario,
        &solution.answers[0],
        &peenpose::control::Cancel::default(),
    );
    Record::new(scenario, &solution.answers, &windows, notes, unknowns, run)
        .expect("there is an answer")
}
