//! Campaigns: planned, run in shards, killed, gathered.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

use tempfile::TempDir;

use crate::common::program::{self, Run};

/// A folder with a problem and a campaign file.
struct Folder(TempDir);

impl Folder {
    fn new(campaign: &str) -> Self {
        let folder = TempDir::new().unwrap();
        let problems = Path::new(env!("CARGO_MANIFEST_DIR")).join("problems");
        fs::copy(
            problems.join("plate.yaml"),
            folder.path().join("plate.yaml"),
        )
        .unwrap();
        fs::write(folder.path().join("campaign.yaml"), campaign).unwrap();
        Self(folder)
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn campaign(&self, arguments: &[&str]) -> Run {
        program::peenpose([&["campaign"], arguments].concat(), self.path())
    }

    fn planned(&self, study: &str) -> String {
        let run = self.campaign(&["plan", "campaign.yaml", "--out", study]);
        assert_eq!(run.status, 0, "{}", run.messages);
        run.out
    }

    /// Runs the cases of a study and returns its table.
    fn solved(&self, study: &str) -> String {
        let run = self.campaign(&["run", study]);
        assert!(run.status == 0 || run.status == 2, "{}", run.messages);
        self.table(study)
    }

    fn table(&self, study: &str) -> String {
        assert_eq!(self.campaign(&["gather", study]).status, 0);
        fs::read_to_string(self.path().join(study).join("table.csv")).unwrap()
    }

    fn results(&self, study: &str) -> Vec<PathBuf> {
        let entries = fs::read_dir(self.path().join(study).join("results")).unwrap();
        let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
        paths.sort();
        paths
    }
}

const GRID: &str = "\
campaign: 1
base: plate.yaml
vary:
  contacts.mu_030.restitution: [0.3, 0.4, 1.5]   # the last one is a fault
  goals.normal_impulse.target: { from: 20 uN.s, to: 30 uN.s, step: 5 uN.s }
  surfaces.plate.x_min.allow: [5 uN.s]       # not in the file
";

/// The columns of a table by their names, row by row. No value here has a comma.
fn column(table: &str, name: &str) -> Vec<String> {
    let heading = table.lines().next().unwrap();
    let index = heading.split(',').position(|column| column == name);
    let index = index.unwrap_or_else(|| panic!("{name} is not in {heading}"));
    let cell = |line: &str| line.split(',').nth(index).unwrap().to_owned();
    table.lines().skip(1).map(cell).collect()
}

#[test]
fn a_grid_is_solved_and_gathered() {
    let folder = Folder::new(GRID);
    assert_eq!(folder.planned("study"), "9 cases planned in study\n");
    let status = |study| folder.campaign(&["status", study]).out;
    assert_eq!(status("study"), "0 done, 9 missing, 0 faulty\n");
    let run = folder.campaign(&["run", "study"]);
    assert_eq!(
        (run.status, run.out.as_str()),
        (2, "6 cases solved, 3 faulty, 0 kept, 0 left\n")
    );
    assert_eq!(status("study"), "6 done, 0 missing, 3 faulty\n");
    let table = folder.table("study");
    assert_eq!(
        column(&table, "contacts.mu_030.restitution"),
        [
            "0.3", "0.3", "0.3", "0.4", "0.4", "0.4", "1.5", "1.5", "1.5"
        ]
    );
    let targets = column(&table, "goals.normal_impulse.target");
    assert_eq!(targets[..3], ["20 uN.s", "25 uN.s", "30 uN.s"]);
    // The last contact is added to the file; its N* is (1 + e) m v sin 60, 41.27 uN.s at e = 0.3.
    let statuses = column(&table, "status");
    assert_eq!(statuses[6..], ["2", "2", "2"]);
    assert!(
        statuses[..6].iter().all(|status| status == "1"),
        "{statuses:?}"
    );
    let fault = folder
        .results("study")
        .into_iter()
        .find(|path| path.extension().is_some_and(|it| it == "txt"));
    let fault = fs::read_to_string(fault.unwrap()).unwrap();
    assert!(fault.contains("restitution"), "{fault}");
    // What the table says of a case is what the program says of its problem.
    let alone = program::peenpose(
        [
            "solve",
            "plate.yaml",
            "--json",
            "--quiet",
            "--set",
            "contacts.mu_030.restitution=0.3",
            "--set",
            "goals.normal_impulse.target=20 uN.s",
            "--set",
            "surfaces={ plate.x_min: { allow: 5 uN.s } }",
        ],
        folder.path(),
    );
    let objective = alone.json()["best"]["objective"]["total"].as_f64().unwrap();
    assert_eq!(
        column(&table, "objective")[0].parse::<f64>().unwrap(),
        objective
    );
    assert_eq!(column(&table, "margin.plate.x_min")[0], "0.01");
}

/// Shards in any order, one process and one that was killed again and again give the same bytes.
#[test]
fn the_table_is_the_same_whoever_solves_it() {
    let folder = Folder::new(
        "campaign: 1\nbase: plate.yaml\nvary:\n  settings.speed: { from: 5 m/s, to: 15 m/s }\n  shot.radius: { from: 0.3 mm, to: 0.6 mm }\nsample: { sobol: 40, seed: 3 }\n",
    );
    for study in ["whole", "shards", "killed"] {
        assert_eq!(
            folder.planned(study),
            format!("40 cases planned in {study}\n")
        );
    }
    let table = folder.solved("whole");
    assert_eq!(column(&table, "status").len(), 40);
    for shard in ["3/3", "1/3", "2/3"] {
        let run = folder.campaign(&["run", "shards", "--shard", shard, "--threads", "1"]);
        assert_eq!(run.status, 0, "{}", run.messages);
    }
    assert_eq!(folder.table("shards"), table);
    let mut killed = 0;
    for wait in 0..8 {
        let mut child = Command::new(env!("CARGO_BIN_EXE_peenpose"))
            .args(["campaign", "run", "killed", "--threads", "1"])
            .current_dir(folder.path())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_millis(20 * (wait + 1)));
        // SIGKILL where there is one.
        child.kill().unwrap();
        child.wait().unwrap();
        let table = folder.table("killed");
        killed += usize::from(column(&table, "status").iter().any(String::is_empty));
    }
    assert!(killed > 0);
    assert_eq!(folder.solved("killed"), table);
    // Nothing is solved twice, and nothing half-written counts.
    let run = folder.campaign(&["run", "killed"]);
    assert_eq!(run.out, "0 cases solved, 0 faulty, 40 kept, 0 left\n");
}

