//! Starts on surfaces, wedges and corners, and rooms with a small way out.

use std::path::Path;

use nalgebra::{Point3, Vector3};
use peenpose::evaluate::evaluate;
use peenpose::jet::Replicates;
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::scene::ray::Ray;
use peenpose::trace::End;

use crate::common::held::held;
use crate::stability::{PLATE, Random, edited, path, scenario, setup_beside};

const PLATE_PART: &str = "plate: { box: { min: [-50, -50, -10], max: [50, 50, 0] } }";
const PLATE_TARGET: &str = "plate.z_max, aim: [0, 0, 0], along: [1, 0, 0]";

/// A wedge of this angle along z, its apex at the origin and its mouth at x = 50 mm; `Walls` say
/// whether it is two planes or triangles.
fn wedge(angle: f64, walls: Walls) -> Scenario {
    let (x, y) = (50.0 * (angle / 2.0).cos(), 50.0 * (angle / 2.0).sin());
    let part = format!(
        "plate: {{ extrude: {{ length: 40 mm, ends: open, profile: [
      {{ from: [{x:?}, {y:?}], line_to: [0, 0], surface: upper }},
      {{ line_to: [{x:?}, {:?}], surface: lower }} ] }} }}",
        -y
    );
    let text = edited(
        PLATE,
        &[
            (PLATE_PART, &part),
            (PLATE_TARGET, "plate.upper, along: [0, 0, 1]"),
        ],
    );
    setup_beside(Path::new("."), &text, walls)
}

/// How often an elastic point without friction hits the walls of a wedge before it is 50 mm from
/// the apex: unfolded it flies straight, through walls at every odd multiple of half the angle.
fn unfolded(angle: f64, origin: Point3<f64>, direction: Vector3<f64>) -> usize {
    let (start, heading) = (origin.coords.xy(), direction.xy().normalize());
    let polar = |at: f64| {
        let along = start.dot(&heading);
        let across = start.perp(&heading);
        // Angle turned round the apex since the start, and the distance from it.
        let point = start + heading * at;
        let turned = ((along + at).atan2(across.abs())) - along.atan2(across.abs());
        (turned, point.norm())
    };
    let first = start.y.atan2(start.x);
    let side = start.perp(&heading).signum();
    let end = (0.05_f64.powi(2) - start.perp(&heading).powi(2)).sqrt() - start.dot(&heading);
    let (turned, _) = polar(end);
    let last = side * first + turned;
    // Walls at (k + 1/2) angle between the two.
    ((last / angle + 0.5).floor() - (side * first / angle + 0.5).floor()) as usize
}

#[test]
fn shots_come_out_of_a_wedge_after_as_many_hits_as_unfolding_says() {
    for walls in [Walls::Exact, Walls::TriangleMesh { chord_angle: 0.1 }] {
        for angle in [1.0_f64, 7.3, 36.5, 91.0] {
            let angle = angle.to_radians();
            let scene = wedge(angle, walls).scene;
            for aside in [1e-3, 1e-5, -1e-7, 1e-8] {
                for slope in [0.0, 0.3] {
                    let origin = Point3::new(0.04, 0.2 * aside, 0.02);
                    // Passes the apex at about `aside`.
                    let at = Point3::new(0.0, aside, 0.02 + slope * 0.002);
                    let mut ray = Ray {
                        origin,
                        direction: (at - origin).normalize(),
                    };
                    let expected = unfolded(angle, origin, ray.direction);
                    let (mut leaving, mut hits) = (None, 0);
                    while let Some(hit) = scene.first_hit(&ray, leaving) {
                        hits += 1;
                        assert!(hits <= expected, "{angle} {aside} {walls:?}");
                        let into = ray.direction.dot(&hit.normal);
                        let p = hit.point;
                        assert!(p.x > 0.0 && p.y.abs() <= p.x * (angle / 2.0).tan() + 1e-12);
                        ray = Ray {
                            origin: p,
                            direction: (ray.direction - hit.normal * (2.0 * into)).normalize(),
                        };
                        leaving = Some(hit.hit_id);
                    }
                    assert_eq!(hits, expected, "{angle} {aside} {walls:?}");
                }
            }
        }
    }
    // The narrow wedge turns a shot back in half a turn: 180 times 1 degree.
    let ray = Vector3::new(-1.0, 1e-6, 0.0);
    let expected = unfolded(1_f64.to_radians(), Point3::new(0.04, 0.0, 0.02), ray);
    assert!((178..=180).contains(&expected), "{expected}");
}

