//! Sizes and distances that do not belong together.

use nalgebra::{Point3, Vector3};

use crate::elementary::extremes;
use crate::problem::equipment::{Body, Nozzle};
use crate::problem::setting::{Range, Setting};
use crate::problem::warning::{Warning, WarningCode, short};
use crate::scenario::Scenario;

/// Sizes that differ by more than this factor are not in the same unit.
const ANOTHER_UNIT: f64 = 300.0;
/// A part may be longer than a shot by this factor.
const LONGEST_IN_SHOTS: f64 = 2e4;
/// A standoff may be longer than the scene by this factor.
const FARTHEST_IN_SCENES: f64 = 10.0;
/// Share of its radius by which a shot may seem to reach into a wall where facets stand for arcs.
const FACETS: f64 = 0.05;

/// A box, m.
type Bounds = (Point3<f64>, Point3<f64>);

pub(super) fn warnings(scenario: &Scenario) -> Vec<Warning> {
    let Some(bounds) = part_bounds(scenario) else {
        return Vec::new();
    };
    let Some(of_target) = bounds.iter().find(|(name, _)| is_targets(scenario, name)) else {
        return Vec::new();
    };
    let own = &of_target.1;
    [
        unit(scenario, own),
        patch_box(scenario, own),
        room(scenario),
    ]
    .into_iter()
    .flatten()
    .chain(parts(scenario, &bounds, own))
    .chain(standoff(scenario, &bounds))
    .chain(aims(scenario))
    .collect()
}

/// The box round each part, in the order of the file.
fn part_bounds(scenario: &Scenario) -> Option<Vec<(String, Bounds)>> {
    let parts = scenario.problem.parts.iter();
    parts
        .map(|part| {
            let own = format!("{}.", part.name);
            let names = (0..).zip(scenario.scene.surfaces());
            let surfaces = names.filter(|(_, name)| name.starts_with(&own));
            let corners = surfaces.flat_map(|(index, _)| scenario.scene.surface_triangles(index));
            Some((part.name.clone(), around(corners.flatten())?))
        })
        .collect()
}

fn around(points: impl Iterator<Item = Point3<f64>>) -> Option<Bounds> {
    let boxes = points.map(|point| (point, point));
    boxes.reduce(|(low, high), (a, b)| (low.inf(&a), high.sup(&b)))
}

fn longest_side((low, high): &Bounds) -> f64 {
    (high - low).max()
}

fn is_targets(scenario: &Scenario, part: &str) -> bool {
    let target = &scenario.problem.target.surface;
    target
        .strip_prefix(part)
        .is_some_and(|rest| rest.starts_with('.'))
}

fn unit(scenario: &Scenario, part: &Bounds) -> Option<Warning> {
    let (side, shot) = (longest_side(part), 2.0 * scenario.problem.shot.radius);
    let times = side / shot;
    let (doubt, message) = if times < 1.0 {
        let message = format!(
            "the part with the target is {} mm long, smaller than the shot of {} mm",
            short(side * 1e3),
            short(shot * 1e3)
        );
        (WarningCode::PartSmallerThanShot, message)
    } else if times > LONGEST_IN_SHOTS {
        let message = format!(
            "the part with the target is {} mm long, {} times the diameter of the shot",
            short(side * 1e3),
            short(times)
        );
        (WarningCode::PartFarTooLarge, message)
    } else {
        return None;
    };
    let help = "compare `lengths_in` with the drawing";
    Some(Warning::new(doubt, "lengths_in", message, help))
}

fn patch_box(scenario: &Scenario, part: &Bounds) -> Option<Warning> {
    let side = longest_side(part);
    let within = scenario.target.within?;
    (longest_side(&within) > ANOTHER_UNIT * side).then(|| {
        let message = format!(
            "is {} times as long as the part itself: it cuts nothing off",
            short(longest_side(&within) / side)
        );
        let help = "its corners are in `lengths_in`; leave it out if all of the surface is meant";
        Warning::new(WarningCode::BoxTooLarge, "target.within", message, help)
    })
}