/// A case is known by what it holds: planned in another way it has the same name, and changed it has another one.
#[test]
fn names_follow_from_content() {
    let folder = Folder::new(
        "campaign: 1\nbase: plate.yaml\nvary: { settings.speed: [8 m/s, 9 m/s, 8 m/s] }\n",
    );
    assert_eq!(
        folder.planned("list"),
        "2 cases planned in list, 1 left out that repeat others\n"
    );
    let cases =
        |study: &str| fs::read_to_string(folder.path().join(study).join("cases.csv")).unwrap();
    let listed = column(&cases("list"), "id");
    fs::write(
        folder.path().join("cases.csv"),
        "settings.speed , id\n 9 m/s,old\n7 m/s,old\n",
    )
    .unwrap();
    fs::write(
        folder.path().join("campaign.yaml"),
        "campaign: 1\nbase: plate.yaml\ncases: cases.csv\n",
    )
    .unwrap();
    assert_eq!(folder.planned("table"), "2 cases planned in table\n");
    let tabled = column(&cases("table"), "id");
    assert_eq!(
        (tabled[0].as_str(), tabled.contains(&listed[0])),
        (listed[1].as_str(), false)
    );
    assert!(
        listed
            .iter()
            .all(|id| id.len() == 16 && id.bytes().all(|digit| digit.is_ascii_hexdigit()))
    );
    // A problem that was changed since is not taken for the one that was planned.
    let plate = folder.path().join("plate.yaml");
    let text = fs::read_to_string(&plate).unwrap();
    fs::write(&plate, text.replace("radius: 0.5 mm", "radius: 0.4 mm")).unwrap();
    let run = folder.campaign(&["run", "table"]);
    assert_eq!((run.status, run.out.as_str()), (2, ""));
    assert!(
        run.messages.contains("not what was planned: plan again"),
        "{}",
        run.messages
    );
    assert!(folder.results("table").is_empty());
}

