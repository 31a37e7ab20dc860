//! Tilts of a surface by hand.

use super::*;

const UP: Triple = [0.0, 0.0, 1.0];

fn near(one: Triple, other: Triple) -> bool {
    (0..3).all(|axis| (one[axis] - other[axis]).abs() < 1e-12)
}

/// Off the wall as from a mirror.
fn mirrored(velocity: Triple) -> impl Fn(Triple) -> Triple {
    move |normal| along(velocity, normal, -2.0 * dot(velocity, normal))
}

#[test]
fn tilts_are_the_roughness_times_normal_numbers_of_the_flight() {
    let sample = ShotSample {
        tilts: 0.37,
        ..ShotSample::NONE
    };
    for flight in 1..5 {
        let [a, b] = normal_pair(sample.tilts, flight);
        assert!(a != 0.0 && b != 0.0);
        assert_eq!(tilt(&sample, flight, 0.25), [0.25 * a, 0.25 * b]);
    }
}

/// The two tangents of a normal are perpendicular to it and to each other.
#[test]
fn a_normal_is_tilted_by_the_angles_whose_tangents_are_given() {
    for normal in [UP, unit([1.0, -2.0, 0.5]), unit([-0.3, 0.1, -1.0])] {
        for tilt in [[0.3, 0.0], [0.0, 0.3], [0.3, -0.4]] {
            let [a, b]: [f64; 2] = tilt;
            let tilted = tilted(normal, tilt).unwrap();
            let cosine = 1.0 / (1.0 + a * a + b * b).sqrt();
            assert!((dot(tilted, normal) - cosine).abs() < 1e-12);
            assert!((dot(tilted, tilted) - 1.0).abs() < 1e-12);
        }
        let [one, other] = [[0.3, 0.0], [0.0, 0.3]].map(|tilt| tilted(normal, tilt).unwrap());
        let cosine = dot(one, normal);
        assert!((dot(one, other) - cosine * cosine).abs() < 1e-12);
    }
}

#[test]
fn a_normal_along_the_reference_has_no_tangents() {
    let normal = unit(REFERENCE);
    assert_eq!(tilted(normal, [0.3, 0.4]), None);
    let there = [-normal[0], -normal[1], -normal[2]];
    let counts = normal_of_impact(normal, [0.3, 0.4], there, mirrored(there));
    assert_eq!(counts, normal);
}

#[test]
fn steep_shots_meet_the_tilted_normal() {
    let velocity = [0.1, 0.2, -1.0];
    let tilt = [0.1, -0.05];
    let counts = normal_of_impact(UP, tilt, velocity, mirrored(velocity));
    assert!(near(counts, tilted(UP, tilt).unwrap()));
    assert!(!near(counts, UP));
}

/// The side of a tilted patch that looks away, or from which the shot would leave into the wall.
#[test]
fn shots_that_cannot_meet_the_tilted_normal_meet_the_true_one() {
    let tilt = [0.5, 0.0];
    let slope = tilted(UP, tilt).unwrap();
    let downhill = [slope[0], slope[1], 0.0];
    let size = dot(downhill, downhill).sqrt();
    let [x, y] = [downhill[0] / size, downhill[1] / size];
    // Flatter than the slope and down it: behind the patch.
    let behind = [x, y, -0.1];
    assert!(dot(behind, slope) > 0.0);
    assert_eq!(normal_of_impact(UP, tilt, behind, |_| UP), UP);
    // Up the slope, the patch is met, but what leaves it must leave the wall as well.
    let against = [-x, -y, -0.1];
    assert!(dot(against, slope) < 0.0);
    let into_the_wall = |_| [1.0, 0.0, -0.1];
    assert_eq!(normal_of_impact(UP, tilt, against, into_the_wall), UP);
    let along_the_wall = |_| [1.0, 0.0, 0.0];
    assert_eq!(normal_of_impact(UP, tilt, against, along_the_wall), UP);
    let off_the_wall = |_| [1.0, 0.0, 0.1];
    assert_eq!(normal_of_impact(UP, tilt, against, off_the_wall), slope);
    // A shot that leaves the wall meets nothing, whatever it meets of the patch.
    let leaving = [-x, -y, 0.1];
    assert!(dot(leaving, slope) < 0.0);
    assert_eq!(normal_of_impact(UP, tilt, leaving, |_| UP), UP);
    let beside = [-x, -y, 0.0];
    assert_eq!(normal_of_impact(UP, tilt, beside, |_| UP), UP);
}
