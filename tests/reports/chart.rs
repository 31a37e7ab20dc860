//! `peenpose chart`: files, figures and tables, and that errors are what they should be.

use std::path::Path;
use std::sync::{Arc, LazyLock};
use std::time::Instant;

use assert_cmd::Command;
use peenpose::chart::{BesidePoint, Chart, Effect, Plan, Refusal, Sampling, Walls, measure};
use peenpose::control::{Cancel, Clock, Control, Progress};
use peenpose::report;
use peenpose::report::figure::Figure;
use peenpose::scenario::Scenario;
use resvg::tiny_skia::Pixmap;
use resvg::usvg::roxmltree::Document;
use tempfile::TempDir;

/// Small enough for many searches: only the incidence is sought.
const PROBLEM: &str = r#"
format: 1
title: "Floor of a keyway \u0007& its walls"
lengths_in: mm
scene:
  hub: { keyway: { bore: 30 mm, width: 8 mm, depth: 3.3 mm, length: 40 mm } }
target: { surface: hub.floor, within: { min: [-3, 18, 15], max: [3, 19, 25] } }
shot: { radius: 0.5 mm, density: 7000 kg/m3 }
jet: { exit_diameter: 1.5 mm, divergence: 4 deg, speed_spread: 5 % }
contacts:
  oiled: { mu_s: 0.06, mu_d: 0.054, restitution: 0.25 }
settings:
  incidence: [55 deg, 80 deg]
  azimuth: 0 deg
  standoff: 8 mm
  speed: [5 m/s, 40 m/s]
  contact: oiled
goals:
  normal_impulse: { target: 40 uN.s, tolerance: 15 % }
  rebound: { allow: 10 uN.s }
tolerance: { incidence: 2 deg }
solve: { accuracy: 3 % }
"#;

const BESIDE: &str = "\
method,speed,seconds,excess,remark
# measured elsewhere
grid,100 poses,0.01,0.5,coarse

grid,1000 poses,0.1,0.02,fine
";

/// What the command did, once for all tests.
struct Run {
    folder: TempDir,
    status: i32,
    out: String,
    messages: String,
}

impl Run {
    fn text(&self, name: &str) -> String {
        std::fs::read_to_string(self.folder.path().join("out").join(name)).unwrap()
    }

    fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.folder.path().join("out").join(name)).unwrap()
    }

    fn chart(&self) -> Chart {
        Chart::from_json(&self.text("chart.json")).unwrap()
    }
}

fn run(folder: TempDir, arguments: &[&str]) -> Run {
    let output = Command::new(env!("CARGO_BIN_EXE_peenpose"))
        .arg("chart")
        .args(arguments)
        .current_dir(folder.path())
        .output()
        .unwrap();
    Run {
        folder,
        status: output.status.code().unwrap(),
        out: String::from_utf8(output.stdout).unwrap(),
        messages: String::from_utf8(output.stderr).unwrap(),
    }
}

fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("floor.yaml"), PROBLEM).unwrap();
    folder
}

static RUN: LazyLock<Run> = LazyLock::new(|| {
    let folder = folder();
    std::fs::write(folder.path().join("grid.csv"), BESIDE).unwrap();
    let arguments = "floor.yaml --out out --beside grid.csv --most-shots 16384 --seeds 1";
    run(folder, &arguments.split(' ').collect::<Vec<_>>())
});

const FIGURES: [&str; 3] = ["pose", "search", "effect"];

#[test]
fn every_file_is_there_and_the_text_is_printed() {
    let run = &*RUN;
    assert_eq!((run.status, run.messages.as_str()), (0, ""));
    assert_eq!(run.out, run.text("chart.txt"));
    let chart = run.chart();
    assert!(!chart.interrupted);
    assert_eq!(report::chart(&chart), run.out);
    for name in FIGURES {
        for ending in ["svg", "png", "csv"] {
            assert!(!run.bytes(&format!("{name}.{ending}")).is_empty());
        }
    }
    for heading in ["J OF ONE POSE", "WALLS", "SEARCH", "EFFECTS", "REPRODUCE"] {
        assert!(run.out.contains(heading), "no {heading} in\n{}", run.out);
    }
    assert!(run.out.lines().all(|line| line.trim_end() == line));
}

/// Rows of a table by the names of its columns.
fn column(csv: &str, name: &str) -> Vec<String> {
    let mut lines = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next().unwrap();
    let index = head.iter().position(|cell| *cell == name).unwrap();
    lines
        .map(|row| {
            assert_eq!(row.len(), head.len(), "{row:?}");
            row[index].to_owned()
        })
        .collect()
}