/// All faults of a campaign file at once, each at its place.
#[test]
fn campaign_files_that_are_wrong_are_refused() {
    for (campaign, words) in [
        ("[1]", &["campaign.yaml:1:1", "is no group of keys"][..]),
        (
            "campaign: 2\nbase: plate.yaml\nvary: { settings.speed: [8 m/s] }\n",
            &["campaign.yaml:1:11", "no format"],
        ),
        (
            "campaign: 1\nbaes: plate.yaml\nvari: 1\n",
            &[
                "campaign.yaml:2:1",
                "did you mean `base`?",
                "campaign.yaml:3:1",
                "did you mean `vary`?",
                "base: is missing",
            ],
        ),
        ("campaign: 1\nbase: plate.yaml\n", &["`vary` with keys"]),
        (
            "campaign: 1\nbase: plate.yaml\nvary: { a: [1] }\ncases: x.csv\n",
            &["campaign.yaml:4:8", "stands beside"],
        ),
        (
            "campaign: 1\nbase: plate.yaml\nsample: { sobol: 4 }\n",
            &["has nothing to sample"],
        ),
        (
            "campaign: 1\nbase: plate.yaml\nvary: { settings.speed: { from: 8 m/s, to: 9 m/s } }\n",
            &["is a range without steps"],
        ),
        (
            "campaign: 1\nbase: plate.yaml\nvary:\n  settings.speed: { from: 8 m/s, to: 9 mm, step: 1 m/s }\n  shot.radius: 3 mm\n",
            &[
                "campaign.yaml:4:19",
                "not in the unit",
                "campaign.yaml:5:16",
                "neither a list nor a range",
            ],
        ),
        (
            "campaign: 1\nbase: plate.yaml\nvary: { a: [1, 2], a: [3] }\nsample: { sobol: 0, sed: 1 }\n",
            &["given already", "sample.sobol", "did you mean `seed`?"],
        ),
        (
            "campaign: 1\nbase: none.yaml\nvary: { settings.speed: [8 m/s] }\n",
            &["cannot read", "none.yaml"],
        ),
        (
            "campaign: 1\nbase: campaign.yaml\nvary: { settings.speed: [8 m/s] }\n",
            &["campaign.yaml:1:1", "format"],
        ),
        (
            "campaign: 1\nbase: plate.yaml\nvary: { settings.sped: [8 m/s] }\n",
            &["settings.sped", "did you mean `speed`?"],
        ),
        (
            "campaign: 1\nbase: plate.yaml\nvary: { settings.speed.x: [8 m/s] }\n",
            &["would be in what is no group"],
        ),
        (
            "campaign: 1\nbase: plate.yaml\ncases: none.csv\n",
            &["cases: cannot read", "none.csv"],
        ),
        (
            "campaign: 1\nbase: plate.yaml\nvary: { a: { from: 1, to: 2, count: 1000 }, b: { from: 1, to: 2, count: 1001 } }\n",
            &["too many cases"],
        ),
        ("{ a: [1", &["campaign.yaml:1:"]),
        ("", &["campaign.yaml:1:1"]),
    ] {
        let folder = Folder::new(campaign);
        let run = folder.campaign(&["plan", "campaign.yaml", "--out", "study"]);
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{campaign}");
        for word in words {
            assert!(
                run.messages.contains(word),
                "{campaign}: {word} is not in\n{}",
                run.messages
            );
        }
        assert!(!folder.path().join("study").exists());
    }
    let folder = Folder::new(GRID);
    for arguments in [
        &["run", "none"][..],
        &["status", "none"],
        &["gather", "none"],
    ] {
        let run = folder.campaign(arguments);
        assert_eq!(run.status, 2, "{arguments:?}");
        assert!(
            run.messages.contains("peenpose campaign plan"),
            "{}",
            run.messages
        );
    }
    folder.planned("study");
    let run = folder.campaign(&["run", "study", "--shard", "4/3"]);
    assert!(
        run.status == 2 && run.messages.contains("no shard"),
        "{}",
        run.messages
    );
}
