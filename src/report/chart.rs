//! A chart in words and numbers.

use crate::chart::{Chart, Effect, Leaks, PoseCurve, Sampling, Searches};
use crate::report::figure::curve_name;
use crate::report::finding::{self, rounded_time, share, signed_share};
use crate::report::layout::{Align, Block, Table};
use crate::report::number::{Scale, count, significant};
use crate::report::series::{Group, Series};
use crate::report::sheet::setting::SETTINGS;

/// The chart as text.
pub fn chart(chart: &Chart) -> String {
    let blocks = [
        Some(head(chart)),
        poses(chart),
        walls(chart),
        chart
            .searches
            .as_ref()
            .map(|searches| self::searches(chart, searches)),
        effects(&chart.effects),
        Some(reproduce(chart)),
    ];
    let texts: Vec<String> = blocks.into_iter().flatten().map(Block::into_text).collect();
    texts.join("\n")
}

fn head(chart: &Chart) -> Block {
    let mut block = Block::titled("SPEED AGAINST ACCURACY");
    block.paragraph(&chart.title);
    block.paragraph(&chart.file);
    block.gap();
    let settings = chart.recommended.settings;
    let pose = SETTINGS[..3].iter();
    let pose = pose.map(|it| format!("{} {}", it.name, it.text_with_unit(&settings)));
    let pose: Vec<String> = pose.collect();
    block.hanging(
        "settings   ",
        &format!(
            "{}, {}, speed {} m/s",
            chart.recommended.contact,
            pose.join(", "),
            significant(settings.speed_m_s, 3),
        ),
    );
    let reference = chart.reference;
    let scale = Scale::for_error(reference.objective, reference.standard_error);
    block.hanging(
        "reference  ",
        &format!(
            "J0 = {} there, from {} Sobol shots in double precision",
            scale.with_error(reference.objective, reference.standard_error),
            count(reference.shots),
        ),
    );
    if chart.interrupted {
        block.hanging("            ", "interrupted: not everything was measured");
    }
    block
}

/// The errors by shots, for every way to draw them.
fn poses(chart: &Chart) -> Option<Block> {
    let first = chart.poses.first()?;
    let mut block = Block::titled("J OF ONE POSE: how well it is known after how much time");
    block.paragraph(&finding::of_poses(chart));
    block.gap();
    let curve = |sampling: Sampling| {
        let is_it = |curve: &&PoseCurve| curve.sampling == sampling && curve.walls == first.walls;
        chart.poses.iter().find(is_it)
    };
    let mut table = Table::new(&[
        ("  shots", Align::Right),
        ("time", Align::Right),
        ("random", Align::Right),
        ("Sobol", Align::Right),
        ("Sobol, with boundary samples", Align::Right),
    ]);
    for (index, point) in first.points.iter().enumerate() {
        let errors = Sampling::ALL.map(|sampling| {
            let point = curve(sampling).and_then(|curve| curve.points.get(index));
            point.map_or_else(String::new, |point| share(point.error))
        });
        table.row(
            [count(point.shots), rounded_time(point.seconds)]
                .into_iter()
                .chain(errors),
        );
    }
    block.table(table);
    block.paragraph(&format!(
        "Root mean square error of J, relative to J0; {}; one thread. With boundary samples: as the search draws \
         shots before it has an importance density, one in two or, of 2048 and more, three in four towards the \
         boundary. It ended with \
         {} shots at each pose.",
        curve_name(first),
        count(chart.recommended.shots_per_pose),
    ));
    Some(block)
}

/// What walls change and cost.
fn walls(chart: &Chart) -> Option<Block> {
    let sampling = chart.poses.last()?.sampling;
    let is_of_it = |curve: &&PoseCurve| curve.sampling == sampling;
    let curves: Vec<&PoseCurve> = chart.poses.iter().filter(is_of_it).collect();
    let [first, _, ..] = curves[..] else {
        return None;
    };
    let seconds = |curve: &PoseCurve| curve.points.last().map_or(f64::NAN, |point| point.seconds);
    let mut table = Table::new(&[
        ("WALLS", Align::Left),
        ("time", Align::Right),
        ("J changes by", Align::Right),
        ("+- std. error", Align::Right),
        ("rays lost at edges", Align::Right),
    ]);
    for curve in &curves {
        table.row([
            curve_name(curve),
            share(seconds(curve) / seconds(first)),
            signed_share(curve.bias),
            share(curve.bias_standard_error),
            curve.leaks.map_or_else(String::new, leaks),
        ]);
    }
    let mut block = Block::default();
    block.table(table);
    Some(block)
}

fn leaks(leaks: Leaks) -> String {
    format!("{} of {}", count(leaks.missed), count(leaks.aimed))
}

fn searches(chart: &Chart, searches: &Searches) -> Block {
    let mut block = Block::titled("SEARCH: how good the answer is after how much time");
    block.paragraph(&finding::of_searches(chart, searches));
    for series in Series::of(searches, chart.accuracy) {
        block.gap();
        block.paragraph(&format!("{}:", series.name));
        let mut table = Table::new(&[
            ("", Align::Left),
            ("time", Align::Right),
            ("above the best known", Align::Right),
            ("worst", Align::Right),
        ]);
        for group in &series.groups {
            let (seconds, excess) = group.median();
            table.row([
                label(group),
                rounded_time(seconds),
                share(excess),
                share(group.worst()),
            ]);
        }
        block.table(table);
    }
    block.gap();
    block.paragraph(&format!(
        "Medians over seeds, {} threads. J of all answers on {} common validation shots; differences of {} \
         are within the noise.",
        chart.threads,
        count(searches.shots),
        share(searches.noise()),
    ));
    block
}

fn label(group: &Group) -> String {
    let mark = if group.is_picked {
        "  (the file's)"
    } else {
        ""
    };
    format!("{}{mark}", group.label)
}

fn effects(effects: &[Effect]) -> Option<Block> {
    if effects.is_empty() {
        return None;
    }
    let mut block = Block::titled("EFFECTS: what leaving one out changes and saves");
    block.paragraph(&finding::of_effects(effects));
    block.gap();
    let mut table = Table::new(&[
        ("  left out", Align::Left),
        ("J changes by", Align::Right),
        ("+-", Align::Right),
        ("answer worse by", Align::Right),
        ("+-", Align::Right),
        ("time", Align::Right),
    ]);
    for effect in effects {
        let [worse, error] = match effect.fits {
            true => [
                signed_share(effect.regret),
                share(effect.regret_standard_error),
            ],
            false => ["no fit".into(), "-".into()],
        };
        table.row([
            effect.name.clone(),
            signed_share(effect.change),
            share(effect.change_standard_error),
            worse,
            error,
            share(effect.relative_cost),
        ]);
    }
    block.table(table);
    block.paragraph(
        "J changes: at the recommended settings. Answer worse: J, computed with the effect, at the settings \
         that a search without it recommends; no fit: the nozzle does not fit there. +-: standard errors. \
         Time: for a pose, of that with the effect.",
    );
    Some(block)
}

fn reproduce(chart: &Chart) -> Block {
    let mut block = Block::titled("REPRODUCE");
    block.verbatim(&chart.command);
    block.verbatim(&format!("problem sha256  {}", chart.problem_sha256));
    block.verbatim(&format!(
        "peenpose        {}, seed {}",
        chart.version, chart.seed
    ));
    block.paragraph("Times are this machine's; every other number is the same on each run.");
    block
}