fn numbers(csv: &str, name: &str) -> Vec<f64> {
    let cells = column(csv, name).into_iter();
    cells.map(|cell| cell.parse().unwrap()).collect()
}

#[test]
fn tables_can_be_read() {
    let poses = RUN.text("pose.csv");
    // 3 ways to draw shots; exact walls, 3 meshes, points by both engines; 16 to 16384 shots in steps of 4.
    assert_eq!(numbers(&poses, "shots").len(), 3 * 6 * 6);
    assert!(
        numbers(&poses, "seconds")
            .iter()
            .all(|s| *s > 0.0 && *s < 10.0)
    );
    assert!(numbers(&poses, "error").iter().all(|error| *error > 0.0));
    let searches = RUN.text("search.csv");
    assert_eq!(numbers(&searches, "seconds").len(), 9);
    assert!(
        numbers(&searches, "excess")
            .iter()
            .all(|excess| *excess >= 0.0)
    );
    assert!(
        BesidePoint::read_all(&searches).is_ok(),
        "one chart can stand beside another"
    );
    let effects = RUN.text("effect.csv");
    assert_eq!(
        column(&effects, "left_out"),
        [
            "size of the shot in flight",
            "impacts after the first",
            "impacts after the second",
            "spin between impacts",
            "width of the exit",
            "divergence of the jet",
            "scatter of the speed",
            "tolerance of the settings"
        ]
    );
}

#[test]
fn errors_fall_with_shots_and_rim_shots_beat_random_ones() {
    let chart = RUN.chart();
    let error = |sampling: Sampling, shots: usize| {
        let curve = chart.poses.iter().find(|c| c.sampling == sampling).unwrap();
        let point = curve.points.iter().find(|p| p.shots == shots).unwrap();
        point.error
    };
    // The error of random shots falls with the root of their number: 16 times as many, a quarter.
    for shots in [16, 64, 256] {
        let ratio = error(Sampling::Random, shots) / error(Sampling::Random, 16 * shots);
        assert!((3.0..5.3).contains(&ratio), "{shots}: {ratio}");
    }
    // What harms rarely scatters all shots of the jet alike; those on the rim see it.
    assert!(error(Sampling::Sobol, 1024) < 1.2 * error(Sampling::Random, 1024));
    assert!(error(Sampling::SobolRim, 16384) < 0.7 * error(Sampling::Random, 16384));
    // The reference is the average of far more shots than any point.
    let reference = chart.reference;
    assert!(reference.standard_error < 0.01 * reference.objective);
    assert_eq!(reference.shots, 32 * 16384);
}

#[test]
fn rays_at_edges_are_lost_by_parry_alone() {
    let chart = RUN.chart();
    let leaks = |walls: Walls| {
        let curve = chart.poses.iter().find(|it| it.walls == walls).unwrap();
        curve.leaks.unwrap()
    };
    let (own, parry) = (leaks(Walls::Points), leaks(Walls::Parry));
    assert!(own.aimed > 100 && own.missed == 0, "{own:?}");
    assert_eq!(parry.aimed, own.aimed);
    assert!((1..own.aimed / 10).contains(&parry.missed), "{parry:?}");
    let exact = chart.poses.iter().find(|it| it.walls == Walls::Exact);
    assert_eq!(exact.unwrap().leaks, None);
}

#[test]
fn what_is_left_out_changes_what_it_should() {
    let chart = RUN.chart();
    let effect = |name: &str| {
        chart
            .effects
            .iter()
            .find(|effect| effect.name == name)
            .unwrap()
    };
    // Half of the scatter of N* is the speed's: without it J falls by far more than its error.
    let speed = effect("scatter of the speed");
    assert!(speed.change < -0.2 && speed.change_standard_error < 0.02);
    // A search that sees no rebounds shoots steeply, into the opposite wall.
    let rebounds = effect("impacts after the first");
    assert!(rebounds.regret > 10.0, "{rebounds:?}");
    assert!(rebounds.relative_cost < 1.0, "{rebounds:?}");
}

/// Without its tolerance the nozzle goes nearer than the tolerance lets it, where fewer shots miss the small target.
const CROWDED: &str = r#"
format: 1
title: A small target, and a ball round the exit
lengths_in: mm
scene:
  hub: { keyway: { bore: 30 mm, width: 8 mm, depth: 3.3 mm, length: 40 mm } }
