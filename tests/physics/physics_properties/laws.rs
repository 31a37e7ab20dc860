//! Mechanics along a path.

use nalgebra::Vector3;
use peenpose::impact::Regime;
use peenpose::jet::{Samples, Stream};
use peenpose::trace::{PathImpact, Tracer};
use proptest::prelude::*;

use crate::common::cases::cases;
use crate::common::held::held;
use crate::physics_properties::view::{PLAIN, path};
use crate::physics_properties::world::{meshed_world, world};

/// Relative to the speeds of an impact; ten times that of impacts on normals of exactly unit length.
const ROUNDING: f64 = 1e-11;

/// A shot just before an impact.
#[derive(Clone, Copy)]
struct Arrival {
    velocity: Vector3<f64>,
    rolling: Vector3<f64>,
}

impl Arrival {
    /// Per unit mass.
    fn energy(&self) -> f64 {
        0.5 * self.velocity.norm_squared() + 0.2 * self.rolling.norm_squared()
    }

    fn slip(&self, normal: &Vector3<f64>) -> Vector3<f64> {
        self.velocity - normal * self.velocity.dot(normal) + normal.cross(&self.rolling)
    }

    /// Angular momentum about the point of contact, per unit mass and radius.
    fn angular_momentum(&self, normal: &Vector3<f64>) -> Vector3<f64> {
        normal.cross(&self.velocity) + self.rolling * 0.4
    }
}

/// V7 at one impact of a path, by a shot of some mass, kg.
fn obeys_mechanics(
    before: &Arrival,
    impact: &PathImpact,
    mass: f64,
    friction: f64,
) -> Result<(), TestCaseError> {
    let after = Arrival {
        velocity: impact.velocity,
        rolling: impact.rolling,
    };
    let normal = &impact.normal;
    let off = ROUNDING * (before.velocity.norm() + before.rolling.norm());
    let turned = after.angular_momentum(normal) - before.angular_momentum(normal);
    prop_assert!(turned.norm() <= off);
    prop_assert!((after.rolling - before.rolling).dot(normal).abs() <= off);
    prop_assert!(after.energy() <= before.energy() * (1.0 + ROUNDING));
    // The impulses are what changes the velocity.
    let change = after.velocity - before.velocity;
    let across = change - normal * change.dot(normal);
    let unexplained = change.dot(normal) - impact.normal_impulse / mass;
    prop_assert!(unexplained.abs() <= off, "{unexplained:e} {off:e}");
    prop_assert!((across.norm() - impact.tangential_impulse / mass).abs() <= off);
    prop_assert!(before.velocity.dot(normal) < 0.0 && after.velocity.dot(normal) >= -off);
    // Friction is limited, acts against the slip and does not turn it round.
    prop_assert!(impact.tangential_impulse <= friction * impact.normal_impulse + mass * off);
    let (slip, left) = (before.slip(normal), after.slip(normal));
    prop_assert!(across.dot(&slip) <= off * off.max(slip.norm()));
    prop_assert!(left.dot(&slip) >= -off * slip.norm());
    if impact.regime == Regime::Stick {
        prop_assert!(left.norm() <= off);
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(200))]

    /// Every impact, the free flights between them, and what the impulses of a path add up to.
    #[test]
    fn every_impact_and_flight_of_a_path_obeys_mechanics(
        world in prop_oneof![world(), meshed_world()],
    ) {
        let scenario = PLAIN.of(&world);
        let settings = held(&scenario);
        let tracer = Tracer::new(&scenario, &settings, settings.speed);
        for shot in Samples::new(&scenario.problem, Stream::Search, 16).shots {
            let launch = tracer.launch(&shot);
            let mass = scenario.problem.shot.mass() * shot.mass();
            let start = launch.direction * (settings.speed * shot.speed);
            let mut before = Arrival { velocity: start, rolling: Vector3::zeros() };
            let mut at = launch.origin;
            let mut momentum = Vector3::zeros();
            for (count, impact) in (1..).zip(path(&scenario, &shot)) {
                obeys_mechanics(&before, &impact, mass, world.friction())?;
                prop_assert_eq!(impact.number, count);
                // The flight was straight.
                let way = impact.centre - at;
                let aside = way.cross(&before.velocity.normalize()).norm();
                prop_assert!(aside <= ROUNDING * scenario.scene.size(), "{aside}");
                let ahead = way.dot(&before.velocity.normalize());
                prop_assert!(ahead >= -ROUNDING * scenario.scene.size(), "{ahead}");
                // The shot touches the wall and no more.
                let gap = (impact.centre - impact.point).dot(&impact.normal);
                let radius = scenario.problem.shot.radius * shot.size;
                let expected = if world.shots_have_size { radius } else { 0.0 };
                prop_assert!((gap - expected).abs() <= ROUNDING * scenario.scene.size());
                let across = impact.velocity - before.velocity;
                let across = across - impact.normal * across.dot(&impact.normal);
                momentum += impact.normal * impact.normal_impulse
                    + across.try_normalize(0.0).unwrap_or_default() * impact.tangential_impulse;
                at = impact.centre;
                before = Arrival { velocity: impact.velocity, rolling: impact.rolling };
            }
            let kept = (before.velocity - start) * mass - momentum;
            prop_assert!(kept.norm() <= 10.0 * ROUNDING * mass * start.norm());
        }
    }
}
