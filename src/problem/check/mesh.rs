//! Parts from mesh files.

use std::path::{Component, Path, PathBuf};

use super::coordinates::Coordinates;
use super::scope::Scope;
use crate::problem::fault_code::FaultCode;
use crate::problem::field::Field;
use crate::problem::file::Named;
use crate::problem::file::scene::PartEntry;
use crate::problem::part::{Region, Shape};

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
                    let entry = list.required(name, field, "`{ min: [..], max: [..] }`")?;
                    let (min, max) = coordinates.corners(&list.of(name), entry, unit)?;
                    valid.then(|| Region {
                        name: name.clone(),
                        min,
                        max,
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
