//! Directions of a jet within the tolerance of its angles.

use nalgebra::Vector3;
use wide::f64x4;

use crate::scene::lanes::splat;

/// Unit vectors, four to a lane: most of the work of a distance is to find the one that reaches farthest.
#[derive(Clone, Debug)]
pub struct Directions {
    /// Coordinates of four at a time; the last one fills up what is left.
    lanes: Vec<[f64x4; 3]>,
}

impl Directions {
    /// Of at least one unit vector.
    pub fn new(directions: &[Vector3<f64>]) -> Self {
        let lane = |four: &[Vector3<f64>]| {
            let at = |index: usize| four[index.min(four.len() - 1)];
            [0, 1, 2].map(|axis| f64x4::from([0, 1, 2, 3].map(|index| at(index)[axis])))
        };
        Self {
            lanes: directions.chunks(4).map(lane).collect(),
        }
    }

    /// The unit vector in the middle of them.
    pub(super) fn mean(&self) -> Vector3<f64> {
        let lanes = self.lanes.iter();
        let sum = lanes.map(|lane| Vector3::from(lane.map(|it| it.reduce_add())));
        sum.sum::<Vector3<f64>>().normalize()
    }

    /// The largest `height`, given how far each goes ahead in a direction.
    #[inline(always)]
    pub(super) fn highest(&self, toward: &Vector3<f64>, height: impl Fn(f64x4) -> f64x4) -> f64 {
        let heights = self.ahead(toward).map(|(ahead, _)| height(ahead));
        let most = heights.fold(f64x4::splat(f64::NEG_INFINITY), f64x4::fast_max);
        let each = most.to_array().into_iter();
        each.fold(f64::NEG_INFINITY, f64::max)
    }

    /// The first one of those for which `height` is largest, likewise.
    #[inline(always)]
    pub(super) fn farthest(
        &self,
        toward: &Vector3<f64>,
        height: impl Fn(f64x4) -> f64x4,
    ) -> Vector3<f64> {
        let (mut most, mut lanes) = (f64x4::splat(f64::NEG_INFINITY), [f64x4::ZERO; 3]);
        for (ahead, lane) in self.ahead(toward) {
            let here = height(ahead);
            let is_more = here.simd_gt(most);
            most = is_more.select(here, most);
            for (kept, lane) in lanes.iter_mut().zip(lane) {
                *kept = is_more.select(*lane, *kept);
            }
        }
        let most = most.to_array();
        let index = (1..4).fold(0, |best, it| if most[it] > most[best] { it } else { best });
        Vector3::from(lanes.map(|lane| lane.to_array()[index]))
    }

    /// How far they go ahead in a direction, and their coordinates.
    #[inline(always)]
    fn ahead(&self, toward: &Vector3<f64>) -> impl Iterator<Item = (f64x4, &[f64x4; 3])> {
        let [x, y, z] = splat(*toward);
        let lanes = self.lanes.iter();
        lanes.map(move |lane| (lane[0] * x + lane[1] * y + lane[2] * z, lane))
    }
}