target: { surface: hub.floor, within: { min: [-1, 18, 19], max: [1, 19, 21] } }
shot: { radius: 0.5 mm, density: 7000 kg/m3 }
jet: { exit_diameter: 1.5 mm, divergence: 4 deg, speed_spread: 5 % }
nozzle: { body: [ { ball: { radius: 3 mm } } ], clearance: 0 mm }
contacts: { oiled: { mu_s: 0.06, mu_d: 0.054, restitution: 0.25 } }
settings: { incidence: 65 deg, azimuth: 0 deg, standoff: [3 mm, 12 mm], speed: [5 m/s, 40 m/s], contact: oiled }
goals:
  normal_impulse: { target: 40 uN.s, tolerance: 15 % }
  miss: { share: 50 %, weight: 2 }
tolerance: { standoff: 1 mm }
solve: { accuracy: 3 % }
"#;

#[test]
fn an_answer_at_which_the_nozzle_does_not_fit_is_not_called_better() {
    let folder = TempDir::new().unwrap();
    std::fs::write(folder.path().join("floor.yaml"), CROWDED).unwrap();
    let arguments = "floor.yaml --out out --most-shots 1024 --seeds 1";
    let run = run(folder, &arguments.split(' ').collect::<Vec<_>>());
    let chart = run.chart();
    let fits = |effect: &Effect| effect.fits == (effect.name != "tolerance of the settings");
    assert!(chart.effects.iter().all(fits), "{:?}", chart.effects);
    let mut lines = run.out.lines();
    let row = lines.find(|line| line.starts_with("  tolerance of"));
    assert!(row.is_some_and(|row| row.contains("no fit")), "{}", run.out);
    assert!(run.text("effect.svg").contains("no fit"));
    assert!(column(&run.text("effect.csv"), "fits").contains(&"false".into()));
}

#[test]
fn figures_are_well_formed_and_name_axes_and_units() {
    let words: [&[&str]; 3] = [
        &[
            "time for J of one pose",
            "error of J, % of J",
            " µs",
            " %",
            "exact walls",
            "rays lost at edges",
            "faster",
            "more accurate",
        ],
        &[
            "time to the answer",
            "J of the answer above the best known, %",
            " s",
            "grid",
            "1000 poses",
            "3 %",
        ],
        &["time for a pose", "tolerance of the settings", " %"],
    ];
    for (name, words) in FIGURES.iter().zip(words) {
        let svg = RUN.text(&format!("{name}.svg"));
        let document = Document::parse(&svg).unwrap();
        let texts: String = document
            .descendants()
            .filter_map(|node| node.text())
            .collect();
        assert!(texts.contains("Floor of a keyway ␇& its walls"), "{texts}");
        for word in words {
            assert!(texts.contains(word), "no {word:?} in {name}.svg");
        }
        assert!(svg.contains("Open Sans, sans-serif"));
        assert!(!svg.contains("NaN"));
    }
}

#[test]
fn figures_as_png_have_their_size_and_are_not_blank() {
    for name in FIGURES {
        let svg = RUN.text(&format!("{name}.svg"));
        let document = Document::parse(&svg).unwrap();
        let side = |side| {
            document
                .root_element()
                .attribute(side)
                .unwrap()
                .parse()
                .unwrap()
        };
        let png = Pixmap::decode_png(&RUN.bytes(&format!("{name}.png"))).unwrap();
        assert_eq!((png.width(), png.height()), (side("width"), side("height")));
        let inked = |from: u32, to: u32| {
            let row = png.width() as usize;
            let pixels = &png.pixels()[from as usize * row..to as usize * row];
            pixels.iter().filter(|pixel| pixel.red() < 128).count()
        };
        // The title needs the embedded font: without it no letter is drawn.
        assert!(inked(20, 70) > 1000, "{name}: no title");
        assert!(inked(150, png.height()) > 5000, "{name}: no figure");
    }
}

#[test]
fn figures_can_be_made_again_from_the_json() {
    for figure in Figure::of_chart(&RUN.chart()).unwrap() {
        assert_eq!(figure.svg, RUN.text(&format!("{}.svg", figure.name)));
        assert_eq!(
            figure.png().unwrap(),
            RUN.bytes(&format!("{}.png", figure.name))
        );
    }
}

