//! From nothing to a first sheet: `init`, `media` and `schema` from outside.

use std::fs;
use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use peenpose::control::Control;
use peenpose::problem;
use peenpose::problem::media;
use peenpose::report::brief;
use peenpose::study::{Extras, Study};
use serde_json::Value;
use tempfile::TempDir;

fn peenpose(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_peenpose"))
        .args(arguments)
        .current_dir(folder)
        .timeout(std::time::Duration::from_secs(300))
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

#[test]
fn three_commands_lead_to_a_sheet_that_passes() {
    for kind in ["keyway", "mesh", "plate"] {
        let folder = TempDir::new().unwrap();
        let run = |arguments: &[&str]| {
            let output = peenpose(folder.path(), arguments);
            let messages = text(&output.stderr).to_owned();
            assert_eq!(
                output.status.code(),
                Some(0),
                "{kind} {arguments:?}: {messages}"
            );
            text(&output.stdout).to_owned()
        };
        assert_eq!(run(&["init", kind, "--out", "part.yaml"]), "");
        assert!(run(&["check", "part.yaml"]).starts_with("part.yaml: ok"));
        let sheet = run(&["solve", "part.yaml", "--quiet", "--accuracy", "5 %"]);
        assert!(
            sheet.contains("shot       S170, 0.4318 mm diameter, 7800 kg/m3"),
            "{sheet}"
        );
        assert!(
            sheet.contains("library    diameter, density of S170;"),
            "{sheet}"
        );
        // The library measured no fall with speed: it is taken from theory, and the sheet says so.
        assert!(
            sheet.contains("assumed    exponent of restitution"),
            "{sheet}"
        );
        let schema = fs::read_to_string(folder.path().join("peenpose.schema.json")).unwrap();
        assert!(schema == format!("{:#}\n", problem::schema()));
    }
}

#[test]
fn without_a_file_it_goes_to_stdout_and_nothing_is_asked() {
    let folder = TempDir::new().unwrap();
    let bare = peenpose(folder.path(), &["init"]);
    assert!(bare.status.success() && bare.stderr.is_empty());
    assert_eq!(
        bare.stdout,
        peenpose(folder.path(), &["init", "keyway"]).stdout
    );
    let mesh = peenpose(folder.path(), &["init", "mesh"]);
    assert!(text(&mesh.stderr).contains("sample-slot.obj"));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);

    // The mesh is missing then, and the check says so where it is named.
    fs::write(folder.path().join("m.yaml"), &mesh.stdout).unwrap();
    let check = peenpose(folder.path(), &["check", "m.yaml"]);
    assert_eq!(check.status.code(), Some(2));
    let messages = text(&check.stderr);
    assert!(
        messages.contains("scene.part.mesh") && messages.contains("sample-slot.obj"),
        "{messages}"
    );
}

#[test]
fn files_are_written_over_only_when_that_is_asked_for() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("sub/part.yaml");
    fs::create_dir(folder.path().join("sub")).unwrap();
    let init = |arguments: &[&str]| {
        let all = [&["init", "plate", "--out", "sub/part.yaml"], arguments].concat();
        peenpose(folder.path(), &all)
    };
    assert!(init(&[]).status.success());
    let first = fs::read(&path).unwrap();
    assert!(
        init(&[]).status.success(),
        "the same contents are not in the way"
    );

    fs::write(&path, "mine").unwrap();
    let refused = init(&[]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("part.yaml is there already"));
    assert_eq!(fs::read(&path).unwrap(), b"mine");

    assert!(init(&["--force"]).status.success());
    assert_eq!(fs::read(&path).unwrap(), first);

    // A file beside it that is somebody else's is in the way as well, and nothing is written.
    fs::write(folder.path().join("sub/peenpose.schema.json"), "{}").unwrap();
    fs::remove_file(&path).unwrap();
    assert_eq!(init(&[]).status.code(), Some(2));
    assert!(!path.exists());
}

#[test]
fn the_schema_is_printed_as_the_library_gives_it() {
    let output = peenpose(Path::new("."), &["schema"]);
    let printed: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(printed, problem::schema());
}