/// Who starts rebounds a little above the wall starts some of them beyond the wall opposite.
#[test]
fn an_offset_along_the_normal_leaves_a_wedge_through_its_wall() {
    const OFFSET: f64 = 1e-6;
    let angle = 1_f64.to_radians();
    let scene = wedge(angle, Walls::Exact).scene;
    let mut ray = Ray {
        origin: Point3::new(0.04, 0.0, 0.02),
        direction: Vector3::new(-1.0, 1e-7, 0.0).normalize(),
    };
    let expected = unfolded(angle, ray.origin, ray.direction);
    let (mut hits, mut outside) = (0, 0);
    while let Some(hit) = scene.first_hit(&ray, None) {
        hits += 1;
        let into = ray.direction.dot(&hit.normal);
        ray = Ray {
            origin: ray.origin + ray.direction * hit.distance + hit.normal * OFFSET,
            direction: ray.direction - hit.normal * (2.0 * into),
        };
        outside += usize::from(ray.origin.y.abs() > ray.origin.x * (angle / 2.0).tan());
        if hits > 1000 {
            break;
        }
    }
    assert!(
        outside > 0 && hits != expected,
        "{outside} {hits} {expected}"
    );
}

/// A room with walls as they are: restitution, friction and spin.
fn room(contact: &str, paths: &str) -> Scenario {
    scenario(&edited(
        PLATE,
        &[
            (
                "min: [-50, -50, -10], max: [50, 50, 0]",
                "min: [-10, -10, -10], max: [10, 10, 10]",
            ),
            ("aim: [0, 0, 0]", "aim: [0, 0, 10], facing: [0, 0, -1]"),
            ("mu_s: 0.15, mu_d: 0.075, restitution: 0.25", contact),
            ("goals:", &format!("paths: {paths}\ngoals:")),
        ],
    ))
}

/// Into corners, along edges and at random: nothing leaves, nothing gains energy, and every path
/// ends by its energy or at the limit.
#[test]
fn shots_rattle_in_corners_until_they_are_spent() {
    let room = room(
        "mu_s: 0.3, mu_d: 0.2, restitution: 0.9",
        "{ impacts: 1000, least_energy: 0.1 % }",
    );
    let mut random = Random(31);
    let mut ends = [0, 0];
    for number in 0..300 {
        let origin = Point3::from(random.vector() * 8e-3);
        let mut at = random.vector().map(f64::signum) * 10e-3;
        // Corners, then edges, then corners missed by a hair.
        match number % 3 {
            0 => {}
            1 => at.z = 9e-3 * random.signed(),
            _ => at += random.vector() * 1e-9,
        }
        let (impacts, end) = path(&room, origin, at - origin.coords);
        match end {
            End::Spent => ends[0] += 1,
            End::Limit => ends[1] += 1,
            _ => panic!("{number} {end:?} after {}", impacts.len()),
        }
        assert!(impacts.len() >= 2);
        let mut before = 50.0 * (1.0 + 1e-12);
        for impact in &impacts {
            assert!(impact.point.coords.amax() <= 10e-3 + 1e-14);
            let energy = 0.5 * impact.velocity.norm_squared() + 0.2 * impact.rolling.norm_squared();
            assert!(energy <= before);
            before = energy * (1.0 + 1e-14);
        }
    }
    assert_eq!(ends[0] + ends[1], 300);
    assert!(ends[0] > 200, "{ends:?}");
}

/// What leaves a surface, in whatever direction away from it, does not hit it again at once.
#[test]
fn a_start_on_a_surface_is_no_hit() {
    let block = room("mu_s: 0.3, mu_d: 0.2, restitution: 0.9", "{ impacts: 2 }");
    let bore = scenario(&edited(
        PLATE,
        &[
            (
                PLATE_PART,
                "plate: { bore: { diameter: 20 mm, length: 20 mm, ends: closed } }",
            ),
            (PLATE_TARGET, "plate.near, aim: [0, 0, 0], along: [1, 0, 0]"),
        ],
    ));
    let mut random = Random(32);
    for (scene, middle) in [(&block.scene, 0.0), (&bore.scene, 10e-3)] {
        for _ in 0..5000 {
            let ray = Ray {
                origin: Point3::new(0.0, 0.0, middle) + random.vector() * 2e-3,
                direction: random.vector().normalize(),
            };
            let hit = scene.first_hit(&ray, None).unwrap();
            let sideways = random.vector().cross(&hit.normal).normalize();
            for rise in [1.0, 1e-2, 1e-5, 1e-9] {
                let direction = (sideways + hit.normal * rise).normalize();
                let away = Ray {
                    origin: hit.point,
                    direction,
                };
                let next = scene.first_hit(&away, Some(hit.hit_id)).unwrap();
                // Never the piece that it left, unless that is round: then a chord of it, across
                // 2 R times the sine of its rise.
                if next.hit_id.piece == hit.hit_id.piece {
                    let turned = 1.0 - next.normal.dot(&hit.normal);
                    let chord = 2.0 * 10e-3 * direction.dot(&hit.normal);
                    assert!(
                        next.distance > 0.9 * chord && turned > 0.0,
                        "{rise}: {next:?}"
                    );
                }
                assert!(next.normal.dot(&direction) < 0.0);
            }
            // Exactly on it, as a nozzle may stand that takes no room: not hit on the way out.
            let start = Ray {
                origin: hit.point,
                direction: hit.normal,
            };
            let across = scene.first_hit(&start, None).unwrap();
            assert!(across.distance > 1e-3, "{across:?}");
        }
    }
}

