//! What parses but can hardly be meant: said where it stands, and never about what is shipped.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use crate::common::announced;
use peenpose::problem::render_warnings;
use peenpose::problem::warning::WarningCode;
use peenpose::scenario::Scenario;
use peenpose::warnings;

fn files(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    let is_problem = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "yaml");
    paths.filter(is_problem).collect()
}

#[test]
fn doubtful_files_get_the_warnings_that_their_comments_announce() {
    let files = files("tests/doubtful");
    assert!(files.len() >= 20);
    for path in files {
        let (scenario, source) = Scenario::load(&path).unwrap();
        let found: Vec<_> = warnings::of(&scenario, &source)
            .into_iter()
            .map(|warning| {
                let at = warning.at.unwrap();
                (at.line, at.column, warning.to_string())
            })
            .collect();
        let text = fs::read_to_string(&path).unwrap();
        assert_eq!(found, announced(&text), "{}", path.display());
        assert!(!found.is_empty(), "{}", path.display());
    }
}

#[test]
fn every_doubt_is_raised_by_a_doubtful_file() {
    let mut raised = BTreeSet::new();
    for path in files("tests/doubtful") {
        let (scenario, source) = Scenario::load(&path).unwrap();
        let found = warnings::of(&scenario, &source);
        raised.extend(found.into_iter().map(|warning| warning.doubt));
    }
    let doubts: BTreeSet<WarningCode> = WarningCode::ALL.iter().copied().collect();
    let unraised: Vec<&WarningCode> = doubts.difference(&raised).collect();
    assert!(unraised.is_empty(), "no doubtful file raises {unraised:?}");
}

#[test]
fn nothing_that_is_shipped_is_doubtful() {
    for path in files("problems") {
        let (scenario, source) = Scenario::load(&path).unwrap();
        assert_eq!(warnings::of(&scenario, &source), [], "{}", path.display());
    }
}

#[test]
fn a_warning_shows_its_line() {
    let path = Path::new("tests/doubtful/exit_too_small.yaml");
    let (scenario, source) = Scenario::load(path).unwrap();
    let found = warnings::of(&scenario, &source);
    let text = render_warnings(&source, &found, false);
    for part in [
        "warning: jet.exit_diameter: the shot, 1 mm wide, does not fit through",
        "exit_too_small.yaml:10:23",
        "                       ^^^^^^^",
        "= help: give the diameter",
    ] {
        assert!(text.contains(part), "{text}");
    }
    assert!(!text.contains("\u{1b}"));
    assert!(render_warnings(&source, &found, true).contains("\u{1b}"));
}

/// Sound problems that differ from the doubtful ones by little.
#[test]
fn what_is_only_unusual_passes() {
    let text = fs::read_to_string("problems/keyway.yaml").unwrap();
    let unusual = [
        ("weight: 2", "weight: 0"),
        ("standoff: [6 mm, 20 mm]", "standoff: [6 mm, 300 mm]"),
        ("exit_diameter: 1.5 mm", "exit_diameter: 0 mm"),
        ("limit: 8 uN.s", "limit: 13 uN.s"),
        ("allow: 10 uN.s", "allow: 45 uN.s"),
        ("speed: [5 m/s, 40 m/s]", "speed: [5 m/s, 9 m/s]"),
    ];
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("unusual.yaml");
    for (usual, instead) in unusual {
        assert!(text.contains(usual));
        fs::write(&path, text.replace(usual, instead)).unwrap();
        let (scenario, source) = Scenario::load(&path).unwrap();
        assert_eq!(warnings::of(&scenario, &source), [], "{instead}");
    }
}
