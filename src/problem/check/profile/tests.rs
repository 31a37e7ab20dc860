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
fn only_segments_of_one_outline_are_compared() {
    let source = Source::new(Path::new("any.yaml"), b"", String::new());
    let crossings = |second: [f64; 2]| {
        let faults = Faults::new(&source);
        let profile = [
            line([0.0, 0.0], [2.0, 0.0]),
            line([2.0, 0.0], [1.0, 1.0]),
            line(second, [1.0, -1.0]),
        ];
        let plain = no_outline_crosses_itself(&Scope::root(&faults), &profile);
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
