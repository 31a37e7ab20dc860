//! What can be wrong with a mesh file, in words that say what to do.

use std::fmt;

use nalgebra::Point3;

use super::warning::Coordinates;
use crate::digits::rounded;
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

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing => f.write_str(
                "there is no such file; the path is relative to the folder of the problem file",
            ),
            Self::Unreadable { reason } => write!(f, "the file cannot be read: {reason}"),
            Self::UnknownFormat { ending, nearest } => {
                match ending.as_str() {
                    "" => f.write_str("the name has no ending that tells the format")?,
                    ending => write!(f, "`.{ending}` is not a mesh format that is read here")?,
                }
                f.write_str("; export the part as .stl, .obj or .ply")?;
                match nearest {
                    Some(nearest) => write!(f, " (did you mean `.{nearest}`?)"),
                    None => Ok(()),
                }
            }
            Self::TooLarge { bytes } => write!(
                f,
                "the file has {} MB, at most {} MB are read; export it with a coarser tolerance",
                bytes / 1_000_000,
                super::LARGEST_FILE / 1_000_000
            ),
            Self::TooManyTriangles => write!(
                f,
                "the mesh has more than {} triangles; export it with a coarser tolerance",
                super::MOST_TRIANGLES
            ),
            Self::TooManyCorners { corners } => write!(
                f,
                "a face with {corners} corners, at most {} are read; export triangles instead",
                super::MOST_CORNERS
            ),
            Self::FacesTooWinding => f.write_str(
                "the faces up to this one have so many corners and wind so much that it takes too \
                 long to cut them into triangles; export triangles instead",
            ),
            Self::TooManySurfaces { surfaces } => write!(
                f,
                "the mesh has {surfaces} named groups, at most {} are read; export it with fewer",
                super::MOST_SURFACES
            ),
            Self::NameTooLong { start } => write!(
                f,
                "the name of a group that starts with `{start}` has more than {} characters; export \
                 the mesh with shorter names",
                super::LONGEST_NAME
            ),
            Self::LineTooLong => write!(
                f,
                "the line is longer than {} bytes; this is no text mesh, check the file's format",
                LONGEST_LINE
            ),
            Self::Empty => f.write_str("the file is empty; export the part again"),
            Self::NoTriangles => f.write_str(
                "the file holds no triangles; export the part as a mesh, not as curves, points or \
                 free-form surfaces",
            ),
            Self::AllDegenerate { triangles } => write!(
                f,
                "each of the {triangles} triangles has zero area; check the unit and the number of \
                 digits of the export"
            ),
            Self::NotFinite {
                coordinates: [x, y, z],
            } => write!(
                f,
                "the coordinates ({x}, {y}, {z}) are not finite numbers; repair the mesh or export \
                 it again"
            ),
            Self::TooFarOut {
                coordinates: [x, y, z],
            } => write!(
                f,
                "the coordinates ({x:e}, {y:e}, {z:e}) lie more than {} km out; check `lengths_in`, \
                 or the file is damaged",
                super::LARGEST_COORDINATE / 1000.0
            ),
            Self::NoSuchVertex {
                index,
                vertices,
                first,
            } => write!(
                f,
                "the face uses vertex {index}, counted from {first}, but only {vertices} vertices stand before it; the \
                 file is damaged or cut short"
            ),
            Self::WrongCount {
                promised,
                held,
                rest,
            } => {
                write!(
                    f,
                    "the header promises {promised} triangles, the file holds {held}"
                )?;
                if held < promised {
                    return f.write_str("; it was cut short, copy or export it again");
                }
                if *rest > 0 {
                    write!(f, " and {rest} bytes more")?;
                }
                f.write_str("; it is damaged, export it again")
            }
            Self::VendorData => f.write_str(
                "the facets carry vendor data, bytes between the triangles that are in no standard; \
                 export the mesh without",
            ),
            Self::Foreign { told } => f.write_str(told),
            Self::Unexpected { expected, found } => match found.as_str() {
                "" => write!(f, "expected {expected}, found nothing"),
                found => write!(f, "expected {expected}, found `{found}`"),
            },
            Self::EndsEarly { expected } => write!(
                f,
                "the file ends where {expected} should follow; it was cut short, copy or export it \
                 again"
            ),
            Self::NotInHeader { missing } => write!(
                f,
                "the PLY header has no {missing}; export the part as a mesh with vertices and faces"
            ),
            Self::EmptyRegion { region, min, max } => write!(
                f,
                "region `{region}` holds the centre of no triangle; the mesh reaches from {} to {} \
                 in the file's unit",
                Coordinates(min),
                Coordinates(max)
            ),
            Self::RegionOffMesh { region, distance } => write!(
                f,
                "the point of region `{region}` is {} mm off the mesh; `peenpose surfaces` lists points on its faces",
                rounded(distance * 1e3, 3)
            ),
            Self::RegionOnEdge { region } => write!(
                f,
                "the point of region `{region}` lies on the edge between two faces; move it onto one of them"
            ),
            Self::CoveredRegion { region } => write!(
                f,
                "region `{region}` is left without a triangle, because regions listed after it take \
                 them all; list it last or make them smaller"
            ),
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