#[test]
fn the_library_is_listed_with_every_source() {
    let table = peenpose(Path::new("."), &["media"]);
    let table = text(&table.stdout);
    let json = peenpose(Path::new("."), &["media", "--json"]);
    let json: Value = serde_json::from_slice(&json.stdout).unwrap();
    for line in table.lines() {
        assert!(line.chars().count() <= 92, "{line}");
    }
    for (index, medium) in media::media().iter().enumerate() {
        assert!(table.contains(&format!("\n  {} ", medium.name)));
        let listed = &json["shot"][index];
        assert_eq!(listed["name"], medium.name);
        assert_eq!(listed["diameter_m"]["value"], medium.diameter.value);
        assert_eq!(
            listed["density_kg_m3"]["source"],
            medium.density.source.to_string()
        );
    }
    for (index, contact) in media::contacts().iter().enumerate() {
        assert!(table.contains(&format!("\n  {} ", contact.name)));
        let listed = &json["contacts"][index];
        assert_eq!(
            listed["mu_d"]["assumed"],
            contact.dynamic_friction.source.is_assumed()
        );
    }
    let unwrapped = table.split_whitespace().collect::<Vec<_>>().join(" ");
    let numbers = media::media()
        .iter()
        .flat_map(|medium| [medium.diameter, medium.density]);
    for number in numbers {
        assert!(
            unwrapped.contains(&number.source.to_string()),
            "{}",
            number.source
        );
    }
}

/// A document of the repository with a text that the program prints.
struct Shown {
    document: &'static str,
    start: &'static str,
    end: &'static str,
}

const BRIEF: Shown = Shown {
    document: "README.md",
    start: "<!-- brief -->\n```text\n",
    end: "```\n<!-- /brief -->",
};
const PROBLEM: Shown = Shown {
    document: "README.md",
    start: "<!-- problem -->\n```yaml\n",
    end: "```\n<!-- /problem -->",
};
const SHEET: Shown = Shown {
    document: "docs/sheet.md",
    start: "<!-- sheet -->\n```text\n",
    end: "```\n<!-- /sheet -->",
};

impl Shown {
    /// The document before the text, the text, and what follows.
    fn parts(&self) -> [String; 3] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(self.document);
        let whole = fs::read_to_string(path).unwrap();
        let (before, rest) = whole.split_once(self.start).unwrap();
        let (shown, after) = rest.split_once(self.end).unwrap();
        [before, shown, after].map(str::to_owned)
    }

    /// The text; with `UPDATE_SHEETS=1` it becomes what is printed first.
    fn text(&self, printed: &str) -> String {
        let [before, shown, after] = self.parts();
        if std::env::var_os("UPDATE_SHEETS").is_none() {
            return shown;
        }
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(self.document);
        let whole = [&before, self.start, printed, self.end, &after];
        fs::write(path, whole.concat()).unwrap();
        printed.to_owned()
    }
}

#[test]
fn the_sheet_of_the_readme_is_what_its_problem_gives() {
    let [before, problem, after] = PROBLEM.parts();
    let lines = |text: &str| text.lines().count();
    assert!(lines(&before) + lines(&problem) + lines(&after) <= 150);
    assert!(lines(&problem) <= 16);
    let study = Study::from_text(&problem, Path::new("floor.yaml")).unwrap();
    let record = study.solve(Extras::default(), &Control::default()).unwrap();
    let printed = brief(&record);
    assert_eq!(BRIEF.text(&printed), printed);
}

#[test]
fn the_chapter_on_the_sheet_shows_the_keyway_as_it_is() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let output = peenpose(root, &["solve", "problems/keyway.yaml", "--quiet"]);
    let timeless = |text: &str| {
        let lines = text.lines().map(str::to_owned);
        lines
            .filter(|line| !line.contains("wall time"))
            .collect::<Vec<_>>()
    };
    let printed = text(&output.stdout);
    assert_eq!(timeless(&SHEET.text(printed)), timeless(printed));
}
