//! What fresh shots are drawn for: sets for different purposes are independent of each other and of
//! every search.

/// Reported figures.
pub const ANSWERS: u32 = 0;
/// Windows and maps, neither of which decides on the other.
pub const WINDOWS: u32 = 1;
/// The ends of what is not known.
pub const UNKNOWNS: u32 = 2;
/// Which effects a search needs, and how many shots.
pub const EFFECTS: u32 = 3;
/// Pictures and places.
pub const EVIDENCE: u32 = 4;
/// Densities of hits.
pub const COVERAGE: u32 = 5;
/// Where harm comes from.
pub const HARM: u32 = 6;
/// What charts take as true.
pub const CHART_REFERENCE: u32 = 7;
/// Poses that charts compare.
pub const CHART_COMPARISON: u32 = 8;
/// The scatter of samples in charts; the last, as it may take more streams than the others.
pub const CHART_SCATTER: u32 = 9;
