//! What is modelled: which effects, and who decides.

use super::Problem;
use super::setting::Tolerance;
use crate::impact::Restitution;

/// Something that a model may have or leave out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Effect {
    /// Shots have their size in flight.
    ShotSize,
    /// Impacts after the first.
    Rebounds,
    /// Impacts after the second.
    LaterRebounds,
    /// The spin that a shot takes from one impact to the next.
    Spin,
    /// The width of the exit.
    ExitWidth,
    /// The divergence of the jet.
    Divergence,
    /// The scatter of the speed.
    SpeedScatter,
    /// The scatter of the size.
    SizeScatter,
    /// Restitution that falls as speed rises.
    FallingRestitution,
    /// The tilt of rough walls.
    Roughness,
}

/// Which effects are modelled.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Model {
    /// Those that matter in the scene at hand; figures always have all.
    #[default]
    Auto,
    /// All that the problem has.
    Full,
    /// These of them.
    Only(Vec<Effect>),
}

impl Effect {
    /// All of them, those first whose absence saves most.
    pub const ALL: [Self; 10] = [
        Self::ShotSize,
        Self::Rebounds,
        Self::LaterRebounds,
        Self::FallingRestitution,
        Self::Roughness,
        Self::Spin,
        Self::ExitWidth,
        Self::Divergence,
        Self::SpeedScatter,
        Self::SizeScatter,
    ];

    /// Its name in problem files and results.
    pub const fn name(self) -> &'static str {
        match self {
            Self::ShotSize => "shot_size",
            Self::Rebounds => "rebounds",
            Self::LaterRebounds => "later_rebounds",
            Self::Spin => "spin",
            Self::ExitWidth => "exit_width",
            Self::Divergence => "divergence",
            Self::SpeedScatter => "speed_scatter",
            Self::SizeScatter => "size_scatter",
            Self::FallingRestitution => "falling_restitution",
            Self::Roughness => "roughness",
        }
    }

    /// The effect of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|effect| effect.name() == name)
    }

    /// What it is, for people.
    pub const fn description(self) -> &'static str {
        match self {
            Self::ShotSize => "size of the shot in flight",
            Self::Rebounds => "impacts after the first",
            Self::LaterRebounds => "impacts after the second",
            Self::Spin => "spin between impacts",
            Self::ExitWidth => "width of the exit",
            Self::Divergence => "divergence of the jet",
            Self::SpeedScatter => "scatter of the speed",
            Self::SizeScatter => "scatter of the size",
            Self::FallingRestitution => "fall of restitution with speed",
            Self::Roughness => "tilt of rough walls",
        }
    }

    /// Whether it decides where shots hit first.
    pub const fn decides_first_hits(self) -> bool {
        matches!(self, Self::ShotSize | Self::ExitWidth | Self::Divergence)
    }

    /// What a model without it does instead, for people.
    pub const fn without(self) -> &'static str {
        match self {
            Self::ShotSize => "shots fly as points; their size acts through the mass only",
            Self::Rebounds => "nothing after the first hit",
            Self::LaterRebounds => "nothing after the second impact",
            Self::Spin => "every impact begins without spin",
            Self::ExitWidth => "shots leave from the centre of the exit",
            Self::Divergence => "shots leave along the axis",
            Self::SpeedScatter => "every shot has the same speed",
            Self::SizeScatter => "every shot has the same size",
            Self::FallingRestitution => {
                "restitution is what it is at the normal speed of the leading settings"
            }
            Self::Roughness => "walls are smooth",
        }
    }

    /// Whether a problem has it.
    pub fn is_in(self, problem: &Problem) -> bool {
        match self {
            Self::ShotSize => problem.paths.shot_size,
            Self::Rebounds => problem.paths.impacts > 1,
            Self::LaterRebounds => problem.paths.impacts > 2,
            Self::Spin => problem.paths.spin && problem.paths.impacts > 1,
            Self::ExitWidth => problem.paths.exit_width && problem.jet.exit_diameter > 0.0,
            Self::Divergence => problem.jet.divergence > 0.0,
            Self::SpeedScatter => problem.jet.speed_spread > 0.0,
            Self::SizeScatter => problem.shot.size_spread > 0.0,
            Self::FallingRestitution => restitutions(problem).any(|e| !e.is_constant()),
            Self::Roughness => problem.surfaces.iter().any(|rule| rule.roughness > 0.0),
        }
    }

    /// Takes it out of a problem. Restitution that falls with speed becomes what it is at
    /// `normal_speed`, m/s.
    pub fn remove_from(self, problem: &mut Problem, normal_speed: f64) {
        match self {
            Self::ShotSize => problem.paths.shot_size = false,
            Self::Rebounds => problem.paths.impacts = 1,
            Self::LaterRebounds => problem.paths.impacts = problem.paths.impacts.min(2),
            Self::Spin => problem.paths.spin = false,
            Self::ExitWidth => problem.paths.exit_width = false,
            Self::Divergence => problem.jet.divergence = 0.0,
            Self::SpeedScatter => problem.jet.speed_spread = 0.0,
            Self::SizeScatter => problem.shot.size_spread = 0.0,
            Self::FallingRestitution => {
                let chosen = problem
                    .contacts
                    .iter_mut()
                    .map(|settings| &mut settings.contact);
                let own = problem
                    .surfaces
                    .iter_mut()
                    .filter_map(|rule| rule.contact.as_mut());
                for contact in chosen.chain(own) {
                    contact.restitution = contact.restitution.held_at(normal_speed);
                }
            }
            Self::Roughness => {
                for rule in &mut problem.surfaces {
                    rule.roughness = 0.0;
                }
            }
        }
    }
}

