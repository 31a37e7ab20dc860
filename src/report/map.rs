//! A map with what stands round it: its axes in the units of the sheet, what is held, what it says.

use super::layout::Block;
use super::number::{count, fixed, plain, significant};
use super::sheet::setting::SETTINGS;
use crate::elementary::extremes;
use crate::record::{AnswerRecord, AxisRecord, MapRecord, MapTerm, QuestionRecord};

/// Names of the files of a record's maps, without ending.
pub(super) const MAPS: [&str; 2] = ["map_1", "map_2"];

/// A map, the problem that it belongs to, and the settings round which it was made.
#[derive(Clone, Copy, Debug)]
pub struct MapView<'a> {
    /// The map.
    pub map: &'a MapRecord,
    /// The problem.
    pub problem: &'a QuestionRecord,
    /// The settings.
    pub answer: &'a AnswerRecord,
    /// Whether those on the axes are worth a mark: not where they only fill in.
    pub marks_settings: bool,
}

/// An axis in the unit of the sheet.
pub(super) struct AxisView {
    pub name: &'static str,
    pub unit: &'static str,
    pub values: Vec<f64>,
    /// The value round which the map was made.
    pub at: f64,
    /// How exactly a shop sets that, half-width.
    pub tolerance: f64,
    decimals: usize,
}

impl AxisView {
    fn new(view: &MapView, axis: &AxisRecord) -> Self {
        let answer = view.answer;
        let Some(setting) = SETTINGS.iter().find(|setting| setting.key == axis.setting) else {
            let mu_s = answer.contact_values.mu_s;
            return Self {
                name: "static friction",
                unit: "",
                values: axis.values.clone(),
                at: mu_s,
                tolerance: view.problem.tolerance.friction * mu_s,
                decimals: 3,
            };
        };
        let at = setting.value(&answer.settings);
        let shown = |value: &f64| value * setting.scale();
        Self {
            name: setting.name,
            unit: setting.unit,
            values: axis.values.iter().map(shown).collect(),
            at,
            tolerance: setting.half_width_at(at, &view.problem.tolerance),
            decimals: setting.decimals,
        }
    }

    /// Name and unit.
    pub fn title(&self) -> String {
        match self.unit {
            "" => self.name.into(),
            unit => format!("{}, {unit}", self.name),
        }
    }

    /// A value with its name and unit.
    fn value(&self, value: f64) -> String {
        let text = format!(
            "{} {} {}",
            self.name,
            fixed(value, self.decimals),
            self.unit
        );
        text.trim_end().into()
    }

    /// Two values with their name and unit.
    fn range(&self, [low, high]: [f64; 2]) -> String {
        let [low, high] = [low, high].map(|end| fixed(end, self.decimals));
        format!("{} {low} to {high} {}", self.name, self.unit)
            .trim_end()
            .into()
    }
}

