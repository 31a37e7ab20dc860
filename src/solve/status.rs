//! How a search can end.

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The accuracy asked for was reached: finalists of independent searches agree, and J is known as well.
    Converged,
    /// These are the best settings that were found, but finalists differ, or the search ended before J was certain.
    BestFound,
    /// The nozzle collides with the part at every pose that was tried.
    NoFeasiblePose,
    /// It was interrupted.
    Interrupted,
}
