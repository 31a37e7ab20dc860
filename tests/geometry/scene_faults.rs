//! Scenes against closed forms, against each other, and the rules that surfaces may have.

use nalgebra::{Point2, Point3, UnitQuaternion, Vector3};
use peenpose::evaluate::{Evaluation, evaluate};
use peenpose::impact::Contact;
use peenpose::jet::{Pose, Replicates, Samples, ShotSample, Stream};
use peenpose::objective::Tally;
use peenpose::problem::Problem;
use peenpose::problem::equipment::{Body, Nozzle, Role, SurfaceRule};
use peenpose::problem::part::{Ends, Part, Place, Segment, Shape, Target};
use peenpose::problem::setting::Settings;
use peenpose::scenario::Scenario;
use peenpose::scene::ray::Ray;
use peenpose::scene::{Scene, Walls};
use peenpose::trace::{PathImpact, Tracer};
use peenpose::verdict::{Subject, Verdict};

use crate::common::shipped;

fn settings(incidence_deg: f64, azimuth_deg: f64, standoff: f64) -> Settings {
    Settings {
        incidence: incidence_deg.to_radians(),
        azimuth: azimuth_deg.to_radians(),
        standoff,
        speed: 10.0,
        aim_along: 0.0,
        aim_across: 0.0,
        aim_above: 0.0,
        contact: 1,
        static_friction: 0.0,
    }
}

/// Settings whose shots hit everything there is.
fn choices() -> [Settings; 5] {
    [
        settings(67.0, 0.0, 8e-3),
        settings(45.0, 35.0, 12e-3),
        settings(35.0, 80.0, 15e-3),
        settings(85.0, -20.0, 18e-3),
        settings(30.0, -60.0, 20e-3),
    ]
}

fn exact(problem: Problem) -> Scenario {
    Scenario::new(problem, Walls::Exact).unwrap()
}

fn objective(scenario: &Scenario, settings: &Settings) -> f64 {
    let samples = Samples::new(&scenario.problem, Stream::Search, 4096);
    let tally = Tally::trace(scenario, settings, settings.speed, &samples.shots);
    tally.terms(&scenario.problem.goals, settings.speed).total()
}

fn same_objective(one: &Scenario, other: &Scenario) {
    for settings in choices() {
        let (a, b) = (objective(one, &settings), objective(other, &settings));
        assert!((a - b).abs() <= 1e-9 * a, "{settings:?}: {a} {b}");
    }
}

fn gap(scene: &Scene, body: Body, exit: Point3<f64>, jet: Vector3<f64>) -> f64 {
    let nozzle = Nozzle {
        body: vec![body],
        clearance: 0.0,
    };
    scene
        .clearance(&nozzle, &exit, &jet, f64::INFINITY)
        .unwrap()
        .0
}

#[test]
fn a_ball_and_a_lance_in_a_keyway_keep_the_distance_of_the_drawing() {
    let scenario = exact(crate::common::keyway(40e-3));
    let scene = &scenario.scene;
    let ball = Body::Ball { radius: 3e-3 };
    let jet = Vector3::y();
    // Chords of 1 degree lie up to 0.6 um inside the bore.
    let near = |found: f64, expected: f64| {
        assert!((found - expected).abs() < 1e-6, "{found}, not {expected}");
    };
    let at = |x: f64, y: f64| Point3::new(x * 1e-3, y * 1e-3, 20e-3);
    near(gap(scene, ball, at(0.0, 0.0), jet), 12e-3);
    near(
        gap(scene, ball, at(-9.0, -4.0), jet),
        12e-3 - 9.0_f64.hypot(4.0) * 1e-3,
    );
    // Under the groove the edges of the lips are nearest: (4, sqrt(15^2 - 4^2)) mm.
    let lip = 209.0_f64.sqrt();
    near(
        gap(scene, ball, at(0.0, 12.0), jet),
        4.0_f64.hypot(lip - 12.0) * 1e-3 - 3e-3,
    );
    // In the groove the floor or a wall is nearest.
    near(gap(scene, ball, at(0.0, 15.0), jet), 3.3e-3 - 3e-3);
    near(gap(scene, ball, at(1.5, 16.0), jet), 2.3e-3 - 3e-3);
    near(gap(scene, ball, at(2.5, 15.0), jet), 1.5e-3 - 3e-3);
    // Beyond the open end the rim of the bore is nearest.
    let outside = Point3::new(0.0, -15e-3, 44e-3);
    near(gap(scene, ball, outside, jet), 1e-3);
    // A lance along the bore is as near as the ball at its end; across, its far end decides.
    let lance = |direction| Body::Capsule {
        length: 10e-3,
        radius: 3e-3,
        direction,
    };
    near(
        gap(scene, lance(Some(Vector3::z())), at(0.0, 0.0), jet),
        12e-3,
    );
    near(
        gap(scene, lance(Some(-Vector3::x())), at(0.0, 0.0), jet),
        2e-3,
    );
    // Without a direction of its own it lies back along the jet.
    near(gap(scene, lance(None), at(0.0, 0.0), jet), 2e-3);
    // Through a wall the distance is 0, less the radius.
    let through = Body::Capsule {
        length: 40e-3,
        radius: 3e-3,
        direction: Some(Vector3::x()),
    };
    near(gap(scene, through, at(0.0, 0.0), jet), -3e-3);
}

