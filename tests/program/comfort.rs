//! The command line as people use it: completions, manual, colours, quiet, pipes that break, Ctrl-C.

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use crate::common::program::GOOD;
use serde_json::Value;
use tempfile::TempDir;

const KEYWAY: &str = "problems/keyway.yaml";
const DOUBTFUL: &str = "tests/doubtful/exit_too_small.yaml";
const MAP_OF_PLATE: [&str; 7] = [
    "problems/plate.yaml",
    "--x",
    "incidence=40deg:80deg",
    "--y",
    "speed=5m/s:15m/s",
    "--set",
    "contact=mu_006",
];

fn peenpose(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_peenpose"));
    command
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .env_remove("NO_COLOR")
        .env_remove("CLICOLOR_FORCE");
    command
}

fn run(arguments: &[&str]) -> Output {
    peenpose(arguments).output().unwrap()
}

fn out(output: &Output) -> &str {
    std::str::from_utf8(&output.stdout).unwrap()
}

fn messages(output: &Output) -> &str {
    std::str::from_utf8(&output.stderr).unwrap()
}

/// The names of all commands, from the help.
fn commands() -> Vec<String> {
    let help = run(&["--help"]);
    let lines = out(&help).lines().skip_while(|line| *line != "Commands:");
    let listed = lines.skip(1).take_while(|line| !line.is_empty());
    let names = listed.filter_map(|line| line.split_whitespace().next());
    let names: Vec<String> = names.map(str::to_owned).collect();
    assert!(names.len() > 6, "{names:?}");
    names
}

#[test]
fn completions_know_every_command_and_its_options() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = run(&["completions", shell]);
        assert_eq!(script.status.code(), Some(0));
        for word in commands()
            .iter()
            .map(String::as_str)
            .chain(["pareto", "steps"])
        {
            assert!(out(&script).contains(word), "{shell}: {word}");
        }
    }
    assert_eq!(run(&["completions", "cmd"]).status.code(), Some(2));
    // The shell itself must take it.
    if let Ok(mut bash) = Command::new("bash")
        .args(["-n", "/dev/stdin"])
        .stdin(Stdio::piped())
        .spawn()
    {
        let script = run(&["completions", "bash"]);
        std::io::Write::write_all(bash.stdin.as_mut().unwrap(), &script.stdout).unwrap();
        assert!(bash.wait().unwrap().success());
    }
}

