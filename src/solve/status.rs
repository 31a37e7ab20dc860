//! How a search can end.

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The accuracy asked for was reached.
    Converged,
    /// The budget was spent before.
    BudgetSpent,
    /// The nozzle collides with the part at every pose that was tried.
    NoFeasiblePose,
    /// It was interrupted.
    Interrupted,
}
