//! The objective, its best speed, its errors, and the samples behind it.

use crate::common::cases::cases;
use peenpose::evaluate::{Evaluation, evaluate};
use peenpose::impact::{Regime, Restitution};
use peenpose::jet::{Replicates, Samples, ShotSample, Stream};
use peenpose::objective::{Impulses, Sums, Tally, Terms};
use peenpose::problem::Problem;
use peenpose::problem::equipment::Spread;
use peenpose::problem::goal::{Goals, TangentialImpulse};
use peenpose::problem::setting::{Range, Settings, Tolerance};
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::trace::{PathImpact, Tracer};
use proptest::prelude::*;

fn scenario(length: f64) -> Scenario {
    Scenario::new(crate::common::keyway(length), Walls::Exact).unwrap()
}

fn settings(incidence_deg: f64, azimuth_deg: f64, standoff: f64, contact: usize) -> Settings {
    Settings {
        incidence: incidence_deg.to_radians(),
        azimuth: azimuth_deg.to_radians(),
        standoff,
        speed: 10.0,
        aim_along: 0.0,
        aim_across: 0.0,
        aim_above: 0.0,
        contact,
        static_friction: 0.0,
    }
}

/// Settings all over the range: good ones, ones that hit walls, ones that miss.
fn choices() -> Vec<Settings> {
    let mut choices = Vec::new();
    for incidence in [30.0, 45.0, 67.0, 85.0] {
        for azimuth in [-80.0, 0.0, 35.0] {
            for (standoff, contact) in [(6e-3, 0), (9e-3, 1), (20e-3, 2)] {
                choices.push(settings(incidence, azimuth, standoff, contact));
            }
        }
    }
    choices
}

