//! Points of the unit cube: each a pure function of (index, dimension, seed).

use super::importance::{Cells, ImportanceDensity, NO_CELL};
use super::quantile::deviation;
use crate::elementary::{ln, sin_cos};

/// A coordinate of a point of a scrambled Sobol sequence, from 0 to below 1. Points repeat after 2^16, and there are 256
/// coordinates.
pub(crate) fn sobol(index: u32, axis: u32, seed: u32) -> f64 {
    f64::from(sobol_burley::sample(index, axis, seed))
}

/// An independent sequence of samples under one seed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// Shots of the search.
    Search,
    /// Shots that the search has not seen: a replicate for each number.
    Validation(u32),
}

impl Stream {
    /// Its own seed under a common one.
    fn seed(self, seed: u64) -> u64 {
        let number = match self {
            Self::Search => 0,
            Self::Validation(number) => 1 + u64::from(number),
        };
        mix(mix(seed) ^ number)
    }
}

/// Sample dimensions, those that matter most first: low dimensions are the most uniform.
#[derive(Clone, Copy)]
pub(super) enum Dimension {
    ConeAngle,
    ConeTurn,
    ExitRadius,
    ExitTurn,
    Incidence,
    Azimuth,
    SpeedScatter,
    SpeedSetting,
    Standoff,
    Restitution,
    Friction,
    Size,
    AimAlong,
    AimAcross,
    AimAbove,
    Tilts,
    Place,
}

/// How many there are.
pub(super) const DIMENSIONS: usize = 17;

/// The density that points are drawn with.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Proposal {
    /// As the jet fires shots.
    Nominal,
    /// Towards the boundary.
    Boundary,
    /// Towards the boundary, and there with an importance density.
    Importance,
}

/// Points of one replicate before it repeats itself.
const POINTS_PER_SEED: u32 = 1 << 16;

/// Share of a normal distribution between its mean and two standard deviations.
const BELOW_TWO_DEVIATIONS: f64 = 0.477_249_868_051_820_8;

/// One point of the unit cube.
pub(super) struct QmcPoint<'a> {
    sequence: Sequence,
    by: Proposal,
    importance: &'a ImportanceDensity,
    /// That of its components which it is drawn with.
    component: usize,
    /// Whether the next fields are kept up.
    keeps_account: bool,
    /// Density of the boundary proposal over that of the jet, so far.
    pub boundary_density: f64,
    /// Its cells in the coordinates in which the boundary proposal is uniform.
    pub cells: Cells,
}

/// Where the coordinates of a point come from.
enum Sequence {
    /// Sobol's points, scrambled; four dimensions at a time, as far as they have been asked for.
    Sobol {
        index: u32,
        seed: u32,
        known: [Option<[f32; 4]>; 5],
    },
    /// SplitMix64, for each coordinate on its own.
    Random { seed: u64 },
}

/// Keeps the density finite on the boundary itself: the square root of a depth.
const LEAST_ROOT: f64 = 1e-9;

impl<'a> QmcPoint<'a> {
    /// A point of a proposal in a mixture.
    pub fn new(
        seed: u64,
        stream: Stream,
        index: u32,
        by: Proposal,
        importance: &'a ImportanceDensity,
    ) -> Self {
        let block = u64::from(index / POINTS_PER_SEED);
        let set = match by {
            Proposal::Nominal => 0,
            Proposal::Boundary => 1,
            Proposal::Importance => 2,
        };
        let mixed = mix(mix(stream.seed(seed) ^ block) ^ set);
        let mut sequence = Sequence::Sobol {
            index: index % POINTS_PER_SEED,
            seed: (mixed >> 32) as u32,
            known: [None; 5],
        };
        let component = match by == Proposal::Importance && importance.is_mixed() {
            true => importance.component(sequence.coordinate(DIMENSIONS as u32)),
            false => 0,
        };
        Self {
            by,
            importance,
            component,
            keeps_account: true,
            ..Self::of(sequence)
        }
    }

    /// A point of the nominal proposal.
    pub fn of_jet(seed: u64, stream: Stream, index: u32) -> Self {
        Self {
            keeps_account: false,
            ..Self::new(
                seed,
                stream,
                index,
                Proposal::Nominal,
                &ImportanceDensity::NONE,
            )
        }
    }

