//! Splitting sets of triangles where the surface area heuristic wants it, the largest first, until
//! there are eight.

use nalgebra::Vector3;

use super::WIDTH;
use super::build::LEAF_SIZE;
use crate::scene::lanes::{larger, smaller};

/// Bins that the triangles of a set are sorted into along each axis before it is split.
const BINS: usize = 32;
/// Below this depth sets are halved, so that no mesh makes the tree too deep for a walk.
pub(super) const HALVING_DEPTH: usize = 16;

/// A triangle's box in the coordinates of the tree.
#[derive(Clone, Copy)]
pub(super) struct Item {
    pub bounds: Bounds,
    pub triangle: u32,
}

impl Item {
    fn centre(&self, axis: usize) -> f32 {
        self.bounds.low[axis] + self.bounds.high[axis]
    }
}

#[derive(Clone, Copy)]
pub(super) struct Bounds {
    pub low: [f32; 3],
    pub high: [f32; 3],
}

impl Bounds {
    const EMPTY: Self = Self {
        low: [f32::INFINITY; 3],
        high: [f32::NEG_INFINITY; 3],
    };

    #[inline]
    fn add(&mut self, other: &Self) {
        for axis in 0..3 {
            self.low[axis] = smaller(other.low[axis], self.low[axis]);
            self.high[axis] = larger(other.high[axis], self.high[axis]);
        }
    }

    fn around(items: &[Item]) -> Self {
        let mut bounds = Self::EMPTY;
        items.iter().for_each(|item| bounds.add(&item.bounds));
        bounds
    }

    /// From the lower corner to the upper one.
    pub fn diagonal(&self) -> Vector3<f64> {
        let [low, high] = [self.low, self.high].map(|corner| Vector3::from(corner.map(f64::from)));
        high - low
    }

    fn area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|axis| self.high[axis] - self.low[axis]);
        x * y + y * z + z * x
    }
}

/// Triangles that will be a child of a node.
pub(super) struct Set<'a> {
    pub items: &'a mut [Item],
    pub bounds: Bounds,
}

/// Splits items into at most eight sets.
pub(super) fn eight_sets(items: &mut [Item], depth: usize) -> Vec<Set<'_>> {
    let halving = depth >= HALVING_DEPTH;
    let bounds = Bounds::around(items);
    let mut sets = vec![Set { items, bounds }];
    while sets.len() < WIDTH {
        let size = |set: &Set| {
            if halving {
                set.items.len() as f32
            } else {
                // By area alone, small parts with many triangles would end up too deep.
                set.bounds.area() * (set.items.len() as f32).sqrt().sqrt()
            }
        };
        let divisible = |(_, set): &(usize, &Set)| set.items.len() > LEAF_SIZE;
        let sizes = sets.iter().enumerate().filter(divisible);
        let Some((largest, _)) = sizes.max_by(|a, b| size(a.1).total_cmp(&size(b.1))) else {
            break;
        };
        let set = sets.swap_remove(largest);
        let middle = if halving {
            set.items.len() / 2
        } else {
            split(set.items)
        };
        let (left, right) = set.items.split_at_mut(middle);
        for items in [left, right] {
            let bounds = Bounds::around(items);
            sets.push(Set { items, bounds });
        }
    }
    sets
}

/// Sorts items to the two sides of the best plane; returns where the second side starts.
fn split(items: &mut [Item]) -> usize {
    let mut middles = [(f32::INFINITY, f32::NEG_INFINITY); 3];
    for item in &*items {
        for (axis, (low, high)) in middles.iter_mut().enumerate() {
            let centre = item.centre(axis);
            *low = smaller(centre, *low);
            *high = larger(centre, *high);
        }
    }
    let bin = |axis: usize, item: &Item| {
        let (low, high) = middles[axis];
        let share = (item.centre(axis) - low) / (high - low);
        ((share * BINS as f32) as usize).min(BINS - 1)
    };
    let mut bins = [[(Bounds::EMPTY, 0_usize); BINS]; 3];
    for item in &*items {
        for (axis, bins) in bins.iter_mut().enumerate() {
            let (bounds, count) = &mut bins[bin(axis, item)];
            bounds.add(&item.bounds);
            *count += 1;
        }
    }
    let mut best = (f32::INFINITY, 0, 0);
    for (axis, bins) in bins.iter().enumerate() {
        let mut above = [0.0; BINS];
        let (mut bounds, mut count) = (Bounds::EMPTY, 0);
        for index in (1..BINS).rev() {
            bounds.add(&bins[index].0);
            count += bins[index].1;
            above[index] = cost(&bounds, count);
        }
        let (mut bounds, mut count) = (Bounds::EMPTY, 0);
        for index in 1..BINS {
            bounds.add(&bins[index - 1].0);
            count += bins[index - 1].1;
            let total = cost(&bounds, count) + above[index];
            if count > 0 && count < items.len() && total < best.0 {
                best = (total, axis, index);
            }
        }
    }
    let (total, axis, first_above) = best;
    if total == f32::INFINITY {
        return items.len() / 2;
    }
    partition(items, |item| bin(axis, item) < first_above)
}

