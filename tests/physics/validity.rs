//! The notes on validity against calculations by hand.

use std::f64::consts::PI;
use std::fmt::Write;
use std::path::Path;

use crate::common::held::held;
use crate::common::shipped;
use peenpose::evaluate::{Evaluation, evaluate};
use peenpose::jet::Replicates;
use peenpose::problem;
use peenpose::problem::setting::Settings;
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::validity::{self, Note};

/// A plate under a jet that stands still; tests replace what they are about.
const PLATE: &str = "
format: 1
lengths_in: mm
scene: { part: { box: { min: [-50, -50, -10], max: [50, 50, 0] } } }
target: { surface: part.z_max, aim: [0, 0, 0], along: [1, 0, 0] }
shot: { radius: 0.5 mm, density: 7000 kg/m3 }
jet: { exit_diameter: 1.5 mm, divergence: 4 deg }
contacts: { dry: { mu_s: 0.4, mu_d: 0.4, restitution: 0.5 } }
settings: { incidence: 90 deg, azimuth: 0 deg, standoff: 10 mm, speed: 10 m/s }
goals: { normal_impulse: { target: 40 uN.s } }
";

/// Mass of a shot of the plate, kg: 4/3 pi (0.5 mm)^3 7000 kg/m3.
const MASS: f64 = 3.665_191_429_188_092e-6;

fn setup_in(folder: &Path, changes: &[(&str, &str)]) -> Scenario {
    let mut text = PLATE.to_owned();
    for (old, new) in changes {
        assert!(text.contains(old), "{old}");
        text = text.replace(old, new);
    }
    let reading = problem::read_text(&text, &folder.join("plate.yaml")).unwrap();
    let shown = problem::render(&reading.source, &reading.faults, false);
    Scenario::new(reading.problem.expect(&shown), Walls::Exact).unwrap()
}

fn scenario(changes: &[(&str, &str)]) -> Scenario {
    setup_in(Path::new(""), changes)
}

fn evaluated(scenario: &Scenario) -> Evaluation {
    evaluate(
        scenario,
        &held(scenario),
        &Replicates::new(&scenario.problem, 0, 4096),
    )
}

fn notes(scenario: &Scenario) -> Vec<Note> {
    validity::notes(scenario, &held(scenario), None)
}

fn find(notes: &[Note], name: &str) -> Option<Note> {
    let mut named = notes.iter().filter(|note| note.name == name);
    let found = named.next().cloned();
    assert_eq!(named.next(), None);
    found
}

fn value(scenario: &Scenario, name: &str) -> f64 {
    find(&notes(scenario), name).expect(name).value
}

fn assert_close(found: f64, expected: f64, relative: f64) {
    assert!(
        (found - expected).abs() <= relative * expected.abs(),
        "{found} is not {expected}"
    );
}

/// Speed lost over a distance, by Euler steps in time.
fn lost_by_small_steps(diameter: f64, density: f64, speed: f64, distance: f64) -> f64 {
    let (air, viscosity) = (1.204, 1.81e-5);
    let mass = density * PI / 6.0 * diameter.powi(3);
    let area = PI / 4.0 * diameter * diameter;
    let step = distance / speed * 1e-6;
    let (mut way, mut v) = (0.0, speed);
    while way < distance {
        let reynolds = air * v * diameter / viscosity;
        let coefficient = 24.0 / reynolds * (1.0 + 0.15 * reynolds.powf(0.687));
        way += v * step;
        v -= 0.5 * coefficient * air * area * v * v / mass * step;
    }
    1.0 - v / speed
}

#[test]
fn steel_hardly_loses_speed() {
    let steel = scenario(&[
        (
            "radius: 0.5 mm, density: 7000",
            "radius: 0.3 mm, density: 7800",
        ),
        (
            "standoff: 10 mm, speed: 10 m/s",
            "standoff: 150 mm, speed: 60 m/s",
        ),
    ]);
    // Re = 1.204 60 0.0006 / 1.81e-5 = 2395, so C_d = 0.44 as long as it stays above 1000.
    let rate = 0.75 * 0.44 * 1.204 / (7800.0 * 0.6e-3);
    let loss = value(&steel, "drag");
    assert_close(loss, 1.0 - (-rate * 0.150_f64).exp(), 1e-6);
    assert!(loss < 0.03, "{loss}");
    assert!(
        !find(&notes(&steel), "drag")
            .unwrap()
            .text
            .contains("N* falls")
    );
}

