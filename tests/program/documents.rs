//! Every command in the README and in `docs/` is run, and the outputs of the tutorial are compared.
//!
//! A document is read from top to bottom in a folder of its own: a block of YAML that starts with
//! `# name.yaml` is written to that file, a block of shell is run, and every line of a block of text
//! behind it must be in what the commands printed. Pictures that the commands draw must be those of
//! the repository.
#![cfg(unix)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Commands that take minutes, each with where it is run instead.
const LONG: [(&str, &str); 7] = [
    ("peenpose chart", "tests/reports/chart.rs"),
    ("cargo test", "it is what runs this"),
    ("cargo install", "builds the whole program again"),
    ("rustup", "installs another compiler"),
    (
        "cargo +nightly fuzz",
        "tests/problems/fuzzed.rs replays what it found",
    ),
    ("cargo doc", ".ci/run"),
    ("cargo bench", "benches/ are checked by .ci/run"),
];

/// A fenced block of a document.
struct Block {
    language: String,
    text: String,
}

fn blocks(document: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut open: Option<Block> = None;
    for line in document.lines() {
        match (line.strip_prefix("```"), &mut open) {
            (Some(language), None) => {
                let language = language.to_owned();
                let text = String::new();
                open = Some(Block { language, text });
            }
            (Some(_), Some(_)) => blocks.extend(open.take()),
            (None, Some(block)) => {
                block.text += line;
                block.text += "\n";
            }
            (None, None) => {}
        }
    }
    assert!(open.is_none(), "a block is never closed");
    blocks
}

/// The commands of a block of shell, without comments.
fn commands(block: &str) -> Vec<String> {
    let joined = block.replace("\\\n", " ");
    let lines = joined.lines().map(|line| match line.split_once(" #") {
        Some((command, _)) => command.trim(),
        None => line.trim(),
    });
    lines
        .filter(|line| !line.is_empty() && !line.starts_with('#'))
        .map(str::to_owned)
        .collect()
}

/// The command with the programs that the test was built with.
fn with_built_programs(command: &str) -> String {
    let program = PathBuf::from(env!("CARGO_BIN_EXE_peenpose"));
    let program_shown = program.display();
    if let Some(arguments) = command.strip_prefix("peenpose ") {
        return format!("'{program_shown}' {arguments}");
    }
    let Some(run) = command.strip_prefix("cargo run --release ") else {
        panic!("do not know how to run `{command}`");
    };
    match run.strip_prefix("--example ") {
        None => format!("'{program_shown}' {}", run.trim_start_matches("-- ")),
        Some(rest) => {
            let (name, arguments) = rest.split_once(' ').unwrap_or((rest, ""));
            let example = program.with_file_name("examples").join(name);
            assert!(
                example.is_file(),
                "no example `{name}`: cargo build --examples makes them"
            );
            let arguments = arguments.trim_start_matches("-- ");
            format!("'{}' {arguments}", example.display())
        }
    }
}

fn is_long(command: &str) -> bool {
    let run_here = command.replace("cargo run --release -- ", "peenpose ");
    LONG.iter().any(|(start, _)| run_here.starts_with(start))
}

/// Runs a command; 0 and 1 are answers, anything else is a failure.
fn run(folder: &Path, command: &str) -> Output {
    let output = Command::new("sh")
        .args(["-c", &with_built_programs(command)])
        .current_dir(folder)
        .env("HOME", folder)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    let status = output.status.code();
    assert!(
        matches!(status, Some(0 | 1)),
        "{command}: {status:?} {said}"
    );
    assert!(!said.contains("error:"), "{command}: {said}");
    output
}

/// A folder with what a clone has, as far as commands use it.
fn clone_of_repository() -> tempfile::TempDir {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("docs")).unwrap();
    fs::create_dir(folder.path().join("problems")).unwrap();
    for entry in fs::read_dir(root.join("problems")).unwrap() {
        let entry = entry.unwrap();
        let copy = folder.path().join("problems").join(entry.file_name());
        fs::copy(entry.path(), copy).unwrap();
    }
    folder
}

/// Runs a document; returns how many commands it ran and how many lines it compared.
fn follow(document: &str) -> (usize, usize) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(root.join(document)).unwrap();
    let folder = clone_of_repository();
    let (mut ran, mut compared, mut printed) = (0, 0, None);
    for block in blocks(&text) {
        match block.language.as_str() {
            "yaml" => {
                let first = block.text.lines().next().unwrap_or_default();
                if let Some(name) = first.strip_prefix("# ").filter(|n| n.ends_with(".yaml")) {
                    fs::write(folder.path().join(name), &block.text).unwrap();
                }
            }
            "sh" => {
                let mut all = String::new();
                for command in commands(&block.text).iter().filter(|c| !is_long(c)) {
                    all += &String::from_utf8(run(folder.path(), command).stdout).unwrap();
                    ran += 1;
                }
                printed = Some(all);
            }
            "text" if document.starts_with("docs/tutorial") => {
                let Some(printed) = &printed else { continue };
                for line in block.text.lines() {
                    assert!(printed.contains(line), "{document}: not printed: {line}");
                    compared += 1;
                }
            }
            _ => {}
        }
    }
    for drawn in ["docs", "maps"] {
        compare_pictures(document, &folder.path().join(drawn));
    }
    (ran, compared)
}

