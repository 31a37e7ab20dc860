//! What is odd about a mesh that can be used all the same.

use std::fmt;

use nalgebra::Point3;

/// Something odd about a mesh. Places are in the file's own unit.
#[derive(Clone, Debug, PartialEq)]
pub enum MeshWarning {
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
    /// Edges of one triangle only.
    OpenEdges {
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
    /// Edges along which the fronts of two triangles look to different sides.
    InconsistentWinding {
        /// How many.
        count: usize,
        /// Middle of one.
        near: Point3<f64>,
    },
    /// A closed mesh whose triangles' fronts look inwards.
    InsideOut {
        /// The enclosed volume, m3; negative.
        signed_volume: f64,
    },
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

impl fmt::Display for MeshWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::DegenerateTriangles { count, near } => {
                let (verb, one) =
                    number(f, *count, "triangle of zero area", "triangles of zero area")?;
                write!(f, "{verb} dropped{one} near {}", Coordinates(near))
            }
            Self::DuplicateTriangles { count, near } => {
                let (verb, one) = number(f, *count, "duplicate triangle", "duplicate triangles")?;
                write!(
                    f,
                    "{verb} dropped{one} near {}; the first of each kept its surface",
                    Coordinates(near)
                )
            }
            Self::OpenEdges { count, near } => {
                let (_, one) = number(f, *count, "open edge", "open edges")?;
                write!(
                    f,
                    "in the mesh{one} near {}: shots can leave there; close the mesh unless the \
                     part is meant to be open",
                    Coordinates(near)
                )
            }
            Self::NonManifoldEdges { count, near } => {
                let (verb, one) = number(f, *count, "edge", "edges")?;
                write!(
                    f,
                    "{verb} shared by more than two triangles{one} near {}: bodies touch or overlap \
                     there; export them as separate parts or unite them",
                    Coordinates(near)
                )
            }
            Self::InconsistentWinding { count, near } => {
                let (verb, one) = number(f, *count, "edge", "edges")?;
                write!(
                    f,
                    "{verb} shared by triangles whose fronts look to different sides{one} near {}; \
                     let the CAD program or a mesh repair tool make the normals agree",
                    Coordinates(near)
                )
            }
            Self::InsideOut { signed_volume } => write!(
                f,
                "the fronts of the triangles look into the material (signed volume {signed_volume:.3e} \
                 m3); flip the normals in the CAD program or a mesh repair tool"
            ),
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
