//! Runs that are killed, cut short or run out of room: results are whole or the old ones, and kept
//! work is gone on from.
#![cfg(unix)]

use std::collections::BTreeSet;
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde_json::Value;
use tempfile::TempDir;

const KEYWAY: &str = "problems/keyway-long.yaml";
const PLATE: &str = "problems/plate.yaml";
const MAP: [&str; 10] = [
    "map",
    KEYWAY,
    "--x",
    "incidence",
    "--y",
    "azimuth",
    "--steps",
    "61",
    "--shots",
    "2048",
];
const SETTINGS: [&str; 4] = ["--set", "standoff=8mm", "--set", "speed=12m/s"];

fn peenpose(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_peenpose"));
    command
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(arguments);
    command
}

fn run(arguments: &[&str]) -> Output {
    peenpose(arguments).output().unwrap()
}

fn messages(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn started(arguments: &[&str]) -> Child {
    let mut command = peenpose(arguments);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().unwrap()
}

/// Kills a run after a while; tells whether it was still at work.
fn killed_after(arguments: &[&str], time: Duration) -> bool {
    let mut child = started(arguments);
    sleep(time);
    let was_at_work = child.try_wait().unwrap().is_none();
    child.kill().unwrap();
    child.wait().unwrap();
    was_at_work
}

/// Later than what still counts as the same request.
const ASKED_AGAIN: Duration = Duration::from_millis(700);

/// Sends signals to a run that was waited for, each with a pause after it, and gives how it ended.
fn signalled(arguments: &[&str], wait: impl Fn(), signals: &[(&str, Duration)]) -> Output {
    let mut command = peenpose(arguments);
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = command.spawn().unwrap();
    wait();
    for (signal, pause) in signals {
        // Fails where the program has ended by itself.
        let _ = Command::new("kill")
            .args([*signal, &child.id().to_string()])
            .stderr(Stdio::null())
            .status()
            .unwrap();
        sleep(*pause);
    }
    child.wait_with_output().unwrap()
}

/// Waits until there is work in a checkpoint, after which a run goes on with more.
fn until_work_is_in(kept: &str) {
    let file = Path::new(kept).join("checkpoint.txt");
    while !fs::metadata(&file).is_ok_and(|file| file.len() > 1000) {
        sleep(Duration::from_millis(1));
    }
}

/// Kills runs later and later until one ends before; returns how many were killed at work.
fn killed_until_one_ends(arguments: &[&str]) -> usize {
    let times = std::iter::successors(Some(Duration::from_millis(400)), |time| Some(*time * 3 / 2));
    times
        .take_while(|&time| killed_after(arguments, time))
        .count()
}

/// A result without its times, which differ from run to run.
fn timeless(json: &[u8]) -> Value {
    fn forget_times(value: &mut Value) {
        match value {
            Value::Object(entries) => {
                entries.remove("seconds");
                entries.remove("relative_time");
                entries.values_mut().for_each(forget_times);
            }
            Value::Array(items) => items.iter_mut().for_each(forget_times),
            _ => {}
        }
    }
    let mut value = serde_json::from_slice(json).unwrap();
    forget_times(&mut value);
    value
}

fn solve_in(folder: &Path) -> Vec<String> {
    let words = ["solve", KEYWAY, "--pareto", "--json", "--checkpoint"];
    let folder = folder.to_str().unwrap();
    words
        .into_iter()
        .chain([folder])
        .map(str::to_owned)
        .collect()
}

fn borrowed(words: &[String]) -> Vec<&str> {
    words.iter().map(String::as_str).collect()
}

#[test]
fn a_solve_that_was_killed_again_and_again_ends_with_the_same_bits() {
    let folder = TempDir::new().unwrap();
    let words = solve_in(folder.path());
    let with_checkpoint = borrowed(&words);
    let uninterrupted = run(&with_checkpoint[..4]);
    assert!(killed_until_one_ends(&with_checkpoint) > 0);
    let last = run(&with_checkpoint);
    assert!(messages(&last).contains(" pieces of work were in the checkpoint"));
    assert_eq!(timeless(&last.stdout), timeless(&uninterrupted.stdout));
}

#[test]
fn a_map_that_was_killed_again_and_again_ends_with_the_same_bytes() {
    let folder = TempDir::new().unwrap();
    let place = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (kept, once, again) = (place("kept"), place("once"), place("again"));
    let map = [&MAP[..], &SETTINGS, &["--set", "contact=oiled", "--out"]].concat();
    run(&[&map[..], &[&once]].concat());
    let with_checkpoint = [&map[..], &[&again, "--checkpoint", &kept]].concat();
    assert!(killed_until_one_ends(&with_checkpoint) > 0);
    for ending in ["csv", "svg", "png"] {
        let bytes = |out: &str| fs::read(format!("{out}/map-incidence-azimuth.{ending}")).unwrap();
        assert!(bytes(&once) == bytes(&again), "{ending}");
    }
}

fn map_in(folder: &str) -> Option<String> {
    fs::read_to_string(format!("{folder}/map-incidence-azimuth.csv")).ok()
}

/// Whether a map that was told to stop has blanks; beside them it is the whole one, and says so.
fn has_blanks(told: &Output, out: &str, whole: &str) -> bool {
    let found = map_in(out).unwrap();
    let known = whole.lines().zip(found.lines());
    let (known, blank): (Vec<_>, Vec<_>) = known.partition(|(whole, found)| whole == found);
    assert_eq!(found.lines().count(), whole.lines().count());
    assert!(blank.iter().all(|(_, found)| found.ends_with(",,,,,,,,")));
    assert_eq!(fs::read_dir(out).unwrap().count(), 3);
    if blank.is_empty() {
        assert_eq!(told.status.code(), Some(0));
        return false;
    }
    assert_eq!(told.status.code(), Some(130), "{}", messages(told));
    let text = String::from_utf8(told.stdout.clone()).unwrap();
    let known = known.len() - 1;
    let count = format!("stopped when {known} of 3721 were known");
    assert!(
        text.replace(' ', "").contains(&count.replace(' ', "")),
        "{text}"
    );
    assert!(messages(told).contains("blank where nothing is known"));
    true
}

#[test]
fn a_map_that_is_told_to_stop_shows_what_is_known_and_is_gone_on_with() {
    let folder = TempDir::new().unwrap();
    let place = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let once = place("once");
    let map = [&MAP[..], &SETTINGS, &["--set", "contact=oiled", "--out"]].concat();
    let started = Instant::now();
    run(&[&map[..], &[&once]].concat());
    let time = started.elapsed();
    let whole = map_in(&once).unwrap();
    // Whatever the moment: nothing is written, or a map with blanks and without anything wrong, or the
    // whole one.
    for (round, signal) in (1..4).zip(["-INT", "-TERM"].into_iter().cycle()) {
        let out = place(&format!("stopped-{round}"));
        let wait = || sleep(time * round / 4);
        let told = signalled(
            &[&map[..], &[&out]].concat(),
            wait,
            &[(signal, Duration::ZERO)],
        );
        if map_in(&out).is_some() {
            has_blanks(&told, &out, &whole);
        }
    }
    for signal in ["-INT", "-TERM"] {
        let (kept, again) = (place(&format!("kept{signal}")), place("again"));
        let with_checkpoint = [&map[..], &[&again, "--checkpoint", &kept]].concat();
        let until_kept = || until_work_is_in(&kept);
        let told = signalled(&with_checkpoint, until_kept, &[(signal, Duration::ZERO)]);
        assert!(has_blanks(&told, &again, &whole));
        let last = run(&with_checkpoint);
        assert!(messages(&last).contains(" pieces of work were in the checkpoint"));
        assert_eq!(last.status.code(), Some(0));
        assert!(map_in(&again).unwrap() == whole);
    }
}

#[test]
fn a_map_that_is_told_twice_to_stop_ends_at_once() {
    let folder = TempDir::new().unwrap();
    let place = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (kept, out) = (place("kept"), place("out"));
    // A row, whose paths are traced once, takes much longer than it takes to ask for an end.
    let map = [
        "map",
        KEYWAY,
        "--x",
        "speed",
        "--y",
        "incidence",
        "--steps",
        "401",
        "--shots",
        "1048576",
        "--set",
        "azimuth=0deg",
        "--set",
        "standoff=8mm",
        "--contact",
        "oiled",
        "--out",
        &out,
        "--checkpoint",
        &kept,
    ];
    // While it is frozen it does not end by itself, however fast the machine is.
    let signals = [
        ("-INT", Duration::from_millis(100)),
        ("-STOP", ASKED_AGAIN),
        ("-INT", Duration::ZERO),
        ("-CONT", Duration::ZERO),
    ];
    let told = signalled(&map, || until_work_is_in(&kept), &signals);
    assert_eq!(told.status.code(), Some(130));
    assert_eq!(
        messages(&told),
        "note: ended at once: not everything has been written\n"
    );
    assert_eq!(fs::read_dir(&out).unwrap().count(), 0);
}

#[test]
fn a_result_is_the_old_one_or_the_new_one_whenever_its_run_is_killed() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().to_str().unwrap();
    let solve = |seed: &'static str| ["solve", PLATE, "--out", out, "--seed", seed];
    let result = folder.path().join("result.json");
    run(&solve("1"));
    let old = timeless(&fs::read(&result).unwrap());
    let (mut olds, mut news) = (0, 0);
    for round in 0..40 {
        killed_after(&solve("2"), Duration::from_millis(5 * round));
        let found = timeless(&fs::read(&result).unwrap());
        if found == old {
            olds += 1;
            continue;
        }
        news += 1;
        assert_eq!(found["problem"]["seed"], 2);
        run(&solve("1"));
    }
    assert!(olds > 0 && news > 0, "{olds} {news}");
}

