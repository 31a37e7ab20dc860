use super::flat::{entry, reciprocal};
use super::walk::{Stop, settle_last};

#[test]
fn rays_from_afar_enter_the_box_round_the_mesh() {
    let enters = |origin: [f64; 3], direction: [f64; 3]| {
        entry(&origin.into(), &direction.map(reciprocal).into(), 2.0)
    };
    assert_eq!(enters([-5.0, 0.0, 0.0], [1.0, 0.0, 0.0]), 3.0);
    assert_eq!(enters([0.0, 9.0, 1.0], [0.0, -1.0, 0.0]), 7.0);
    assert_eq!(enters([-5.0, 3.0, 0.0], [1.0, 0.0, 0.0]), f64::INFINITY);
    assert_eq!(enters([-5.0, 0.0, 0.0], [-1.0, 0.0, 0.0]), f64::INFINITY);
    // 3-4-5: the first enters at (-2, 1), the second at (-0.5, 2).
    assert_eq!(enters([-5.0, 5.0, 0.0], [0.6, -0.8, 0.0]), 5.0);
    assert_eq!(enters([-5.0, 8.0, 0.0], [0.6, -0.8, 0.0]), 7.5);
    assert_eq!(enters([-5.0, 12.0, 0.0], [0.6, -0.8, 0.0]), f64::INFINITY);
    assert_eq!(enters([0.0, 0.0, 1.0], [0.6, -0.8, 0.0]), 0.0);
}

#[test]
fn the_nearest_stop_is_the_last() {
    let mut stops: Vec<Stop> = Vec::new();
    for entry in [3.0, 1.0, 2.0, 5.0, 4.0, 0.5] {
        stops.push(Stop::new(7 + entry as u32, entry));
        settle_last(&mut stops);
    }
    let entries: Vec<f32> = stops.iter().map(|stop| stop.entry()).collect();
    assert_eq!(entries, [5.0, 4.0, 3.0, 2.0, 1.0, 0.5]);
    assert!(
        stops
            .iter()
            .all(|stop| stop.child() == 7 + stop.entry() as u32)
    );
}

#[test]
fn reciprocals_stay_finite_and_keep_their_sign() {
    assert_eq!([4.0, -0.5].map(reciprocal), [0.25, -2.0]);
    assert_eq!([0.0, -0.0].map(reciprocal), [1e30, -1e30]);
    assert_eq!([1e-31, -1e-31].map(reciprocal), [1e30, -1e30]);
}