/// The least value of J in the range, without derivatives: golden sections.
fn least_by_golden_sections(tally: &Tally, goals: &Goals, range: Range) -> f64 {
    let ratio = (5.0_f64.sqrt() - 1.0) / 2.0;
    let value = |speed: f64| tally.terms(goals, speed).total();
    let (mut low, mut high) = (range.min, range.max);
    let (mut a, mut b) = (high - ratio * (high - low), low + ratio * (high - low));
    let (mut at_a, mut at_b) = (value(a), value(b));
    for _ in 0..100 {
        if at_a < at_b {
            (high, b, at_b) = (b, a, at_a);
            a = high - ratio * (high - low);
            at_a = value(a);
        } else {
            (low, a, at_a) = (a, b, at_b);
            b = low + ratio * (high - low);
            at_b = value(b);
        }
    }
    [range.min, range.max, a, b]
        .map(value)
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

/// The best speed is in the range, and no worse than what golden sections and a grid find.
fn check_best_speed(tally: &Tally, goals: &Goals, range: Range) {
    let speed = tally.best_speed(goals, range);
    assert!(range.contains(speed), "{speed}");
    let least = tally.terms(goals, speed).total();
    let golden = least_by_golden_sections(tally, goals, range);
    assert!(
        (least - golden).abs() <= 1e-9 * golden.abs() + 1e-15,
        "{least} {golden}"
    );
    for step in 0..=200 {
        let other = tally
            .terms(goals, range.at(f64::from(step) / 200.0))
            .total();
        assert!(
            least <= other + 1e-12 * other.abs(),
            "{least} at {speed}, {other}"
        );
    }
}

#[test]
fn the_best_speed_of_traced_shots_is_the_least_of_j() {
    for length in [40e-3, 200e-3] {
        let scenario = scenario(length);
        let goals = &scenario.problem.goals;
        let samples = Samples::with_boundary(&scenario.problem, Stream::Search, 1000);
        for settings in choices() {
            let tally = Tally::trace(&scenario, &settings, 1.0, &samples.shots);
            for (min, max) in [
                (5.0, 40.0),
                (0.01, 1000.0),
                (1.0, 2.0),
                (30.0, 31.0),
                (12.0, 12.0),
            ] {
                check_best_speed(&tally, goals, Range { min, max });
            }
        }
    }
}

#[test]
fn the_best_speed_does_not_need_hits_or_limits() {
    let mut goals = crate::common::keyway(0.04).goals;
    let range = Range {
        min: 5.0,
        max: 40.0,
    };
    let nothing = Tally {
        shots: 10,
        weight: 10.0,
        missed: 10.0,
        ..Tally::default()
    };
    check_best_speed(&nothing, &goals, range);
    let only_rebounds = Tally {
        rebound: 3.0,
        ..nothing
    };
    assert_eq!(only_rebounds.best_speed(&goals, range), 5.0);
    check_best_speed(&only_rebounds, &goals, range);
    goals.tangential_impulse = None;
    goals.rebound = None;
    let hit = Impulses {
        normal: 4e-6,
        normal_at_mean: 4e-6,
        tangential: 9e-6,
        weight: 1.0,
        of_jet: 1.0,
    };
    let one = Tally {
        shots: 1,
        weight: 1.0,
        hits: [hit].into_iter().collect(),
        ..Tally::default()
    };
    // 40 uN s at 4 uN s per m/s.
    assert!((one.best_speed(&goals, range) - 10.0).abs() < 1e-12);
}

fn impulses() -> impl Strategy<Value = Impulses> {
    let shot = (0.01..2.0_f64, prop::sample::select(vec![0.0, 1.0]));
    let factors = 0.5..1.5_f64;
    (0.0..10e-6_f64, factors, 0.0..10e-6_f64, shot).prop_map(
        |(normal_at_mean, factor, tangential, (weight, of_jet))| Impulses {
            normal: factor * normal_at_mean,
            normal_at_mean,
            tangential,
            weight,
            of_jet,
        },
    )
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn the_best_speed_of_any_tally_is_the_least_of_j(
        hits in prop::collection::vec(impulses(), 0..600),
        missed in 0.0..100.0_f64,
        rebound in prop_oneof![Just(0.0), 1e-9..1e3_f64],
        speed_variance in prop_oneof![Just(0.0), 1e-6..0.3_f64],
        limit in prop::option::of((-8.0..-4.0_f64).prop_map(|digits| 10_f64.powf(digits))),
        weights in [0.0..3.0_f64, 0.0..3.0_f64],
        min in 0.01..20.0_f64,
        width in 0.0..100.0_f64,
    ) {
        let weight = missed + hits.iter().map(|hit| hit.weight).sum::<f64>();
        prop_assume!(weight > 0.0);
        let tally = Tally { shots: hits.len() + 1, weight, missed, hits: hits.into_iter().collect(), rebound, speed_variance, ..Tally::default() };
        let mut goals = crate::common::keyway(0.04).goals;
        goals.normal_impulse.weight = weights[0];
        goals.tangential_impulse =
            limit.map(|limit| TangentialImpulse { limit, share: 0.05, weight: weights[1] });
        check_best_speed(&tally, &goals, Range { min, max: min + width });
    }
}

/// The mean over factors on the speed that scatter by 5 %, cut at two deviations, by Simpson's rule.
fn mean_over_speeds(of_factor: &dyn Fn(f64) -> f64, _: f64) -> f64 {
    const STEPS: u32 = 1000;
    let (mut sum, mut weight) = (0.0, 0.0);
    for step in 0..=STEPS {
        let deviation = f64::from(step) / f64::from(STEPS) * 4.0 - 2.0;
        let part = match step {
            0 | STEPS => 1.0,
            odd if odd % 2 == 1 => 4.0,
            _ => 2.0,
        };
        let density = part * (-0.5 * deviation * deviation).exp();
        sum += density * of_factor(1.0 + 0.05 * deviation);
        weight += density;
    }
    sum / weight
}

#[test]
fn terms_follow_from_the_impacts_as_defined() {
    // By hand, shot by shot, from the definition of the objective: each path at all the speeds that the
    // shot may have, but for what exceeds a limit.
    let scenario = scenario(40e-3);
    for settings in choices() {
        check_terms(
            &scenario,
            &settings,
            mean_over_speeds,
            &[settings.speed, 1.0],
        );
    }
}

#[test]
fn where_paths_depend_on_the_speed_every_shot_has_its_own() {
    let mut scenario = scenario(40e-3);
    for contact in &mut scenario.problem.contacts {
        contact.contact.restitution = Restitution::Falling {
            reference: 0.25,
            speed: 5.0,
            exponent: 0.25,
        };
    }
    for settings in choices() {
        let own = |of_factor: &dyn Fn(f64) -> f64, factor: f64| of_factor(factor);
        check_terms(&scenario, &settings, own, &[settings.speed]);
    }
}

/// Terms by hand, where `mean` averages over the factors on the speed of a shot that has one of them.
fn check_terms(
    scenario: &Scenario,
    settings: &Settings,
    mean: impl Fn(&dyn Fn(f64) -> f64, f64) -> f64,
    traced_at: &[f64],
) {
    let problem = &scenario.problem;
    let goals = &problem.goals;
    let limit = goals.tangential_impulse.unwrap();
    let rebound = goals.rebound.unwrap();
    let mut samples = Samples::new(problem, Stream::Validation(3), 500);
    // As if drawn towards the rim.
    for sample in samples.shots.iter_mut().step_by(3) {
        (sample.weight, sample.of_jet) = (0.5, false);
    }
    let tracer = Tracer::new(scenario, settings, settings.speed);
    let (mut normal, mut tangential, mut harm) = (0.0, 0.0, 0.0);
    let (mut weight, mut hits, mut hits_of_jet) = (0.0, 0.0, 0.0);
    let mut rays = 0;
    for sample in &samples.shots {
        let mut path: Vec<PathImpact> = Vec::new();
        let (_, of_path) = tracer.follow(sample, |impact| path.push(*impact));
        rays += of_path;
        weight += sample.weight;
        assert!(
            path.iter()
                .enumerate()
                .all(|(index, impact)| impact.number == index + 1)
        );
        let over_own = |factor: f64| factor / sample.speed;
        if let Some(first) = path.first().filter(|first| first.on_target) {
            hits += sample.weight;
            if sample.of_jet {
                hits_of_jet += 1.0;
                let impulse = first.normal_impulse / goals.normal_impulse.target;
                normal += mean(&|s| (impulse * over_own(s) - 1.0).powi(2), sample.speed);
            }
            let excess = first.tangential_impulse / limit.limit - 1.0;
            tangential += sample.weight * excess.max(0.0).powi(2);
        }
        for impact in path.iter().filter(|impact| !impact.on_target) {
            let impulse = impact.normal_impulse / rebound.allow;
            harm += sample.weight * mean(&|s| (impulse * over_own(s)).powi(2), sample.speed);
        }
    }
    let share = |sum: f64, hits: f64| if hits > 0.0 { sum / hits } else { 0.0 };
    let expected = Terms {
        normal_impulse: goals.normal_impulse.weight * share(normal, hits_of_jet),
        tangential_impulse: limit.weight * share(tangential, hits),
        rebound: rebound.weight * harm / weight,
        miss: goals.miss.weight * (weight - hits) / weight,
    };
    // Traced at this speed, and at another one with the impulses scaled.
    for &traced_at in traced_at {
        let tally = Tally::trace(scenario, settings, traced_at, &samples.shots);
        assert_eq!((tally.shots, tally.rays), (samples.shots.len(), rays));
        let found = tally.terms(goals, settings.speed);
        for part in [
            |t: &Terms| t.normal_impulse,
            |t: &Terms| t.tangential_impulse,
            |t: &Terms| t.rebound,
            |t: &Terms| t.miss,
            Terms::total,
        ] {
            let (found, expected) = (part(&found), part(&expected));
            assert!(
                (found - expected).abs() <= 1e-9 * expected + 1e-15,
                "{found} {expected}"
            );
        }
        let sum = found.normal_impulse + found.tangential_impulse + found.rebound + found.miss;
        assert_eq!(found.total(), sum);
    }
}

#[test]
fn an_evaluation_counts_what_every_surface_receives() {
    let scenario = scenario(40e-3);
    let goals = &scenario.problem.goals;
    for settings in [
        settings(45.0, 35.0, 9e-3, 1),
        settings(35.0, 80.0, 15e-3, 0),
    ] {
        let validation = Replicates::new(&scenario.problem, 7, 32 * 100);
        let found = evaluate(&scenario, &settings, &validation);
        let tracer = Tracer::new(&scenario, &settings, settings.speed);
        let mut paths: Vec<Vec<PathImpact>> = Vec::new();
        for samples in &validation.sets {
            for sample in &samples.jet.shots {
                let mut path = Vec::new();
                tracer.follow(sample, |impact| path.push(*impact));
                paths.push(path);
            }
        }
        assert_eq!(found.shots, paths.len());
        assert!((found.ends.values().sum::<f64>() - 1.0).abs() < 1e-12);
        let count =
            |holds: &dyn Fn(&[PathImpact]) -> bool| paths.iter().filter(|path| holds(path)).count();
        let first = |path: &[PathImpact]| path.first().copied().filter(|first| first.on_target);
        let target = &found.target;
        assert_eq!(target.hits, count(&|path| first(path).is_some()));
        let off = |impulse: f64| (impulse / goals.normal_impulse.target - 1.0).abs() > 0.15;
        let is_off = |path: &[PathImpact]| first(path).is_some_and(|i| off(i.normal_impulse));
        assert_eq!(target.off_target, count(&is_off));
        let sticks = |path: &[PathImpact]| first(path).is_some_and(|i| i.regime == Regime::Stick);
        assert_eq!(target.sticking, count(&sticks));
        for (index, receipt) in found.surfaces.iter().enumerate() {
            let on_it = |i: &PathImpact| !i.on_target && i.surface as usize == index;
            let is_over = |i: &PathImpact| on_it(i) && i.normal_impulse > 10e-6;
            assert_eq!(receipt.shots, count(&|path| path.iter().any(on_it)));
            assert_eq!(receipt.over, count(&|path| path.iter().any(is_over)));
            for number in 1..=6 {
                let with = |impact: &dyn Fn(&PathImpact) -> bool| {
                    let impacts = paths.iter().flatten();
                    impacts.filter(|i| i.number == number && impact(i)).count()
                };
                let at = |counts: &[usize]| counts.get(number - 1).copied().unwrap_or(0);
                assert_eq!(at(&receipt.impacts_by_number), with(&on_it));
                assert_eq!(at(&receipt.over_by_number), with(&is_over));
            }
            let mut impulses: Vec<f64> = paths
                .iter()
                .flatten()
                .copied()
                .filter(on_it)
                .map(|impact| impact.normal_impulse)
                .collect();
            impulses.sort_unstable_by(f64::total_cmp);
            assert_eq!(
                receipt.normal_impulse.largest,
                impulses.last().copied().unwrap_or(0.0)
            );
            let below = impulses.partition_point(|&i| i < receipt.normal_impulse.high) as f64;
            let share = below / impulses.len().max(1) as f64;
            assert!(
                impulses.len() < 100 || (share - 0.95).abs() < 0.02,
                "{share}"
            );
        }
    }
}

#[test]
fn the_reported_error_covers_the_scatter_of_independent_evaluations() {
    let scenario = scenario(40e-3);
    // One with many kinds of events, one where a few per cent miss, one near the optimum, where no shot
    // does harm: what the worst could do is far more than the scatter there.
    for (settings, most) in [
        (settings(45.0, 35.0, 9e-3, 1), 5.0),
        (settings(40.0, 80.0, 15e-3, 0), 5.0),
        (settings(67.0, 0.0, 8e-3, 2), f64::INFINITY),
    ] {
        let evaluations: Vec<_> = (0..30)
            .map(|number| {
                evaluate(
                    &scenario,
                    &settings,
                    &Replicates::new(&scenario.problem, 100 + number, 2048),
                )
            })
            .collect();
        // With 29 degrees of freedom the scatter itself is uncertain by 13 %.
        let check = |value: fn(&Evaluation) -> f64, error: fn(&Evaluation) -> f64, most: f64| {
            let mean = evaluations.iter().map(value).sum::<f64>() / 30.0;
            let deviations = evaluations.iter().map(|it| (value(it) - mean).powi(2));
            let scatter = (deviations.sum::<f64>() / 29.0).sqrt();
            let squares: f64 = evaluations.iter().map(|it| error(it).powi(2)).sum();
            let ratio = (squares / 30.0).sqrt() / scatter;
            assert!(ratio > 0.6 && ratio < most, "{settings:?}: {ratio}");
        };
        check(|it| it.terms.total(), |it| it.standard_error, most);
        check(
            |it| it.terms.normal_impulse,
            |it| it.term_errors.normal_impulse,
            1.6,
        );
    }
}

/// J of independent streams of samples: mean and its standard error.
fn mean_objective(
    scenario: &Scenario,
    settings: &Settings,
    draw: impl Fn(u32) -> Samples,
) -> (f64, f64) {
    const STREAMS: u32 = 32;
    let goals = &scenario.problem.goals;
    let sums: Vec<Sums> = (0..STREAMS)
        .map(|number| {
            let tally = Tally::trace(scenario, settings, settings.speed, &draw(number).shots);
            tally.sums(goals, settings.speed)
        })
        .collect();
    let totals: Vec<f64> = sums.iter().map(|sums| sums.terms(goals).total()).collect();
    let mean = totals.iter().sum::<f64>() / f64::from(STREAMS);
    let squares: f64 = totals.iter().map(|total| (total - mean).powi(2)).sum();
    let error = (squares / f64::from(STREAMS * (STREAMS - 1))).sqrt();
    let pooled = sums.iter().fold(Sums::default(), |all, one| all.plus(one));
    (pooled.terms(goals).total(), error)
}

#[test]
fn rim_shots_estimate_the_same_objective() {
    let mut problem = crate::common::keyway(40e-3);
    for tolerance in [
        Tolerance::default(),
        Tolerance {
            incidence: 0.03,
            azimuth: 0.03,
            standoff: 1e-3,
            speed: 0.03,
            restitution: 0.1,
            ..Tolerance::default()
        },
    ] {
        problem.tolerance = tolerance;
        let scenario = Scenario::new(problem.clone(), Walls::Exact).unwrap();
        for settings in [
            settings(67.0, 0.0, 8e-3, 2),
            settings(45.0, 35.0, 9e-3, 1),
            settings(40.0, 80.0, 15e-3, 0),
        ] {
            let problem = &scenario.problem;
            let (plain, plain_error) = mean_objective(&scenario, &settings, |number| {
                Samples::new(problem, Stream::Validation(number), 2048)
            });
            let (boundary, rim_error) = mean_objective(&scenario, &settings, |number| {
                Samples::with_boundary(problem, Stream::Validation(number), 2048)
            });
            let error = plain_error.hypot(rim_error);
            assert!(
                (plain - boundary).abs() < 4.0 * error,
                "{plain} {boundary} +- {error}"
            );
        }
    }
}

#[test]
fn rim_weights_average_to_one() {
    let mut problem = crate::common::keyway(40e-3);
    problem.tolerance.incidence = 0.03;
    let weights: Vec<f64> = weights_of(&Samples::with_boundary(&problem, Stream::Search, 1 << 15));
    let mean = weights.iter().sum::<f64>() / weights.len() as f64;
    assert!((mean - 1.0).abs() < 0.01, "{mean}");
    assert!(weights.iter().all(|&weight| weight > 0.0 && weight <= 4.0));
    // Every second shot is drawn to the rim, of many three out of four, and stands for less.
    for (count, turn) in [(64, 2), (1024, 2), (2048, 4), (1 << 15, 4)] {
        let shots = Samples::with_boundary(&problem, Stream::Search, count).shots;
        let is_of_jet = |(index, shot): (usize, &ShotSample)| shot.of_jet == (index % turn == 0);
        assert!(shots.iter().enumerate().all(is_of_jet), "{count}");
        let average = |of_jet: bool| {
            let chosen = shots.iter().filter(|shot| shot.of_jet == of_jet);
            chosen.clone().map(|shot| shot.weight).sum::<f64>() / chosen.count() as f64
        };
        let (jet, boundary) = (average(true), average(false));
        assert!(boundary < 0.9 * jet, "{count}: {jet} {boundary}");
    }
    // Without anything that has a rim all shots are alike.
    problem.tolerance = Tolerance::default();
    problem.jet.exit_diameter = 0.0;
    problem.jet.divergence = 0.0;
    let weights = weights_of(&Samples::with_boundary(&problem, Stream::Search, 64));
    assert!(weights.iter().all(|&weight| weight == 1.0));
}

fn weights_of(samples: &Samples) -> Vec<f64> {
    samples.shots.iter().map(|sample| sample.weight).collect()
}

#[test]
fn samples_are_pure_functions_of_their_number() {
    let problem = crate::common::keyway(40e-3);
    for draw in [Samples::new, Samples::with_boundary] {
        let long = draw(&problem, Stream::Validation(5), 70_000).shots;
        let short = draw(&problem, Stream::Validation(5), 3000).shots;
        assert_eq!(long[..3000], short);
        assert_ne!(draw(&problem, Stream::Validation(6), 3000).shots, short);
        assert_ne!(draw(&problem, Stream::Search, 3000).shots, short);
        // The sequence does not start again after 2^16 points.
        assert_ne!(long[1 << 16..][..1000], long[..1000]);
    }
}

fn mean(samples: &Samples, value: impl Fn(&ShotSample) -> f64) -> f64 {
    let weighted = samples
        .shots
        .iter()
        .map(|sample| sample.weight * value(sample));
    let weight: f64 = samples.shots.iter().map(|sample| sample.weight).sum();
    weighted.sum::<f64>() / weight
}

/// Both kinds of samples must have these moments, the second kind by its weights.
fn with_both(problem: &Problem, check: impl Fn(&Samples)) {
    check(&Samples::new(problem, Stream::Validation(0), 1 << 14));
    check(&Samples::with_boundary(
        problem,
        Stream::Validation(0),
        1 << 16,
    ));
}

fn near(found: f64, expected: f64, slack: f64) {
    assert!((found - expected).abs() <= slack, "{found}, not {expected}");
}

#[test]
fn directions_fill_the_cone_uniformly_in_solid_angle() {
    let mut problem = crate::common::keyway(40e-3);
    for half_angle in [0.5_f64, 4.0, 60.0].map(f64::to_radians) {
        problem.jet.divergence = half_angle;
        with_both(&problem, |samples| {
            let versine = 1.0 - half_angle.cos();
            for sample in &samples.shots {
                let [x, y, z] = sample.cone;
                near(x * x + y * y + z * z, 1.0, 1e-14);
                assert!(1.0 - z <= versine * (1.0 + 1e-9));
            }
            // 1 - cos is uniform from 0 to its largest value.
            near(mean(samples, |d| (1.0 - d.cone[2]) / versine), 0.5, 0.01);
            near(
                mean(samples, |d| ((1.0 - d.cone[2]) / versine).powi(2)),
                1.0 / 3.0,
                0.01,
            );
            let sine = half_angle.sin();
            near(mean(samples, |d| d.cone[0] / sine), 0.0, 0.01);
            near(mean(samples, |d| d.cone[1] / sine), 0.0, 0.01);
            near(
                mean(samples, |d| d.cone[0] * d.cone[1] / (sine * sine)),
                0.0,
                0.01,
            );
            // Where in the disc a shot starts tells nothing about its direction.
            let radius = 0.75e-3;
            for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                near(
                    mean(samples, |d| d.cone[i] * d.exit[j] / (sine * radius)),
                    0.0,
                    0.01,
                );
            }
        });
    }
}

