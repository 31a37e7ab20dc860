//! Coverage against cases that can be worked out by hand.

use std::f64::consts::PI;
use std::path::Path;

use peenpose::coverage::Coverage;
use peenpose::problem;
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;

/// A parallel jet of 4 mm onto a square of 2 mm: every part of it is hit alike.
const PLATE: &str = "
format: 1
lengths_in: mm
scene:
  plate: { box: { min: [-20, -20, -5], max: [20, 20, 0] } }
target: { surface: plate.z_max, within: { min: [-1, -1, -1], max: [1, 1, 1] }, aim: [0, 0, 0] }
shot: { radius: 0.5 mm, density: 7000 kg/m3 }
jet: { exit_diameter: 4 mm, divergence: 0 deg, mass_flow: 0.6 kg/min }
contacts:
  dry: { mu_s: 0.30, mu_d: 0.27, restitution: 0.25 }
settings: { incidence: 90 deg, azimuth: 0 deg, standoff: 20 mm, speed: 10 m/s }
goals:
  normal_impulse: { target: 40 uN.s }
coverage: { dent_diameter: 0.2 mm, wanted: 90 % }
";

const MASS: f64 = 4.0 / 3.0 * PI * 0.5e-3 * 0.5e-3 * 0.5e-3 * 7000.0;

fn coverage(changes: &[(&str, &str)]) -> Option<Coverage> {
    let text = changes.iter().fold(PLATE.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    });
    let reading = problem::read_text(&text, Path::new("plate.yaml")).unwrap();
    let faults = problem::render(&reading.source, &reading.faults, false);
    let problem = reading.problem.unwrap_or_else(|| panic!("{faults}"));
    let scenario = Scenario::new(problem, Walls::Exact).unwrap();
    Coverage::of(&scenario, &scenario.problem.ranges.middle())
}

#[track_caller]
fn assert_close(value: f64, expected: f64, relative: f64) {
    let off = value / expected - 1.0;
    assert!(
        off.abs() < relative,
        "{value} is not {expected}: off by {off:e}"
    );
}

#[test]
fn an_even_jet_covers_as_worked_out_by_hand() {
    let even = coverage(&[]).unwrap();
    assert_close(even.area, 4e-6, 1e-9);
    assert_close(even.shots_per_kilogram, 1.0 / MASS, 1e-12);
    // One shot falls on the disc of 4 mm: 1 / (pi d^2 / 4) for each area.
    let density = 1.0 / (PI * 4e-6);
    assert_close(even.mean.value, density, 0.002);
    assert!((even.mean.value - density).abs() < 4.0 * even.mean.standard_error);
    // 64 cells of 0.25 mm: 1304 hits in each, and an even sequence does better than chance.
    assert_eq!(even.cells, 64);
    assert_close(even.side, 0.25e-3, 1e-9);
    let chance = 1.0 / (even.shots as f64 * density * 0.0625e-6).sqrt();
    assert!(even.variation < chance && even.variation > 0.01 * chance);
    assert!((0.9 * density..even.mean.value).contains(&even.lowest.value));
    assert!(even.lowest.standard_error < 2.0 * chance * density);
    assert_eq!(even.share_not_hit, 0.0);
    // 1 - exp(-n pi (0.2 mm)^2 / 4) = 0.9 for n = 73.3 per mm2; 0.01 kg/s are 2728 shots/s.
    let hits = 10.0_f64.ln() / (PI * 0.04e-6 / 4.0);
    assert_close(hits, 73.3e6, 1e-3);
    let mass = hits / (density / MASS);
    assert_close(even.mass_until_wanted(even.mean).unwrap(), mass, 0.002);
    assert_close(
        even.time_until_wanted(even.mean).unwrap(),
        mass / 0.01,
        0.002,
    );
    // Even hits dent on the mean what their mean density dents.
    let dented = even.dented;
    let by_even_mass = dented.by_even_mass.unwrap();
    assert!((by_even_mass.value - 0.9).abs() < 4e-3, "{dented:?}");
    assert!(by_even_mass.standard_error < 2e-3);
    assert_close(dented.mass.unwrap().value, mass, 0.02);
    assert!((2000..3000).contains(&dented.cells), "{dented:?}");
    let slowest = even.time_until_wanted(even.lowest).unwrap();
    assert_close(slowest, mass / 0.01 * density / even.lowest.value, 1e-9);
}

#[test]
fn shots_beside_the_jet_leave_it_bare() {
    // Of the square of 8 mm the jet hits a disc of 4 mm.
    let small = coverage(&[(
        "[-1, -1, -1], max: [1, 1, 1]",
        "[-4, -4, -1], max: [4, 4, 1]",
    )]);
    let small = small.unwrap();
    assert_close(small.mean.value, 1.0 / 64e-6, 1e-12);
    assert_eq!(small.mean.standard_error, 0.0);
    // Cells of 1 mm: the 16 in the middle are hit, those at its corners in part.
    assert_eq!(small.cells, 64);
    // Small cells see the disc itself.
    let outside = 1.0 - PI / 16.0;
    assert_close(small.share_not_hit, outside, 0.02);
    let resolution = small.dented.not_reached_resolution;
    assert!((small.share_not_hit - outside).abs() < resolution && resolution < 0.05);
    assert_eq!(small.lowest.value, 0.0);
    assert_eq!(small.mass_until_wanted(small.lowest), None);
    assert_eq!(small.time_until_wanted(small.lowest), None);
    // Were all 16 hit alike, the variance would be 64/16 - 1.
    assert!(
        (3.0_f64.sqrt()..3.5_f64.sqrt()).contains(&small.variation),
        "{small:?}"
    );
}

