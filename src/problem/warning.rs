//! What parses but can hardly be meant, as far as the file alone tells.

use super::Problem;
use super::equipment::SurfaceRule;
use super::fault::Span;
use super::source::Source;
use super::stroke::Feed;
pub use super::warning_code::WarningCode;
use crate::digits::plain;
use crate::elementary::sin;
use crate::impact::Contact;

/// Something in a problem file that can hardly be meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Why it is one.
    pub doubt: WarningCode,
    /// Key path, such as `goals.rebound.allow`.
    pub key: String,
    /// What is odd about it.
    pub message: String,
    /// What could be meant instead.
    pub help: String,
    /// The place in the text, once known.
    pub at: Option<Span>,
}

impl Warning {
    /// A warning about the value at `key`.
    pub fn new(
        doubt: WarningCode,
        key: impl Into<String>,
        message: impl Into<String>,
        help: impl Into<String>,
    ) -> Self {
        Self {
            doubt,
            key: key.into(),
            message: message.into(),
            help: help.into(),
            at: None,
        }
    }

    /// The same with its place in the text.
    #[must_use]
    pub fn in_text(mut self, source: &Source) -> Self {
        self.at = source.locate(&self.key);
        self
    }
}

impl std::fmt::Display for Warning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}; {}", self.key, self.message, self.help)
    }
}

/// What is odd about a problem, as far as that can be told without its scene.
pub fn warnings(problem: &Problem) -> Vec<Warning> {
    [
        weights(problem),
        reachable_impulse(problem),
        loose_tolerance(problem),
        friction_limit(problem),
        unfollowed_rebounds(problem),
        density(problem),
        size(problem),
        exit(problem),
        feed(problem),
    ]
    .into_iter()
    .flatten()
    .chain(allowances(problem))
    .collect()
}

fn weights(problem: &Problem) -> Option<Warning> {
    let goals = &problem.goals;
    let of_rebounds = goals.rebound.map_or(0.0, |goal| goal.weight);
    let of_surfaces = problem.surfaces.iter().map(|rule| {
        let is_limited = rule.allow.is_some() || goals.rebound.is_some();
        let weight = rule
            .weight
            .unwrap_or(if goals.rebound.is_some() { 0.0 } else { 1.0 });
        if is_limited { weight } else { 0.0 }
    });
    let sum = goals.normal_impulse.weight
        + goals.tangential_impulse.map_or(0.0, |goal| goal.weight)
        + of_rebounds
        + goals.miss.weight
        + of_surfaces.sum::<f64>();
    (sum == 0.0).then(|| {
        Warning::new(
            WarningCode::NothingWeighs,
            "goals",
            "all weights are 0: every setting is as good as any other",
            "give the goals that matter a `weight` above 0",
        )
    })
}

/// The contacts that the target may meet.
fn contacts_on_target(problem: &Problem) -> impl Iterator<Item = Contact> + '_ {
    let mut rules = problem.surfaces.iter();
    let rule = rules.find(|rule| rule.surface == problem.target.surface);
    let own = rule.and_then(|rule| rule.contact);
    problem.ranges.contact.iter().map(move |&index| {
        let settings = &problem.contacts[index];
        own.unwrap_or_else(|| settings.at(settings.static_friction.max))
    })
}

fn reachable_impulse(problem: &Problem) -> Option<Warning> {
    let goal = problem.goals.normal_impulse;
    let (speeds, mass) = (problem.ranges.speed, problem.shot.mass());
    let impulse = |speed: f64| {
        let one = move |contact: Contact| mass * speed * (1.0 + contact.restitution.at(speed));
        contacts_on_target(problem).map(one)
    };
    // Whatever the angle, the fastest shot gives no more, and the slowest gives this.
    let fastest = speeds.max * (1.0 + 2.0 * problem.jet.speed_spread);
    let most = impulse(fastest).fold(0.0, f64::max);
    let slowest = speeds.min * sin(problem.ranges.incidence.min);
    let least = impulse(slowest).fold(f64::INFINITY, f64::min);
    let help = format!(
        "a shot of {} mg gives {} uN.s to {} uN.s at these speeds; compare units, radius and density",
        short(mass * 1e6),
        short(least * 1e6),
        short(most * 1e6),
    );
    let (doubt, message) = if goal.target > most * (1.0 + goal.tolerance) {
        let message = "is more than the shot gives at any speed of the range";
        (WarningCode::ImpulseTooLarge, message)
    } else if goal.target < least * SLOWEST_SHARE {
        let message =
            "is far less than the shot gives at the lowest speed and the flattest incidence";
        (WarningCode::ImpulseTooSmall, message)
    } else {
        return None;
    };
    Some(Warning::new(
        doubt,
        "goals.normal_impulse.target",
        message,
        help,
    ))
}

/// A curved target may be hit more flatly than the settings say, but not at any angle.
const SLOWEST_SHARE: f64 = 0.25;

