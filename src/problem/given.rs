//! Values that are given beside a problem file: what the file may say, they may, with the same messages.

mod partial_settings;

pub use partial_settings::{Incomplete, PartialSettings};

use std::f64::consts::{FRAC_PI_2, TAU};

use super::fault::nearest_name;
use super::setting::{Range, Setting, Settings};
use super::{Limit, Problem};
use crate::units::{self, Dimension, shortened};

/// A value of a setting, SI.
///
/// # Errors
/// It is no such value, or lies beyond what a problem file may say.
pub fn setting(setting: Setting, text: &str) -> Result<f64, String> {
    let text = text.trim();
    let value = match setting.dimension() {
        Some(dimension) => units::parse(dimension, text).map_err(|fault| fault.to_string())?,
        None => units::parse_number(text)
            .filter(|value| value.is_finite())
            .ok_or_else(|| {
                let shown = shortened(text);
                format!("`{shown}` is not a friction coefficient such as `0.2`")
            })?,
    };
    within(limit(setting), value, text)?;
    Ok(match setting {
        // 90 deg may come out of the conversion a rounding error too large.
        Setting::Incidence => value.min(FRAC_PI_2),
        _ => value,
    })
}

/// A range `FROM` to `TO` of a setting, SI.
///
/// # Errors
/// One of its ends is wrong, it is upside down or of no width, or wider than a turn.
pub fn range(of: Setting, from: &str, to: &str) -> Result<Range, String> {
    let (min, max) = (setting(of, from)?, setting(of, to)?);
    if min >= max {
        return Err(format!(
            "`{}` is not below `{}`",
            shortened(from),
            shortened(to)
        ));
    }
    let range = Range { min, max };
    if of == Setting::Azimuth && range.width() > TAU * (1.0 + 1e-12) {
        return Err(
            "the range is wider than a full turn; expected at most 360 deg from end to end".into(),
        );
    }
    Ok(range)
}

/// The setting with a name.
///
/// # Errors
/// There is none; with those that there are.
pub fn setting_named(name: &str) -> Result<Setting, String> {
    let mut all = Setting::ALL.into_iter();
    let found = all.find(|setting| setting.name() == name);
    found.ok_or_else(|| unknown("setting", name, &names()))
}

/// The setting with a name, or `None` for `contact`: what is given to be evaluated.
///
/// # Errors
/// It is neither; with all that there are.
pub fn setting_or_contact(name: &str) -> Result<Option<Setting>, String> {
    const CONTACT: &str = "contact";
    if name == CONTACT {
        return Ok(None);
    }
    let names: Vec<&str> = names().into_iter().chain([CONTACT]).collect();
    let found = setting_named(name).map_err(|_| unknown("setting", name, &names))?;
    Ok(Some(found))
}

fn names() -> [&'static str; Setting::ALL.len()] {
    Setting::ALL.map(|setting| setting.name())
}

/// The index of the contact with a name.
///
/// # Errors
/// There is none; with those that there are.
pub fn contact_named(name: &str, problem: &Problem) -> Result<usize, String> {
    let contacts = problem.contacts.iter();
    let names: Vec<&str> = contacts.map(|contact| contact.name.as_str()).collect();
    let found = names.iter().position(|known| *known == name);
    found.ok_or_else(|| unknown("contact", name, &names))
}

/// Says that there is no such thing, and what there is.
pub fn unknown(what: &str, name: &str, known: &[&str]) -> String {
    let nearest = nearest_name(name, known.iter().copied()).map_or_else(String::new, |nearest| {
        format!("; did you mean `{nearest}`?")
    });
    let known = known.join(", ");
    format!("there is no {what} `{name}`; expected one of {known}{nearest}")
}

/// The accuracy of J, relative.
///
/// # Errors
/// It is no percentage, or beyond what a problem file may say.
pub fn accuracy(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let value = units::parse(Dimension::Fraction, text).map_err(|fault| fault.to_string())?;
    within(Limit::ACCURACY, value, text).map(|()| value)
}

