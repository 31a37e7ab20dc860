use std::f64::consts::PI;

use super::build::too_many_triangles;
use super::mesh_file::MOST_TRIANGLES;
use super::nearest::spiral_direction;
use super::*;
use crate::problem::part::{Ends, Part, Place, Shape};
use crate::scene::lanes::LANES;
use crate::scene::nozzle_frame::NozzleFrames;
use crate::scene::rays::HitIds;

fn part(name: &str, shape: Shape, on_nozzle: bool) -> Part {
    Part {
        name: name.to_owned(),
        shape,
        place: Place::default(),
        on_nozzle,
        cut: Vec::new(),
    }
}

fn block(min: [f64; 3], max: [f64; 3]) -> Shape {
    Shape::Box {
        min: min.into(),
        max: max.into(),
    }
}

/// Up to z = 0.
fn floor() -> Part {
    let floor = block([-50.0, -50.0, -9.0], [50.0, 50.0, 0.0]);
    part("floor", floor, false)
}

#[test]
fn directions_on_a_spiral_are_even() {
    let directions: Vec<_> = (0..256).map(|index| spiral_direction(index, 256)).collect();
    let mean = directions.iter().sum::<Vector3<f64>>() / 256.0;
    assert!(mean.norm() < 1e-3, "{mean}");
    let squares = directions.iter().map(|it| it.component_mul(it));
    let squares = squares.sum::<Vector3<f64>>() / 256.0;
    assert!(
        (squares - Vector3::repeat(1.0 / 3.0)).norm() < 1e-3,
        "{squares}"
    );
    for (index, one) in directions.iter().enumerate() {
        assert!((one.norm() - 1.0).abs() < 1e-12);
        // Each has about a 256th of the sphere, a cap of 0.125 rad, to itself.
        let apart = |other: &Vector3<f64>| one.angle(other);
        let nearest = directions[..index].iter().map(apart).fold(PI, f64::min);
        assert!(nearest > 0.15, "{index}: {nearest}");
    }
}

#[test]
fn a_scene_is_as_large_as_its_farthest_coordinate() {
    let near = part("near", block([0.0; 3], [0.1, 0.2, 0.3]), false);
    let far = part("far", block([-0.1, -0.7, 0.1], [0.0, 0.0, 0.2]), false);
    let scene = Scene::build(&[near, far], Walls::Exact).expect("it is sound");
    assert_eq!(scene.size(), 0.7);
    // Two for each face of a block.
    assert_eq!(scene.triangles(), 24);
    assert!(!scene.moves_with_nozzle());
}

#[test]
fn a_scene_has_no_more_triangles_than_one_mesh_may_have() {
    let hub = part("hub", block([0.0; 3], [1.0; 3]), false);
    assert_eq!(too_many_triangles(&hub, MOST_TRIANGLES), None);
    let fault = too_many_triangles(&hub, MOST_TRIANGLES + 1).expect("one too many");
    assert_eq!(
        fault.to_string(),
        "scene.hub: up to this part the scene has more than 20000000 triangles; expected \
         fewer or coarser meshes, at most so many triangles together"
    );
}

#[test]
fn it_is_known_what_moves_with_the_nozzle() {
    let cube = || block([0.0; 3], [1.0; 3]);
    let parts = [part("table", cube(), false), part("shield", cube(), true)];
    let scene = Scene::build(&parts, Walls::Exact).expect("it is sound");
    assert!(scene.moves_with_nozzle());
    for (name, moves) in [("table.z_max", false), ("shield.z_max", true)] {
        let surface = scene.surface_named(name).expect("it is there");
        assert_eq!(scene.surface_moves_with_nozzle(surface), moves, "{name}");
    }
}

#[test]
fn walls_are_exact_where_no_part_is_of_triangles() {
    let bore = || Shape::Bore {
        diameter: 2.0,
        length: 5.0,
        ends: Ends::default(),
        free: None,
    };
    let one = [part("bore", bore(), false)];
    let two = [
        part("bore", bore(), false),
        part("block", block([3.0; 3], [4.0; 3]), false),
    ];
    let is_exact = |parts: &[Part], walls: Walls| {
        let scene = Scene::build(parts, walls).expect("it is sound");
        scene.has_exact_walls()
    };
    assert!(is_exact(&one, Walls::Exact));
    assert!(!is_exact(&one, Walls::TriangleMesh { chord_angle: 0.1 }));
    assert!(!is_exact(&two, Walls::Exact));
}

