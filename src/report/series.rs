//! Searches and other methods, as series of points that belong together.

use crate::chart::{BesidePoint, Method, Searches, median};
use crate::report::number::{count, plain};

/// A method with more and more effort.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// What it is.
    pub name: String,
    /// Whether it is another method than the search.
    pub is_beside: bool,
    /// By effort.
    pub groups: Vec<Group>,
}

/// Runs of a method with the same effort.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// The effort.
    pub label: String,
    /// Whether the problem file asks for it.
    pub is_picked: bool,
    /// Time in s, and by how much the answer is above the best known, relative to it.
    pub points: Vec<(f64, f64)>,
}

impl Series {
    /// The searches by accuracy, those by shots, then the other methods in the order of their table.
    pub fn of(searches: &Searches, accuracy: f64) -> Vec<Self> {
        let by_accuracy = |method: &Method| matches!(method, Method::Accuracy(_));
        let mut series = vec![
            Self::of_runs(
                "search until J is this accurate (solve --accuracy)",
                searches,
                accuracy,
                by_accuracy,
            ),
            Self::of_runs(
                "the same search, ended at this number of shots, however inaccurate",
                searches,
                accuracy,
                |method| !by_accuracy(method),
            ),
        ];
        for point in &searches.beside {
            Self::add(&mut series, point);
        }
        series.retain(|series| !series.groups.is_empty());
        series
    }

    /// All points.
    pub fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        self.groups
            .iter()
            .flat_map(|group| group.points.iter().copied())
    }

    fn of_runs(
        name: &str,
        searches: &Searches,
        accuracy: f64,
        belongs: impl Fn(&Method) -> bool,
    ) -> Self {
        let mut groups: Vec<Group> = Vec::new();
        for run in searches.runs.iter().filter(|run| belongs(&run.method)) {
            let label = effort(&run.method);
            let group = Group::labelled(&mut groups, &label);
            group.is_picked = run.method == Method::Accuracy(accuracy);
            group.points.push((run.seconds, run.excess));
        }
        Self {
            name: name.into(),
            is_beside: false,
            groups,
        }
    }

    fn add(series: &mut Vec<Self>, point: &BesidePoint) {
        let index = series.iter().position(|one| one.name == point.method);
        let index = index.unwrap_or_else(|| {
            series.push(Self {
                name: point.method.clone(),
                is_beside: true,
                groups: Vec::new(),
            });
            series.len() - 1
        });
        let group = Group::labelled(&mut series[index].groups, &point.speed);
        group.points.push((point.seconds, point.excess));
    }
}

/// How much a method was told to do.
pub fn effort(method: &Method) -> String {
    match method {
        Method::Accuracy(accuracy) => format!("{} %", plain(accuracy * 100.0)),
        Method::MostShots(shots) => format!("{} shots", count(*shots)),
    }
}

impl Group {
    fn labelled<'a>(groups: &'a mut Vec<Self>, label: &str) -> &'a mut Self {
        let index = groups.iter().position(|group| group.label == label);
        let index = index.unwrap_or_else(|| {
            groups.push(Self {
                label: label.into(),
                is_picked: false,
                points: Vec::new(),
            });
            groups.len() - 1
        });
        &mut groups[index]
    }

    /// The largest excess.
    pub fn worst(&self) -> f64 {
        let excesses = self.points.iter().map(|point| point.1);
        excesses.fold(f64::NEG_INFINITY, f64::max)
    }

    /// Medians of time and excess.
    pub fn median(&self) -> (f64, f64) {
        let middle = |part: fn(&(f64, f64)) -> f64| median(self.points.iter().map(part).collect());
        (middle(|point| point.0), middle(|point| point.1))
    }
}
