//! A moving sphere and one triangle: the points within a radius of a triangle are a convex body,
//! and the sphere touches the triangle when its centre enters that.

use nalgebra::{Point3, Vector3};

use super::convex_edges::ConvexEdges;
use crate::scene::LIFT;
use crate::scene::ray::Ray;
use crate::scene::triangle::box_holds;

/// Cosine of the angle to the normal at the contact that a shot must at least head in with: what
/// is less is rounding.
const HEADING_IN: f64 = 1e-12;

/// A triangle as spheres meet it.
#[derive(Clone, Copy)]
pub(super) struct SweptTriangle {
    pub corners: [Point3<f64>; 3],
    /// Unit normal on the front; 0 for a triangle without a plane.
    pub normal: Vector3<f64>,
    /// Unit vectors in the plane, at right angles to the edges, inwards.
    pub inward: [Vector3<f64>; 3],
    /// Bit i tells to compute with edge i from its end, so that both triangles at an edge compute
    /// the same.
    pub backwards: u8,
    /// Whether rounding leaves it a plane to judge by.
    pub clear: bool,
}

/// A sphere whose centre moves along a ray.
#[derive(Clone, Copy)]
pub(super) struct Sphere<'a> {
    pub ray: &'a Ray,
    pub radius: f64,
    pub slack: f64,
    /// The margin of faces that the sphere comes to at the flattest angles.
    pub widest_margin: f64,
}

/// Where a sphere touches a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    /// How far the centre travels, m.
    pub distance: f64,
    /// Unit vector from the point of contact to the centre.
    pub normal: Vector3<f64>,
    /// Whether it is the face that is touched and not an edge or a corner.
    pub on_face: bool,
    /// Cosine of the angle between that vector and the line along the triangle's normal.
    pub facing: f64,
    /// Whether the centre is in front of the triangle then.
    pub front: bool,
}

/// How a sphere is placed to a triangle at its start.
pub(super) enum Placed {
    Apart,
    /// In contact; with the touch if it heads in.
    Touching(Option<Touch>),
    /// Nearer than that.
    Overlapping,
}

/// What of a triangle is nearest to a point: its face, or the edge or corner with that bit in
/// [`ConvexEdges`].
struct Nearest {
    offset: Vector3<f64>,
    feature: Option<u32>,
}

impl<'a> Sphere<'a> {
    pub fn new(ray: &'a Ray, radius: f64, slack: f64) -> Self {
        let margin = LIFT * slack;
        Self {
            ray,
            radius,
            slack,
            // Past an edge by this, the distance to the triangle is the height over its plane but
            // for half a slack.
            widest_margin: (radius * slack).sqrt().max(margin),
        }
    }

    /// How the sphere is placed to a triangle at the start of its way.
    pub fn placed(&self, plate: &SweptTriangle, folds: ConvexEdges) -> Placed {
        let Nearest { offset, feature } = plate.nearest(&self.ray.origin);
        let distance = offset.norm();
        if distance > self.radius + self.slack {
            return Placed::Apart;
        }
        if distance < self.radius - OVERLAP * self.slack && folds != ConvexEdges::ALL {
            return Placed::Overlapping;
        }
        let front = plate.height(&self.ray.origin) >= 0.0;
        let touchable = feature.is_none_or(|bit| folds.of(front) >> bit & 1 == 1);
        let heads_in = self.ray.direction.dot(&offset) < -HEADING_IN * distance;
        Placed::Touching((touchable && heads_in).then(|| {
            let (normal, facing) = match feature {
                None if front => (plate.normal, 1.0),
                None => (-plate.normal, 1.0),
                Some(_) => {
                    let away = offset / distance;
                    (away, plate.facing(&away))
                }
            };
            Touch {
                distance: 0.0,
                normal,
                on_face: feature.is_none(),
                facing,
                front,
            }
        }))
    }

    /// Whether a touch of the triangle that the sphere has just left is at another place of it: where
    /// it left, it heads in by rounding of the place at most.
    pub fn is_another(&self, touch: &Touch) -> bool {
        let sinking = -self.ray.direction.dot(&touch.normal);
        sinking * self.radius > LIFT * LIFT * self.slack
    }

