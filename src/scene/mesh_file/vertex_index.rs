//! Finds the vertex that already stands at a point.

use nalgebra::Point3;

/// Marks a slot as free; never the number of a vertex.
const FREE: u32 = u32::MAX;

/// A hash table of vertex numbers; the points stay in the mesh. It takes at most 16 bytes a vertex,
/// where a map from points to numbers takes over 60.
pub(super) struct VertexIndex {
    /// Power of two, at most half full.
    slots: Vec<u32>,
}

impl VertexIndex {
    pub fn new() -> Self {
        Self {
            slots: vec![FREE; 1024],
        }
    }

    /// Number of the vertex at exactly this point, which is added if there is none.
    /// `None` if numbers run out.
    pub fn find_or_add(
        &mut self,
        vertices: &mut Vec<Point3<f64>>,
        point: Point3<f64>,
    ) -> Option<u32> {
        let slot = self.slot(vertices, &point);
        if self.slots[slot] != FREE {
            return Some(self.slots[slot]);
        }
        let number = u32::try_from(vertices.len())
            .ok()
            .filter(|number| *number < FREE / 2)?;
        self.slots[slot] = number;
        vertices.push(point);
        if 2 * vertices.len() > self.slots.len() {
            self.grow(vertices);
        }
        Some(number)
    }

    /// The slot of this point, or the free one where it belongs.
    fn slot(&self, vertices: &[Point3<f64>], point: &Point3<f64>) -> usize {
        let mask = self.slots.len() - 1;
        let mut slot = hash(point) as usize & mask;
        while self.slots[slot] != FREE && vertices[self.slots[slot] as usize] != *point {
            slot = (slot + 1) & mask;
        }
        slot
    }

    fn grow(&mut self, vertices: &[Point3<f64>]) {
        let slots = 2 * self.slots.len();
        self.slots = Vec::new(); // frees the old table first
        self.slots = vec![FREE; slots];
        for (number, point) in (0..).zip(vertices) {
            let slot = self.slot(vertices, point);
            self.slots[slot] = number;
        }
    }
}

/// Spreads the bits of a point; both zeros count as one.
fn hash(point: &Point3<f64>) -> u64 {
    point.iter().fold(0, |state: u64, value| {
        let mixed = (state ^ (value + 0.0).to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        mixed ^ (mixed >> 32)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_point_has_one_number() {
        let mut index = VertexIndex::new();
        let mut vertices = Vec::new();
        let points: Vec<Point3<f64>> = (0..5000_u32)
            .map(|i| {
                [i % 17, i % 23, i % 29]
                    .map(|it| f64::from(it) - 8.0)
                    .into()
            })
            .collect();
        for _ in 0..2 {
            for (number, point) in (0..).zip(&points) {
                assert_eq!(index.find_or_add(&mut vertices, *point), Some(number));
            }
        }
        assert_eq!(vertices, points);
    }

    #[test]
    fn both_zeros_are_one_point() {
        let mut index = VertexIndex::new();
        let mut vertices = Vec::new();
        for signs in 0..8 {
            let zero = |bit: u32| if signs >> bit & 1 == 1 { -0.0 } else { 0.0 };
            let point = Point3::new(zero(0), zero(1), zero(2));
            assert_eq!(index.find_or_add(&mut vertices, point), Some(0), "{point}");
        }
        assert_eq!(vertices.len(), 1);
    }
}
