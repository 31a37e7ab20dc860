//! `scene`: the named parts, what each looks like and where it stands.

use std::path::Path;

use nalgebra::{UnitQuaternion, Vector3};

use super::coordinates::Coordinates;
use super::scope::Scope;
use super::{cut, mesh, shape};
use crate::problem::fault::{Fault, one_of};
use crate::problem::fault_code::FaultCode;
use crate::problem::field::{Field, Needed};
use crate::problem::file::Named;
use crate::problem::file::quantity::{Quantity, Turn};
use crate::problem::file::scene::{BaseEntry, MoveEntry, PartEntry, PlaceEntry};
use crate::problem::part::{Part, Place, Shape};

/// The parts of the file by name; `None` for a faulty one.
pub(super) struct Scene {
    /// Each with what could be made of it.
    parts: Vec<(String, Option<Part>)>,
    /// Whether the whole block could be read.
    sound: bool,
}

impl Scene {
    /// All parts, if all of them are sound.
    pub fn sound(&self) -> Option<Vec<Part>> {
        let parts: Option<Vec<Part>> = self.parts.iter().map(|(_, part)| part.clone()).collect();
        parts.filter(|_| self.sound)
    }

    /// Whether the part of a surface moves with the nozzle.
    pub fn moves_with_nozzle(&self, surface: &str) -> bool {
        let part_name = surface.split('.').next().unwrap_or(surface);
        let mut parts = self.parts.iter().filter_map(|(_, part)| part.as_ref());
        parts.any(|part| part.on_nozzle && part.name == part_name)
    }

    /// The full names of all surfaces, of which a mesh file may hold one called `surface`.
    fn known_surfaces(&self, surface: &str) -> Vec<String> {
        let sound = self.parts.iter().filter_map(|(_, part)| part.as_ref());
        sound
            .flat_map(|part| {
                let mut names = full_names(&part.name, &part.shape);
                if matches!(part.shape, Shape::Mesh { .. }) && !surface.is_empty() {
                    names.push(format!("{}.{surface}", part.name));
                }
                names
            })
            .collect()
    }

    /// What is wrong with `name` as the name of a surface, as far as the file alone can tell: the
    /// groups of a mesh file are not known here.
    pub fn surface_fault(&self, key: &str, name: &str) -> Option<Fault> {
        if !self.sound {
            return None;
        }
        if name.trim().is_empty() {
            let fault = Fault::at_key(FaultCode::EmptyText, key, "has no value");
            return Some(fault.expecting("the name of a surface, `part.surface`"));
        }
        let shown = crate::units::shortened(name);
        let (part_name, surface) = name.split_once('.').unwrap_or((name, ""));
        let Some((_, part)) = self.parts.iter().find(|(known, _)| known == part_name) else {
            let names: Vec<&str> = self.parts.iter().map(|(name, _)| name.as_str()).collect();
            let (rule, message) = if surface.is_empty() {
                (
                    FaultCode::NotASurface,
                    format!("`{shown}` is not a surface"),
                )
            } else {
                let part = crate::units::shortened(part_name);
                (FaultCode::UnknownPart, format!("there is no part `{part}`"))
            };
            let fault = Fault::at_key(rule, key, message).expecting(format!(
                "`part.surface` with a part out of {}",
                names.join(", ")
            ));
            let known = self.known_surfaces(surface);
            return Some(fault.nearest(name, known.iter().map(String::as_str)));
        };
        let shape = &part.as_ref()?.shape;
        let full = full_names(part_name, shape);
        let is_mesh = matches!(shape, Shape::Mesh { .. });
        if full.iter().any(|known| known == name) || (is_mesh && !surface.is_empty()) {
            return None;
        }
        let (rule, message) = if surface.is_empty() {
            let message = format!("`{shown}` is a part, not a surface");
            (FaultCode::NotASurface, message)
        } else {
            let message = format!("there is no surface `{shown}`");
            (FaultCode::UnknownSurface, message)
        };
        let expected = match (is_mesh, full.is_empty()) {
            (true, true) => format!("{part_name}.all, or a group of its mesh file"),
            (true, false) => format!("{}, or a group of its mesh file", full.join(", ")),
            _ => format!("one of {}", full.join(", ")),
        };
        let fault = Fault::at_key(rule, key, message).expecting(expected);
        Some(if surface.is_empty() {
            fault
        } else {
            fault.nearest(name, full.iter().map(String::as_str))
        })
    }
}

fn full_names(part: &str, shape: &Shape) -> Vec<String> {
    let names = shape.surface_names().into_iter();
    names.map(|surface| format!("{part}.{surface}")).collect()
}

