//! Shots against the narrow places of the part.

use nalgebra::{Point2, Vector2};

use super::Note;
use crate::digits::{fixed, significant};
use crate::elementary::cos;
use crate::jet::Pose;
use crate::problem::curve::Curve;
use crate::problem::part::{Part, Shape};
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::scene::profile::Profile;

/// ASTM B851: the diameter of the shot is at most this part of a fillet's radius.
const OF_A_FILLET: f64 = 0.5;
/// The same: at most this part of the width of an opening.
const OF_AN_OPENING: f64 = 0.25;
/// Walls face each other when their normals are opposed within this angle.
const FACING: f64 = 10.0 / 180.0 * std::f64::consts::PI;
/// Chords that stand in for arcs where gaps are measured turn by at most this angle.
const CHORD_ANGLE: f64 = 2.0 / 180.0 * std::f64::consts::PI;

/// Shots that fly as points.
pub(super) fn point_shots(scenario: &Scenario) -> Option<Note> {
    let radius = scenario.problem.shot.radius;
    let (name, why) = match scenario.scene.has_parry_rays() {
        true => (
            "parry_rays",
            "rays are cast by parry at triangles, for shots that fly as points",
        ),
        false => ("point_shots", "shots fly as points, as the file asks"),
    };
    (!scenario.problem.paths.shot_size).then(|| Note {
        name,
        value: radius,
        text: format!(
            "{why}: a real one touches a wall {} mm before its centre \
             would, which matters where that is not small against the groove",
            significant(radius * 1e3, 3)
        ),
    })
}

/// Shots that are too large for the smallest fillet of the part that holds the target.
pub(super) fn fillet(scenario: &Scenario) -> Option<Note> {
    let radius = smallest_fillet(&target_part(scenario)?.shape)?;
    let diameter = 2.0 * scenario.problem.shot.radius;
    (diameter > OF_A_FILLET * radius).then(|| Note {
        name: "fillet",
        value: diameter / radius,
        text: format!(
            "shots of {} mm are {} times the smallest fillet radius of the part, {} mm: {}; ASTM B851 \
             has shot of at most half the radius, which keeps three quarters",
            significant(diameter * 1e3, 3),
            fixed(diameter / radius, 2),
            significant(radius * 1e3, 3),
            against_a_fillet(diameter / (2.0 * radius)),
        ),
    })
}

/// What a fillet does to the dent of a shot whose radius is this part of its own: the curvature across the
/// fillet that is left between the two.
fn against_a_fillet(part: f64) -> String {
    if part >= 1.0 {
        return "they span it and do not touch its bottom".into();
    }
    format!(
        "against its hollow they curve by only {:.0} % of what they do against a flat strip, so dents are wider \
         and shallower there",
        (1.0 - part) * 100.0
    )
}

/// Shots that are too large for the narrowest gap of the part that holds the target.
pub(super) fn opening(scenario: &Scenario, settings: &Settings) -> Option<Note> {
    let width = narrowest_gap(scenario, settings, target_part(scenario)?)?;
    let diameter = 2.0 * scenario.problem.shot.radius;
    (diameter > OF_AN_OPENING * width).then(|| Note {
        name: "opening",
        value: diameter / width,
        text: format!(
            "shots of {} mm are {} times the narrowest gap of the part, {} mm; ASTM B851 has shot of at most \
             a quarter of it: wider ones have no room to pass each other on their way in and out",
            significant(diameter * 1e3, 3),
            fixed(diameter / width, 2),
            significant(width * 1e3, 3),
        ),
    })
}

fn target_part(scenario: &Scenario) -> Option<&Part> {
    let (name, _) = scenario.problem.target.surface.split_once('.')?;
    scenario.problem.parts.iter().find(|part| part.name == name)
}

