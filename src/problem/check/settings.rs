//! `settings`: what is searched and what is held.

use std::f64::consts::{FRAC_PI_2, TAU};

use super::contacts::Contacts;
use super::scope::Scope;
use crate::problem::Limit;
use crate::problem::fault::one_of;
use crate::problem::fault_code::FaultCode;
use crate::problem::field::{Field, Needed};
use crate::problem::file::quantity::{Quantity, Shift};
use crate::problem::file::settings::{OneOrMany, OneOrRange, SettingsEntry};
use crate::problem::setting::{Range, SettingRanges};

pub(super) fn check(
    scope: &Scope<'_>,
    entry: &SettingsEntry,
    contacts: &Contacts,
) -> Option<SettingRanges> {
    let aim_above = shift(scope, "aim_above", &entry.aim_above);
    let limit = if aim_above.is_some_and(|range| range.min > 0.0) {
        Limit::INCIDENCE_OR_ZERO
    } else {
        Limit::INCIDENCE
    };
    let incidence = needed_within(scope, "incidence", &entry.incidence, limit).map(|range| {
        // 90 deg may come out of the conversion a rounding error too large.
        Range {
            min: range.min.min(FRAC_PI_2),
            max: range.max.min(FRAC_PI_2),
        }
    });
    let azimuth = needed(scope, "azimuth", &entry.azimuth).filter(|range| {
        let sound = range.width() <= TAU * (1.0 + 1e-12);
        if !sound {
            scope.report(
                scope
                    .fault(
                        FaultCode::MoreThanATurn,
                        "azimuth",
                        "the range is wider than a full turn",
                    )
                    .expecting("at most 360 deg from end to end"),
            );
        }
        sound
    });
    let standoff = needed(scope, "standoff", &entry.standoff);
    let speed = needed(scope, "speed", &entry.speed);
    let aim_along = shift(scope, "aim_along", &entry.aim_along);
    let aim_across = shift(scope, "aim_across", &entry.aim_across);
    let contact = chosen(scope, &entry.contact, contacts);
    Some(SettingRanges {
        incidence: incidence?,
        azimuth: azimuth?,
        standoff: standoff?,
        speed: speed?,
        aim_along: aim_along?,
        aim_across: aim_across?,
        aim_above: aim_above?,
        contact: contact?,
    })
}

fn needed<Q: Quantity>(
    scope: &Scope<'_>,
    name: &str,
    field: &Needed<OneOrRange<Q>>,
) -> Option<Range> {
    needed_within(scope, name, field, Q::LIMIT)
}

fn needed_within<Q: Quantity>(
    scope: &Scope<'_>,
    name: &str,
    field: &Needed<OneOrRange<Q>>,
    limit: Limit,
) -> Option<Range> {
    let expected = format!("{}, or a range `[min, max]`", limit.expected);
    let value = scope.required(name, field, &expected)?;
    scope.range_within(name, value, limit)
}

fn shift(scope: &Scope<'_>, name: &str, field: &Field<OneOrRange<Shift>>) -> Option<Range> {
    match field {
        Field::Missing => Some(Range::held(0.0)),
        Field::Faulty => None,
        Field::Present(value) => scope.range(name, value),
    }
}

/// Indices of the contacts that may be chosen, in the order of the file.
fn chosen(scope: &Scope<'_>, field: &Field<OneOrMany>, contacts: &Contacts) -> Option<Vec<usize>> {
    let known: Vec<&str> = contacts.names().collect();
    let mut sound = true;
    let named: Vec<(Scope<'_>, &str)> = match field {
        Field::Missing => return Some((0..known.len()).collect()),
        Field::Faulty => return None,
        Field::Present(OneOrMany::One(name)) => vec![(scope.of("contact"), name)],
        Field::Present(OneOrMany::Many(names)) => {
            let list = scope.of("contact");
            let mut given = Vec::new();
            for (index, name) in names.iter().enumerate() {
                let item = list.item(index);
                match name {
                    Field::Present(name) => given.push((item, name.as_str())),
                    Field::Faulty => sound = false,
                    Field::Missing => {
                        let fault = item.own_fault(FaultCode::Missing, "is missing");
                        item.report(fault.expecting("a contact"));
                        sound = false;
                    }
                }
            }
            if names.is_empty() {
                list.report(
                    list.own_fault(FaultCode::NothingListed, "names no contact")
                        .expecting(one_of(&known)),
                );
                return None;
            }
            given
        }
    };
    let mut indices = Vec::new();
    for (item, name) in named {
        match known.iter().position(|known| *known == name) {
            Some(index) if indices.contains(&index) => {
                item.report(
                    item.own_fault(FaultCode::NamedTwice, format!("`{name}` is named twice"))
                        .expecting("every contact once"),
                );
                sound = false;
            }
            Some(index) => indices.push(index),
            // Without any contact there is a fault already.
            None if contacts.complete => {
                item.report(
                    item.own_fault(
                        FaultCode::UnknownContact,
                        format!("there is no contact `{}`", crate::units::shortened(name)),
                    )
                    .expecting(one_of(&known))
                    .nearest(name, known.iter().copied()),
                );
                sound = false;
            }
            None => sound = false,
        }
    }
    indices.sort_unstable();
    sound.then_some(indices)
}