#[test]
fn bad_tables_are_refused_with_file_and_line() {
    for (table, message) in [
        (
            "method,speed,seconds,excess\ngrid,1,2,3\ngrid,1,soon,3\n",
            "bad.csv:3: seconds: `soon`",
        ),
        (
            "method,speed,seconds,excess\n\ngrid,1,0,3\n",
            "bad.csv:3: seconds: `0` must be from 1e-9 to 1e9",
        ),
        (
            "method,speed,seconds,excess\ngrid,1,2\n",
            "bad.csv:2: 3 fields, but there are 4",
        ),
        (
            "method,speed,seconds,excess\n,1,2,3\n",
            "bad.csv:2: method: a name is missing",
        ),
        (
            "method,speed,seconds,excess\ngrid,1,2,inf\n",
            "bad.csv:2: excess: `inf`",
        ),
        (
            "name,seconds\n",
            "bad.csv:1: expected the heading `method,speed,seconds,excess`",
        ),
        ("", "bad.csv:1: expected the heading"),
    ] {
        let folder = folder();
        std::fs::write(folder.path().join("bad.csv"), table).unwrap();
        let run = run(
            folder,
            &["floor.yaml", "--out", "out", "--beside", "bad.csv"],
        );
        assert_eq!((run.status, run.out.as_str()), (2, ""), "{table}");
        assert!(
            run.messages.contains(message),
            "{message:?} is not in {}",
            run.messages
        );
    }
}

#[test]
fn a_problem_without_scatter_has_no_figure_of_it() {
    let plate = Path::new(env!("CARGO_MANIFEST_DIR")).join("problems/plate.yaml");
    let arguments = ["--out", "out", "--most-shots", "64", "--seeds", "1"];
    let run = run(
        folder(),
        &[&[plate.to_str().unwrap()], &arguments[..]].concat(),
    );
    assert_eq!((run.status, run.messages.as_str()), (0, ""));
    assert!(!run.folder.path().join("out/pose.svg").exists());
    assert!(run.text("pose.csv").lines().count() > 1);
    assert!(run.out.contains("as good without any one of these effects"));
    assert!(run.out.contains("(J = 9.6e-13)"), "{}", run.out);
    assert!(
        !run.out.contains("NaN") && !run.out.contains("inf"),
        "{}",
        run.out
    );
}

fn scenario() -> (TempDir, Scenario, peenpose::problem::Source) {
    let folder = folder();
    let (scenario, source) = Scenario::load(&folder.path().join("floor.yaml")).unwrap();
    (folder, scenario, source)
}

#[test]
fn everything_but_times_is_the_same_for_any_number_of_threads() {
    let (_folder, scenario, source) = scenario();
    let plan = Plan {
        most_shots: 1024,
        replicates: 3,
        seeds: 1,
        ..Plan::default()
    };
    let timeless = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let chart = || measure(&scenario, &source, String::new(), Vec::new(), &plan).unwrap();
        let mut chart = pool.install(chart);
        chart.threads = 0;
        let points = chart.poses.iter_mut().flat_map(|curve| &mut curve.points);
        points.for_each(|point| point.seconds = 0.0);
        let runs = chart
            .searches
            .iter_mut()
            .flat_map(|searches| &mut searches.runs);
        runs.for_each(|run| run.seconds = 0.0);
        chart
            .effects
            .iter_mut()
            .for_each(|effect| effect.relative_cost = 0.0);
        chart
    };
    assert_eq!(timeless(1), timeless(3));
}

#[test]
fn a_chart_that_is_stopped_at_once_says_so() {
    let (_folder, scenario, source) = scenario();
    let plan = Plan::default();
    plan.control.cancel.end();
    let refused = measure(&scenario, &source, String::new(), Vec::new(), &plan);
    assert_eq!(refused, Err(Refusal::Interrupted));
}

#[test]
fn a_chart_that_is_stopped_later_keeps_what_it_has() {
    let (_folder, scenario, source) = scenario();
    let cancel = Cancel::default();
    let asked = cancel.clone();
    let started = Instant::now();
    let observer = move |progress| {
        if matches!(progress, Progress::Step { name, number: 2, .. } if name == "searches") {
            asked.end();
        }
    };
    let plan = Plan {
        most_shots: 64,
        replicates: 2,
        seeds: 1,
        control: Control {
            cancel,
            observer: Some(Arc::new(observer)),
            clock: Clock::new(move || started.elapsed().as_secs_f64()),
            ..Control::default()
        },
    };
    let chart = measure(&scenario, &source, String::new(), Vec::new(), &plan).unwrap();
    assert!(chart.interrupted);
    assert_eq!(chart.poses.len(), 3 * 6);
    assert_eq!(chart.searches.as_ref().unwrap().runs.len(), 2);
    assert!(chart.effects.is_empty());
    assert!(report::chart(&chart).contains("interrupted"));
    assert!(!Figure::of_chart(&chart).unwrap().is_empty());
}
