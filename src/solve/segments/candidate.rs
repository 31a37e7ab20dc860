//! Settings for a piece of a stroke.

use crate::problem::setting::Settings;
use crate::solve::Status;

/// Settings, and at which cells they pass.
#[derive(Clone)]
pub struct Candidate {
    pub settings: Settings,
    /// The largest violation in each cell; at most 1 where all verdicts pass there.
    pub violations: Vec<f64>,
    pub status: Status,
}

impl Candidate {
    /// Whether it passes at a cell.
    pub fn passes(&self, cell: usize) -> bool {
        self.violations[cell] <= 1.0
    }

    /// How far it passes from a cell on: the first cell at which it does not.
    pub fn reach(&self, from: usize) -> usize {
        let mut cells = from..self.violations.len();
        cells
            .find(|&cell| !self.passes(cell))
            .unwrap_or(self.violations.len())
    }
}

/// Whether all candidates violate as much in one cell as in another: what one search has not found, another will not.
pub fn are_alike(candidates: &[Candidate], [a, b]: [usize; 2]) -> bool {
    candidates.iter().all(|it| {
        let (a, b) = (it.violations[a], it.violations[b]);
        (a - b).abs() <= ALIKE * a.min(b)
    })
}

/// Violations that differ by less than this share are alike: by as much they scatter.
const ALIKE: f64 = 0.1;

#[cfg(test)]
mod tests {
    use super::*;

    const SETTINGS: Settings = Settings {
        incidence: 1.0,
        azimuth: 0.0,
        standoff: 0.01,
        speed: 50.0,
        aim_along: 0.0,
        aim_across: 0.0,
        aim_above: 0.0,
        contact: 0,
        static_friction: 0.3,
    };

    fn candidate(violations: &[f64]) -> Candidate {
        Candidate {
            settings: SETTINGS,
            violations: violations.to_vec(),
            status: Status::BestFound,
        }
    }

    #[test]
    fn settings_reach_to_the_first_cell_at_which_they_fail() {
        let found = candidate(&[0.2, 1.0, 1.3, 0.1]);
        assert_eq!([0, 1, 2, 3].map(|from| found.reach(from)), [2, 2, 2, 4]);
    }

    #[test]
    fn cells_are_alike_where_no_settings_tell_them_apart() {
        let open = [
            candidate(&[1.4, 1.45, 1.41, f64::MAX]),
            candidate(&[f64::MAX, f64::MAX, 9.0, f64::MAX]),
        ];
        assert!(are_alike(&open, [0, 1]));
        // One of them fits into the third cell alone, the other one into all but the last.
        assert!(!are_alike(&open, [0, 2]));
        assert!(!are_alike(&open, [0, 3]));
    }
}
