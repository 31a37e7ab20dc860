//! What the 3-D view in the page is built from, as JSON: millimetres from the aim point.

use serde::Serialize;

use super::look::{LOOK, Look};
use super::motion::Motion;
use crate::record::{
    BodyRecord, EvidenceRecord, FrameRecord, GoalsRecord, Record, RoleRecord, SurfaceShapeRecord,
};

/// Dots of each kind that are drawn at most: more would only hide each other. Shots are spread
/// evenly, so the first ones stand for all.
const MOST_DOTS: usize = 1000;
/// Parts of a millimetre that are kept.
const FINENESS: f64 = 1e4;

/// The whole scene.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Scene<'a> {
    look: Look,
    normal: [f64; 3],
    along: [f64; 3],
    across: [f64; 3],
    exit: [f64; 3],
    direction: [f64; 3],
    exit_radius: f64,
    /// N* asked for, N s.
    wanted: f64,
    surfaces: Vec<Surface<'a>>,
    nozzle: Vec<Piece>,
    paths: Vec<Path>,
    hits: Dots,
    rebounds: Dots,
    places: Vec<Place<'a>>,
    /// How the nozzle travels; absent for a spot.
    motion: Option<Motion>,
}

#[derive(Serialize)]
struct Surface<'a> {
    name: &'a str,
    role: RoleRecord,
    points: Vec<f64>,
    triangles: Vec<u32>,
}

/// All points within a distance of a line.
#[derive(Serialize)]
struct Piece {
    from: [f64; 3],
    to: [f64; 3],
    radius: f64,
}

#[derive(Serialize)]
struct Path {
    points: Vec<f64>,
    breaks: bool,
    /// Whether it was picked because it breaks something.
    picked: bool,
}

/// Impacts, one value per impact in each column.
#[derive(Serialize)]
struct Dots {
    points: Vec<f64>,
    /// N s.
    impulse: Vec<f32>,
    /// 1 where a goal or a limit is broken.
    breaks: Vec<u8>,
}

#[derive(Serialize)]
struct Place<'a> {
    surface: &'a str,
    text: &'a str,
    point: [f64; 3],
}

impl<'a> Scene<'a> {
    /// The scene of a record with its evidence.
    pub fn new(record: &'a Record, evidence: &'a EvidenceRecord) -> Self {
        let frame = &evidence.frame;
        let pose = &record.best.pose;
        let places = evidence.places.iter().map(|place| Place {
            surface: &place.surface,
            text: &place.text,
            point: point(frame, place.point_m),
        });
        Self {
            look: LOOK,
            normal: frame.normal,
            along: frame.along,
            across: frame.across,
            exit: point(frame, pose.exit_m),
            direction: pose.direction,
            exit_radius: record.problem.exit_diameter_m * 1e3 / 2.0,
            wanted: record.problem.goals.normal_impulse,
            surfaces: evidence
                .surfaces
                .iter()
                .map(|s| surface(frame, s))
                .collect(),
            nozzle: evidence
                .nozzle
                .iter()
                .map(|b| piece(frame, pose.exit_m, b))
                .collect(),
            paths: evidence
                .paths
                .iter()
                .map(|path| Path {
                    points: points(frame, &path.points_m),
                    breaks: path.breaks,
                    picked: path.picked,
                })
                .collect(),
            hits: hits(record, evidence),
            rebounds: rebounds(record, evidence),
            places: places.collect(),
            motion: Motion::new(record, evidence),
        }
    }
}

fn surface<'a>(frame: &FrameRecord, shape: &'a SurfaceShapeRecord) -> Surface<'a> {
    Surface {
        name: &shape.name,
        role: shape.role,
        points: points(frame, &shape.points_m),
        triangles: shape.whole_triangles().flatten().collect(),
    }
}

fn piece(frame: &FrameRecord, exit: [f64; 3], body: &BodyRecord) -> Piece {
    let from = point(frame, exit);
    match *body {
        BodyRecord::Ball { radius_m } => Piece {
            from,
            to: from,
            radius: radius_m * 1e3,
        },
        BodyRecord::Capsule {
            length_m,
            radius_m,
            direction,
        } => Piece {
            from,
            to: [0, 1, 2].map(|axis| rounded(from[axis] + direction[axis] * length_m * 1e3)),
            radius: radius_m * 1e3,
        },
    }
}

fn hits(record: &Record, evidence: &EvidenceRecord) -> Dots {
    let hits = &evidence.hits;
    let impulses = hits.normal_impulse.iter().zip(&hits.tangential_impulse);
    let goals = &record.problem.goals;
    Dots {
        points: first_points(&evidence.frame, &hits.points_m),
        impulse: first(&hits.normal_impulse),
        breaks: impulses
            .take(MOST_DOTS)
            .map(|(&normal, &tangential)| {
                u8::from(breaks_goal(goals, f64::from(normal), f64::from(tangential)))
            })
            .collect(),
    }
}

fn breaks_goal(goals: &GoalsRecord, normal: f64, tangential: f64) -> bool {
    let off = (normal / goals.normal_impulse - 1.0).abs();
    off > goals.normal_impulse_tolerance
        || goals
            .tangential_impulse
            .is_some_and(|limit| tangential > limit)
}

fn rebounds(record: &Record, evidence: &EvidenceRecord) -> Dots {
    let rebounds = &evidence.rebounds;
    let allowed = |surface: u32| {
        let shape = evidence.surfaces.get(surface as usize)?;
        record.best.surfaces.get(&shape.name)?.allow
    };
    let impacts = rebounds.normal_impulse.iter().zip(&rebounds.surface);
    Dots {
        points: first_points(&evidence.frame, &rebounds.points_m),
        impulse: first(&rebounds.normal_impulse),
        breaks: impacts
            .take(MOST_DOTS)
            .map(|(&impulse, &surface)| {
                u8::from(allowed(surface).is_some_and(|allow| f64::from(impulse) > allow))
            })
            .collect(),
    }
}

fn first(values: &[f32]) -> Vec<f32> {
    values.iter().copied().take(MOST_DOTS).collect()
}

fn first_points(frame: &FrameRecord, metres: &[[f32; 3]]) -> Vec<f64> {
    points(frame, &metres[..metres.len().min(MOST_DOTS)])
}

fn points(frame: &FrameRecord, metres: &[[f32; 3]]) -> Vec<f64> {
    metres
        .iter()
        .flat_map(|at| point(frame, at.map(f64::from)))
        .collect()
}

/// Millimetres from the aim point.
pub(super) fn point(frame: &FrameRecord, metres: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| rounded((metres[axis] - frame.aim_m[axis]) * 1e3))
}

fn rounded(millimetres: f64) -> f64 {
    (millimetres * FINENESS).round() / FINENESS
}
