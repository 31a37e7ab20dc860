//! Reads triangle meshes from STL, OBJ and PLY files, and refuses or reports what is wrong with them.
//!
//! Coordinates keep all digits that the file has (f64 in text, f32 in binary STL). Vertices at
//! exactly the same point become one, in every format. Surfaces come from the groups of an OBJ file
//! (`g`, or `o` where the file has no `g`) or the solids of a text STL file, provided that there are
//! several with different names; everything else belongs to the surface `all`.

mod assembly;
mod cleaning;
mod defect;
mod fault;
mod lines;
mod obj;
mod ply;
mod ply_header;
mod ply_numbers;
mod polygon;
mod region;
mod stl;
mod stl_text;
mod vertex_index;
mod warning;

pub use defect::Defect;
pub use fault::{MeshFault, Place};
pub use warning::MeshWarning;

use std::fs::File;
use std::io::{Cursor, Read};
use std::path::Path;

use assembly::Assembly;

use super::mesh::Mesh;
use crate::problem::fault::nearest_name;
use crate::problem::part::Region;
use crate::problem::sha256;

/// Bytes of the largest file that is read.
pub const LARGEST_FILE: u64 = 1_000_000_000;
/// Triangles of the largest mesh that is read.
pub const MOST_TRIANGLES: usize = 20_000_000;
/// Corners of the largest face that is read.
pub const MOST_CORNERS: usize = 4096;
/// Surfaces, that is named groups or solids, of the largest mesh that is read.
pub const MOST_SURFACES: usize = 10_000;
/// Characters of the longest name of a surface.
pub const LONGEST_NAME: usize = 200;
/// Coordinates further out than this, in m, are taken for damage.
pub const LARGEST_COORDINATE: f64 = 1e6;

/// A format of mesh files, by the ending of their names.
#[derive(Clone, Copy)]
enum Format {
    Stl,
    Obj,
    Ply,
}

/// Reads a mesh file; `regions` (in m, in the file's frame) then name the triangles whose centre they
/// hold, a later region before an earlier one.
///
/// Every vertex of the mesh belongs to a triangle, every triangle has an area, no two triangles have
/// the same corners, the two at an edge agree on which side is the front wherever that is possible, and
/// every surface has a triangle.
///
/// Warnings about edges refer to the mesh before triangles of zero area are dropped: where such a
/// triangle fills the gap between neighbours, no ray can pass, although [`Mesh::topology`] of what is
/// left finds open edges there.
///
/// # Errors
///
/// If the file cannot be read, does not follow its format, holds no usable triangle or numbers that
/// cannot be coordinates, is too large, or if a region gets no triangle.
pub fn read(
    path: &Path,
    metres_per_unit: f64,
    regions: &[Region],
) -> Result<(Mesh, Vec<MeshWarning>), MeshFault> {
    let (mesh, warnings, _) = read_with_checksum(path, metres_per_unit, regions)?;
    Ok((mesh, warnings))
}

/// The same, and the SHA-256 of the very bytes that the mesh was made of, in hexadecimal digits.
///
/// # Errors
/// Those of [`read`].
pub fn read_with_checksum(
    path: &Path,
    metres_per_unit: f64,
    regions: &[Region],
) -> Result<(Mesh, Vec<MeshWarning>, String), MeshFault> {
    let whole = |defect: Defect| defect.at(Place::File);
    let found = || {
        let (mut mesh, checksum) = parse(path, metres_per_unit)?;
        let warnings = cleaning::clean(&mut mesh, metres_per_unit).map_err(whole)?;
        check_surfaces(&mesh.surfaces).map_err(whole)?;
        region::name_triangles(&mut mesh, metres_per_unit, regions).map_err(whole)?;
        Ok((mesh, warnings, checksum))
    };
    found().map_err(|fault: MeshFault| fault.in_file(path))
}

/// Refuses more surfaces than can be told apart, and names that nobody can read.
fn check_surfaces(names: &[String]) -> Result<(), Defect> {
    const SHOWN: usize = 40;
    if names.len() > MOST_SURFACES {
        let surfaces = names.len();
        return Err(Defect::TooManySurfaces { surfaces });
    }
    let is_long = |name: &&String| name.chars().count() > LONGEST_NAME;
    match names.iter().find(is_long) {
        Some(name) => Err(Defect::NameTooLong {
            start: name.chars().take(SHOWN).collect(),
        }),
        None => Ok(()),
    }
}

fn parse(path: &Path, metres_per_unit: f64) -> Result<(Mesh, String), MeshFault> {
    let whole = |defect: Defect| defect.at(Place::File);
    let source = open(path).map_err(whole)?;
    let format = Format::of(path).map_err(whole)?;
    let bytes = source.get_ref().len() as u64;
    let checksum = sha256(source.get_ref());
    let mut assembly = Assembly::new(metres_per_unit);
    match format {
        Format::Stl => stl::read(source, bytes, &mut assembly),
        Format::Obj => obj::read(source, &mut assembly),
        Format::Ply => ply::read(source, &mut assembly),
    }?;
    let mesh = assembly.finish().map_err(whole)?;
    Ok((mesh, checksum))
}

/// Reads a file of a bearable size, once: what is parsed is what the checksum is of, whoever writes to the
/// file meanwhile.
fn open(path: &Path) -> Result<Cursor<Vec<u8>>, Defect> {
    let about = std::fs::metadata(path)?;
    if !about.is_file() {
        return Err(Defect::Unreadable {
            reason: "it is not a regular file".to_owned(),
        });
    }
    match about.len() {
        0 => Err(Defect::Empty),
        bytes if bytes > LARGEST_FILE => Err(Defect::TooLarge { bytes }),
        bytes => {
            let mut contents = Vec::with_capacity(bytes as usize);
            let file = File::open(path)?;
            match file.take(LARGEST_FILE + 1).read_to_end(&mut contents)? {
                0 => Err(Defect::Empty),
                read if read as u64 > LARGEST_FILE => Err(Defect::TooLarge { bytes: read as u64 }),
                _ => Ok(Cursor::new(contents)),
            }
        }
    }
}

impl Format {
    fn of(path: &Path) -> Result<Self, Defect> {
        let ending = path.extension().unwrap_or_default().to_string_lossy();
        match ending.to_ascii_lowercase().as_str() {
            "stl" => Ok(Self::Stl),
            "obj" => Ok(Self::Obj),
            "ply" => Ok(Self::Ply),
            unknown => Err(Defect::UnknownFormat {
                // Other formats, such as STEP, are no misspelt ones.
                nearest: nearest_name(unknown, ["stl", "obj", "ply"])
                    .filter(|near| near.len() == unknown.len()),
                ending: ending.into_owned(),
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surfaces_are_as_many_and_their_names_as_long_as_is_bearable() {
        let many = |count: usize| check_surfaces(&vec!["any".to_owned(); count]);
        assert!(many(MOST_SURFACES).is_ok());
        assert!(matches!(
            many(MOST_SURFACES + 1),
            Err(Defect::TooManySurfaces { surfaces }) if surfaces == MOST_SURFACES + 1
        ));
        // Letters count, not bytes.
        let long = |letters: usize| check_surfaces(&["any".to_owned(), "ü".repeat(letters)]);
        assert!(long(LONGEST_NAME).is_ok());
        assert!(matches!(
            long(LONGEST_NAME + 1),
            Err(Defect::NameTooLong { start }) if start == "ü".repeat(40)
        ));
    }
}
