//! Where the aim point of a stroke travels, with the directions there.
//!
//! A place on a stroke is a number: -0.5 at its beginning, 0 in its middle, 0.5 at its end, and beyond in the run-out.

use nalgebra::{Point3, Rotation3, Unit, Vector3};

use super::Scene;
use super::patch::{Frame, Patch};
use crate::problem::Problem;
use crate::problem::fault::Fault;
use crate::problem::fault_code::FaultCode;
use crate::problem::part::{Part, Shape, Target};
use crate::problem::stroke::{Helix, Line, Stroke};

/// The way of the aim point over the target.
#[derive(Clone, Debug)]
pub struct Traverse {
    way: Way,
    /// Of the whole way, m, on the part.
    whole: f64,
    /// Where this part of it begins and ends, as shares of the way from -0.5 to 0.5.
    span: [f64; 2],
}

/// The span of a whole way.
const WHOLE: [f64; 2] = [-0.5, 0.5];

#[derive(Clone, Debug)]
enum Way {
    /// Straight from knot to knot.
    Knots(Vec<Knot>),
    /// Round an axis.
    Around {
        helix: Helix,
        base: Frame,
        /// Whether nothing changes while the part turns.
        is_round: bool,
    },
}

/// A place that the aim point passes.
#[derive(Clone, Copy, Debug)]
struct Knot {
    /// How far it has come, m.
    travelled: f64,
    frame: Frame,
}

/// Pieces of a leg over a curved target.
const PIECES: usize = 32;
/// Normals that differ by less are the same.
const FLAT: f64 = 1e-9;
/// Places of a helix at which it is looked whether it is on the target.
const LOOKS: usize = 64;

impl Traverse {
    /// Finds the way of a stroke over a target.
    ///
    /// # Errors
    /// A point that is not on the target, or `target.along` perpendicular to it there.
    pub fn find(
        scene: &Scene,
        patch: &Patch,
        problem: &Problem,
        stroke: &Stroke,
    ) -> Result<Self, Vec<Fault>> {
        let surface = Surface {
            scene,
            patch,
            target: &problem.target,
        };
        match &stroke.line {
            Line::Straight(ends) => surface.straight(ends, |index| {
                format!("stroke.along.{}", ["from", "to"][index])
            }),
            Line::Points(points) => {
                surface.straight(points, |index| format!("stroke.points[{index}]"))
            }
            Line::Around(helix) => {
                let mut standing = problem.parts.iter().filter(|part| !part.on_nozzle);
                let is_round = standing.all(|part| is_round(part, helix));
                surface.around(helix, is_round)
            }
        }
    }

    /// By how much places change over a run-out of this length, m: along the line, or along the axis that it goes
    /// round.
    pub fn places_in(&self, run_out: f64) -> f64 {
        match &self.way {
            Way::Knots(_) => run_out / self.length(),
            Way::Around { helix, .. } if helix.pitch != 0.0 => {
                run_out / (helix.pitch.abs() * self.turns())
            }
            Way::Around { .. } => 0.0,
        }
    }

    /// The direction in which a run-out goes on at an end, unit vector: along the line, or along the axis.
    pub fn onwards(&self, at_end: bool) -> Vector3<f64> {
        match &self.way {
            Way::Knots(knots) => {
                let last = knots.len() - 1;
                let [from, to] = if at_end { [last - 1, last] } else { [1, 0] };
                (knots[to].frame.aim - knots[from].frame.aim).normalize()
            }
            Way::Around { helix, .. } => {
                let ahead = if at_end { 1.0 } else { -1.0 };
                helix.axis * ahead * helix.pitch.signum()
            }
        }
    }

    /// A part of it, between two places.
    #[must_use]
    pub fn part(&self, span: [f64; 2]) -> Self {
        Self {
            span: span.map(|place| self.on_way(place)),
            ..self.clone()
        }
    }

    /// A place on the whole way.
    fn on_way(&self, place: f64) -> f64 {
        let [from, to] = self.span;
        from + (to - from) * (place + 0.5)
    }

    /// Length between the ends on the part, m.
    pub fn length(&self) -> f64 {
        self.whole * (self.span[1] - self.span[0])
    }

    /// Turns of the part from one end to the other; 0 for a line.
    pub fn turns(&self) -> f64 {
        match &self.way {
            Way::Knots(_) => 0.0,
            Way::Around { helix, .. } => {
                let share = self.span[1] - self.span[0];
                share * (helix.angles[1] - helix.angles[0]) / std::f64::consts::TAU
            }
        }
    }

    /// How far it is from the beginning to a place, m.
    pub fn travelled(&self, place: f64) -> f64 {
        (place + 0.5) * self.length()
    }