#[test]
fn a_nozzle_is_as_clear_as_the_nearest_piece_of_its_body() {
    // A floor at z = 0, a wall at x = -10, and something that moves along.
    let parts = [
        floor(),
        part(
            "wall",
            block([-19.0, -50.0, 0.0], [-10.0, 50.0, 50.0]),
            false,
        ),
        part("cap", block([0.0, 0.0, 4.0], [1.0, 1.0, 5.0]), true),
    ];
    let scene = Scene::build(&parts, Walls::Exact).expect("it is sound");
    let (exit, jet) = (Point3::new(0.0, 0.0, 5.0), Vector3::new(0.6, 0.0, -0.8));
    let clearance = |body: &[Body], limit: f64| {
        let nozzle = Nozzle {
            body: body.to_vec(),
            clearance: 0.0,
        };
        let found = scene.clearance(&nozzle, &exit, &jet, limit);
        found.map(|(gap, surface)| (gap, scene.surfaces()[surface as usize].as_str()))
    };
    let rod = |length: f64, direction: Option<Vector3<f64>>| Body::Capsule {
        length,
        radius: 0.5,
        direction,
    };
    let ball = |radius: f64| Body::Ball { radius };
    let down = Some(-Vector3::z());
    for (body, gap, surface) in [
        (vec![ball(1.0)], 4.0, "floor.z_max"),
        // Below the floor by 1.
        (vec![ball(6.0)], -1.0, "floor.z_max"),
        // Back along the jet: after 5 it is 3 to the side and 4 up, after 10 6 and 8.
        (vec![rod(5.0, None)], 4.5, "floor.z_max"),
        (vec![rod(10.0, None)], 3.5, "wall.x_max"),
        (vec![rod(3.0, down)], 1.5, "floor.z_max"),
        (vec![rod(10.0, None), ball(1.0)], 3.5, "wall.x_max"),
        (vec![rod(10.0, None), ball(2.0)], 3.0, "floor.z_max"),
        (vec![ball(2.0), rod(10.0, None)], 3.0, "floor.z_max"),
    ] {
        let (found, at) = clearance(&body, 9.0).expect("it is near");
        assert!((found - gap).abs() < 1e-12, "{body:?}: {found}");
        assert_eq!(at, surface, "{body:?}");
        assert!(clearance(&body, gap + 0.01).is_some(), "{body:?}");
        assert!(clearance(&body, gap - 0.01).is_none(), "{body:?}");
    }
    assert_eq!(clearance(&[], 9.0), None);
}

#[test]
fn a_shot_touches_a_scene_a_radius_before_a_point_would() {
    let parts = [
        floor(),
        part("lid", block([-50.0, -50.0, 8.0], [50.0, 50.0, 9.0]), false),
    ];
    let scene = Scene::build(&parts, Walls::Exact).expect("it is sound");
    for (height, direction, distance, surface) in [
        (3.0, [0.6, 0.0, -0.8], 3.75, "floor.z_max"),
        (3.0, [0.0, 0.6, 0.8], 6.25, "lid.z_min"),
        // From inside the floor, whose fronts are outside.
        (-3.0, [0.6, 0.0, 0.8], 3.75, "floor.z_max"),
        (-3.0, [0.0, -0.6, -0.8], 7.5, "floor.z_min"),
    ] {
        let ray = Ray::of([1.0, 2.0, height], direction);
        let point = scene.first_hit(&ray, None).expect("it is ahead");
        assert!((point.distance - distance).abs() < 1e-12);
        // 0.4 along z is 0.5 on the way.
        let shot = scene.first_touch(&ray, 0.4, None).expect("it is ahead");
        assert!((shot.distance - (distance - 0.5)).abs() < 1e-12);
        for hit in [&point, &shot] {
            assert_eq!(scene.surfaces()[hit.surface as usize], surface);
            assert_eq!(hit.normal.z, -direction[2].signum());
        }
        // The place of contact is on the surface, below or above the centre.
        let centre = ray.origin + ray.direction * shot.distance;
        let expected = centre - shot.normal * 0.4;
        assert!((shot.point - expected).norm() < 1e-12);
        assert!((point.point - (ray.origin + ray.direction * distance)).norm() < 1e-9);
        // The same among many.
        let mut rays = Rays::none();
        rays.count = 1;
        rays.are_spheres = true;
        rays.radius[0] = 0.4;
        put(&mut rays.origin, 0, ray.origin.into());
        put(&mut rays.direction, 0, ray.direction.into());
        let mut hits = Hits::none();
        scene.first_hits(&rays, &mut hits);
        assert_eq!(hits.distance[0], shot.distance);
        assert_eq!(Vector3::from(components(&hits.normal, 0)), shot.normal);
        assert!((Point3::from(components(&hits.point, 0)) - shot.point).norm() < 1e-12);
    }
}

