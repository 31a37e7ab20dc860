//! Streams of validation shots: sets for different purposes are independent of each other and of every
//! search.

/// Reported figures.
pub const ANSWERS: u32 = 0;
/// Windows and maps, neither of which decides on the other.
pub const WINDOWS: u32 = 1;
/// Restitution and friction at the ends of their ranges.
pub const UNKNOWNS: u32 = 2;
/// Which effects a search needs, and how many shots.
pub const EFFECTS: u32 = 3;
/// Pictures and places.
pub const EVIDENCE: u32 = 4;
/// Densities of hits.
pub const COVERAGE: u32 = 5;
/// Pilot runs.
pub const PILOT_RUNS: u32 = 6;
/// References of charts.
pub const CHART_REFERENCE: u32 = 7;
/// Poses that charts compare.
pub const CHART_COMPARISON: u32 = 8;
/// Shots of a search that is to confirm another one.
pub const CONFIRMATION: u32 = 9;
/// Stages of a search that bound how far the settings found before are from the best ones.
pub const OPTIMALITY_GAP: u32 = 10;
/// The scatter of samples in charts; the last, as it may take more streams than the others.
pub const CHART_SCATTER: u32 = 11;