fn restitutions(problem: &Problem) -> impl Iterator<Item = Restitution> + '_ {
    let chosen = problem.contacts.iter().map(|settings| settings.contact);
    let own = problem.surfaces.iter().filter_map(|rule| rule.contact);
    chosen.chain(own).map(|contact| contact.restitution)
}

impl Problem {
    /// The effects that it has, in the order of [`Effect::ALL`].
    pub fn effects(&self) -> Vec<Effect> {
        let all = Effect::ALL.into_iter();
        all.filter(|effect| effect.is_in(self)).collect()
    }

    /// Whether every shot is the same: then one ray is enough.
    pub fn has_one_ray(&self) -> bool {
        let scatters = [
            Effect::ExitWidth,
            Effect::Divergence,
            Effect::SpeedScatter,
            Effect::SizeScatter,
            Effect::Roughness,
        ];
        self.stroke.is_none()
            && self.tolerance == Tolerance::default()
            && !scatters.iter().any(|effect| effect.is_in(self))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::impact::Contact;
    use crate::problem::equipment::SurfaceRule;
    use crate::problem::example::{keyway, rule};

    /// The keyway with what it lacks: sizes that scatter, restitution that falls, a rough wall.
    fn with_everything() -> Problem {
        let mut problem = keyway();
        problem.shot.size_spread = 0.05;
        problem.contacts[1].contact.restitution = FALLING;
        problem.surfaces = vec![SurfaceRule {
            roughness: 0.1,
            ..rule("hub.bore")
        }];
        problem
    }

    const FALLING: Restitution = Restitution::Falling {
        reference: 0.5,
        speed: 10.0,
        exponent: 0.25,
    };

    #[test]
    fn a_problem_has_the_effects_that_its_numbers_give() {
        use Effect::*;

        let mut problem = keyway();
        let usual = [ShotSize, Rebounds, LaterRebounds, Spin];
        assert_eq!(
            problem.effects(),
            [&usual[..], &[ExitWidth, Divergence, SpeedScatter]].concat()
        );
        assert_eq!(with_everything().effects(), Effect::ALL);

        problem.jet.exit_diameter = 0.0;
        problem.jet.divergence = 0.0;
        problem.jet.speed_spread = 0.0;
        assert_eq!(problem.effects(), usual);
        // The second impact is a rebound, and only the third a later one.
        problem.paths.impacts = 2;
        assert_eq!(problem.effects(), [ShotSize, Rebounds, Spin]);
        problem.paths.impacts = 1;
        assert_eq!(problem.effects(), [ShotSize]);
    }

    #[test]
    fn an_effect_that_is_taken_out_takes_no_other_with_it() {
        for effect in Effect::ALL {
            let mut problem = with_everything();
            effect.remove_from(&mut problem, 5.0);
            let left = problem.effects();
            let kept = |other: &Effect| match effect {
                // Without rebounds there is nothing to spin for.
                Effect::Rebounds => !matches!(
                    other,
                    Effect::Rebounds | Effect::LaterRebounds | Effect::Spin
                ),
                effect => *other != effect,
            };
            let expected: Vec<Effect> = Effect::ALL.into_iter().filter(kept).collect();
            assert_eq!(left, expected, "{effect:?}");
        }
    }

    #[test]
    fn what_is_taken_out_leaves_the_rest_as_it_was() {
        let mut problem = with_everything();
        let rule = problem.surfaces[0].clone();
        let own = problem.contacts[0].contact;
        problem.surfaces.push(SurfaceRule {
            contact: Some(Contact {
                restitution: FALLING,
                ..own
            }),
            ..rule
        });
        Effect::LaterRebounds.remove_from(&mut problem, 5.0);
        assert_eq!(problem.paths.impacts, 2);
        problem.paths.impacts = 1;
        Effect::LaterRebounds.remove_from(&mut problem, 5.0);
        assert_eq!(problem.paths.impacts, 1);

        // 0.5 (5 / 10)^-0.25
        let held = 0.594_603_557_501_360_5;
        Effect::FallingRestitution.remove_from(&mut problem, 5.0);
        let of_contacts = problem.contacts.iter().map(|settings| settings.contact);
        let of_contacts: Vec<f64> = of_contacts.map(|it| it.restitution.at(99.0)).collect();
        assert_eq!(of_contacts, [0.25, held, 0.25]);
        let own = problem.surfaces[1].contact.expect("it was given");
        assert_eq!(own.restitution.at(99.0), held);
    }

    #[test]
    fn one_ray_is_enough_where_nothing_scatters_or_is_tolerated() {
        let mut single = keyway();
        assert!(!single.has_one_ray());
        single.tolerance = Tolerance::default();
        assert!(!single.has_one_ray());
        single.jet.exit_diameter = 0.0;
        single.jet.divergence = 0.0;
        single.jet.speed_spread = 0.0;
        assert!(single.has_one_ray());

        let scatters: [fn(&mut Problem); 6] = [
            |problem| problem.jet.exit_diameter = 1e-3,
            |problem| problem.jet.divergence = 0.1,
            |problem| problem.jet.speed_spread = 0.1,
            |problem| problem.shot.size_spread = 0.1,
            |problem| problem.surfaces = with_everything().surfaces,
            |problem| problem.tolerance.standoff = 1e-3,
        ];
        for (index, scatter) in scatters.into_iter().enumerate() {
            let mut problem = single.clone();
            scatter(&mut problem);
            assert!(!problem.has_one_ray(), "{index}");
        }
    }
}
