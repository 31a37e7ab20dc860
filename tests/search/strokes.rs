//! Strokes: one setting along a whole feature, or as few segments as there can be.

use std::path::{Path, PathBuf};

use peenpose::control::Control;
use peenpose::jet::Pose;
use peenpose::problem::change::Change;
use peenpose::problem::setting::Settings;
use peenpose::problem::stroke::{Hold, Line};
use peenpose::record::{Record, StatusRecord};
use peenpose::solve::Answer;
use peenpose::study::{Extras, Study};

/// The file of a shipped problem.
fn shipped(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("problems");
    folder.join(name)
}

fn study(name: &str) -> Study {
    Study::open(&shipped(name)).unwrap_or_else(|rejection| panic!("{rejection}"))
}

fn solved(study: &Study) -> Record {
    let record = study.solve(Extras::default(), &Control::default());
    record.expect("there is a contact")
}

/// The settings of a segment, with the contact of that name.
fn settings(study: &Study, record: &Record, segment: usize) -> Settings {
    let stroke = record.stroke.as_ref().expect("it is a stroke");
    let segment = &stroke.segments[segment];
    let mut contacts = study.problem().contacts.iter();
    let contact = contacts.position(|contact| contact.name == segment.contact);
    Settings {
        contact: contact.expect("it is one of them"),
        ..segment.settings.settings()
    }
}

#[test]
fn one_setting_held_along_the_keyway_passes_wherever_the_nozzle_stands() {
    let study = study("keyway-stroke.yaml");
    let record = solved(&study);
    assert!(record.passes() && record.status == StatusRecord::Converged);
    let stroke = record.stroke.as_ref().unwrap();
    assert_eq!(stroke.segments.len(), 1);
    // Those of the file, and what verdicts want between them.
    assert!(stroke.stations.len() >= 9);
    let settings = settings(&study, &record, 0);
    // Places between the stations, too.
    for millimetres in [5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0] {
        let place = (millimetres - 4.0) / 32.0 - 0.5;
        let standing = study.scenario().standing_at(place);
        assert!((standing.target.frame.aim.z - millimetres * 1e-3).abs() < 1e-12);
        let draw = peenpose::jet::Draw::new(&standing.problem, 0, 16_384);
        let evaluation = peenpose::evaluate::evaluate_streamed(&standing, &settings, &draw);
        let answer = Answer::evaluated(&standing, &settings, Some(evaluation));
        assert!(
            answer.passes(),
            "z = {millimetres} mm: {:?}",
            answer.verdicts
        );
    }
}

/// What a nozzle sweeps is one convex body then, and its distance is found at once; else many places of the stroke are
/// looked at.
#[test]
fn along_a_fillet_and_a_flat_of_facets_the_nozzle_moves_straight_on() {
    let sweep = |name: &str, along: &str| {
        let change = |key: &str, value: &str| Change::new(key, value).unwrap();
        let changes = [
            change("target.within", "{ min: [-9, 3, 5], max: [9, 19, 48] }"),
            change("stroke", &format!("{{ along: {along} }}")),
        ];
        let study = Study::open_changed(&shipped(name), &changes);
        study.unwrap_or_else(|it| panic!("{it}")).scenario().sweep
    };
    let is_half = |sweep: Option<nalgebra::Vector3<f64>>, metres: f64| {
        sweep.is_some_and(|it| (it - nalgebra::Vector3::z() * metres).norm() < 1e-12)
    };
    // A point of the fillet in four digits.
    let fillet = "{ from: [6.0405, 4.694, 8], to: [6.0405, 4.694, 42] }";
    assert!(is_half(sweep("firtree.yaml", fillet), 17e-3));
    let floor = "{ from: [1.234, 18.3, 20], to: [1.234, 18.3, 44] }";
    assert!(is_half(sweep("keyway-blind.yaml", floor), 12e-3));
    // Round the fillet it turns.
    let round = "{ from: [6.0405, 4.694, 25], to: [5.4566, 6.1954, 25] }";
    assert_eq!(sweep("firtree.yaml", round), None);
}