    /// By how much the part, or the nozzle in its coordinates, is turned at a place.
    pub fn turn_at(&self, place: f64) -> Option<Rotation3<f64>> {
        match &self.way {
            Way::Knots(_) => None,
            Way::Around { helix, .. } => {
                let axis = Unit::new_unchecked(helix.axis);
                Some(Rotation3::from_axis_angle(
                    &axis,
                    angle_at(helix, self.on_way(place)),
                ))
            }
        }
    }

    /// The same in the machine, where a part that goes round turns back.
    pub fn frame_in_machine(&self, place: f64) -> Frame {
        match &self.way {
            Way::Knots(_) => self.frame_at(place),
            Way::Around { helix, base, .. } => {
                moved(helix, base, angle_at(helix, self.on_way(place)))
            }
        }
    }

    /// The angle at a place, rad; 0 on a line.
    pub fn angle_at(&self, place: f64) -> f64 {
        match &self.way {
            Way::Knots(_) => 0.0,
            Way::Around { helix, .. } => angle_at(helix, self.on_way(place)),
        }
    }

    /// Half the way of the aim point, m, where it moves straight on and no direction turns; with a part that is round
    /// about its axis, in the machine.
    pub fn sweep(&self) -> Option<Vector3<f64>> {
        let [from, to] = [-0.5, 0.5].map(|place| self.frame_in_machine(place));
        let half = (to.aim - from.aim) / 2.0;
        let is_straight = match &self.way {
            Way::Around { is_round, .. } => *is_round,
            Way::Knots(knots) => knots.iter().all(|knot| {
                let beside = (knot.frame.aim - from.aim).cross(&half).norm();
                let is_alike = knot.frame.normal == from.normal && knot.frame.along == from.along;
                is_alike && beside <= FLAT * half.norm_squared()
            }),
        };
        is_straight.then_some(half)
    }

    /// The aim point and the directions at a place.
    pub fn frame_at(&self, place: f64) -> Frame {
        match &self.way {
            Way::Knots(knots) => between(knots, self.whole * (self.on_way(place) + 0.5)),
            Way::Around { helix, base, .. } => {
                turned(helix, base, angle_at(helix, self.on_way(place)))
            }
        }
    }
}

/// A frame, moved along the axis only.
fn moved(helix: &Helix, base: &Frame, angle: f64) -> Frame {
    Frame {
        aim: base.aim + advance(helix, angle),
        ..*base
    }
}

fn advance(helix: &Helix, angle: f64) -> Vector3<f64> {
    let middle = 0.5 * (helix.angles[0] + helix.angles[1]);
    helix.axis * (helix.pitch * (angle - middle) / std::f64::consts::TAU)
}

/// Whether a part is round about an axis: a bore or a pin on it.
fn is_round(part: &Part, helix: &Helix) -> bool {
    let axis = part.place.rotation * Vector3::z();
    let beside = (part.place.shift - helix.through.coords)
        .cross(&axis)
        .norm();
    let is_on_axis = axis.cross(&helix.axis).norm() < FLAT && beside < FLAT;
    is_on_axis && matches!(part.shape, Shape::Bore { .. })
}

fn angle_at(helix: &Helix, place: f64) -> f64 {
    let [from, to] = helix.angles;
    from + (to - from) * (place + 0.5)
}

/// A frame, turned about the axis by an angle and moved along it.
fn turned(helix: &Helix, base: &Frame, angle: f64) -> Frame {
    let turn = Rotation3::from_axis_angle(&Unit::new_unchecked(helix.axis), angle);
    Frame {
        aim: helix.through + turn * (base.aim - helix.through) + advance(helix, angle),
        normal: turn * base.normal,
        along: turn * base.along,
        across: turn * base.across,
    }
}

/// The frame after some way; straight on beyond the ends.
fn between(knots: &[Knot], travelled: f64) -> Frame {
    let last = knots.len() - 1;
    let next = knots.partition_point(|knot| knot.travelled <= travelled);
    let next = next.clamp(1, last);
    let (a, b) = (&knots[next - 1], &knots[next]);
    let share = (travelled - a.travelled) / (b.travelled - a.travelled);
    let aim = a.frame.aim + (b.frame.aim - a.frame.aim) * share;
    let turned_by = share.clamp(0.0, 1.0);
    if a.frame.normal == b.frame.normal && a.frame.along == b.frame.along {
        return Frame { aim, ..a.frame };
    }
    let mix = |a: Vector3<f64>, b: Vector3<f64>| a + (b - a) * turned_by;
    let normal = mix(a.frame.normal, b.frame.normal).normalize();
    let along = mix(a.frame.along, b.frame.along);
    let along = (along - normal * along.dot(&normal)).normalize();
    Frame {
        aim,
        normal,
        along,
        across: along.cross(&normal),
    }
}

/// The target as a stroke meets it.
struct Surface<'a> {
    scene: &'a Scene,
    patch: &'a Patch,
    target: &'a Target,
}

