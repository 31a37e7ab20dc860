//! `stroke`: where the nozzle travels while it peens.

use nalgebra::{Point3, Vector3};

use super::coordinates::Coordinates;
use super::scope::Scope;
use crate::problem::Limit;
use crate::problem::fault::one_of;
use crate::problem::fault_code::FaultCode;
use crate::problem::field::Field;
use crate::problem::file::Triple;
use crate::problem::file::settings::OneOrMany;
use crate::problem::file::stroke::{
    AlongEntry, AroundEntry, AxisEntry, Choice, StepsEntry, StrokeEntry,
};
use crate::problem::setting::{Setting, for_each_setting};
use crate::problem::stroke::{Feed, Helix, Hold, Line, Stroke};
use crate::units::{self, Dimension};

pub(super) fn check(
    scope: &Scope<'_>,
    entry: &StrokeEntry,
    coordinates: &Coordinates<'_>,
) -> Option<Stroke> {
    let line = line(scope, entry, coordinates);
    let stations = scope.optional("stations", &entry.stations, 9.0);
    let hold = hold(scope, &entry.hold);
    let steps = entry
        .steps
        .or(StepsEntry::default())
        .and_then(|entry| steps(&scope.of("steps"), &entry));
    let feed = feed(scope, &entry.feed, !entry.around.is_given());
    let passes = passes(scope, &entry.passes);
    let run_out = run_out(scope, &entry.run_out);
    Some(Stroke {
        line: line?,
        stations: stations? as usize,
        hold: hold?,
        steps: steps?,
        feed: feed?,
        passes: passes?,
        run_out: run_out?,
    })
}

fn line(scope: &Scope<'_>, entry: &StrokeEntry, coordinates: &Coordinates<'_>) -> Option<Line> {
    let given = [
        entry.along.is_given(),
        entry.points.is_given(),
        entry.around.is_given(),
    ];
    match given.iter().filter(|&&it| it).count() {
        1 => {}
        0 => {
            if !StrokeEntry::LINES
                .iter()
                .any(|name| scope.is_misspelt(name))
            {
                let fault = scope.own_fault(
                    FaultCode::NoneOfSeveral,
                    "says nothing of where the nozzle travels",
                );
                scope.report(fault.expecting(one_of(&StrokeEntry::LINES)));
            }
            return None;
        }
        _ => {
            let named = StrokeEntry::LINES
                .iter()
                .zip(given)
                .filter(|(_, given)| *given);
            let names: Vec<&str> = named.map(|(name, _)| *name).collect();
            let fault = scope.fault(
                FaultCode::EitherOr,
                names[1],
                format!("stands beside `{}`", names[0]),
            );
            scope.report(fault.expecting(format!("only one of {}", names.join(", "))));
            return None;
        }
    }
    if let Some(entry) = entry.along.value() {
        return along(&scope.of("along"), entry, coordinates).map(Line::Straight);
    }
    if let Some(points) = entry.points.value() {
        return self::points(&scope.of("points"), points, coordinates).map(Line::Points);
    }
    around(&scope.of("around"), entry.around.value()?, coordinates).map(Line::Around)
}

fn along(
    scope: &Scope<'_>,
    entry: &AlongEntry,
    coordinates: &Coordinates<'_>,
) -> Option<[Point3<f64>; 2]> {
    let from = scope.required("from", &entry.from, "a point `[x, y, z]`");
    let from = from.and_then(|from| coordinates.point(&scope.of("from"), from));
    let to = scope.required("to", &entry.to, "a point `[x, y, z]`");
    let to = to.and_then(|to| coordinates.point(&scope.of("to"), to));
    let ends = [from?, to?];
    has_extent(&scope.of("to"), &ends).then_some(ends)
}

fn points(
    scope: &Scope<'_>,
    points: &[Field<Triple>],
    coordinates: &Coordinates<'_>,
) -> Option<Vec<Point3<f64>>> {
    if points.len() < 2 {
        let message = format!("is a list of {}", points.len());
        let fault = scope.own_fault(FaultCode::WrongLength, message);
        scope.report(fault.expecting("two points or more"));
        return None;
    }
    let mut found = Vec::new();
    for (index, point) in points.iter().enumerate() {
        let item = scope.item(index);
        match point {
            Field::Present(point) => found.push(coordinates.point(&item, point)),
            Field::Faulty => found.push(None),
            Field::Missing => {
                item.report(
                    item.own_fault(FaultCode::Missing, "is missing")
                        .expecting("a point `[x, y, z]`"),
                );
                found.push(None);
            }
        }
    }
    let found: Vec<Point3<f64>> = found.into_iter().collect::<Option<_>>()?;
    let mut sound = true;
    for (index, pair) in found.windows(2).enumerate() {
        sound &= has_extent(&scope.item(index + 1), pair);
    }
    sound.then_some(found)
}

