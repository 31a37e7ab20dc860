//! Reads triangle meshes from STL, OBJ and PLY files, and refuses or reports what is wrong with them.
//!
//! Coordinates keep all digits that the file has (f64 in text, f32 in binary STL). Vertices at
//! exactly the same point become one, in every format; at open edges also those that the file's
//! precision does not tell apart. Surfaces come from the solids of a text STL file, or from the level
//! of an OBJ file that tells its faces apart: the groups (`g`), else the objects (`o`), else the
//! materials (`usemtl`). Everything else belongs to the surface `all`.

mod assembly;
mod cleaning;
mod clusters;
mod defect;
mod fault;
mod lines;
mod mending;
mod obj;
mod obj_names;
mod ply;
mod ply_header;
mod ply_numbers;
mod polygon;
mod precision;
mod region;
mod stl;
mod stl_layout;
mod stl_text;
mod vertex_index;
mod warning;
mod weld;

pub use defect::Defect;
pub use fault::{MeshFault, Place};
pub use mending::Mending;
pub use warning::MeshWarning;

use std::fs::File;
use std::io::{BufRead, BufReader, Cursor, Read};
use std::path::Path;

use assembly::{Assembled, Assembly};

use super::mesh::{Mesh, Shells};
use crate::content::{Content, HEAD, Utf16};
use crate::problem::fault::nearest_name;
use crate::problem::part::{MeshFile, Region};
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
    let file = MeshFile::from(path.to_owned());
    let loaded = load(&file, metres_per_unit, regions)?;
    Ok((loaded.mesh, loaded.warnings))
}

/// A mesh with what its reader found out about it.
pub(super) struct Loaded {
    pub mesh: Mesh,
    pub warnings: Vec<MeshWarning>,
    pub shells: Shells,
    /// How far its triangles may be from the surface that they approximate, m, where the file says so.
    pub deflection: Option<f64>,
    /// SHA-256 of the very bytes that the mesh was made of, in hexadecimal digits.
    pub sha256: String,
}

/// The same with the shells of the mesh and the checksum of the file.
pub(super) fn load(
    file: &MeshFile,
    metres_per_unit: f64,
    regions: &[Region],
) -> Result<Loaded, MeshFault> {
    let whole = |defect: Defect| defect.at(Place::File);
    let found = || {
        let (assembled, sha256) = parse(file, metres_per_unit)?;
        let Assembled {
            mut mesh,
            mendings,
            open_fault,
            deflection,
        } = assembled;
        let mut warnings: Vec<_> = mendings.into_iter().map(MeshWarning::Mended).collect();
        let (odd, shells) = cleaning::clean(&mut mesh, metres_per_unit).map_err(whole)?;
        let is_open = |warning: &MeshWarning| matches!(warning, MeshWarning::OpenEdges { .. });
        if let Some(fault) = open_fault.filter(|_| odd.iter().any(is_open)) {
            return Err(fault);
        }
        warnings.extend(odd);
        check_surfaces(&mesh.surfaces).map_err(whole)?;
        region::name_triangles(&mut mesh, metres_per_unit, regions).map_err(whole)?;
        Ok(Loaded {
            mesh,
            warnings,
            shells,
            deflection,
            sha256,
        })
    };
    found().map_err(|fault: MeshFault| fault.in_file(&file.path))
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

fn parse(file: &MeshFile, metres_per_unit: f64) -> Result<(Assembled, String), MeshFault> {
    let whole = |defect: Defect| defect.at(Place::File);
    let mut source = match &file.contents {
        Some(contents) => bearable(contents).map_err(whole)?,
        None => open(&file.path).map_err(whole)?,
    };
    let format = Format::of(&file.path).map_err(whole)?;
    let bytes = source.get_ref().len() as u64;
    let sha256 = sha256(source.get_ref());
    let head = source.get_ref()[..source.get_ref().len().min(HEAD)].to_vec();
    let mut assembly = Assembly::new(metres_per_unit);
    match Content::of(&head) {
        _ if matches!(format, Format::Stl) && stl::is_binary(&head, bytes) => {
            stl::read(&mut source, &head, bytes, &mut assembly)
        }
        Content::Foreign(foreign) => {
            let told = foreign.to_string();
            Err(whole(Defect::Foreign { told }))
        }
        Content::Plain if format.misnamed(&head, bytes).is_some() => {
            let other = format.misnamed(&head, bytes).unwrap_or_default();
            let told = format!("this is {other} file: give its name that ending");
            Err(whole(Defect::Foreign { told }))
        }
        Content::Utf16(order) => {
            assembly.mended(Mending::Utf16);
            let mut source = BufReader::new(Utf16::new(source, order));
            format.read_text(&mut source, &mut assembly)
        }
        Content::Plain if matches!(format, Format::Stl) && !stl::is_text(&head) => {
            stl::read(&mut source, &head, bytes, &mut assembly)
        }
        Content::Plain => format.read_text(&mut source, &mut assembly),
    }?;
    let assembled = assembly.finish().map_err(whole)?;
    Ok((assembled, sha256))
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

/// Bytes that came without a file, if they are as many as a file may have.
fn bearable(contents: &[u8]) -> Result<Cursor<Vec<u8>>, Defect> {
    match contents.len() as u64 {
        0 => Err(Defect::Empty),
        bytes if bytes > LARGEST_FILE => Err(Defect::TooLarge { bytes }),
        _ => Ok(Cursor::new(contents.to_vec())),
    }
}

impl Format {
    /// The format of a file that begins like this, where its name has the ending of another.
    fn misnamed(self, head: &[u8], bytes: u64) -> Option<&'static str> {
        let is_ply = head.starts_with(b"ply\n") || head.starts_with(b"ply\r");
        let is_stl = || stl::is_binary(head, bytes) || stl::is_text(head);
        match self {
            Self::Stl | Self::Obj if is_ply => Some("a .ply"),
            Self::Obj | Self::Ply if !is_ply && is_stl() => Some("an .stl"),
            _ => None,
        }
    }

    /// Reads a file that is not binary STL.
    fn read_text(
        self,
        source: &mut impl BufRead,
        assembly: &mut Assembly,
    ) -> Result<(), MeshFault> {
        match self {
            Self::Stl => stl_text::read(source, assembly),
            Self::Obj => obj::read(source, assembly),
            Self::Ply => ply::read(source, assembly),
        }
    }

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
