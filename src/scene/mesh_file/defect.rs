//! What can be wrong with a mesh file, in words that say what to do.

mod text;

use nalgebra::Point3;

use crate::problem::fault_code::FaultCode;

/// Bytes of the longest line that is read; a face of four thousand corners fits.
pub(super) const LONGEST_LINE: usize = 1 << 18;

/// What is wrong with a mesh file.
#[derive(Clone, Debug, PartialEq)]
pub enum Defect {
    /// There is no such file.
    Missing,
    /// The operating system refuses to read it.
    Unreadable {
        /// In the system's words.
        reason: String,
    },
    /// The ending of the name is not that of a format that is read here.
    UnknownFormat {
        /// The ending as written, without the dot; empty for none.
        ending: String,
        /// The known ending that looks most like it.
        nearest: Option<&'static str>,
    },
    /// More bytes than [`LARGEST_FILE`](super::LARGEST_FILE).
    TooLarge {
        /// Size of the file.
        bytes: u64,
    },
    /// More triangles than [`MOST_TRIANGLES`](super::MOST_TRIANGLES).
    TooManyTriangles,
    /// A face with more corners than [`MOST_CORNERS`](super::MOST_CORNERS).
    TooManyCorners {
        /// Corners of the face.
        corners: usize,
    },
    /// Faces of many corners that wind or cross themselves.
    FacesTooWinding,
    /// More surfaces than [`MOST_SURFACES`](super::MOST_SURFACES).
    TooManySurfaces {
        /// Named groups or solids of the file.
        surfaces: usize,
    },
    /// A name longer than [`LONGEST_NAME`](super::LONGEST_NAME).
    NameTooLong {
        /// How it starts.
        start: String,
    },
    /// A line so long that the file cannot be a text mesh.
    LineTooLong,
    /// The file holds nothing at all.
    Empty,
    /// The file can be read but describes no triangle.
    NoTriangles,
    /// Every triangle has zero area.
    AllDegenerate {
        /// How many there are.
        triangles: usize,
    },
    /// A coordinate that is infinite or not a number.
    NotFinite {
        /// The coordinates as read.
        coordinates: [f64; 3],
    },
    /// A coordinate beyond [`LARGEST_COORDINATE`](super::LARGEST_COORDINATE).
    TooFarOut {
        /// The coordinates as read, in the file's unit.
        coordinates: [f64; 3],
    },
    /// A face that names a vertex which does not exist.
    NoSuchVertex {
        /// The number as written.
        index: i64,
        /// How many vertices stand before the face.
        vertices: usize,
        /// What the format calls the first vertex: 0 in PLY, 1 in OBJ.
        first: u8,
    },
    /// A binary STL file that does not hold what its header promises.
    WrongCount {
        /// Triangles that the header promises.
        promised: u64,
        /// Whole triangles that the file holds.
        held: u64,
        /// Bytes behind the last whole triangle.
        rest: u64,
    },
    /// A binary STL file with bytes of unknown number between its triangles.
    VendorData,
    /// A file of another kind that bears the name of a mesh.
    Foreign {
        /// What it is and what to do with it.
        told: String,
    },
    /// Something else was expected here.
    Unexpected {
        /// What was expected.
        expected: &'static str,
        /// What stands there, shortened.
        found: String,
    },
    /// The file ends too early.
    EndsEarly {
        /// What was expected next.
        expected: &'static str,
    },
    /// The header of a PLY file leaves out something that a mesh needs.
    NotInHeader {
        /// What is missing.
        missing: &'static str,
    },
    /// A region of the problem file holds no triangle's centre.
    EmptyRegion {
        /// Name of the region.
        region: String,
        /// Smallest coordinates of the mesh, in the file's unit.
        min: Point3<f64>,
        /// Largest coordinates of the mesh, in the file's unit.
        max: Point3<f64>,
    },
    /// The point of a region is off the mesh.
    RegionOffMesh {
        /// Name of the region.
        region: String,
        /// How far, m.
        distance: f64,
    },
    /// The point of a region lies on an edge between smooth faces.
    RegionOnEdge {
        /// Name of the region.
        region: String,
    },
    /// Later regions of the problem file take every triangle of an earlier one.
    CoveredRegion {
        /// Name of the earlier region.
        region: String,
    },
}

