use std::f64::consts::PI;

use super::*;

fn is_near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-12
}

fn line(from: [f64; 2], to: [f64; 2]) -> Curve {
    Curve::Line {
        from: from.into(),
        to: to.into(),
    }
}

#[test]
fn arcs_go_through_three_points() {
    // A circle of radius 5 round (1, 2), over its upper half and over its lower half.
    for (via, turn) in [([4.0, 6.0], 1.0), ([-2.0, 6.0], 1.0), ([4.0, -2.0], -1.0)] {
        let arc = Curve::arc_through([6.0, 2.0].into(), via.into(), [-4.0, 2.0].into());
        let arc = arc.expect("they lie on no line");
        let Curve::Arc {
            centre,
            radius,
            start,
            sweep,
        } = arc
        else {
            panic!("an arc is round");
        };
        assert!((centre - Point2::new(1.0, 2.0)).norm() < 1e-12);
        assert!(is_near(radius, 5.0) && is_near(start, 0.0));
        assert!(is_near(sweep, turn * PI));
        assert!(is_near(arc.length(), 5.0 * PI));
        let middle = Point2::new(1.0, 2.0 + turn * 5.0);
        assert!((arc.at(0.5) - middle).norm() < 1e-12);
        assert!((arc.tangent(0.0) - Vector2::new(0.0, turn)).norm() < 1e-12);
        assert!((arc.tangent(0.5) + Vector2::x()).norm() < 1e-12);
        assert!((arc.tangent(1.0) + Vector2::new(0.0, turn)).norm() < 1e-12);
    }
    let straight = [[0.0, 0.0], [1.0, 2.0], [2.0, 4.0]].map(Point2::from);
    assert_eq!(
        Curve::arc_through(straight[0], straight[1], straight[2]),
        None
    );
    let line = line([1.0, 1.0], [4.0, 5.0]);
    assert!(is_near(line.length(), 5.0));
    assert!((line.tangent(0.3) - Vector2::new(0.6, 0.8)).norm() < 1e-12);
    assert_eq!(line.at(0.5), Point2::new(2.5, 3.0));
}

/// Of every size, wherever its circle is.
#[test]
fn arcs_begin_and_end_where_they_are_said_to() {
    // From the right of a circle to its top and to its left, over either side.
    let quarters = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]].map(Vector2::from);
    for size in [1e-8, 1.0, 1e3] {
        for centre in [[0.0, 0.0], [7.0, -3.0], [-0.5, 20.0]] {
            let centre = Point2::from(centre) * size;
            let at = |quarter: usize| centre + quarters[quarter % 4] * size;
            for first in 0..4 {
                for (via, last, sweep) in [(1, 2, PI), (1, 3, 1.5 * PI), (2, 1, -1.5 * PI)] {
                    let (from, via, to) = (at(first), at(first + via), at(first + last));
                    let arc = Curve::arc_through(from, via, to).expect("they lie on no line");
                    let off = (arc.at(0.0) - from).norm() + (arc.at(1.0) - to).norm();
                    assert!(off < 1e-12 * size, "{size}, {centre}, {first}: {off}");
                    let length = size * sweep.abs();
                    assert!((arc.length() / length - 1.0).abs() < 1e-12);
                    let turn = arc.tangent(0.0).dot(&quarters[(first + 1) % 4]);
                    assert!((turn - sweep.signum()).abs() < 1e-12);
                }
            }
        }
    }
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
