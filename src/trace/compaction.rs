//! Lanes that shots leave when their paths end, and the shots that take them over.

use crate::scene::lanes::{LANES, Lane};

/// Which shots take over which lanes, so that the rest stand at the front again. Most shots stay
/// where they are: only the last ones move.
pub(super) struct Compaction {
    /// How many shots are left.
    pub left: usize,
    moves: [Move; LANES],
    moved: usize,
}

#[derive(Clone, Copy)]
struct Move {
    from: u8,
    to: u8,
}

impl Compaction {
    /// For as many shots as `stays` has lanes.
    #[inline(always)]
    pub fn among(count: usize, stays: impl Fn(usize) -> bool) -> Self {
        let mut compaction = Self {
            left: count,
            moves: [Move { from: 0, to: 0 }; LANES],
            moved: 0,
        };
        let mut lane = 0;
        while lane < compaction.left {
            if stays(lane) {
                lane += 1;
                continue;
            }
            compaction.left -= 1;
            if stays(compaction.left) {
                compaction.moves[compaction.moved] = Move {
                    from: compaction.left as u8,
                    to: lane as u8,
                };
                compaction.moved += 1;
                lane += 1;
            }
        }
        compaction
    }

    /// Lets the shots take their new lanes in one of their quantities.
    #[inline(always)]
    pub fn fill<T: Copy>(&self, lane: &mut [T; LANES]) {
        for &Move { from, to } in &self.moves[..self.moved] {
            lane[to as usize % LANES] = lane[from as usize % LANES];
        }
    }

    /// The same for several quantities.
    #[inline(always)]
    pub fn fill_all<'a>(&self, lanes: impl IntoIterator<Item = &'a mut Lane>) {
        lanes.into_iter().for_each(|lane| self.fill(lane));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rest_stand_at_the_front() {
        let patterns: [fn(usize) -> bool; 6] = [
            |_| true,
            |_| false,
            |lane| lane % 2 == 0,
            |lane| lane % 3 == 1,
            |lane| lane < 5,
            |lane| lane > 90,
        ];
        for stays in patterns {
            for count in [0, 1, 2, 37, LANES] {
                let compaction = Compaction::among(count, stays);
                let mut lanes: [usize; LANES] = std::array::from_fn(|lane| lane);
                compaction.fill(&mut lanes);
                let mut rest = lanes[..compaction.left].to_vec();
                rest.sort_unstable();
                let expected: Vec<usize> = (0..count).filter(|&lane| stays(lane)).collect();
                assert_eq!(rest, expected, "{count} shots");
            }
        }
    }

    #[test]
    fn only_shots_behind_the_front_move() {
        let mut lanes: [usize; LANES] = std::array::from_fn(|lane| lane);
        let compaction = Compaction::among(10, |lane| lane != 3 && lane != 8);
        compaction.fill(&mut lanes);
        assert_eq!(lanes[..compaction.left], [0, 1, 2, 9, 4, 5, 6, 7]);
    }
}
