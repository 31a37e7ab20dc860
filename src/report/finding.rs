//! What a chart shows, in a sentence each.

use crate::chart::{Chart, Effect, PoseCurve, Sampling, Searches, Walls};
use crate::elementary::{ln, log10, power, whole_power};
use crate::report::number::{Scale, count, plain, time};
use crate::report::series::Series;

/// How the ways to draw shots and to model walls compare, at the middle of all errors seen.
pub fn of_poses(chart: &Chart) -> String {
    let curve = |sampling| chart.poses.iter().find(|curve| curve.sampling == sampling);
    let mut findings = Vec::new();
    if let Some((random, sobol)) = curve(Sampling::Random).zip(curve(Sampling::Sobol))
        && let Some((error, fewer)) = savings(random, sobol)
    {
        findings.push(format!(
            "an error of {} takes {} times as many shots when they are plainly random as from scrambled Sobol points",
            share(error),
            plain(rounded(fewer, 2)),
        ));
    }
    let of_the_search = || {
        let is_it = |curve: &&PoseCurve| curve.sampling == Sampling::SobolRim;
        chart.poses.iter().filter(is_it)
    };
    let is_facets = |curve: &&PoseCurve| matches!(curve.walls, Walls::Facets { .. });
    if let Some((exact, coarse)) = of_the_search().next().zip(of_the_search().find(is_facets)) {
        findings.push(format!(
            "the coarsest mesh takes {} times as long as exact walls and changes J by {}",
            plain(rounded(seconds(coarse) / seconds(exact), 2)),
            bias(coarse),
        ));
    }
    let mut text = findings.join("; ");
    if let Some(first) = text.get(..1).map(str::to_uppercase) {
        text.replace_range(..1, &first);
        text.push('.');
    }
    text
}

/// By how much a way changes J, as far as that is known.
fn bias(curve: &PoseCurve) -> String {
    match (curve.bias.abs(), 2.0 * curve.bias_standard_error) {
        (0.0, 0.0) => "nothing".into(),
        (bias, noise) if bias > noise => share(bias),
        (_, noise) => format!("less than {}", share(noise).trim_start_matches('<')),
    }
}

/// Time for the most shots, s.
fn seconds(curve: &PoseCurve) -> f64 {
    curve.points.last().map_or(f64::NAN, |point| point.seconds)
}

/// The least error that both reach, rounded up to a power of ten, and how many times fewer shots
/// the second takes for it.
fn savings(many: &PoseCurve, few: &PoseCurve) -> Option<(f64, f64)> {
    let errors = |curve: &PoseCurve| {
        let errors = curve.points.iter().map(|point| point.error);
        errors.fold(f64::INFINITY, f64::min)
    };
    let error = whole_power(10.0, log10(errors(many).max(errors(few))).ceil() as i32);
    Some((error, shots_for(many, error)? / shots_for(few, error)?))
}

/// The shots with which a curve gets below an error for the first time, between its points along
/// straight lines of the figure.
fn shots_for(curve: &PoseCurve, error: f64) -> Option<f64> {
    let mut pairs = curve.points.windows(2);
    let pair = pairs.find(|pair| pair[0].error >= error && pair[1].error <= error)?;
    let [from, to] = [pair[0].shots as f64, pair[1].shots as f64];
    let fraction = ln(pair[0].error / error) / ln(pair[0].error / pair[1].error);
    Some(from * power(to / from, fraction))
}

/// How good the answer is with the accuracy that the file asks for.
pub fn of_searches(chart: &Chart, searches: &Searches) -> String {
    let series = Series::of(searches, chart.accuracy);
    let picked = series
        .iter()
        .flat_map(|series| &series.groups)
        .find(|group| group.is_picked);
    let Some(picked) = picked else {
        return String::new();
    };
    let (seconds, excess) = picked.median();
    format!(
        "Asked for {}, as in the file, the answer is {} above the best known (J = {}) after {}: medians of {} seeds.",
        picked.label,
        share(excess),
        objective(searches.best_known.objective),
        rounded_time(seconds),
        count(picked.points.len()),
    )
}

/// Which effect matters most for the answer, and without which the nozzle does not fit.
pub fn of_effects(effects: &[Effect]) -> String {
    let matters =
        |effect: &&Effect| effect.fits && effect.regret > 2.0 * effect.regret_standard_error;
    let misfit = effects.iter().find(|effect| !effect.fits);
    let worst = effects
        .iter()
        .filter(matters)
        .max_by(|a, b| a.regret.total_cmp(&b.regret));
    let mut sentences = Vec::new();
    if let Some(worst) = worst {
        sentences.push(format!(
            "Without {}, J at the recommended settings changes by {}, and the answer found is {} worse.",
            worst.name,
            signed_share(worst.change),
            share(worst.regret),
        ));
    }
    if let Some(misfit) = misfit {
        sentences.push(format!(
            "Without {}, an answer is found at which the nozzle does not fit.",
            misfit.name
        ));
    }
    if sentences.is_empty() {
        sentences.push("The answer is as good without any one of these effects.".into());
    }
    sentences.join(" ")
}

/// J with four digits.
pub fn objective(value: f64) -> String {
    Scale::for_error(value, 0.0).text(value)
}

/// Smaller shares, in percent, are not worth their digits.
const LEAST_PERCENT: f64 = 0.001;

/// A share in percent, two or three significant digits.
pub fn share(share: f64) -> String {
    let percent = share * 100.0;
    if percent != 0.0 && percent.abs() < LEAST_PERCENT {
        return format!("<{LEAST_PERCENT} %");
    }
    let digits = if percent.abs() < 100.0 { 2 } else { 3 };
    let rounded = rounded(percent, digits);
    if rounded.abs() > 9999.0 {
        let sign = if rounded < 0.0 { "-" } else { "" };
        return format!("{sign}{} %", count(rounded.abs() as usize));
    }
    format!("{} %", plain(rounded))
}

/// The same with its sign.
pub fn signed_share(value: f64) -> String {
    let text = share(value);
    let sign = if value > 0.0 && !text.starts_with('<') {
        "+"
    } else {
        ""
    };
    format!("{sign}{text}")
}

/// A measured time with its unit, two significant digits.
pub fn rounded_time(seconds: f64) -> String {
    time(rounded(seconds, 2))
}

/// A value rounded to significant digits, before the point too.
fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits - 1).parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_and_times_have_few_digits() {
        assert_eq!(share(0.000_934), "0.093 %");
        assert_eq!(share(121.049), "12 100 %");
        assert_eq!(signed_share(-0.538), "-54 %");
        assert_eq!(signed_share(3.3e-9), "<0.001 %");
        assert_eq!(signed_share(7.87), "+787 %");
        assert_eq!(rounded_time(0.816_148), "820 ms");
    }
}
