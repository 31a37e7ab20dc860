//! Checkpoints: whatever happened to the file, it is refused with a reason, or the run that goes on
//! from it ends as one that was never interrupted; and whatever somebody wrote into one, a run ends
//! with settings that are legal.

use std::fs;
use std::sync::{Arc, LazyLock};

use peenpose::checkpoint::{Checkpoint, Trouble};
use peenpose::control::Control;
use peenpose::map::{Axis, Map};
use peenpose::problem::Source;
use peenpose::problem::setting::Setting;
use peenpose::record::{MapRecord, Record};
use peenpose::scenario::Scenario;
use peenpose::solve::{Solution, solve};
use tempfile::TempDir;

use super::bytes::Bytes;
use super::checkpoint_edit::{damage, forge};
use super::solve::{is_legal, recorded, sound};

const HEADING: &[u8] = b"peenpose checkpoint 2\n";
/// Longest complaint about a file, its own name included.
const LONGEST_COMPLAINT: usize = 1000;

const PROBLEM: &str = "
format: 1
lengths_in: mm
scene:
  block: { box: { min: [-5, -5, -5], max: [5, 5, 0] } }
  wall: { box: { min: [4, -5, 0], max: [5, 5, 6] } }
target: { surface: block.z_max, aim: [0, 0, 0], along: [1, 0, 0] }
shot: { radius: 0.5 mm, density: 7000 kg/m3 }
jet: { exit_diameter: 1.5 mm, divergence: 4 deg, speed_spread: 5 % }
nozzle: { body: [ { ball: { radius: 3 mm } } ], clearance: 0 mm }
contacts:
  dry: { mu_s: 0.30, mu_d: 0.27, restitution: 0.25 }
settings:
  incidence: [40 deg, 85 deg]
  azimuth: 0 deg
  standoff: [3 mm, 6 mm]
  speed: [5 m/s, 40 m/s]
goals:
  normal_impulse: { target: 40 uN.s, tolerance: 15 % }
  rebound: { allow: 10 uN.s }
  miss: { share: 1 % }
";

/// A small search and two small maps that were never interrupted, and the file that they leave.
struct Uninterrupted {
    scenario: Scenario,
    source: Source,
    file: Vec<u8>,
    outcome: Outcome,
}

/// All that a run comes to.
#[derive(Debug)]
struct Outcome {
    solution: Solution,
    maps: [Map; 2],
}

impl Outcome {
    fn is_that_of(&self, other: &Self) -> bool {
        // Every number is written to the last bit.
        format!("{self:?}") == format!("{other:?}")
    }
}

static WHOLE: LazyLock<Uninterrupted> = LazyLock::new(|| {
    let (scenario, source) = sound(PROBLEM);
    let outcome = outcome(&scenario, None);
    let folder = folder();
    let kept = Checkpoint::open(folder.path(), &scenario).expect("there is no file yet");
    let kept = Arc::new(kept);
    assert!(outcome.is_that_of(&self::outcome(&scenario, Some(&kept))));
    kept.finish().expect("there is room");
    let file = fs::read(folder.path().join("checkpoint.txt")).expect("it was written");
    Uninterrupted {
        scenario,
        source,
        file,
        outcome,
    }
});

pub fn run(data: &[u8]) {
    let mut bytes = Bytes(data);
    match bytes.byte() % 4 {
        0 => is_refused_or_the_same(bytes.0),
        1 => is_refused_or_the_same(&[HEADING, bytes.0].concat()),
        2 => is_refused_or_the_same(&damage(&WHOLE.file, &mut bytes)),
        _ => ends_legally(&forge(&WHOLE.file, &mut bytes)),
    }
}

