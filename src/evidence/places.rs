//! Where to put test strips: the places at which the jet does least, or most.

mod edge;
mod near;
mod stroke;

use nalgebra::{Point3, Vector3};

use super::Flight;
use crate::digits::{fixed, significant};
use crate::jet::Pose;
use crate::scenario::Scenario;
use crate::trace::PathImpact;
use near::Neighbourhoods;
pub(crate) use stroke::least_dented;

/// A place that is worth a test strip.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// A short fixed name.
    pub name: &'static str,
    /// Index of its surface.
    pub surface: u32,
    /// m.
    pub point: Point3<f64>,
    /// Normal of the surface, towards free space.
    pub normal: Vector3<f64>,
    /// The number behind it: N s, m, deg for an angle, or a share.
    pub value: f64,
    /// What it means, for people.
    pub text: String,
}

/// A first hit on the target.
struct TargetHit<'a> {
    impact: &'a PathImpact,
    /// rad.
    angle: f64,
}

/// The places of the shots of a jet; none on the target where nothing hits it.
///
/// What the target receives is compared by its mean over a small disc round each hit, as a test
/// strip would: the place of one odd shot is none to look at again. Rebounds are rare, so that each
/// of them counts by itself.
pub(super) fn find(scenario: &Scenario, pose: &Pose, flights: &[Flight]) -> Vec<Place> {
    let hits: Vec<TargetHit> = flights
        .iter()
        .filter_map(|flight| {
            Some(TargetHit {
                impact: flight.hit_on_target()?,
                angle: flight.angle_of_first_hit()?,
            })
        })
        .collect();
    let points: Vec<Point3<f64>> = hits.iter().map(|hit| hit.impact.point).collect();
    let neighbourhoods = Neighbourhoods::new(&points);
    let mut places = on_target(&hits, &neighbourhoods);
    // Where the jet ends tells nothing of a nozzle that goes on.
    match scenario.traverse {
        Some(_) => places.extend(stroke::along(scenario)),
        None => places.extend(edge::find(scenario, pose, &hits, neighbourhoods.radius)),
    }
    places.extend(rebounds(scenario, flights));
    places
}

/// Something of which the mean over a small disc is looked at.
struct Quantity {
    name: &'static str,
    of: fn(&TargetHit) -> f64,
    /// 1 where the largest mean is wanted, -1 where it is the least one.
    sign: f64,
    words: fn(f64) -> String,
}

const QUANTITIES: [Quantity; 3] = [
    Quantity {
        name: "lowest_normal_impulse",
        of: |hit| hit.impact.normal_impulse,
        sign: -1.0,
        words: |value| format!("lowest N* on target, {}", impulse(value)),
    },
    Quantity {
        name: "most_grazing",
        of: |hit| hit.angle.to_degrees(),
        sign: -1.0,
        words: |value| format!("most grazing hits, {} deg to the surface", fixed(value, 1)),
    },
    Quantity {
        name: "most_tangential_impulse",
        of: |hit| hit.impact.tangential_impulse,
        sign: 1.0,
        words: |value| format!("largest f* on target, {}", impulse(value)),
    },
];

fn on_target(hits: &[TargetHit], neighbourhoods: &Neighbourhoods) -> Vec<Place> {
    let mut worst: [Option<(f64, usize, usize)>; QUANTITIES.len()] = [None; QUANTITIES.len()];
    for index in 0..hits.len() {
        let near = neighbourhoods.of(index);
        if near.len() < neighbourhoods.least {
            continue;
        }
        for (worst, quantity) in worst.iter_mut().zip(&QUANTITIES) {
            let sum: f64 = near.iter().map(|&i| (quantity.of)(&hits[i])).sum();
            let mean = sum / near.len() as f64;
            if worst.is_none_or(|(known, ..)| (mean - known) * quantity.sign > 0.0) {
                *worst = Some((mean, index, near.len()));
            }
        }
    }
    let place = |(quantity, worst): (&Quantity, Option<(f64, usize, usize)>)| {
        let (value, index, count) = worst?;
        let impact = hits[index].impact;
        let words = (quantity.words)(value);
        let text = match count {
            1 => format!("{words}: the only hit here"),
            _ => {
                let radius = length(neighbourhoods.radius);
                format!("{words}: mean of the {count} hits within {radius}")
            }
        };
        Some(Place {
            name: quantity.name,
            surface: impact.surface,
            point: impact.point,
            normal: impact.normal,
            value,
            text,
        })
    };
    QUANTITIES.iter().zip(worst).filter_map(place).collect()
}

/// The strongest impact on each secondary surface that is hit, in the order of the scene.
fn rebounds(scenario: &Scenario, flights: &[Flight]) -> Vec<Place> {
    let mut strongest: Vec<Option<(&PathImpact, usize)>> = vec![None; scenario.surfaces.len()];
    let impacts = flights.iter().flat_map(|flight| &flight.impacts);
    for impact in impacts.filter(|impact| impact.number > 0 && !impact.on_target) {
        let (known, count) = strongest[impact.surface as usize].get_or_insert((impact, 0));
        *count += 1;
        if impact.normal_impulse > known.normal_impulse {
            *known = impact;
        }
    }
    let place = |(impact, count): (&PathImpact, usize)| Place {
        name: "strongest_rebound",
        surface: impact.surface,
        point: impact.point,
        normal: impact.normal,
        value: impact.normal_impulse,
        text: in_words(scenario, impact, count),
    };
    strongest.into_iter().flatten().map(place).collect()
}

fn in_words(scenario: &Scenario, strongest: &PathImpact, count: usize) -> String {
    let surface = strongest.surface;
    let name = &scenario.scene.surfaces()[surface as usize];
    let where_on_it = if surface == scenario.target.surface {
        " off target"
    } else {
        ""
    };
    let which = match count {
        1 => "only impact".to_owned(),
        _ => format!("strongest of {count} impacts"),
    };
    let by = match strongest.number {
        1 => "by a direct hit".to_owned(),
        number => format!("after bounce {}", number - 1),
    };
    let allow = scenario.surfaces[surface as usize].allow;
    let may = allow.map_or_else(String::new, |allow| {
        format!("; it may take {}", impulse(allow))
    });
    format!(
        "{which} on {name}{where_on_it}, N* {} {by}{may}",
        impulse(strongest.normal_impulse)
    )
}

fn impulse(newton_seconds: f64) -> String {
    format!("{} uN.s", significant(newton_seconds * 1e6, 3))
}

fn length(metres: f64) -> String {
    format!("{} mm", significant(metres * 1e3, 3))
}
