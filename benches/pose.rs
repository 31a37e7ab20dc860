//! What one pose costs: rays per second through exact walls and through facets, in both precisions,
//! impacts and bookkeeping included, and how the cost grows with shots and with triangles.
//!
//! Run on one core: `taskset -c 0 cargo bench --bench pose`.

mod common;

use std::fs::File;
use std::hint::black_box;
use std::io::{BufWriter, Write};
use std::path::Path;

use criterion::measurement::WallTime;
use criterion::{
    BenchmarkGroup, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main,
};
use nalgebra::Point3;
use peenpose::jet::{Samples, Stream};
use peenpose::objective::Tally;
use peenpose::problem;
use peenpose::problem::part::Shape;
use peenpose::problem::setting::Settings;
use peenpose::scenario::Scenario;
use peenpose::scene::{Scene, Walls};

use common::settings;

/// A shipped problem with its walls as asked for.
fn scenario(file: &str, walls: Walls) -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("problems")
        .join(file);
    let problem = problem::read(&path)
        .expect("the file can be read")
        .problem
        .expect("a shipped problem has no faults");
    Scenario::new(problem, walls).expect("its scene has no faults")
}

fn facets(degrees: f64) -> Walls {
    Walls::TriangleMesh {
        chord_angle: degrees.to_radians(),
    }
}

/// What flies, and whether it has a size.
const KINDS: [(&str, bool); 2] = [("points", false), ("shots of their size", true)];

/// A pose of the long hub with many bounces, and the blind keyway near its best pose.
fn rays(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("rays");
    let steep = settings(60.0, 20.0, 10e-3, 10.0);
    let blind = settings(63.0, 0.0, 8e-3, 48.0);
    for (name, scenario, settings) in [
        (
            "keyway 40 mm, 666 facets",
            scenario("keyway.yaml", facets(1.0)),
            settings(78.0, 0.0, 8e-3, 9.4),
        ),
        (
            "keyway 200 mm, exact",
            scenario("keyway-long.yaml", Walls::Exact),
            steep,
        ),
        (
            "keyway 200 mm, 666 facets",
            scenario("keyway-long.yaml", facets(1.0)),
            steep,
        ),
        (
            "blind keyway, 14588 facets",
            scenario("keyway-blind.yaml", Walls::Exact),
            blind,
        ),
    ] {
        let samples = Samples::with_boundary(&scenario.problem, Stream::Search, 1024);
        for (kind, shot_size) in KINDS {
            let mut scenario = scenario.clone();
            scenario.problem.paths.shot_size = shot_size;
            let once = Tally::trace(&scenario, &settings, 1.0, &samples.shots);
            group.throughput(Throughput::Elements(once.rays as u64));
            let shots = &samples.shots;
            group.bench_function(format!("{name}, {kind}"), |bencher| {
                bencher.iter(|| Tally::trace(&scenario, black_box(&settings), 1.0, shots));
            });
        }
    }
    group.finish();
}

/// The whole judgement of a pose of 1024 shots, best speed included.
fn pose(criterion: &mut Criterion) {
    let scenario = scenario("keyway.yaml", Walls::Exact);
    let samples = Samples::with_boundary(&scenario.problem, Stream::Search, 1024);
    let settings = settings(68.0, 0.0, 8e-3, 9.4);
    criterion.bench_function("pose of 1024 shots with the best speed", |bencher| {
        bencher.iter(|| {
            let tally = Tally::trace(&scenario, black_box(&settings), 1.0, &samples.shots);
            let goals = &scenario.problem.goals;
            let speed = tally.best_speed(goals, scenario.problem.ranges.speed);
            tally.terms(goals, speed)
        });
    });
}

fn growth(criterion: &mut Criterion) {
    let steep = settings(60.0, 20.0, 10e-3, 10.0);
    let mut group = criterion.benchmark_group("shots");
    let exact = scenario("keyway-long.yaml", Walls::Exact);
    for shots in [256, 1024, 4096, 16384, 65536] {
        let samples = Samples::with_boundary(&exact.problem, Stream::Search, shots);
        group.throughput(Throughput::Elements(shots as u64));
        group.bench_with_input(
            BenchmarkId::from_parameter(shots),
            &samples,
            |bencher, samples| {
                bencher.iter(|| Tally::trace(&exact, black_box(&steep), 1.0, &samples.shots));
            },
        );
    }
    group.finish();
    narrow_facets(criterion);
    even_facets(criterion);
}

