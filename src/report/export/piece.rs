//! What is shown, piece by piece, whatever the format.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{Point3, Vector3};

use crate::elementary::sin_cos;
use crate::record::{
    BodyRecord, EvidenceRecord, HitsRecord, PathRecord, RoleRecord, SurfaceShapeRecord,
};

/// Something with a name and a colour of its own.
pub(super) struct Piece {
    pub name: String,
    /// sRGB.
    pub color: [u8; 3],
    /// 1, or less for what one must see through.
    pub opacity: f32,
    /// Of a piece of the nozzle's body, what it moves with.
    pub body: Option<Body>,
    /// Corners, m.
    pub points: Vec<[f32; 3]>,
    pub cells: Cells,
}

/// A piece of the nozzle's body, as it stands.
#[derive(Clone, Copy)]
pub(super) struct Body {
    /// In the order of the file.
    pub index: usize,
    /// Where the exit is, m.
    pub exit: [f32; 3],
    /// Where its far end is from there, m.
    pub tip: Vector3<f64>,
}

/// What the points of a piece make.
pub(super) enum Cells {
    /// Three corners each.
    Triangles(Vec<[u32; 3]>),
    /// Both ends.
    Lines(Vec<[u32; 2]>),
    /// The points themselves, with N*, N s.
    Points(Vec<f32>),
}

// Colours of Okabe and Ito, which colour-blind people can tell apart, and greys.
const VERMILION: [u8; 3] = [0xd5, 0x5e, 0x00];
const SKY_BLUE: [u8; 3] = [0x56, 0xb4, 0xe9];
const WALL: [u8; 3] = [0xdd, 0xe3, 0xe8];
/// Of secondary surfaces: the jet is inside them.
const SEE_THROUGH: f32 = 0.35;
const NOZZLE: [u8; 3] = [0x8a, 0x93, 0x9b];
const HIT: [u8; 3] = [0x22, 0x22, 0x22];
const BREAKS: [u8; 3] = [0xcc, 0x00, 0x00];
const FLIGHTS: [(&str, [u8; 3]); 4] = [
    ("paths to the first hit", [0x00, 0x72, 0xb2]),
    ("paths after the first hit", [0xe6, 0x9f, 0x00]),
    ("paths after the second hit", [0x00, 0x9e, 0x73]),
    ("paths later", [0xcc, 0x79, 0xa7]),
];

/// Surfaces, nozzle, paths by bounce with those that break a limit apart, hits; none that is empty.
pub(super) fn all(evidence: &EvidenceRecord, exit: [f64; 3]) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = evidence.surfaces.iter().map(surface).collect();
    for (body, number) in evidence.nozzle.iter().zip(1..) {
        pieces.push(nozzle(body, number, &Point3::from(exit)));
    }
    pieces.extend(paths(evidence));
    pieces.push(hits(&evidence.hits));
    pieces.retain(|piece| !piece.points.is_empty());
    pieces
}

fn surface(shape: &SurfaceShapeRecord) -> Piece {
    let (suffix, color, opacity) = match shape.role {
        RoleRecord::Target => (" (target)", VERMILION, 1.0),
        RoleRecord::Secondary => ("", WALL, SEE_THROUGH),
        RoleRecord::Deflector => (" (deflector)", SKY_BLUE, 1.0),
    };
    Piece {
        name: format!("{}{suffix}", shape.name),
        color,
        opacity,
        body: None,
        points: shape.points_m.clone(),
        cells: Cells::Triangles(shape.whole_triangles().collect()),
    }
}

fn hits(hits: &HitsRecord) -> Piece {
    let pairs = hits.points_m.iter().zip(&hits.normal_impulse);
    let (points, impulses) = pairs.unzip();
    Piece {
        name: "hits".into(),
        color: HIT,
        opacity: 1.0,
        body: None,
        points,
        cells: Cells::Points(impulses),
    }
}

