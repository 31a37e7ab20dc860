//! Building a wide tree from the top.

use arrayvec::ArrayVec;
use nalgebra::{Point3, Vector3};
use rayon::prelude::*;

use super::bars::{Bar, Bars};
use super::flat::Frame;
use super::oriented_slab::{OrientedSlab, OrientedSlabs};
use super::split::{Bounds, HALVING_DEPTH, Item, Set, eight_sets};
use super::{Bvh8, LEAF, Node, SLIM, THIN, WIDTH};

/// Triangles of a leaf.
pub(super) const LEAF_SIZE: usize = 4;
/// Sets larger than this are built by all threads.
const PARALLEL: usize = 1 << 13;
/// Halved eight times to a level, 2^32 triangles end after eleven more.
const DEEPEST: usize = HALVING_DEPTH + 12;
/// A walk leaves behind at most seven stops at each level.
pub(super) const MOST_STOPS: usize = DEEPEST * (WIDTH - 1) + 1;

/// Indices of the triangles in a leaf.
pub type Leaf = ArrayVec<u32, LEAF_SIZE>;

/// A part of the tree with the leaves below it.
#[derive(Default)]
struct Branch {
    nodes: Vec<Node>,
    slabs: Vec<OrientedSlabs>,
    bars: Vec<Bars>,
    /// Which of these are of each node that has some.
    bars_of: Vec<u32>,
    leaves: Vec<Leaf>,
}

/// What a tree is built over, in its coordinates.
struct Triangles<'a> {
    corners: &'a (dyn Fn(u32) -> [Vector3<f64>; 3] + Sync),
    slack: f64,
}

impl Triangles<'_> {
    /// The corners of the triangles of a set.
    fn of<'b>(&'b self, set: &'b Set) -> impl Iterator<Item = [Vector3<f64>; 3]> + Clone + 'b {
        set.items.iter().map(|item| (self.corners)(item.triangle))
    }
}

impl Bvh8 {
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
        let inside = |triangle| corners(triangle).map(|corner| frame.inside(&corner));
        let item = |triangle| {
            let [a, b, c] = inside(triangle);
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
        let triangles = Triangles {
            corners: &inside,
            slack: frame.slack,
        };
        if items.is_empty() {
            tree.add_node();
        } else {
            tree.grow(&mut items, &triangles, 0);
        }
        let Branch {
            nodes,
            slabs,
            bars,
            bars_of,
            leaves,
        } = tree;
        let tree = Self {
            nodes,
            slabs,
            bars,
            bars_of,
            frame,
        };
        (tree, leaves)
    }
}

impl Branch {
    /// Adds an empty node; returns its index.
    fn add_node(&mut self) -> usize {
        self.nodes.push(Node::EMPTY);
        self.slabs.push(OrientedSlabs::ENDLESS);
        self.bars_of.push(0);
        self.nodes.len() - 1
    }

    /// Adds a node over the items; returns what its parent holds of it.
    fn grow(&mut self, items: &mut [Item], triangles: &Triangles, depth: usize) -> u32 {
        let index = self.add_node();
        let mut flags = 0;
        let parallel = items.len() > PARALLEL;
        let sets = eight_sets(items, depth);
        let mut bars = ArrayVec::<Option<Bar>, WIDTH>::new();
        for (lane, set) in sets.iter().enumerate() {
            let node = &mut self.nodes[index];
            for axis in 0..3 {
                node.sides[axis][lane] = set.bounds.low[axis];
                node.sides[axis + 3][lane] = set.bounds.high[axis];
            }
            let corners = triangles.of(set);
            bars.push(Bar::around(corners.clone(), &set.bounds, triangles.slack));
            if let Some(slab) = OrientedSlab::along(corners, &set.bounds, triangles.slack) {
                self.slabs[index].set(lane, &slab);
                flags |= THIN;
            }
        }
        if let Some(bars) = Bars::of(&bars) {
            self.bars_of[index] = self.bars.len() as u32;
            self.bars.push(bars);
            flags |= SLIM;
        }
        let children: ArrayVec<u32, WIDTH> = if parallel {
            let branch = |set| {
                let mut branch = Self::default();
                let child = branch.child(set, triangles, depth);
                (branch, child)
            };
            let mut branches = Vec::new();
            sets.into_par_iter()
                .map(branch)
                .collect_into_vec(&mut branches);
            let mut graft = |(branch, child)| self.graft(branch, child);
            branches.into_iter().map(&mut graft).collect()
        } else {
            let mut child = |set| self.child(set, triangles, depth);
            sets.into_iter().map(&mut child).collect()
        };
        self.nodes[index].children[..children.len()].copy_from_slice(&children);
        flags | index as u32
    }

    /// Adds a set as a leaf or as a node; returns what its parent holds of it.
    fn child(&mut self, set: Set, triangles: &Triangles, depth: usize) -> u32 {
        if set.items.len() > LEAF_SIZE {
            return self.grow(set.items, triangles, depth + 1);
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
        self.slabs.extend(branch.slabs);
        let bars = self.bars.len() as u32;
        self.bars.extend(branch.bars);
        self.bars_of
            .extend(branch.bars_of.iter().map(|index| index + bars));
        self.nodes.extend(branch.nodes.into_iter().map(|mut node| {
            node.children = node.children.map(moved);
            node
        }));
        moved(child)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// So that no mesh makes the tree too deep for a walk.
    #[test]
    fn depth_is_counted_on_the_way_down() {
        // Eight clusters of heaps of three, which are divided only deep in a tree.
        let place = |triangle: u32| {
            let (cluster, inside) = (triangle / 32, triangle % 32);
            f64::from(100 * cluster + inside / 3)
        };
        let corners = |triangle| [Vector3::x() * place(triangle); 3];
        let triangles = Triangles {
            corners: &corners,
            slack: 0.0,
        };
        let item = |triangle| {
            let at = place(triangle) as f32;
            let (low, high) = ([at, 0.0, 0.0], [at + 0.1, 0.1, 0.1]);
            let bounds = Bounds { low, high };
            Item { bounds, triangle }
        };
        let leaves = |depth: usize| {
            let mut items: Vec<Item> = (0..256).map(item).collect();
            let mut branch = Branch::default();
            branch.grow(&mut items, &triangles, depth);
            branch.leaves.iter().map(Leaf::len).collect::<Vec<_>>()
        };
        assert_eq!(leaves(HALVING_DEPTH - 1), [4; 64]);
        assert_ne!(leaves(HALVING_DEPTH - 2), [4; 64]);
    }
}
