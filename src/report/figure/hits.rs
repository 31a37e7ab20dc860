//! The figure of the hits on the target: where they lie, what they deliver there, and how often.

mod grid;
mod histogram;
mod map;

use std::ops::Range;

use plotters::prelude::*;

use self::grid::Grid;
use self::histogram::histograms;
use self::map::maps;
use super::marks::Mark;
use super::sheet::{Fault, drawn, headline};
use super::style::INK;
use crate::record::{
    EvidenceRecord, GoalsRecord, HitsRecord, Record, RoleRecord, SurfaceShapeRecord,
};
use crate::report::number::{count, share_asked, significant};

const SIZE: (u32, u32) = (2000, 1250);
/// Upper left corners of maps and histograms, px, and their sizes.
const LEFT: [i32; 3] = [130, 760, 1450];
const TOP: [i32; 2] = [250, 810];
const WIDTH: i32 = 390;
const MAP_HEIGHT: i32 = 390;
const HISTOGRAM_HEIGHT: i32 = 300;
/// Room round the hits, relative to their extent.
const ROOM: f64 = 0.08;

/// The figure as SVG; `None` where nothing was hit, where all shots are the same, or where a hit
/// lacks some of its values.
pub fn svg(record: &Record, evidence: &EvidenceRecord) -> Option<Result<String, Fault>> {
    let hits = &evidence.hits;
    let number = hits.plane_m.len();
    let columns = [
        hits.angle_deg.len(),
        hits.normal_impulse.len(),
        hits.tangential_impulse.len(),
        hits.sticks.len(),
    ];
    if number == 0 || hits.shots < 2 || columns.iter().any(|column| *column != number) {
        return None;
    }
    let grid = Grid::new(hits);
    Some(drawn(SIZE, |area| {
        let sentences = [record.problem.title.clone(), where_they_lie(hits, evidence)];
        headline(area, "First hits on the target", &sentences)?;
        let outline = outline(evidence);
        for (index, map) in maps(record, hits, &grid).iter().enumerate() {
            let plot = map.draw(area, index, &grid)?;
            for ends in &outline {
                plot.segment(*ends, INK.stroke_width(3))?;
            }
        }
        for (index, histogram) in histograms(record, hits).iter().enumerate() {
            histogram.draw(area, index)?;
        }
        Ok(())
    }))
}

fn where_they_lie(hits: &HitsRecord, evidence: &EvidenceRecord) -> String {
    let sizes = |plane: &mut dyn Iterator<Item = [f64; 2]>| {
        let [x, y] = extent(plane);
        format!(
            "{} x {} mm",
            significant(x.end - x.start, 2),
            significant(y.end - y.start, 2)
        )
    };
    format!(
        "{} of {} shots hit it; the hits span {} of a patch of {}. Each shot flies as the jet scatters and \
         from a setting within the tolerance; the outline is the edge of the patch.",
        count(hits.plane_m.len()),
        count(hits.shots),
        sizes(&mut in_millimetres(hits)),
        sizes(&mut patch(evidence).flatten()),
    )
}

/// The triangles of the target, mm along and across from the aim point.
fn patch(evidence: &EvidenceRecord) -> impl Iterator<Item = [[f64; 2]; 3]> {
    let frame = &evidence.frame;
    let flat = move |at: [f32; 3]| {
        let from = [0, 1, 2].map(|axis| f64::from(at[axis]) - frame.aim_m[axis]);
        [frame.along, frame.across].map(|axis| {
            let parts = from.iter().zip(axis).map(|(part, unit)| part * unit);
            parts.sum::<f64>() * 1e3
        })
    };
    let targets = evidence
        .surfaces
        .iter()
        .filter(|s| s.role == RoleRecord::Target);
    let faces = targets.flat_map(SurfaceShapeRecord::faces);
    faces.map(move |corners| corners.map(flat))
}

/// The edges of the target patch: those that belong to one triangle only.
fn outline(evidence: &EvidenceRecord) -> Vec<[(f64, f64); 2]> {
    let mut edges = std::collections::BTreeMap::new();
    // Corners of neighbours are the same but for rounding.
    let key = |at: [f64; 2]| at.map(|part| (part * 1e4).round() as i64);
    for triangle in patch(evidence) {
        for index in 0..3 {
            let ends = [triangle[index], triangle[(index + 1) % 3]];
            let mut name = ends.map(key);
            name.sort_unstable();
            let (number, _) = edges.entry(name).or_insert((0, ends));
            *number += 1;
        }
    }
    let single = edges.into_values().filter(|(number, _)| *number == 1);
    single
        .map(|(_, ends)| ends.map(|[along, across]| (along, across)))
        .collect()
}

fn in_millimetres(hits: &HitsRecord) -> impl Iterator<Item = [f64; 2]> {
    hits.plane_m
        .iter()
        .map(|at| at.map(|part| f64::from(part) * 1e3))
}

fn extent(points: &mut dyn Iterator<Item = [f64; 2]>) -> [Range<f64>; 2] {
    let empty = [
        f64::INFINITY..f64::NEG_INFINITY,
        f64::INFINITY..f64::NEG_INFINITY,
    ];
    points.fold(empty, |[x, y], at| {
        [
            x.start.min(at[0])..x.end.max(at[0]),
            y.start.min(at[1])..y.end.max(at[1]),
        ]
    })
}

/// What is wanted of N* and the ends of its tolerance, uN.s.
fn tolerance_marks(goals: &GoalsRecord) -> Vec<Mark> {
    let wanted = goals.normal_impulse * 1e6;
    let tolerance = goals.normal_impulse_tolerance;
    let end = |sign: char, factor: f64| Mark {
        value: wanted * factor,
        name: format!("{sign}{}", share_asked(tolerance)),
        is_dashed: true,
    };
    vec![
        Mark {
            value: wanted,
            name: "wanted".into(),
            is_dashed: false,
        },
        end('\u{2212}', 1.0 - tolerance),
        end('+', 1.0 + tolerance),
    ]
}

/// The limit of f*, uN.s.
fn limit_mark(goals: &GoalsRecord) -> Option<Mark> {
    goals.tangential_impulse.map(|limit| Mark {
        value: limit * 1e6,
        name: "limit".into(),
        is_dashed: false,
    })
}
