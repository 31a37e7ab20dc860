//! The scene cut through the aim point, as a still picture for where nothing moves.

mod view;

use askama::Template;
use nalgebra::{Point3, Vector3};

use self::view::View;
use super::look::{Colour, LOOK, Look};
use crate::record::{EvidenceRecord, PathRecord, Record, RoleRecord, SurfaceShapeRecord};
use crate::report::number::{count, plain};

/// Units of the drawing: its width, the height of the scene in it, and that of the whole.
const WIDTH: f64 = 1000.0;
const PICTURE: f64 = 600.0;
const HEIGHT: f64 = 664.0;
/// The body of the nozzle, which one sees through, on white.
const NOZZLE_ON_WHITE: Colour = Colour(165, 170, 176);

/// The picture.
#[derive(Template)]
#[template(path = "still.svg", config = "src/report/page/askama.toml")]
pub struct Still {
    look: Look,
    width: f64,
    height: f64,
    picture: f64,
    /// What lies behind the section, farthest first.
    behind: Vec<Area>,
    cuts: Vec<String>,
    target_cut: String,
    nozzle: Vec<Piece>,
    axis: String,
    exit: String,
    flights: Vec<Flight>,
    breaks: String,
    labels: Vec<Label>,
    strips: Vec<Label>,
    bar_from: f64,
    bar_to: f64,
    bar_height: f64,
    bar_length: String,
    legend: Vec<Entry>,
    legend_height: f64,
    caption: String,
}

struct Area {
    path: String,
    colour: Colour,
}

struct Piece {
    path: String,
    width: String,
}

struct Flight {
    path: String,
    colour: Colour,
}

struct Label {
    x: String,
    y: String,
    anchor: &'static str,
    text: String,
}

struct Entry {
    x: f64,
    colour: Colour,
    width: f64,
    is_dashed: bool,
    text: &'static str,
}

impl Still {
    /// The section of a record's scene.
    pub fn new(record: &Record, evidence: &EvidenceRecord) -> Self {
        let view = View::new(record, evidence);
        let direction = Vector3::from(record.best.pose.direction);
        let exit = Point3::from(record.best.pose.exit_m);
        let tip = exit + direction * (exit - view.aim).norm();
        let rim = view.right.cross(&view.up).cross(&direction);
        let rim = rim.try_normalize(1e-9).unwrap_or(view.up) * record.problem.exit_diameter_m / 2.0;
        let is_target = |shape: &&SurfaceShapeRecord| shape.role == RoleRecord::Target;
        let (targets, others): (Vec<_>, Vec<_>) = evidence.surfaces.iter().partition(is_target);
        let shown = evidence.paths.iter().filter(|path| !path.picked);
        let (breaking, kept): (Vec<_>, Vec<_>) = shown.partition(|path| path.breaks);
        let (bar, bar_length) = view.scale_bar();
        Self {
            look: LOOK,
            width: WIDTH,
            height: HEIGHT,
            picture: PICTURE,
            behind: view.behind(&evidence.surfaces),
            cuts: others.iter().map(|shape| view.cut_path(shape)).collect(),
            target_cut: targets.iter().map(|shape| view.cut_path(shape)).collect(),
            nozzle: evidence
                .nozzle
                .iter()
                .map(|body| view.body(exit, body))
                .collect(),
            axis: view.line(&[exit, tip]),
            exit: view.line(&[exit - rim, exit + rim]),
            flights: flights(&view, &kept),
            breaks: breaking
                .iter()
                .map(|path| view.line(&points(path)))
                .collect(),
            labels: view.labels(&evidence.surfaces),
            strips: view.strips(evidence),
            bar_from: 20.0,
            bar_to: 20.0 + bar,
            bar_height: PICTURE - 18.0,
            bar_length: plain(bar_length),
            legend: legend(&kept, !breaking.is_empty()),
            legend_height: PICTURE + 20.0,
            caption: format!(
                "{}; cut through the aim point{}, seen against {}.",
                match breaking.len() + kept.len() {
                    1 => "1 shot".into(),
                    shots => format!("{} shots as they come", count(shots)),
                },
                if evidence.places.is_empty() {
                    ""
                } else {
                    ", numbers are test strips"
                },
                view.seen_against,
            ),
        }
    }
}

fn points(path: &PathRecord) -> Vec<Point3<f64>> {
    let point = |at: &[f32; 3]| Point3::from(at.map(f64::from));
    path.points_m.iter().map(point).collect()
}

/// The flights of all paths by bounce, the last ones first so that the jet stays on top.
fn flights(view: &View, paths: &[&PathRecord]) -> Vec<Flight> {
    let mut drawn = LOOK.flights.map(|flight| Flight {
        path: String::new(),
        colour: flight.colour,
    });
    for path in paths {
        for (flight, ends) in points(path).windows(2).enumerate() {
            drawn[flight.min(LOOK.flights.len() - 1)].path += &view.line(ends);
        }
    }
    let mut drawn = Vec::from(drawn);
    drawn.reverse();
    drawn
}

fn legend(kept: &[&PathRecord], any_breaks: bool) -> Vec<Entry> {
    let most = kept
        .iter()
        .map(|path| path.points_m.len().saturating_sub(1))
        .max();
    let entry = |colour, width, is_dashed, text| Entry {
        x: 0.0,
        colour,
        width,
        is_dashed,
        text,
    };
    let mut entries = vec![
        entry(LOOK.target_cut, 6.0, false, "target"),
        entry(NOZZLE_ON_WHITE, 12.0, false, "nozzle"),
    ];
    for flight in LOOK.flights.into_iter().take(most.unwrap_or(0)) {
        entries.push(entry(flight.colour, 2.5, false, flight.name));
    }
    if any_breaks {
        entries.push(entry(LOOK.breaks, 3.0, true, "breaks a limit"));
    }
    let mut x = 16.0;
    for entry in &mut entries {
        entry.x = x;
        x += 56.0 + 6.9 * entry.text.len() as f64;
    }
    entries
}
