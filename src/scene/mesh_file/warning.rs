//! What is odd about a mesh that can be used all the same.

use std::fmt;

use nalgebra::Point3;

use super::mending::Mending;

/// Something odd about a mesh. Places are in the file's own unit.
#[derive(Clone, Debug, PartialEq)]
pub enum MeshWarning {
    /// What was put right while the file was read.
    Mended(Mending),
    /// Corners of neighbours that were apart by less than the file's precision were joined.
    WeldedCorners {
        /// How many took the place of another.
        count: usize,
        /// The largest distance of one from its new place, in the file's unit.
        apart: f64,
        /// Where the first is now.
        near: Point3<f64>,
    },
    /// Triangles of zero area, which have no normal, were dropped.
    DegenerateTriangles {
        /// How many.
        count: usize,
        /// Centre of the first.
        near: Point3<f64>,
    },
    /// Triangles with the corners of an earlier one were dropped.
    DuplicateTriangles {
        /// How many.
        count: usize,
        /// Centre of the first.
        near: Point3<f64>,
    },
    /// Triangles that disagreed with most of their neighbours about the front were turned.
    TurnedTriangles {
        /// How many.
        count: usize,
        /// Centre of the first.
        near: Point3<f64>,
    },
    /// Edges of one triangle only: the rims of holes.
    OpenEdges {
        /// How many.
        count: usize,
        /// Middle of one.
        near: Point3<f64>,
        /// Whether the holes are so small beside the part that it was surely meant to be closed.
        small: bool,
    },
    /// Edges along which other triangles go on without sharing the corners, as at T-junctions.
    Seams {
        /// How many.
        count: usize,
        /// Middle of one.
        near: Point3<f64>,
    },
    /// Edges of more than two triangles.
    NonManifoldEdges {
        /// How many.
        count: usize,
        /// Middle of one.
        near: Point3<f64>,
    },
    /// Edges along which the fronts of two triangles look to different sides, and cannot be made to
    /// agree.
    InconsistentWinding {
        /// How many.
        count: usize,
        /// Middle of one.
        near: Point3<f64>,
    },
    /// Pieces that do not hang together with the rest, and are a hundred times smaller.
    TinyPieces {
        /// How many.
        count: usize,
        /// A corner of one.
        near: Point3<f64>,
    },
    /// Closed bodies whose triangles' fronts looked inwards; they were turned.
    InsideOut {
        /// How many.
        bodies: usize,
        /// The enclosed volume, m3; negative.
        signed_volume: f64,
    },
}

impl MeshWarning {
    /// Puts its place, in m until then, in the file's unit.
    pub(super) fn put_in_unit(&mut self, metres_per_unit: f64) {
        match self {
            Self::WeldedCorners { near, .. }
            | Self::DegenerateTriangles { near, .. }
            | Self::DuplicateTriangles { near, .. }
            | Self::TurnedTriangles { near, .. }
            | Self::OpenEdges { near, .. }
            | Self::Seams { near, .. }
            | Self::NonManifoldEdges { near, .. }
            | Self::InconsistentWinding { near, .. }
            | Self::TinyPieces { near, .. } => *near /= metres_per_unit,
            Self::Mended(_) | Self::InsideOut { .. } => {}
        }
    }
}

/// A point as an engineer writes it: without the last digits that a change of units leaves behind.
pub(super) struct Coordinates<'a>(pub &'a Point3<f64>);

impl fmt::Display for Coordinates<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self
            .0
            .coords
            .map(|value| (value * 1e9).round() / 1e9 + 0.0)
            .into();
        write!(f, "({x}, {y}, {z})")
    }
}

/// A small length with two digits.
struct Length(f64);

impl fmt::Display for Length {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value: f64 = format!("{:.1e}", self.0).parse().unwrap_or(self.0);
        if value >= 1e-6 {
            write!(f, "{value}")
        } else {
            write!(f, "{value:e}")
        }
    }
}