#[test]
fn a_lance_along_a_blind_keyway_keeps_the_distance_of_the_drawing() {
    let scenario = shipped::scenario("keyway-blind.yaml");
    let mut checked = 0;
    for incidence in [42.0, 50.0, 63.0, 75.0, 85.0] {
        for azimuth in [-55.0, -20.0, 0.0, 10.0, 40.0] {
            for standoff in [6.5e-3, 8e-3, 12e-3, 19e-3] {
                let settings = settings(incidence, azimuth, standoff);
                let pose = Pose::new(&scenario.target.frame, &settings);
                let nozzle = &scenario.problem.nozzle;
                let found = scenario
                    .scene
                    .clearance(nozzle, &pose.exit, &pose.direction, f64::INFINITY)
                    .unwrap()
                    .0;
                // The lance passes through the round bore in front of the groove.
                let (s, inc, az) = (standoff * 1e3, settings.incidence, settings.azimuth);
                let from_axis = (s * inc.cos() * az.sin()).hypot(18.3 - s * inc.sin());
                let expected = (15.0 - 3.0 - from_axis) * 1e-3;
                if found > 0.0 || expected > 0.0 {
                    // Facets of at most 2 degrees lie up to 2.3 um inside the bore.
                    assert!(
                        (found - expected).abs() < 3e-6,
                        "{settings:?}: {found}, not {expected}"
                    );
                    checked += 1;
                }
            }
        }
    }
    assert!(checked > 40, "{checked}");
}

#[test]
fn a_scene_that_is_moved_as_a_whole_gives_the_same_objective() {
    let plain = crate::common::keyway(40e-3);
    // A box of the target would have to turn as well.
    let plain = Problem {
        target: Target {
            within: None,
            ..plain.target
        },
        ..plain
    };
    let place = Place {
        rotation: UnitQuaternion::from_euler_angles(0.3, -1.1, 2.0),
        shift: Vector3::new(0.01, -0.2, 0.07),
    };
    let moved = |point: Point3<f64>| place.rotation * point + place.shift;
    let mut problem = plain.clone();
    problem.parts[0].place = place;
    problem.target.aim = problem.target.aim.map(moved);
    problem.target.along = problem.target.along.map(|along| place.rotation * along);
    same_objective(&exact(plain.clone()), &exact(problem));
    // Rotations come first, about x, then y, then z; a quarter turn keeps boxes.
    let mut problem = crate::common::keyway(40e-3);
    problem.parts[0].place = Place {
        rotation: UnitQuaternion::from_euler_angles(0.0, 0.0, -std::f64::consts::FRAC_PI_2),
        shift: Vector3::new(0.0, 0.0, -20e-3),
    };
    problem.target.aim = Some(Point3::new(18.3e-3, 0.0, 0.0));
    problem.target.within = Some((
        Point3::new(18e-3, -3e-3, -5e-3),
        Point3::new(19e-3, 3e-3, 5e-3),
    ));
    same_objective(&exact(crate::common::keyway(40e-3)), &exact(problem));
}

