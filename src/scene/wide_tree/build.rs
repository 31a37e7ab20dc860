//! Building a wide tree: sets of triangles are split where the surface area heuristic wants it,
//! the largest first, until there are eight to a node.

use arrayvec::ArrayVec;
use nalgebra::Point3;
use rayon::prelude::*;

use super::flat::Frame;
use super::{LEAF, Node, WIDTH, WideTree};
use crate::scene::lanes::{larger, smaller};

/// Triangles of a leaf.
const LEAF_SIZE: usize = 4;
/// Bins that the triangles of a set are sorted into along each axis before it is split.
const BINS: usize = 32;
/// Sets larger than this are built by all threads.
const PARALLEL: usize = 1 << 13;
/// Below this depth sets are halved, so that no mesh makes the tree deeper than [`DEEPEST`].
const HALVING_DEPTH: usize = 16;
/// Halved eight times to a level, 2^32 triangles end after eleven more.
const DEEPEST: usize = HALVING_DEPTH + 12;
/// A walk leaves behind at most seven stops at each level.
pub(super) const MOST_STOPS: usize = DEEPEST * (WIDTH - 1) + 1;

/// Indices of the triangles in a leaf.
pub type Leaf = ArrayVec<u32, LEAF_SIZE>;

/// A triangle's box in the coordinates of the tree.
#[derive(Clone, Copy)]
struct Item {
    bounds: Bounds,
    triangle: u32,
}

impl Item {
    fn centre(&self, axis: usize) -> f32 {
        self.bounds.low[axis] + self.bounds.high[axis]
    }
}

#[derive(Clone, Copy)]
struct Bounds {
    low: [f32; 3],
    high: [f32; 3],
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

    fn area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|axis| self.high[axis] - self.low[axis]);
        x * y + y * z + z * x
    }
}

/// A part of the tree with the leaves below it.
#[derive(Default)]
struct Branch {
    nodes: Vec<Node>,
    leaves: Vec<Leaf>,
}

/// Triangles that will be a child of a node.
struct Set<'a> {
    items: &'a mut [Item],
    bounds: Bounds,
}

impl WideTree {
    /// A tree over this many triangles, whose boxes are loosened by `slack` (m), and its leaves.
    pub fn new(
        count: usize,
        corners: impl Fn(u32) -> [Point3<f64>; 3] + Sync,
        slack: f64,
    ) -> (Self, Vec<Leaf>) {
        let indices = 0..count as u32;
        let mut points = indices.clone().flat_map(&corners);
        let first = points.next().unwrap_or_default();
        let (low, high) = points.fold((first, first), |(low, high), point| {
            (low.inf(&point), high.sup(&point))
        });
        let frame = Frame::around(low, high, slack);
        let margin = frame.margin();
        let item = |triangle| {
            let [a, b, c] = corners(triangle).map(|corner| frame.inside(&corner));
            let (low, high) = (a.inf(&b).inf(&c), a.sup(&b).sup(&c));
            Item {
                bounds: Bounds {
                    low: low.map(|side| (side - margin) as f32).into(),
                    high: high.map(|side| (side + margin) as f32).into(),
                },
                triangle,
            }
        };
        let mut items: Vec<Item> = indices.into_par_iter().map(item).collect();
        let mut tree = Branch::default();
        if items.is_empty() {
            tree.nodes.push(Node::EMPTY);
        } else {
            tree.grow(&mut items, 0);
        }
        let nodes = tree.nodes;
        (Self { nodes, frame }, tree.leaves)
    }
}

impl Branch {
    /// Adds a node over the items; returns its index.
    fn grow(&mut self, items: &mut [Item], depth: usize) -> u32 {
        let index = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        let parallel = items.len() > PARALLEL;
        let sets = eight_sets(items, depth);
        for (lane, set) in sets.iter().enumerate() {
            let node = &mut self.nodes[index];
            for axis in 0..3 {
                node.sides[axis][lane] = set.bounds.low[axis];
                node.sides[axis + 3][lane] = set.bounds.high[axis];
            }
        }
        let children: ArrayVec<u32, WIDTH> = if parallel {
            let branch = |set| {
                let mut branch = Self::default();
                let child = branch.child(set, depth);
                (branch, child)
            };
            let mut branches = Vec::new();
            sets.into_par_iter()
                .map(branch)
                .collect_into_vec(&mut branches);
            let mut graft = |(branch, child)| self.graft(branch, child);
            branches.into_iter().map(&mut graft).collect()
        } else {
            let mut child = |set| self.child(set, depth);
            sets.into_iter().map(&mut child).collect()
        };
        self.nodes[index].children[..children.len()].copy_from_slice(&children);
        index as u32
    }

    /// Adds a set as a leaf or as a node; returns what its parent holds of it.
    fn child(&mut self, set: Set, depth: usize) -> u32 {
        if set.items.len() > LEAF_SIZE {
            return self.grow(set.items, depth + 1);
        }
        let mut leaf: Leaf = set.items.iter().map(|item| item.triangle).collect();
        leaf.sort_unstable();
        self.leaves.push(leaf);
        LEAF | (self.leaves.len() - 1) as u32
    }

    /// Adds a branch with the child that it was made for; returns that child as it is called here.
    fn graft(&mut self, branch: Self, child: u32) -> u32 {
        let (nodes, leaves) = (self.nodes.len() as u32, self.leaves.len() as u32);
        let moved = |child: u32| {
            if child & LEAF != 0 {
                child + leaves
            } else {
                child + nodes
            }
        };
        self.leaves.extend(branch.leaves);
        self.nodes.extend(branch.nodes.into_iter().map(|mut node| {
            node.children = node.children.map(moved);
            node
        }));
        moved(child)
    }
}

/// Splits items into at most eight sets.
fn eight_sets(items: &mut [Item], depth: usize) -> Vec<Set<'_>> {
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
}
