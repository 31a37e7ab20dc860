//! Programs of strokes, read back.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::LazyLock;

use peenpose::control::Control;
use peenpose::record::{Record, StrokeRecord, WaypointRecord};
use peenpose::report::export::{Format, export};
use peenpose::report::{program, sheet};
use peenpose::study::{Extras, Study};

/// The answers to two problems with their pictures, solved once for all tests.
static ILLUSTRATED: [LazyLock<Record>; 2] = [
    LazyLock::new(|| solved("keyway-stroke.yaml")),
    LazyLock::new(|| solved("bore-turning.yaml")),
];

/// A stroke with its pictures.
pub fn illustrated(name: &str) -> &'static Record {
    let [keyway, bore] = &ILLUSTRATED;
    match name {
        "keyway-stroke.yaml" => keyway,
        "bore-turning.yaml" => bore,
        _ => panic!("{name} is not among them"),
    }
}

fn stroke(name: &str) -> &'static StrokeRecord {
    illustrated(name).stroke.as_ref().expect("it is a stroke")
}

fn solved(name: &str) -> Record {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("problems");
    let study = Study::open(&folder.join(name)).unwrap_or_else(|rejection| panic!("{rejection}"));
    let extras = Extras {
        evidence: true,
        ..Extras::default()
    };
    study.solve(extras, &Control::default()).unwrap()
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
            let files = program::files(stroke, exposure).unwrap();
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
    let files = program::files(stroke, 1).unwrap();
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

/// In glTF the nozzle travels through its waypoints in the time that the feed takes: round the part where that turns.
#[test]
fn the_nozzle_travels_in_gltf() {
    for name in ["keyway-stroke.yaml", "bore-turning.yaml"] {
        let record = illustrated(name);
        let stroke = record.stroke.as_ref().unwrap();
        let bytes = export(record, Format::Glb).unwrap().unwrap();
        let file = gltf::Gltf::from_slice(&bytes).expect("a valid file");
        let blob = file.blob.as_ref().unwrap();
        let animation = file.animations().next().unwrap();
        let (mut bodies, mut turns) = (0, 0);
        for channel in animation.channels() {
            let node = channel.target().node();
            let node = node.name().unwrap();
            assert!(node.starts_with("nozzle, body"), "{node}");
            let reader = channel.reader(|_| Some(blob));
            let times: Vec<f32> = reader.read_inputs().unwrap().collect();
            assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
            let last = f64::from(*times.last().unwrap());
            let takes = stroke.time_s.unwrap();
            assert!((last / takes - 1.0).abs() < 0.01, "{last} {takes}");
            match reader.read_outputs().unwrap() {
                gltf::animation::util::ReadOutputs::Translations(exits) => {
                    bodies += 1;
                    let exits: Vec<[f32; 3]> = exits.collect();
                    assert_eq!(exits.len(), stroke.waypoints.len());
                    for (exit, waypoint) in exits.iter().zip(&stroke.waypoints) {
                        assert_exit(*exit, waypoint);
                    }
                }
                gltf::animation::util::ReadOutputs::Rotations(rotations) => {
                    turns += 1;
                    for it in rotations.into_f32() {
                        let norm: f32 = it.iter().map(|part| part * part).sum();
                        assert!((norm - 1.0).abs() < 1e-5);
                    }
                }
                _ => panic!("only places and directions change"),
            }
        }
        let record_bodies = record.evidence.as_ref().unwrap().nozzle.len();
        assert_eq!(bodies, record_bodies);
        // A ball looks the same from everywhere.
        let expected = if stroke.turns > 0.0 { record_bodies } else { 0 };
        assert_eq!(turns, expected);
    }
}

/// A part that turns about z by an angle sees the nozzle turned back by it.
fn assert_exit(found: [f32; 3], waypoint: &WaypointRecord) {
    let (sin, cos) = (-waypoint.turn_deg).to_radians().sin_cos();
    let [x, y, z] = waypoint.pose.exit_m;
    let wanted = [x * cos - y * sin, x * sin + y * cos, z];
    for (found, wanted) in found.iter().zip(wanted) {
        assert!(
            (f64::from(*found) - wanted).abs() < 1e-7,
            "{found} {wanted}"
        );
    }
}

/// Strips lie on the target: at the beginning, in the middle and at the end of the stroke, and where the map has its least share.
#[test]
fn test_strips_lie_along_the_stroke() {
    for (name, ends) in [
        (
            "keyway-stroke.yaml",
            [[0.0, 18.3, 4.0], [0.0, 18.3, 20.0], [0.0, 18.3, 36.0]],
        ),
        ("bore-turning.yaml", [[0.0; 3]; 3]),
    ] {
        let record = illustrated(name);
        let stroke = record.stroke.as_ref().unwrap();
        let places = &record.evidence.as_ref().unwrap().places;
        let place = |name: &str| {
            let mut places = places.iter().filter(|place| place.name == name);
            places.next().unwrap_or_else(|| panic!("{name}"))
        };
        let along = ["beginning_of_stroke", "middle_of_stroke", "end_of_stroke"];
        for (number, (along, end)) in along.into_iter().zip(ends).enumerate() {
            let place = place(along);
            assert!((place.value - stroke.length_m * number as f64 / 2.0).abs() < 1e-9);
            if name == "keyway-stroke.yaml" {
                assert_near(&place.point_m.map(|it| it * 1e3), &end);
                assert_near(&place.normal, &[0.0, -1.0, 0.0]);
            }
        }
        let least = place("least_dented");
        let shares = &stroke.dented_map.as_ref().unwrap().dented;
        let shares = shares.iter().flatten().map(|&share| f64::from(share));
        assert_near(&[least.value], &[shares.fold(1.0, f64::min)]);
        let [x, y, z] = least.point_m.map(|it| it * 1e3);
        match name {
            // Within half a cell of the border of the strip, 5 mm wide.
            "keyway-stroke.yaml" => {
                assert!(
                    y == 18.3 && x.abs() < 2.5 && (0.0..40.0).contains(&z),
                    "{x} {y} {z}"
                );
                assert!(x.abs() > 1.9 || !(0.6..39.4).contains(&z), "{x} {z}");
            }
            _ => {
                let normal = least.normal;
                let radius = x.hypot(y);
                assert!((normal[0] * x + normal[1] * y + radius).abs() < 1e-6 * radius);
            }
        }
        assert!(places.iter().all(|place| place.name != "shadow_edge"));
    }
}

/// Dents that grow with the hit: a reading at the speed of the hits changes nothing, at half of it dents are larger by the
/// root of two; a hardness gives what its formula says; 200 % takes twice the time to 98 %.
#[test]
fn dents_follow_from_a_reading_or_from_hardness() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("problems");
    let text = std::fs::read_to_string(folder.join("keyway-stroke.yaml")).unwrap();
    let given = "coverage: { dent_diameter: 0.25 mm, wanted: 98 % }";
    let with = |coverage: &str| {
        assert!(text.contains(given));
        let changed = text.replace(given, coverage);
        let study = Study::from_memory(&changed, Path::new("stroke.yaml"), &[]).unwrap();
        let settings = study.problem().ranges.middle();
        let record = study.evaluate(&settings, 4096, Extras::default(), &Control::default());
        let record = record.unwrap();
        (record.coverage.unwrap(), record.stroke.unwrap(), settings)
    };
    let (fixed, stroke, settings) = with(given);
    let (incidence, speed) = (settings.incidence, settings.speed);
    let reading = |speed: f64| {
        let degrees = incidence.to_degrees();
        with(&format!(
            "coverage: {{ dent_diameter: 0.25 mm, measured_at: {{ speed: {speed} m/s, incidence: {degrees} deg }} }}"
        ))
    };
    let (same, ..) = reading(speed);
    let (larger, ..) = reading(speed / 2.0);
    let ratio = same.dent_diameter_m / fixed.dent_diameter_m;
    assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
    let ratio = larger.dent_diameter_m / same.dent_diameter_m;
    assert!((ratio - 2_f64.sqrt()).abs() < 1e-9, "{ratio}");
    let (hard, ..) = with("coverage: { hardness: 250 HB }");
    let normal_speed = speed * incidence.sin();
    let lost = 1.0 - 0.25 * 0.25;
    let work_over_hardness = 7000.0 * normal_speed * normal_speed * lost / (250.0 * 9.806_65e6);
    let expected = 1.278 * 1e-3 * work_over_hardness.powf(0.25);
    let ratio = hard.dent_diameter_m / expected;
    assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
    let (twice, slower, _) = with("coverage: { dent_diameter: 0.25 mm, wanted: 200 % }");
    assert_eq!((twice.wanted, twice.wanted_times), (0.98, 2.0));
    let ratio = stroke.feed_m_s.unwrap() / slower.feed_m_s.unwrap();
    assert!((ratio - 2.0).abs() < 1e-9, "{ratio}");
}

#[test]
fn where_the_nozzle_turns_its_clearance_is_said_to_be_that_of_the_stations() {
    let told = "at the stations of the stroke; between them no less than the 1.5 mm wanted";
    let words = |record: &Record| {
        let sheet = sheet(record);
        let words: Vec<&str> = sheet.split_whitespace().collect();
        words.join(" ")
    };
    assert!(words(illustrated("bore-turning.yaml")).contains(told));
    // Along a straight line all of the way is one body.
    let straight = illustrated("keyway-stroke.yaml");
    assert!(!words(straight).contains("at the stations"));
    // A nozzle that turns with a bent line turns on the way.
    let mut bent = straight.clone();
    let stroke = bent.stroke.as_mut().unwrap();
    assert!(!stroke.turns_on_the_way());
    let middle = stroke.waypoints.len() / 2;
    stroke.waypoints[middle].pose.quaternion_xyzw = [0.0, 0.0, 0.0, 1.0];
    assert!(stroke.turns_on_the_way());
}