fn is_refused_or_the_same(file: &[u8]) {
    let folder = folder();
    let path = folder.path().join("checkpoint.txt");
    fs::write(&path, file).expect("there is room for a file");
    let whole = &*WHOLE;
    let kept = match Checkpoint::open(folder.path(), &whole.scenario) {
        Ok(kept) => Arc::new(kept),
        Err(trouble) => {
            is_told(&trouble, file);
            // It may be somebody's only copy of something else.
            assert!(fs::read(&path).expect("it is there") == file);
            return;
        }
    };
    let outcome = outcome(&whole.scenario, Some(&kept));
    assert!(outcome.is_that_of(&whole.outcome), "{}", shown(file));
    kept.finish().expect("there is room");
    drop(kept);
    let after = fs::read(&path).expect("it is there");
    assert!(after.starts_with(HEADING), "{}", shown(file));
    let finished = file.iter().rposition(|&byte| byte == b'\n');
    let lines = finished.map_or(&[][..], |last| &file[..=last]);
    assert!(after.starts_with(lines), "{}", shown(file));
    nothing_is_left_to_do(&folder);
}

fn nothing_is_left_to_do(folder: &TempDir) {
    let whole = &*WHOLE;
    let kept = Checkpoint::open(folder.path(), &whole.scenario).expect("it is our own");
    let kept = Arc::new(kept);
    let again = outcome(&whole.scenario, Some(&kept));
    assert!(again.is_that_of(&whole.outcome));
    assert_eq!(kept.added(), 0);
}

fn is_told(trouble: &Trouble, file: &[u8]) {
    match trouble {
        Trouble::Foreign(_) => assert!(!file.starts_with(HEADING), "{}", shown(file)),
        Trouble::Damaged(_, line) => {
            let lines = file.split(|&byte| byte == b'\n').count();
            assert!((2..lines).contains(line), "{line} of {lines}");
        }
        Trouble::File(..) | Trouble::InUse(_) | Trouble::TooLarge(_) => panic!("{trouble}"),
    }
    let complaint = trouble.to_string();
    assert!(complaint.chars().count() <= LONGEST_COMPLAINT);
    assert!(!complaint.contains(char::is_control), "{complaint:?}");
}

/// What is forged may lead anywhere, as long as it is within the ranges and can be shown.
fn ends_legally(file: &[u8]) {
    let folder = folder();
    let path = folder.path().join("checkpoint.txt");
    fs::write(&path, file).expect("there is room for a file");
    let whole = &*WHOLE;
    let kept = Checkpoint::open(folder.path(), &whole.scenario).expect("its checksums are right");
    let kept = Arc::new(kept);
    let outcome = outcome(&whole.scenario, Some(&kept));
    let scenario = whole.scenario.as_asked();
    for answer in &outcome.solution.answers {
        is_legal(&scenario, answer, PROBLEM);
    }
    for map in &outcome.maps {
        let shown = serde_json::to_string(&MapRecord::new(&scenario, map)).expect("it is finite");
        let back: MapRecord = serde_json::from_str(&shown).expect("what was written can be read");
        assert!(back == MapRecord::new(&scenario, map), "{shown}");
    }
    // Records take most of the time: in some cases only.
    if !file.len().is_multiple_of(4) {
        return;
    }
    let record = recorded(&scenario, &whole.source, &outcome.solution);
    let written = record
        .to_json()
        .expect("every number of a record is finite");
    let back = Record::from_json(&written).expect("what was written can be read");
    assert!(back == record, "{written}");
}

/// A search, and a map with each of the ways to share paths between its places.
fn outcome(scenario: &Scenario, checkpoint: Option<&Arc<Checkpoint>>) -> Outcome {
    let control = Control {
        most_shots: 64,
        validation_shots: 128,
        checkpoint: checkpoint.cloned(),
        ..Control::default()
    };
    let solution = solve(scenario, &control);
    let scenario = scenario.as_asked();
    let axis = |setting: Setting| {
        let range = scenario
            .problem
            .ranges
            .range(setting)
            .expect("it is of the nozzle");
        Axis::over(setting, range, 3)
    };
    let map = |x, y| {
        Map::of(
            &scenario,
            &solution.answers[0].settings,
            axis(x),
            axis(y),
            64,
            &control,
        )
    };
    let maps = [
        map(Setting::Speed, Setting::Incidence),
        map(Setting::Incidence, Setting::Standoff),
    ];
    Outcome { solution, maps }
}

fn folder() -> TempDir {
    tempfile::tempdir().expect("there is room for a folder")
}

fn shown(file: &[u8]) -> String {
    String::from_utf8_lossy(file).into_owned()
}
