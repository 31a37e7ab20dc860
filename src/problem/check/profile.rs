//! The lines and arcs of a cross-section.

mod crossing;

use nalgebra::Point2;

use super::coordinates::Coordinates;
use super::scope::Scope;
use crate::problem::curve::Curve;
use crate::problem::fault_code::FaultCode;
use crate::problem::field::Field;
use crate::problem::file::Pair;
use crate::problem::file::scene::SegmentEntry;
use crate::problem::name::{NAME_EXPECTED, is_name};
use crate::problem::part::{Ends, SAME_POINT, Segment};
use crossing::cross;

/// Checks each segment, and that the outlines are closed where an end is.
///
/// A segment that gives `from` begins a new outline.
pub(super) fn check(
    scope: &Scope<'_>,
    entries: &[Field<SegmentEntry>],
    coordinates: &Coordinates<'_>,
    ends: Option<&Ends>,
) -> Option<Vec<Segment>> {
    if entries.is_empty() {
        scope.report(
            scope
                .own_fault(FaultCode::NothingListed, "is empty")
                .expecting("at least one line or arc"),
        );
        return None;
    }
    let caps = ends.map_or_else(Vec::new, |ends| ends.surface_names());
    let mut segments = Vec::new();
    let mut previous: Option<Point2<f64>> = None;
    for (index, field) in entries.iter().enumerate() {
        let scope = scope.item(index);
        let entry = match field {
            Field::Present(entry) => entry,
            Field::Faulty => {
                previous = None;
                segments.push(None);
                continue;
            }
            Field::Missing => {
                scope.report(
                    scope
                        .own_fault(FaultCode::Missing, "is missing")
                        .expecting("a line or an arc"),
                );
                previous = None;
                segments.push(None);
                continue;
            }
        };
        let from = match &entry.from {
            Field::Present(from) => coordinates.flat_point(&scope.of("from"), from),
            Field::Faulty => None,
            Field::Missing if index == 0 => {
                scope.required_here("from", &entry.from, "the first point, `[x, y]`");
                None
            }
            Field::Missing => previous,
        };
        let surface = surface(&scope, entry, &caps);
        let (to, via) = path(&scope, entry, coordinates);
        previous = to;
        segments.push(segment(&scope, from, to, via, surface));
    }
    let profile: Vec<Segment> = segments.into_iter().collect::<Option<_>>()?;
    let closed = ends.is_none_or(|ends| !(ends.near_closed || ends.far_closed))
        || outlines_close(scope, &profile);
    let plain = no_outline_crosses_itself(scope, &profile);
    (closed && plain).then_some(profile)
}

fn surface(scope: &Scope<'_>, entry: &SegmentEntry, caps: &[&str]) -> Option<String> {
    let name = scope.required("surface", &entry.surface, "the name of the surface")?;
    if !is_name(name) {
        scope.report(
            scope
                .fault(
                    FaultCode::UnusableName,
                    "surface",
                    "cannot be used as a name",
                )
                .expecting(NAME_EXPECTED),
        );
        return None;
    }
    if caps.contains(&name.as_str()) {
        scope.report(
            scope
                .fault(
                    FaultCode::NameOfAnEnd,
                    "surface",
                    format!("`{name}` is the name of a closed end"),
                )
                .expecting("another name"),
        );
        return None;
    }
    Some(name.clone())
}

/// Where a segment leads, and for an arc (outer `Some`) what it passes through.
#[expect(clippy::option_option, reason = "a line and a faulty point differ")]
fn path(
    scope: &Scope<'_>,
    entry: &SegmentEntry,
    coordinates: &Coordinates<'_>,
) -> (Option<Point2<f64>>, Option<Option<Point2<f64>>>) {
    let point =
        |name: &str, field: &Field<Pair>| coordinates.flat_point(&scope.of(name), field.value()?);
    match (entry.line_to.is_given(), entry.arc_to.is_given()) {
        (true, false) => {
            if entry.via.is_given() {
                scope.report_name(
                    scope
                        .fault(FaultCode::NoEffect, "via", "has no effect on a line")
                        .expecting("it beside `arc_to` only"),
                );
            }
            (point("line_to", &entry.line_to), None)
        }
        (false, true) => {
            scope.required_here("via", &entry.via, "a point of the arc, `[x, y]`");
            let via = point("via", &entry.via);
            (point("arc_to", &entry.arc_to), Some(via))
        }
        (true, true) => {
            scope.report_name(
                scope
                    .fault(
                        FaultCode::EitherOr,
                        "arc_to",
                        "a segment is a line or an arc",
                    )
                    .expecting("either line_to or arc_to"),
            );
            (None, None)
        }
        (false, false) => {
            if !scope.is_misspelt("line_to") && !scope.is_misspelt("arc_to") {
                scope.report(
                    scope
                        .own_fault(FaultCode::NoneOfSeveral, "leads nowhere")
                        .expecting("either line_to or arc_to"),
                );
            }
            (None, None)
        }
    }
}

