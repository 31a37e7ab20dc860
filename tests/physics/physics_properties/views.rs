//! The same world seen in other ways.

use nalgebra::Vector3;
use peenpose::evaluate::{Evaluation, evaluate};
use peenpose::jet::{Replicates, Samples, ShotSample, Stream, purpose};
use peenpose::objective::{Tally, Terms};
use peenpose::scenario::Scenario;
use peenpose::trace::PathImpact;
use proptest::prelude::*;

use crate::common::cases::cases;
use crate::common::held::held;
use crate::physics_properties::conditioning::{MOST, is_steady, roundings};
use crate::physics_properties::view::{PLAIN, View, path};
use crate::physics_properties::world::{World, world};

pub fn shots(scenario: &Scenario, count: usize) -> Vec<ShotSample> {
    Samples::new(&scenario.problem, Stream::Search, count).shots
}

/// J's terms on some shots.
fn terms(scenario: &Scenario, shots: &[ShotSample]) -> Terms {
    let settings = held(scenario);
    let tally = Tally::trace(scenario, &settings, settings.speed, shots);
    tally.terms(&scenario.problem.goals, settings.speed)
}

fn close(one: f64, other: f64, off: f64) -> Result<(), TestCaseError> {
    let scale = one.abs().max(other.abs());
    prop_assert!((one - other).abs() <= off * scale, "{one:e} {other:e}");
    Ok(())
}

/// A shot and what it becomes in another view.
type Pair = [ShotSample; 2];

/// Compares J on those of the shots which rounding does not lead astray.
fn terms_are_close(one: &Scenario, other: &Scenario, shots: &[Pair]) -> Result<(), TestCaseError> {
    let steady = shots.iter().filter(|[here, _]| is_steady(one, here));
    let (here, there): (Vec<ShotSample>, Vec<ShotSample>) = steady.map(|[a, b]| (*a, *b)).unzip();
    // In some worlds the nozzle is in a wall.
    prop_assert!(here.len() * 8 > shots.len(), "{}", here.len());
    let (one, other) = (terms(one, &here), terms(other, &there));
    close(one.normal_impulse, other.normal_impulse, MOST)?;
    close(one.tangential_impulse, other.tangential_impulse, MOST)?;
    close(one.rebound, other.rebound, MOST)?;
    close(one.miss, other.miss, MOST)
}

/// What a vector of the plain view becomes in another one.
type Vectors<'a> = &'a dyn Fn(&Vector3<f64>) -> Vector3<f64>;

/// The paths of shots in two worlds, given how the places, directions and axes of rotation of one
/// become those of the other, and the factors on impulses and speeds.
struct Comparison<'a> {
    places: Vectors<'a>,
    directions: Vectors<'a>,
    axes: Vectors<'a>,
    impulse: f64,
    speed: f64,
}

impl Comparison<'_> {
    fn paths(&self, one: &Scenario, other: &Scenario, shots: &[Pair]) -> Result<(), TestCaseError> {
        for [here, there] in shots {
            let roundings = roundings(one, here);
            let (here, there) = (path(one, here), path(other, there));
            if roundings.len() == here.len() {
                prop_assert_eq!(here.len(), there.len());
            }
            prop_assert!(roundings.len() <= there.len());
            let momentum = other.problem.shot.mass() * held(other).speed;
            for ((here, there), off) in here.iter().zip(&there).zip(roundings) {
                self.impacts(here, there, off, other.scene.size())?;
                self.impulses(here, there, off * momentum)?;
            }
        }
        Ok(())
    }

    fn impacts(
        &self,
        here: &PathImpact,
        there: &PathImpact,
        off: f64,
        size: f64,
    ) -> Result<(), TestCaseError> {
        prop_assert_eq!((here.number, here.regime), (there.number, there.regime));
        prop_assert_eq!(here.on_target, there.on_target);
        let expected = (self.places)(&here.point.coords);
        let aside = (expected - there.point.coords).norm();
        prop_assert!(aside <= off * size, "{aside:e}");
        let aside = ((self.directions)(&here.normal) - there.normal).norm();
        prop_assert!(aside <= off, "{aside:e}");
        let scale = off * (there.velocity.norm() + there.rolling.norm());
        let expected = (self.directions)(&here.velocity) * self.speed;
        prop_assert!((expected - there.velocity).norm() <= scale);
        let expected = (self.axes)(&here.rolling) * self.speed;
        prop_assert!((expected - there.rolling).norm() <= scale);
        Ok(())
    }

    fn impulses(
        &self,
        here: &PathImpact,
        there: &PathImpact,
        off: f64,
    ) -> Result<(), TestCaseError> {
        let apart = |here: f64, there: f64| (here * self.impulse - there).abs();
        prop_assert!(apart(here.normal_impulse, there.normal_impulse) <= off);
        prop_assert!(apart(here.tangential_impulse, there.tangential_impulse) <= off);
        Ok(())
    }
}

/// Both, from the same shots; in a view of another scale the exit is scaled as well.
pub fn same_in(view: &View, world: &World) -> Result<(), TestCaseError> {
    let (one, other) = (PLAIN.of(world), view.of(world));
    let rotation = view.rotation();
    let turned = |vector: &Vector3<f64>| rotation * vector;
    let comparison = Comparison {
        places: &|place| view.there(&(*place).into()).coords,
        directions: &turned,
        axes: &turned,
        impulse: view.impulse(),
        speed: view.speed,
    };
    let (here, there) = (shots(&one, 256), shots(&other, 256));
    let pairs: Vec<Pair> = here.into_iter().zip(there).map(Pair::from).collect();
    comparison.paths(&one, &other, &pairs[..16])?;
    terms_are_close(&one, &other, &pairs)
}

