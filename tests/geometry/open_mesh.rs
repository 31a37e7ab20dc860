//! A keyway given as an open mesh, as exporters and scripts write it: where its triangles look to the
//! enclosed side, that is free; where they do not, the file must say which side is.

use std::fmt::Write as _;

use peenpose::evaluate::evaluate;
use peenpose::jet::Replicates;
use peenpose::problem::fault_code::FaultCode;
use peenpose::problem::setting::Settings;
use peenpose::scenario::Scenario;

use crate::common::shipped;

/// The keyway of the shipped problem with chords of about 1 degree, in mm.
fn mesh(flipped: bool) -> String {
    let lip = (15.0_f64 * 15.0 - 16.0).sqrt();
    let start = lip.atan2(-4.0);
    let sweep = std::f64::consts::TAU - 2.0 * (start - std::f64::consts::FRAC_PI_2);
    let mut outline = vec![(4.0, lip), (4.0, 18.3), (-4.0, 18.3)];
    outline.extend((0..=330).map(|k| {
        let angle = start + sweep * f64::from(k) / 330.0;
        (15.0 * angle.cos(), 15.0 * angle.sin())
    }));
    let mut text = String::new();
    for (x, y) in &outline {
        writeln!(text, "v {x} {y} 0\nv {x} {y} 40").unwrap();
    }
    for k in 0..outline.len() - 1 {
        let group = match k {
            0 => "wall_pos",
            1 => "floor",
            2 => "wall_neg",
            _ => "bore",
        };
        let [a, b, c, d] = [1, 2, 4, 3].map(|corner| 2 * k + corner);
        if flipped {
            writeln!(text, "g {group}\nf {a} {d} {c} {b}").unwrap();
        } else {
            writeln!(text, "g {group}\nf {a} {b} {c} {d}").unwrap();
        }
    }
    text
}

fn scenario(flipped: bool, facing: &str) -> Result<Scenario, Vec<FaultCode>> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("hub.obj"), mesh(flipped)).unwrap();
    let problem = include_str!("../../problems/keyway.yaml")
        .replace(
            "keyway: { bore: 30 mm, width: 8 mm, depth: 3.3 mm, length: 40 mm }",
            "mesh: hub.obj",
        )
        .replace(
            "  along: [0, 0, 1]",
            &format!("  along: [0, 0, 1]\n{facing}"),
        );
    assert!(problem.contains("hub.obj"));
    let file = folder.path().join("keyway.yaml");
    std::fs::write(&file, problem).unwrap();
    match Scenario::load(&file) {
        Ok((scenario, _)) => Ok(scenario),
        Err(rejection) => Err(rejection.faults.iter().map(|fault| fault.rule).collect()),
    }
}

#[test]
fn the_target_of_an_open_mesh_faces_the_enclosed_side_if_its_triangles_do() {
    let exact = shipped::scenario("keyway.yaml");
    let settings = Settings {
        incidence: 60_f64.to_radians(),
        azimuth: 20_f64.to_radians(),
        standoff: 9e-3,
        speed: 10.0,
        aim_along: 0.0,
        aim_across: 0.0,
        aim_above: 0.0,
        contact: 1,
        static_friction: 0.0,
    };
    let total = |scenario: &Scenario| {
        let fresh = Replicates::new(&scenario.problem, 0, 1 << 14);
        evaluate(scenario, &settings, &fresh).terms.total()
    };
    let expected = total(&exact);
    let refused = scenario(true, "").err();
    assert_eq!(refused, Some(vec![FaultCode::FreeSideUnclear]));
    let facing = "  facing: [0, -1, 0]";
    for (flipped, facing) in [(false, ""), (false, facing), (true, facing)] {
        let scenario = scenario(flipped, facing).unwrap();
        let away = scenario.target.frame.normal - exact.target.frame.normal;
        assert!(away.norm() < 1e-12);
        let found = total(&scenario);
        assert!(
            (found / expected - 1.0).abs() < 5e-3,
            "{found} {expected}, flipped: {flipped}"
        );
    }
}