#[test]
fn a_gaussian_cone_is_denser_inside_and_cut_at_its_edge() {
    let mut problem = crate::common::keyway(40e-3);
    problem.jet.spread = Spread::Gaussian;
    let half_angle = problem.jet.divergence;
    with_both(&problem, |samples| {
        let angle = |sample: &ShotSample| sample.cone[0].hypot(sample.cone[1]).asin();
        for sample in &samples.shots {
            assert!(angle(sample) <= half_angle * (1.0 + 1e-9));
        }
        // Shares inside one and 1.5 standard deviations of half the half-angle.
        let inside = |deviations: f64| 1.0 - (-0.5 * deviations * deviations).exp();
        for deviations in [0.5, 1.0, 1.5] {
            let share = mean(samples, |d| {
                f64::from(u8::from(angle(d) < deviations * half_angle / 2.0))
            });
            near(share, inside(deviations) / inside(2.0), 0.01);
        }
        near(mean(samples, |d| d.cone[0] / half_angle), 0.0, 0.01);
    });
}

#[test]
fn the_exit_disc_is_filled_uniformly() {
    let problem = crate::common::keyway(40e-3);
    with_both(&problem, |samples| {
        let radius = problem.jet.exit_diameter / 2.0;
        let square = |d: &ShotSample| (d.exit[0].powi(2) + d.exit[1].powi(2)) / radius.powi(2);
        assert!(
            samples
                .shots
                .iter()
                .all(|sample| square(sample) <= 1.0 + 1e-12)
        );
        near(mean(samples, square), 0.5, 0.01);
        near(mean(samples, |d| square(d).powi(2)), 1.0 / 3.0, 0.01);
        near(mean(samples, |d| (d.exit[0] / radius).powi(2)), 0.25, 0.01);
        near(
            mean(samples, |d| d.exit[0] * d.exit[1] / radius.powi(2)),
            0.0,
            0.01,
        );
    });
}