#[test]
fn surfaces_are_two_sided() {
    let mut problem = crate::common::keyway(40e-3);
    problem.jet.divergence = 0.0;
    problem.jet.exit_diameter = 0.0;
    problem.jet.speed_spread = 0.0;
    problem.parts = vec![Part {
        name: "pin".into(),
        shape: Shape::Bore {
            diameter: 12e-3,
            length: 48e-3,
            ends: Ends::default(),
            free: None,
        },
        place: Place::default(),
        on_nozzle: false,
        cut: Vec::new(),
    }];
    problem.target = Target {
        lengths_in: Default::default(),
        surface: "pin.wall".into(),
        within: None,
        aim: Some(Point3::new(0.0, 6e-3, 24e-3)),
        aim_key: "target.aim",
        along: Some(Vector3::z()),
        facing: None,
    };
    let bore = exact(problem.clone());
    problem.target.facing = Some(Vector3::y());
    let pin = exact(problem);
    assert!((bore.target.frame.normal + Vector3::y()).norm() < 1e-9);
    assert!((pin.target.frame.normal - Vector3::y()).norm() < 1e-9);
    for scenario in [&bore, &pin] {
        let settings = settings(60.0, 0.0, 5e-3);
        let path = path(scenario, &settings, &ShotSample::NONE);
        let shot = scenario.problem.shot.mass();
        let expected = shot * 1.25 * 10.0 * 60.0_f64.to_radians().sin();
        assert!((path[0].normal_impulse / expected - 1.0).abs() < 1e-9);
        assert!(path[0].on_target);
    }
    // Inside, the shot flies on to the other side of the bore; outside it is gone.
    assert!(path(&bore, &settings(60.0, 0.0, 5e-3), &ShotSample::NONE).len() > 1);
    assert_eq!(
        path(&pin, &settings(60.0, 0.0, 5e-3), &ShotSample::NONE).len(),
        1
    );
}

fn path(scenario: &Scenario, settings: &Settings, sample: &ShotSample) -> Vec<PathImpact> {
    let mut path = Vec::new();
    Tracer::new(scenario, settings, settings.speed).follow(sample, |impact| path.push(*impact));
    path
}

fn paths(scenario: &Scenario, settings: &Settings) -> Vec<Vec<PathImpact>> {
    let samples = Samples::new(&scenario.problem, Stream::Search, 4096);
    samples
        .shots
        .iter()
        .map(|sample| path(scenario, settings, sample))
        .collect()
}

fn surface(scenario: &Scenario, name: &str) -> usize {
    scenario.scene.surface_named(name).unwrap() as usize
}

#[test]
fn the_rest_of_a_target_surface_is_secondary() {
    let whole = crate::common::keyway(40e-3);
    let whole = Problem {
        target: Target {
            within: None,
            ..whole.target
        },
        ..whole
    };
    let narrow = Problem {
        target: Target {
            within: Some((
                Point3::new(-3e-3, 18e-3, 19.5e-3),
                Point3::new(3e-3, 19e-3, 20.5e-3),
            )),
            ..whole.target.clone()
        },
        ..whole.clone()
    };
    let (whole, narrow) = (exact(whole), exact(narrow));
    let settings = settings(67.0, 0.0, 8e-3);
    let found = |scenario: &Scenario| -> Evaluation {
        evaluate(
            scenario,
            &settings,
            &Replicates::new(&scenario.problem, 0, 8192),
        )
    };
    let (on_whole, on_narrow) = (found(&whole), found(&narrow));
    assert_eq!(on_whole.target.hits, on_whole.shots);
    assert!(on_narrow.target.hits > 1000 && on_narrow.target.hits < on_narrow.shots - 1000);
    let floor = surface(&narrow, "hub.floor");
    let direct = on_narrow.surfaces[floor].impacts_by_number[0];
    assert_eq!(direct + on_narrow.target.hits, on_narrow.shots);
    assert!(on_whole.surfaces[floor].impacts_by_number.is_empty());
    // All of those are far above what a secondary surface may take.
    assert_eq!(on_narrow.surfaces[floor].over_by_number[0], direct);
    let miss = |scenario: &Scenario, evaluation: &Evaluation| {
        let verdicts = Verdict::all(scenario, evaluation);
        *verdicts
            .iter()
            .find(|verdict| verdict.subject == Subject::Miss)
            .unwrap()
    };
    assert_eq!(miss(&narrow, &on_narrow).broken, direct);
    assert_eq!(miss(&whole, &on_whole).broken, 0);
    // The term is an average over other shots as well.
    let expected = 2.0 * direct as f64 / on_narrow.shots as f64;
    assert!((on_narrow.terms.miss - expected).abs() < 6.0 * on_narrow.term_errors.miss);
}

