//! The parts of a scene as the user described them: checked, in metres, not yet built.

use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;

use nalgebra::{Point2, Point3, UnitQuaternion, Vector3};

use super::LengthUnit;
use super::curve::Curve;

/// One named part of the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Name of the part; its surfaces are called `name.surface`.
    pub name: String,
    /// What the part looks like in its own frame.
    pub shape: Shape,
    /// Where that frame stands in the scene, or in the frame of the nozzle.
    pub place: Place,
    /// Whether it is fixed to the nozzle and moves with it. The nozzle's frame has its origin in
    /// the centre of the exit, z along the jet, and y across it in the target's plane.
    pub on_nozzle: bool,
    /// Names of the parts whose insides are cut out of it; what is left of their walls bounds the openings.
    pub cut: Vec<String>,
}

/// A rotation about fixed x, then y, then z, followed by a shift (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Rotation of the part about its own origin.
    pub rotation: UnitQuaternion<f64>,
    /// Position of the part's origin, m.
    pub shift: Vector3<f64>,
}

impl Default for Place {
    fn default() -> Self {
        Self {
            rotation: UnitQuaternion::identity(),
            shift: Vector3::zeros(),
        }
    }
}

/// The geometry of a part in its own frame; every length in metres.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A bore along z with a groove towards +y, open at both ends; see [`Keyway`].
    Keyway(Keyway),
    /// A round hole (or, seen from outside, a pin) along z from 0 to `length`.
    Bore {
        /// Diameter, m.
        diameter: f64,
        /// Length along z, m.
        length: f64,
        /// Which of the two ends carry a flat cap.
        ends: Ends,
        /// The side of its wall that is free; where absent the target decides.
        free: Option<RoundSide>,
    },
    /// A cross-section of lines and arcs, along z from 0 to `length`.
    Extrude {
        /// The outline, in the order in which it was written; free space lies to its left.
        profile: Vec<Segment>,
        /// Length along z, m.
        length: f64,
        /// Which of the two ends carry a flat cap.
        ends: Ends,
    },
    /// A cross-section of lines and arcs, turned about the z axis; x of its points is the distance from that, y is z.
    Revolve {
        /// The outline, in the order in which it was written; free space lies to its left.
        profile: Vec<Segment>,
    },
    /// An axis-parallel block.
    Box {
        /// Smallest corner, m.
        min: Point3<f64>,
        /// Largest corner, m.
        max: Point3<f64>,
    },
    /// Triangles from a file.
    Mesh {
        /// The file.
        file: MeshFile,
        /// Metres per unit of length in the file.
        metres_per_unit: f64,
        /// Regions that name triangles.
        regions: Vec<Region>,
    },
}

/// A side of a round wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RoundSide {
    /// That of a hole.
    Inside,
    /// That of a pin.
    Outside,
}

/// A mesh file: on disk, or its bytes under a name.
#[derive(Clone, PartialEq)]
pub struct MeshFile {
    /// Where it is, resolved against the folder of the problem file. Its ending tells the format.
    pub path: PathBuf,
    /// What is in it; read from the disk when absent.
    pub contents: Option<Arc<[u8]>>,
}

impl From<PathBuf> for MeshFile {
    fn from(path: PathBuf) -> Self {
        let contents = None;
        Self { path, contents }
    }
}

impl fmt::Debug for MeshFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.path)
    }
}

/// A groove of rectangular section in the wall of a round bore (DIN 6885 style).
///
/// The axis is z, from 0 to `length`; the groove points towards +y and its floor lies at
/// y = bore/2 + depth. Surfaces: `floor`, `wall_neg` (x < 0), `wall_pos`, `bore`, and with a
/// root radius also `root_neg` and `root_pos`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Keyway {
    /// Diameter of the bore, m.
    pub bore: f64,
    /// Width of the groove, m.
    pub width: f64,
    /// Depth of the groove below the bore's crown, m.
    pub depth: f64,
    /// Length along z, m.
    pub length: f64,
    /// Radius between floor and walls, m; 0 for sharp roots.
    pub root_radius: f64,
}

/// Whether the two ends of a prismatic part are closed by a flat cap.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Ends {
    /// The end at z = 0, surface `near`.
    pub near_closed: bool,
    /// The end at z = length, surface `far`.
    pub far_closed: bool,
}

