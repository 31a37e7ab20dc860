//! What a number may be, and how that is said.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_6, TAU};

use crate::problem::fault_code::FaultCode;

/// An interval of allowed values in SI.
///
/// The outermost ends are far beyond any workshop; they keep masses and squares computable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Limit {
    min: f64,
    max: f64,
    /// Whether `max` itself is too large.
    below: bool,
    /// What is expected, in messages.
    pub expected: &'static str,
}

const fn to(min: f64, max: f64, expected: &'static str) -> Limit {
    Limit {
        min,
        max,
        below: false,
        expected,
    }
}

const fn below(min: f64, max: f64, expected: &'static str) -> Limit {
    Limit {
        min,
        max,
        below: true,
        expected,
    }
}

/// What coverage may be wanted.
const WANTED: &str =
    "a percentage above 0 %, below 100 %, or up to 10000 % for so many times the shot to 98 %";

/// Angles at the ends of their range may be off by a rounding error.
const ROUNDING: f64 = 1e-12;

impl Limit {
    pub const LENGTH: Self = to(1e-9, 1e3, "a length from 0.001 um to 1000 m");
    pub const LENGTH_OR_ZERO: Self = to(0.0, 1e3, "a length from 0 mm to 1000 m");
    pub const SHIFT: Self = to(-1e3, 1e3, "a length from -1000 m to 1000 m");
    pub const DENSITY: Self = to(1.0, 1e5, "a density from 1 kg/m3 to 100000 kg/m3");
    pub const SPEED: Self = to(1e-6, 1e4, "a speed from 1 um/s to 10000 m/s");
    pub const IMPULSE: Self = to(1e-18, 1e6, "an impulse above 0 N.s");
    pub const MASS_FLOW: Self = to(1e-12, 1e6, "a mass flow above 0 kg/min");
    pub const PRESSURE: Self = to(1e-3, 1e10, "a pressure above 0 bar, up to 100000 bar");
    pub const WANTED: Self = below(1e-9, 1.0, WANTED);
    /// Of coverage wanted several times.
    pub const TIMES: Self = to(1.0, 100.0, WANTED);
    pub const HARDNESS: Self = to(9.806_65e6, 9.806_65e10, "a hardness from 1 HB to 10000 HB");
    pub const INCIDENCE: Self = to(
        1e-6,
        FRAC_PI_2 + ROUNDING,
        "an angle above 0 deg, up to 90 deg",
    );
    /// Of a jet that aims above the target; otherwise its exit would be in it.
    pub const INCIDENCE_OR_ZERO: Self =
        to(0.0, FRAC_PI_2 + ROUNDING, "an angle from 0 deg to 90 deg");
    pub const DIVERGENCE: Self = below(0.0, FRAC_PI_2, "a half-angle from 0 deg to below 90 deg");
    pub const ROUGHNESS: Self = to(
        0.0,
        FRAC_PI_6 + ROUNDING,
        "a standard deviation from 0 deg to 30 deg",
    );
    pub const TURN: Self = to(
        -TAU - ROUNDING,
        TAU + ROUNDING,
        "an angle from -360 deg to 360 deg",
    );
    pub const ANGLE_OR_ZERO: Self = to(0.0, TAU + ROUNDING, "an angle from 0 deg to 360 deg");
    /// A standard deviation that is cut at two: the smallest value must stay above 0.
    pub const SPREAD: Self = below(0.0, 0.5, "a percentage from 0 % to below 50 %");
    pub const SHARE: Self = to(0.0, 1.0, "a percentage from 0 % to 100 %");
    pub const BELOW_ALL: Self = below(0.0, 1.0, "a percentage from 0 % to below 100 %");
    pub const ACCURACY: Self = to(1e-9, 1.0, "a percentage above 0 %, up to 100 %");
    pub const DEVIATION: Self = to(0.0, 10.0, "a percentage from 0 % to 1000 %");
    pub const WEIGHT: Self = to(0.0, 1e9, "a number from 0 to 1e9");
    pub const STATIONS: Self = to(2.0, 200.0, "a whole number from 2 to 200");
    pub const TURNS: Self = to(-6283.2, 6283.2, "an angle from -360000 deg to 360000 deg");
    pub const RPM: Self = to(1e-6, 1e6, "turns above 0 rpm, up to 1000000 rpm");
    pub const FEED: Self = to(1e-9, 1e3, "a speed above 0 mm/s, up to 1000 m/s");
    pub const PASSES: Self = to(1.0, 1e4, "`auto`, or a whole number from 1 to 10000");
    pub const RUN_OUT: Self = to(0.0, 1e3, "`auto`, or a length from 0 mm to 1000 m");
    pub const ANGLE_STEP: Self = to(1e-9, TAU + ROUNDING, "an angle above 0 deg, up to 360 deg");
    pub const IMPACTS: Self = to(1.0, 1000.0, "a whole number from 1 to 1000");
    pub const FRICTION: Self = to(0.0, 10.0, "a number from 0 to 10");
    pub const FRACTION: Self = to(0.0, 1.0, "a number from 0 to 1");
    pub const SIGNED_FRACTION: Self = to(-1.0, 1.0, "a number from -1 to 1");

