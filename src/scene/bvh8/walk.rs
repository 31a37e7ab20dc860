//! Walks through the tree along a ray.

use arrayvec::ArrayVec;

use super::flat::FlatRay;
use super::marks::Marks;
use super::oriented_slab::Looks;
use super::query_shape::QueryShape;
use super::{Bvh8, Entered, LEAF, Node, SLIM, THIN, WIDTH, build};

/// A walk along a ray.
pub(in crate::scene) struct Walk<'a, B> {
    tree: &'a Bvh8,
    ray: &'a FlatRay<B>,
    /// Where it has yet to go, the nearest last.
    stops: ArrayVec<StackEntry, { build::MOST_STOPS + MOST_SORTED }>,
    /// How far along the ray it leads, in the coordinates of the boxes.
    limit: f32,
    /// The marked leaves to which it does not lead.
    passed: Option<(&'a Marks, u32)>,
    /// Whether there are crowds of needles.
    among_needles: bool,
}

impl<'a, B: QueryShape> Walk<'a, B> {
    #[inline(always)]
    pub fn new(tree: &'a Bvh8, ray: &'a FlatRay<B>) -> Self {
        Self {
            tree,
            ray,
            stops: ArrayVec::new(),
            limit: f32::INFINITY,
            passed: None,
            among_needles: tree.bars.len() >= CROWD,
        }
    }

    /// Starts from where the ray [enters](WideTree::entered) the tree.
    #[inline(always)]
    pub fn start(&mut self, entered: &Entered) {
        self.limit = entered.limit;
        if let Some(nearest) = self.enter(&self.tree.nodes[0], entered) {
            self.stops.push(nearest);
        }
    }

    /// From now on it leads to this distance along the ray, m.
    #[inline(always)]
    pub fn end_at(&mut self, limit: f64) {
        self.limit = self.tree.frame.limit(limit, self.ray);
    }

    /// From now on it does not lead to the leaves with this mark.
    #[inline(always)]
    pub fn pass_by(&mut self, marks: &'a Marks, mark: u32) {
        self.passed = Some((marks, mark));
    }

    /// The next leaf that the ray may meet on its way, and whether the ray may start inside its box.
    #[inline(always)]
    pub fn next(&mut self) -> Option<(u32, bool)> {
        loop {
            let mut stop = self.stops.pop()?;
            if stop.entry() > self.limit {
                continue;
            }
            loop {
                if let Some((marks, mark)) = self.passed
                    && marks.of(stop.child()) == mark
                {
                    break;
                }
                if stop.child() & LEAF != 0 {
                    return Some((stop.child() & !LEAF, stop.entry() == 0.0));
                }
                let index = (stop.child() & !(THIN | SLIM)) as usize;
                let looks = Looks {
                    slabs: (stop.child() & THIN != 0).then(|| &self.tree.slabs[index]),
                    bars: (stop.child() & SLIM != 0)
                        .then(|| &self.tree.bars[self.tree.bars_of[index] as usize]),
                };
                let node = &self.tree.nodes[index];
                let entered = node.entered(looks, self.ray, self.limit);
                let Some(nearest) = self.enter(node, &entered) else {
                    break;
                };
                stop = nearest;
            }
        }
    }

    /// Where to go from a node that the ray enters: to its nearest child, while the others have to wait.
    ///
    /// Among needles, a sphere goes where it is nearest of all that waits: under it are all that it comes
    /// near to, and a branch without the one that it touches would be searched to its end. Where too many
    /// wait for that, it stays in its branch.
    #[inline(always)]
    fn enter(&mut self, node: &Node, entered: &Entered) -> Option<StackEntry> {
        let mut lanes = entered.lanes;
        let mut next = || {
            let lane = lanes.trailing_zeros() as usize;
            lanes &= lanes.wrapping_sub(1);
            (lane < WIDTH)
                .then(|| StackEntry::new(node.children[lane], entered.entries.as_array()[lane]))
        };
        let mut nearest = next()?;
        let goes_back =
            B::HAS_SIZE && self.among_needles && self.stops.len() <= MOST_SORTED - WIDTH;
        let bottom = if goes_back { 0 } else { self.stops.len() };
        while let Some(other) = next() {
            let (nearer, farther) = if other < nearest {
                (other, nearest)
            } else {
                (nearest, other)
            };
            nearest = nearer;
            self.stops.push(farther);
            settle_last(&mut self.stops[bottom..]);
        }
        if goes_back
            && let Some(waiting) = self.stops.last_mut()
            && *waiting < nearest
        {
            std::mem::swap(waiting, &mut nearest);
            settle_last(&mut self.stops);
        }
        Some(nearest)
    }
}

/// So many nodes with needles are a crowd; to search the branches of fewer to their ends takes no longer.
const CROWD: usize = 64;
/// So many stops are kept in order at most, the nearest last: to sort more takes longer than to visit them.
const MOST_SORTED: usize = 1024;

/// A child and where the ray enters it, in one number that sorts by the latter.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
pub(super) struct StackEntry(u64);

impl StackEntry {
    #[inline(always)]
    pub fn new(child: u32, entry: f32) -> Self {
        Self(u64::from(entry.to_bits()) << 32 | u64::from(child))
    }

    #[inline(always)]
    pub fn child(self) -> u32 {
        self.0 as u32
    }

    #[inline(always)]
    pub fn entry(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }
}

/// Moves the last stop down to its place among others, of which the nearest is the last.
#[inline(always)]
pub(super) fn settle_last(stops: &mut [StackEntry]) {
    let mut place = stops.len() - 1;
    while place > 0 && stops[place - 1] < stops[place] {
        stops.swap(place - 1, place);
        place -= 1;
    }
}
