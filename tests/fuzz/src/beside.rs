//! Tables of other methods: what is read is sensible and can be shown, all else is refused with its
//! line.

use std::sync::LazyLock;

use peenpose::chart::{
    BesideFault, BesidePoint, Chart, LONGEST_NAME, MOST_METHODS, MOST_RUNS, Plan, measure,
};
use peenpose::report;
use peenpose::report::figure::Figure;
use peenpose::report::table::Table;

use super::solve::sound;

/// Longest complaint about a line, however long that is.
const LONGEST_COMPLAINT: usize = 200;

/// A chart of the shipped problem that is solved soonest, beside which the points are shown; without
/// what has nothing to do with them.
static CHART: LazyLock<Chart> = LazyLock::new(|| {
    let (scenario, source) = sound(include_str!("../../../problems/plate.yaml"));
    let plan = Plan {
        most_shots: 64,
        seeds: 1,
        ..Plan::default()
    };
    let command = "peenpose chart any.yaml".into();
    let chart = measure(&scenario, &source, command, Vec::new(), &plan);
    Chart {
        poses: Vec::new(),
        effects: Vec::new(),
        ..chart.expect("there is an answer")
    }
});

pub fn run(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    match BesidePoint::read_all(&text) {
        Ok(points) => {
            are_sensible(&points, &text);
            let written = written(&points);
            assert_eq!(BesidePoint::read_all(&written).as_ref(), Ok(&points));
            can_be_shown(points, &text);
        }
        Err(fault) => is_told(&fault, &text),
    }
}

fn are_sensible(points: &[BesidePoint], text: &str) {
    assert!(points.len() < text.lines().count(), "{text:?}");
    assert!(points.len() <= MOST_RUNS);
    for point in points {
        assert!((1e-9..=1e9).contains(&point.seconds), "{point:?}");
        assert!((-1.0..=1e15).contains(&point.excess), "{point:?}");
        assert!(!point.method.is_empty(), "{point:?}");
        for name in [&point.method, &point.speed] {
            assert!(text.contains(name.as_str()) && name.trim() == name);
            assert!(name.chars().count() <= LONGEST_NAME, "{point:?}");
            assert!(!name.contains(|c: char| c.is_control() || ",\"".contains(c)));
        }
    }
    let mut methods: Vec<&str> = points.iter().map(|point| point.method.as_str()).collect();
    methods.sort_unstable();
    methods.dedup();
    assert!(methods.len() <= MOST_METHODS);
}

/// The same points as a table.
fn written(points: &[BesidePoint]) -> String {
    let row = |point: &BesidePoint| {
        let BesidePoint {
            method,
            speed,
            seconds,
            excess,
        } = point;
        format!("{method},{speed},{seconds:e},{excess}\n")
    };
    let rows: String = points.iter().map(row).collect();
    format!("method,speed,seconds,excess\n{rows}")
}

fn is_told(fault: &BesideFault, text: &str) {
    let lines = text.lines().count();
    assert!(
        (1..=lines.max(1)).contains(&fault.line),
        "{fault} of {lines}"
    );
    assert!(!fault.message.is_empty());
    let complaint = fault.to_string();
    assert!(complaint.starts_with(&format!("{}: ", fault.line)));
    assert!(
        complaint.chars().count() <= LONGEST_COMPLAINT,
        "{complaint}"
    );
    assert!(!complaint.contains(char::is_control), "{complaint:?}");
}

fn can_be_shown(points: Vec<BesidePoint>, text: &str) {
    let mut chart = CHART.clone();
    let searches = chart.searches.as_mut().expect("nothing stopped it");
    searches.beside = points;
    let json = chart.to_json().expect("every number is finite");
    let back = Chart::from_json(&json).expect("what was written can be read");
    assert!(back == chart, "{json}");
    assert!(!report::chart(&chart).is_empty());
    assert!(Table::of_chart(&chart).is_ok());
    for figure in Figure::of_chart(&chart).expect("figures are drawn in memory") {
        assert!(text.contains("NaN") || !figure.svg.contains("NaN"));
        // Pixels take most of the time: in some cases only.
        if text.len().is_multiple_of(16) {
            assert!(figure.png().is_ok());
        }
    }
}