    /// The least number, and the largest with whether it may be reached; for numbers without a unit.
    pub const fn ends(&self) -> (f64, f64, bool) {
        (self.min, self.max, !self.below)
    }

    /// What is wrong with `value`, if anything.
    pub fn complaint(&self, value: f64) -> Option<(FaultCode, &'static str)> {
        if value >= self.min && (value < self.max || (value == self.max && !self.below)) {
            None
        } else if self.min > 0.0 && value <= 0.0 {
            Some((FaultCode::NotPositive, "must be more than 0"))
        } else if self.min == 0.0 && value < 0.0 {
            Some((FaultCode::Negative, "must not be negative"))
        } else if value < self.min {
            Some((FaultCode::TooSmall, "is too small"))
        } else {
            Some((FaultCode::TooLarge, "is too large"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::{Dimension, parse};

    #[test]
    fn angles_reach_the_ends_that_are_announced() {
        for (limit, least, most) in [
            (Limit::INCIDENCE_OR_ZERO, 0.0, 90.0),
            (Limit::ROUGHNESS, 0.0, 30.0),
            (Limit::ANGLE_OR_ZERO, 0.0, 360.0),
            (Limit::TURN, -360.0, 360.0),
        ] {
            let complaint = |degrees: f64| {
                let angle = parse(Dimension::Angle, &format!("{degrees} deg")).unwrap();
                limit.complaint(angle)
            };
            let expected = format!("from {least} deg to {most} deg");
            assert!(limit.expected.ends_with(&expected), "{}", limit.expected);
            assert_eq!(complaint(least), None, "{expected}");
            assert_eq!(complaint(most), None, "{expected}");
            // A rounding error is forgiven, a millionth of a degree is not.
            assert_eq!(limit.complaint(most.to_radians().next_up()), None);
            assert!(complaint(most + 1e-6).is_some(), "{expected}");
            assert!(complaint(least - 1e-6).is_some(), "{expected}");
        }
        let upright = 90_f64.to_radians();
        assert_eq!(Limit::INCIDENCE.complaint(upright.next_up()), None);
        let beyond = Limit::INCIDENCE.complaint(upright + 1e-9);
        assert_eq!(beyond, Some((FaultCode::TooLarge, "is too large")));
        let turned_back = (-360_f64).to_radians().next_down();
        assert_eq!(Limit::TURN.complaint(turned_back), None);
    }

    #[test]
    fn what_is_wrong_with_a_number_depends_on_its_side() {
        for (limit, value, rule) in [
            (Limit::LENGTH, 0.0, FaultCode::NotPositive),
            (Limit::LENGTH, -1.0, FaultCode::NotPositive),
            (Limit::LENGTH, 0.9e-9, FaultCode::TooSmall),
            (Limit::LENGTH, 1000.1, FaultCode::TooLarge),
            (Limit::LENGTH_OR_ZERO, -1e-9, FaultCode::Negative),
            (Limit::SHIFT, -1000.1, FaultCode::TooSmall),
            (Limit::SIGNED_FRACTION, -1.1, FaultCode::TooSmall),
            (Limit::BELOW_ALL, 1.0, FaultCode::TooLarge),
        ] {
            let found = limit.complaint(value).map(|(rule, _)| rule);
            assert_eq!(found, Some(rule), "{value}: {}", limit.expected);
        }
        for (limit, value) in [
            (Limit::LENGTH, 1e-9),
            (Limit::LENGTH, 1e3),
            (Limit::LENGTH_OR_ZERO, 0.0),
            (Limit::SHIFT, -1e3),
            (Limit::SIGNED_FRACTION, -1.0),
            (Limit::BELOW_ALL, 1.0_f64.next_down()),
        ] {
            assert_eq!(limit.complaint(value), None, "{value}: {}", limit.expected);
        }
    }
}