/// Facets, which stand in for them where distances are measured, are off by up to half a degree.
#[test]
fn normals_of_round_walls_are_those_of_the_round_wall() {
    let ends = Ends::default();
    let bore = Shape::Bore {
        diameter: 2.0,
        length: 5.0,
        ends,
        free: None,
    };
    let scene = Scene::build(&[part("bore", bore, false)], Walls::Exact).expect("it is sound");
    for step in 0..100 {
        let (sin, cos) = (0.063 * f64::from(step)).sin_cos();
        let inwards = Vector3::new(-cos, -sin, 0.0);
        for depth in [0.3, 1.0, 1.7] {
            let from = Point3::new(depth * cos, depth * sin, 2.0);
            let (foot, normal) = scene.nearest_on_surface(&from, 0).expect("it is there");
            if depth < 1.0 {
                // Half of a chord that turns by a degree is 0.009 long.
                let expected = Point3::new(cos, sin, 2.0);
                assert!((foot - expected).norm() < 9e-3, "{step}: {foot}");
            }
            let expected = Vector3::new(-foot.x, -foot.y, 0.0).normalize();
            assert!((normal - expected).norm() < 1e-6, "{step}: {normal}");
            assert!(normal.dot(&inwards) > 0.9999, "{step}: {normal}");
        }
    }
}

/// In a closed pot with a block in it and a block on the nozzle, which is the first part or the last.
#[test]
fn many_rays_meet_what_each_of_them_meets() {
    let pot = Shape::Bore {
        diameter: 2.0,
        length: 3.0,
        ends: Ends {
            near_closed: true,
            far_closed: true,
        },
        free: None,
    };
    let pot = part("pot", pot, false);
    let stone = part("stone", block([-0.3, -0.2, 0.4], [0.1, 0.3, 0.9]), false);
    let shield = part("shield", block([-0.2, -0.1, 0.3], [0.3, 0.2, 0.5]), true);
    let orders = [
        [pot.clone(), stone.clone(), shield.clone()],
        [shield, stone, pot],
    ];
    let axes = [[0.6, 0.0, -0.8], [0.0, 1.0, 0.0], [0.8, 0.0, 0.6]];
    let nozzle_frame = NozzleFrame::new(axes.map(Vector3::from), Point3::new(0.1, 0.2, 1.6));
    for (parts, radius) in orders
        .iter()
        .flat_map(|order| [(order, 0.0), (order, 0.05)])
    {
        let scene = Scene::build(parts, Walls::Exact).expect("it is sound");
        let mut nozzle_frames = NozzleFrames::none();
        let mut rays = Rays::none();
        rays.count = LANES;
        rays.are_spheres = radius > 0.0;
        rays.radius = [radius; LANES];
        let mut singles: Vec<(Ray, Option<HitId>)> = Vec::new();
        for i in 0..LANES {
            nozzle_frames.set(i, &nozzle_frame);
            let origin = Point3::new(-0.6, 0.5 - 0.008 * i as f64, 2.4);
            let direction = spiral_direction(i, LANES);
            singles.push((Ray { origin, direction }, None));
        }
        rays.nozzle_frames = Some(Box::new(nozzle_frames));
        let mut met = vec![0; scene.surfaces().len()];
        for flight in 0..12 {
            let mut hit_ids = HitIds::none();
            for (i, (ray, leaving)) in singles.iter().enumerate() {
                put(&mut rays.origin, i, ray.origin.into());
                put(&mut rays.direction, i, ray.direction.into());
                if let Some(hit_id) = *leaving {
                    hit_ids.set(i, hit_id);
                }
            }
            rays.leaving = (flight > 0).then_some(hit_ids);
            let mut hits = Hits::none();
            scene.first_hits(&rays, &mut hits);
            for (i, (ray, leaving)) in singles.iter_mut().enumerate() {
                let hit = scene.first_contact(ray, radius, *leaving, Some(&nozzle_frame));
                let hit = hit.expect("the pot is closed");
                assert_eq!(hits.distance[i], hit.distance, "{ray:?} {leaving:?}");
                assert_eq!(
                    (hits.surface[i], hits.hit_ids.at(i)),
                    (hit.surface, hit.hit_id)
                );
                let normal = Vector3::from(components(&hits.normal, i));
                assert!((normal - hit.normal).norm() < 1e-12, "{ray:?}");
                let point = Point3::from(components(&hits.point, i));
                assert!((point - hit.point).norm() < 1e-12, "{ray:?}");
                met[hit.surface as usize] += 1;
                let into = ray.direction.dot(&hit.normal);
                ray.origin = if radius > 0.0 {
                    ray.origin + ray.direction * hit.distance
                } else {
                    hit.point
                };
                ray.direction = (ray.direction - hit.normal * (2.0 * into)).normalize();
                *leaving = Some(hit.hit_id);
            }
        }
        assert!(met.iter().all(|&count| count > 0), "{met:?}");
    }
}