#[test]
fn slanting_shots_fall_farther_apart() {
    let changes = [
        ("incidence: 90 deg", "incidence: 30 deg"),
        ("azimuth: 0 deg", "azimuth: 20 deg"),
    ];
    let slanting = coverage(&changes).unwrap();
    assert_close(slanting.mean.value, 0.5 / (PI * 4e-6), 0.003);
}

#[test]
fn without_a_mass_flow_there_is_no_time() {
    let unknown = coverage(&[(", mass_flow: 0.6 kg/min", "")]).unwrap();
    assert_eq!(unknown.time_until_wanted(unknown.mean), None);
    let known = coverage(&[]).unwrap();
    let mass = |coverage: &Coverage| coverage.mass_until_wanted(coverage.mean);
    assert_eq!(mass(&unknown), mass(&known));
    assert!(coverage(&[("coverage: { dent_diameter: 0.2 mm, wanted: 90 % }", "")]).is_none());
}

#[test]
fn curved_targets_are_cut_into_cells_of_their_own_area() {
    // A quarter of the wall of a bore, from a jet that is as wide.
    let bore = coverage(&[
        (
            "plate: { box: { min: [-20, -20, -5], max: [20, 20, 0] } }",
            "hole: { bore: { diameter: 20 mm, length: 20 mm } }",
        ),
        (
            "plate.z_max, within: { min: [-1, -1, -1], max: [1, 1, 1] }, aim: [0, 0, 0]",
            "hole.wall, within: { min: [-3, 0, 7], max: [3, 20, 13] }, aim: [0, 10, 10]",
        ),
        ("exit_diameter: 4 mm", "exit_diameter: 9 mm"),
        ("radius: 0.5 mm", "radius: 0.001 mm"),
        ("standoff: 20 mm", "standoff: 10 mm"),
    ]);
    let bore = bore.unwrap();
    let arc = 2.0 * 10e-3 * 0.3_f64.asin();
    assert_close(bore.area, arc * 6e-3, 1e-4);
    // As many hits as fall on the square seen from the jet.
    let seen = 36e-6 / (PI * 81e-6 / 4.0);
    assert_close(bore.mean.value, seen / bore.area, 0.003);
    // A piece of a cell at the border may be without a hit by chance.
    assert!(bore.share_not_hit < 1e-4, "{bore:?}");
    // At the borders the wall leans by asin(0.3): cos is 0.954, on the mean 0.985.
    assert!(
        (0.93..0.985).contains(&(bore.lowest.value * PI * 81e-6 / 4.0)),
        "{bore:?}"
    );
    assert!(bore.variation < 0.05, "{bore:?}");
}

#[test]
fn a_target_as_narrow_as_can_be_has_few_cells() {
    let narrow = coverage(&[
        (
            "min: [-20, -20, -5], max: [20, 20, 0]",
            "min: [-1e6, -20, -5], max: [1e6, 20, 0]",
        ),
        (
            "min: [-1, -1, -1], max: [1, 1, 1]",
            "min: [-1e6, -1e-6, -1], max: [1e6, 1e-6, 1]",
        ),
    ])
    .unwrap();
    // Square cells as wide as the target would be a million million.
    assert!((64..1000).contains(&narrow.cells), "{}", narrow.cells);
}

/// The jet hits a disc of 4 mm in a square of 6 mm. What the mean density would dent all over is far from
/// what is dented.
#[test]
fn what_is_dented_is_not_what_the_mean_density_dents() {
    let hit_id = |wanted: &str| {
        coverage(&[
            (
                "[-1, -1, -1], max: [1, 1, 1]",
                "[-3, -3, -1], max: [3, 3, 1]",
            ),
            ("wanted: 90 %", wanted),
        ])
        .unwrap()
    };
    let disc = PI * 4.0 / 36.0;
    let never = hit_id("wanted: 90 %").dented;
    assert_eq!(never.mass, None);
    let not_reached = never.share_not_reached;
    assert!(
        (not_reached - (1.0 - disc)).abs() < never.not_reached_resolution.max(2e-3),
        "{never:?}"
    );
    // On the disc hits are as dense as 1/disc times the mean.
    let there = 1.0 - 0.1_f64.powf(1.0 / disc);
    let by_even_mass = never.by_even_mass.unwrap();
    let error = by_even_mass.resolution + 4.0 * by_even_mass.standard_error;
    assert!(
        (by_even_mass.value - disc * there).abs() < error && error < 0.02,
        "{never:?}"
    );
    assert!(by_even_mass.standard_error > 0.0);

    // 30 % of the square are 0.3/disc of the disc.
    let some = hit_id("wanted: 30 %").dented;
    let mass = some.mass.unwrap();
    let hits = -(1.0 - 0.3 / disc).ln() / (PI * 0.04e-6 / 4.0);
    let expected = hits * PI * 4e-6 * MASS;
    let error = mass.resolution + 4.0 * mass.standard_error;
    assert!(
        (mass.value - expected).abs() < error && error < 0.1 * expected,
        "{some:?}, {expected}"
    );
}
