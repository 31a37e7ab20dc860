//! Parts from mesh files.

use std::path::{Component, Path, PathBuf};

use super::coordinates::Coordinates;
use super::scope::Scope;
use crate::problem::LengthUnit;
use crate::problem::fault_code::FaultCode;
use crate::problem::field::Field;
use crate::problem::file::Named;
use crate::problem::file::scene::{PartEntry, RegionEntry};
use crate::problem::part::{Region, RegionPlace, Shape};

/// The mesh `file` of a part, with its unit and regions.
pub(super) fn check(
    scope: &Scope<'_>,
    file: &str,
    entry: &PartEntry,
    coordinates: &Coordinates<'_>,
    folder: &Path,
) -> Option<Shape> {
    let path = mesh_path(scope, file, folder);
    let unit = match &entry.lengths_in {
        Field::Missing => coordinates.unit(),
        Field::Faulty => None,
        Field::Present(unit) => Some(*unit),
    };
    let regions = match &entry.regions {
        Field::Missing => Some(Vec::new()),
        Field::Faulty => None,
        Field::Present(Named(entries)) => {
            let list = scope.of("regions");
            let regions: Vec<Option<Region>> = entries
                .iter()
                .map(|(name, field)| {
                    let valid = list.valid_name(name);
                    let entry = list.required(name, field, PLACE)?;
                    let place = region(&list.of(name), entry, coordinates, unit)?;
                    valid.then(|| Region {
                        name: name.clone(),
                        place,
                    })
                })
                .collect();
            regions.into_iter().collect()
        }
    };
    Some(Shape::Mesh {
        file: path?.into(),
        metres_per_unit: unit?.metres(1.0),
        regions: regions?,
    })
}

/// How a region is told.
const PLACE: &str = "`{ at: [x, y, z] }` or `{ min: [..], max: [..] }`";

/// A face at a point, or a box.
fn region(
    scope: &Scope<'_>,
    entry: &RegionEntry,
    coordinates: &Coordinates<'_>,
    unit: Option<LengthUnit>,
) -> Option<RegionPlace> {
    let has_box = entry.min.is_given() || entry.max.is_given();
    if !entry.at.is_given() && !has_box && !scope.is_misspelt("at") {
        let fault = scope.own_fault(FaultCode::NoneOfSeveral, "says not where it is");
        scope.report(fault.expecting(PLACE));
        return None;
    }
    if !entry.at.is_given() {
        let corners = coordinates.corners_of(scope, [&entry.min, &entry.max], unit);
        return corners.map(|(min, max)| RegionPlace::Box { min, max });
    }
    if has_box {
        let key = if entry.min.is_given() { "min" } else { "max" };
        let fault = scope.fault(FaultCode::EitherOr, key, "stands beside `at`");
        scope.report_name(fault.expecting("the point or the box"));
        return None;
    }
    let point = coordinates.point_in(&scope.of("at"), entry.at.value()?, unit)?;
    Some(RegionPlace::Face(point))
}

/// The mesh file within the folder of the problem file. Whether it exists shows when it is read.
fn mesh_path(scope: &Scope<'_>, file: &str, folder: &Path) -> Option<PathBuf> {
    let complaint = if file.trim().is_empty() {
        Some((FaultCode::EmptyText, "has no value"))
    } else if file.contains('\\') || file.contains('\0') {
        Some((FaultCode::PathNotPortable, "is not a portable path"))
    } else {
        let mut depth = 0_i32;
        Path::new(file)
            .components()
            .any(|component| {
                match component {
                    Component::Normal(_) => depth += 1,
                    Component::ParentDir => depth -= 1,
                    Component::CurDir => {}
                    Component::RootDir | Component::Prefix(_) => depth = i32::MIN / 2,
                }
                depth < 0
            })
            .then_some((
                FaultCode::PathLeavesFolder,
                "leaves the folder of the problem file",
            ))
    };
    match complaint {
        None => Some(folder.join(file)),
        Some((rule, complaint)) => {
            scope.report(scope.fault(rule, "mesh", complaint).expecting(
                "a path relative to the problem file, in its folder, with `/` between names",
            ));
            None
        }
    }
}