/// A shot of the mirror's jet: across changes sides.
fn mirrored(shot: &ShotSample) -> ShotSample {
    let [x, y] = shot.exit;
    let [across, upward, forward] = shot.cone;
    ShotSample {
        exit: [-x, y],
        cone: [-across, upward, forward],
        ..*shot
    }
}

fn mirrored_pairs(scenario: &Scenario) -> Vec<Pair> {
    let shots = shots(scenario, 256).into_iter();
    shots.map(|shot| [shot, mirrored(&shot)]).collect()
}

/// The same in a mirror.
pub fn same_in_mirror(world: &World) -> Result<(), TestCaseError> {
    let (one, other) = (PLAIN.of(world), PLAIN.of(&world.mirrored()));
    let flip = Vector3::new(-1.0, 1.0, 1.0);
    let comparison = Comparison {
        places: &|place| place.component_mul(&flip),
        directions: &|direction| direction.component_mul(&flip),
        axes: &|axis| -axis.component_mul(&flip),
        impulse: 1.0,
        speed: 1.0,
    };
    let pairs = mirrored_pairs(&one);
    comparison.paths(&one, &other, &pairs[..16])?;
    terms_are_close(&one, &other, &pairs)
}

fn evaluation(scenario: &Scenario) -> Evaluation {
    let fresh = Replicates::new(&scenario.problem, purpose::ANSWERS, 256);
    evaluate(scenario, &held(scenario), &fresh)
}

/// Every figure of an evaluation, and those of each surface with its name without a prefix.
pub fn figures(scenario: &Scenario, prefix: &str) -> (String, Vec<(String, String)>) {
    let Evaluation {
        terms,
        term_errors,
        target,
        surfaces,
        ends,
        rays,
        ..
    } = evaluation(scenario);
    let names = scenario.scene.surfaces().iter();
    let names = names.map(|name| name.replace(prefix, ""));
    let receipts = surfaces.iter().map(|receipt| format!("{receipt:?}"));
    let mut surfaces: Vec<_> = names.zip(receipts).collect();
    surfaces.sort();
    let all = format!("{terms:?} {term_errors:?} {target:?} {ends:?} {rays}");
    (all, surfaces)
}

proptest! {
    #![proptest_config(cases(40))]

    #[test]
    fn turned_and_moved_worlds_have_turned_and_moved_paths(
        world in world(),
        turn in [-180.0..180.0, -180.0..180.0, -180.0..180.0],
        shift in [-0.1..0.1, -0.1..0.1, -0.1..0.1],
    ) {
        let shift = Vector3::from(shift);
        same_in(&View { turn, shift, ..PLAIN }, &world)?;
    }

    /// Impulses go with density, speed and the third power of length; J stays when its targets go
    /// along.
    #[test]
    fn scaled_worlds_have_scaled_impulses_and_the_same_objective(
        world in world(),
        length in 0.05..20.0,
        density in 0.1..10.0,
        speed in 0.1..10.0,
    ) {
        same_in(&View { length, ..PLAIN }, &world)?;
        same_in(&View { density, ..PLAIN }, &world)?;
        same_in(&View { speed, ..PLAIN }, &world)?;
        same_in(&View { length, density, speed, ..PLAIN }, &world)?;
    }

    #[test]
    fn units_say_the_same(world in world()) {
        for unit in [(1.0, "m"), (1e2, "cm"), (1e6, "um"), (1.0 / 25.4e-3, "in")] {
            same_in(&View { unit, ..PLAIN }, &world)?;
        }
    }

    #[test]
    fn mirrored_worlds_have_mirrored_paths(world in world()) {
        same_in_mirror(&world)?;
    }

    /// From either side of a symmetric slot: exactly with mirrored shots, and within five standard
    /// errors with the same ones.
    #[test]
    fn both_sides_of_a_symmetric_slot_are_alike(world in world()) {
        let world = world.symmetric();
        let one = PLAIN.of(&world);
        let other = PLAIN.of(&world.with_azimuth(-world.azimuth));
        let pairs = mirrored_pairs(&one);
        terms_are_close(&one, &other, &pairs)?;
        let [one, other] = [evaluation(&one), evaluation(&other)];
        let error = one.standard_error.hypot(other.standard_error);
        let apart = (one.terms.total() - other.terms.total()).abs();
        prop_assert!(apart <= 5.0 * error + 1e-12, "{apart} {error}");
    }

    /// To the last bit.
    #[test]
    fn names_do_not_matter(world in world()) {
        let prefix = "zz_";
        let renamed = View { prefix, ..PLAIN }.of(&world);
        prop_assert_eq!(figures(&PLAIN.of(&world), prefix), figures(&renamed, prefix));
    }

    /// Of parts, of rules for surfaces, of contacts and of the sections of a file; to the last bit.
    #[test]
    fn order_does_not_matter(world in world()) {
        let backwards = View { backwards: true, ..PLAIN }.of(&world);
        prop_assert_eq!(figures(&PLAIN.of(&world), "zz_"), figures(&backwards, "zz_"));
    }
}
