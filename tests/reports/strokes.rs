//! Programs of strokes, read back.

use std::collections::BTreeMap;
use std::path::Path;

use peenpose::control::Control;
use peenpose::record::StrokeRecord;
use peenpose::report::program;
use peenpose::study::{Extras, Study};

fn stroke(name: &str) -> StrokeRecord {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("problems");
    let study = Study::open(&folder.join(name)).unwrap_or_else(|rejection| panic!("{rejection}"));
    let record = study.solve(Extras::default(), &Control::default()).unwrap();
    record.stroke.unwrap()
}

/// mm, and the ends of unit vectors.
const NEAR: f64 = 1e-6;

fn assert_near(found: &[f64], wanted: &[f64]) {
    assert_eq!(found.len(), wanted.len());
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((found - wanted).abs() <= NEAR, "{found} {wanted}");
    }
}

#[test]
fn programs_are_read_back_as_the_stroke_is() {
    for name in ["keyway-stroke.yaml", "bore-turning.yaml"] {
        let stroke = stroke(name);
        assert_eq!(stroke.passes, Some(1));
        for exposure in [1, 4] {
            let files = program::files(&stroke, exposure).unwrap();
            let text = |ending: &str| {
                let file = files.iter().find(|(name, _)| name.ends_with(ending));
                String::from_utf8(file.unwrap().1.clone()).unwrap()
            };
            let feed = stroke.feed_m_s.unwrap() * 6e4 / f64::from(exposure);
            let csv = text(".csv");
            let mut rows = csv.lines().skip(1);
            for (index, waypoint) in stroke.waypoints.iter().enumerate() {
                let cells: Vec<&str> = rows.next().unwrap().split(',').collect();
                let numbers: Vec<f64> = cells[1..13].iter().map(|it| it.parse().unwrap()).collect();
                let pose = &waypoint.pose;
                assert_near(&numbers[1..4], &pose.exit_m.map(|length| length * 1e3));
                assert_near(&numbers[4..7], &pose.direction);
                assert_near(&numbers[7..11], &pose.quaternion_xyzw);
                assert_near(&numbers[11..], &[waypoint.turn_deg]);
                if index > 0 {
                    let at_spot: f64 = cells[13].parse().unwrap();
                    assert!((at_spot / feed - 1.0).abs() < 1e-12, "{at_spot} {feed}");
                }
            }
            assert_eq!(rows.next(), None);
            let apt = text(".apt");
            let moves = apt.lines().filter_map(|line| line.strip_prefix("GOTO/"));
            let moves: Vec<Vec<f64>> = moves
                .map(|line| line.split(", ").map(|it| it.parse().unwrap()).collect())
                .collect();
            assert_eq!(moves.len(), stroke.waypoints.len());
            for (numbers, waypoint) in moves.iter().zip(&stroke.waypoints) {
                assert_near(&numbers[..3], &waypoint.pose.exit_m.map(|it| it * 1e3));
                assert_near(&numbers[3..], &waypoint.pose.direction.map(|it| -it));
            }
            let paths: Vec<Vec<Vec<BTreeMap<String, f64>>>> =
                serde_saphyr::from_str(&text(".yaml")).unwrap();
            assert_eq!((paths.len(), paths[0].len()), (1, 1));
            for (pose, waypoint) in paths[0][0].iter().zip(&stroke.waypoints) {
                assert_near(
                    &["x", "y", "z"].map(|key| pose[key] * 1e3),
                    &waypoint.pose.exit_m.map(|it| it * 1e3),
                );
                let quaternion = ["qx", "qy", "qz", "qw"].map(|key| pose[key]);
                assert_near(&quaternion, &waypoint.pose.quaternion_xyzw);
            }
        }
    }
}

/// Where the exit of a straight stroke travels as far as the spot, the feeds of both are the same.
#[test]
fn the_tip_is_as_fast_as_the_spot_on_a_straight_stroke() {
    let stroke = stroke("keyway-stroke.yaml");
    let files = program::files(&stroke, 1).unwrap();
    let (_, csv) = files.iter().find(|(name, _)| name == "stroke.csv").unwrap();
    for row in std::str::from_utf8(csv).unwrap().lines().skip(2) {
        let feeds: Vec<f64> = row
            .split(',')
            .skip(13)
            .map(|it| it.parse().unwrap())
            .collect();
        assert!((feeds[0] / feeds[1] - 1.0).abs() < 1e-9, "{row}");
    }
}
