//! `tolerance`: how exactly a shop sets what is asked for.

use super::limit::Limit;
use super::scope::Scope;
use crate::problem::fault_code::FaultCode;
use crate::problem::file::settings::ToleranceEntry;
use crate::problem::setting::{Range, SettingRanges, Tolerance};

/// Checks the half-widths; against the settings where those are sound.
pub(super) fn check(
    scope: &Scope<'_>,
    entry: &ToleranceEntry,
    settings: Option<&SettingRanges>,
) -> Option<Tolerance> {
    let incidence = scope.optional("incidence", &entry.incidence, Limit::ANGLE_OR_ZERO, 0.0);
    let azimuth = scope.optional("azimuth", &entry.azimuth, Limit::ANGLE_OR_ZERO, 0.0);
    let standoff = scope.optional("standoff", &entry.standoff, Limit::LENGTH_OR_ZERO, 0.0);
    let speed = scope.optional("speed", &entry.speed, Limit::BELOW_ALL, 0.0);
    let aim_along = scope.optional("aim_along", &entry.aim_along, Limit::LENGTH_OR_ZERO, 0.0);
    let aim_across = scope.optional("aim_across", &entry.aim_across, Limit::LENGTH_OR_ZERO, 0.0);
    let aim_above = scope.optional("aim_above", &entry.aim_above, Limit::LENGTH_OR_ZERO, 0.0);
    let restitution = scope.optional("restitution", &entry.restitution, Limit::FRACTION, 0.0);
    let friction = scope.optional("friction", &entry.friction, Limit::BELOW_ALL, 0.0);
    // A faulty half-width is on record; 0 fits anywhere.
    let readable = Tolerance {
        incidence: incidence.unwrap_or_default(),
        azimuth: azimuth.unwrap_or_default(),
        standoff: standoff.unwrap_or_default(),
        aim_along: aim_along.unwrap_or_default(),
        aim_across: aim_across.unwrap_or_default(),
        aim_above: aim_above.unwrap_or_default(),
        speed: speed.unwrap_or_default(),
        ..Tolerance::default()
    };
    let fits = settings.is_none_or(|settings| fits(scope, &readable, settings));
    let tolerance = Tolerance {
        incidence: incidence?,
        azimuth: azimuth?,
        standoff: standoff?,
        aim_along: aim_along?,
        aim_across: aim_across?,
        aim_above: aim_above?,
        speed: speed?,
        restitution: restitution?,
        friction: friction?,
    };
    fits.then_some(tolerance)
}

/// Whether the tolerance leaves something to search, and never reaches beyond what can be set.
fn fits(scope: &Scope<'_>, tolerance: &Tolerance, settings: &SettingRanges) -> bool {
    let absolute = [
        ("incidence", tolerance.incidence, settings.incidence),
        ("azimuth", tolerance.azimuth, settings.azimuth),
        ("standoff", tolerance.standoff, settings.standoff),
        ("aim_along", tolerance.aim_along, settings.aim_along),
        ("aim_across", tolerance.aim_across, settings.aim_across),
        ("aim_above", tolerance.aim_above, settings.aim_above),
        (
            "speed",
            tolerance.speed * settings.speed.max,
            settings.speed,
        ),
    ];
    let mut sound = true;
    for (name, half_width, range) in absolute {
        if !leaves_a_choice(half_width, range) {
            scope.report(
                scope
                    .fault(
                        FaultCode::ToleranceTooWide,
                        name,
                        "is wider than the range that is searched",
                    )
                    .expecting(format!("less than half the range of settings.{name}")),
            );
            sound = false;
        }
    }
    for (name, half_width, range, reached) in [
        (
            "incidence",
            tolerance.incidence,
            settings.incidence,
            "0 deg",
        ),
        ("standoff", tolerance.standoff, settings.standoff, "0 mm"),
    ] {
        let may_fall = name == "incidence" && settings.aims_above();
        if leaves_a_choice(half_width, range) && half_width >= range.min && !may_fall {
            scope.report(
                scope
                    .fault(
                        FaultCode::ToleranceReachesZero,
                        name,
                        format!("lets the {name} fall to {reached}"),
                    )
                    .expecting(format!("less than the smallest settings.{name}")),
            );
            sound = false;
        }
    }
    sound
}

/// A held setting leaves none to begin with, and takes any tolerance.
fn leaves_a_choice(half_width: f64, range: Range) -> bool {
    range.is_held() || 2.0 * half_width <= range.width()
}
