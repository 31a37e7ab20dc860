//! Where a ray starts, and what follows for the surfaces there.

use super::ray::HitId;

/// Sine of the angle to a wall up to which a shot runs along it: some roundings, so that on ten ways
/// through the scene it sinks by no more than [`LIFT`](super::LIFT) slacks. Impacts that lose energy leave
/// it with no more in a crease, and it would hit both sides in turn for ever.
const RUNS_ALONG: f64 = 6e-15;

/// Where a ray starts, and what it therefore must not hit.
///
/// In a corner the start of a rebound lies on more than one wall, and rounding may put it on
/// either side of those that it did not come from. The shot is known to be on one side of them,
/// though: a wall on which the start lies is hit at once when the shot heads into it from that
/// side, and not at all otherwise.
#[derive(Clone, Copy, Debug)]
pub(super) struct Departure {
    /// Where it is on the part that is asked.
    pub piece: Option<u32>,
    /// The side of the wall that it leaves, of whatever part.
    pub front: Option<bool>,
    /// Whether the part that is asked has its fronts towards free space; a hollow has its backs.
    pub fronts_are_free: bool,
}

impl Departure {
    /// Of a ray that leaves a spot, if any, on the part that is asked or on another.
    #[inline]
    pub fn of(leaving: Option<HitId>, on_this_part: bool) -> Self {
        Self {
            piece: leaving.filter(|_| on_this_part).map(|hit_id| hit_id.piece),
            front: leaving.map(|hit_id| hit_id.front),
            fronts_are_free: true,
        }
    }

    /// The same for a part with this side towards free space.
    #[inline]
    pub fn with_free_side(self, fronts_are_free: bool) -> Self {
        Self {
            fronts_are_free,
            ..self
        }
    }

    /// Whether a wall that shows this side is one that the shot can reach without passing through
    /// another, as far as is known: on which side of another part a shot is, the side on which it
    /// leaves this one does not tell.
    #[inline]
    pub fn sees(&self, front: bool) -> bool {
        let known = self.front.filter(|_| self.piece.is_some());
        known.unwrap_or(self.fronts_are_free) == front
    }

    /// Whether a ray runs along a wall, given the direction's component along the wall's normal.
    #[inline]
    pub fn runs_along(approach: f64) -> bool {
        approach.abs() <= RUNS_ALONG
    }

    /// Whether a shot heads into a wall on which it starts, given the direction's component along
    /// the wall's front normal.
    #[inline]
    pub fn enters(&self, approach: f64) -> bool {
        !Self::runs_along(approach) && self.front == Some(approach < 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hit_id(front: bool) -> HitId {
        HitId {
            part: 3,
            piece: 5,
            front,
        }
    }

    #[test]
    fn a_shot_enters_a_wall_from_the_side_that_it_is_on() {
        for front in [true, false] {
            let start = Departure::of(Some(hit_id(front)), true);
            let towards = if front { -1.0 } else { 1.0 };
            for steepness in [1.0, 0.5, 1e-14] {
                assert!(start.enters(towards * steepness), "{front}, {steepness}");
                assert!(!start.enters(-towards * steepness), "{front}, {steepness}");
            }
            // So flat that it is rounding.
            assert!(!start.enters(towards * 1e-15));
        }
        // What starts on no surface enters none.
        let nowhere = Departure::of(None, false);
        assert!(!nowhere.enters(-1.0) && !nowhere.enters(1.0));
    }

    #[test]
    fn a_shot_sees_the_side_on_which_it_leaves_a_part() {
        for front in [true, false] {
            let here = Departure::of(Some(hit_id(front)), true);
            assert_eq!((here.piece, here.front), (Some(5), Some(front)));
            assert!(here.sees(front) && !here.sees(!front));
            // Of another part it sees the fronts.
            let elsewhere = Departure::of(Some(hit_id(front)), false);
            assert_eq!((elsewhere.piece, elsewhere.front), (None, Some(front)));
            assert!(elsewhere.sees(true) && !elsewhere.sees(false));
        }
        let nowhere = Departure::of(None, false);
        assert!(nowhere.sees(true) && !nowhere.sees(false));
        let in_hollow = nowhere.with_free_side(false);
        assert!(in_hollow.sees(false) && !in_hollow.sees(true));
    }
}