/// Whether the last point is another one than that before it.
fn has_extent(scope: &Scope<'_>, pair: &[Point3<f64>]) -> bool {
    let is_apart = (pair[1] - pair[0]).norm() >= SHORTEST;
    if !is_apart {
        let fault = scope.own_fault(FaultCode::NoExtent, "is the point before it again");
        scope.report(fault.expecting("another point"));
    }
    is_apart
}

/// Two points of a stroke are at least this far apart, m.
const SHORTEST: f64 = 1e-9;

fn around(scope: &Scope<'_>, entry: &AroundEntry, coordinates: &Coordinates<'_>) -> Option<Helix> {
    let axis = scope
        .required("axis", &entry.axis, "`x`, `y` or `z`")
        .map(|axis| match axis {
            AxisEntry::X => Vector3::x(),
            AxisEntry::Y => Vector3::y(),
            AxisEntry::Z => Vector3::z(),
        });
    let through = match &entry.through {
        Field::Missing => Some(Point3::origin()),
        Field::Faulty => None,
        Field::Present(point) => coordinates.point(&scope.of("through"), point),
    };
    let from = scope.needed("from", &entry.from);
    let to = scope.needed("to", &entry.to);
    let pitch = scope.optional("pitch", &entry.pitch, 0.0);
    let (from, to) = (from?, to?);
    if from >= to {
        let fault = scope.fault(FaultCode::UpsideDown, "to", "is not larger than `from`");
        scope
            .report(fault.expecting(
                "a larger angle; a pitch below 0 mm moves the other way along the axis",
            ));
        return None;
    }
    Some(Helix {
        through: through?,
        axis: axis?,
        angles: [from, to],
        pitch: pitch?,
    })
}

/// Names that may stand in `hold`.
fn names() -> Vec<&'static str> {
    let settings = Setting::OF_THE_NOZZLE.into_iter().map(Setting::name);
    settings.chain(["contact"]).collect()
}

fn hold(scope: &Scope<'_>, field: &Field<OneOrMany>) -> Option<Hold> {
    let names_of_list = match field {
        Field::Missing => return Some(Hold::All),
        Field::Faulty => return None,
        Field::Present(OneOrMany::One(name)) => match name.as_str() {
            "all" => return Some(Hold::All),
            "none" => Vec::new(),
            _ => vec![(scope.of("hold"), Some(name.as_str()))],
        },
        Field::Present(OneOrMany::Many(names)) => {
            let list = scope.of("hold");
            let each = names.iter().enumerate();
            each.map(|(index, name)| (list.item(index), name.value().map(String::as_str)))
                .collect()
        }
    };
    let known = names();
    let (mut settings, mut contact, mut sound) = (Vec::new(), false, true);
    for (item, name) in names_of_list {
        let Some(name) = name else {
            sound = false;
            continue;
        };
        let of_name = |setting: &Setting| setting.name() == name;
        match Setting::OF_THE_NOZZLE.into_iter().find(of_name) {
            Some(setting) if !settings.contains(&setting) => settings.push(setting),
            None if name == "contact" && !contact => contact = true,
            Some(_) | None if known.contains(&name) => {
                let fault =
                    item.own_fault(FaultCode::NamedTwice, format!("`{name}` is named twice"));
                item.report(fault.expecting("every setting once"));
                sound = false;
            }
            _ => {
                let message = format!("there is no setting `{}`", units::shortened(name));
                let fault = item.own_fault(FaultCode::UnknownWord, message);
                let words = known.iter().copied().chain(["all", "none"]);
                item.report(
                    fault
                        .expecting(format!("`all`, `none`, or a list of {}", known.join(", ")))
                        .nearest(name, words),
                );
                sound = false;
            }
        }
    }
    sound.then_some(Hold::Some { settings, contact })
}

