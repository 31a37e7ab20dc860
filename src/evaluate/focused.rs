//! Evaluations on fresh shots of which a part is drawn from where harm comes from.

use rayon::prelude::*;

use super::harm::focus_on_harm;
use super::ledger::Ledger;
use super::{Evaluation, summed_up};
use crate::jet::{Draw, Focus, Fresh, Unfocused};
use crate::problem::setting::Choice;
use crate::setup::Setup;

/// Evaluates `choice` on fresh shots, half of those on the rim drawn [from where harm comes
/// from](super::focus_on_harm) with these settings.
pub fn evaluate_focused(setup: &Setup, choice: &Choice, fresh: &Fresh) -> Evaluation {
    on_focus(setup, choice, |focus| {
        let sets = fresh.sets.par_iter();
        // Each set is copied when it is fired: all of them together do not fit into a cache.
        sets.map(|set| Ledger::of(setup, choice, &set.focused(&setup.problem, focus)))
            .collect()
    })
}

/// The same for several choices; a few of them share what it takes to fetch a set from memory.
pub fn evaluate_each_focused(setup: &Setup, choices: &[Choice], fresh: &Fresh) -> Vec<Evaluation> {
    let few = choices.chunks(MOST_TOGETHER);
    few.flat_map(|few| evaluate_few_focused(setup, few, fresh))
        .collect()
}

/// What more shots do than those of so many choices is not kept at the same time.
const MOST_TOGETHER: usize = 4;

fn evaluate_few_focused(setup: &Setup, choices: &[Choice], fresh: &Fresh) -> Vec<Evaluation> {
    let foci = choices.par_iter().map(|it| focus_on_harm(setup, it));
    let foci: Vec<(Focus, usize)> = foci.collect();
    let on_set = |set: &Unfocused| {
        let mut shots = set.open();
        let pairs = choices.iter().zip(&foci);
        let ledger = |(choice, (focus, _)): (&Choice, &(Focus, usize))| {
            set.focus(&mut shots, &setup.problem, focus);
            Ledger::of(setup, choice, &shots)
        };
        pairs.map(ledger).collect()
    };
    let of_sets: Vec<Vec<Ledger>> = fresh.sets.par_iter().map(on_set).collect();
    let mut of_choices: Vec<Vec<Ledger>> = choices.iter().map(|_| Vec::new()).collect();
    for ledgers in of_sets {
        for (of_choice, ledger) in of_choices.iter_mut().zip(ledgers) {
            of_choice.push(ledger);
        }
    }
    let pairs = of_choices
        .into_par_iter()
        .zip(choices.par_iter().zip(&foci));
    let found = pairs
        .map(|(ledgers, (choice, (_, rays)))| summed_up(setup, choice, ledgers).with_rays(*rays));
    found.collect()
}

/// The same as [`evaluate_focused`] on shots that are forgotten once they are fired, as [`Fresh`] ones of
/// the same number would take 230 bytes a shot.
pub fn evaluate_drawn(setup: &Setup, choice: &Choice, fresh: &Draw) -> Evaluation {
    on_focus(setup, choice, |focus| {
        let fresh = fresh.focused(focus);
        let numbers = (0..fresh.sets()).into_par_iter();
        numbers
            .map(|number| Ledger::of(setup, choice, &fresh.set(number)))
            .collect()
    })
}

/// Sums up what shots do that are drawn by a focus on the harm of `choice`; its scouts' rays count.
fn on_focus(
    setup: &Setup,
    choice: &Choice,
    fire: impl FnOnce(&Focus) -> Vec<Ledger>,
) -> Evaluation {
    let (focus, rays) = focus_on_harm(setup, choice);
    summed_up(setup, choice, fire(&focus)).with_rays(rays)
}

impl Evaluation {
    /// The same after more rays.
    fn with_rays(self, more: usize) -> Self {
        Self {
            rays: self.rays + more,
            ..self
        }
    }
}
