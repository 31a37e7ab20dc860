use super::*;
use crate::problem::part::{Part, Place, Shape};
use crate::scene::Walls;

fn area(polygons: impl IntoIterator<Item = Polygon>) -> f64 {
    area_and_centre(polygons.into_iter()).0
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
        let (inside, outside) = split(&corners, &(low.into(), high.into()));
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
    let part = Part {
        name: "block".to_owned(),
        shape: Shape::Box {
            min: Point3::origin(),
            max: Point3::new(4.0, 2.0, 1.0),
        },
        place: Place::default(),
        on_nozzle: false,
    };
    let scene = Scene::build(&[part], Walls::Exact).expect("it is sound");
    for (within, inside) in [
        (None, 8.0),
        (Some(([1.0, 0.5, 0.0], [3.0, 1.0, 2.0])), 1.0),
        (Some(([2.0, -1.0, 0.0], [9.0, 9.0, 2.0])), 4.0),
        (Some(([-1.0, -1.0, 0.0], [9.0, 9.0, 2.0])), 8.0),
    ] {
        let target = Target {
            surface: "block.z_max".to_owned(),
            within: within.map(|(low, high)| (low.into(), high.into())),
            aim: None,
            along: None,
            facing: None,
        };
        let patch = Patch::find(&scene, &target).expect("it is there");
        let (within, beyond) = patch.cut_out(&scene);
        let area = |triangles: Vec<Triangle>| area(triangles.into_iter().map(Into::into));
        assert!((patch.area - inside).abs() < 1e-12);
        assert!((area(within) - inside).abs() < 1e-12, "{target:?}");
        assert!((area(beyond) - (8.0 - inside)).abs() < 1e-12, "{target:?}");
    }
}