#[test]
fn fine_glass_loses_much_of_its_speed() {
    let glass = scenario(&[
        (
            "radius: 0.5 mm, density: 7000",
            "radius: 0.025 mm, density: 2500",
        ),
        (
            "standoff: 10 mm, speed: 10 m/s",
            "standoff: 50 mm, speed: 50 m/s",
        ),
    ]);
    let expected = lost_by_small_steps(50e-6, 2500.0, 50.0, 0.05);
    let loss = value(&glass, "drag");
    assert_close(loss, expected, 1e-4);
    assert!((0.25..0.32).contains(&loss), "{loss}");
    assert!(
        find(&notes(&glass), "drag")
            .unwrap()
            .text
            .contains("N* falls")
    );
}

/// Euler steps in time for a shot in moving air, as above.
fn gained_by_small_steps(diameter: f64, density: f64, speed: f64, air: f64, distance: f64) -> f64 {
    let (mut v, mut x) = (speed, 0.0);
    let step = 1e-7;
    while x < distance {
        let u = air - v;
        let reynolds = 1.204 * u.abs() * diameter / 1.81e-5;
        let drag = if reynolds < 1000.0 {
            24.0 / reynolds * (1.0 + 0.15 * reynolds.powf(0.687))
        } else {
            0.44
        };
        v += 0.75 * drag * 1.204 / (density * diameter) * u * u.abs() * step;
        x += v * step;
    }
    v / speed - 1.0
}

#[test]
fn the_air_of_a_nozzle_speeds_its_shot_up() {
    let in_air = |air: &str, radius: &str, speed: &str, standoff: &str| {
        let jet = format!("divergence: 4 deg{air}");
        scenario(&[
            ("divergence: 4 deg", &jet),
            (
                "radius: 0.5 mm, density: 7000",
                &format!("radius: {radius}, density: 7800"),
            ),
            (
                "standoff: 10 mm, speed: 10 m/s",
                &format!("standoff: {standoff}, speed: {speed}"),
            ),
        ])
    };
    let s110 = |air: &str| in_air(air, "0.1397 mm", "40 m/s", "12 mm");
    let mut gains = Vec::new();
    for air in [200.0, 250.0, 300.0] {
        let gain = value(&s110(&format!(", air_speed: {air} m/s")), "air");
        assert_close(
            gain,
            gained_by_small_steps(0.2794e-3, 7800.0, 40.0, air, 12e-3),
            1e-3,
        );
        gains.push(gain);
    }
    assert!(
        0.03 < gains[0] && gains[0] < gains[1] && gains[2] < 0.09,
        "{gains:?}"
    );
    let note = find(&notes(&s110(", air_speed: 250 m/s")), "air").unwrap();
    assert!(
        note.text.contains("gains") && note.text.contains("N* rises"),
        "{}",
        note.text
    );
    assert_eq!(find(&notes(&s110(", air_speed: 250 m/s")), "drag"), None);

    let still = find(&notes(&s110("")), "drag").unwrap();
    assert!((0.0022..0.0026).contains(&still.value), "{still:?}");
    assert!(
        still.text.contains("in still air") && still.text.contains("jet.air_speed"),
        "{}",
        still.text
    );

    // Air slower than the shot brakes it, almost still air as much as still air; fine shot ends as fast as the air.
    let slow = in_air(", air_speed: 20 m/s", "0.025 mm", "60 m/s", "50 mm");
    let gain = value(&slow, "air");
    assert_close(
        gain,
        gained_by_small_steps(50e-6, 7800.0, 60.0, 20.0, 50e-3),
        1e-3,
    );
    assert!(gain < 0.0 && find(&notes(&slow), "air").unwrap().text.contains("loses"));
    let (almost, still) = (
        in_air(", air_speed: 0.001 mm/s", "0.025 mm", "60 m/s", "50 mm"),
        in_air("", "0.025 mm", "60 m/s", "50 mm"),
    );
    assert_close(-value(&almost, "air"), value(&still, "drag"), 1e-4);
    let dust = in_air(", air_speed: 200 m/s", "1 um", "1 m/s", "1 m");
    assert_close(value(&dust, "air"), 199.0, 1e-3);
    let same = in_air(", air_speed: 10 m/s", "0.5 mm", "10 m/s", "10 mm");
    assert_eq!(value(&same, "air"), 0.0);
}

#[test]
fn dust_may_stop_on_its_way() {
    let dust = scenario(&[
        (
            "radius: 0.5 mm, density: 7000",
            "radius: 1 um, density: 1000",
        ),
        (
            "standoff: 10 mm, speed: 10 m/s",
            "standoff: 1 m, speed: 1 m/s",
        ),
    ]);
    let loss = value(&dust, "drag");
    assert!(loss > 1.0 - 1e-6 && loss <= 1.0, "{loss}");
}