    /// The same, independent of all others.
    pub fn random(seed: u64, stream: Stream, index: u32) -> Self {
        Self::of(Sequence::Random {
            seed: mix(stream.seed(seed) ^ u64::from(index)),
        })
    }

    fn of(sequence: Sequence) -> Self {
        Self {
            sequence,
            by: Proposal::Nominal,
            importance: &ImportanceDensity::NONE,
            component: 0,
            keeps_account: false,
            boundary_density: 1.0,
            cells: [NO_CELL; DIMENSIONS],
        }
    }

    /// Uniform in 0 to 1, but for an importance density.
    pub fn uniform(&mut self, dimension: Dimension) -> f64 {
        let uniform = self.sequence.coordinate(dimension as u32);
        let drawn = match self.by {
            Proposal::Importance => self.importance.drawn(self.component, dimension, uniform),
            Proposal::Nominal | Proposal::Boundary => uniform,
        };
        self.cells[dimension as usize] = ImportanceDensity::cell(drawn);
        drawn
    }

    /// In 0 to 1, with the boundary at 1.
    pub fn inwards(&mut self, dimension: Dimension) -> f64 {
        let depth = 1.0 - self.uniform(dimension);
        1.0 - self.towards_boundary(depth, |root| 1.0 - root, dimension)
    }

    /// Within +- `half_width`, with the boundary at both ends.
    pub fn within(&mut self, half_width: f64, dimension: Dimension) -> f64 {
        if half_width == 0.0 {
            return 0.0;
        }
        let signed = 2.0 * self.uniform(dimension) - 1.0;
        let coordinate = |root: f64| 0.5 + 0.5 * (1.0 - root).copysign(signed);
        let depth = self.towards_boundary(1.0 - signed.abs(), coordinate, dimension);
        half_width * (1.0 - depth).copysign(signed)
    }

    /// The distance of this point from the boundary, which is uniform in 0 to 1 for the jet's own points; keeps
    /// account of the density and of the cell.
    fn towards_boundary(
        &mut self,
        depth: f64,
        coordinate: impl Fn(f64) -> f64,
        dimension: Dimension,
    ) -> f64 {
        // The square of a uniform variable crowds at 0, with density depth^(-1/2) / 2.
        let (depth, root) = match (self.by, self.keeps_account) {
            (Proposal::Boundary | Proposal::Importance, _) => (depth * depth, depth),
            (Proposal::Nominal, true) => (depth, depth.sqrt()),
            (Proposal::Nominal, false) => return depth,
        };
        self.boundary_density /= 2.0 * root.max(LEAST_ROOT);
        self.cells[dimension as usize] = ImportanceDensity::cell(coordinate(root));
        depth
    }

    /// 1 plus a normal deviate with standard deviation `spread`, cut at two of them.
    pub fn scatter(&mut self, spread: f64, dimension: Dimension) -> f64 {
        if spread == 0.0 {
            return 1.0;
        }
        let share = BELOW_TWO_DEVIATIONS * (2.0 * self.uniform(dimension) - 1.0);
        1.0 + spread * deviation(share)
    }
}

impl Sequence {
    /// Uniform in 0 to 1.
    fn coordinate(&mut self, dimension: u32) -> f64 {
        match self {
            Self::Sobol { index, seed, known } => {
                let set = dimension / 4;
                let four = known[set as usize]
                    .get_or_insert_with(|| sobol_burley::sample_4d(*index, set, *seed));
                f64::from(four[dimension as usize % 4])
            }
            Self::Random { seed } => random(*seed, dimension),
        }
    }
}

/// Two independent standard normal deviates, a pure function of a number and of a count.
pub(crate) fn normal_pair(number: f64, count: u32) -> [f64; 2] {
    let seed = mix(number.to_bits() ^ mix(u64::from(count)));
    let radius = (-2.0 * ln(1.0 - random(seed, 0))).sqrt();
    let (sin, cos) = sin_cos(std::f64::consts::TAU * random(seed, 1));
    [radius * cos, radius * sin]
}

/// Uniform in 0 to 1 (SplitMix64): the upper 53 bits, which is what f64 holds.
fn random(seed: u64, dimension: u32) -> f64 {
    (mix(seed ^ u64::from(dimension)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// Spreads the bits of a seed (the finaliser of SplitMix64).
fn mix(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}
