//! Finds the way of a stroke over its target.

use nalgebra::{Point3, Vector3};

use super::{FLAT, Knot, Traverse, Way, outwards, turn_between};
use crate::elementary::hypot;
use crate::problem::Problem;
use crate::problem::fault::Fault;
use crate::problem::fault_code::FaultCode;
use crate::problem::part::{Part, Shape, Target};
use crate::problem::stroke::{Helix, Line, Stroke, WHOLE};
use crate::scene::Scene;
use crate::scene::patch::{Frame, Patch, near_enough, stroke_fault};

/// Pieces of a leg over a curved target.
const PIECES: usize = 32;
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
        let (mut frames, mut faults) = (Vec::new(), Vec::new());
        for (index, point) in points.iter().enumerate() {
            match self.on_target(point, &key_of(index)) {
                Ok(frame) => frames.push(frame),
                Err(fault) => faults.push(*fault),
            }
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let mut all = vec![frames[0]];
        for pair in frames.windows(2) {
            let middle = nalgebra::center(&pair[0].aim, &pair[1].aim);
            let is_flat = (pair[0].normal - pair[1].normal).norm() < FLAT
                && self
                    .beside(&middle)
                    .is_some_and(|it| (it.aim - middle).norm() < near_enough(self.patch.area));
            if !is_flat {
                let inner = (1..PIECES).map(|piece| {
                    let share = piece as f64 / PIECES as f64;
                    pair[0].aim + (pair[1].aim - pair[0].aim) * share
                });
                all.extend(inner.filter_map(|point| self.beside(&point)));
            }
            all.push(pair[1]);
        }
        // Places on one plane, or along one cylinder, differ by rounding in their directions: a nozzle that stays as it
        // is turned sweeps what is convex.
        for next in 1..all.len() {
            if all[next].is_nearly_turned_as(&all[next - 1], FLAT) {
                all[next] = Frame {
                    aim: all[next].aim,
                    ..all[next - 1]
                };
            }
        }
        let mut travelled = 0.0;
        let mut before = all[0].aim;
        let knots = all.into_iter().map(|frame| {
            travelled += (frame.aim - before).norm();
            before = frame.aim;
            Knot {
                travelled,
                frame,
                turn: None,
            }
        });
        let mut knots: Vec<Knot> = knots.collect();
        // Two places on one facet edge may be the same.
        knots.dedup_by(|next, knot| next.travelled <= knot.travelled);
        for next in 1..knots.len() {
            knots[next - 1].turn = turn_between(&knots[next - 1].frame, &knots[next].frame);
        }
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
        let radius = outwards(helix, &base.aim).norm();
        let turns = (helix.angles[1] - helix.angles[0]) / std::f64::consts::TAU;
        let per_turn = hypot(std::f64::consts::TAU * radius, helix.pitch);
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

    /// The frame at a point of the target.
    fn on_target(&self, point: &Point3<f64>, key: &str) -> Result<Frame, Box<Fault>> {
        let off = |by| Box::new(stroke_fault(self.target, key, point, by));
        let Some((nearest, normal)) = self.patch.nearest(self.scene, point) else {
            return Err(off(None));
        };
        let distance = (nearest - point).norm();
        if distance > near_enough(self.patch.area) {
            return Err(off(Some(distance)));
        }
        if !self.patch.covers(point) {
            return Err(off(None));
        }
        Frame::new(*point, normal, self.target.along).ok_or_else(|| {
            let place = self.target.lengths_in.point(point);
            let message = format!("is perpendicular to the target at {place}");
            let fault = Fault::at_key(FaultCode::AlongPerpendicular, "target.along", message);
            Box::new(fault.expecting(
                "a direction that can be laid into the target's plane all along the stroke",
            ))
        })
    }

    /// The frame at the point of the target that is nearest to one beside it.
    fn beside(&self, point: &Point3<f64>) -> Option<Frame> {
        let (nearest, normal) = self.patch.nearest(self.scene, point)?;
        Frame::new(nearest, normal, self.target.along)
    }
}