#[test]
fn the_objective_of_a_stroke_is_the_mean_over_its_places() {
    let study = study("keyway-stroke.yaml");
    let scenario = study.scenario();
    let record = solved(&study);
    let settings = settings(&study, &record, 0);
    let places = 32;
    let mean = (0..places)
        .map(|index| {
            let standing = scenario.standing_at((f64::from(index) + 0.5) / f64::from(places) - 0.5);
            let draw = peenpose::jet::Draw::new(&standing.problem, 1, 65_536);
            let evaluation = peenpose::evaluate::evaluate_streamed(&standing, &settings, &draw);
            evaluation.terms.total()
        })
        .sum::<f64>()
        / f64::from(places);
    let objective = record.best.objective.as_ref().unwrap();
    let error = 4.0 * objective.standard_error + 2e-3 * mean;
    assert!(
        (objective.total - mean).abs() < error,
        "{} {mean}",
        objective.total
    );
}

#[test]
fn what_no_setting_passes_is_cut_into_segments_of_one_contact() {
    let study = study("keyway-100.yaml");
    let record = solved(&study);
    let stroke = record.stroke.as_ref().unwrap();
    assert!(record.passes(), "{:?}", record.best.verdicts);
    assert!(stroke.segments.len() > 1);
    let contact = &stroke.segments[0].contact;
    let azimuth = stroke.segments[0].settings.azimuth_deg;
    // Within the accuracy one standoff is as good as another: it does not change on the way.
    let standoff = stroke.segments[0].settings.standoff_m;
    let mut stays = stroke.segments.iter();
    assert!(stays.all(|segment| segment.settings.standoff_m == standoff));
    let mut end = 0.0;
    for (index, segment) in stroke.segments.iter().enumerate() {
        assert!((segment.from_m - end).abs() < 1e-12);
        end = segment.to_m;
        // What is held is held, and the rest is a multiple of its step.
        assert_eq!(
            (&segment.contact, segment.settings.azimuth_deg),
            (contact, azimuth)
        );
        let steps = segment.settings.incidence_deg / 0.5;
        assert!((steps - steps.round()).abs() < 1e-9, "{steps}");
        let settings = settings(&study, &record, index);
        for place in 0..=8 {
            let at = segment.from_m + (segment.to_m - segment.from_m) * f64::from(place) / 8.0;
            let standing = study.scenario().standing_at(at / stroke.length_m - 0.5);
            let draw = peenpose::jet::Draw::new(&standing.problem, 0, 16_384);
            let evaluation = peenpose::evaluate::evaluate_streamed(&standing, &settings, &draw);
            let answer = Answer::evaluated(&standing, &settings, Some(evaluation));
            assert!(
                answer.passes(),
                "segment {index} at {at} m: {:?}",
                answer.verdicts
            );
        }
    }
    assert!((end - stroke.length_m).abs() < 1e-12);
}

#[test]
fn a_stroke_along_which_the_nozzle_fits_nowhere_says_so() {
    let file = shipped("keyway-100.yaml");
    let text = std::fs::read_to_string(&file).unwrap();
    let text = text.replace("clearance: 2 mm", "clearance: 300 mm");
    let study = Study::from_text(&text, &file).unwrap();
    let record = solved(&study);
    assert_eq!(record.status, StatusRecord::NoFeasiblePose);
    assert!(!record.passes() && record.stroke.is_none());
}

#[test]
fn the_same_stroke_is_solved_to_the_same_bits_by_any_number_of_threads() {
    let study = study("keyway-100.yaml").with_accuracy(0.05);
    let of = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let mut record = pool.unwrap().install(|| solved(&study));
        record.work.seconds = 0.0;
        record.to_json().unwrap()
    };
    assert_eq!(of(1), of(3));
}

#[test]
fn a_part_that_turns_brings_every_place_before_a_nozzle_that_keeps_its_attitude() {
    let study = study("bore-turning.yaml");
    let record = solved(&study);
    assert!(record.passes());
    let stroke = record.stroke.as_ref().unwrap();
    assert!((stroke.turns_per_s.unwrap() * stroke.time_s.unwrap() - stroke.turns).abs() < 1e-6);
    let settings = settings(&study, &record, 0);
    let traverse = study.scenario().traverse.as_ref().unwrap();
    for waypoint in &stroke.waypoints {
        assert!((waypoint.pose.direction[2] - 1.0).abs() < 1e-12);
        // Turned back with the part it is the pose there.
        let place = waypoint.at_m / stroke.length_m - 0.5;
        let there = Pose::new(&traverse.frame_at(place), &settings);
        let turn = nalgebra::Rotation3::from_axis_angle(
            &nalgebra::Vector3::z_axis(),
            -waypoint.turn_deg.to_radians(),
        );
        let turned = turn * nalgebra::Point3::from(waypoint.pose.exit_m);
        assert!((turned - there.exit).norm() < 1e-9);
    }
}