    /// Where the sphere, which starts apart from it, touches a triangle; it may miss touches beyond
    /// `limit`.
    #[inline(always)]
    pub fn touch(&self, plate: &SweptTriangle, folds: ConvexEdges, limit: f64) -> Option<Touch> {
        let height = plate.height(&self.ray.origin);
        let approach = self.ray.direction.dot(&plate.normal);
        if let Some(touch) = self.touch_face(plate, height, approach) {
            return Some(touch);
        }
        let mut first: Option<Touch> = None;
        let mut consider = |bit: u32, (distance, normal): (f64, Vector3<f64>)| {
            let front = height + approach * distance >= 0.0;
            let nearer = first.is_none_or(|first| distance < first.distance);
            if nearer && folds.of(front) >> bit & 1 == 1 {
                first = Some(Touch {
                    distance,
                    normal,
                    on_face: false,
                    facing: plate.facing(&normal),
                    front,
                });
            }
        };
        let either = folds.front | folds.behind;
        if either == 0 {
            return None;
        }
        let passed = self.passed(plate, height, approach, limit);
        for bit in 0..3 {
            if (either & passed) >> bit & 1 == 1 {
                let (from, to) = plate.edge(bit);
                if let Some(touch) = self.touch_edge(from, to) {
                    consider(bit, touch);
                }
            }
            if (either & passed) >> (bit + 3) & 1 == 1
                && let Some(touch) = self.touch_corner(plate.corners[bit as usize])
            {
                consider(bit + 3, touch);
            }
        }
        first
    }

    /// The edges, and the corners at them, that the centre is not always on the inner side of while
    /// it may touch the triangle: where it touches them, it is not.
    fn passed(&self, plate: &SweptTriangle, height: f64, approach: f64, limit: f64) -> u8 {
        if !plate.clear {
            return ConvexEdges::ALL.front;
        }
        let gap = height.abs() - self.radius - self.slack;
        let sinking = -approach * height.signum();
        let from = if gap > 0.0 { gap / sinking } else { 0.0 };
        let to = limit.min(FARTHEST);
        let mut passed = 0;
        for (edge, bits) in [0b01_1001, 0b11_0010, 0b10_1100].into_iter().enumerate() {
            let inward = &plate.inward[edge];
            let inside = (self.ray.origin - plate.corners[edge]).dot(inward);
            let faster = self.ray.direction.dot(inward);
            let least = (inside + faster * from).min(inside + faster * to);
            let stays_inside = least > self.slack;
            if !stays_inside {
                passed |= bits;
            }
        }
        passed
    }

    /// Past an edge by at most this the face still counts, so that no sphere slips between two
    /// faces: far more than rounding moves the place where the sphere comes to their planes.
    fn margin(&self, sinking: f64) -> f64 {
        let margin = LIFT * self.slack / sinking;
        margin.min(self.widest_margin)
    }

    fn touch_face(&self, plate: &SweptTriangle, height: f64, approach: f64) -> Option<Touch> {
        let front = height >= 0.0;
        let (normal, sinking) = if front {
            (plate.normal, -approach)
        } else {
            (-plate.normal, approach)
        };
        let gap = height.abs() - self.radius;
        if gap < 0.0 || sinking <= HEADING_IN {
            return None;
        }
        let distance = gap / sinking;
        let centre = self.ray.origin + self.ray.direction * distance;
        let margin = self.margin(sinking);
        let inside = |edge: usize| (centre - plate.corners[edge]).dot(&plate.inward[edge]);
        let [a, b, c] = [inside(0), inside(1), inside(2)];
        let least = a.min(b).min(c);
        let touches = least >= -margin
            && (least >= 0.0
                || box_holds(
                    &plate.corners,
                    &(centre - normal * self.radius),
                    self.slack + margin,
                ));
        touches.then_some(Touch {
            distance,
            normal,
            on_face: true,
            facing: 1.0,
            front,
        })
    }