#[test]
fn gravity_is_half_g_t_squared() {
    // 1 ms of flight.
    assert_close(value(&scenario(&[]), "gravity"), 0.5 * 9.80665e-6, 1e-12);
}

#[test]
fn interference_straight_back_through_the_jet() {
    let jet = |flow: &str| {
        scenario(&[(
            "divergence: 4 deg",
            &format!("divergence: 4 deg, mass_flow: {flow}"),
        )])
    };
    assert_eq!(find(&notes(&scenario(&[])), "interference"), None);
    // 24 g/min of 10 m/s in a disc of 0.75 mm + 10 mm tan(4 deg) = 1.449 mm.
    let radius = 0.75e-3 + 10e-3 * 0.069_926_811_943_510_4;
    let density = 0.4e-3 / (MASS * 10.0 * PI * radius * radius);
    // Back over 10 mm at 5 m/s, against 10 m/s: 15/5 of the way.
    let expected = density * PI * 1e-6 * 10e-3 * 3.0;
    assert_close(value(&jet("24 g/min"), "interference"), expected, 1e-9);
    assert!((0.155..0.157).contains(&expected), "{expected}");
    let text = |scenario: &Scenario, name| find(&notes(scenario), name).expect(name).text;
    assert!(text(&jet("24 g/min"), "interference").contains("are deflected"));
    assert!(text(&jet("6 g/min"), "interference").contains("too few"));
    let many = jet("60 g/min");
    assert_close(value(&many, "interference_strong"), 2.5 * expected, 1e-9);
    let strong = text(&many, "interference_strong");
    assert!(
        strong.contains("as many incoming shots are turned")
            && strong.contains("cannot be called independent")
    );
    assert!(
        strong.contains("N*, misses, rebounds and coverage"),
        "{strong}"
    );
    let noted = text(&jet("24 g/min"), "interference");
    assert!(
        noted.contains("as many incoming shots are turned") && noted.contains("N*, misses"),
        "{noted}"
    );
    assert_eq!(find(&notes(&many), "interference"), None);
}

#[test]
fn interference_out_of_the_side_of_the_jet() {
    let slanting = scenario(&[
        ("divergence: 4 deg", "divergence: 0 deg, mass_flow: 0.4 g/s"),
        ("incidence: 90 deg", "incidence: 45 deg"),
    ]);
    // In units of the speed: v_n = v_t = s, s^2 = 1/2. It sticks: v_t' = 5/7 s, v_n' = s/2.
    let s = 0.5_f64.sqrt();
    let (along, up) = (5.0 / 7.0 * s, 0.5 * s);
    // Across the jet, which comes down at 45 deg; along it the shot still moves towards the plate.
    let sideways = (along + up) * s;
    let approach = (s - along).hypot(s + up);
    let density = 0.4e-3 / (MASS * 10.0 * PI * 0.75e-3 * 0.75e-3);
    let expected = density * PI * 1e-6 * approach * 0.75e-3 / sideways;
    assert_close(value(&slanting, "interference"), expected, 1e-9);
}

#[test]
fn interference_grows_with_the_bounces_in_a_closed_scene() {
    let closed = scenario(&[
        (
            "box: { min: [-50, -50, -10], max: [50, 50, 0] }",
            "bore: { diameter: 30 mm, length: 40 mm, ends: closed }",
        ),
        (
            "part.z_max, aim: [0, 0, 0], along: [1, 0, 0]",
            "part.wall, aim: [0, 15, 20]",
        ),
        ("divergence: 4 deg", "divergence: 4 deg, mass_flow: 6 g/min"),
        (
            "mu_s: 0.4, mu_d: 0.4, restitution: 0.5",
            "mu_s: 0, mu_d: 0, restitution: 1",
        ),
        ("goals:", "paths: { impacts: 6, least_energy: 0 % }\ngoals:"),
        ("incidence: 90 deg", "incidence: 70 deg"),
    ]);
    // Mirrors lose nothing and nothing gets out: six impacts for every shot.
    let evaluation = evaluated(&closed);
    assert_eq!(evaluation.impacts_per_shot, 6.0);
    let all = validity::notes(&closed, &held(&closed), Some(&evaluation));
    let of_one = value(&closed, "interference");
    let of_all = all
        .iter()
        .find(|note| note.name.starts_with("interference"));
    assert_close(of_all.unwrap().value, 6.0 * of_one, 1e-12);
    // In the open every shot has one impact, and leaves.
    let open = scenario(&[("divergence: 4 deg", "divergence: 4 deg, mass_flow: 6 g/min")]);
    let evaluation = evaluated(&open);
    assert_eq!(evaluation.impacts_per_shot, 1.0);
    let noted = validity::notes(&open, &held(&open), Some(&evaluation));
    assert_eq!(
        find(&noted, "interference").unwrap().value,
        value(&open, "interference")
    );
}

