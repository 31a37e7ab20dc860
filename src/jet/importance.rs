//! Importance density: where violating shots come from, so that more of them are drawn there.

mod component;

use super::qmc_point::{DIMENSIONS, Dimension};
use crate::elementary::square;
use component::Component;

/// Density relative to the boundary proposal: a mixture of components, since violations come from several corners of what
/// exit, cone and tolerance allow. A product over dimensions alone, fitted to two opposite corners, is as dense in all the
/// corners between them.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportanceDensity {
    components: [Component; MOST_COMPONENTS],
    /// How many of them there are.
    count: usize,
}

/// Components at most.
const MOST_COMPONENTS: usize = 4;
/// Cells of a dimension.
const CELLS: usize = 16;

/// The cell of a point in each dimension.
pub(super) type Cells = [u8; DIMENSIONS];

/// In place of a cell in dimensions that are not drawn from.
pub(super) const NO_CELL: u8 = u8::MAX;

/// Periodic dimensions: their last cell is a neighbour of the first.
const TURNS: [usize; 2] = [Dimension::ConeTurn as usize, Dimension::ExitTurn as usize];

/// Where a violation came from, and what it weighs.
struct Event<'a> {
    cells: &'a Cells,
    weight: f64,
}

/// Which share of each event comes from each component.
type Belonging = Vec<[f64; MOST_COMPONENTS]>;

impl ImportanceDensity {
    /// The boundary proposal itself.
    pub const NONE: Self = Self {
        components: [Component::FLAT; MOST_COMPONENTS],
        count: 1,
    };

    /// Adapts the mixture to where violations were found, by expectation maximisation (A. P. Dempster and others, Journal
    /// of the Royal Statistical Society B 39, 1977). There are as many components as there are events to tell them apart.
    pub(super) fn on(&self, cells: &[Cells], violation: &[f64]) -> Self {
        let most = violation.iter().copied().fold(0.0, f64::max);
        if !(most > 0.0 && most.is_finite()) {
            return self.clone();
        }
        let events = events(cells, violation, most);
        let count = effective_count(events.iter().map(|event| event.weight));
        let wanted = ((count / EVENTS_PER_COMPONENT) as usize).min(MOST_COMPONENTS);
        let (before, belonging) = if self.count < wanted {
            let belonging = nearest(&seeds(&events, wanted), &events);
            (self.with_components(wanted), belonging)
        } else {
            (self.clone(), self.belonging(&events))
        };
        let mut fitted = before.fitted(&events, &belonging);
        for _ in 1..ROUNDS {
            fitted = before.fitted(&events, &fitted.belonging(&events));
        }
        fitted
    }

    /// The same with more components, each of which is still what the first one is.
    fn with_components(&self, count: usize) -> Self {
        let mut more = self.clone();
        more.components[self.count..count].fill(self.components[0]);
        Self { count, ..more }
    }

    /// Which share of each event comes from each component, by their densities there.
    fn belonging(&self, events: &[Event]) -> Belonging {
        let shares = |event: &Event| {
            let mut densities = [0.0; MOST_COMPONENTS];
            for (density, component) in densities.iter_mut().zip(self.components()) {
                *density = component.share * component.density(event.cells);
            }
            let sum: f64 = densities.iter().sum();
            densities.map(|density| density / sum)
        };
        events.iter().map(shares).collect()
    }

    /// The components adapted to what belongs to them.
    fn fitted(&self, events: &[Event], belonging: &Belonging) -> Self {
        let total: f64 = events.iter().map(|event| event.weight).sum();
        let mut fitted = self.clone();
        let components = fitted.components[..self.count].iter_mut();
        for (index, component) in components.enumerate() {
            let pairs = events.iter().zip(belonging);
            let weights: Vec<f64> = pairs.map(|(event, of)| event.weight * of[index]).collect();
            component.share = weights.iter().sum::<f64>() / total;
            component.adapt(events, &weights);
        }
        fitted
    }

    fn components(&self) -> &[Component] {
        &self.components[..self.count]
    }

    /// The cell of a coordinate in 0 to 1.
    pub(super) fn cell(coordinate: f64) -> u8 {
        ((coordinate * CELLS as f64) as usize).min(CELLS - 1) as u8
    }

    /// Whether there are several components to draw from.
    pub(super) fn is_mixed(&self) -> bool {
        self.count > 1
    }

    /// The component to draw a point with, from a number that is uniform in 0 to 1.
    pub(super) fn component(&self, uniform: f64) -> usize {
        let mut left = uniform;
        for (index, component) in self.components().iter().enumerate() {
            if left < component.share {
                return index;
            }
            left -= component.share;
        }
        0
    }

    /// A coordinate with the density of a component, from one that is uniform in 0 to 1.
    pub(super) fn drawn(&self, component: usize, dimension: Dimension, uniform: f64) -> f64 {
        self.components[component].drawn(dimension, uniform)
    }

    /// The density at a point relative to that of the boundary proposal.
    pub(super) fn density(&self, cells: &Cells) -> f64 {
        let density = |component: &Component| component.share * component.density(cells);
        self.components().iter().map(density).sum()
    }
}

/// The violations among some points; one of `most` weighs 1.
fn events<'a>(cells: &'a [Cells], violation: &[f64], most: f64) -> Vec<Event<'a>> {
    let pairs = cells.iter().zip(violation);
    let violations = pairs.filter(|(_, violation)| **violation > 0.0);
    let event = |(cells, violation): (_, &f64)| Event {
        cells,
        weight: violation / most,
    };
    violations.map(event).collect()
}

/// As many equal events would scatter as much.
fn effective_count(weights: impl Iterator<Item = f64>) -> f64 {
    let (mut total, mut squares) = (0.0, 0.0);
    for weight in weights {
        total += weight;
        squares += weight * weight;
    }
    total * total / squares
}

/// Events far from each other, the heavier the sooner.
fn seeds<'a>(events: &[Event<'a>], count: usize) -> Vec<&'a Cells> {
    let mut seeds: Vec<&Cells> = Vec::with_capacity(count);
    while seeds.len() < count {
        let gain = |event: &Event| {
            let distances = seeds.iter().map(|seed| distance(seed, event.cells));
            event.weight * distances.fold(f64::MAX, f64::min)
        };
        let farthest = events.iter().max_by(|a, b| gain(a).total_cmp(&gain(b)));
        let Some(farthest) = farthest else { break };
        seeds.push(farthest.cells);
    }
    seeds
}

/// Each event belongs to the seed that is nearest to it.
fn nearest(seeds: &[&Cells], events: &[Event]) -> Belonging {
    let nearest = |event: &Event| {
        let distances = seeds.iter().map(|seed| distance(seed, event.cells));
        let nearest = distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        let mut belonging = [0.0; MOST_COMPONENTS];
        belonging[nearest.map_or(0, |(index, _)| index)] = 1.0;
        belonging
    };
    events.iter().map(nearest).collect()
}

/// Square of the distance between two points, in cells.
fn distance(one: &Cells, other: &Cells) -> f64 {
    let pairs = one.iter().zip(other).enumerate();
    let squares = pairs.map(|(dimension, (a, b))| {
        let apart = usize::from(a.abs_diff(*b));
        let is_turn = TURNS.contains(&dimension);
        let apart = if is_turn {
            apart.min(CELLS.saturating_sub(apart))
        } else {
            apart
        };
        square(apart as f64)
    });
    squares.sum()
}

/// Rounds of expectation and maximisation.
const ROUNDS: usize = 6;
/// Equal events that it takes to fit a component.
const EVENTS_PER_COMPONENT: f64 = 8.0;

#[cfg(test)]
mod tests;
