//! argmin's particle swarm.

use argmin::core::Executor;
use argmin::solver::particleswarm::ParticleSwarm;
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use crate::objective::Objective;
use crate::simplex::Cost;

const PARTICLES: usize = 20;
/// A swarm that has settled by now starts again.
const MOST_ITERATIONS: u64 = 60;

pub fn particle_swarm(objective: &Objective, seed: u32) {
    let dimensions = objective.dimensions();
    objective.many_starts(seed, |_, number| {
        let bounds = (vec![0.0; dimensions], vec![1.0; dimensions]);
        let generator =
            Xoshiro256PlusPlus::seed_from_u64(u64::from(seed) << 32 | u64::from(number));
        let solver = ParticleSwarm::new(bounds, PARTICLES).with_rng_generator(generator);
        let executor = Executor::new(Cost(objective), solver)
            .configure(|state| state.max_iters(MOST_ITERATIONS));
        drop(executor.run());
    });
}
