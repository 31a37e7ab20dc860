//! What hangs together: triangles or vertices that are joined pair by pair.

/// Groups of things that are numbered from 0 on.
pub(super) struct Groups {
    /// An earlier one of the same group, or itself for its first one.
    leaders: Vec<u32>,
}

impl Groups {
    /// Each by itself.
    pub fn new(count: usize) -> Self {
        Self {
            leaders: (0..count as u32).collect(),
        }
    }

    /// The first one that is known to be of the same group.
    pub fn leader(&mut self, mut of: u32) -> u32 {
        while self.leaders[of as usize] != of {
            // Ways are halved as they are gone.
            self.leaders[of as usize] = self.leaders[self.leaders[of as usize] as usize];
            of = self.leaders[of as usize];
        }
        of
    }

    /// Makes one group of those of two.
    pub fn join(&mut self, [one, other]: [u32; 2]) {
        let (one, other) = (self.leader(one), self.leader(other));
        self.leaders[one.max(other) as usize] = one.min(other);
    }

    /// The number of each one's group, from 0 on in the order of their first ones, and how many groups there are.
    pub fn numbered(mut self) -> (Vec<u32>, usize) {
        let count = self.leaders.len();
        let mut numbers = vec![u32::MAX; count];
        let mut next = 0;
        let of = (0..count as u32).map(|it| {
            let first = self.leader(it) as usize;
            if numbers[first] == u32::MAX {
                numbers[first] = next;
                next += 1;
            }
            numbers[first]
        });
        let of = of.collect();
        (of, next as usize)
    }
}