/// The facets of a pin stay inside it, and it is its exact wall that rays meet.
#[test]
fn rays_meet_a_round_pin_on_the_nozzle_beyond_its_facets() {
    let shape = Shape::Bore {
        diameter: 2.0,
        length: 3.0,
        ends: Ends::default(),
        free: None,
    };
    let mut pin = part("pin", shape, true);
    // The middle of a chord is where it is widest.
    pin.place.rotation =
        nalgebra::UnitQuaternion::from_euler_angles(0.0, 0.0, 0.5_f64.to_radians());
    let scene = Scene::build(&[pin], Walls::Exact).expect("it is sound");
    let frame = NozzleFrame::new([Vector3::x(), Vector3::y(), Vector3::z()], Point3::origin());
    for (radius, beside, meets) in [
        (0.0, 1.0 - 1e-5, true),
        (0.0, 1.0 + 1e-5, false),
        (0.05, 1.05 - 1e-5, true),
        (0.05, 1.05 + 1e-5, false),
    ] {
        let mut rays = Rays::none();
        rays.count = 1;
        rays.are_spheres = radius > 0.0;
        rays.radius[0] = radius;
        put(&mut rays.origin, 0, [beside, -4.0, 1.5]);
        put(&mut rays.direction, 0, [0.0, 1.0, 0.0]);
        let mut nozzle_frames = NozzleFrames::none();
        nozzle_frames.set(0, &frame);
        rays.nozzle_frames = Some(Box::new(nozzle_frames));
        let mut hits = Hits::none();
        scene.first_hits(&rays, &mut hits);
        assert_eq!(hits.distance[0].is_finite(), meets, "{radius} {beside}");
    }
}