/// Checks every part; mesh files lie in `folder` or below.
pub(super) fn check(
    root: &Scope<'_>,
    field: &Needed<Named<PartEntry>>,
    coordinates: &Coordinates<'_>,
    folder: &Path,
) -> Scene {
    let expected = "at least one part, such as `hub: { keyway: { .. } }`";
    let Some(Named(entries)) = root.required("scene", field, expected) else {
        return Scene {
            parts: Vec::new(),
            sound: false,
        };
    };
    if entries.is_empty() {
        root.report(
            root.fault(FaultCode::NothingListed, "scene", "has no parts")
                .expecting(expected),
        );
    }
    let scope = root.of("scene");
    let parts: Vec<_> = entries
        .iter()
        .map(|(name, entry)| {
            let valid = scope.valid_name(name);
            let part = scope
                .required(name, entry, "a shape, such as `{ keyway: { .. } }`")
                .and_then(|entry| part(&scope.of(name), name, entry, coordinates, folder))
                .filter(|_| valid);
            (name.clone(), part)
        })
        .collect();
    let cuts_are_sound = cut::check(&scope, entries, &parts);
    Scene {
        sound: !parts.is_empty() && cuts_are_sound,
        parts,
    }
}

fn part(
    scope: &Scope<'_>,
    name: &str,
    entry: &PartEntry,
    coordinates: &Coordinates<'_>,
    folder: &Path,
) -> Option<Part> {
    let place = match &entry.place {
        Field::Missing => Some((Place::default(), BaseEntry::Scene)),
        Field::Faulty => None,
        Field::Present(PlaceEntry::AtOrigin(base)) => Some((Place::default(), *base)),
        Field::Present(PlaceEntry::Moved(entry)) => {
            let scope = scope.of("place");
            let place = self::place(&scope, entry, coordinates);
            place.zip(entry.on.or(BaseEntry::Scene))
        }
    };
    let shapes_given = [
        entry.keyway.is_given(),
        entry.bore.is_given(),
        entry.block.is_given(),
        entry.extrude.is_given(),
        entry.revolve.is_given(),
        entry.mesh.is_given(),
    ];
    let given: Vec<&str> = PartEntry::SHAPES
        .into_iter()
        .zip(shapes_given)
        .filter_map(|(name, given)| given.then_some(name))
        .collect();
    let expected = || format!("exactly {}", one_of(&PartEntry::SHAPES));
    match given.as_slice() {
        [_] => {}
        [] => {
            let missing = "has no shape";
            if !PartEntry::SHAPES
                .iter()
                .any(|shape| scope.is_misspelt(shape))
            {
                scope.report_name(
                    scope
                        .own_fault(FaultCode::NoneOfSeveral, missing)
                        .expecting(expected()),
                );
            }
        }
        [_, second, ..] => {
            scope.report_name(
                scope
                    .fault(FaultCode::EitherOr, second, "is a second shape")
                    .expecting(expected()),
            );
        }
    }
    if !entry.mesh.is_given() && given.len() == 1 {
        for (key, stray) in [
            ("regions", entry.regions.is_given()),
            ("lengths_in", entry.lengths_in.is_given()),
        ] {
            if stray {
                scope.report_name(
                    scope
                        .fault(FaultCode::NoEffect, key, "has no effect on this shape")
                        .expecting("it beside `mesh` only"),
                );
            }
        }
    }
    let keyway = entry
        .keyway
        .value()
        .and_then(|keyway| shape::keyway(&scope.of("keyway"), keyway));
    let bore = entry
        .bore
        .value()
        .and_then(|bore| shape::bore(&scope.of("bore"), bore));
    let block = entry.block.value().and_then(|block| {
        let (min, max) = coordinates.corners(&scope.of("box"), block, coordinates.unit())?;
        Some(Shape::Box { min, max })
    });
    let extrude = entry
        .extrude
        .value()
        .and_then(|extrude| shape::extrude(&scope.of("extrude"), extrude, coordinates));
    let revolve = entry
        .revolve
        .value()
        .and_then(|revolve| shape::revolve(&scope.of("revolve"), revolve, coordinates));
    let mesh = entry
        .mesh
        .value()
        .and_then(|file| mesh::check(scope, file, entry, coordinates, folder));
    let shape = keyway.or(bore).or(block).or(extrude).or(revolve).or(mesh)?;
    if given.len() != 1 {
        return None;
    }
    let (place, base) = place?;
    let cut = cut::names(scope, &entry.cut);
    Some(Part {
        name: name.to_owned(),
        shape,
        place,
        on_nozzle: base == BaseEntry::Nozzle,
        cut: cut?,
    })
}

fn place(scope: &Scope<'_>, entry: &MoveEntry, coordinates: &Coordinates<'_>) -> Option<Place> {
    let shift = match &entry.at {
        Field::Missing => Some(Vector3::zeros()),
        Field::Faulty => None,
        Field::Present(at) => coordinates.point(&scope.of("at"), at).map(|p| p.coords),
    };
    let rotation = match &entry.rotate {
        Field::Missing => Some(UnitQuaternion::identity()),
        Field::Faulty => None,
        Field::Present(angles) => {
            let list = scope.of("rotate");
            let angle = |index: usize| {
                let item = list.item(index);
                if !angles[index].is_given() {
                    item.report(
                        item.own_fault(FaultCode::Missing, "is missing")
                            .expecting(Turn::LIMIT.expected),
                    );
                }
                item.within_own(angles[index].value()?.0, Turn::LIMIT)
            };
            let (x, y, z) = (angle(0), angle(1), angle(2));
            // nalgebra turns about fixed x, then y, then z.
            (|| Some(UnitQuaternion::from_euler_angles(x?, y?, z?)))()
        }
    };
    Some(Place {
        rotation: rotation?,
        shift: shift?,
    })
}
