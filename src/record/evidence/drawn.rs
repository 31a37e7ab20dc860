//! From what was computed to what is kept: columns of short numbers.

use nalgebra::{Point3, Vector3};

use super::{
    BodyRecord, EvidenceRecord, FrameRecord, HitsRecord, PathImpactRecord, PathRecord, PlaceRecord,
    ReboundsRecord, RoleRecord, SurfaceShapeRecord,
};
use crate::elementary::{log10, whole_power};
use crate::evidence::{Evidence, Flight, Place, Shape, Shown, broken_by};
use crate::impact::Regime;
use crate::jet::Pose;
use crate::problem::equipment::Body;
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::trace::End;

/// Most impacts on secondary surfaces that are kept, those of the first shots.
const MOST_REBOUNDS: usize = 8_192;

impl EvidenceRecord {
    /// The record of what settings look like; without maps.
    pub fn new(scenario: &Scenario, settings: &Settings, evidence: &Evidence) -> Self {
        let short = Short::of(scenario);
        Self {
            frame: FrameRecord::new(scenario),
            surfaces: evidence
                .shapes
                .iter()
                .map(|shape| short.shape(scenario, shape))
                .collect(),
            nozzle: bodies(scenario, settings),
            paths: evidence
                .shown
                .iter()
                .map(|shown| short.path(scenario, &evidence.flights[shown.flight], shown))
                .collect(),
            hits: short.hits(scenario, &evidence.flights),
            rebounds: short.rebounds(evidence),
            places: evidence
                .places
                .iter()
                .map(|place| PlaceRecord::new(scenario, place))
                .collect(),
            maps: Vec::new(),
        }
    }
}

impl FrameRecord {
    fn new(scenario: &Scenario) -> Self {
        let frame = &scenario.target.frame;
        Self {
            aim_m: frame.aim.coords.into(),
            normal: frame.normal.into(),
            along: frame.along.into(),
            across: frame.across.into(),
        }
    }
}

impl PlaceRecord {
    pub(in crate::record) fn new(scenario: &Scenario, place: &Place) -> Self {
        Self {
            name: place.name.into(),
            surface: scenario.scene.surfaces()[place.surface as usize].clone(),
            point_m: place.point.coords.into(),
            normal: place.normal.into(),
            value: place.value,
            text: place.text.clone(),
        }
    }
}

fn bodies(scenario: &Scenario, settings: &Settings) -> Vec<BodyRecord> {
    let pose = Pose::new(&scenario.target.frame, settings);
    let record = |body: &Body| match *body {
        Body::Ball { radius } => BodyRecord::Ball { radius_m: radius },
        Body::Capsule {
            length,
            radius,
            direction,
        } => BodyRecord::Capsule {
            length_m: length,
            radius_m: radius,
            direction: direction.unwrap_or(-pose.direction).into(),
        },
    };
    scenario.problem.nozzle.body.iter().map(record).collect()
}

/// Writes numbers with no more digits than pictures need.
struct Short {
    /// Coordinates are multiples of 1 m over this: of about a millionth of the scene's size.
    steps_per_metre: f64,
}

/// Significant digits of an impulse.
const IMPULSE_DIGITS: i32 = 5;
/// Steps per degree of an angle.
const ANGLE_STEPS: f64 = 1e3;

impl Short {
    fn of(scenario: &Scenario) -> Self {
        let magnitude = log10(scenario.scene.size()).ceil() as i32;
        Self {
            steps_per_metre: whole_power(10.0, 6 - magnitude),
        }
    }

    fn length(&self, metres: f64) -> f32 {
        stepped(metres, self.steps_per_metre)
    }

    fn point(&self, point: &Point3<f64>) -> [f32; 3] {
        [point.x, point.y, point.z].map(|x| self.length(x))
    }