impl Defect {
    /// Something unexpected, with what stands there shortened to a readable length.
    pub(super) fn unexpected(expected: &'static str, found: &[u8]) -> Self {
        const LONGEST: usize = 40;
        let text = String::from_utf8_lossy(found.get(..4 * LONGEST).unwrap_or(found));
        let text = text.trim();
        let mut found: String = text
            .chars()
            .take(LONGEST)
            .map(|letter| {
                if letter.is_control() {
                    '\u{fffd}'
                } else {
                    letter
                }
            })
            .collect();
        if text.chars().nth(LONGEST).is_some() {
            found.push_str("...");
        }
        Self::Unexpected { expected, found }
    }
}

impl Defect {
    /// The region of the problem file that it is about, if that is to blame.
    pub fn region(&self) -> Option<&str> {
        match self {
            Self::EmptyRegion { region, .. }
            | Self::RegionOffMesh { region, .. }
            | Self::RegionOnEdge { region }
            | Self::CoveredRegion { region } => Some(region),
            _ => None,
        }
    }

    /// The rule that a problem with such a mesh file breaks.
    pub fn rule(&self) -> FaultCode {
        match self {
            Self::Missing => FaultCode::MeshMissing,
            Self::Unreadable { .. } => FaultCode::MeshUnreadable,
            Self::UnknownFormat { .. } => FaultCode::MeshFormatUnknown,
            Self::TooLarge { .. } => FaultCode::MeshTooLarge,
            Self::TooManyTriangles => FaultCode::MeshTooManyTriangles,
            Self::TooManyCorners { .. } => FaultCode::MeshTooManyCorners,
            Self::FacesTooWinding => FaultCode::MeshFacesTooWinding,
            Self::TooManySurfaces { .. } => FaultCode::MeshTooManySurfaces,
            Self::NameTooLong { .. } => FaultCode::MeshNameTooLong,
            Self::LineTooLong => FaultCode::MeshLineTooLong,
            Self::Empty => FaultCode::MeshEmpty,
            Self::NoTriangles => FaultCode::MeshNoTriangles,
            Self::AllDegenerate { .. } => FaultCode::MeshNoArea,
            Self::NotFinite { .. } => FaultCode::MeshNotFinite,
            Self::TooFarOut { .. } => FaultCode::MeshTooFarOut,
            Self::NoSuchVertex { .. } => FaultCode::MeshNoSuchVertex,
            Self::WrongCount { .. } => FaultCode::MeshWrongCount,
            Self::VendorData => FaultCode::MeshVendorData,
            Self::Foreign { .. } => FaultCode::MeshForeign,
            Self::Unexpected { .. } => FaultCode::MeshUnexpected,
            Self::EndsEarly { .. } => FaultCode::MeshEndsEarly,
            Self::NotInHeader { .. } => FaultCode::MeshNotInHeader,
            Self::EmptyRegion { .. } | Self::RegionOffMesh { .. } => FaultCode::RegionEmpty,
            Self::RegionOnEdge { .. } => FaultCode::RegionOnEdge,
            Self::CoveredRegion { .. } => FaultCode::RegionCovered,
        }
    }
}

impl From<std::io::Error> for Defect {
    fn from(error: std::io::Error) -> Self {
        match error.kind() {
            std::io::ErrorKind::NotFound => Self::Missing,
            _ => Self::Unreadable {
                reason: error.to_string(),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defects_of_a_region_tell_its_name() {
        let empty = Defect::EmptyRegion {
            region: "rim".to_owned(),
            min: Point3::origin(),
            max: Point3::origin(),
        };
        let covered = Defect::CoveredRegion {
            region: "floor".to_owned(),
        };
        assert_eq!(empty.region(), Some("rim"));
        assert_eq!(covered.region(), Some("floor"));
        assert_eq!(Defect::Missing.region(), None);
    }

    #[test]
    fn what_stands_there_is_shown_up_to_forty_letters() {
        let shown = |found: &str| match Defect::unexpected("any", found.as_bytes()) {
            Defect::Unexpected { found, .. } => found,
            other => panic!("{other:?}"),
        };
        assert_eq!(shown(" a b "), "a b");
        assert_eq!(shown("a\tb"), "a\u{fffd}b");
        // Letters of up to four bytes.
        for letter in ["a", "ü", "€", "😀"] {
            assert_eq!(shown(&letter.repeat(40)), letter.repeat(40));
        }
        assert_eq!(shown(&"ü".repeat(41)), "ü".repeat(40) + "...");
    }
}