#[test]
fn a_checkpoint_that_was_cut_short_anywhere_is_gone_on_from() {
    let folder = TempDir::new().unwrap();
    let kept = folder.path().to_str().unwrap();
    let solve = ["solve", PLATE, "--json", "--checkpoint", kept];
    let whole = run(&solve);
    let path = folder.path().join("checkpoint.txt");
    let lines = fs::read(&path).unwrap();
    assert!(lines.len() > 1000);
    for length in [0, 1, 21, 22, 60, lines.len() / 2, lines.len() - 1] {
        fs::write(&path, &lines[..length]).unwrap();
        let again = run(&solve);
        assert_eq!(
            again.status.code(),
            Some(0),
            "{length}: {}",
            messages(&again)
        );
        assert_eq!(timeless(&again.stdout), timeless(&whole.stdout), "{length}");
        let after = fs::read(&path).unwrap();
        assert!(after.starts_with(b"peenpose checkpoint 2\n"), "{length}");
        assert_eq!(distinct(&after), distinct(&lines), "{length}");
    }
}

/// The lines of a file, each once: what a run works out twice it writes twice.
fn distinct(lines: &[u8]) -> BTreeSet<&[u8]> {
    lines.split(|&byte| byte == b'\n').collect()
}

#[test]
fn what_is_no_checkpoint_or_damaged_or_in_use_is_said() {
    let folder = TempDir::new().unwrap();
    let kept = folder.path().to_str().unwrap();
    let path = folder.path().join("checkpoint.txt");
    let refused = |folder: &str| {
        let output = run(&["solve", PLATE, "--checkpoint", folder]);
        assert_eq!(output.status.code(), Some(2));
        assert_eq!(output.stdout, b"");
        messages(&output)
    };
    fs::write(&path, "shopping list\nshot").unwrap();
    assert!(refused(kept).contains("checkpoint.txt is not a checkpoint"));
    assert_eq!(fs::read(&path).unwrap(), b"shopping list\nshot");

    fs::remove_file(&path).unwrap();
    run(&["solve", PLATE, "--checkpoint", kept]);
    let whole = fs::read_to_string(&path).unwrap();
    let third = whole.lines().nth(2).unwrap();
    let digit = third.rfind(|c: char| c.is_ascii_digit()).unwrap();
    let other = if third[digit..].starts_with('1') {
        "2"
    } else {
        "1"
    };
    let mut changed = third.to_owned();
    changed.replace_range(digit..=digit, other);
    for damaged in ["nonsense", &changed] {
        fs::write(&path, whole.replace(third, damaged)).unwrap();
        assert!(refused(kept).contains("checkpoint.txt:3: the checkpoint is damaged"));
    }

    fs::write(&path, "").unwrap();
    let user = OpenOptions::new().write(true).open(&path).unwrap();
    user.lock().unwrap();
    assert!(refused(kept).contains("checkpoint.txt is in use by another run"));

    let in_a_file = path.join("further");
    assert!(refused(in_a_file.to_str().unwrap()).contains("cannot keep work in"));
}

