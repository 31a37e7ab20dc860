//! What every surface receives from one replicate, added up impact by impact.

use std::collections::BTreeMap;

use super::impulses::Impulses;
use crate::jet::{Replicate, ShotSample};
use crate::objective::{ObjectiveAccumulator, Tally};
use crate::problem::setting::Settings;
use crate::scenario::Scenario;
use crate::scene::lanes::LANES;
use crate::trace::{End, Observer, RayPacket, Tracer};

/// Statistics of one replicate.
pub(super) struct ReplicateStats {
    /// Of the jet.
    pub tally: Tally,
    /// Of the boundary samples, which nothing else here counts.
    pub boundary: Tally,
    /// First hits on target that stick.
    pub sticking: usize,
    /// Impacts of all paths.
    pub impacts: usize,
    /// One for each surface of the scene.
    pub surfaces: Vec<SurfaceSums>,
    pub ends: BTreeMap<End, usize>,
}

/// What a surface received off target.
#[derive(Clone, Default)]
pub(super) struct SurfaceSums {
    /// Shots that hit it.
    pub shots: usize,
    /// Shots with an impact over what it may take.
    pub over: usize,
    pub impacts_by_number: Vec<usize>,
    pub over_by_number: Vec<usize>,
    /// N*, N s.
    pub normal_impulses: Impulses,
}

impl ReplicateStats {
    /// Traces the shots of some settings.
    pub fn of(scenario: &Scenario, settings: &Settings, replicate: &Replicate) -> Self {
        let shots = &replicate.jet.shots;
        let mut accumulator = ReplicateAccumulator {
            scenario,
            objective: ObjectiveAccumulator::new(
                scenario,
                settings.contact,
                settings.speed,
                shots.len(),
            ),
            sticking: 0,
            impacts: 0,
            surfaces: vec![SurfaceSums::default(); scenario.surfaces.len()],
            ends: BTreeMap::new(),
            seen: Marks::new(scenario.surfaces.len()),
            seen_over: Marks::new(scenario.surfaces.len()),
        };
        let tracer = Tracer::new(scenario, settings, settings.speed);
        tracer.fire(shots, &mut accumulator);
        Self {
            tally: accumulator.objective.finish(),
            boundary: Tally::trace(
                scenario,
                settings,
                settings.speed,
                &replicate.boundary.shots,
            ),
            sticking: accumulator.sticking,
            impacts: accumulator.impacts,
            surfaces: accumulator.surfaces,
            ends: accumulator.ends,
        }
    }
}

/// Impulses that are kept one by one, 16 MB: more than those of the 2048 shots in each set of a
/// usual evaluation, however long their paths are.
const MOST_KEPT: usize = 1 << 21;

/// Adds up what the shots of a replicate do.
struct ReplicateAccumulator<'a> {
    scenario: &'a Scenario,
    objective: ObjectiveAccumulator,
    sticking: usize,
    impacts: usize,
    surfaces: Vec<SurfaceSums>,
    ends: BTreeMap<End, usize>,
    /// The surfaces that each shot of the packet has hit off target.
    seen: Marks,
    /// Those on which it has exceeded what they may take.
    seen_over: Marks,
}

impl ReplicateAccumulator<'_> {
    #[cold]
    fn keep_no_more(&mut self) {
        for sums in &mut self.surfaces {
            sums.normal_impulses.count_in_classes();
        }
    }
}

impl Observer for ReplicateAccumulator<'_> {
    fn impacts(&mut self, packet: &RayPacket) {
        self.objective.impacts(packet);
        for i in (0..packet.rays.count).filter(|&i| packet.impacts.counts[i] != 0.0) {
            let number = packet.number[i] as usize;
            self.impacts += 1;
            if self.impacts == MOST_KEPT {
                self.keep_no_more();
            }
            if self.objective.is_on_target(i) {
                self.sticking += usize::from(number == 1 && packet.impacts.sticks[i] != 0.0);
                continue;
            }
            let (shot, surface) = (packet.shot[i] as usize, packet.hits.surface[i] as usize);
            let normal_impulse = packet.impacts.normal[i];
            let allow = self.scenario.surfaces[surface].allow;
            let sums = &mut self.surfaces[surface];
            count_at(&mut sums.impacts_by_number, number);
            sums.normal_impulses.push(normal_impulse);
            sums.shots += usize::from(self.seen.mark(shot, surface));
            if allow.is_some_and(|allow| normal_impulse > allow) {
                count_at(&mut sums.over_by_number, number);
                sums.over += usize::from(self.seen_over.mark(shot, surface));
            }
        }
    }

    fn ends(&mut self, _: usize, end: End, _: usize) {
        *self.ends.entry(end).or_insert(0) += 1;
    }

    fn packet_ends(&mut self, shots: &[ShotSample], rays: usize) {
        self.objective.packet_ends(shots, rays);
        self.seen.clear();
        self.seen_over.clear();
    }
}

/// Counts one more at a 1-based place.
fn count_at(counts: &mut Vec<usize>, number: usize) {
    if counts.len() < number {
        counts.resize(number, 0);
    }
    counts[number - 1] += 1;
}

/// A mark for each shot of a packet and each surface.
struct Marks {
    bits: Vec<u64>,
    words: usize,
}

impl Marks {
    fn new(surfaces: usize) -> Self {
        let words = surfaces.div_ceil(u64::BITS as usize);
        Self {
            bits: vec![0; words * LANES],
            words,
        }
    }

    fn clear(&mut self) {
        self.bits.fill(0);
    }

    /// Sets a mark; tells whether it is new.
    fn mark(&mut self, shot: usize, surface: usize) -> bool {
        let bits = u64::BITS as usize;
        let word = &mut self.bits[shot * self.words + surface / bits];
        let bit = 1 << (surface % bits);
        let is_new = *word & bit == 0;
        *word |= bit;
        is_new
    }
}
