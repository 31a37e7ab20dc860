//! What parses but can hardly be meant, as far as the file alone tells.

use super::Problem;
pub use super::doubt::Doubt;
use super::fault::Span;
use super::source::Source;
use crate::impact::Contact;

/// Something in a problem file that can hardly be meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Why it is one.
    pub doubt: Doubt,
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
        doubt: Doubt,
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
            Doubt::NothingWeighs,
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
    problem.settings.contact.iter().map(move |&index| {
        let choice = &problem.contacts[index];
        own.unwrap_or_else(|| choice.at(choice.static_friction.max))
    })
}

fn reachable_impulse(problem: &Problem) -> Option<Warning> {
    let goal = problem.goals.normal_impulse;
    let (speeds, mass) = (problem.settings.speed, problem.shot.mass());
    let impulse = |speed: f64| {
        let one = move |contact: Contact| mass * speed * (1.0 + contact.restitution.at(speed));
        contacts_on_target(problem).map(one)
    };
    // Whatever the angle, the fastest shot gives no more, and the slowest gives this.
    let fastest = speeds.max * (1.0 + 2.0 * problem.jet.speed_spread);
    let most = impulse(fastest).fold(0.0, f64::max);
    let slowest = speeds.min * problem.settings.incidence.min.sin();
    let least = impulse(slowest).fold(f64::INFINITY, f64::min);
    let help = format!(
        "a shot of {} mg gives {} uN.s to {} uN.s at these speeds; compare units, radius and density",
        short(mass * 1e6),
        short(least * 1e6),
        short(most * 1e6),
    );
    let (doubt, message) = if goal.target > most * (1.0 + goal.tolerance) {
        let message = "is more than the shot gives at any speed of the range";
        (Doubt::ImpulseTooLarge, message)
    } else if goal.target < least * SLOWEST_SHARE {
        let message =
            "is far less than the shot gives at the lowest speed and the flattest incidence";
        (Doubt::ImpulseTooSmall, message)
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
            Doubt::LooseTolerance,
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
            Doubt::LimitBeyondFriction,
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
    let own = problem.surfaces.iter().filter_map(|rule| {
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
            Warning::new(Doubt::AllowanceAboveTarget, key, message, "say what the surface may take, less than what peens")
        })
        .collect()
}

fn unfollowed_rebounds(problem: &Problem) -> Option<Warning> {
    let limited = problem.goals.rebound.is_some();
    (limited && problem.paths.impacts == 1).then(|| {
        Warning::new(
            Doubt::ReboundsNotFollowed,
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
            Doubt::UnusualDensity,
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
            (Doubt::Dust, "dust")
        } else {
            (Doubt::Balls, "balls")
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
            Doubt::ExitTooSmall,
            "jet.exit_diameter",
            format!(
                "the shot, {} mm wide, does not fit through",
                short(shot * 1e3)
            ),
            "give the diameter of the exit and the radius of the shot",
        )
    })
}

/// A number with three significant digits.
pub(crate) fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    rounded.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::equipment::SurfaceRule;
    use crate::problem::example::{keyway, rule};

    #[test]
    fn any_weight_is_enough() {
        let weighing = |one: usize, other: usize| {
            let weight = |index: usize| f64::from(u8::from(index == one || index == other));
            let mut problem = keyway();
            let goals = &mut problem.goals;
            goals.normal_impulse.weight = weight(0);
            goals.tangential_impulse.as_mut().expect("given").weight = weight(1);
            goals.rebound.as_mut().expect("given").weight = weight(2);
            goals.miss.weight = weight(3);
            problem
        };
        for one in 0..4 {
            for other in 0..4 {
                assert_eq!(weights(&weighing(one, other)), None, "{one}, {other}");
            }
        }
        let none = weights(&weighing(9, 9)).expect("nothing weighs");
        assert_eq!(none.doubt, Doubt::NothingWeighs);
    }

    #[test]
    fn a_surface_weighs_where_something_limits_its_impacts() {
        let weighs_beside = |miss: f64, allow: Option<f64>, weight: Option<f64>| {
            let mut problem = keyway();
            problem.goals.normal_impulse.weight = 0.0;
            problem.goals.miss.weight = miss;
            problem.goals.tangential_impulse = None;
            problem.goals.rebound = None;
            problem.surfaces = vec![SurfaceRule {
                allow,
                weight,
                ..rule("hub.bore")
            }];
            weights(&problem).is_none()
        };
        let weighs = |allow, weight| weighs_beside(0.0, allow, weight);
        assert!(weighs_beside(0.5, Some(1e-6), Some(0.5)));
        assert!(weighs(Some(1e-6), Some(0.5)));
        assert!(weighs(Some(1e-6), None));
        assert!(!weighs(Some(1e-6), Some(0.0)));
        assert!(!weighs(None, Some(0.5)));
    }

    #[test]
    fn the_target_may_have_a_contact_of_its_own() {
        // Without any bounce the fastest shot gives 161.3e-6 N.s, with a full one twice as much.
        let doubt = |surface: &str, target: f64| {
            let mut problem = keyway();
            problem.surfaces = vec![SurfaceRule {
                contact: Contact::new(0.1, 0.1, 1.0).ok(),
                ..rule(surface)
            }];
            problem.goals.normal_impulse.target = target;
            reachable_impulse(&problem).map(|warning| warning.doubt)
        };
        assert_eq!(doubt("hub.floor", 370e-6), None);
        assert_eq!(doubt("hub.floor", 372e-6), Some(Doubt::ImpulseTooLarge));
        assert_eq!(doubt("hub.bore", 232e-6), Some(Doubt::ImpulseTooLarge));
    }

    #[test]
    fn a_target_is_compared_with_what_the_fastest_and_the_slowest_shot_give() {
        let doubt = |target: f64| {
            let mut problem = keyway();
            problem.goals.normal_impulse.target = target;
            reachable_impulse(&problem).map(|warning| warning.doubt)
        };
        // 3.6652e-6 kg at 40 m/s 1.1 give 201.6e-6 N.s with restitution, and 15 % more are allowed.
        assert_eq!(doubt(231.7e-6), None);
        assert_eq!(doubt(231.9e-6), Some(Doubt::ImpulseTooLarge));
        // At 5 m/s and 30 deg they give 11.45e-6 N.s; a quarter of it is still believed.
        assert_eq!(doubt(2.87e-6), None);
        assert_eq!(doubt(2.86e-6), Some(Doubt::ImpulseTooSmall));
    }

    #[test]
    fn friction_may_be_as_high_as_its_tolerance_says() {
        let doubt = |limit: f64| {
            let mut problem = keyway();
            problem.tolerance.friction = 0.1;
            let goal = problem.goals.tangential_impulse.as_mut();
            goal.expect("given").limit = limit;
            friction_limit(&problem).map(|warning| warning.doubt)
        };
        // 0.30 1.1 times 40e-6 N.s 1.15
        assert_eq!(doubt(15.17e-6), None);
        assert_eq!(doubt(15.19e-6), Some(Doubt::LimitBeyondFriction));
    }

    #[test]
    fn a_shot_may_be_as_wide_as_the_exit() {
        let doubt = |exit_diameter: f64| {
            let mut problem = keyway();
            problem.jet.exit_diameter = exit_diameter;
            exit(&problem).map(|warning| warning.doubt)
        };
        assert_eq!(doubt(1e-3), None);
        assert_eq!(doubt(0.99e-3), Some(Doubt::ExitTooSmall));
        // A point, which stands for no nozzle at all.
        assert_eq!(doubt(0.0), None);
    }

    #[test]
    fn a_surface_may_take_what_the_target_takes() {
        let mut problem = keyway();
        problem.goals.normal_impulse.tolerance = 0.0;
        let target = problem.goals.normal_impulse.target;
        let mut doubts = |allow: f64| {
            problem.goals.rebound.as_mut().expect("given").allow = allow;
            allowances(&problem).len()
        };
        assert_eq!(doubts(target), 0);
        assert_eq!(doubts(target.next_up()), 1);
    }
}
