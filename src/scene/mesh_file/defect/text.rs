//! Defects in words that say what to do.

use std::fmt;

use super::super::warning::Coordinates;
use super::super::{
    LARGEST_COORDINATE, LARGEST_FILE, LONGEST_NAME, MOST_CORNERS, MOST_SURFACES, MOST_TRIANGLES,
};
use super::{Defect, LONGEST_LINE};
use crate::digits::rounded;

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
                LARGEST_FILE / 1_000_000
            ),
            Self::TooManyTriangles => write!(
                f,
                "the mesh has more than {} triangles; export it with a coarser tolerance",
                MOST_TRIANGLES
            ),
            Self::TooManyCorners { corners } => write!(
                f,
                "a face with {corners} corners, at most {} are read; export triangles instead",
                MOST_CORNERS
            ),
            Self::FacesTooWinding => f.write_str(
                "the faces up to this one have so many corners and wind so much that it takes too \
                 long to cut them into triangles; export triangles instead",
            ),
            Self::TooManySurfaces { surfaces } => write!(
                f,
                "the mesh has {surfaces} named groups, at most {} are read; export it with fewer",
                MOST_SURFACES
            ),
            Self::NameTooLong { start } => write!(
                f,
                "the name of a group that starts with `{start}` has more than {} characters; export \
                 the mesh with shorter names",
                LONGEST_NAME
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
                LARGEST_COORDINATE / 1000.0
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
