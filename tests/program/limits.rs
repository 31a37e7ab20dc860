//! `docs/limits.md` says what the code does.

use std::fs;
use std::path::Path;
use std::process::Command;

use peenpose::chart::BesidePoint;
use peenpose::problem::size;
use peenpose::scene::mesh_file;
use peenpose::{chart, checkpoint, problem, record};
use tempfile::TempDir;

/// A row of the table: what is limited, by how much, and what is said beyond.
struct Row {
    what: String,
    limit: String,
    said: String,
}

fn rows() -> Vec<Row> {
    let text = include_str!("../../docs/limits.md");
    let start = text.find("|---|---|---|").expect("a table");
    let lines = text[start..].lines().skip(1);
    let rows = lines.take_while(|line| line.starts_with('|')).map(|line| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let [what, limit, said] = cells[..] else {
            panic!("{line}");
        };
        Row {
            what: what.to_owned(),
            limit: limit.to_owned(),
            said: said.to_owned(),
        }
    });
    rows.collect()
}

fn row(what: &str) -> Row {
    let mut rows = rows().into_iter().filter(|row| row.what.starts_with(what));
    let row = rows.next().unwrap_or_else(|| panic!("no row on {what}"));
    assert!(rows.next().is_none(), "two rows on {what}");
    row
}

/// The faults of a problem file as text.
fn faults(text: &str) -> String {
    match problem::read_text(text, Path::new("any.yaml")) {
        Ok(reading) => problem::render(&reading.source, &reading.faults, false),
        Err(fault) => fault.to_string(),
    }
}

/// Holds a row against the constant of the code, a text that exceeds it, and one that does not.
fn is_true(what: &str, limit: impl ToString, text: impl Fn(usize) -> String) {
    let row = row(what);
    assert_eq!(row.limit, limit.to_string(), "{what}");
    let most: usize = row.limit.parse().expect("a number");
    let (within, beyond) = (faults(&text(most)), faults(&text(most + 1)));
    assert!(beyond.contains(&row.said), "{what}: {beyond:.500}");
    // Nor is the same said of the largest number that is allowed.
    let of_most = row.said.replace(&(most + 1).to_string(), &row.limit);
    for said in [&row.said, &of_most] {
        assert!(!within.contains(said), "{what}: {within:.500}");
    }
}

#[test]
fn problem_files() {
    let file = row("problem file");
    assert_eq!(file.limit, format!("{} MB", size::LARGEST_FILE / 1_000_000));
    let text = "#".repeat(size::LARGEST_FILE as usize);
    assert!(!faults(&text).contains(&file.said));
    assert!(faults(&(text + "#")).contains(&file.said));

    is_true("lists and groups", size::MOST_LEVELS, |levels| {
        format!("{}{}", "[".repeat(levels), "]".repeat(levels))
    });
    is_true("aliases", size::MOST_ALIASES, |aliases| {
        let anchors: String = (0..101).map(|name| format!("&a{name} 0, ")).collect();
        let aliases: String = (0..aliases)
            .map(|index| format!("*a{}, ", index % 101))
            .collect();
        format!("a: [{anchors}]\nb: [{aliases}]\n")
    });
    is_true("items of a list", size::MOST_ITEMS, |items| {
        format!(
            "format: 1\ntarget: {}\n",
            list(items, "0").trim_end_matches(',')
        )
    });
    is_true("keys of a group", size::MOST_ITEMS, |keys| {
        let keys: String = (0..keys).map(|key| format!("  k{key}: 1\n")).collect();
        format!("format: 1\ncontacts:\n{keys}")
    });
    is_true("characters of a key", size::LONGEST_KEY, |length| {
        format!("scene: {{ {}: 1 }}\n", "ü".repeat(length))
    });
    is_true("characters of a text", size::LONGEST_TEXT, |length| {
        format!("title: {}\n", "ü".repeat(length))
    });
    is_true("impacts of a shot", 1000, |impacts| {
        format!("paths: {{ impacts: {impacts} }}\n")
    });
}

fn list(count: usize, item: &str) -> String {
    format!("[{}],", vec![item; count].join(", "))
}

