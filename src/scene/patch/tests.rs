use super::*;
use crate::problem::part::{Part, Place, Shape};
use crate::scene::Walls;

fn area(polygons: impl IntoIterator<Item = Polygon>) -> f64 {
    area_and_centre(polygons.into_iter()).0
}

fn plate(min: Point3<f64>, max: Point3<f64>) -> Scene {
    let part = Part {
        name: "plate".to_owned(),
        shape: Shape::Box { min, max },
        place: Place::default(),
        on_nozzle: false,
        cut: Vec::new(),
    };
    Scene::build(&[part], Walls::Exact).expect("it is sound")
}

/// The upper side of the plate.
fn upper_side() -> Target {
    Target {
        lengths_in: Default::default(),
        surface: "plate.z_max".to_owned(),
        within: None,
        aim: None,
        aim_key: "target.aim",
        along: None,
        facing: None,
    }
}

#[test]
fn a_triangle_is_cut_along_the_faces_of_a_box() {
    // Half of a square of 4 by 4.
    let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]].map(Point3::from);
    for (low, high, expected) in [
        ([0.0, 0.0, -1.0], [2.0, 2.0, 1.0], 4.0),
        ([1.0, 1.0, -1.0], [3.0, 3.0, 1.0], 2.0),
        ([-1.0, 1.0, -1.0], [5.0, 2.0, 1.0], 2.5),
        ([-1.0, -1.0, -1.0], [5.0, 5.0, 1.0], 8.0),
        ([0.5, 0.5, -1.0], [1.5, 1.0, 1.0], 0.5),
        ([3.0, 3.0, -1.0], [5.0, 5.0, 1.0], 0.0),
        ([0.0, 0.0, 1.0], [2.0, 2.0, 2.0], 0.0),
        ([0.0, 0.0, -2.0], [2.0, 2.0, -1.0], 0.0),
    ] {
        let (inside, outside) = split(&corners, &(low.into(), high.into()), 0.0);
        let within = area([inside.clone()]);
        assert!((within - expected).abs() < 1e-12, "{low:?}: {within}");
        let beyond = area(outside.clone());
        assert!(
            (beyond - (8.0 - expected)).abs() < 1e-12,
            "{low:?}: {beyond}"
        );
        let cut = outside.iter().flat_map(fan).map(|it| it.to_vec());
        assert!((area(cut) - beyond).abs() < 1e-12);
    }
}

#[test]
fn the_centre_of_a_patch_is_weighed_by_area() {
    let square = [
        [0.0, 0.0, 1.0],
        [2.0, 0.0, 1.0],
        [2.0, 2.0, 1.0],
        [0.0, 2.0, 1.0],
    ];
    let triangle = [[3.0, 0.0, 1.0], [6.0, 0.0, 1.0], [3.0, 0.0, 4.0]];
    let polygons = [square.to_vec(), triangle.to_vec()];
    let points = polygons.map(|it| it.into_iter().map(Point3::from).collect::<Polygon>());
    let (area, centre) = area_and_centre(points.into_iter());
    // 4 at (1, 1, 1), and 4.5 at (4, 0, 2).
    assert!((area - 8.5).abs() < 1e-12);
    let expected = Point3::new(22.0 / 8.5, 4.0 / 8.5, 13.0 / 8.5);
    assert!((centre - expected).norm() < 1e-12, "{centre}");
}

