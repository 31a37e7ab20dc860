//! How often a stroke hits the surfaces that it should spare.

use rayon::prelude::*;

use super::grid::Cells;
use super::hits::{FirstHit, shots_of};
use super::shots::Shots;
use crate::jet::purpose;
use crate::problem::stroke::Leg;
use crate::scenario::Scenario;
use crate::scene::patch::Triangle;
use crate::trace::Tracer;

/// Hits on a secondary surface, all impacts of a path counted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dose {
    /// Index of the surface.
    pub surface: u32,
    /// Hits per shot and area where they are densest, over cells, 1/m2.
    pub most: f64,
    /// Its standard error, 1/m2.
    pub standard_error: f64,
    /// Side of a cell, m.
    pub side: f64,
}

/// Shots behind the doses.
const SHOTS: usize = 1 << 16;
/// Cells of a target; those of surfaces are as large.
const CELLS: f64 = 64.0;

impl Dose {
    /// The doses of a stroke on all surfaces with a limit that are hit at all, its run-out included.
    pub fn of_stroke(scenario: &Scenario, legs: &[Leg], ends: [f64; 2]) -> Vec<Self> {
        let fired = Shots::new(scenario, purpose::EVIDENCE, SHOTS, ends);
        let of_set = |number: u32| {
            let mut hits = vec![Vec::new(); scenario.surfaces.len()];
            let shots = fired.fire(number, |shots| {
                for leg in legs {
                    let own = shots_of(leg, legs, shots);
                    let tracer = Tracer::new(scenario, &leg.settings, leg.settings.speed);
                    let impacts = tracer.paths(&own).into_iter().flat_map(|it| it.impacts);
                    for impact in impacts.filter(|it| it.number > 0 && !it.on_target) {
                        hits[impact.surface as usize].push(FirstHit {
                            point: impact.point,
                            weight: 1.0,
                        });
                    }
                }
            });
            (hits, shots)
        };
        let mut sets: Vec<(Vec<Vec<FirstHit>>, usize)> =
            (0..fired.sets()).into_par_iter().map(of_set).collect();
        let shots = sets.iter().map(|(_, shots)| shots).sum();
        let limited = scenario.surfaces.iter().enumerate();
        let limited = limited.filter(|(_, limits)| limits.allow.is_some() && !limits.deflector);
        let doses = limited.filter_map(|(surface, _)| {
            let of_surface = sets.iter_mut();
            let hits: Vec<Vec<FirstHit>> = of_surface
                .map(|(hits, _)| std::mem::take(&mut hits[surface]))
                .collect();
            Self::on(scenario, surface as u32, &hits, shots)
        });
        doses.collect()
    }

    fn on(scenario: &Scenario, surface: u32, hits: &[Vec<FirstHit>], shots: usize) -> Option<Self> {
        if hits.iter().all(Vec::is_empty) {
            return None;
        }
        let triangles: Vec<Triangle> = match surface == scenario.target.surface {
            true => scenario.target.cut_out(&scenario.scene).1,
            false => scenario.scene.surface_triangles(surface).collect(),
        };
        let cells = Cells::new(scenario, &triangles, CELLS, hits);
        let each = cells.cells.iter().map(|cell| cell.density(shots));
        let most = each.max_by(|a, b| a.value.total_cmp(&b.value))?;
        Some(Self {
            surface,
            most: most.value,
            standard_error: most.standard_error,
            side: cells.side,
        })
    }
}