impl MapView<'_> {
    /// Both axes, the lower one first.
    pub(super) fn axes(&self) -> [AxisView; 2] {
        [&self.map.x, &self.map.y].map(|axis| AxisView::new(self, axis))
    }

    /// What the map shows: `J over incidence and azimuth`.
    pub(super) fn title(&self, term: MapTerm) -> String {
        let [x, y] = self.axes();
        format!("{} over {} and {}", quantity(term), x.name, y.name)
    }

    /// The settings that are held.
    pub(super) fn held(&self) -> String {
        let is_axis = |key: &str| {
            [&self.map.x, &self.map.y]
                .iter()
                .any(|it| it.setting == key)
        };
        let settings = &self.answer.settings;
        let mut held: Vec<String> = SETTINGS
            .iter()
            .filter(|setting| !is_axis(setting.key))
            .filter(|it| !it.key.starts_with("aim") || it.value(settings) != 0.0)
            .map(|it| format!("{} {}", it.name, it.text_with_unit(settings)))
            .collect();
        held.push(format!("contact {}", self.answer.contact));
        held.join(", ")
    }

    /// How many places it shows.
    pub(super) fn extent(&self) -> String {
        let shots = match self.map.shots {
            1 => "1 shot".into(),
            shots => format!("{} shots", count(shots)),
        };
        let (columns, rows) = (self.map.x.values.len(), self.map.y.values.len());
        let known = self.map.known_places();
        let part = if known < self.map.cells.len() {
            let [known, all] = [known, self.map.cells.len()].map(count);
            format!("; stopped when {known} of {all} were known")
        } else {
            String::new()
        };
        format!("{columns} x {rows} settings, {shots} at each{part}")
    }

    /// The place with the least value, and that value.
    fn least(&self, term: MapTerm) -> Option<([f64; 2], f64)> {
        let values = self.map.cells.iter().map(|cell| term.of(cell)).enumerate();
        let known = values.filter_map(|(index, value)| Some((index, value?)));
        let (index, value) = known.min_by(|a, b| a.1.total_cmp(&b.1))?;
        Some((self.place(index), value))
    }

    fn place(&self, index: usize) -> [f64; 2] {
        let [x, y] = self.axes();
        let columns = x.values.len();
        [x.values[index % columns], y.values[index / columns]]
    }

    /// Where every verdict passes: the share of the places where the nozzle fits, and the box
    /// round them.
    fn passing(&self) -> Option<(f64, [[f64; 2]; 2])> {
        let passing = self.map.cells.iter().enumerate();
        let places: Vec<[f64; 2]> = passing
            .filter(|(_, cell)| cell.passes())
            .map(|(index, _)| self.place(index))
            .collect();
        let fitting = self.map.cells.iter().filter(|cell| cell.terms.is_some());
        let ends = |axis: usize| {
            let (low, high) = extremes(places.iter().map(|place| place[axis]));
            [low, high]
        };
        let share = places.len() as f64 / fitting.count().max(1) as f64;
        (!places.is_empty()).then(|| (share, [ends(0), ends(1)]))
    }
}

/// What a term is called.
pub(super) fn quantity(term: MapTerm) -> String {
    match term {
        MapTerm::Total => "J".into(),
        part => format!("{} (part of J)", part.name()),
    }
}

/// What a map says, in words.
pub fn map(view: &MapView, term: MapTerm) -> String {
    let mut block = Block::titled(&format!("MAP  {}", view.title(term)));
    let mut line = |label: &str, text: &str| block.hanging(&format!("{label:<10} "), text);
    let [x, y] = view.axes();
    line("problem", &view.problem.title);
    line("held", &view.held());
    line("places", &view.extent());
    let Some(([at_x, at_y], least)) = view.least(term) else {
        let is_whole = view.map.known_places() == view.map.cells.len();
        let everywhere = if is_whole {
            "everywhere"
        } else {
            "at each of them"
        };
        line(
            "fits",
            &format!("nowhere: the nozzle is too near to the part {everywhere}"),
        );
        return block.into_text();
    };
    let place = format!("{}, {}", x.value(at_x), y.value(at_y));
    let name = match term {
        MapTerm::Total => "J",
        part => part.name(),
    };
    let mut values = view.map.cells.iter().filter_map(|cell| term.of(cell));
    let place = if values.all(|value| value == least) {
        "wherever the nozzle fits".into()
    } else {
        format!("at {place}")
    };
    line(
        "least",
        &format!("{name} {} {place}", significant(least, 3)),
    );
    let cells = &view.map.cells;
    let blocked = cells.iter().filter(|cell| cell.is_blocked()).count();
    let of_which = if blocked > 0 {
        " where the nozzle fits"
    } else {
        ""
    };
    let passing = view.passing().map_or_else(
        || "nowhere: at every place some verdict fails".into(),
        |(share, [in_x, in_y])| {
            format!(
                "every verdict at {} % of the places{of_which}, within {}, {}",
                plain((share * 1000.0).round() / 10.0),
                x.range(in_x),
                y.range(in_y)
            )
        },
    );
    line("passes", &passing);
    if blocked > 0 {
        let share = blocked as f64 / view.map.known_places() as f64 * 100.0;
        line(
            "no room",
            &format!("for the nozzle at {} % of the places", fixed(share, 1)),
        );
    }
    block.into_text()
}