/// A bore that is closed but for a slit between its wall and a plug.
fn nearly_closed(contact: &str, paths: &str) -> Scenario {
    scenario(&edited(
        PLATE,
        &[
            (
                PLATE_PART,
                "plate: { bore: { diameter: 12 mm, length: 20 mm, ends: { far: closed } } }
  plug: { box: { min: [-7, -7, -1], max: [5.5, 7, 0] } }",
            ),
            (PLATE_TARGET, "plate.far, aim: [0, 0, 20], along: [1, 0, 0]"),
            // Small enough for the slit, whether or not shots fly as spheres.
            ("radius: 0.5 mm", "radius: 0.05 mm"),
            ("40 uN.s", "0.04 uN.s"),
            ("divergence: 0 deg", "divergence: 30 deg"),
            ("mu_s: 0.15, mu_d: 0.075, restitution: 0.25", contact),
            (
                "goals:",
                &format!("paths: {paths}\ngoals:\n  rebound: {{ allow: 0.005 uN.s }}"),
            ),
        ],
    ))
}

#[test]
fn paths_in_a_nearly_closed_bore_end_and_are_counted() {
    let cases = [
        // Without losses only the slit or the limit ends a path.
        (
            "mu_s: 0, mu_d: 0, restitution: 1",
            "{ impacts: 200, least_energy: 1 % }",
            [true, true, false],
        ),
        // With losses all of them are spent at last, if they do not leave.
        (
            "mu_s: 0.3, mu_d: 0.27, restitution: 0.8",
            "{ impacts: 1000, least_energy: 1 % }",
            [true, false, true],
        ),
        // So few that no path is spent before.
        (
            "mu_s: 0.1, mu_d: 0.1, restitution: 0.95",
            "{ impacts: 3, least_energy: 1 % }",
            [true, true, false],
        ),
        (
            "mu_s: 0.1, mu_d: 0.1, restitution: 0",
            "{ impacts: 1000, least_energy: 0 % }",
            [false, false, false],
        ),
    ];
    for (contact, paths, which) in cases {
        let bore = nearly_closed(contact, paths);
        let evaluation = evaluate(
            &bore,
            &held(&bore),
            &Replicates::new(&bore.problem, 5, 4096),
        );
        let share = |end: End| evaluation.ends.get(&end).copied().unwrap_or(0.0);
        let sum: f64 = evaluation.ends.values().sum();
        assert!((sum - 1.0).abs() < 1e-12, "{:?}", evaluation.ends);
        let seen = [End::Left, End::Limit, End::Spent].map(|end| share(end) > 0.0);
        assert_eq!(seen, which, "{contact}: {:?}", evaluation.ends);
        let total = evaluation.terms.total();
        assert!(total.is_finite() && evaluation.standard_error.is_finite());
        let most = bore.problem.paths.impacts;
        let longest = evaluation
            .surfaces
            .iter()
            .map(|s| s.impacts_by_number.len())
            .max();
        assert!(longest.unwrap() <= most);
        assert!(evaluation.rays <= (evaluation.shots + evaluation.boundary_shots) * (most + 1));
    }
    // Through a slit of less than 4 % of the end, and with 200 impacts, some find the way out and
    // some do not.
    let bore = nearly_closed(cases[0].0, cases[0].1);
    let evaluation = evaluate(
        &bore,
        &held(&bore),
        &Replicates::new(&bore.problem, 5, 4096),
    );
    assert!(
        (0.05..0.99).contains(&evaluation.ends[&End::Left]),
        "{:?}",
        evaluation.ends
    );
}
