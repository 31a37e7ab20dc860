//! What the pictures of a report are drawn from: scene, paths, hits, maps and places to look at.
//!
//! Coordinates are the scene's, m. They and impulses are kept to five or six digits: enough for a
//! picture, and half the size.

mod drawn;

use serde::{Deserialize, Serialize};

/// What the pictures show; all of it at the recommended settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EvidenceRecord {
    /// Where the target lies and which way it faces.
    pub frame: FrameRecord,
    /// The surfaces as triangles, the target patch first.
    pub surfaces: Vec<SurfaceShapeRecord>,
    /// The pieces of the nozzle's body.
    pub nozzle: Vec<BodyRecord>,
    /// Some shots of the jet on their way.
    pub paths: Vec<PathRecord>,
    /// First hits on the target.
    pub hits: HitsRecord,
    /// Impacts on secondary surfaces.
    pub rebounds: ReboundsRecord,
    /// Where to put test strips.
    pub places: Vec<PlaceRecord>,
    /// The objective and the verdicts over two settings.
    pub maps: Vec<MapRecord>,
}

/// The target's frame: azimuth 0 points `along`, azimuth 90 deg `across`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct FrameRecord {
    /// The aim point of the file, m.
    pub aim_m: [f64; 3],
    /// The target's normal.
    pub normal: [f64; 3],
    /// a, in the target's plane.
    pub along: [f64; 3],
    /// b = a x n.
    pub across: [f64; 3],
}

/// A surface, or the part of one that is the target, as triangles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurfaceShapeRecord {
    /// Full name.
    pub name: String,
    /// What a hit on it counts as.
    pub role: RoleRecord,
    /// Share of its triangles that is kept here: 1 unless the mesh is too fine for a picture.
    pub share_drawn: f64,
    /// Corners, m.
    pub points_m: Vec<[f32; 3]>,
    /// Three corners each.
    pub triangles: Vec<[u32; 3]>,
}

impl SurfaceShapeRecord {
    /// Its triangles, but for those with corners that it does not have: records may come from
    /// elsewhere.
    pub fn whole_triangles(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        let exists = |corner: &u32| (*corner as usize) < self.points_m.len();
        let triangles = self.triangles.iter().copied();
        triangles.filter(move |corners| corners.iter().all(exists))
    }

    /// The corner points of these triangles, m.
    pub fn faces(&self) -> impl Iterator<Item = [[f32; 3]; 3]> + '_ {
        let point = |corner: u32| self.points_m[corner as usize];
        self.whole_triangles()
            .map(move |corners| corners.map(point))
    }
}

/// What a hit on a surface counts as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RoleRecord {
    /// The target patch.
    Target,
    /// What the jet must spare.
    Secondary,
    /// Part of the flight.
    Deflector,
}

/// A piece of the nozzle's body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BodyRecord {
    /// A ball round the exit.
    Ball {
        /// Radius, m.
        radius_m: f64,
    },
    /// A rod with round ends that starts at the exit.
    Capsule {
        /// Length, m.
        length_m: f64,
        /// Radius, m.
        radius_m: f64,
        /// Unit vector from the exit.
        direction: [f64; 3],
    },
}

/// One shot on its way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PathRecord {
    /// Where its centre is: at the exit, at every impact, and if it leaves where it is last seen,
    /// a little outside the scene, m.
    pub points_m: Vec<[f32; 3]>,
    /// Its impacts, deflectors included.
    pub impacts: Vec<PathImpactRecord>,
    /// `left`, `stays`, `spent` or `limit`.
    pub end: String,
    /// Whether one of its impacts breaks a limit or it misses the target.
    pub breaks: bool,
    /// Whether it was picked among all shots because of that; the others are shown as they come.
    #[serde(default)]
    pub picked: bool,
}

/// One impact of a path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PathImpactRecord {
    /// Full name of the surface.
    pub surface: String,
    /// N*.
    #[serde(rename = "normal_impulse_N_s")]
    pub normal_impulse: f32,
    /// f*.
    #[serde(rename = "tangential_impulse_N_s")]
    pub tangential_impulse: f32,
    /// Whether it breaks a goal or a limit.
    pub breaks: bool,
}

/// First hits on the target, one value per hit in each column.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct HitsRecord {
    /// Shots fired for them.
    pub shots: usize,
    /// The place of contact, m.
    pub points_m: Vec<[f32; 3]>,
    /// The same from the aim point, along and across, m.
    pub plane_m: Vec<[f32; 2]>,
    /// Angle between flight and surface, deg; 90 is perpendicular.
    pub angle_deg: Vec<f32>,
    /// N*.
    #[serde(rename = "normal_impulse_N_s")]
    pub normal_impulse: Vec<f32>,
    /// f*.
    #[serde(rename = "tangential_impulse_N_s")]
    pub tangential_impulse: Vec<f32>,
    /// Whether it sticks.
    pub sticks: Vec<bool>,
}

/// Impacts on secondary surfaces, one value per impact in each column.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ReboundsRecord {
    /// The place of contact, m.
    pub points_m: Vec<[f32; 3]>,
    /// Index into the list of surfaces; the target's own one is its part beside the patch.
    pub surface: Vec<u32>,
    /// 1 for a direct hit, 2 after the first bounce.
    pub number: Vec<u32>,
    /// N*.
    #[serde(rename = "normal_impulse_N_s")]
    pub normal_impulse: Vec<f32>,
}

/// A place that is worth a test strip.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlaceRecord {
    /// A short fixed name, such as `lowest_normal_impulse`.
    pub name: String,
    /// Full name of the surface.
    pub surface: String,
    /// m.
    pub point_m: [f64; 3],
    /// Normal of the surface there, towards free space.
    pub normal: [f64; 3],
    /// The number behind it; SI, angles in deg.
    pub value: f64,
    /// For people.
    pub text: String,
}

/// The objective and the verdicts over two settings; all others as recommended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MapRecord {
    /// The lower axis.
    pub x: AxisRecord,
    /// The left axis.
    pub y: AxisRecord,
    /// Shots at each place.
    pub shots: usize,
    /// What a cell's `fails` may name: the goals, the surfaces, `clearance`.
    pub subjects: Vec<String>,
    /// Row by row, from the lowest y; within a row from the lowest x.
    pub cells: Vec<CellRecord>,
}

/// An axis of a map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AxisRecord {
    /// Key of the setting, with its unit.
    pub setting: String,
    /// The values; deg for angles, else SI.
    pub values: Vec<f64>,
}

/// What one place of a map does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CellRecord {
    /// Terms of the objective with their weights: normal_impulse, tangential_impulse, rebound,
    /// miss; absent where the nozzle does not fit or nothing is known. What is larger than any `f32` is kept as the
    /// largest of them.
    pub terms: Option<[f32; 4]>,
    /// The subjects that fail there; none where nothing is known.
    pub fails: Vec<u32>,
    /// Share of the hits on target that stick; absent where there is none.
    pub share_sticking: Option<f32>,
}