/// One piece of a cross-section, in m.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// Where it starts.
    pub from: Point2<f64>,
    /// Where it ends.
    pub to: Point2<f64>,
    /// A point that a circular arc passes through on its way; `None` for a straight line.
    pub via: Option<Point2<f64>>,
    /// Name of the surface that it becomes.
    pub surface: String,
}

/// Two ends nearer than this are one, m.
pub(in crate::problem) const SAME_POINT: f64 = 1e-9;

impl Segment {
    /// Whether another one begins where this one ends.
    pub fn leads_to(&self, next: &Self) -> bool {
        (next.from - self.to).norm() <= SAME_POINT
    }

    /// Its form.
    pub fn curve(&self) -> Curve {
        let line = Curve::Line {
            from: self.from,
            to: self.to,
        };
        let arc = self
            .via
            .and_then(|via| Curve::arc_through(self.from, via, self.to));
        arc.unwrap_or(line)
    }
}

/// A named axis-parallel box.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Name of the surface that it cuts out of the mesh.
    pub name: String,
    /// Which of its triangles that are.
    pub place: RegionPlace,
}

/// Where a region of a mesh is, in the frame of the file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RegionPlace {
    /// Triangles whose centre lies in a box.
    Box {
        /// Smallest corner, m.
        min: Point3<f64>,
        /// Largest corner, m.
        max: Point3<f64>,
    },
    /// The smooth face that a point lies on, m.
    Face(Point3<f64>),
}

/// The surface to be peened.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// The unit of its coordinates.
    pub lengths_in: LengthUnit,
    /// Full name of the surface, `part.surface`.
    pub surface: String,
    /// Only this box of it (scene frame, m); the rest of the surface is secondary.
    pub within: Option<(Point3<f64>, Point3<f64>)>,
    /// Where the jet axis meets the target (m); the centre of the patch when absent.
    pub aim: Option<Point3<f64>>,
    /// The key that gives the aim point: its own, or that of the stroke which begins there.
    pub aim_key: &'static str,
    /// The direction that azimuth 0 means; laid into the target's plane later.
    pub along: Option<Vector3<f64>>,
    /// A direction that points to the nozzle's side of the target; the surface's own
    /// orientation decides when absent.
    pub facing: Option<Vector3<f64>>,
}

impl Part {
    /// Whether it is cut out of one of these parts, and stands nowhere itself.
    pub fn is_cut_out(&self, parts: &[Self]) -> bool {
        parts.iter().any(|other| other.cut.contains(&self.name))
    }
}

impl Shape {
    /// Names of the surfaces as far as the problem file alone tells: for a mesh only its regions.
    pub fn surface_names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        match self {
            Self::Keyway(keyway) => {
                names.extend(["floor", "wall_neg", "wall_pos", "bore"]);
                if keyway.root_radius > 0.0 {
                    names.extend(["root_neg", "root_pos"]);
                }
            }
            Self::Bore { ends, .. } => {
                names.push("wall");
                names.append(&mut ends.surface_names());
            }
            Self::Extrude { profile, ends, .. } => {
                names.extend(names_of(profile));
                names.append(&mut ends.surface_names());
            }
            Self::Revolve { profile } => names.extend(names_of(profile)),
            Self::Box { .. } => {
                names.extend(["x_min", "x_max", "y_min", "y_max", "z_min", "z_max"]);
            }
            Self::Mesh { regions, .. } => {
                for region in regions {
                    names.push(&region.name);
                }
            }
        }
        names
    }
}

/// The surfaces of a cross-section, each once.
fn names_of(profile: &[Segment]) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for segment in profile {
        if !names.contains(&segment.surface.as_str()) {
            names.push(&segment.surface);
        }
    }
    names
}

impl Ends {
    /// Names of the caps that are there.
    pub fn surface_names<'a>(self) -> Vec<&'a str> {
        let near = self.near_closed.then_some("near");
        let far = self.far_closed.then_some("far");
        near.into_iter().chain(far).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_groove_has_roots_where_they_are_round() {
        let names = |root_radius: f64| {
            let shape = Shape::Keyway(Keyway {
                bore: 30e-3,
                width: 8e-3,
                depth: 3.3e-3,
                length: 40e-3,
                root_radius,
            });
            shape.surface_names().join(" ")
        };
        assert_eq!(names(0.0), "floor wall_neg wall_pos bore");
        assert_eq!(
            names(1e-3),
            "floor wall_neg wall_pos bore root_neg root_pos"
        );
    }
}