/// Where a ray starts on a second wall already, it is put on the side that it comes from.
#[test]
fn hits_are_a_lift_above_their_surface_or_as_high_as_the_ray_starts() {
    let nozzle_frame =
        NozzleFrame::new([Vector3::x(), Vector3::y(), Vector3::z()], Point3::origin());
    for on_nozzle in [false, true] {
        let room = [part("room", block([-2.0; 3], [2.0; 3]), on_nozzle)];
        let scene = Scene::build(&room, Walls::Exact).expect("it is sound");
        let lift = 2.0 * LIFT * SLACK;
        let side = scene.surface_named("room.x_max").expect("it is there");
        let to_side = Ray::of([0.0, 0.5, 0.5], [1.0, 0.0, 0.0]);
        let leaving = scene.first_contact(&to_side, 0.0, None, Some(&nozzle_frame));
        let leaving = leaving.expect("it is ahead");
        assert_eq!(leaving.surface, side);
        assert!((2.0 - leaving.point.x - lift).abs() < 1e-15);
        for height in [0.0, 0.25, 0.5, 0.9, 2.0, 8.0].map(|lifts| lifts * lift) {
            // From that wall into the one beside it.
            let ray = Ray::of([leaving.point.x, 2.0 - height, 0.5], [-0.6, 0.8, 0.0]);
            let hit = scene.first_contact(&ray, 0.0, Some(leaving.hit_id), Some(&nozzle_frame));
            let hit = hit.expect("at once");
            assert_eq!(hit.distance, 0.0);
            assert_eq!(scene.surfaces()[hit.surface as usize], "room.y_max");
            assert!(
                (2.0 - hit.point.y - height.max(lift)).abs() < 1e-15,
                "{height}"
            );
            let mut rays = Rays::none();
            rays.count = 1;
            put(&mut rays.origin, 0, ray.origin.into());
            put(&mut rays.direction, 0, ray.direction.into());
            let mut hit_ids = HitIds::none();
            hit_ids.set(0, leaving.hit_id);
            rays.leaving = Some(hit_ids);
            let mut nozzle_frames = NozzleFrames::none();
            nozzle_frames.set(0, &nozzle_frame);
            rays.nozzle_frames = Some(Box::new(nozzle_frames));
            let mut hits = Hits::none();
            scene.first_hits(&rays, &mut hits);
            assert_eq!(hits.distance[0], 0.0, "{height} {on_nozzle}");
            assert!((hits.point[1][0] - hit.point.y).abs() < 1e-15, "{height}");
        }
    }
}

/// What is a thousandth of the scene away from the wall is beyond the opposite one.
#[test]
fn the_wall_of_a_long_and_narrow_bore_faces_its_axis() {
    let bore = Shape::Bore {
        diameter: 0.5e-3,
        length: 1.0,
        ends: Ends::default(),
        free: None,
    };
    let scene = Scene::build(&[part("bore", bore, false)], Walls::Exact).expect("it is sound");
    for step in 0..20 {
        let (sin, cos) = (0.31 * f64::from(step)).sin_cos();
        let from = Point3::new(0.2e-3 * cos, 0.2e-3 * sin, 0.4);
        let (_, normal) = scene.nearest_on_surface(&from, 0).expect("it is there");
        let inwards = Vector3::new(-cos, -sin, 0.0);
        // Facets turn by a degree.
        assert!(normal.dot(&inwards) > 0.999, "{step}: {normal}");
    }
}

/// Sheets of metal that are thinner than the height from which the scene is looked at.
#[test]
fn the_enclosed_side_of_a_sheet_is_that_from_which_clearly_more_is_seen() {
    const THIN: f64 = 1e-8;
    // A channel of 1 mm by 2 mm, 20 mm long, its floor at z = 0.
    let floor = block([-0.5e-3, -10e-3, -THIN], [0.5e-3, 10e-3, 0.0]);
    let side = |x: f64| block([x, -10e-3, 0.0], [x + THIN, 10e-3, 2e-3]);
    let channel = [floor.clone(), side(-0.5e-3), side(0.5e-3)];
    // Below it a roof that is seen from a good part of the directions.
    let below = block([-2e-3, -2e-3, -2e-3 - THIN], [2e-3, 2e-3, -2e-3]);
    // A lip at one end that is seen from few.
    let lip = block([-0.5e-3, 9e-3, -1e-3], [0.5e-3, 9e-3 + THIN, 0.0]);
    let faces = |shapes: &[Shape], front: f64| {
        let parts = shapes.iter().enumerate();
        let parts: Vec<Part> = parts
            .map(|(index, shape)| part(&format!("sheet{index}"), shape.clone(), false))
            .collect();
        let scene = Scene::build(&parts, Walls::Exact).expect("it is sound");
        let at = Point3::new(0.1e-3, 0.2e-3, 0.0);
        let before = scene.enclosed_side(&at, &(Vector3::z() * front));
        before.map(|before| if before { front } else { -front })
    };
    let mut over_roof = channel.to_vec();
    over_roof.push(below);
    for front in [1.0, -1.0] {
        assert_eq!(faces(&channel, front), Some(1.0), "{front}");
        assert_eq!(faces(&over_roof, front), Some(1.0), "{front}");
        // Hardly anything is seen from either side.
        assert_eq!(faces(&[floor.clone(), lip.clone()], front), None);
    }
}