fn steps(scope: &Scope<'_>, entry: &StepsEntry) -> Option<Vec<(Setting, f64)>> {
    let mut found = Vec::new();
    macro_rules! each_step {
        ($($variant:ident $field:ident $key:ident $dimension:ident [$($serde:meta)?] $doc:literal,)+) => {
            $(found.push((
                Setting::$variant,
                scope.maybe(stringify!($field), &entry.$field),
            ));)+
        };
    }
    for_each_setting!(each_step);
    let steps = found
        .into_iter()
        .map(|(setting, step)| Some((setting, step?)));
    let steps: Vec<(Setting, Option<f64>)> = steps.collect::<Option<_>>()?;
    let given = steps
        .into_iter()
        .filter_map(|(setting, step)| Some((setting, step?)));
    Some(given.collect())
}

/// The value of a key that may be `auto`, by what `read` makes of what is written: a number and what it may be; the outer
/// `None` is a fault.
#[expect(clippy::option_option, reason = "absent and faulty differ")]
fn auto_or(
    scope: &Scope<'_>,
    name: &str,
    field: &Field<Choice>,
    expected: &str,
    read: impl Fn(&Choice) -> Option<(f64, Limit)>,
) -> Option<Option<f64>> {
    match field {
        Field::Missing => Some(None),
        Field::Faulty => None,
        Field::Present(Choice::Text(text)) if text == "auto" => Some(None),
        Field::Present(choice) => {
            if let Some((value, limit)) = read(choice) {
                return scope.within(name, value, limit).map(Some);
            }
            let written = match choice {
                Choice::Text(text) => units::shortened(text),
                Choice::Number(number) => number.to_string(),
            };
            let message = format!("`{written}` is not known here");
            let fault = scope.fault(FaultCode::UnknownWord, name, message);
            scope.report(fault.expecting(expected));
            None
        }
    }
}

/// The turns of a part in a minute, where that is what is written.
fn turns_per_minute(choice: &Choice) -> Option<f64> {
    let Choice::Text(text) = choice else {
        return None;
    };
    units::parse_number(text.strip_suffix("rpm")?.trim())
}

/// A quantity, where that is what is written.
fn quantity(choice: &Choice, dimension: Dimension) -> Option<f64> {
    let Choice::Text(text) = choice else {
        return None;
    };
    units::parse(dimension, text).ok()
}

fn feed(scope: &Scope<'_>, field: &Field<Choice>, is_straight: bool) -> Option<Feed> {
    let expected = "`auto`, a speed such as `5 mm/s`, or for a part that turns `30 rpm`";
    let turns = field.value().and_then(turns_per_minute);
    if let (Some(Choice::Text(text)), Some(_), true) = (field.value(), turns, is_straight) {
        let message = format!("`{}` needs an axis to turn about", units::shortened(text));
        let fault = scope.fault(FaultCode::NoEffect, "feed", message);
        scope.report(fault.expecting("a speed such as `5 mm/s`, or `around` in place of the line"));
        return None;
    }
    let feed = auto_or(scope, "feed", field, expected, |choice| match turns {
        Some(turns) => Some((turns, Limit::RPM)),
        None => Some((quantity(choice, Dimension::Speed)?, Limit::FEED)),
    })?;
    Some(match (feed, turns) {
        (None, _) => Feed::Auto,
        (Some(per_minute), Some(_)) => Feed::Turns(per_minute / 60.0),
        (Some(speed), None) => Feed::Speed(speed),
    })
}

#[expect(clippy::option_option, reason = "absent and faulty differ")]
fn passes(scope: &Scope<'_>, field: &Field<Choice>) -> Option<Option<u32>> {
    let expected = Limit::PASSES.expected;
    let passes = auto_or(scope, "passes", field, expected, |choice| match choice {
        Choice::Number(number) if number.fract() == 0.0 && (1.0..=1e4).contains(number) => {
            Some((*number, Limit::PASSES))
        }
        _ => None,
    })?;
    Some(passes.map(|passes| passes as u32))
}

#[expect(clippy::option_option, reason = "absent and faulty differ")]
fn run_out(scope: &Scope<'_>, field: &Field<Choice>) -> Option<Option<f64>> {
    auto_or(scope, "run_out", field, Limit::RUN_OUT.expected, |choice| {
        Some((quantity(choice, Dimension::Length)?, Limit::RUN_OUT))
    })
}