#[test]
fn work_on_another_problem_or_mesh_is_not_taken() {
    let folder = TempDir::new().unwrap();
    let problem = folder.path().join("problem.yaml");
    let mesh = folder.path().join("block.obj");
    let kept = folder.path().join("kept");
    let sheet = "v -50 -50 Z\nv 50 -50 Z\nv 50 50 Z\nv -50 50 Z\ng face\nf 1 2 3 4\n";
    let solve = |with_checkpoint: bool| {
        let file = problem.to_str().unwrap();
        let mut words = vec!["solve", file, "--json"];
        if with_checkpoint {
            words.extend(["--checkpoint", kept.to_str().unwrap()]);
        }
        run(&words)
    };
    let question = |height: &str, goal: &str| {
        let goal = format!("goals: {{ normal_impulse: {{ target: {goal} uN.s }} }}\n");
        let problem_text = format!(
            "format: 1\nlengths_in: mm\nscene:\n  block: {{ mesh: block.obj }}\n\
             target: {{ surface: block.face, along: [1, 0, 0], facing: [0, 0, 1] }}\n\
             shot: {{ radius: 0.5 mm, density: 7000 kg/m3 }}\n\
             jet: {{ exit_diameter: 1.5 mm, divergence: 4 deg }}\n\
             contacts:\n  dry: {{ mu_s: 0.3, mu_d: 0.27, restitution: 0.25 }}\n\
             settings:\n  incidence: [45 deg, 85 deg]\n  azimuth: 0 deg\n  standoff: 8 mm\n  \
             speed: [5 m/s, 40 m/s]\n{goal}"
        );
        fs::write(&problem, problem_text).unwrap();
        fs::write(&mesh, sheet.replace('Z', height)).unwrap();
    };
    for (height, goal) in [("0", "40"), ("0", "60"), ("3", "60")] {
        question(height, goal);
        let first = solve(true);
        // A sheet is open on all sides.
        let said = messages(&first);
        assert!(
            said.starts_with("warning: part `block`: 4 open edges") && said.lines().count() == 1,
            "{height} {goal}: {said}"
        );
        assert!(matches!(first.status.code(), Some(0 | 1)));
        assert_eq!(timeless(&first.stdout), timeless(&solve(false).stdout));
        let again = solve(true);
        assert!(messages(&again).contains("note: "), "{height} {goal}");
        assert_eq!(timeless(&first.stdout), timeless(&again.stdout));
    }
}