#[test]
fn the_manual_has_a_page_for_every_command() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("man1");
    let written = run(&["man", "--out", path.to_str().unwrap()]);
    assert_eq!(written.status.code(), Some(0));
    for name in commands().iter().filter(|name| *name != "help") {
        let page = std::fs::read_to_string(path.join(format!("peenpose-{name}.1"))).unwrap();
        assert!(page.contains(".TH") && page.contains("Examples:"), "{name}");
        let printed = run(&["man", name]);
        assert_eq!(out(&printed), page);
    }
    let whole = run(&["man"]);
    assert!(out(&whole).contains("Exit status"));
    let unknown = run(&["man", "sovle"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(messages(&unknown).contains("did you mean `solve`"));
}

#[test]
fn every_command_explains_itself_with_examples() {
    for name in commands().iter().filter(|name| *name != "help") {
        let help = run(&[name, "--help"]);
        assert!(out(&help).contains("Examples:"), "{name}");
        assert!(out(&help).contains(&format!("  peenpose {name}")), "{name}");
    }
}

#[test]
fn no_color_is_respected_by_help_and_faults() {
    for arguments in [
        &["--help"][..],
        &["sovle"],
        &["check", "tests/bad/several.yaml"],
    ] {
        let plain = peenpose(arguments)
            .env("NO_COLOR", "1")
            .env("CLICOLOR_FORCE", "1")
            .output()
            .unwrap();
        let all = [plain.stdout, plain.stderr].concat();
        assert!(!all.is_empty() && !all.contains(&0x1b), "{arguments:?}");
    }
    // The same with colours asked for, so that the test above can fail.
    let coloured = peenpose(&["--help"])
        .env("CLICOLOR_FORCE", "1")
        .output()
        .unwrap();
    assert!(coloured.stdout.contains(&0x1b));
}

#[test]
fn warnings_go_to_stderr_and_change_no_status() {
    let warned = run(&["check", DOUBTFUL]);
    assert_eq!(warned.status.code(), Some(0));
    assert!(messages(&warned).starts_with("warning: jet.exit_diameter"));
    assert!(out(&warned).contains("exit_too_small.yaml: ok"));
    let denied = run(&["check", "--deny-warnings", DOUBTFUL, KEYWAY]);
    assert_eq!(denied.status.code(), Some(2));
    assert!(messages(&denied).starts_with("warning: jet.exit_diameter"));
    assert!(!out(&denied).contains("exit_too_small") && out(&denied).contains("keyway.yaml: ok"));
    let evaluate = [&["evaluate", DOUBTFUL][..], &GOOD[..8]].concat();
    let evaluated = run(&evaluate);
    assert!(messages(&evaluated).contains("warning: jet.exit_diameter"));
    let quiet = run(&[&evaluate[..], &["--quiet"]].concat());
    assert_eq!(messages(&quiet), "");
    assert_eq!(quiet.status.code(), evaluated.status.code());
}

#[test]
fn a_closed_pipe_is_quiet_for_every_command() {
    let folder = TempDir::new().unwrap();
    let maps = folder.path().to_str().unwrap();
    let set = ["--set", "contact=mu_006", "--set", "contact=mu_006"];
    let map = [
        &["map"],
        &MAP_OF_PLATE[..],
        &["--steps", "3", "--out", maps],
    ]
    .concat();
    let commands: [&[&str]; 9] = [
        &["--help"],
        &["--version"],
        &["completions", "bash"],
        &["man"],
        &["check", KEYWAY],
        &["impact", "--table", "zohdi1"],
        &["solve", "problems/plate.yaml"],
        &["evaluate", "problems/plate.yaml", set[0], set[1]],
        &map,
    ];
    for arguments in commands {
        let mut child = peenpose(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(messages(&output), "", "{arguments:?}");
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
    }
}

#[cfg(unix)]
#[test]
fn ctrl_c_and_a_request_to_end_give_the_best_answer_so_far() {
    // `timeout` sends its signal to the program and at once to its group.
    for signals in [&["-INT"][..], &["-TERM", "-TERM"]] {
        ends_with_the_best_answer(signals);
    }
}

#[cfg(unix)]
fn ends_with_the_best_answer(signals: &[&str]) {
    // So accurate that it takes minutes.
    let mut child = peenpose(&[
        "solve",
        "problems/keyway-blind.yaml",
        "--accuracy",
        "0.0001 %",
        "--json",
    ])
    .stdout(Stdio::piped())
    .stderr(Stdio::piped())
    .spawn()
    .unwrap();
    let stdout = child.stdout.take().unwrap();
    let text = std::thread::spawn(move || {
        let mut text = String::new();
        BufReader::new(stdout).read_to_string(&mut text).unwrap();
        text
    });
    std::thread::sleep(std::time::Duration::from_secs(3));
    for signal in signals {
        let sent = Command::new("kill")
            .args([*signal, &child.id().to_string()])
            .status()
            .unwrap();
        assert!(sent.success());
    }
    let output = child.wait_with_output().unwrap();
    assert_eq!(
        messages(&output),
        "note: stopped: this is the best answer so far\n"
    );
    assert!(matches!(output.status.code(), Some(0 | 1)));
    let record: Value = serde_json::from_str(&text.join().unwrap()).unwrap();
    assert_eq!(record["status"], "interrupted");
    assert!(record["best"]["settings"]["speed_m_s"].as_f64().unwrap() > 0.0);
}

/// Whenever the signal comes: either nothing is written yet, or the folder is complete.
#[cfg(unix)]
#[test]
fn an_answer_once_found_is_written_whoever_asks_for_an_end() {
    let solve = |folder: &Path| {
        let arguments = ["solve", "problems/plate.yaml", "--out"];
        let mut command = peenpose(&arguments);
        command.arg(folder).stdout(Stdio::null());
        command.stderr(Stdio::piped()).spawn().unwrap()
    };
    let files = |folder: &Path| {
        let entries = std::fs::read_dir(folder).unwrap();
        let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        names
    };
    let undisturbed = TempDir::new().unwrap();
    let started = std::time::Instant::now();
    let status = solve(undisturbed.path()).wait().unwrap().code();
    let whole = started.elapsed();
    let all = files(undisturbed.path());
    assert!(all.contains(&"result.json".into()), "{all:?}");

    let mut completed = 0;
    for step in 1..20 {
        let folder = TempDir::new().unwrap();
        let child = solve(folder.path());
        std::thread::sleep(whole * step / 20);
        // Fails where the program has ended by itself.
        let _ = Command::new("kill")
            .args(["-INT", &child.id().to_string()])
            .stderr(Stdio::null())
            .status()
            .unwrap();
        let output = child.wait_with_output().unwrap();
        let written = files(folder.path());
        match output.status.code() {
            // Before the search begins there is nothing to lose.
            None => assert!(written.is_empty(), "{step}: {written:?}"),
            code => {
                assert_eq!(code, status, "{step}: {}", messages(&output));
                assert_eq!(written, all, "{step}");
                completed += 1;
            }
        }
    }
    assert!(completed > 0);
}

/// A map of the plate; what it says, or why not.
fn map(arguments: &[&str], folder: &Path) -> Output {
    let out = ["--out", folder.to_str().unwrap()];
    run(&[&["map"][..], arguments, &out].concat())
}

#[test]
fn a_map_is_written_as_picture_and_table() {
    let folder = TempDir::new().unwrap();
    let plate = [&MAP_OF_PLATE[..], &["--steps", "11"]].concat();
    let told = map(&plate, folder.path());
    assert_eq!(told.status.code(), Some(0), "{}", messages(&told));
    assert!(out(&told).contains("J over incidence and speed"));
    assert!(out(&told).contains("11 x 11 settings, 1 shot at each"));
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    let svg = String::from_utf8(read("map-incidence-speed.svg")).unwrap();
    for text in ["incidence, deg", "speed, m/s", "every verdict passes"] {
        assert!(svg.contains(text), "{text}");
    }
    assert!(read("map-incidence-speed.png").starts_with(b"\x89PNG"));
    let csv = read("map-incidence-speed.csv");
    let lines: Vec<String> = csv.lines().map(Result::unwrap).collect();
    assert_eq!(lines.len(), 122);
    assert!(lines[0].starts_with("incidence_deg,speed_m_s,total,normal_impulse"));
    // At what is asked for nothing is left of J: 60 deg and 10 m/s.
    let there = lines
        .iter()
        .find(|line| line.starts_with("60,10,"))
        .unwrap();
    let total: f64 = there.split(',').nth(2).unwrap().parse().unwrap();
    assert!(total < 1e-9 && there.ends_with(",true,"), "{there}");

    let with = |more: &[&str]| map(&[&plate[..], more].concat(), folder.path());
    let miss = with(&["--term", "miss"]);
    assert_eq!(miss.status.code(), Some(0));
    assert!(out(&miss).contains("miss 0 wherever the nozzle fits"));
    assert!(folder.path().join("map-incidence-speed-miss.svg").exists());
    assert_eq!(with(&["--term", "mis"]).status.code(), Some(2));
}

#[test]
fn a_map_does_not_depend_on_the_threads() {
    let [one, two] = ["1", "2"].map(|threads| {
        let folder = TempDir::new().unwrap();
        let told = map(
            &[
                KEYWAY,
                "--x",
                "incidence",
                "--y",
                "speed=8m/s:11m/s",
                "--steps",
                "15",
                "--shots",
                "300",
                "--quiet",
                "--threads",
                threads,
            ],
            folder.path(),
        );
        assert_eq!((told.status.code(), messages(&told)), (Some(0), ""));
        let read = |ending| {
            std::fs::read(folder.path().join(format!("map-incidence-speed.{ending}"))).unwrap()
        };
        (read("csv"), read("svg"))
    });
    assert!(one == two);
}

#[test]
fn maps_that_make_no_sense_are_refused() {
    let folder = TempDir::new().unwrap();
    let refused = |arguments: &[&str], words: &[&str]| {
        let told = map(&[&[KEYWAY][..], arguments].concat(), folder.path());
        assert_eq!(told.status.code(), Some(2), "{arguments:?}");
        assert_eq!(out(&told), "");
        for word in words {
            assert!(
                messages(&told).contains(word),
                "{word}: {}",
                messages(&told)
            );
        }
    };
    let y = ["--y", "azimuth"];
    let x = |x: &'static str| ["--x", x, y[0], y[1]];
    refused(
        &x("incidnce"),
        &["--x incidnce", "did you mean `incidence`?"],
    );
    refused(&x("contact"), &["no setting `contact`"]);
    refused(&x("azimuth"), &["both axes are the same setting"]);
    refused(
        &x("aim_along"),
        &["holds it at one value", "aim_along=-2mm:2mm"],
    );
    refused(&x("incidence=40deg"), &["expected NAME=FROM:TO"]);
    refused(&x("incidence=40:80"), &["has no unit"]);
    refused(&x("incidence=80deg:40deg"), &["is not below"]);
    refused(
        &x("incidence=40deg:100deg"),
        &["is too large", "from 0 deg to 90 deg"],
    );
    let contact = |name: &'static str| ["--x", "incidence", "--y", "azimuth", "--contact", name];
    refused(
        &contact("oild"),
        &["no contact `oild`", "did you mean `oiled`?"],
    );
    refused(
        &[
            "--x",
            "mu_s=0.1:0.2",
            "--y",
            "azimuth",
            "--set",
            "standoff=8mm",
            "--set",
            "speed=9m/s",
            "--contact",
            "dry",
            "--set",
            "incidence=60deg",
        ],
        &["friction of contact `dry` is fixed"],
    );
    refused(
        &[
            "--x",
            "incidence",
            "--y",
            "azimuth",
            "--set",
            "standoff=8mm",
        ],
        &["leaves speed, contact open"],
    );
}
