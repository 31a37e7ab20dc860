//! Whole small searches: the result is finite, can be written and read back, and can be shown.

use std::path::Path;

use peenpose::problem::{self, Source};
use peenpose::record::{Circumstances, FrontRecord, Record, WorkRecord};
use peenpose::scene::Walls;
use peenpose::setup::Setup;
use peenpose::solve::{Answer, Control, Solution, front, passing_windows, solve};
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
    let (setup, source) = match Setup::load(&file) {
        Ok(loaded) => loaded,
        Err(rejection) => {
            assert!(!rejection.faults.is_empty());
            return;
        }
    };
    let _ = problem::render_warnings(&source, &warnings::of(&setup, &source), false);
    let control = Control {
        most_shots,
        fresh_shots: 128,
        ..Control::default()
    };
    let solution = solve(&setup, &control);
    let setup = setup.as_asked();
    assert_eq!(
        solution.answers.len(),
        setup.problem.settings.contact.len(),
        "{problem}"
    );
    for answer in &solution.answers {
        is_legal(&setup, answer, &problem);
    }
    let mut record = recorded(&setup, &source, &solution);
    match wanted {
        0..20 => {
            let front = front(&setup, &solution.answers, &control);
            record.front = FrontRecord::all(&setup, &front);
        }
        20..40 => record = record.with_evidence(&setup, &solution.answers[0]),
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
pub fn is_legal(setup: &Setup, answer: &Answer, problem: &str) {
    let (settings, choice) = (&setup.problem.settings, &answer.choice);
    for (range, value) in [
        (settings.incidence, choice.incidence),
        (settings.azimuth, choice.azimuth),
        (settings.standoff, choice.standoff),
        (settings.speed, choice.speed),
        (settings.aim_along, choice.aim_along),
        (settings.aim_across, choice.aim_across),
        (settings.aim_above, choice.aim_above),
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
pub fn sound(text: &str) -> (Setup, Source) {
    let reading = problem::read_text(text, Path::new("any.yaml")).expect("short enough");
    let problem = reading.problem.expect("the problem is sound");
    let setup = Setup::new(problem, Walls::Exact).expect("the problem is sound");
    (setup, reading.source)
}

/// As `peenpose solve` makes it.
pub fn recorded(setup: &Setup, source: &Source, solution: &Solution) -> Record {
    let best = &solution.answers[0];
    let notes = validity::notes(setup, &best.choice, best.evaluation.as_ref());
    let fits = best.evaluation.is_some();
    let unknowns = fits.then(|| Unknowns::of(setup, &best.choice)).flatten();
    let circumstances = Circumstances {
        ladder: &solution.ladder,
        source,
        status: solution.status.into(),
        command: "peenpose solve any.yaml".into(),
        work: WorkRecord {
            poses: solution.poses,
            shots_per_pose: solution.shots_per_pose,
            rays: solution.rays,
            seconds: 0.0,
        },
    };
    let windows = passing_windows(setup, solution);
    Record::new(
        setup,
        &solution.answers,
        &windows,
        notes,
        unknowns,
        circumstances,
    )
    .expect("there is an answer")
}