/// Runs with files limited to so many blocks of 512 bytes: writing more fails, as on a full disk.
fn run_with_room(blocks: usize, arguments: &[&str]) -> Output {
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$@\"");
    Command::new("sh")
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["-c", &script, "sh", env!("CARGO_BIN_EXE_peenpose")])
        .args(arguments)
        .output()
        .unwrap()
}

#[test]
fn on_a_full_disk_the_old_result_stays_and_the_failure_is_said() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().to_str().unwrap();
    run(&["solve", PLATE, "--out", out]);
    let result = folder.path().join("result.json");
    let old = fs::read(&result).unwrap();
    let files = || fs::read_dir(out).unwrap().count();
    let count = files();
    let failed = run_with_room(4, &["solve", PLATE, "--out", out, "--seed", "2"]);
    assert_eq!(failed.status.code(), Some(2));
    assert!(
        messages(&failed).contains("error: cannot write"),
        "{}",
        messages(&failed)
    );
    assert_eq!(fs::read(&result).unwrap(), old);
    assert_eq!(files(), count);
}

/// The system's own folder of figures is one that not even an administrator can add to.
#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_nobody_may_write_into_is_named_before_the_work() {
    for folder in ["/sys/kernel", "/sys/peenpose"] {
        let failed = run(&["solve", PLATE, "--out", folder]);
        assert_eq!(failed.status.code(), Some(2));
        let said = messages(&failed);
        let start = format!("error: cannot write into {folder}: ");
        assert!(said.starts_with(&start), "{said}");
        assert!(failed.stdout.is_empty());
    }
}

#[test]
fn a_checkpoint_on_a_full_disk_costs_no_answer() {
    let folder = TempDir::new().unwrap();
    let kept = folder.path().to_str().unwrap();
    let solve = ["solve", KEYWAY, "--json", "--checkpoint", kept];
    let told = run_with_room(8, &solve);
    assert!(messages(&told).starts_with("warning: --checkpoint: cannot keep work in"));
    let whole = run(&solve[..3]);
    assert_eq!(timeless(&told.stdout), timeless(&whole.stdout));
    assert_eq!(told.status.code(), whole.status.code());
    // What was written before is of use.
    let again = run(&solve);
    assert!(
        messages(&again).starts_with("note: "),
        "{}",
        messages(&again)
    );
    assert_eq!(timeless(&again.stdout), timeless(&whole.stdout));
}

#[test]
fn a_mesh_that_has_vanished_is_named() {
    let folder = TempDir::new().unwrap();
    let problem = folder.path().join("keyway-blind.yaml");
    fs::copy("problems/keyway-blind.yaml", &problem).unwrap();
    let output = run(&["solve", problem.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    assert!(messages(&output).contains("hub-blind-keyway.obj"));
}

#[test]
fn added_lines_go_on_where_the_file_ends() {
    let folder = TempDir::new().unwrap();
    let kept = folder.path().to_str().unwrap();
    let path = folder.path().join("checkpoint.txt");
    run(&["solve", PLATE, "--checkpoint", kept]);
    let before = fs::read(&path).unwrap();
    let mut file = OpenOptions::new().append(true).open(&path).unwrap();
    file.write_all(b"0123 torn").unwrap();
    drop(file);
    run(&["solve", PLATE, "--checkpoint", kept, "--seed", "2"]);
    let after = fs::read(&path).unwrap();
    assert!(after.len() > before.len() && after.starts_with(&before));
    assert!(!String::from_utf8(after).unwrap().contains("torn"));
}
