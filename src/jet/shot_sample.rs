//! How single shots deviate from the jet's axis, each a pure function of a point of the unit cube.

use super::qmc_point::{Dimension, QmcPoint};
use crate::elementary::{cube, exp, ln_1p, sin, sin_cos, square};
use crate::problem::Problem;
use crate::problem::equipment::Spread;
use crate::problem::model::Effect;

/// How one shot deviates from the mean shot on the axis; the same for every pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShotSample {
    /// Offset in the exit disc, m.
    pub exit: [f64; 2],
    /// Unit direction in the jet's frame; the last component is along the axis.
    pub cone: [f64; 3],
    /// Factor on the speed, setup tolerance included.
    pub speed: f64,
    /// Factor on the radius.
    pub size: f64,
    /// Sine and cosine of the error in incidence.
    pub incidence: [f64; 2],
    /// Sine and cosine of the error in azimuth.
    pub azimuth: [f64; 2],
    /// Error in standoff, m.
    pub standoff: f64,
    /// Error of the aim point along, across and above, m.
    pub aim: [f64; 3],
    /// Change of the coefficient of restitution.
    pub restitution: f64,
    /// Factor on the friction coefficients.
    pub friction: f64,
    /// Where on a stroke it is fired from, -0.5 to 0.5; 0 for a nozzle that stands still.
    pub place: f64,
    /// What the tilts of rough surfaces are drawn from, in 0 to 1; 0 where none is rough.
    pub tilts: f64,
    /// Importance weight: 1, or less for a boundary sample.
    pub weight: f64,
    /// Whether it is a nominal sample, and not a boundary sample.
    pub of_jet: bool,
}

impl ShotSample {
    /// The mean shot, on the axis.
    pub const NONE: Self = Self {
        exit: [0.0; 2],
        cone: [0.0, 0.0, 1.0],
        speed: 1.0,
        size: 1.0,
        incidence: [0.0, 1.0],
        azimuth: [0.0, 1.0],
        standoff: 0.0,
        aim: [0.0; 3],
        restitution: 0.0,
        friction: 1.0,
        place: 0.0,
        tilts: 0.0,
        weight: 1.0,
        of_jet: true,
    };

    /// All of them, for checksums.
    pub fn numbers(&self) -> [f64; 21] {
        let Self {
            exit: [exit_x, exit_y],
            cone: [cone_x, cone_y, cone_z],
            speed,
            size,
            incidence: [sin_incidence, cos_incidence],
            azimuth: [sin_azimuth, cos_azimuth],
            standoff,
            aim: [along, across, above],
            restitution,
            friction,
            place,
            tilts,
            weight,
            of_jet,
        } = *self;
        [
            exit_x,
            exit_y,
            cone_x,
            cone_y,
            cone_z,
            speed,
            size,
            sin_incidence,
            cos_incidence,
            sin_azimuth,
            cos_azimuth,
            standoff,
            along,
            across,
            above,
            restitution,
            friction,
            place,
            tilts,
            weight,
            f64::from(u8::from(of_jet)),
        ]
    }

    /// Factor on the mass.
    #[inline(always)]
    pub fn mass(&self) -> f64 {
        cube(self.size)
    }

    /// Whether the pose is the one that was asked for.
    #[inline]
    pub fn leaves_pose(&self) -> bool {
        // Number by number: arrays are compared in loops, several times as slow.
        let [sin_incidence, cos_incidence] = self.incidence;
        let [sin_azimuth, cos_azimuth] = self.azimuth;
        let [along, across, above] = self.aim;
        (sin_incidence == 0.0)
            & (cos_incidence == 1.0)
            & (sin_azimuth == 0.0)
            & (cos_azimuth == 1.0)
            & (self.standoff == 0.0)
            & (along == 0.0)
            & (across == 0.0)
            & (above == 0.0)
            & (self.place == 0.0)
    }