fn loose_tolerance(problem: &Problem) -> Option<Warning> {
    (problem.goals.normal_impulse.tolerance >= 1.0).then(|| {
        Warning::new(
            WarningCode::LooseTolerance,
            "goals.normal_impulse.tolerance",
            "a hit that gives nothing is within it",
            "say by how much N* may differ, such as `15 %`",
        )
    })
}

fn friction_limit(problem: &Problem) -> Option<Warning> {
    let (goal, normal) = (
        problem.goals.tangential_impulse?,
        problem.goals.normal_impulse,
    );
    let friction = contacts_on_target(problem)
        .map(|contact| contact.static_friction.max(contact.dynamic_friction))
        .fold(0.0, f64::max)
        * (1.0 + problem.tolerance.friction);
    let most = friction * normal.target * (1.0 + normal.tolerance);
    (goal.limit > most).then(|| {
        Warning::new(
            WarningCode::LimitBeyondFriction,
            "goals.tangential_impulse.limit",
            format!(
                "friction gives at most {} uN.s where N* is as wanted: nothing breaks this limit",
                short(most * 1e6)
            ),
            format!(
                "the largest coefficient of friction is {}; leave the goal out if f* does not matter",
                short(friction)
            ),
        )
    })
}

fn allowances(problem: &Problem) -> Vec<Warning> {
    let goal = problem.goals.normal_impulse;
    let wanted = goal.target * (1.0 + goal.tolerance);
    let general = problem
        .goals
        .rebound
        .map(|it| ("goals.rebound.allow".into(), it.allow));
    // Beside the target its own surface may well be peened as the target is.
    let beside = |rule: &&SurfaceRule| rule.surface != problem.target.surface;
    let own = problem.surfaces.iter().filter(beside).filter_map(|rule| {
        let key = format!("surfaces.{}.allow", rule.surface);
        Some((key, rule.allow?))
    });
    general
        .into_iter()
        .chain(own)
        .filter(|(_, allow)| *allow > wanted)
        .map(|(key, _): (String, f64)| {
            let message = format!(
                "is more than the target itself shall receive, {} uN.s: hardly any rebound breaks it",
                short(wanted * 1e6)
            );
            Warning::new(WarningCode::AllowanceAboveTarget, key, message, "say what the surface may take, less than what peens")
        })
        .collect()
}

fn unfollowed_rebounds(problem: &Problem) -> Option<Warning> {
    let limited = problem.goals.rebound.is_some();
    (limited && problem.paths.impacts == 1).then(|| {
        Warning::new(
            WarningCode::ReboundsNotFollowed,
            "paths.impacts",
            "paths end with the first hit: `goals.rebound` sees no rebound",
            "follow at least 2 impacts, or leave `goals.rebound` out",
        )
    })
}

fn density(problem: &Problem) -> Option<Warning> {
    let is_usual = (500.0..25_000.0).contains(&problem.shot.density);
    (!is_usual).then(|| {
        Warning::new(
            WarningCode::UnusualDensity,
            "shot.density",
            "no shot is made of this",
            "glass has 2500 kg/m3, ceramic 3850 kg/m3, steel 7800 kg/m3, tungsten carbide 15000 kg/m3",
        )
    })
}

fn size(problem: &Problem) -> Option<Warning> {
    let radius = problem.shot.radius;
    (!(2e-6..20e-3).contains(&radius)).then(|| {
        let (doubt, kind) = if radius < 1e-3 {
            (WarningCode::Dust, "dust")
        } else {
            (WarningCode::Balls, "balls")
        };
        Warning::new(
            doubt,
            "shot.radius",
            format!("these are {kind}, not shot"),
            "shot has radii from 0.01 mm to 3 mm",
        )
    })
}

fn exit(problem: &Problem) -> Option<Warning> {
    let (exit, shot) = (problem.jet.exit_diameter, 2.0 * problem.shot.radius);
    (exit > 0.0 && exit < shot).then(|| {
        Warning::new(
            WarningCode::ExitTooSmall,
            "jet.exit_diameter",
            format!(
                "the shot, {} mm wide, does not fit through",
                short(shot * 1e3)
            ),
            "give the diameter of the exit and the radius of the shot",
        )
    })
}

fn feed(problem: &Problem) -> Option<Warning> {
    let stroke = problem.stroke.as_ref()?;
    let missing = match (problem.coverage.is_some(), problem.jet.mass_flow.is_some()) {
        (true, true) => return None,
        (false, true) => "coverage",
        (true, false) => "jet.mass_flow",
        (false, false) => "coverage and jet.mass_flow",
    };
    (stroke.feed == Feed::Auto).then(|| {
        Warning::new(
            WarningCode::FeedUnknown,
            "stroke",
            "nothing tells how fast the nozzle may travel: the answer will have no feed",
            format!("give {missing}, or a `feed`"),
        )
    })
}

/// A number with three significant digits.
pub(crate) fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    plain(rounded)
}

#[cfg(test)]
mod tests;