/// Facets as long as the hub: the narrower they are, the more of them a shot passes over.
fn narrow_facets(criterion: &mut Criterion) {
    let steep = settings(60.0, 20.0, 10e-3, 10.0);
    let mut group = criterion.benchmark_group("chord angle in degrees");
    for (kind, shot_size) in KINDS {
        for degrees in [1.0, 0.1, 0.01, 0.001] {
            let mut scenario = scenario("keyway-long.yaml", facets(degrees));
            scenario.problem.paths.shot_size = shot_size;
            trace(&mut group, &scenario, &steep, &format!("{degrees}, {kind}"));
        }
    }
    group.finish();
}

/// Facets about as long as wide, as most programs for meshes make them.
fn even_facets(criterion: &mut Criterion) {
    let steep = settings(60.0, 20.0, 10e-3, 10.0);
    let mut group = criterion.benchmark_group("side in mm");
    for side in [8.0, 2.5, 0.8, 0.25] {
        let folder = tempfile::TempDir::new().expect("there is space for a mesh");
        let mut scenario = setup_of_even_facets(folder.path(), side * 1e-3);
        for (kind, shot_size) in KINDS {
            scenario.problem.paths.shot_size = shot_size;
            trace(&mut group, &scenario, &steep, &format!("{side}, {kind}"));
        }
    }
    group.finish();
}

/// Measures a pose of 1024 shots.
fn trace(
    group: &mut BenchmarkGroup<WallTime>,
    scenario: &Scenario,
    settings: &Settings,
    name: &str,
) {
    let samples = Samples::with_boundary(&scenario.problem, Stream::Search, 1024);
    let once = Tally::trace(scenario, settings, 1.0, &samples.shots);
    group.throughput(Throughput::Elements(once.rays as u64));
    let name = format!("{name}, {} triangles", scenario.scene.triangles());
    group.bench_function(name, |bencher| {
        bencher.iter(|| Tally::trace(scenario, black_box(settings), 1.0, &samples.shots));
    });
}

/// The long keyway as a mesh of halved squares with sides of at most `side`, m.
fn setup_of_even_facets(folder: &Path, side: f64) -> Scenario {
    let strips = scenario(
        "keyway-long.yaml",
        facets((side / BORE_RADIUS).to_degrees()),
    );
    let path = folder.join("hub.obj");
    write_even(&strips.scene, side, &path).expect("there is space for a mesh");
    let mut problem = strips.problem;
    problem.parts[0].shape = Shape::Mesh {
        file: path.into(),
        metres_per_unit: 1.0,
        regions: Vec::new(),
    };
    Scenario::new(problem, Walls::Exact).expect("its scene has no faults")
}

/// m.
const BORE_RADIUS: f64 = 0.015;

/// Writes the strips of a prism, cut into squares.
fn write_even(scene: &Scene, side: f64, path: &Path) -> std::io::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    let mut corners = 0;
    for (index, name) in (0..).zip(scene.surfaces()) {
        let (_, surface) = name.split_once('.').unwrap_or(("", name));
        writeln!(file, "g {surface}")?;
        for [from, to, top] in scene.surface_triangles(index).filter_map(on_near_end) {
            let pieces = |length: f64| (length / side).ceil().max(1.0) as usize;
            let (columns, rows) = (pieces((to - from).norm()), pieces(top.z));
            let at = |column: usize, row: usize| {
                let share = column as f64 / columns as f64;
                let [x, y] = [0, 1].map(|axis| from[axis] * (1.0 - share) + to[axis] * share);
                [x, y, top.z * row as f64 / rows as f64]
            };
            for (column, row) in (0..columns).flat_map(|c| (0..rows).map(move |r| (c, r))) {
                for [column, row] in
                    [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[c, r]| [column + c, row + r])
                {
                    let [x, y, z] = at(column, row);
                    writeln!(file, "v {x} {y} {z}")?;
                }
                let [a, b, c, d] = [1, 2, 3, 4].map(|corner| corners + corner);
                writeln!(file, "f {a} {b} {c}\nf {a} {c} {d}")?;
                corners += 4;
            }
        }
    }
    file.flush()
}

/// A triangle with two corners on the near end, those first.
fn on_near_end([a, b, c]: [Point3<f64>; 3]) -> Option<[Point3<f64>; 3]> {
    let turns = [[a, b, c], [b, c, a], [c, a, b]];
    let is_on = |[a, b, c]: &[Point3<f64>; 3]| a.z == 0.0 && b.z == 0.0 && c.z > 0.0;
    turns.into_iter().find(is_on)
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).without_plots();
    targets = rays, pose, growth
}
criterion_main!(benches);
