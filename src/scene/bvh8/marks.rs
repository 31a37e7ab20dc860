//! Leaves and branches of a tree that a walk passes by.

use super::{Bvh8, LEAF, SLIM, THIN};

/// Marks of leaves, and of the nodes below which all leaves have the same one.
#[derive(Clone)]
pub(in crate::scene) struct Marks {
    leaves: Vec<u32>,
    nodes: Vec<u32>,
}

impl Marks {
    /// The mark of a leaf that has none.
    pub const NONE: u32 = u32::MAX;

    /// The mark of what a node holds as its child.
    pub(super) fn of(&self, child: u32) -> u32 {
        if child & LEAF == 0 {
            self.nodes[(child & !(THIN | SLIM)) as usize]
        } else {
            self.leaves[(child & !LEAF) as usize]
        }
    }
}

impl Bvh8 {
    /// Marks for the leaves of this tree.
    pub fn marks(&self, leaves: Vec<u32>) -> Marks {
        let nodes = vec![Marks::NONE; self.nodes.len()];
        let mut marks = Marks { leaves, nodes };
        // Nodes come after the nodes above them.
        for (index, node) in self.nodes.iter().enumerate().rev() {
            let mut below = node.children().map(|child| marks.of(child));
            let first = below.next().unwrap_or(Marks::NONE);
            if below.all(|mark| mark == first) {
                marks.nodes[index] = first;
            }
        }
        marks
    }
}
