use super::super::plate;
use super::*;

const SLACK: f64 = 1e-9;

/// A triangle of 40 by 30 in the plane z = 0.
fn large() -> SweptTriangle {
    let corners = [[0.0, 0.0, 0.0], [40.0, 0.0, 0.0], [0.0, 30.0, 0.0]].map(Point3::from);
    plate(corners, [5, 2, 9], SLACK)
}

#[test]
fn plates_know_their_plane_and_the_order_of_their_edges() {
    let plate = large();
    assert!(plate.clear);
    assert_eq!(plate.normal, Vector3::z());
    let expected = [[0.0, 1.0, 0.0], [-0.6, -0.8, 0.0], [1.0, 0.0, 0.0]].map(Vector3::from);
    for (inward, expected) in plate.inward.iter().zip(expected) {
        assert!((inward - expected).norm() < 1e-15, "{inward}");
    }
    // Vertices 5, 2 and 9: an edge runs from its lower one.
    let [a, b, c] = plate.corners;
    assert_eq!(
        [0, 1, 2].map(|edge| plate.edge(edge)),
        [(b, a), (b, c), (a, c)]
    );
}

#[test]
fn slivers_have_a_plane_as_far_as_rounding_leaves_one() {
    let of_height = |height: f64, flat: f64| {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, height, 0.0]];
        plate(corners.map(Point3::from), [0, 1, 2], flat)
    };
    // The two shorter edges are 0.5 long: they tilt the plane by 2.2e-16 / 4 / height.
    assert!(of_height(1e-10, 1e-6).clear);
    let doubtful = of_height(1e-10, 5e-7);
    assert!(!doubtful.clear && doubtful.normal == Vector3::z());
    let hopeless = of_height(1e-13, 1.0);
    assert!(!hopeless.clear && hopeless.normal == Vector3::zeros());
    // Four times as long and as high: as much tilted, and by that four times as far off at its tips.
    let longer = |flat: f64| {
        let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [2.0, 4e-10, 0.0]];
        plate(corners.map(Point3::from), [0, 1, 2], flat)
    };
    assert!(longer(2.5e-6).clear && !longer(2e-6).clear);
}

#[test]
fn the_planes_of_slivers_lose_no_digits() {
    // Whole numbers, so that edges are exact; their product in whole numbers, made a unit vector.
    let sliver = [
        [0.0, 0.0, 0.0],
        [1_000_000_007.0, 3.0, -400_000_009.0],
        [3.0, -2.0, 5.0],
    ];
    let area_normal = [-800_000_003.0, -6_200_000_062.0, -2_000_000_023.0];
    let expected = Vector3::from(area_normal).normalize();
    for turn in 0..3 {
        for (one, other, side) in [(1, 2, 1.0), (2, 1, -1.0)] {
            let order = [turn, turn + one, turn + other].map(|corner| corner % 3);
            let corners = order.map(|corner| Point3::from(sliver[corner]));
            let found = plate(corners, [0, 1, 2], 1.0);
            let off = found.normal - expected * side;
            assert!(found.clear && off.norm() < 1e-15, "{order:?}: {off}");
        }
    }
}

#[test]
fn only_edges_that_the_centre_passes_are_looked_at() {
    let plate = large();
    let passed = |origin: [f64; 3], direction: [f64; 3], limit: f64| {
        let ray = Ray::of(origin, direction);
        let sphere = Sphere::new(&ray, 1.0, SLACK);
        let height = plate.height(&ray.origin);
        sphere.passed(&plate, height, ray.direction.dot(&plate.normal), limit)
    };
    let down = [0.0, 0.0, -1.0];
    assert_eq!(passed([10.0, 10.0, 5.0], down, 9.0), 0);
    assert_eq!(passed([10.0, -1.0, 5.0], down, 9.0), 0b01_1001);
    assert_eq!(passed([-1.0, 10.0, 5.0], down, 9.0), 0b10_1100);
    assert_eq!(passed([30.0, 20.0, 5.0], down, 9.0), 0b11_0010);
    // It may touch from 5 on, 4 down and 3 across, and then until the limit.
    let across = [0.0, -0.6, -0.8];
    assert_eq!(passed([10.0, 10.0, 5.0], across, 10.0), 0);
    assert_eq!(passed([10.0, 10.0, 5.0], across, 20.0), 0b01_1001);
    let inwards = [0.0, 0.6, -0.8];
    assert_eq!(passed([10.0, -2.0, 5.0], inwards, 10.0), 0);
    assert_eq!(passed([10.0, -4.0, 5.0], inwards, 10.0), 0b01_1001);
}

#[test]
fn faces_and_edges_are_touched_a_radius_away() {
    let plate = large();
    let touch = |origin: [f64; 3], direction: [f64; 3], folds: ConvexEdges| {
        let ray = Ray::of(origin, direction);
        Sphere::new(&ray, 1.0, SLACK).touch(&plate, folds, 99.0)
    };
    let face = touch([10.0, 10.0, 5.0], [0.0, 0.0, -1.0], ConvexEdges::ALL).expect("the face");
    assert!(face.on_face && face.front && face.distance == 4.0);
    let face = touch([10.0, 10.0, -5.0], [0.0, 0.0, 1.0], ConvexEdges::ALL).expect("the face");
    assert!(face.on_face && !face.front && face.distance == 4.0);
    assert_eq!(face.normal, -Vector3::z());

    let in_front = ConvexEdges {
        behind: 0,
        ..ConvexEdges::ALL
    };
    let behind = ConvexEdges {
        front: 0,
        ..ConvexEdges::ALL
    };
    for (z, front) in [(0.6, true), (-0.6, false)] {
        let (stands_out, hollow) = if front {
            (in_front, behind)
        } else {
            (behind, in_front)
        };
        // Level, and slanted so that it starts on the other side.
        for (origin, direction, distance) in [
            ([10.0, -5.0, z], [0.0, 1.0, 0.0], 4.2),
            ([10.0, -4.8, -4.0 * z], [0.0, 0.8, z], 5.0),
        ] {
            let found = touch(origin, direction, stands_out).expect("the edge");
            assert!((found.distance - distance).abs() < 1e-12);
            assert!(!found.on_face && found.front == front);
            assert!((found.normal - Vector3::new(0.0, -0.8, z)).norm() < 1e-12);
            assert!(touch(origin, direction, hollow).is_none());
        }
    }
}

#[test]
fn margins_grow_as_the_angle_flattens() {
    let level = Ray::of([0.0, 0.0, 5.0], [1.0, 0.0, 0.0]);
    let sphere = Sphere::new(&level, 1.0, SLACK);
    assert_eq!(sphere.margin(1.0), LIFT * SLACK);
    assert_eq!(sphere.margin(0.25), 4.0 * LIFT * SLACK);
    assert_eq!(sphere.margin(1e-12), SLACK.sqrt());
}

#[test]
fn a_triangle_that_was_left_is_touched_again_where_the_sphere_heads_in() {
    let is_another = |sinking: f64, radius: f64| {
        let ray = Ray::of([0.0, 0.0, 1.0], [1.0, 0.0, -sinking]);
        let touch = Touch {
            distance: 0.0,
            normal: Vector3::z(),
            on_face: true,
            facing: 1.0,
            front: true,
        };
        Sphere::new(&ray, radius, SLACK).is_another(&touch)
    };
    let least = LIFT * LIFT * SLACK;
    assert!(is_another(1.1 * least, 1.0) && !is_another(0.9 * least, 1.0));
    assert!(is_another(0.6 * least, 2.0) && !is_another(-0.5, 1.0));
}