#[test]
fn a_root_radius_is_a_round_between_floor_and_walls() {
    let radius = 0.6e-3;
    let mut problem = crate::common::keyway(40e-3);
    let Shape::Keyway(keyway) = &mut problem.parts[0].shape else {
        unreachable!()
    };
    keyway.root_radius = radius;
    let round = exact(problem.clone());
    let sharp = exact(crate::common::keyway(40e-3));
    for name in ["hub.root_neg", "hub.root_pos"] {
        assert!(round.scene.surface_named(name).is_ok());
        assert!(sharp.scene.surface_named(name).is_err());
    }
    for side in [-1.0, 1.0] {
        let centre = Point3::new(side * (4e-3 - radius), 18.3e-3 - radius, 20e-3);
        for turn in [10.0_f64, 45.0, 80.0].map(f64::to_radians) {
            let outwards = Vector3::new(side * turn.cos(), turn.sin(), 0.0);
            let ray = Ray {
                origin: centre,
                direction: outwards,
            };
            let hit = round.scene.first_hit(&ray, None).unwrap();
            let name = if side < 0.0 {
                "hub.root_neg"
            } else {
                "hub.root_pos"
            };
            assert_eq!(hit.surface as usize, surface(&round, name));
            assert!((hit.distance - radius).abs() < 1e-12);
            assert!((hit.normal + outwards).norm() < 1e-9);
        }
    }
    // Floor and walls end where the round begins.
    let down = |x: f64| {
        let ray = Ray {
            origin: Point3::new(x, 15e-3, 20e-3),
            direction: Vector3::y(),
        };
        round.scene.first_hit(&ray, None).unwrap().surface as usize
    };
    assert_eq!(down(4e-3 - radius - 1e-9), surface(&round, "hub.floor"));
    assert_eq!(down(4e-3 - radius + 1e-9), surface(&round, "hub.root_pos"));
    // Facets of it give the same objective.
    agree_within_errors(&round, &faceted(problem, 1.0), FACETS_OF_ONE_DEGREE);
}

/// The objective on independent shots agrees within three standard errors, and `slack` of it for
/// what facets do to the scene itself.
fn agree_within_errors(one: &Scenario, other: &Scenario, slack: f64) {
    for settings in choices() {
        let (a, b) = (
            evaluate(one, &settings, &Replicates::new(&one.problem, 0, 1 << 15)),
            evaluate(
                other,
                &settings,
                &Replicates::new(&other.problem, 500, 1 << 15),
            ),
        );
        let error = a.standard_error.hypot(b.standard_error);
        let (a, b) = (a.terms.total(), b.terms.total());
        let allowed = 3.0 * error + slack * a;
        assert!((a - b).abs() < allowed, "{settings:?}: {a} {b} +- {error}");
    }
}

/// Facets turn rebounds by up to half a degree each. At settings where most shots end up in the
/// bore that changes J by this much; it goes away with finer facets.
const FACETS_OF_ONE_DEGREE: f64 = 3e-3;

fn faceted(problem: Problem, chord_deg: f64) -> Scenario {
    let chord_angle = chord_deg.to_radians();
    Scenario::new(problem, Walls::TriangleMesh { chord_angle }).unwrap()
}

#[test]
fn facets_agree_with_exact_walls_within_the_errors() {
    for length in [40e-3, 200e-3] {
        let problem = crate::common::keyway(length);
        let walls = exact(problem.clone());
        agree_within_errors(&walls, &faceted(problem.clone(), 1.0), FACETS_OF_ONE_DEGREE);
        agree_within_errors(&walls, &faceted(problem, 0.1), FACETS_OF_ONE_DEGREE / 10.0);
    }
}

/// The section of the keyway as lines and an arc.
fn outline() -> Vec<Segment> {
    let lip = 209.0_f64.sqrt() * 1e-3;
    let [right, left] = [4e-3, -4e-3].map(|x| [Point2::new(x, lip), Point2::new(x, 18.3e-3)]);
    let segment = |from: Point2<f64>, to: Point2<f64>, surface: &str| Segment {
        from,
        to,
        via: None,
        surface: surface.into(),
    };
    vec![
        segment(right[0], right[1], "wall_pos"),
        segment(right[1], left[1], "floor"),
        segment(left[1], left[0], "wall_neg"),
        Segment {
            via: Some(Point2::new(0.0, -15e-3)),
            ..segment(left[0], right[0], "bore")
        },
    ]
}

