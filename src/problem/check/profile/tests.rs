use std::path::Path;

use super::*;
use crate::problem::fault::Fault;
use crate::problem::faults::Faults;
use crate::problem::source::Source;

fn line(from: [f64; 2], to: [f64; 2]) -> Segment {
    Segment {
        from: from.into(),
        to: to.into(),
        via: None,
        surface: "any".to_owned(),
    }
}

#[test]
fn arcs_of_any_size_are_told_from_lines() {
    for size in [1e-6, 1e-3, 1.0, 1e3] {
        let straight = |height: f64| {
            let points = [[0.0, 0.0], [1.0, height], [2.0, 0.0]];
            let [a, b, c] = points.map(|[x, y]| Point2::new(x * size, y * size));
            is_straight(a, b, c)
        };
        // The longest side is 2: the points lie on a line below a height of 2e-9.
        assert!(!straight(0.5), "{size}");
        assert!(!straight(3e-9), "{size}");
        assert!(straight(1e-9), "{size}");
        assert!(straight(0.0), "{size}");
    }
    let [a, b] = [Point2::new(0.0, 0.0), Point2::new(1.0, 1.0)];
    assert!(is_straight(a, a, b) && is_straight(a, b, b));
}

#[test]
fn lines_cross_where_each_ends_on_both_sides_of_the_other() {
    for size in [1e-3, 1.0, 1e3] {
        let along = line([0.0, 0.0], [size, 0.0]);
        let crosses = |from: f64, to: f64| {
            let across = line([0.5 * size, from], [0.5 * size, to]);
            assert_eq!(
                lines_cross(&along, &across),
                lines_cross(&across, &along),
                "{size}: {from} to {to}"
            );
            lines_cross(&along, &across)
        };
        assert!(crosses(-size, size), "{size}");
        // What reaches less than a nanometre beyond only touches.
        assert!(crosses(-1.1e-9, size), "{size}");
        assert!(crosses(1.1e-9, -size), "{size}");
        assert!(!crosses(-0.9e-9, size), "{size}");
        assert!(!crosses(0.9e-9, -size), "{size}");
        assert!(!crosses(0.0, size), "{size}");
        if size == 1.0 {
            assert!(!crosses(-SAME_POINT, size));
            assert!(!crosses(SAME_POINT, -size));
        }
        let beside = line([1.5 * size, -size], [1.5 * size, size]);
        assert!(!lines_cross(&along, &beside), "{size}");
    }
}

#[test]
fn arcs_are_not_taken_for_their_chords() {
    let line = line([0.0, -1.0], [0.0, 1.0]);
    let arc = Segment {
        from: Point2::new(-1.0, 0.0),
        to: Point2::new(1.0, 0.0),
        via: Some(Point2::new(0.0, 1.0)),
        surface: "any".to_owned(),
    };
    assert!(!lines_cross(&line, &arc));
    assert!(!lines_cross(&arc, &line));
}

#[test]
fn only_lines_of_one_outline_are_compared() {
    let source = Source::new(Path::new("any.yaml"), b"", String::new());
    let crossings = |second: [f64; 2]| {
        let faults = Faults::new(&source);
        let profile = [
            line([0.0, 0.0], [2.0, 0.0]),
            line([2.0, 0.0], [1.0, 1.0]),
            line(second, [1.0, -1.0]),
        ];
        let plain = no_lines_cross(&Scope::root(&faults), &profile);
        let found: Vec<String> = faults.into_sorted().iter().map(Fault::to_string).collect();
        assert_eq!(plain, found.is_empty());
        found
    };
    assert_eq!(
        crossings([1.0, 1.0]),
        ["[2]: crosses the line of profile[0]; expected an outline that does not cross itself"]
    );
    // What begins elsewhere is an outline of its own.
    assert_eq!(crossings([1.0, 1.1]), [""; 0]);
}
