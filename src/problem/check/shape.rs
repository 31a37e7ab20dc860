//! Keyways, bores and extrusions.

use super::coordinates::Coordinates;
use super::profile;
use super::scope::Scope;
use crate::problem::fault_code::FaultCode;
use crate::problem::field::Field;
use crate::problem::file::scene::{
    BoreEntry, End, EndsEntry, ExtrudeEntry, KeywayEntry, RevolveEntry, RoundSideEntry,
};
use crate::problem::part::{Ends, Keyway, RoundSide, Shape};

/// A bore with a groove.
pub(super) fn keyway(scope: &Scope<'_>, entry: &KeywayEntry) -> Option<Shape> {
    let bore = scope.needed("bore", &entry.bore);
    let width = scope.needed("width", &entry.width);
    let depth = scope.needed("depth", &entry.depth);
    let length = scope.needed("length", &entry.length);
    let root = scope.optional("root_radius", &entry.root_radius, 0.0);
    let (bore, width, depth, root_radius) = (bore?, width?, depth?, root?);
    if width >= bore {
        scope.report(
            scope
                .fault(
                    FaultCode::GrooveTooWide,
                    "width",
                    "the groove is as wide as the bore, or wider",
                )
                .expecting("a width below the diameter of the bore"),
        );
        return None;
    }
    let (radius, half) = (bore / 2.0, width / 2.0);
    // The walls begin where the groove leaves the round of the bore.
    let wall = radius + depth - (radius * radius - half * half).sqrt();
    let rounding = 1e-12 * bore;
    let expected = if root_radius > half + rounding {
        Some("at most half the width of the groove")
    } else if root_radius > wall + rounding {
        Some("at most the depth of the straight walls")
    } else {
        None
    };
    if let Some(expected) = expected {
        scope.report(
            scope
                .fault(
                    FaultCode::RootTooLarge,
                    "root_radius",
                    "the root does not fit into the groove",
                )
                .expecting(expected),
        );
        return None;
    }
    Some(Shape::Keyway(Keyway {
        bore,
        width,
        depth,
        length: length?,
        root_radius,
    }))
}

/// A round hole or pin.
pub(super) fn bore(scope: &Scope<'_>, entry: &BoreEntry) -> Option<Shape> {
    let diameter = scope.needed("diameter", &entry.diameter);
    let length = scope.needed("length", &entry.length);
    let ends = ends(&entry.ends);
    let free = match &entry.free {
        Field::Missing => None,
        Field::Faulty => return None,
        Field::Present(RoundSideEntry::Inside) => Some(RoundSide::Inside),
        Field::Present(RoundSideEntry::Outside) => Some(RoundSide::Outside),
    };
    Some(Shape::Bore {
        diameter: diameter?,
        length: length?,
        ends: ends?,
        free,
    })
}

/// A cross-section along z.
pub(super) fn extrude(
    scope: &Scope<'_>,
    entry: &ExtrudeEntry,
    coordinates: &Coordinates<'_>,
) -> Option<Shape> {
    let length = scope.needed("length", &entry.length);
    let ends = ends(&entry.ends);
    let profile = scope
        .required("profile", &entry.profile, "a list of lines and arcs")
        .and_then(|segments| {
            profile::check(&scope.of("profile"), segments, coordinates, ends.as_ref())
        });
    Some(Shape::Extrude {
        profile: profile?,
        length: length?,
        ends: ends?,
    })
}

/// A cross-section about z.
pub(super) fn revolve(
    scope: &Scope<'_>,
    entry: &RevolveEntry,
    coordinates: &Coordinates<'_>,
) -> Option<Shape> {
    let segments = scope.required("profile", &entry.profile, "a list of lines and arcs")?;
    let list = scope.of("profile");
    let profile = profile::check(&list, segments, coordinates, None)?;
    for (index, segment) in profile.iter().enumerate() {
        let beyond = segment.curve().least_x() < -ON_AXIS;
        if beyond {
            let fault = list.item(index).own_fault(
                FaultCode::Negative,
                "reaches beyond the axis, where the distance from it is below 0",
            );
            list.report(fault.expecting("points `[distance from the axis, z]`"));
            return None;
        }
    }
    Some(Shape::Revolve { profile })
}

/// What is nearer to the axis than this is on it, m.
const ON_AXIS: f64 = 1e-9;

fn ends(field: &Field<EndsEntry>) -> Option<Ends> {
    let (near, far) = match field {
        Field::Missing => (End::Open, End::Open),
        Field::Faulty => return None,
        Field::Present(EndsEntry::Both(end)) => (*end, *end),
        Field::Present(EndsEntry::Each(each)) => {
            (each.near.or(End::Open)?, each.far.or(End::Open)?)
        }
    };
    Some(Ends {
        near_closed: near == End::Closed,
        far_closed: far == End::Closed,
    })
}