/// What a set costs the rays that meet its parent: its leaves are tested whole.
fn cost(bounds: &Bounds, count: usize) -> f32 {
    if count == 0 {
        return f32::INFINITY;
    }
    bounds.area() * count.div_ceil(LEAF_SIZE) as f32
}

/// Brings the items that `first` wants to the front; returns how many these are.
fn partition(items: &mut [Item], first: impl Fn(&Item) -> bool) -> usize {
    let mut front = 0;
    for index in 0..items.len() {
        if first(&items[index]) {
            items.swap(front, index);
            front += 1;
        }
    }
    front
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_grow_to_hold_what_is_added() {
        let mut bounds = Bounds::EMPTY;
        bounds.add(&Bounds {
            low: [1.0, 2.0, 3.0],
            high: [4.0, 3.0, 5.0],
        });
        bounds.add(&Bounds {
            low: [2.0, -2.0, 3.5],
            high: [3.0, 2.5, 9.0],
        });
        assert_eq!(bounds.low, [1.0, -2.0, 3.0]);
        assert_eq!(bounds.high, [4.0, 3.0, 9.0]);
        // Half the surface of 3 by 5 by 6.
        assert_eq!(bounds.area(), 15.0 + 30.0 + 18.0);
    }

    /// Small boxes at these places along an axis.
    fn row(axis: usize, places: impl IntoIterator<Item = f32>) -> Vec<Item> {
        let item = |(triangle, place): (u32, f32)| {
            let (mut low, mut high) = ([-0.1; 3], [0.1; 3]);
            low[axis] += place;
            high[axis] += place;
            let bounds = Bounds { low, high };
            Item { bounds, triangle }
        };
        (0..).zip(places).map(item).collect()
    }

    #[test]
    fn a_set_is_split_at_the_gap_in_it() {
        for axis in 0..3 {
            // Of ten each, this many beyond the gap.
            for (far, first) in [(1, -4.0), (3, 40.0), (7, -20.0)] {
                let is_far = |index: u32| index * 3 % 10 < far;
                let place = |index: u32| {
                    let gap = if is_far(index) { 10.0 } else { 0.0 };
                    first + 0.01 * index as f32 + gap
                };
                let mut items = row(axis, (0..60).map(place));
                let near = split(&mut items);
                assert_eq!(near, 60 - 6 * far as usize, "{axis}");
                let mut first = items[..near].iter();
                assert!(first.all(|item| !is_far(item.triangle)), "{axis}, {far}");
            }
        }
    }

    #[test]
    fn what_lies_in_one_place_is_halved() {
        let mut items = row(0, [0.5; 41]);
        assert_eq!(split(&mut items), 20);
    }

    #[test]
    fn only_what_is_too_much_for_a_leaf_is_divided() {
        for count in 1..=LEAF_SIZE + 1 {
            let mut items = row(1, (0..count).map(|index| index as f32));
            let sets = eight_sets(&mut items, 0).len();
            assert_eq!(sets, if count > LEAF_SIZE { 2 } else { 1 }, "{count}");
        }
    }

    #[test]
    fn deep_in_a_tree_sets_are_halved() {
        let squares = (0..800).map(|index| (index * index) as f32);
        for (depth, halves) in [(HALVING_DEPTH - 1, false), (HALVING_DEPTH, true)] {
            let mut items = row(2, squares.clone());
            let sets = eight_sets(&mut items, depth);
            let even = sets.iter().all(|set| set.items.len() == 100);
            assert_eq!((sets.len(), even), (WIDTH, halves), "{depth}");
        }
    }
}
