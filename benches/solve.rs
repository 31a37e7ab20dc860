//! Whole searches of the shipped problems, on all cores, without the start of the process.

use std::path::Path;

use criterion::{Criterion, criterion_group, criterion_main};
use peenpose::control::Control;
use peenpose::scenario::Scenario;
use peenpose::solve::solve;

fn shipped(criterion: &mut Criterion) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("problems");
    for file in [
        "plate.yaml",
        "keyway.yaml",
        "keyway-long.yaml",
        "keyway-blind.yaml",
    ] {
        let Ok((scenario, _)) = Scenario::load(&folder.join(file)) else {
            panic!("{file} has faults");
        };
        criterion.bench_function(file, |bencher| {
            bencher.iter(|| solve(&scenario, &Control::default()));
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10).without_plots();
    targets = shipped
}
criterion_main!(benches);