#[test]
fn shots_that_stay_in_the_jet_are_not_independent() {
    let dull = scenario(&[
        (
            "divergence: 4 deg",
            "divergence: 4 deg, mass_flow: 0.001 g/min",
        ),
        ("restitution: 0.5", "restitution: 0"),
    ]);
    let stuck = value(&dull, "interference_strong");
    assert!(stuck.is_finite() && stuck > 1e3, "{stuck}");
}

#[test]
fn behind_a_deflector_interference_is_not_estimated() {
    let mut scenario = shipped::scenario("deflector.yaml");
    let settings = scenario.problem.ranges.middle();
    let has = |scenario: &Scenario, name| {
        validity::notes(scenario, &settings, None)
            .iter()
            .any(|note| note.name == name)
    };
    assert!(!has(&scenario, "interference_unknown"));
    scenario.problem.jet.mass_flow = Some(1e-3);
    assert!(has(&scenario, "interference_unknown") && !has(&scenario, "interference"));
}

/// A prism with a regular polygon as its cross-section, open at both ends, as OBJ.
fn polygon_prism(corners: usize) -> String {
    let mut text = String::new();
    for corner in 0..corners {
        let (sin, cos) = (2.0 * PI * corner as f64 / corners as f64).sin_cos();
        for z in [0.0, 30.0] {
            writeln!(text, "v {} {} {z}", 10.0 * cos, 10.0 * sin).unwrap();
        }
    }
    for corner in 0..corners {
        let (a, b) = (2 * corner + 1, 2 * ((corner + 1) % corners) + 1);
        writeln!(text, "f {a} {} {b}\nf {b} {} {}", a + 1, a + 1, b + 1).unwrap();
    }
    text
}

#[test]
fn facets_turn_rebounds_by_the_angle_between_them() {
    let folder = tempfile::tempdir().unwrap();
    let meshed = |corners: usize| {
        std::fs::write(folder.path().join("tube.obj"), polygon_prism(corners)).unwrap();
        let turn = PI / corners as f64;
        let (x, y) = (10.0 * turn.cos().powi(2), 10.0 * turn.cos() * turn.sin());
        let target = format!("part.all, aim: [{x}, {y}, 15]");
        let changes = [
            (
                "box: { min: [-50, -50, -10], max: [50, 50, 0] }",
                "mesh: tube.obj",
            ),
            ("part.z_max, aim: [0, 0, 0], along: [1, 0, 0]", &target),
        ];
        let scenario = setup_in(folder.path(), &changes);
        find(&notes(&scenario), "facets")
    };
    assert_close(meshed(24).unwrap().value, 15.0, 1e-6);
    assert_close(meshed(90).unwrap().value, 4.0, 1e-6);
    // 36 deg is an edge, not a facet of something round.
    assert_eq!(meshed(10), None);
    assert_eq!(find(&notes(&scenario(&[])), "facets"), None);
}

fn keyway(rest: &str) -> Scenario {
    let shape = format!("keyway: {{ bore: 30 mm, depth: 3.3 mm, length: 40 mm, {rest} }}");
    scenario(&[
        ("box: { min: [-50, -50, -10], max: [50, 50, 0] }", &shape),
        ("part.z_max, aim: [0, 0, 0], along: [1, 0, 0]", "part.floor"),
    ])
}

#[test]
fn shots_fit_into_fillets_and_openings_of_a_keyway() {
    // Shots of 1 mm: a fillet of 2 mm and a gap of 4 mm are the least.
    assert_close(
        value(&keyway("width: 8 mm, root_radius: 1.9 mm"), "fillet"),
        1.0 / 1.9,
        1e-12,
    );
    assert_eq!(
        find(
            &notes(&keyway("width: 8 mm, root_radius: 2.1 mm")),
            "fillet"
        ),
        None
    );
    assert_close(value(&keyway("width: 3.9 mm"), "opening"), 1.0 / 3.9, 1e-12);
    assert_eq!(find(&notes(&keyway("width: 4.1 mm")), "opening"), None);
    assert_eq!(find(&notes(&keyway("width: 4.1 mm")), "fillet"), None);
}