    fn shape(&self, scenario: &Scenario, shape: &Shape) -> SurfaceShapeRecord {
        let surface = shape.surface as usize;
        SurfaceShapeRecord {
            name: scenario.scene.surfaces()[surface].clone(),
            role: if shape.is_target {
                RoleRecord::Target
            } else if scenario.surfaces[surface].deflector {
                RoleRecord::Deflector
            } else {
                RoleRecord::Secondary
            },
            share_drawn: shape.share_drawn,
            points_m: shape.points.iter().map(|point| self.point(point)).collect(),
            triangles: shape.triangles.clone(),
        }
    }

    fn path(&self, scenario: &Scenario, flight: &Flight, shown: &Shown) -> PathRecord {
        let impacts = flight.impacts.iter().map(|impact| PathImpactRecord {
            surface: scenario.scene.surfaces()[impact.surface as usize].clone(),
            normal_impulse: impulse(impact.normal_impulse),
            tangential_impulse: impulse(impact.tangential_impulse),
            breaks: !broken_by(impact, scenario).is_empty(),
        });
        PathRecord {
            points_m: flight.corners().map(|corner| self.point(&corner)).collect(),
            impacts: impacts.collect(),
            end: match flight.end {
                End::Left => "left",
                End::Stays => "stays",
                End::Spent => "spent",
                End::Limit => "limit",
            }
            .into(),
            breaks: !flight.broken(scenario).is_empty(),
            picked: shown.picked,
        }
    }

    fn hits(&self, scenario: &Scenario, flights: &[Flight]) -> HitsRecord {
        let frame = &scenario.target.frame;
        let mut hits = HitsRecord {
            shots: flights.len(),
            ..HitsRecord::default()
        };
        for flight in flights {
            let (Some(impact), Some(angle)) = (flight.hit_on_target(), flight.angle_of_first_hit())
            else {
                continue;
            };
            let from_aim = impact.point - frame.aim;
            let plane = |direction: &Vector3<f64>| self.length(from_aim.dot(direction));
            hits.points_m.push(self.point(&impact.point));
            hits.plane_m
                .push([plane(&frame.along), plane(&frame.across)]);
            hits.angle_deg
                .push(stepped(angle.to_degrees(), ANGLE_STEPS));
            hits.normal_impulse.push(impulse(impact.normal_impulse));
            hits.tangential_impulse
                .push(impulse(impact.tangential_impulse));
            hits.sticks.push(impact.regime == Regime::Stick);
        }
        hits
    }

    fn rebounds(&self, evidence: &Evidence) -> ReboundsRecord {
        let shape_of = |surface: u32| {
            let mut shapes = evidence.shapes.iter();
            shapes.position(|shape| shape.surface == surface && !shape.is_target)
        };
        let impacts = evidence.flights.iter().flat_map(|flight| &flight.impacts);
        let secondary = impacts.filter(|impact| impact.number > 0 && !impact.on_target);
        let mut rebounds = ReboundsRecord::default();
        for impact in secondary.take(MOST_REBOUNDS) {
            let Some(shape) = shape_of(impact.surface) else {
                continue;
            };
            rebounds.points_m.push(self.point(&impact.point));
            rebounds.surface.push(shape as u32);
            rebounds.number.push(impact.number as u32);
            rebounds.normal_impulse.push(impulse(impact.normal_impulse));
        }
        rebounds
    }
}

fn stepped(value: f64, steps: f64) -> f32 {
    ((value * steps).round() / steps + 0.0) as f32
}

/// What is too small for the precision is 0, and not what its digits would overflow to.
fn impulse(newton_seconds: f64) -> f32 {
    if newton_seconds < f64::from(f32::MIN_POSITIVE) {
        return 0.0;
    }
    let magnitude = log10(newton_seconds).floor() as i32;
    stepped(
        newton_seconds,
        whole_power(10.0, IMPULSE_DIGITS - 1 - magnitude),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn impulses_are_finite_however_small() {
        assert_eq!(impulse(4.123_456_7e-5), 4.1235e-5);
        for tiny in [0.0, 5e-324, 1e-310, 1e-300, 1e-40] {
            assert_eq!(impulse(tiny), 0.0, "{tiny}");
        }
    }
}