/// Shots that meet the rim of the floor before the stroke harm the bore, and those from farther out meet nothing: what
/// is passed on the way there counts.
#[test]
fn a_run_out_ends_where_another_surface_receives_too_much() {
    let file = shipped("keyway-stroke.yaml");
    let evaluated = |changes: &[[&str; 2]]| {
        let changes: Vec<Change> = changes
            .iter()
            .map(|[key, value]| Change::new(key, value).unwrap())
            .collect();
        let study = Study::open_changed(&file, &changes).unwrap();
        let settings = Settings {
            incidence: 59.8_f64.to_radians(),
            standoff: 6e-3,
            speed: 10.04,
            contact: 2,
            static_friction: 0.06,
            ..study.problem().ranges.middle()
        };
        let record = study.evaluate(&settings, 8192, Extras::default(), &Control::default());
        record.unwrap()
    };
    let strict = ["surfaces.hub.bore.share", "1 %"];
    let [before, after] = evaluated(&[strict]).stroke.unwrap().run_outs.unwrap();
    assert_eq!(before.limited_by.as_deref(), Some("hub.bore"));
    assert!((0.5e-3..1.5e-3).contains(&before.length_m), "{before:?}");
    assert!(before.wanted_m > 6e-3 && after.limited_by.is_none());
    assert_eq!(after.length_m, after.wanted_m);
    // As shipped the bore may receive that.
    let [before, _] = evaluated(&[]).stroke.unwrap().run_outs.unwrap();
    assert_eq!(before.length_m, before.wanted_m);
    // The same that is asked for fails on the way to where the spot has left the part.
    let asked = evaluated(&[strict, ["stroke.run_out", "7.5 mm"]]);
    let bore = asked.best.verdicts.iter();
    let bore = bore.clone().find(|it| it.subject == "hub.bore").unwrap();
    assert!(!bore.passes, "{bore:?}");
    assert!((-5e-3..-1e-3).contains(&bore.at_m.unwrap()), "{bore:?}");
}

#[test]
fn shipped_strokes_are_what_their_titles_say() {
    let held = study("keyway-stroke.yaml");
    let stroke = held.problem().stroke.clone().unwrap();
    assert_eq!((stroke.hold, stroke.stations), (Hold::All, 9));
    let turning = study("bore-turning.yaml");
    let stroke = turning.problem().stroke.clone().unwrap();
    assert!(matches!(stroke.line, Line::Around(_)));
}

/// What fails on few shots for all that their shares may be off can pass on many: the search for what passes goes on from
/// there as well. Before, it ended 40 % above.
#[test]
#[ignore = "takes a quarter of a minute"]
fn what_only_many_shots_let_pass_is_refined() {
    let file = shipped("gear-root.yaml");
    let mut text = std::fs::read_to_string(&file).unwrap();
    for (from, to) in [
        // A higher tip beside the gap, which rebounds reach.
        ("from: [-16.3874, 106.7495]", "from: [-17.2068, 112.087]"),
        (
            "min: [0, 85, 20], max: [5, 95, 40]",
            "min: [0, 85, 10], max: [5, 95, 50]",
        ),
        ("aim: [3.3797, 91.4372, 30]", "# aim"),
    ] {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    text += "
stroke:
  along: { from: [3.3797, 91.4372, 20], to: [3.3797, 91.4372, 45] }
  stations: 3
  hold: all
";
    let study = Study::from_text(&text, &file).unwrap_or_else(|it| panic!("{it}"));
    let record = solved(&study.with_seed(4));
    let objective = record.best.objective.as_ref().unwrap().total;
    // The least J of four seeds is 0.019.
    assert!(record.passes() && objective < 0.024, "{objective}");
}