#[test]
fn scatter_is_normal_and_cut_at_two_deviations() {
    let mut problem = crate::common::keyway(40e-3);
    problem.shot.size_spread = 0.02;
    // Variance of a normal deviate cut at two: 1 - 4 phi(2) / (2 Phi(2) - 1).
    let variance = 1.0 - 4.0 * 0.053_990_966_513_188 / 0.954_499_736_103_642;
    with_both(&problem, |samples| {
        let speed = |d: &ShotSample| (d.speed - 1.0) / 0.05;
        let size = |d: &ShotSample| (d.size - 1.0) / 0.02;
        for sample in &samples.shots {
            assert!(speed(sample).abs() <= 2.0 + 1e-9 && size(sample).abs() <= 2.0 + 1e-9);
        }
        near(mean(samples, speed), 0.0, 0.02);
        near(mean(samples, |d| speed(d).powi(2)), variance, 0.02);
        near(mean(samples, size), 0.0, 0.02);
        near(mean(samples, |d| size(d).powi(2)), variance, 0.02);
        near(mean(samples, |d| speed(d) * size(d)), 0.0, 0.02);
        let largest = samples.shots.iter().map(speed).fold(0.0, f64::max);
        assert!(largest > 1.95, "{largest}");
    });
}

#[test]
fn set_up_errors_fill_their_box_uniformly() {
    let mut problem = crate::common::keyway(40e-3);
    problem.jet.speed_spread = 0.0;
    problem.tolerance = Tolerance {
        incidence: 0.03,
        azimuth: 0.02,
        standoff: 1e-3,
        aim_along: 2e-3,
        aim_across: 3e-3,
        aim_above: 0.0,
        speed: 0.03,
        restitution: 0.1,
        friction: 0.2,
    };
    with_both(&problem, |samples| {
        let errors: [fn(&ShotSample) -> f64; 8] = [
            |d| d.incidence[0].atan2(d.incidence[1]) / 0.03,
            |d| d.azimuth[0].atan2(d.azimuth[1]) / 0.02,
            |d| d.standoff / 1e-3,
            |d| d.aim[0] / 2e-3,
            |d| d.aim[1] / 3e-3,
            |d| (d.speed - 1.0) / 0.03,
            |d| d.restitution / 0.1,
            |d| (d.friction - 1.0) / 0.2,
        ];
        for (index, error) in errors.iter().enumerate() {
            assert!(samples.shots.iter().all(|d| error(d).abs() <= 1.0 + 1e-9));
            // A weighted mean over eight crowded dimensions is uncertain.
            near(mean(samples, error), 0.0, 0.05);
            near(mean(samples, |d| error(d).powi(2)), 1.0 / 3.0, 0.05);
            for other in &errors[..index] {
                near(mean(samples, |d| error(d) * other(d)), 0.0, 0.05);
            }
        }
    });
}
