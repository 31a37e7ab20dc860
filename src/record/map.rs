//! Maps in a record.

use super::answer::subject_name;
use super::evidence::{AxisRecord, CellRecord, MapRecord};
use crate::map::{Axis, Map, Place};
use crate::objective::Terms;
use crate::scenario::Scenario;

/// How a cell says that the nozzle does not fit.
const CLEARANCE: &str = "clearance";

/// What can be shown of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MapTerm {
    /// J.
    Total,
    /// See [`Terms::normal_impulse`].
    NormalImpulse,
    /// See [`Terms::tangential_impulse`].
    TangentialImpulse,
    /// See [`Terms::rebound`].
    Rebound,
    /// See [`Terms::miss`].
    Miss,
}

impl MapTerm {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Total,
        Self::NormalImpulse,
        Self::TangentialImpulse,
        Self::Rebound,
        Self::Miss,
    ];

    /// Its name on the command line and in records.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Total => "total",
            Self::NormalImpulse => "normal_impulse",
            Self::TangentialImpulse => "tangential_impulse",
            Self::Rebound => "rebound",
            Self::Miss => "miss",
        }
    }

    /// Its value in a cell; `None` where the nozzle does not fit or nothing is known.
    pub fn of(self, cell: &CellRecord) -> Option<f64> {
        let terms = cell.terms?.map(f64::from);
        Some(match self {
            Self::Total => terms.iter().sum(),
            Self::NormalImpulse => terms[0],
            Self::TangentialImpulse => terms[1],
            Self::Rebound => terms[2],
            Self::Miss => terms[3],
        })
    }
}

impl MapRecord {
    /// The record of a map.
    pub fn new(scenario: &Scenario, map: &Map) -> Self {
        let named = map.subjects.iter();
        let mut subjects: Vec<String> = named.map(|&it| subject_name(scenario, it)).collect();
        let clearance = subjects.len() as u32;
        subjects.push(CLEARANCE.into());
        let without_terms = |fails| CellRecord {
            terms: None,
            fails,
            share_sticking: None,
        };
        let cell = |place: &Place| match place {
            Place::Unknown => without_terms(Vec::new()),
            Place::Blocked => without_terms(vec![clearance]),
            Place::Open(cell) => CellRecord {
                terms: Some(rounded(&cell.terms)),
                fails: (0..)
                    .zip(&map.subjects)
                    .filter(|(_, subject)| cell.failing.contains(subject))
                    .map(|(index, _)| index)
                    .collect(),
                share_sticking: cell.share_sticking.map(|share| share as f32),
            },
        };
        Self {
            x: AxisRecord::new(&map.x),
            y: AxisRecord::new(&map.y),
            shots: map.shots,
            subjects,
            cells: map.places.iter().map(cell).collect(),
        }
    }
}

/// In the precision of a picture; what is too large for that is the largest number there is, as JSON
/// has no infinity.
fn rounded(terms: &Terms) -> [f32; 4] {
    let terms = [
        terms.normal_impulse,
        terms.tangential_impulse,
        terms.rebound,
        terms.miss,
    ];
    terms.map(|term| (term as f32).min(f32::MAX))
}

impl CellRecord {
    /// Whether anything is known of the place: it is not where a map was asked to stop before.
    pub fn is_known(&self) -> bool {
        self.terms.is_some() || !self.fails.is_empty()
    }

    /// Whether the nozzle does not fit there.
    pub fn is_blocked(&self) -> bool {
        self.terms.is_none() && self.is_known()
    }

    /// Whether every verdict passes there.
    pub fn passes(&self) -> bool {
        self.terms.is_some() && self.fails.is_empty()
    }
}

impl MapRecord {
    /// Of how many places something is known: of all, unless the map was asked to stop.
    pub fn known_places(&self) -> usize {
        self.cells.iter().filter(|cell| cell.is_known()).count()
    }
}

impl AxisRecord {
    fn new(axis: &Axis) -> Self {
        let values = axis.values.iter();
        Self {
            setting: axis.setting.record_key().into(),
            values: values.map(|&value| axis.setting.to_record(value)).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_beyond_single_precision_stay_finite() {
        let terms = Terms {
            normal_impulse: 1e60,
            tangential_impulse: 0.5,
            ..Terms::default()
        };
        assert_eq!(rounded(&terms), [f32::MAX, 0.5, 0.0, 0.0]);
    }
}