#[test]
fn a_fault_of_size_says_where_it_is() {
    let text = format!(
        "format: 1\nscene:\n  hub:\n    mesh: {}\n",
        "m".repeat(2000)
    );
    let reading = problem::read_text(&text, Path::new("any.yaml")).expect("short enough");
    let [fault] = &reading.faults[..] else {
        panic!("{:?}", reading.faults);
    };
    assert_eq!(
        problem::one_line(&reading.source, fault),
        "any.yaml:4:11: scene.hub.mesh: is 2000 characters long; expected at most 1000 characters"
    );
    let text = format!("format: 1\nscene:\n  {}: 1\n", "m".repeat(1000));
    let reading = problem::read_text(&text, Path::new("any.yaml")).expect("short enough");
    assert_eq!(
        problem::one_line(&reading.source, &reading.faults[0]),
        "any.yaml:3:3: scene: has a key of 1000 characters; expected at most 100 characters"
    );
}

#[test]
fn hostile_names_take_no_memory() {
    // Each key of the second level would be kept with its whole path: 20 GB.
    let keys: String = (0..100_000).map(|key| format!("{key}: ,")).collect();
    let text = format!("{{ ? {} : {{ {keys} }} }}", "a".repeat(200_000));
    assert!(faults(&text).contains("has a key of 200000 characters"));
}

fn obj(folder: &TempDir, text: &str) -> Result<(), String> {
    let path = folder.path().join("any.obj");
    fs::write(&path, text).expect("there is room");
    let read = mesh_file::read(&path, 1.0, &[]);
    read.map(drop).map_err(|fault| fault.to_string())
}

#[test]
fn mesh_files() {
    let folder = TempDir::new().expect("there is room");
    let megabytes = format!("{} MB", mesh_file::LARGEST_FILE / 1_000_000);
    assert_eq!(row("mesh file").limit, megabytes);
    let path = folder.path().join("huge.stl");
    let file = fs::File::create(&path).expect("there is room");
    file.set_len(mesh_file::LARGEST_FILE + 1)
        .expect("it is sparse");
    let fault = mesh_file::read(&path, 1.0, &[])
        .expect_err("too large")
        .to_string();
    assert!(fault.contains(&row("mesh file").said), "{fault}");

    let triangles = row("triangles of a mesh");
    assert_eq!(triangles.limit, mesh_file::MOST_TRIANGLES.to_string());
    assert!(
        mesh_file::Defect::TooManyTriangles
            .to_string()
            .contains(&triangles.said)
    );

    let winding = row("looks at a corner").said;
    assert!(
        mesh_file::Defect::FacesTooWinding
            .to_string()
            .contains(&winding)
    );

    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let face = |corners: usize| {
        let corners: String = (0..corners)
            .map(|corner| format!(" {}", corner % 3 + 1))
            .collect();
        format!("{points}f{corners}\n")
    };
    is_refused(&folder, "corners of a face", mesh_file::MOST_CORNERS, face);
    is_refused(
        &folder,
        "named groups",
        mesh_file::MOST_SURFACES,
        |groups| {
            let groups: String = (0..groups)
                .map(|group| {
                    let (row, column) = (group / 100, group % 100);
                    format!("v {row} {column} 1\ng g{group}\nf 1 2 -1\n")
                })
                .collect();
            format!("{points}{groups}")
        },
    );
    is_refused(
        &folder,
        "characters of the name",
        mesh_file::LONGEST_NAME,
        |length| format!("{points}g {}\nf 1 2 3\n", "ü".repeat(length)),
    );
    let line = row("bytes of a line").limit.parse().expect("a number");
    is_refused(&folder, "bytes of a line", line, |length| {
        // The end of the line counts.
        format!("{points}f 1 2 3\n#{}\n", "-".repeat(length - 2))
    });
    let distance = row("distance of a mesh");
    assert_eq!(
        distance.limit,
        format!("{} km", mesh_file::LARGEST_COORDINATE / 1000.0)
    );
    let fault = obj(&folder, "v 0 0 1.0001e6\n").expect_err("too far");
    assert!(fault.contains(&distance.said), "{fault}");
}

fn is_refused(folder: &TempDir, what: &str, limit: usize, text: impl Fn(usize) -> String) {
    let row = row(what);
    assert_eq!(row.limit, limit.to_string(), "{what}");
    let within = obj(folder, &text(limit)).err().unwrap_or_default();
    assert!(!within.contains(&row.said), "{what}: {within}");
    let fault = obj(folder, &text(limit + 1)).expect_err("beyond the limit");
    assert!(fault.contains(&row.said), "{what}: {fault}");
}