impl Surface<'_> {
    /// From point to point; `key_of` is where each stands in the file.
    fn straight(
        &self,
        points: &[Point3<f64>],
        key_of: impl Fn(usize) -> String,
    ) -> Result<Traverse, Vec<Fault>> {
        let mut faults = Vec::new();
        let found: Vec<Option<Frame>> = points
            .iter()
            .enumerate()
            .map(|(index, point)| {
                let frame = self.on_target(point, &key_of(index));
                frame.map_err(|fault| faults.push(fault)).ok()
            })
            .collect();
        let frames: Option<Vec<Frame>> = found.into_iter().collect();
        let Some(frames) = frames else {
            return Err(faults);
        };
        let mut all = vec![frames[0]];
        for pair in frames.windows(2) {
            let middle = nalgebra::center(&pair[0].aim, &pair[1].aim);
            let is_flat = (pair[0].normal - pair[1].normal).norm() < FLAT
                && self
                    .beside(&middle)
                    .is_some_and(|it| (it.aim - middle).norm() < self.near_enough());
            if !is_flat {
                let inner = (1..PIECES).map(|piece| {
                    let share = piece as f64 / PIECES as f64;
                    pair[0].aim + (pair[1].aim - pair[0].aim) * share
                });
                all.extend(inner.filter_map(|point| self.beside(&point)));
            }
            all.push(pair[1]);
        }
        let mut travelled = 0.0;
        let mut before = all[0].aim;
        let knots = all.into_iter().map(|frame| {
            travelled += (frame.aim - before).norm();
            before = frame.aim;
            Knot { travelled, frame }
        });
        let mut knots: Vec<Knot> = knots.collect();
        // Two places on one facet edge may be the same.
        knots.dedup_by(|next, knot| next.travelled <= knot.travelled);
        Ok(Traverse {
            whole: knots.last().map_or(0.0, |knot| knot.travelled),
            span: WHOLE,
            way: Way::Knots(knots),
        })
    }

    fn around(&self, helix: &Helix, is_round: bool) -> Result<Traverse, Vec<Fault>> {
        let base = self.patch.frame;
        let traverse = |length| Traverse {
            way: Way::Around {
                helix: *helix,
                base,
                is_round,
            },
            whole: length,
            span: WHOLE,
        };
        let from_axis = base.aim - helix.through;
        let radius = (from_axis - helix.axis * from_axis.dot(&helix.axis)).norm();
        let turns = (helix.angles[1] - helix.angles[0]) / std::f64::consts::TAU;
        let per_turn = crate::elementary::hypot(std::f64::consts::TAU * radius, helix.pitch);
        let found = traverse(per_turn * turns);
        for look in 0..=LOOKS {
            let place = look as f64 / LOOKS as f64 - 0.5;
            let aim = found.frame_at(place).aim;
            self.on_target(&aim, "stroke.around").map_err(|fault| {
                vec![fault.expecting(
                    "a helix on the target: its radius is that of `target.aim`, which is its middle",
                )]
            })?;
        }
        Ok(found)
    }

    /// What a mesh's facets may lie inside of the true surface that a drawing's numbers mean, m.
    fn near_enough(&self) -> f64 {
        1e-5_f64.max(1e-3 * self.patch.area.sqrt())
    }

    /// The frame at a point of the target.
    #[allow(clippy::result_large_err, reason = "faults are rare")]
    fn on_target(&self, point: &Point3<f64>, key: &str) -> Result<Frame, Fault> {
        let unit = self.target.lengths_in;
        let [x, y, z] = [point.x, point.y, point.z].map(|it| unit.text(it));
        let place = format!("[{x}, {y}, {z}] {}", unit.name());
        let off = |by: Option<f64>| {
            let by = by.map_or(String::new(), |by| {
                format!(": it is {} {} away", unit.text(by), unit.name())
            });
            let message = format!("the stroke leaves the target at {place}{by}");
            let fault = Fault::at_key(FaultCode::StrokeOffTarget, key, message);
            fault.expecting(format!(
                "points on `{}`, inside `target.within` if that is given",
                self.target.surface
            ))
        };
        let Some((nearest, normal)) = self.patch.nearest(self.scene, point) else {
            return Err(off(None));
        };
        let distance = (nearest - point).norm();
        if distance > self.near_enough() {
            return Err(off(Some(distance)));
        }
        if !self.patch.covers(point) {
            return Err(off(None));
        }
        Frame::new(*point, normal, self.target.along).ok_or_else(|| {
            let message = format!("is perpendicular to the target at {place}");
            let fault = Fault::at_key(FaultCode::AlongPerpendicular, "target.along", message);
            fault.expecting(
                "a direction that can be laid into the target's plane all along the stroke",
            )
        })
    }

    /// The frame at the point of the target that is nearest to one beside it.
    fn beside(&self, point: &Point3<f64>) -> Option<Frame> {
        let (nearest, normal) = self.patch.nearest(self.scene, point)?;
        Frame::new(nearest, normal, self.target.along)
    }
}
