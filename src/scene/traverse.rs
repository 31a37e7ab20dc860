//! Where the aim point of a stroke travels, with the directions there.
//!
//! A place on a stroke is a number: -0.5 at its beginning, 0 in its middle, 0.5 at its end, and beyond in the run-out.

mod find;

use nalgebra::{Point3, Rotation3, Unit, Vector3};

use super::patch::Frame;
use crate::elementary::{atan2, tan};
use crate::problem::stroke::{Helix, WHOLE, place_in};

/// The way of the aim point over the target.
#[derive(Clone, Debug)]
pub struct Traverse {
    way: Way,
    /// Of the whole way, m, on the part.
    whole: f64,
    /// Where this part of it begins and ends, as shares of the way from -0.5 to 0.5.
    span: [f64; 2],
}

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
    /// A bound of how far the directions turn on the way to the next one, rad; `None` where they stay.
    turn: Option<f64>,
}

/// Normals that differ by less are the same.
const FLAT: f64 = 1e-9;
impl Traverse {
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

    /// The place so far beyond an end, which is the first or the last place, m.
    pub fn beyond(&self, end: f64, run_out: f64) -> f64 {
        end + end.signum() * self.places_in(run_out)
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
            span: span.map(|place| place_in(self.span, place)),
            ..self.clone()
        }
    }

    /// Whether it begins and ends where the whole way does, and its run-out is that of the whole.
    pub fn reaches_ends(&self) -> [bool; 2] {
        [self.span[0] <= WHOLE[0], self.span[1] >= WHOLE[1]]
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
            Way::Around { helix, .. } => Some(turn(helix, self.angle_at(place))),
        }
    }

    /// The same in the machine, where a part that goes round turns back.
    pub fn frame_in_machine(&self, place: f64) -> Frame {
        match &self.way {
            Way::Knots(_) => self.frame_at(place),
            Way::Around { helix, base, .. } => Frame {
                aim: base.aim + advance(helix, self.angle_at(place)),
                ..*base
            },
        }
    }

    /// Where a point of the target is along the stroke from its beginning, and across it, m: in the plane of the target at
    /// the beginning, or unrolled round the axis with the length along it as the second number.
    pub fn unrolled(&self, point: &Point3<f64>) -> [f64; 2] {
        match &self.way {
            Way::Knots(knots) => {
                let [ahead, beside] = self.directions(knots);
                let from = point - knots[0].frame.aim;
                [from.dot(&ahead), from.dot(&beside)]
            }
            Way::Around { helix, base, .. } => {
                let (zero, here) = (outwards(helix, &base.aim), outwards(helix, point));
                let side = helix.axis.cross(&zero) / zero.norm();
                let angle = atan2(here.dot(&side), here.dot(&zero) / zero.norm());
                let along = (point - self.frame_at(WHOLE[0]).aim).dot(&helix.axis);
                [angle * zero.norm(), along]
            }
        }
    }

    /// The other way round: the point that is laid out there, on the plane or on the cylinder that things are laid out on.
    pub fn rolled(&self, [x, y]: [f64; 2]) -> Point3<f64> {
        match &self.way {
            Way::Knots(knots) => {
                let first = &knots[0].frame;
                let [ahead, beside] = self.directions(knots);
                first.aim + ahead * x + beside * y
            }
            Way::Around { helix, base, .. } => {
                let zero = outwards(helix, &base.aim);
                let start = self.frame_at(WHOLE[0]).aim;
                let height = (start - helix.through).dot(&helix.axis) + y;
                helix.through + helix.axis * height + turn(helix, x / zero.norm()) * zero
            }
        }
    }

    /// Along a line from its beginning to its end, and across it, unit vectors.
    fn directions(&self, knots: &[Knot]) -> [Vector3<f64>; 2] {
        let (first, last) = (&knots[0].frame, &knots[knots.len() - 1].frame);
        let chord = last.aim - first.aim;
        // A stroke that ends where it began has no direction but its first one.
        let ahead = match chord.norm() > FLAT * self.whole {
            true => chord.normalize(),
            false => -self.onwards(false),
        };
        [ahead, first.normal.cross(&ahead).normalize()]
    }

    /// The length once round the axis at the aim point, m; `None` for a line.
    pub fn circumference(&self) -> Option<f64> {
        match &self.way {
            Way::Knots(_) => None,
            Way::Around { helix, base, .. } => {
                Some(std::f64::consts::TAU * outwards(helix, &base.aim).norm())
            }
        }
    }

    /// The angle at a place, rad; 0 on a line.
    pub fn angle_at(&self, place: f64) -> f64 {
        match &self.way {
            Way::Knots(_) => 0.0,
            Way::Around { helix, .. } => {
                let [from, to] = helix.angles;
                from + (to - from) * (place_in(self.span, place) + 0.5)
            }
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
                knot.frame.is_turned_as(&from) && beside <= FLAT * half.norm_squared()
            }),
        };
        is_straight.then_some(half)
    }

    /// The places of the corners of a line, in order; none round an axis.
    pub fn corners(&self) -> Vec<f64> {
        let Way::Knots(knots) = &self.way else {
            return Vec::new();
        };
        let inner = &knots[1..knots.len() - 1];
        let share = |knot: &Knot| knot.travelled / self.whole - 0.5;
        let [from, to] = self.span;
        inner
            .iter()
            .map(|knot| (share(knot) - from) / (to - from) - 0.5)
            .collect()
    }

    /// Half the way between two places with no corner of a line in between, m, where no direction turns on it.
    pub fn straight_half(&self, places: [f64; 2]) -> Option<Vector3<f64>> {
        let Way::Knots(_) = &self.way else {
            return None;
        };
        let [from, to] = places.map(|place| self.frame_at(place));
        let has_corner = || {
            let mut corners = self.corners().into_iter();
            corners.any(|corner| places[0] + FLAT < corner && corner + FLAT < places[1])
        };
        (from.is_turned_as(&to) && !has_corner()).then(|| (to.aim - from.aim) / 2.0)
    }

    /// No point so far from the aim point that moves with it, m, moves by more than this between two places, m.
    pub fn motion(&self, places: [f64; 2], reach: f64) -> f64 {
        match &self.way {
            Way::Knots(knots) => {
                let [from, to] =
                    places.map(|place| self.whole * (place_in(self.span, place) + 0.5));
                let turns = knots.windows(2).map(|pair| {
                    let [begin, end] = [pair[0].travelled, pair[1].travelled];
                    let passed = (to.min(end) - from.max(begin)).max(0.0) / (end - begin);
                    passed * pair[0].turn.unwrap_or(0.0)
                });
                (to - from).abs() + reach * turns.sum::<f64>()
            }
            Way::Around { helix, base, .. } => {
                let [from, to] = places.map(|place| self.angle_at(place));
                let radius = outwards(helix, &base.aim).norm() + reach;
                (to - from).abs() * (radius + helix.pitch.abs() / std::f64::consts::TAU)
            }
        }
    }

    /// The aim point and the directions at a place.
    #[inline(always)]
    pub fn frame_at(&self, place: f64) -> Frame {
        match &self.way {
            Way::Knots(knots) => between(knots, self.whole * (place_in(self.span, place) + 0.5)),
            Way::Around { helix, base, .. } => turned(helix, base, self.angle_at(place)),
        }
    }
}