#[expect(clippy::option_option, reason = "a line and a faulty point differ")]
fn segment(
    scope: &Scope<'_>,
    from: Option<Point2<f64>>,
    to: Option<Point2<f64>>,
    via: Option<Option<Point2<f64>>>,
    surface: Option<String>,
) -> Option<Segment> {
    let (from, to) = (from?, to?);
    let via = match via {
        None => None,
        Some(via) => Some(via?),
    };
    let complaint = match via {
        None if (to - from).norm() <= SAME_POINT => {
            Some((FaultCode::NoExtent, "line_to", "the line has no length"))
        }
        Some(_) if (to - from).norm() <= SAME_POINT => Some((
            FaultCode::NoExtent,
            "arc_to",
            "the arc ends where it starts; a full circle takes two arcs",
        )),
        Some(via) if is_straight(from, via, to) => Some((
            FaultCode::StraightArc,
            "via",
            "the three points of the arc lie on one line",
        )),
        _ => None,
    };
    if let Some((rule, name, complaint)) = complaint {
        scope.report(scope.fault(rule, name, complaint));
        return None;
    }
    Some(Segment {
        from,
        to,
        via,
        surface: surface?,
    })
}

/// Whether three points give no circle; two of them may be one.
fn is_straight(a: Point2<f64>, b: Point2<f64>, c: Point2<f64>) -> bool {
    let (ab, bc, ac) = (b - a, c - b, c - a);
    let longest = ab.norm().max(bc.norm()).max(ac.norm());
    let shortest = ab.norm().min(bc.norm());
    shortest <= SAME_POINT || ab.perp(&ac).abs() <= 1e-9 * longest * longest
}

/// Whether no segment of an outline crosses another one of the same outline.
fn no_outline_crosses_itself(scope: &Scope<'_>, profile: &[Segment]) -> bool {
    let curves: Vec<Curve> = profile.iter().map(Segment::curve).collect();
    let mut plain = true;
    let mut start = 0;
    for (index, curve) in curves.iter().enumerate() {
        if index > 0 && !profile[index - 1].leads_to(&profile[index]) {
            start = index;
        }
        let mut earlier = curves[start..index].iter().zip(start..);
        if let Some((other, crossed)) = earlier.find(|(other, _)| cross(other, curve)) {
            let item = scope.item(index);
            let kind = match other {
                Curve::Line { .. } => "line",
                Curve::Arc { .. } => "arc",
            };
            let message = format!("crosses the {kind} of profile[{crossed}]");
            let fault = item.own_fault(FaultCode::CrossingOutline, message);
            item.report(fault.expecting("an outline that does not cross itself"));
            plain = false;
        }
    }
    plain
}

/// Whether every outline ends where it began.
fn outlines_close(scope: &Scope<'_>, profile: &[Segment]) -> bool {
    let mut closed = true;
    let mut start = profile.first().map(|segment| segment.from);
    for (index, segment) in profile.iter().enumerate() {
        let next = profile.get(index + 1);
        if next.is_some_and(|next| segment.leads_to(next)) {
            continue;
        }
        if start.is_some_and(|start| (start - segment.to).norm() > SAME_POINT) {
            scope.report(
                scope
                    .item(index)
                    .own_fault(
                        FaultCode::OpenOutline,
                        "the outline is not closed, so an end cannot be",
                    )
                    .expecting("a last point equal to the first, or `ends: open`"),
            );
            closed = false;
        }
        start = next.map(|next| next.from);
    }
    closed
}

#[cfg(test)]
mod tests;
