//! Where the nozzle stands, for the parts that move with it.
//!
//! Such parts are kept in the frame of the nozzle: rays are taken there, and normals back.

use nalgebra::{Point3, Vector3};

use super::lanes::{LANES, Lane, components, put};
use super::ray::Ray;
use crate::triple::{Triple, along, dot, scaled};

/// The frame of the nozzle in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NozzleFrame {
    axes: [Triple; 3],
    origin: Triple,
}

/// Stands side by side.
pub struct NozzleFrames {
    axes: [[Lane; 3]; 3],
    origin: [Lane; 3],
}

impl NozzleFrame {
    /// A frame by its three unit vectors and its origin, m.
    pub fn new(axes: [Vector3<f64>; 3], origin: Point3<f64>) -> Self {
        Self {
            axes: axes.map(Into::into),
            origin: origin.into(),
        }
    }

    /// A point of this frame, as it is in the scene, m.
    pub fn point_back(&self, point: &Point3<f64>) -> Point3<f64> {
        let turned = Point3::from(self.vector_back((*point).into()));
        turned + Vector3::from(self.origin)
    }

    /// A ray of the scene, as it is in this frame.
    pub fn ray_there(&self, ray: &Ray) -> Ray {
        Ray {
            origin: self.point_there(ray.origin.into()).into(),
            direction: self.vector_there(ray.direction.into()).into(),
        }
    }

    #[inline(always)]
    pub(super) fn point_there(&self, point: Triple) -> Triple {
        self.vector_there(along(point, self.origin, -1.0))
    }

    #[inline(always)]
    pub(super) fn vector_there(&self, vector: Triple) -> Triple {
        let [x, y, z] = self.axes;
        [dot(x, vector), dot(y, vector), dot(z, vector)]
    }

    /// A vector of this frame, as it is in the scene.
    #[inline(always)]
    pub(super) fn vector_back(&self, vector: Triple) -> Triple {
        let [x, y, z] = self.axes;
        along(along(scaled(x, vector[0]), y, vector[1]), z, vector[2])
    }
}

impl NozzleFrames {
    /// All where the scene's frame is.
    pub fn none() -> Self {
        let (zero, one) = ([0.0; LANES], [1.0; LANES]);
        Self {
            axes: [[one, zero, zero], [zero, one, zero], [zero, zero, one]],
            origin: [zero; 3],
        }
    }

    /// Sets one of them.
    pub fn set(&mut self, index: usize, nozzle_frame: &NozzleFrame) {
        for (lanes, axis) in self.axes.iter_mut().zip(nozzle_frame.axes) {
            put(lanes, index, axis);
        }
        put(&mut self.origin, index, nozzle_frame.origin);
    }

    /// Every number of theirs.
    pub fn lanes_mut(&mut self) -> impl Iterator<Item = &mut Lane> {
        self.axes.iter_mut().flatten().chain(&mut self.origin)
    }

    #[inline(always)]
    pub(super) fn at(&self, index: usize) -> NozzleFrame {
        let [x, y, z] = &self.axes;
        NozzleFrame {
            axes: [
                components(x, index),
                components(y, index),
                components(z, index),
            ],
            origin: components(&self.origin, index),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_taken_there_and_back_is_where_it_was() {
        // Its x axis is the scene's y axis, its y axis z, its z axis x.
        let axes = [Vector3::y(), Vector3::z(), Vector3::x()];
        let nozzle_frame = NozzleFrame::new(axes, Point3::new(10.0, 20.0, 30.0));
        assert_eq!(
            nozzle_frame.point_there([11.0, 22.0, 33.0]),
            [2.0, 3.0, 1.0]
        );
        assert_eq!(nozzle_frame.vector_there([1.0, 2.0, 3.0]), [2.0, 3.0, 1.0]);
        assert_eq!(nozzle_frame.vector_back([2.0, 3.0, 1.0]), [1.0, 2.0, 3.0]);
        let back = nozzle_frame.point_back(&Point3::new(2.0, 3.0, 1.0));
        assert_eq!(back, Point3::new(11.0, 22.0, 33.0));
        let ray = nozzle_frame.ray_there(&Ray::of([10.0, 20.0, 35.0], [1.0, 0.0, 0.0]));
        assert_eq!(ray, Ray::of([0.0, 5.0, 0.0], [0.0, 0.0, 1.0]));
    }
}