#[test]
fn a_patch_and_what_lies_round_it_are_the_whole_surface() {
    let scene = plate(Point3::origin(), Point3::new(4.0, 2.0, 1.0));
    for (within, inside) in [
        (None, 8.0),
        (Some(([1.0, 0.5, 0.0], [3.0, 1.0, 2.0])), 1.0),
        (Some(([2.0, -1.0, 0.0], [9.0, 9.0, 2.0])), 4.0),
        (Some(([-1.0, -1.0, 0.0], [9.0, 9.0, 2.0])), 8.0),
        // It lies in a face of the box, as drawings have it.
        (Some(([1.0, 0.5, 0.0], [3.0, 1.0, 1.0])), 1.0),
        (Some(([1.0, 0.5, 1.0], [3.0, 1.0, 2.0])), 1.0),
        (Some(([0.0, 0.0, 1.0], [4.0, 2.0, 1.0])), 8.0),
    ] {
        let target = Target {
            within: within.map(|(low, high)| (low.into(), high.into())),
            ..upper_side()
        };
        let patch = Patch::find(&scene, &target).expect("it is there");
        let (within, beyond) = patch.cut_out(&scene);
        let area = |triangles: Vec<Triangle>| area(triangles.into_iter().map(Into::into));
        assert!((patch.area - inside).abs() < 1e-12);
        assert!((area(within) - inside).abs() < 1e-12, "{target:?}");
        assert!((area(beyond) - (8.0 - inside)).abs() < 1e-12, "{target:?}");
    }
}

/// A plate seen from both sides; the front of its upper side looks up, and behind it is material.
#[test]
fn a_target_faces_the_side_that_is_asked_for() {
    let scene = plate(Point3::origin(), Point3::new(4.0, 2.0, 1.0));
    let up = Vector3::z();
    for (facing, expected) in [
        (None, up),
        (Some(Vector3::new(3.0, 0.0, 0.1)), up),
        (Some(Vector3::new(3.0, 0.0, -0.1)), -up),
        // Level with it: neither side is meant more than the other.
        (Some(Vector3::new(3.0, 0.0, 0.0)), up),
    ] {
        let target = Target {
            facing,
            ..upper_side()
        };
        let patch = Patch::find(&scene, &target).expect("it is there");
        assert!((patch.frame.normal - expected).norm() < 1e-12, "{facing:?}");
        assert_eq!(patch.in_material, expected == -up, "{facing:?}");
        assert!((patch.frame.aim - Point3::new(2.0, 1.0, 1.0)).norm() < 1e-12);
    }
}

#[test]
fn hits_are_on_the_target_in_its_box_and_on_its_surface() {
    let frame = Frame::new(Point3::origin(), Vector3::z(), None).expect("along x");
    let box_of = |within| Patch {
        surface: 3,
        within,
        front: true,
        in_material: false,
        slack: 1e-9,
        rounding: 1e-12,
        frame,
        area: 1.0,
    };
    let hit = |surface: u32, point: [f64; 3]| Hit {
        distance: 1.0,
        point: point.into(),
        normal: Vector3::z(),
        surface,
        hit_id: crate::scene::ray::HitId {
            part: 0,
            piece: 0,
            front: true,
        },
    };
    let limits = (Point3::new(-1.0, -2.0, -3.0), Point3::new(1.0, 2.0, 3.0));
    let (whole, part) = (box_of(None), box_of(Some(limits)));
    for axis in 0..3 {
        let reach = limits.1[axis];
        for (at, inside) in [
            (0.9, true),
            (1.0, true),
            (1.1, false),
            (-1.0, true),
            (-1.1, false),
        ] {
            let mut point = [0.5, 0.5, 0.5];
            point[axis] = at * reach;
            assert_eq!(part.holds(&hit(3, point)), inside, "{axis}, {at}");
            assert!(!part.holds(&hit(4, point)));
            assert!(whole.holds(&hit(3, point)) && !whole.holds(&hit(4, point)));
        }
    }
}

#[test]
fn what_is_wrong_with_a_target_is_said() {
    let scene = plate(
        Point3::new(-0.001, 0.002, 0.0),
        Point3::new(0.004, 0.0025, 0.01),
    );
    let target = |within: Option<[[f64; 3]; 2]>, aim: Option<[f64; 3]>| Target {
        within: within.map(|[low, high]| (low.into(), high.into())),
        aim: aim.map(Point3::from),
        ..upper_side()
    };
    let fault = |target: &Target| {
        let faults = Patch::find(&scene, target).map(|patch| patch.area);
        let faults = faults.expect_err("it is at fault");
        assert_eq!(faults.len(), 1);
        faults[0].to_string()
    };
    let elsewhere = target(Some([[1.0, 1.0, 1.0], [2.0, 2.0, 2.0]]), None);
    assert_eq!(
        fault(&elsewhere),
        "target.within: no part of `plate.z_max` lies in this box: the target is empty; expected a \
         box that meets x -1.000 to 4.000, y 2.000 to 2.500, z 10.000 to 10.000 mm"
    );
    let off = target(None, Some([0.0015, 0.002, 0.0]));
    assert_eq!(
        fault(&off),
        "target.aim: the aim point [1.500, 2.000, 0.000] mm is not on the target; expected a point \
         on `plate.z_max`, inside `within` if that is given"
    );
}

