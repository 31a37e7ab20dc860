use std::f64::consts::PI;

use super::*;
use crate::problem::curve::tests::line;

fn is_near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-12
}

/// A bore of radius 5 with a groove that leaves it at (3, 4) and (-3, 4).
fn keyway(root_radius: f64) -> Profile {
    Profile::keyway(&Keyway {
        bore: 10.0,
        width: 6.0,
        depth: 2.0,
        length: 9.0,
        root_radius,
    })
}

#[test]
fn a_keyway_is_a_closed_outline_with_two_lips() {
    for (root, names) in [
        (0.0, "floor wall_neg bore wall_pos"),
        (1.0, "floor root_neg wall_neg bore wall_pos root_pos"),
    ] {
        let profile = keyway(root);
        assert_eq!(profile.surfaces.join(" "), names);
        let pieces = &profile.pieces;
        for (index, piece) in pieces.iter().enumerate() {
            let next = &pieces[(index + 1) % pieces.len()];
            let gap = piece.curve.at(1.0) - next.curve.at(0.0);
            assert!(gap.norm() < 1e-12, "{root}: behind {index}");
        }
        // Floor at 5 + 2; walls from there, less the root, to 4.
        let length = |name: &str| {
            let surface = profile.surfaces.iter().position(|it| it == name);
            let mut of_it = pieces
                .iter()
                .filter(|it| Some(it.surface as usize) == surface);
            of_it.next().map(|piece| piece.curve.length())
        };
        assert!(is_near(length("floor").unwrap(), 6.0 - 2.0 * root));
        assert!(is_near(length("wall_neg").unwrap(), 3.0 - root));
        assert!(is_near(length("wall_pos").unwrap(), 3.0 - root));
        let open = 2.0 * 0.6_f64.asin();
        assert!(is_near(length("bore").unwrap(), 5.0 * (2.0 * PI - open)));
        if root > 0.0 {
            assert!(is_near(length("root_neg").unwrap(), 0.5 * PI));
            let middle = pieces[1].curve.at(0.5);
            let expected = Point2::new(-2.0 - 0.5_f64.sqrt(), 6.0 + 0.5_f64.sqrt());
            assert!((middle - expected).norm() < 1e-12);
        }
        let corners = profile.convex_corners();
        let bore = pieces.len() / 2;
        let walls: Vec<[usize; 2]> = corners.iter().map(|corner| corner.walls).collect();
        assert_eq!(walls, [[bore - 1, bore], [bore, bore + 1]]);
        for (corner, expected) in corners.iter().zip([[-3.0, 4.0], [3.0, 4.0]]) {
            assert!((corner.point - Point2::from(expected)).norm() < 1e-12);
        }
        // Down the wall and along the bore, which there leads to (-4, -3) / 5.
        let expected = Vector2::new(-0.8, -1.6);
        assert!((corners[0].towards_second - expected).norm() < 1e-12);
    }
}

#[test]
fn plates_have_edges_where_they_turn_back_or_end() {
    let profile = |curves: &[Curve]| {
        let mut profile = Profile::empty();
        curves.iter().for_each(|curve| profile.push(*curve, "any"));
        profile
    };
    let there = line([0.0, 0.0], [1.0, 0.0]);
    let back = line([1.0, 0.0], [0.0, 0.0]);
    let on = line([1.0, 0.0], [2.0, 0.0]);
    let up = line([1.0, 0.0], [1.0, 1.0]);
    let down = line([1.0, 0.0], [1.0, -1.0]);
    let places = |curves: &[Curve]| {
        let corners = profile(curves).convex_corners();
        let places: Vec<_> = corners.iter().map(|it| (it.point.x, it.point.y)).collect();
        places
    };
    assert_eq!(places(&[there, back]), [(1.0, 0.0), (0.0, 0.0)]);
    assert_eq!(places(&[there]), [(1.0, 0.0), (0.0, 0.0)]);
    assert_eq!(places(&[there, on]), [(2.0, 0.0), (0.0, 0.0)]);
    // A turn to the left closes in on free space, one to the right opens it.
    assert_eq!(places(&[there, up]), [(1.0, 1.0), (0.0, 0.0)]);
    assert_eq!(
        places(&[there, down]),
        [(1.0, 0.0), (1.0, -1.0), (0.0, 0.0)]
    );
}
