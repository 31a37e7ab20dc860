//! What was put right while a mesh file was read.

use std::fmt;

/// Something in a mesh file that is against its format, but can only be meant in one way.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mending {
    /// The file is UTF-16 text.
    Utf16,
    /// Bytes behind the last triangle were passed over.
    TrailingBytes {
        /// How many.
        bytes: u64,
    },
    /// Lines behind the last face were passed over.
    TrailingLines {
        /// The first of them, from 1.
        line: u64,
    },
    /// The number of triangles or faces was taken from what the file holds.
    Recounted {
        /// How many its header promises.
        promised: u64,
        /// How many there are.
        held: u64,
    },
    /// Bytes that a program keeps for itself between the triangles were passed over.
    VendorBytes {
        /// How many in all.
        bytes: u64,
    },
    /// A text STL file without `solid` at its beginning.
    NoSolid,
    /// A text STL file without `endsolid` at its end.
    NoEndsolid,
    /// Solids of one name, which became one surface.
    MergedSolids {
        /// The names that several solids have.
        names: Vec<String>,
    },
    /// Names of surfaces from the objects (`o`) of an OBJ file, because its groups (`g`) do not tell
    /// its faces apart.
    NamesOfObjects,
    /// Names of surfaces from the materials (`usemtl`) of an OBJ file, because neither groups nor
    /// objects tell its faces apart.
    NamesOfMaterials,
}

impl fmt::Display for Mending {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Utf16 => f.write_str("the file is UTF-16 text and was read as such"),
            Self::TrailingBytes { bytes } => write!(
                f,
                "{bytes} bytes behind the last triangle are passed over; the triangles are complete"
            ),
            Self::TrailingLines { line } => write!(
                f,
                "what stands behind the last face, from line {line} on, is passed over; the faces are \
                 as many as the header promises"
            ),
            Self::Recounted { promised, held } => write!(
                f,
                "the header promises {promised} triangles, the file holds exactly {held}, and all of \
                 these are read"
            ),
            Self::VendorBytes { bytes } => write!(
                f,
                "{bytes} bytes that a program keeps for itself between the triangles are passed over"
            ),
            Self::NoSolid => f.write_str("the file does not begin with `solid`; its facets are read"),
            Self::NoEndsolid => {
                f.write_str("the file does not end with `endsolid`; its facets are complete")
            }
            Self::MergedSolids { names } => {
                f.write_str("solids of the same name are one surface: ")?;
                list(f, names)
            }
            Self::NamesOfObjects => f.write_str(
                "the surfaces have the names of the file's objects (`o`), because its groups (`g`) do \
                 not tell faces apart",
            ),
            Self::NamesOfMaterials => f.write_str(
                "the surfaces have the names of the file's materials (`usemtl`), because neither its \
                 groups (`g`) nor its objects (`o`) tell faces apart",
            ),
        }
    }
}

/// The first names of some.
fn list(f: &mut fmt::Formatter<'_>, names: &[String]) -> fmt::Result {
    const SHOWN: usize = 5;
    for (position, name) in names.iter().take(SHOWN).enumerate() {
        let before = if position == 0 { "" } else { ", " };
        write!(f, "{before}`{name}`")?;
    }
    match names.len().checked_sub(SHOWN) {
        Some(more @ 1..) => write!(f, " and {more} more"),
        _ => Ok(()),
    }
}