/// From the axis to a point, m.
fn outwards(helix: &Helix, point: &Point3<f64>) -> Vector3<f64> {
    let from = point - helix.through;
    from - helix.axis * from.dot(&helix.axis)
}

fn advance(helix: &Helix, angle: f64) -> Vector3<f64> {
    let middle = 0.5 * (helix.angles[0] + helix.angles[1]);
    helix.axis * (helix.pitch * (angle - middle) / std::f64::consts::TAU)
}

fn turn(helix: &Helix, angle: f64) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&Unit::new_unchecked(helix.axis), angle)
}

/// A frame, turned about the axis by an angle and moved along it.
fn turned(helix: &Helix, base: &Frame, angle: f64) -> Frame {
    let turn = turn(helix, angle);
    Frame {
        aim: helix.through + turn * (base.aim - helix.through) + advance(helix, angle),
        normal: turn * base.normal,
        along: turn * base.along,
        across: turn * base.across,
    }
}

/// A bound of how far directions turn from one frame to another, rad, as if all the way as fast as at most; `None` where
/// they are the same. Mixed and made unit vectors again, vectors turn fastest in the middle: by 2 tan of half their angle.
fn turn_between(a: &Frame, b: &Frame) -> Option<f64> {
    let fastest = |a: &Vector3<f64>, b: &Vector3<f64>| {
        let angle = a.angle(b).min(SHARPEST);
        f64::max(LOOSE * angle, 2.0 * tan(angle / 2.0))
    };
    (!a.is_turned_as(b)).then(|| fastest(&a.normal, &b.normal) + fastest(&a.along, &b.along))
}

/// Room for what making both directions of a frame square to each other adds.
const LOOSE: f64 = 1.3;
/// No line turns by more at a corner, rad: 170 deg.
const SHARPEST: f64 = 2.967;

/// The frame after some way; straight on beyond the ends.
#[inline(always)]
fn between(knots: &[Knot], travelled: f64) -> Frame {
    let last = knots.len() - 1;
    let next = knots.partition_point(|knot| knot.travelled <= travelled);
    let next = next.clamp(1, last);
    let (a, b) = (&knots[next - 1], &knots[next]);
    let share = (travelled - a.travelled) / (b.travelled - a.travelled);
    let aim = a.frame.aim + (b.frame.aim - a.frame.aim) * share;
    if a.turn.is_some() {
        blend(&a.frame, &b.frame, share, aim)
    } else {
        Frame { aim, ..a.frame }
    }
}

/// The frame at an aim point, some share of the way from one frame to another.
fn blend(a: &Frame, b: &Frame, share: f64, aim: Point3<f64>) -> Frame {
    let turned_by = share.clamp(0.0, 1.0);
    let mix = |a: Vector3<f64>, b: Vector3<f64>| a + (b - a) * turned_by;
    let normal = mix(a.normal, b.normal).normalize();
    let along = mix(a.along, b.along);
    let along = (along - normal * along.dot(&normal)).normalize();
    Frame {
        aim,
        normal,
        along,
        across: along.cross(&normal),
    }
}