#[test]
fn an_extruded_section_is_the_keyway() {
    for length in [40e-3, 200e-3] {
        let mut problem = crate::common::keyway(length);
        problem.parts[0].shape = Shape::Extrude {
            profile: outline(),
            length,
            ends: Ends::default(),
        };
        same_objective(&exact(crate::common::keyway(length)), &exact(problem));
    }
}

#[test]
fn a_closed_end_stops_what_would_leave() {
    let mut problem = crate::common::keyway(40e-3);
    problem.parts[0].shape = Shape::Extrude {
        profile: outline(),
        length: 40e-3,
        ends: Ends {
            near_closed: false,
            far_closed: true,
        },
    };
    let (open, closed) = (exact(crate::common::keyway(40e-3)), exact(problem));
    let settings = settings(67.0, 0.0, 8e-3);
    let far = surface(&closed, "hub.far") as u32;
    let mut stopped = 0;
    for (open_path, closed_path) in paths(&open, &settings)
        .iter()
        .zip(paths(&closed, &settings))
    {
        match closed_path.iter().position(|impact| impact.surface == far) {
            Some(at) => {
                stopped += 1;
                let impact = &closed_path[at];
                assert!((impact.point.z - 40e-3).abs() < 1e-12);
                assert!(impact.velocity.z < 0.0);
                assert_eq!(open_path.len(), at, "without the cap the path ends here");
            }
            None => assert_eq!(open_path.len(), closed_path.len()),
        }
    }
    assert!(stopped > 1000, "{stopped}");
}

fn rule(surface: &str) -> SurfaceRule {
    SurfaceRule {
        surface: surface.into(),
        allow: None,
        share: None,
        weight: None,
        contact: None,
        roughness: 0.0,
        library: None,
        role: Role::Part,
    }
}

fn with_rules(rules: &[SurfaceRule]) -> Scenario {
    exact(Problem {
        surfaces: rules.to_vec(),
        ..crate::common::keyway(40e-3)
    })
}

/// The same with the whole floor as the target.
fn with_rules_and_whole_floor(rules: &[SurfaceRule]) -> Scenario {
    let mut problem = Problem {
        surfaces: rules.to_vec(),
        ..crate::common::keyway(40e-3)
    };
    problem.target.within = None;
    exact(problem)
}

#[test]
fn hits_on_a_deflector_belong_to_the_flight() {
    let plain = with_rules_and_whole_floor(&[]);
    let walls = ["hub.wall_neg", "hub.wall_pos"];
    let rules = walls.map(|wall| SurfaceRule {
        role: Role::Deflector,
        ..rule(wall)
    });
    let deflecting = with_rules_and_whole_floor(&rules);
    let is_wall = |impact: &PathImpact| {
        walls
            .iter()
            .any(|wall| surface(&plain, wall) == impact.surface as usize)
    };
    let settings = Settings {
        aim_across: 3.5e-3,
        aim_above: 0.0,
        ..settings(60.0, 90.0, 15e-3)
    };
    let mut banked = 0;
    for (before, after) in paths(&plain, &settings)
        .iter()
        .zip(paths(&deflecting, &settings))
    {
        assert!(!after.iter().any(is_wall));
        assert!(
            after
                .iter()
                .enumerate()
                .all(|(index, impact)| impact.number == index + 1)
        );
        // The same flight, as far as both are followed.
        for (one, other) in before.iter().filter(|impact| !is_wall(impact)).zip(&after) {
            assert_eq!((one.surface, one.point), (other.surface, other.point));
            assert_eq!(one.normal_impulse, other.normal_impulse);
        }
        let starts_at_wall = before.first().is_some_and(is_wall);
        banked += usize::from(starts_at_wall && after.first().is_some_and(|hit| hit.on_target));
    }
    assert!(banked > 100, "{banked}");
    let (before, after) = (
        evaluate(&plain, &settings, &Replicates::new(&plain.problem, 0, 4096)),
        evaluate(
            &deflecting,
            &settings,
            &Replicates::new(&deflecting.problem, 0, 4096),
        ),
    );
    assert!(after.target.hits > before.target.hits);
    assert!(after.terms.miss < before.terms.miss);
    for wall in walls {
        let index = surface(&deflecting, wall);
        assert_eq!(after.surfaces[index].shots, 0);
        let subject = Subject::Surface(index as u32);
        let about = |verdicts: Vec<Verdict>| verdicts.iter().any(|v| v.subject == subject);
        assert!(about(Verdict::all(&plain, &before)));
        assert!(!about(Verdict::all(&deflecting, &after)));
    }
}