/// A shot that touches the aim point must not reach into a wall.
fn room(scenario: &Scenario) -> Option<Warning> {
    let radius = scenario.problem.shot.radius;
    let frame = &scenario.target.frame;
    let ball = Nozzle {
        body: vec![Body::Ball { radius }],
        clearance: 0.0,
    };
    let centre = frame.aim + frame.normal * radius;
    let (gap, surface) = scenario
        .scene
        .clearance(&ball, &centre, &-frame.normal, radius)?;
    (gap < -FACETS * radius).then(|| {
        let message = format!(
            "a shot of {} mm cannot touch the aim point: `{}` is {} mm too near",
            short(2.0 * radius * 1e3),
            scenario.scene.surfaces()[surface as usize],
            short(-gap * 1e3),
        );
        let help = "take smaller shot, or aim farther away from the wall";
        Warning::new(WarningCode::NoRoom, "shot.radius", message, help)
    })
}

/// Parts in another unit than the one with the target.
fn parts(scenario: &Scenario, bounds: &[(String, Bounds)], own: &Bounds) -> Vec<Warning> {
    let standing = |name: &str| {
        let mut parts = scenario.problem.parts.iter();
        parts.any(|part| part.name == name && !part.on_nozzle)
    };
    let side = longest_side(own);
    let others = bounds
        .iter()
        .filter(|(name, _)| standing(name) && !is_targets(scenario, name));
    others
        .filter_map(|(name, other)| {
            let times = longest_side(other) / side;
            let gap = (other.0 - own.1)
                .sup(&(own.0 - other.1))
                .sup(&Vector3::zeros())
                .norm();
            let (doubt, message) = if !(1.0 / ANOTHER_UNIT..ANOTHER_UNIT).contains(&times) {
                let times = short(times);
                let message = format!("is {times} times as long as the part with the target");
                (WarningCode::PartOfAnotherSize, message)
            } else if gap > ANOTHER_UNIT * side.max(longest_side(other)) {
                let gap = short(gap);
                let message = format!("lies {gap} m away from the part with the target");
                (WarningCode::PartFarAway, message)
            } else {
                return None;
            };
            let help = "compare its lengths and `lengths_in`";
            Some(Warning::new(doubt, format!("scene.{name}"), message, help))
        })
        .collect()
}

fn standoff(scenario: &Scenario, bounds: &[(String, Bounds)]) -> Option<Warning> {
    let corners = bounds.iter().flat_map(|(_, (low, high))| [*low, *high]);
    let scene = longest_side(&around(corners)?);
    let farthest = scenario.problem.ranges.standoff.max;
    (farthest > FARTHEST_IN_SCENES * scene).then(|| {
        let message = format!(
            "the exit may be {} mm away, {} times the length of the scene",
            short(farthest * 1e3),
            short(farthest / scene)
        );
        let help = "it counts from the aim point back to the exit of the nozzle";
        Warning::new(
            WarningCode::StandoffTooLong,
            "settings.standoff",
            message,
            help,
        )
    })
}

/// Shifts of the aim point that leave the target altogether.
fn aims(scenario: &Scenario) -> Vec<Warning> {
    let frame = &scenario.target.frame;
    let axes = [
        (Setting::AimAlong, frame.along),
        (Setting::AimAcross, frame.across),
    ];
    axes.into_iter()
        .filter_map(|(setting, axis)| {
            let Range { min, max } = scenario.problem.ranges.range(setting)?;
            let (pieces, _) = scenario.target.cut_out(&scenario.scene);
            let points = pieces.into_iter().flatten();
            let places = points.map(|point| axis.dot(&(point - frame.aim)));
            let (low, high) = extremes(places);
            let slack = 1e-6 * (high - low);
            (min > high + slack || max < low - slack).then(|| {
                let message = format!(
                    "moves the aim point off the target, which reaches from {} mm to {} mm this way",
                    short(low * 1e3),
                    short(high * 1e3)
                );
                let help = "shifts count from `target.aim`";
                let key = format!("settings.{}", setting.name());
                Warning::new(WarningCode::AimOffTarget, key, message, help)
            })
        })
        .collect()
}