#[test]
fn names_of_groups_do_not_move_the_cursor() {
    let folder = TempDir::new().expect("there is room");
    let path = folder.path().join("any.obj");
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ng \u{1b}[31m\nf 1 2 3\ng b\nf 1 2 4\n";
    fs::write(&path, text).expect("there is room");
    let (mesh, _) = mesh_file::read(&path, 1.0, &[]).expect("two triangles");
    assert_eq!(mesh.surfaces, ["\u{fffd}[31m", "b"]);
}

#[test]
fn results_and_tables() {
    let megabytes = |bytes: u64| format!("{} MB", bytes / 1_000_000);
    let (result, table) = (row("`result.json`"), row("table for"));
    let kept = row("checkpoint");
    assert_eq!(kept.limit, megabytes(checkpoint::LARGEST_FILE));
    assert_eq!(result.limit, megabytes(record::LARGEST_FILE));
    assert_eq!(table.limit, megabytes(chart::LARGEST_TABLE));
    let folder = TempDir::new().expect("there is room");
    for (name, bytes) in [
        ("result.json", record::LARGEST_FILE),
        ("table.csv", chart::LARGEST_TABLE),
        ("checkpoint.txt", checkpoint::LARGEST_FILE),
    ] {
        let file = fs::File::create(folder.path().join(name)).expect("there is room");
        file.set_len(bytes + 1).expect("it is sparse");
    }
    let problem = Path::new(env!("CARGO_MANIFEST_DIR")).join("problems/plate.yaml");
    let problem = problem.to_string_lossy();
    for (row, arguments) in [
        (&result, vec!["report", "."]),
        (
            &table,
            vec!["chart", &problem, "--out", "c", "--beside", "table.csv"],
        ),
        (&kept, vec!["solve", &problem, "--checkpoint", "."]),
    ] {
        let said = complaint(&folder, &arguments);
        assert!(
            said.contains(&row.said) && said.contains(&row.limit),
            "{said}"
        );
    }
}

#[test]
fn tables_of_other_methods() {
    let refusal = |rows: &str| {
        let table = format!("method,speed,seconds,excess\n{rows}");
        let refused = BesidePoint::read_all(&table).err();
        refused.map(|fault| fault.message).unwrap_or_default()
    };
    let holds = |what: &str, limit: usize, rows: &dyn Fn(usize) -> String| {
        let row = row(what);
        assert_eq!(row.limit, limit.to_string(), "{what}");
        assert_eq!(refusal(&rows(limit)), "", "{what}");
        let said = refusal(&rows(limit + 1));
        assert!(said.contains(&row.said), "{what}: {said}");
    };
    holds("runs in it", chart::MOST_RUNS, &|runs| {
        "grid,1,1,1\n".repeat(runs)
    });
    holds("methods in it", chart::MOST_METHODS, &|methods| {
        (0..methods).map(|it| format!("m{it},1,1,1\n")).collect()
    });
    let what = "characters of a method";
    holds(what, chart::LONGEST_NAME, &|length| {
        format!("{},1,1,1\n", "ü".repeat(length))
    });
    holds(what, chart::LONGEST_NAME, &|length| {
        format!("grid,{},1,1\n", "ü".repeat(length))
    });
}

#[test]
fn options_of_the_program() {
    let folder = TempDir::new().expect("there is room");
    for (what, command) in [
        ("`evaluate --shots`", vec!["evaluate", "x.yaml", "--shots"]),
        (
            "`map --steps`",
            vec![
                "map", "x.yaml", "--x", "speed", "--y", "azimuth", "--out", "m", "--steps",
            ],
        ),
        (
            "`chart --most-shots`",
            vec!["chart", "x.yaml", "--out", "c", "--most-shots"],
        ),
        (
            "`map --shots`",
            vec![
                "map", "x.yaml", "--x", "speed", "--y", "azimuth", "--out", "m", "--shots",
            ],
        ),
    ] {
        let Row { limit, said, .. } = row(what);
        let most: u64 = limit.parse().expect("a number");
        let at = |count: u64| {
            let mut arguments = command.clone();
            let count = count.to_string();
            arguments.push(&count);
            complaint(&folder, &arguments)
        };
        assert!(at(most + 1).contains(&said), "{what}: {}", at(most + 1));
        assert!(!at(most).contains(&said), "{what}: {}", at(most));
    }
}

/// What the program says on its standard error.
fn complaint(folder: &TempDir, arguments: &[&str]) -> String {
    let program = env!("CARGO_BIN_EXE_peenpose");
    let run = Command::new(program)
        .args(arguments)
        .current_dir(folder)
        .output();
    let output = run.expect("it can be started");
    assert_eq!(output.status.code(), Some(2));
    String::from_utf8_lossy(&output.stderr).into_owned()
}
