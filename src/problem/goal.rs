//! What must be reached and what must not happen.

/// The goals of a problem, in N s; `share` is how many shots may break a goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goals {
    /// Normal impulse on the target.
    pub normal_impulse: NormalImpulse,
    /// Limit of the tangential impulse on the target, when there is one.
    pub tangential_impulse: Option<TangentialImpulse>,
    /// What secondary surfaces may take, when there is a limit.
    pub rebound: Option<Rebound>,
    /// Shots whose first hit is not on the target.
    pub miss: Miss,
}

/// First hits on the target shall give this normal impulse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalImpulse {
    /// N s.
    pub target: f64,
    /// Relative deviation from which a shot breaks the goal.
    pub tolerance: f64,
    /// Share of the first hits on target that may break it.
    pub share: f64,
    /// Weight in the objective.
    pub weight: f64,
}

impl NormalImpulse {
    /// Whether a hit with this N*, N s, breaks it.
    pub fn is_off(&self, normal: f64) -> bool {
        (normal / self.target - 1.0).abs() > self.tolerance
    }
}

/// First hits on the target shall not give more tangential impulse than this.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TangentialImpulse {
    /// N s.
    pub limit: f64,
    /// Share of the first hits on target that may break it.
    pub share: f64,
    /// Weight in the objective.
    pub weight: f64,
}

/// Impacts on secondary surfaces shall not give more normal impulse than this.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rebound {
    /// N s.
    pub allow: f64,
    /// Share of all shots that may break it, on each surface.
    pub share: f64,
    /// Weight in the objective.
    pub weight: f64,
}

/// First hits shall be on the target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Miss {
    /// Share of all shots that may miss.
    pub share: f64,
    /// Weight in the objective.
    pub weight: f64,
}