/// What is wrong with settings as a whole, wherever they come from: each beyond what a problem file may say,
/// or a jet along the target that does not aim above it.
///
/// # Errors
/// The first fault, with the name of its setting.
pub fn check(settings: &Settings) -> Result<(), String> {
    if settings.incidence == 0.0 && settings.aim_above <= 0.0 {
        return Err("the incidence must be above 0 deg where aim_above is not above 0 mm".into());
    }
    for setting in Setting::ALL {
        let limit = match setting {
            Setting::Incidence if settings.aim_above <= 0.0 => Limit::INCIDENCE,
            _ => limit(setting),
        };
        let value = setting.of(settings);
        let shown = match setting.dimension() {
            Some(Dimension::Angle) => format!("{} deg", setting.to_record(value)),
            Some(Dimension::Length) => format!("{value} m"),
            Some(_) => format!("{value} m/s"),
            None => value.to_string(),
        };
        within(limit, value, &shown).map_err(|fault| format!("{}: {fault}", setting.name()))?;
    }
    Ok(())
}

fn within(limit: Limit, value: f64, text: &str) -> Result<(), String> {
    match limit.complaint(value) {
        Some((_, complaint)) => Err(format!(
            "`{}` {complaint}; expected {}",
            shortened(text),
            limit.expected
        )),
        None => Ok(()),
    }
}

/// What a setting may be anywhere; an incidence of 0 only where the jet aims above the target.
pub(crate) const fn limit(setting: Setting) -> Limit {
    match setting {
        Setting::Incidence => Limit::INCIDENCE_OR_ZERO,
        Setting::Azimuth => Limit::TURN,
        Setting::Standoff => Limit::LENGTH,
        Setting::Speed => Limit::SPEED,
        Setting::AimAlong | Setting::AimAcross | Setting::AimAbove => Limit::SHIFT,
        Setting::StaticFriction => Limit::FRICTION,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_beyond_a_problem_file_is_refused_in_its_words() {
        for (of, text, words) in [
            (
                Setting::Azimuth,
                "1e308deg",
                "`1e308deg` is too large; expected an angle from -360 deg to 360 deg",
            ),
            (
                Setting::Azimuth,
                "-361 deg",
                "is too small; expected an angle from",
            ),
            (
                Setting::Incidence,
                "91deg",
                "is too large; expected an angle from 0 deg to 90 deg",
            ),
            (
                Setting::Standoff,
                "0mm",
                "must be more than 0; expected a length from 0.001 um to 1000 m",
            ),
            (Setting::Standoff, "1e-12mm", "is too small"),
            (
                Setting::Speed,
                "1e-9 m/s",
                "is too small; expected a speed from",
            ),
            (Setting::Speed, "20000 m/s", "is too large"),
            (
                Setting::AimAlong,
                "-2e6 mm",
                "is too small; expected a length from -1000 m to 1000 m",
            ),
            (
                Setting::StaticFriction,
                "11",
                "is too large; expected a number from 0 to 10",
            ),
            (Setting::StaticFriction, "-0.1", "must not be negative"),
            (
                Setting::StaticFriction,
                "nan",
                "is not a friction coefficient",
            ),
            (
                Setting::StaticFriction,
                "1e999",
                "is not a friction coefficient",
            ),
        ] {
            let fault = setting(of, text).expect_err(text);
            assert!(fault.contains(words), "{text}: {fault}");
        }
        assert_eq!(setting(Setting::Incidence, "90 deg"), Ok(FRAC_PI_2));
        assert_eq!(setting(Setting::Azimuth, "-360 deg"), Ok(-TAU));
    }

    #[test]
    fn ranges_and_accuracies_are_those_of_a_file() {
        assert!(range(Setting::Azimuth, "-180deg", "180deg").is_ok());
        let fault = range(Setting::Azimuth, "-200deg", "200deg").expect_err("400 deg");
        assert!(fault.contains("wider than a full turn"), "{fault}");
        assert!(range(Setting::Speed, "5m/s", "5m/s").is_err());
        assert_eq!(accuracy("100 %"), Ok(1.0));
        assert!(accuracy("1e-8 %").is_err() && accuracy("101 %").is_err());
    }
}