#[test]
fn an_aim_point_may_be_off_by_a_thousandth_of_the_targets_size() {
    let scene = plate(Point3::origin(), Point3::new(8.0, 2.0, 1.0));
    // The root of its area is 4.
    for (height, is_on_it) in [
        (3.9e-3, true),
        (-3.9e-3, true),
        (4.1e-3, false),
        (-4.1e-3, false),
    ] {
        let target = Target {
            aim: Some(Point3::new(3.0, 1.0, 1.0 + height)),
            ..upper_side()
        };
        assert_eq!(Patch::find(&scene, &target).is_ok(), is_on_it, "{height}");
    }
    // Inside its box but for roundings of a file with seven digits.
    for (x, is_on_it) in [
        (2.0 - 0.9e-6, true),
        (2.0 - 1.1e-6, false),
        (3.0, true),
        (4.0 + 0.9e-6, true),
        (4.0 + 1.1e-6, false),
        (6.0, false),
    ] {
        let target = Target {
            within: Some((Point3::new(2.0, 0.5, 0.5), Point3::new(4.0, 1.5, 1.5))),
            aim: Some(Point3::new(x, 1.0, 1.0)),
            ..upper_side()
        };
        assert_eq!(Patch::find(&scene, &target).is_ok(), is_on_it, "{x}");
    }
}

/// A part often ends where its box does; a shot that touches its rim there is off by rounding.
#[test]
fn rounding_loses_no_hit_in_a_face_of_the_box() {
    let keyway = Part {
        name: "pipe".to_owned(),
        shape: Shape::Bore {
            diameter: 0.03,
            length: 0.04,
            ends: crate::problem::part::Ends::default(),
            free: None,
        },
        place: Place::default(),
        on_nozzle: false,
        cut: Vec::new(),
    };
    let exact = Scene::build(&[keyway], Walls::Exact).expect("it is sound");
    let corner = |z: f64| Point3::new(0.02, 0.02, z);
    let target = Target {
        surface: "pipe.wall".to_owned(),
        within: Some((Point3::new(-0.02, -0.02, 0.0), corner(0.01))),
        aim: Some(Point3::new(0.0, 0.015, 0.005)),
        ..upper_side()
    };
    let patch = Patch::find(&exact, &target).expect("it is there");
    let at = |z: f64| Point3::new(0.0, 0.015, z);
    // The scene's size is 0.04.
    for (beyond, is_held) in [
        (0.0, true),
        (1e-17, true),
        (3.9e-11, true),
        (4.1e-11, false),
    ] {
        assert_eq!(patch.covers(&at(-beyond)), is_held, "{beyond}");
        assert_eq!(patch.covers(&at(0.01 + beyond)), is_held, "{beyond}");
    }
    // A surface that lies in a face of the box but for rounding is all of the target.
    let turned = plate(
        Point3::new(0.0, 0.0, 0.0),
        Point3::new(4.0, 2.0, 1.0 + 1e-15),
    );
    for (low, high) in [(0.0, 1.0), (1.0 + 2e-15, 2.0)] {
        let target = Target {
            within: Some((Point3::new(0.0, 0.0, low), Point3::new(4.0, 2.0, high))),
            ..upper_side()
        };
        let patch = Patch::find(&turned, &target).expect("it is there");
        assert!((patch.area - 8.0).abs() < 1e-12, "{}", patch.area);
        assert!(patch.cut_out(&turned).1.is_empty());
    }
}