impl fmt::Display for MeshWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mended(mending) => mending.fmt(f),
            Self::WeldedCorners { count, apart, near } => {
                let (verb, one) = number(f, *count, "corner", "corners")?;
                write!(
                    f,
                    "{verb} joined with those of neighbouring triangles{one} near {}: they were at most \
                     {} apart, which is within the precision of the file",
                    Coordinates(near),
                    Length(*apart)
                )
            }
            Self::DegenerateTriangles { count, near } => {
                let (verb, one) =
                    number(f, *count, "triangle of zero area", "triangles of zero area")?;
                write!(
                    f,
                    "{verb} dropped{one} near {}; the answer is the same without",
                    Coordinates(near)
                )
            }
            Self::DuplicateTriangles { count, near } => {
                let (verb, one) = number(f, *count, "duplicate triangle", "duplicate triangles")?;
                write!(
                    f,
                    "{verb} dropped{one} near {}; the first of each kept its surface, and the answer is \
                     the same without the others",
                    Coordinates(near)
                )
            }
            Self::TurnedTriangles { count, near } => {
                let (verb, one) = number(f, *count, "triangle", "triangles")?;
                write!(
                    f,
                    "{verb} turned to agree with the neighbours about the front{one} near {}; the answer \
                     is that of the mesh with fronts that agree",
                    Coordinates(near)
                )
            }
            Self::OpenEdges { count, near, small } => {
                let (_, one) = number(f, *count, "open edge", "open edges")?;
                write!(
                    f,
                    "in the mesh{one} near {}: shots can leave there; ",
                    Coordinates(near)
                )?;
                f.write_str(if *small {
                    "the holes are small, and only shots that meet one go wrong; close the mesh"
                } else {
                    "close the mesh, or where the part is meant to be open, give `facing` should the \
                     free side of the target be taken for the other"
                })
            }
            Self::Seams { count, near } => {
                let (_, one) = number(f, *count, "edge", "edges")?;
                write!(
                    f,
                    "in the mesh, where triangles meet without sharing their corners{one} near {}: the \
                     cracks there are narrower than a millionth of the part, and so is the share of the \
                     shots that leave through them",
                    Coordinates(near)
                )
            }
            Self::NonManifoldEdges { count, near } => {
                let (verb, one) = number(f, *count, "edge", "edges")?;
                write!(
                    f,
                    "{verb} shared by more than two triangles{one} near {}: bodies touch or overlap \
                     there, and shots bounce off all of their faces, those inside as well; export them \
                     as separate parts or unite them",
                    Coordinates(near)
                )
            }
            Self::InconsistentWinding { count, near } => {
                let (verb, one) = number(f, *count, "edge", "edges")?;
                write!(
                    f,
                    "{verb} shared by triangles whose fronts look to different sides{one} near {}; shots \
                     bounce off either side, but the free side of a target may be taken for the other: \
                     give `facing`, or let a mesh repair tool make the normals agree",
                    Coordinates(near)
                )
            }
            Self::TinyPieces { count, near } => {
                let (verb, one) = number(f, *count, "piece", "pieces")?;
                write!(
                    f,
                    "{verb} not joined to the rest and less than a hundredth of its size{one} near {}: \
                     shots bounce off them as well; delete them if they are left over from modelling",
                    Coordinates(near)
                )
            }
            Self::InsideOut {
                bodies,
                signed_volume,
            } => {
                let which = match bodies {
                    1 => "a closed body is inside out: its".into(),
                    count => format!("{count} closed bodies are inside out: their"),
                };
                write!(
                    f,
                    "{which} normals point into the material (signed volume {signed_volume:.3e} m3); they \
                     were turned: give `facing` for a target inside, or flip the normals in the file"
                )
            }
        }
    }
}

/// Writes the count with its noun; gives the verb and the words that lead to the example.
fn number(
    f: &mut fmt::Formatter<'_>,
    count: usize,
    single: &str,
    several: &str,
) -> Result<(&'static str, &'static str), fmt::Error> {
    if count == 1 {
        write!(f, "1 {single} ")?;
        Ok(("is", ","))
    } else {
        write!(f, "{count} {several} ")?;
        Ok(("are", ", one of them"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_shown_without_their_roundings() {
        let shown = |point: [f64; 3]| Coordinates(&point.into()).to_string();
        assert_eq!(shown([0.1 + 0.2, -0.0, 1.0 / 3.0]), "(0.3, 0, 0.333333333)");
        assert_eq!(shown([-1e-12, 2e9, -2.5]), "(0, 2000000000, -2.5)");
    }
}
