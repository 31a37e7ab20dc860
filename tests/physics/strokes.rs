//! What a moving nozzle covers, against a Monte Carlo that shares nothing with the program but the problem.

use std::path::Path;

use peenpose::control::Control;
use peenpose::study::{Extras, Study};

/// A generator of its own (PCG, 64 bits of state).
struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let word = ((self.0 >> 22) ^ self.0) >> (22 + (self.0 >> 61));
        f64::from(word as u32) / f64::from(u32::MAX)
    }

    /// Within +- a half-width.
    fn within(&mut self, half_width: f64) -> f64 {
        half_width * (2.0 * self.uniform() - 1.0)
    }
}

/// Of the floor, m.
const LENGTH: f64 = 40e-3;

/// First hits on the floor of the keyway, x and z in m: a flat floor at y = 18.3 mm that a jet from below meets, and nothing
/// in its way.
fn hit(random: &mut Random, [incidence, azimuth, standoff]: [f64; 3], z: f64) -> [f64; 2] {
    let incidence = incidence + random.within(2_f64.to_radians());
    let azimuth = azimuth + random.within(2_f64.to_radians());
    let standoff = standoff + random.within(1e-3);
    // Azimuth 0 is z, and 90 deg is across: z x (-y) = x.
    let axis = [
        incidence.cos() * azimuth.sin(),
        incidence.sin(),
        incidence.cos() * azimuth.cos(),
    ];
    let side = [azimuth.cos(), 0.0, -azimuth.sin()];
    let up = [
        side[1] * axis[2] - side[2] * axis[1],
        side[2] * axis[0] - side[0] * axis[2],
        side[0] * axis[1] - side[1] * axis[0],
    ];
    let (radius, turn) = (
        2.5e-3 * random.uniform().sqrt(),
        std::f64::consts::TAU * random.uniform(),
    );
    let exit = [radius * turn.cos(), radius * turn.sin()];
    let cosine = 1.0 - random.uniform() * (1.0 - 4_f64.to_radians().cos());
    let sine = (1.0 - cosine * cosine).sqrt();
    let turn = std::f64::consts::TAU * random.uniform();
    let cone = [sine * turn.cos(), sine * turn.sin()];
    let along = |k: usize| axis[k] * cosine + side[k] * cone[0] + up[k] * cone[1];
    let from = |k: usize| side[k] * exit[0] + up[k] * exit[1] - axis[k] * standoff;
    // The centre of a shot of 0.5 mm comes that near to the floor.
    let way = (-0.5e-3 - from(1)) / along(1);
    let (x, z) = (from(0) + along(0) * way, z + from(2) + along(2) * way);
    // Beyond an end of the floor a shot may still touch its edge.
    let edge = z.clamp(0.0, LENGTH);
    let (off, ahead) = (edge - z, [along(1), along(2)]);
    let length = ahead[0].hypot(ahead[1]);
    let passes_at = (0.5e-3 * ahead[1] - off * ahead[0]).abs() / length;
    let touches = edge == z || passes_at < 0.5e-3;
    [
        x,
        if touches {
            edge.min(LENGTH * (1.0 - 1e-12))
        } else {
            z
        },
    ]
}

#[test]
fn a_stroke_covers_what_a_moving_nozzle_covers() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("problems");
    let study = Study::open(&folder.join("keyway-stroke.yaml")).unwrap();
    let record = study.solve(Extras::default(), &Control::default()).unwrap();
    let (stroke, coverage) = (record.stroke.unwrap(), record.coverage.unwrap());
    let settings = stroke.segments[0].settings.settings();
    let pose = [settings.incidence, settings.azimuth, settings.standoff];
    let dented = stroke.dented.unwrap();
    // What is fired is what flows while it travels.
    let [before, after] = stroke.run_outs.unwrap().map(|it| it.length_m);
    let way = before + stroke.length_m + after;
    let mass = 0.1 / 60.0 * way / stroke.feed_m_s.unwrap();
    assert!((dented.mass_kg / mass - 1.0).abs() < 1e-9);

    const SHOTS: usize = 6_000_000;
    // The floor of 5 mm x 40 mm in the cells of the program's map.
    let map = stroke.dented_map.unwrap();
    let (along, across) = (map.columns, map.dented.len() / map.columns);
    let sides = [5e-3 / across as f64, LENGTH / along as f64];
    assert!((map.sides_m[0] / sides[1] - 1.0).abs() < 1e-9);
    let mut counts = vec![0_u32; along * across];
    let mut random = Random(7);
    for _ in 0..SHOTS {
        let z = 4e-3 - before + way * random.uniform();
        let [x, z] = hit(&mut random, pose, z);
        let (column, row) = ((x + 2.5e-3) / sides[0], z / sides[1]);
        if (0.0..across as f64).contains(&column) && (0.0..along as f64).contains(&row) {
            counts[row as usize * across + column as usize] += 1;
        }
    }
    let on_target: u32 = counts.iter().sum();
    let mean = f64::from(on_target) / SHOTS as f64 / (5e-3 * 40e-3);
    let found = coverage.mean.hits_per_shot_m2;
    assert!((mean / found - 1.0).abs() < 0.005, "{mean} {found}");

    // What that dents, as many shots as are fired: on the mean, and where it is dented least.
    let fired = dented.mass_kg * coverage.shots_per_kg;
    let dent = std::f64::consts::PI * 0.25e-3 * 0.25e-3 / 4.0;
    let share = |count: u32, area: f64| {
        1.0 - (-dent * fired * f64::from(count) / SHOTS as f64 / area).exp()
    };
    let shares = counts
        .iter()
        .map(|&count| share(count, sides[0] * sides[1]));
    let mean = shares.sum::<f64>() / counts.len() as f64;
    let off = (mean - dented.mean).abs();
    assert!(off < 0.01, "{mean} {}", dented.mean);
    assert!(off < 3.0 * dented.mean_standard_error + dented.mean_resolution + 1e-3);
    // The cell that is dented least, and for the feed the least dense 5 % of the floor.
    counts.sort_unstable();
    let least = share(counts[0], sides[0] * sides[1]);
    let off = (least - dented.least).abs();
    assert!(off < 0.01, "{least} {}", dented.least);
    let lowest = f64::from(counts[counts.len() / 20]) / SHOTS as f64 / (sides[0] * sides[1]);
    let needed = -(0.02_f64).ln() / dent / lowest;
    let feed = 0.1 / 60.0 * way * coverage.shots_per_kg / needed;
    let found = stroke.feed_m_s.unwrap();
    assert!((feed / found - 1.0).abs() < 0.02, "{feed} {found}");
}
