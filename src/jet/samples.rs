//! The shots of a jet: low-discrepancy or random samples, in which neither order nor threads can change
//! a result.

use rayon::prelude::*;

use super::importance::ImportanceDensity;
use super::mixture::{Mixture, Parts};
use super::qmc_point::{QmcPoint, Stream};
use super::shot_sample::ShotSample;
use crate::problem::Problem;

/// The shots of a jet, without its pose.
#[derive(Clone, Debug)]
pub struct Samples {
    /// One for each shot.
    pub shots: Vec<ShotSample>,
}

impl Samples {
    /// The first `count` shots of a stream, all of weight 1.
    pub fn new(problem: &Problem, stream: Stream, count: usize) -> Self {
        let shot =
            |index| ShotSample::at(problem, &mut QmcPoint::of_jet(problem.seed, stream, index));
        Self {
            shots: (0..count as u32).map(shot).collect(),
        }
    }

    /// The first `count` shots of a stream, drawn independently of each other: plain Monte Carlo, for comparison
    /// with the low-discrepancy points of [`Samples::new`].
    pub fn random(problem: &Problem, stream: Stream, count: usize) -> Self {
        let shot =
            |index| ShotSample::at(problem, &mut QmcPoint::random(problem.seed, stream, index));
        Self {
            shots: (0..count as u32).map(shot).collect(),
        }
    }

    /// Shots of a search: one in two is a boundary sample, drawn towards the boundary of the exit disc, the cone
    /// and the tolerance box, where rare violations come from; three in four from 2048 shots on.
    ///
    /// Averages weighted with [`ShotSample::weight`] estimate the same as those over [`Samples::new`].
    /// When all shots of a problem are the same, there is one.
    pub fn with_boundary(problem: &Problem, stream: Stream, count: usize) -> Self {
        let boundary = if count < MANY { 1 } else { 3 };
        let parts = Parts {
            boundary,
            ..Parts::JET_ALONE
        };
        Self::mixed(
            problem,
            stream,
            count,
            &Mixture::new(parts, &ImportanceDensity::NONE),
        )
    }

    /// The same with half of the boundary samples drawn with an importance density, two thirds from 2048 shots
    /// on; [`Samples::with_boundary`] without a density.
    pub fn with_importance(
        problem: &Problem,
        stream: Stream,
        count: usize,
        importance: Option<&ImportanceDensity>,
    ) -> Self {
        let Some(importance) = importance else {
            return Self::with_boundary(problem, stream, count);
        };
        let [jet, by_importance] = if count < MANY { [2, 1] } else { [1, 2] };
        let parts = Parts {
            jet,
            boundary: 1,
            by_importance,
        };
        Self::mixed(problem, stream, count, &Mixture::new(parts, importance))
    }

    /// Shots that tell which shares of them break goals and limits: every fourth is drawn with an importance density, so
    /// that of rare violations more are seen and shares of many shots stay nearly as certain; all are of the jet where
    /// there is no density.
    pub fn for_shares(
        problem: &Problem,
        stream: Stream,
        count: usize,
        importance: Option<&ImportanceDensity>,
    ) -> Self {
        let mixture = match importance {
            Some(importance) => {
                let parts = Parts {
                    jet: 3,
                    by_importance: 1,
                    ..Parts::NONE
                };
                Mixture::new(parts, importance)
            }
            None => Mixture::new(Parts::JET_ALONE, &ImportanceDensity::NONE),
        };
        Self::mixed(problem, stream, count, &mixture)
    }

    fn mixed(problem: &Problem, stream: Stream, count: usize, mixture: &Mixture) -> Self {
        if problem.has_one_ray() {
            return Self::new(problem, stream, 1);
        }
        let shot = |index| mixture.in_rounds(problem, stream, index).0;
        Self {
            shots: (0..count as u32).into_par_iter().map(shot).collect(),
        }
    }
}

/// From this many shots on most of them are boundary samples.
const MANY: usize = 2048;