/// Least radius of a rounded inner corner, m. Sharp corners have none.
fn smallest_fillet(shape: &Shape) -> Option<f64> {
    match shape {
        Shape::Keyway(keyway) => (keyway.root_radius > 0.0).then_some(keyway.root_radius),
        Shape::Extrude { profile, .. } | Shape::Revolve { profile } => {
            let pieces = Profile::outline(profile).pieces;
            let concave = pieces.into_iter().filter_map(|piece| match piece.curve {
                // Counter-clockwise arcs have their centre, and free space, to the left.
                Curve::Arc { radius, sweep, .. } if sweep > 0.0 => Some(radius),
                _ => None,
            });
            concave.min_by(f64::total_cmp)
        }
        Shape::Bore { .. } | Shape::Box { .. } | Shape::Mesh { .. } => None,
    }
}

/// Least width of an opening, m; not known for meshes.
fn narrowest_gap(scenario: &Scenario, settings: &Settings, part: &Part) -> Option<f64> {
    match &part.shape {
        Shape::Keyway(keyway) => Some(keyway.width.min(keyway.bore)),
        Shape::Bore { diameter, .. } => {
            is_shot_from_inside(scenario, settings, part, *diameter).then_some(*diameter)
        }
        Shape::Extrude { profile, .. } => gap_of_outline(&Profile::outline(profile)),
        // Across the axis it is twice the least distance from that.
        Shape::Revolve { profile } => {
            let least = profile.iter().map(|it| it.curve().least_x());
            let least = least.fold(f64::INFINITY, f64::min);
            (least > 0.0 && is_shot_from_inside(scenario, settings, part, 2.0 * least))
                .then_some(2.0 * least)
        }
        Shape::Box { .. } | Shape::Mesh { .. } => None,
    }
}

/// Whether a bore is a hole: a pin is aimed at from outside.
fn is_shot_from_inside(
    scenario: &Scenario,
    settings: &Settings,
    part: &Part,
    diameter: f64,
) -> bool {
    let frame = &scenario.target.frame;
    let above = frame.aim + frame.normal * (1e-3 * diameter);
    let exit = Pose::new(frame, settings).exit;
    [above, exit].into_iter().any(|point| {
        let own = part.place.rotation.inverse() * (point.coords - part.place.shift);
        own.xy().norm() < diameter / 2.0
    })
}

/// A chord of an outline.
struct Chord {
    from: Point2<f64>,
    to: Point2<f64>,
}

impl Chord {
    /// Unit normal towards free space, on the left.
    fn normal(&self) -> Vector2<f64> {
        let along = (self.to - self.from).normalize();
        Vector2::new(-along.y, along.x)
    }

    /// Distance along a unit direction at which it is met from its front.
    fn met(&self, origin: &Point2<f64>, direction: &Vector2<f64>) -> Option<f64> {
        let along = self.to - self.from;
        let across = direction.perp(&along);
        let offset = self.from - origin;
        let distance = offset.perp(&along) / across;
        let place = offset.perp(direction) / across;
        let is_met = across != 0.0 && distance > 0.0 && (0.0..=1.0).contains(&place);
        (is_met && self.normal().dot(direction) < 0.0).then_some(distance)
    }
}

/// The shortest way straight across free space from the middle of a chord to a wall that faces it, m.
fn gap_of_outline(profile: &Profile) -> Option<f64> {
    let chains = profile.chords(CHORD_ANGLE);
    let pairs = chains.iter().flat_map(|chain| chain.windows(2));
    let chords: Vec<Chord> = pairs
        .map(|pair| Chord {
            from: pair[0],
            to: pair[1],
        })
        .filter(|chord| chord.from != chord.to)
        .collect();
    let gap = |chord: &Chord| {
        let (middle, normal) = (nalgebra::center(&chord.from, &chord.to), chord.normal());
        let crossings = chords
            .iter()
            .filter_map(|other| Some((other.met(&middle, &normal)?, other)));
        let (distance, other) = crossings.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (other.normal().dot(&normal) < -cos(FACING)).then_some(distance)
    };
    chords.iter().filter_map(gap).min_by(f64::total_cmp)
}
