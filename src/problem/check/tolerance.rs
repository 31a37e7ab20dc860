//! `tolerance`: how exactly a shop sets what is asked for.

use super::scope::Scope;
use crate::problem::fault_code::FaultCode;
use crate::problem::file::settings::ToleranceEntry;
use crate::problem::setting::{Range, Setting, SettingRanges, Tolerance, for_each_setting};

/// Checks the half-widths; against the settings where those are sound.
pub(super) fn check(
    scope: &Scope<'_>,
    entry: &ToleranceEntry,
    settings: Option<&SettingRanges>,
) -> Option<Tolerance> {
    let restitution = scope.optional("restitution", &entry.restitution, 0.0);
    let friction = scope.optional("friction", &entry.friction, 0.0);
    macro_rules! half_widths {
        ($($variant:ident $field:ident $key:ident $dimension:ident [$($serde:meta)?] $doc:literal,)+) => {{
            $(let $field = scope.optional(stringify!($field), &entry.$field, 0.0);)+
            // A faulty half-width is on record; 0 fits anywhere.
            let readable = Tolerance {
                $($field: $field.unwrap_or_default(),)+
                ..Tolerance::default()
            };
            let fits = settings.is_none_or(|settings| fits(scope, &readable, settings));
            let tolerance = Tolerance {
                $($field: $field?,)+
                restitution: restitution?,
                friction: friction?,
            };
            fits.then_some(tolerance)
        }};
    }
    for_each_setting!(half_widths)
}

/// Whether the tolerance leaves something to search, and never reaches beyond what can be set.
fn fits(scope: &Scope<'_>, tolerance: &Tolerance, settings: &SettingRanges) -> bool {
    let mut sound = true;
    for setting in Setting::OF_THE_NOZZLE {
        let (Some(range), name) = (settings.range(setting), setting.name()) else {
            continue;
        };
        let half_width = match setting {
            Setting::Speed => tolerance.speed * range.max,
            _ => tolerance.half_width(setting),
        };
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
            continue;
        }
        let least = match setting {
            Setting::Incidence if !settings.aims_above() => "0 deg",
            Setting::Standoff => "0 mm",
            _ => continue,
        };
        if half_width >= range.min {
            scope.report(
                scope
                    .fault(
                        FaultCode::ToleranceReachesZero,
                        name,
                        format!("lets the {name} fall to {least}"),
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