/// Line segments by how often their shot has bounced, deflectors not counted.
fn paths(evidence: &EvidenceRecord) -> Vec<Piece> {
    let deflectors: Vec<&str> = evidence
        .surfaces
        .iter()
        .filter(|shape| shape.role == RoleRecord::Deflector)
        .map(|shape| shape.name.as_str())
        .collect();
    let mut segments: BTreeMap<usize, Vec<[f32; 3]>> = BTreeMap::new();
    for path in &evidence.paths {
        let mut flight = 0;
        for (index, ends) in path.points_m.windows(2).enumerate() {
            let group = if path.breaks {
                FLIGHTS.len()
            } else {
                flight.min(FLIGHTS.len() - 1)
            };
            segments.entry(group).or_default().extend(ends);
            flight += usize::from(counts(path, index, &deflectors));
        }
    }
    let piece = |(group, points): (usize, Vec<[f32; 3]>)| {
        let (name, color) = FLIGHTS
            .get(group)
            .copied()
            .unwrap_or(("paths that break a limit", BREAKS));
        let segments = points.len() as u32 / 2;
        Piece {
            name: name.into(),
            color,
            opacity: 1.0,
            body: None,
            points,
            cells: Cells::Lines((0..segments).map(|i| [2 * i, 2 * i + 1]).collect()),
        }
    };
    segments.into_iter().map(piece).collect()
}

/// Whether the impact at the end of a segment is one that is counted.
fn counts(path: &PathRecord, segment: usize, deflectors: &[&str]) -> bool {
    let impact = path.impacts.get(segment);
    impact.is_some_and(|impact| !deflectors.contains(&impact.surface.as_str()))
}

/// Corners round a body, and from its pole to its equator.
const ROUND: u32 = 32;
const RINGS: u32 = 8;

/// A body as a rod with round ends; a ball is one without length.
fn nozzle(body: &BodyRecord, number: usize, exit: &Point3<f64>) -> Piece {
    let (length, radius, axis) = match *body {
        BodyRecord::Ball { radius_m } => (0.0, radius_m, Vector3::z()),
        BodyRecord::Capsule {
            length_m,
            radius_m,
            direction,
        } => (length_m, radius_m, Vector3::from(direction)),
    };
    let least = axis.map(f64::abs).imin();
    let side = axis.cross(&Vector3::ith(least, 1.0)).normalize();
    let other = axis.cross(&side);
    let mut points = Vec::new();
    // Rings from pole to pole; the equator comes twice, once at each end of the rod.
    for (end, from) in [(0.0, 0), (length, RINGS)] {
        for ring in from..=from + RINGS {
            let latitude = (f64::from(ring) / f64::from(RINGS) - 1.0) * FRAC_PI_2;
            let (latitude_sine, latitude_cosine) = sin_cos(latitude);
            for step in 0..ROUND {
                let (sin, cos) = sin_cos(TAU * f64::from(step) / f64::from(ROUND));
                let outwards = (side * cos + other * sin) * latitude_cosine;
                let point = exit + axis * end + (outwards + axis * latitude_sine) * radius;
                points.push([point.x as f32, point.y as f32, point.z as f32]);
            }
        }
    }
    let corner = |ring: u32, step: u32| ring * ROUND + step % ROUND;
    let quads = (0..2 * RINGS + 1).flat_map(|ring| (0..ROUND).map(move |step| (ring, step)));
    let triangles = quads.flat_map(|(ring, step)| {
        let [a, b] = [corner(ring, step), corner(ring, step + 1)];
        let [c, d] = [corner(ring + 1, step + 1), corner(ring + 1, step)];
        [[a, b, c], [a, c, d]]
    });
    let has_area = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|corner| points[corner as usize]);
        a != b && b != c && c != a
    };
    let triangles = triangles.filter(has_area).collect();
    Piece {
        name: format!("nozzle, body {number}"),
        color: NOZZLE,
        opacity: 1.0,
        body: Some(Body {
            index: number - 1,
            exit: [exit.x, exit.y, exit.z].map(|it| it as f32),
            tip: axis * length,
        }),
        points,
        cells: Cells::Triangles(triangles),
    }
}
