//! What one pose costs: rays per second through exact walls and through facets, in both precisions,
//! impacts and bookkeeping included, and how the cost grows with shots and with triangles.
//!
//! Run on one core: `taskset -c 0 cargo bench --bench pose`.

mod common;

use std::hint::black_box;
use std::path::Path;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use peenpose::jet::{Samples, Stream};
use peenpose::objective::Tally;
use peenpose::precision::Precision;
use peenpose::problem;
use peenpose::scene::Walls;
use peenpose::setup::Setup;

use common::choice;

/// A shipped problem with its walls as asked for.
fn setup(file: &str, walls: Walls) -> Setup {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("problems")
        .join(file);
    let problem = problem::read(&path)
        .expect("the file can be read")
        .problem
        .expect("a shipped problem has no faults");
    Setup::new(problem, walls).expect("its scene has no faults")
}

fn facets(degrees: f64) -> Walls {
    Walls::Facets {
        chord_angle: degrees.to_radians(),
    }
}

/// What flies, and whether it has a size.
const KINDS: [(&str, bool); 2] = [("points", false), ("shots of their size", true)];

/// A pose of the long hub with many bounces, and the blind keyway near its best pose.
fn rays(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("rays");
    let steep = choice(60.0, 20.0, 10e-3, 10.0);
    let blind = choice(63.0, 0.0, 8e-3, 48.0);
    for (name, setup, choice) in [
        (
            "keyway 40 mm, 666 facets",
            setup("keyway.yaml", facets(1.0)),
            choice(78.0, 0.0, 8e-3, 9.4),
        ),
        (
            "keyway 200 mm, exact",
            setup("keyway-long.yaml", Walls::Exact),
            steep,
        ),
        (
            "keyway 200 mm, 666 facets",
            setup("keyway-long.yaml", facets(1.0)),
            steep,
        ),
        (
            "blind keyway, 14588 facets",
            setup("keyway-blind.yaml", Walls::Exact),
            blind,
        ),
    ] {
        let samples = Samples::with_rim(&setup.problem, Stream::Search, 1024);
        for (kind, shot_size) in KINDS {
            let mut setup = setup.clone();
            setup.problem.paths.shot_size = shot_size;
            let once = Tally::trace(&setup, &choice, 1.0, &samples.deviates);
            group.throughput(Throughput::Elements(once.rays as u64));
            for precision in Precision::ALL {
                let shots = &samples.deviates;
                group.bench_function(format!("{name}, {kind}, {precision:?}"), |bencher| {
                    bencher.iter(|| {
                        Tally::trace_as(precision, &setup, black_box(&choice), 1.0, shots)
                    });
                });
            }
        }
    }
    group.finish();
}

/// The whole judgement of a pose of 1024 shots, best speed included.
fn pose(criterion: &mut Criterion) {
    let setup = setup("keyway.yaml", Walls::Exact);
    let samples = Samples::with_rim(&setup.problem, Stream::Search, 1024);
    let choice = choice(68.0, 0.0, 8e-3, 9.4);
    criterion.bench_function("pose of 1024 shots with the best speed", |bencher| {
        bencher.iter(|| {
            let tally = Tally::trace(&setup, black_box(&choice), 1.0, &samples.deviates);
            let goals = &setup.problem.goals;
            let speed = tally.best_speed(goals, setup.problem.settings.speed);
            tally.terms(goals, speed)
        });
    });
}

fn growth(criterion: &mut Criterion) {
    let steep = choice(60.0, 20.0, 10e-3, 10.0);
    let mut group = criterion.benchmark_group("shots");
    let exact = setup("keyway-long.yaml", Walls::Exact);
    for shots in [256, 1024, 4096, 16384, 65536] {
        let samples = Samples::with_rim(&exact.problem, Stream::Search, shots);
        group.throughput(Throughput::Elements(shots as u64));
        group.bench_with_input(
            BenchmarkId::from_parameter(shots),
            &samples,
            |bencher, samples| {
                bencher.iter(|| Tally::trace(&exact, black_box(&steep), 1.0, &samples.deviates));
            },
        );
    }
    group.finish();
    let mut group = criterion.benchmark_group("chord angle in degrees");
    for (kind, shot_size) in KINDS {
        for degrees in [1.0, 0.1, 0.01, 0.001] {
            let mut setup = setup("keyway-long.yaml", facets(degrees));
            setup.problem.paths.shot_size = shot_size;
            let samples = Samples::with_rim(&setup.problem, Stream::Search, 1024);
            let once = Tally::trace(&setup, &steep, 1.0, &samples.deviates);
            group.throughput(Throughput::Elements(once.rays as u64));
            let triangles = setup.scene.triangles();
            let name = format!("{degrees}, {triangles} triangles, {kind}");
            group.bench_function(name, |bencher| {
                bencher.iter(|| Tally::trace(&setup, black_box(&steep), 1.0, &samples.deviates));
            });
        }
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).without_plots();
    targets = rays, pose, growth
}
criterion_main!(benches);