    fn touch_edge(&self, from: Point3<f64>, to: Point3<f64>) -> Option<(f64, Vector3<f64>)> {
        let edge = to - from;
        let length = edge.norm();
        let along = edge / length;
        let direction = &self.ray.direction;
        let start = self.ray.origin - from;
        let both = direction.cross(&along);
        let sine_squared = both.norm_squared();
        // The distance between the two lines is that of their common perpendicular.
        let passing = start.dot(&both);
        let within = self.radius * self.radius * sine_squared - passing * passing;
        let comes_within = within > 0.0;
        if !comes_within {
            return None;
        }
        let across = start - along * start.dot(&along);
        let distance = (-across.dot(direction) - within.sqrt()) / sine_squared;
        let share = (start + direction * distance).dot(&along);
        // Corners are tested too, so that rounding leaves no gap.
        if !(0.0..=length).contains(&share) {
            return None;
        }
        self.settle(distance, |centre| {
            let at = centre - from;
            at - along * at.dot(&along)
        })
    }

    fn touch_corner(&self, corner: Point3<f64>) -> Option<(f64, Vector3<f64>)> {
        let start = self.ray.origin - corner;
        let nearest = -start.dot(&self.ray.direction);
        let passing = start + self.ray.direction * nearest;
        let within = self.radius * self.radius - passing.norm_squared();
        let comes_within = within > 0.0;
        if !comes_within {
            return None;
        }
        self.settle(nearest - within.sqrt(), |centre| centre - corner)
    }

    /// Corrects a distance for rounding, given where the centre is from the nearest point.
    fn settle(
        &self,
        distance: f64,
        offset: impl Fn(Point3<f64>) -> Vector3<f64>,
    ) -> Option<(f64, Vector3<f64>)> {
        let at = |distance: f64| offset(self.ray.origin + self.ray.direction * distance);
        let there = at(distance);
        let gap = there.norm() - self.radius;
        let sinking = -self.ray.direction.dot(&there) / there.norm();
        let heads_in = sinking > HEADING_IN;
        if !heads_in {
            return None;
        }
        let corrected = distance + gap / sinking;
        let normal = at(corrected).normalize();
        // A sphere that only brushes the place is past it then.
        let still_heads_in = self.ray.direction.dot(&normal) < -HEADING_IN;
        let (distance, normal) = if still_heads_in {
            (corrected, normal)
        } else {
            (distance, there.normalize())
        };
        (distance >= 0.0).then_some((distance, normal))
    }
}

/// Stands for no limit, so that 0 times it stays 0.
pub(super) const FARTHEST: f64 = 1e30;

/// Spheres that start this many slacks nearer than their radius overlap a triangle; after a rebound
/// they are nearer by rounding only, or by what faces that count as one differ.
const OVERLAP: f64 = 2.0;

impl SweptTriangle {
    fn height(&self, point: &Point3<f64>) -> f64 {
        (point - self.corners[0]).dot(&self.normal)
    }

    /// Of neighbours that are touched at the edge between them, the one that faces the sphere more is the
    /// one whose normal is nearer, whichever sides are their fronts.
    fn facing(&self, normal: &Vector3<f64>) -> f64 {
        self.normal.dot(normal).abs()
    }

    fn edge(&self, index: u32) -> (Point3<f64>, Point3<f64>) {
        let from = self.corners[index as usize];
        let to = self.corners[(index as usize + 1) % 3];
        if self.backwards >> index & 1 == 1 {
            (to, from)
        } else {
            (from, to)
        }
    }

    /// Where a point is from the nearest point of the triangle.
    fn nearest(&self, point: &Point3<f64>) -> Nearest {
        let inside = |edge: usize| (point - self.corners[edge]).dot(&self.inward[edge]) >= 0.0;
        let has_plane = self.normal != Vector3::zeros();
        if has_plane && inside(0) && inside(1) && inside(2) {
            return Nearest {
                offset: self.normal * self.height(point),
                feature: None,
            };
        }
        let mut nearest = Nearest {
            offset: Vector3::repeat(f64::INFINITY),
            feature: None,
        };
        for bit in 0..3 {
            let (from, to) = self.edge(bit);
            let edge = to - from;
            let share = (point - from).dot(&edge) / edge.norm_squared();
            let (offset, feature) = if share > 0.0 && share < 1.0 {
                (point - from - edge * share, bit)
            } else {
                (point - self.corners[bit as usize], bit + 3)
            };
            if offset.norm_squared() < nearest.offset.norm_squared() {
                nearest = Nearest {
                    offset,
                    feature: Some(feature),
                };
            }
        }
        nearest
    }
}

#[cfg(test)]
mod tests;