#[test]
fn a_surface_may_have_its_own_contact() {
    let plain = with_rules(&[]);
    let dead = Contact::new(0.8, 0.7, 0.0).unwrap();
    let deadened = with_rules(&[SurfaceRule {
        contact: Some(dead),
        ..rule("hub.floor")
    }]);
    for contact in 0..3 {
        let settings = Settings {
            contact,
            ..settings(67.0, 0.0, 8e-3)
        };
        for (before, after) in paths(&plain, &settings)
            .iter()
            .zip(paths(&deadened, &settings))
        {
            // (1 + E) m v_n with E = 0 in place of 0.25; there the shot stays.
            assert!((after[0].normal_impulse * 1.25 / before[0].normal_impulse - 1.0).abs() < 1e-9);
            assert_eq!(after.len(), 1);
        }
    }
    // Other surfaces keep the contact that is chosen.
    let mask = with_rules(&[SurfaceRule {
        contact: Some(dead),
        ..rule("hub.wall_pos")
    }]);
    same_first_hits(&plain, &mask);
}

fn same_first_hits(one: &Scenario, other: &Scenario) {
    let settings = settings(67.0, 0.0, 8e-3);
    for (a, b) in paths(one, &settings).iter().zip(paths(other, &settings)) {
        assert_eq!(a[0], b[0]);
    }
}

#[test]
fn a_surface_may_have_its_own_limits() {
    let settings = settings(35.0, 80.0, 15e-3);
    let strict = SurfaceRule {
        allow: Some(2e-6),
        share: Some(0.001),
        weight: Some(3.0),
        ..rule("hub.bore")
    };
    let mut scenario = with_rules(&[strict]);
    scenario.problem.jet.speed_spread = 0.0;
    let bore = surface(&scenario, "hub.bore") as u32;
    let (mut harm, mut over) = (0.0, 0);
    let paths = paths(&scenario, &settings);
    for path in &paths {
        over += usize::from(
            path.iter()
                .any(|i| i.surface == bore && i.normal_impulse > 2e-6),
        );
        for impact in path.iter().filter(|impact| !impact.on_target) {
            let (weight, allow) = if impact.surface == bore {
                (3.0, 2e-6)
            } else {
                (0.5, 10e-6)
            };
            harm += weight * (impact.normal_impulse / allow).powi(2) / paths.len() as f64;
        }
    }
    let samples = Samples::new(&scenario.problem, Stream::Search, 4096);
    let tally = Tally::trace(&scenario, &settings, settings.speed, &samples.shots);
    let found = tally.terms(&scenario.problem.goals, settings.speed).rebound;
    assert!((found / harm - 1.0).abs() < 1e-9, "{found} {harm}");
    let evaluation = evaluate(
        &scenario,
        &settings,
        &Replicates::new(&scenario.problem, 0, 1 << 14),
    );
    let verdicts = Verdict::all(&scenario, &evaluation);
    let verdict = verdicts
        .iter()
        .find(|v| v.subject == Subject::Surface(bore))
        .unwrap();
    assert_eq!(verdict.allowed, 0.001);
    let share = over as f64 / paths.len() as f64;
    assert!(
        (verdict.share() - share).abs() < 0.03,
        "{} {share}",
        verdict.share()
    );
    assert!(share > 0.01);
}

#[test]
fn rules_for_a_surface_that_is_not_there_are_a_fault() {
    let problem = Problem {
        surfaces: vec![rule("hub.brim")],
        ..crate::common::keyway(40e-3)
    };
    let Err(faults) = Scenario::new(problem, Walls::Exact) else {
        panic!("it must be refused")
    };
    assert_eq!(faults.len(), 1);
    assert_eq!(faults[0].key, "surfaces.hub.brim");
    assert!(
        faults[0]
            .to_string()
            .contains("there is no surface `hub.brim`")
    );
}