    /// The shot at a point of the unit cube.
    pub(super) fn at(problem: &Problem, point: &mut QmcPoint) -> Self {
        let (jet, tolerance) = (&problem.jet, &problem.tolerance);
        Self {
            exit: match problem.paths.exit_width {
                true => exit_offset(jet.exit_diameter / 2.0, point),
                false => [0.0; 2],
            },
            cone: cone_direction(jet.divergence, jet.spread, point),
            speed: point.scatter(jet.speed_spread, Dimension::SpeedScatter)
                * (1.0 + point.within(tolerance.speed, Dimension::SpeedSetting)),
            size: point.scatter(problem.shot.size_spread, Dimension::Size),
            incidence: sine_and_cosine(point.within(tolerance.incidence, Dimension::Incidence)),
            azimuth: sine_and_cosine(point.within(tolerance.azimuth, Dimension::Azimuth)),
            standoff: point.within(tolerance.standoff, Dimension::Standoff),
            aim: [
                point.within(tolerance.aim_along, Dimension::AimAlong),
                point.within(tolerance.aim_across, Dimension::AimAcross),
                point.within(tolerance.aim_above, Dimension::AimAbove),
            ],
            restitution: point.within(tolerance.restitution, Dimension::Restitution),
            friction: 1.0 + point.within(tolerance.friction, Dimension::Friction),
            place: match problem.stroke {
                Some(_) => point.within(0.5, Dimension::Place),
                None => 0.0,
            },
            tilts: if Effect::Roughness.is_in(problem) {
                point.uniform(Dimension::Tilts)
            } else {
                0.0
            },
            weight: 1.0,
            of_jet: true,
        }
    }
}

/// Variance of the shots' factors on the speed, whose mean is 1.
pub fn speed_variance(problem: &Problem) -> f64 {
    let scatter = square(problem.jet.speed_spread) * VARIANCE_WITHIN_TWO_DEVIATIONS;
    let setting = square(problem.tolerance.speed) / 3.0;
    // The factors are products of both: 1 + variance is the product of the mean squares.
    scatter + setting + scatter * setting
}

/// Of a standard normal deviate that is cut at two deviations, 1 - 4 phi(2) / (2 Phi(2) - 1).
const VARIANCE_WITHIN_TWO_DEVIATIONS: f64 = 0.773_741_303_549_923_2;

/// An angle of 0, as of every shot of a nozzle that is set exactly, takes no work.
#[inline]
fn sine_and_cosine(angle: f64) -> [f64; 2] {
    if angle == 0.0 {
        [0.0, 1.0]
    } else {
        sin_cos(angle).into()
    }
}

/// Uniform in a disc.
fn exit_offset(radius: f64, point: &mut QmcPoint) -> [f64; 2] {
    if radius == 0.0 {
        return [0.0; 2];
    }
    let distance = radius * point.inwards(Dimension::ExitRadius).sqrt();
    let (sin, cos) = sin_cos(std::f64::consts::TAU * point.uniform(Dimension::ExitTurn));
    [distance * cos, distance * sin]
}

/// A direction in the cone.
fn cone_direction(half_angle: f64, spread: Spread, point: &mut QmcPoint) -> [f64; 3] {
    if half_angle == 0.0 {
        return [0.0, 0.0, 1.0];
    }
    let share = point.inwards(Dimension::ConeAngle);
    let versine = match spread {
        // Uniform in solid angle: 1 - cos is uniform. sin^2 of the half avoids cancellation.
        Spread::Uniform => 2.0 * square(sin(half_angle / 2.0)) * share,
        Spread::Gaussian => {
            let deviation = half_angle / 2.0;
            let inside = 1.0 - exp(-2.0);
            let angle = deviation * (-2.0 * ln_1p(-share * inside)).sqrt();
            2.0 * square(sin(angle / 2.0))
        }
    };
    let sine = (versine * (2.0 - versine)).sqrt();
    let (sin, cos) = sin_cos(std::f64::consts::TAU * point.uniform(Dimension::ConeTurn));
    [sine * cos, sine * sin, 1.0 - versine]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jet::{Samples, Stream};
    use crate::problem::example::keyway;

    #[test]
    fn the_variance_of_the_speed_is_that_of_many_shots() {
        let mut problem = keyway();
        for (spread, tolerance) in [(0.05, 0.03), (0.4, 0.0), (0.0, 0.5), (0.4, 0.5)] {
            problem.jet.speed_spread = spread;
            problem.tolerance.speed = tolerance;
            let samples = Samples::new(&problem, Stream::Search, 1 << 16);
            let mean = |of: fn(f64) -> f64| {
                let speeds = samples.shots.iter().map(|shot| of(shot.speed));
                speeds.sum::<f64>() / samples.shots.len() as f64
            };
            assert!((mean(|speed| speed) - 1.0).abs() < 1e-5);
            let variance = mean(|speed| (speed - 1.0).powi(2));
            let found = speed_variance(&problem);
            assert!((found / variance - 1.0).abs() < 1e-4, "{found} {variance}");
        }
    }
}
