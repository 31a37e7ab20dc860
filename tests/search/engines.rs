//! Rays cast by parry and by this program lead to the same answers.

use peenpose::control::Control;
use peenpose::problem::model::Effect;
use peenpose::record::Record;
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::solve::solve;
use peenpose::study::{Extras, Study};

use crate::common::shipped;
use crate::effects::objective;

const CHORD_ANGLE: f64 = std::f64::consts::PI / 180.0;

fn study(file: &str) -> Study {
    Study::open(&shipped::path(file)).unwrap()
}

#[test]
fn both_engines_find_answers_of_equal_objective() {
    for file in ["keyway.yaml", "keyway-blind.yaml"] {
        let study = study(file);
        let mut problem = study.problem().clone();
        problem.paths.shot_size = false;
        let walls = Walls::TriangleMesh {
            chord_angle: CHORD_ANGLE,
        };
        let own = Scenario::new(problem, walls).unwrap();
        let parry = study.with_parry_rays().unwrap();
        assert!(parry.has_parry_rays() && !own.scene.has_parry_rays());
        assert!(!Effect::ShotSize.is_in(parry.problem()));
        assert_eq!(parry.scenario().scene.triangles(), own.scene.triangles());
        let control = Control::default();
        let ((found, error), (expected, other)) = (
            objective(&solve(parry.scenario(), &control)),
            objective(&solve(&own, &control)),
        );
        let tolerable = own.problem.accuracy * expected + 2.0 * error.hypot(other);
        assert!(
            (found - expected).abs() <= tolerable,
            "{file}: {found} {expected} {tolerable}"
        );
    }
}

#[test]
fn a_sheet_says_who_cast_its_rays() {
    let study = study("plate.yaml").with_parry_rays().unwrap();
    let solved = study.solve(Extras::default(), &Control::default());
    let record: Record = solved.unwrap();
    assert!(record.command.ends_with(" --rays parry"));
    let note = record.notes.iter().find(|note| note.name == "parry_rays");
    assert!(note.unwrap().text.contains("points"));
    assert!(record.notes.iter().all(|note| note.name != "point_shots"));
}