fn compare_pictures(document: &str, drawn: &Path) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for entry in fs::read_dir(drawn).into_iter().flatten() {
        let entry = entry.unwrap();
        if entry
            .path()
            .extension()
            .is_some_and(|ending| ending == "svg")
        {
            let (now, then) = (
                fs::read(entry.path()).unwrap(),
                fs::read(root.join("docs").join(entry.file_name())).unwrap(),
            );
            assert!(
                now == then,
                "{document}: {:?} is out of date",
                entry.file_name()
            );
        }
    }
}

#[test]
fn tutorial() {
    let (ran, compared) = follow("docs/tutorial.md");
    assert!(ran >= 6 && compared >= 15, "{ran} {compared}");
}

#[test]
fn readme() {
    let (ran, _) = follow("README.md");
    assert!(ran >= 4, "{ran}");
}

/// Beside a picture that is made again, the words are easily forgotten.
#[test]
fn the_readme_names_the_angles_of_its_pictures() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |file: &str| fs::read_to_string(root.join(file)).unwrap();
    let angle = |picture: &str| -> f64 {
        let svg = read(picture);
        let (_, rest) = svg.split_once(">incidence ").unwrap();
        rest.split_once('\u{b0}').unwrap().0.parse().unwrap()
    };
    let (best, steep) = (angle("docs/keyway.svg"), angle("docs/keyway-steep.svg"));
    let readme = read("README.md");
    for said in [
        format!("the same nozzle {:.0}\u{b0} steeper", steep - best),
        format!("floor at {best:.0} degrees"),
        format!("At {steep:.0} degrees"),
        format!("At {best:.0}\u{b0} every rebound"),
        format!("At {steep:.0}\u{b0} half of the shots"),
    ] {
        assert!(readme.contains(&said), "{said}");
    }
}

/// Rows that are measured again leave sums behind.
#[test]
fn sums_over_the_suite_are_those_of_its_table() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |file: &str| fs::read_to_string(root.join(file)).unwrap();
    let (readme, benchmarks) = (read("README.md"), read("docs/benchmarks.md"));
    let table = benchmarks.split("suite -->").nth(1).unwrap();
    let rows = table.lines().filter(|row| row.starts_with("| ")).skip(1);
    let numbers = |cell: &str| -> Vec<u32> {
        let words = cell.split([' ', ',']);
        words.filter_map(|word| word.parse().ok()).collect()
    };
    // Of each row as good and of how many; said to be converged and truly; errors that hold and of how many.
    let mut sums = [0; 6];
    for row in rows {
        let cells: Vec<Vec<u32>> = row.split('|').map(numbers).collect();
        let found = cells[3..6].concat();
        assert_eq!(found.len(), sums.len(), "{row}");
        for (sum, number) in sums.iter_mut().zip(found) {
            *sum += number;
        }
    }
    let [good, all, converged, truly, holds, _] = sums;
    for said in [
        format!("{good} of {all} answers as good as the best known"),
        format!("where it said `converged`, {truly} of {converged}"),
    ] {
        assert!(readme.contains(&said), "{said}");
    }
    let said = format!("of {all} answers it does in {holds}.");
    assert!(benchmarks.contains(&said), "{said}");
}

#[test]
fn other_documents() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut ran = 0;
    for entry in fs::read_dir(root.join("docs")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        if name.ends_with(".md") && name != "tutorial.md" {
            ran += follow(&format!("docs/{name}")).0;
        }
    }
    assert!(ran >= 20, "{ran}");
}

/// Addresses in the links and pictures of a document.
fn links(document: &str) -> Vec<String> {
    let targets = document.split("](").skip(1);
    let target = |rest: &str| rest.split_once(')').map(|(link, _)| link.to_owned());
    targets.filter_map(target).collect()
}

/// The anchors that headings have.
fn anchors(document: &str) -> Vec<String> {
    let headings = document.lines().filter(|line| line.starts_with('#'));
    let anchor = |heading: &str| {
        let text = heading.trim_start_matches('#').trim().to_lowercase();
        let kept = text
            .chars()
            .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
        kept.map(|c| if c == ' ' { '-' } else { c }).collect()
    };
    headings.map(anchor).collect()
}

#[test]
fn links_lead_somewhere() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut documents = vec![
        root.join("README.md"),
        root.join("CONTRIBUTING.md"),
        root.join("CHANGELOG.md"),
        root.join("benches/peers/README.md"),
    ];
    for entry in fs::read_dir(root.join("docs")).unwrap() {
        documents.push(entry.unwrap().path());
    }
    documents.retain(|path| path.extension().is_some_and(|ending| ending == "md"));
    let mut chapters = 0;
    for path in &documents {
        let text = fs::read_to_string(path).unwrap();
        for link in links(&text) {
            if link.contains("://") {
                continue;
            }
            let (file, anchor) = link.split_once('#').unwrap_or((&link, ""));
            let target = match file {
                "" => path.clone(),
                file => path.parent().unwrap().join(file),
            };
            assert!(target.exists(), "{}: {link}", path.display());
            if !anchor.is_empty() {
                let there = fs::read_to_string(&target).unwrap();
                let has_it = anchors(&there).iter().any(|it| it == anchor);
                assert!(has_it, "{}: {link}", path.display());
            }
        }
        if path.ends_with("docs/SUMMARY.md") {
            chapters = links(&text).len();
        }
    }
    // The book has every chapter: all documents but those beside it, and its own table of contents.
    assert_eq!(chapters + 5, documents.len());
}