#[test]
fn a_bore_is_an_opening_and_a_pin_is_none() {
    let round = |facing: &str| {
        let target = format!("part.wall, aim: [0, 1.5, 20]{facing}");
        scenario(&[
            (
                "box: { min: [-50, -50, -10], max: [50, 50, 0] }",
                "bore: { diameter: 3 mm, length: 40 mm }",
            ),
            ("part.z_max, aim: [0, 0, 0], along: [1, 0, 0]", &target),
        ])
    };
    assert_close(value(&round(""), "opening"), 1.0 / 3.0, 1e-12);
    assert_eq!(find(&notes(&round(", facing: [0, 1, 0]")), "opening"), None);
}

/// A slot with a round bottom that touches both walls.
fn slot(width: f64) -> Scenario {
    let (half, bottom) = (width / 2.0, -width / 2.0);
    let profile = format!(
        "extrude: {{ length: 40 mm, profile: [ {{ from: [{}, 10], line_to: [{}, 0], surface: left }}, \
         {{ arc_to: [{half}, 0], via: [0, {bottom}], surface: floor }}, \
         {{ line_to: [{half}, 10], surface: right }} ] }}",
        -half, -half
    );
    let target = format!("part.floor, aim: [0, {bottom}, 20]");
    scenario(&[
        ("box: { min: [-50, -50, -10], max: [50, 50, 0] }", &profile),
        ("part.z_max, aim: [0, 0, 0], along: [1, 0, 0]", &target),
    ])
}

#[test]
fn shots_fit_into_fillets_and_openings_of_an_outline() {
    assert_close(value(&slot(3.9), "opening"), 1.0 / 3.9, 1e-3);
    assert_close(value(&slot(3.9), "fillet"), 1.0 / 1.95, 1e-9);
    assert_eq!(find(&notes(&slot(4.1)), "opening"), None);
    assert_eq!(find(&notes(&slot(4.1)), "fillet"), None);
}

/// The file says in a comment what ASTM B851 allows in it: fillets of 2 mm, an opening of 9.4 mm.
#[test]
fn the_narrowest_gap_of_a_firtree_is_between_its_lobes() {
    let mut scenario = shipped::scenario("firtree.yaml");
    let ranges = &scenario.problem.ranges;
    let middle = |range: problem::setting::Range| range.at(0.5);
    let settings = Settings {
        incidence: middle(ranges.incidence),
        azimuth: 0.0,
        standoff: middle(ranges.standoff),
        speed: middle(ranges.speed),
        aim_along: 0.0,
        aim_across: 0.0,
        aim_above: 0.0,
        contact: 0,
        static_friction: 0.0,
    };
    let noted = validity::notes(&scenario, &settings, None);
    assert_eq!(find(&noted, "fillet"), None);
    assert_eq!(find(&noted, "opening"), None);
    // Between (-4.7123, 7.4804) and its mirror image.
    scenario.problem.shot.radius = 1.2e-3;
    let noted = validity::notes(&scenario, &settings, None);
    assert_close(find(&noted, "opening").unwrap().value, 2.4 / 9.4246, 1e-3);
    assert!(find(&noted, "fillet").unwrap().value > 1.0);
}

#[test]
fn restitution_is_compared_with_the_speed_at_which_it_was_measured() {
    let falling = scenario(&[
        (
            "restitution: 0.5",
            "restitution: { value: 0.5, at: 4 m/s, exponent: 0.25 }",
        ),
        ("incidence: 90 deg", "incidence: 30 deg"),
        ("divergence: 4 deg", "divergence: 0 deg"),
    ]);
    let evaluation = evaluated(&falling);
    let noted = validity::notes(&falling, &held(&falling), Some(&evaluation));
    // 10 m/s at 30 deg arrive with 5 m/s.
    let note = find(&noted, "restitution_speed").unwrap();
    assert_close(note.value, 5.0 / 4.0, 1e-9);
    assert!(
        note.text.contains("5.00 m/s") && !note.text.contains("measure it nearer"),
        "{}",
        note.text
    );
    // 0.5 (5/4)^(-1/4)
    assert!(note.text.contains("gives 0.473"), "{}", note.text);
    assert_eq!(find(&noted, "constant_restitution"), None);

    let far = scenario(&[
        (
            "restitution: 0.5",
            "restitution: { value: 0.5, at: 1 m/s, exponent: 0.25 }",
        ),
        ("divergence: 4 deg", "divergence: 0 deg"),
    ]);
    let noted = validity::notes(&far, &held(&far), Some(&evaluated(&far)));
    let note = find(&noted, "restitution_speed").unwrap();
    assert_close(note.value, 10.0, 1e-9);
    assert!(note.text.contains("measure it nearer"), "{}", note.text);

    assert_eq!(value(&scenario(&[]), "constant_restitution"), 0.5);
}
