//! Facets in place of exact arcs change the objective at second order in their chord angle.
//!
//! A facet's normal is off by up to half the chord angle, so single impulses are off at first order;
//! but the errors of a facet's two halves cancel, and what is left of an average is of second order.
//! Rebounds that change sides at an edge of a surface cancel only over many shots: they are the
//! scatter that the bounds leave room for.

use std::path::Path;

use peenpose::impact::Restitution;
use peenpose::jet::{Samples, Stream};
use peenpose::objective::Tally;
use peenpose::problem::setting::Settings;
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;

const SHOTS: usize = 1 << 18;

/// One pose of a shipped problem, its shots, and what they do to exact walls.
struct Case {
    exact: Scenario,
    settings: Settings,
    shots: Samples,
    tally: Tally,
}

impl Case {
    fn new(file: &str, incidence_deg: f64, speed: f64) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("problems")
            .join(file);
        let (exact, _) = Scenario::load(&path).unwrap();
        let contacts = &exact.problem.contacts;
        let oiled = contacts.iter().position(|contact| contact.name == "oiled");
        let settings = Settings {
            incidence: incidence_deg.to_radians(),
            azimuth: 0.0,
            standoff: 9e-3,
            speed,
            aim_along: 0.0,
            aim_across: 0.0,
            aim_above: 0.0,
            contact: oiled.unwrap(),
            static_friction: 0.0,
        };
        let shots = Samples::new(&exact.problem, Stream::Search, SHOTS);
        let tally = Tally::trace(&exact, &settings, speed, &shots.shots);
        Self {
            exact,
            settings,
            shots,
            tally,
        }
    }

    /// The same shots from the same pose, on facets.
    fn on_facets(&self, chord_angle: f64) -> Tally {
        let mut scenario = Scenario::new(
            self.exact.problem.clone(),
            Walls::TriangleMesh { chord_angle },
        )
        .unwrap();
        // The facet at the aim point has another normal, which would turn the whole jet.
        scenario.target.frame = self.exact.target.frame;
        Tally::trace(
            &scenario,
            &self.settings,
            self.settings.speed,
            &self.shots.shots,
        )
    }

    fn objective(&self, tally: &Tally) -> f64 {
        let goals = &self.exact.problem.goals;
        tally.terms(goals, self.settings.speed).total()
    }

    /// J on facets less J on exact walls, relative to the latter.
    fn relative_error(&self, facets: &Tally) -> f64 {
        self.objective(facets) / self.objective(&self.tally) - 1.0
    }
}

/// By how many powers of the chord angle an error falls from each angle to its half.
fn orders(errors: &[f64]) -> Vec<f64> {
    let falls = errors.windows(2).map(|pair| (pair[0] / pair[1]).log2());
    falls.collect()
}

#[test]
fn rebounds_in_the_bore_of_a_keyway_converge_at_second_order() {
    // In the short hub six shots out of seven rebound into the bore, in the long one all of them.
    for (file, incidence_deg) in [("keyway.yaml", 82.0), ("keyway-long.yaml", 65.0)] {
        let case = Case::new(file, incidence_deg, 9.5);
        let error = |angle_deg: f64| case.relative_error(&case.on_facets(angle_deg.to_radians()));
        let errors = [32.0, 16.0, 8.0, 4.0].map(error);
        let found = orders(&errors);
        let what = format!("{file}: errors {errors:?}, orders {found:?}");
        assert!(
            found.iter().all(|order| (1.6..2.9).contains(order)),
            "{what}"
        );
        assert!(errors[3].abs() < 5e-4, "{what}");
    }
}

#[test]
fn hits_in_the_fillet_of_a_fir_tree_converge_as_theory_says() {
    let case = Case::new("firtree.yaml", 33.0, 84.0);
    assert_eq!(case.tally.hits.len(), SHOTS);
    let mut largest = Vec::new();
    for angle_deg in [16.0_f64, 8.0, 4.0, 2.0] {
        let chord_angle = angle_deg.to_radians();
        let facets = case.on_facets(chord_angle);
        assert_eq!(facets.hits.len(), SHOTS);
        let hits = facets.hits.iter().zip(case.tally.hits.iter());
        let errors: Vec<f64> = hits
            .map(|(facet, exact)| facet.normal / exact.normal - 1.0)
            .collect();
        largest.push(errors.iter().fold(0.0, |most: f64, e| most.max(e.abs())));
        // With normals off by +-chord_angle/2, evenly spread, the mean of their cosine.
        let expected = -chord_angle.powi(2) / 24.0;
        let mean = errors.iter().sum::<f64>() / SHOTS as f64;
        assert!((mean / expected - 1.0).abs() < 0.15, "{mean} {expected}");
        let error = case.relative_error(&facets);
        assert!(
            error.abs() < 3.0 * chord_angle.powi(2),
            "{error} at {angle_deg} deg"
        );
    }
    let found = orders(&largest);
    assert!(
        found.iter().all(|order| (0.6..1.4).contains(order)),
        "{largest:?}, orders {found:?}"
    );
}

#[test]
fn facets_agree_with_exact_walls_whatever_effect_is_left_out() {
    for (file, incidence_deg) in [("keyway-long.yaml", 65.0), ("keyway.yaml", 80.0)] {
        let mut case = Case::new(file, incidence_deg, 9.5);
        case.exact.problem.shot.size_spread = 0.05;
        for contact in &mut case.exact.problem.contacts {
            contact.contact.restitution = Restitution::Falling {
                reference: 0.3,
                speed: 8.0,
                exponent: 0.25,
            };
        }
        let whole = case.exact.clone();
        for effect in whole.problem.effects() {
            case.exact = whole.without(&[effect], &case.settings);
            case.shots = Samples::new(&case.exact.problem, Stream::Search, SHOTS / 8);
            let tally = |scenario: &Scenario| {
                let (settings, shots) = (&case.settings, &case.shots.shots);
                Tally::trace(scenario, settings, settings.speed, shots)
            };
            let exact = case.objective(&tally(&case.exact));
            let facets = case.objective(&case.on_facets(1_f64.to_radians()));
            let error = facets / exact - 1.0;
            assert!(error.abs() < 2e-3, "{file} without {effect:?}: {error}");
        }
    }
}
