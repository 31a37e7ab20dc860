//! The table of a map.

use std::fmt::Display;
use std::io;

use super::{Rows, Table, or_empty};
use crate::record::{MapRecord, MapTerm};

/// A row for each place; without figures where nothing is known.
pub(super) fn table(name: &'static str, map: &MapRecord) -> io::Result<Table> {
    let settings = [map.x.setting.as_str(), &map.y.setting];
    let terms = MapTerm::ALL.map(MapTerm::name);
    let columns = [
        &settings[..],
        &terms,
        &["share_sticking", "passes", "fails"],
    ]
    .concat();
    let mut table = Rows::headed(name, &columns)?;
    let rows = map.cells.chunks(map.x.values.len().max(1));
    for (y, row) in map.y.values.iter().zip(rows) {
        for (x, cell) in map.x.values.iter().zip(row) {
            let named = |index: &u32| map.subjects.get(*index as usize).cloned();
            let fails: Vec<String> = cell.fails.iter().filter_map(named).collect();
            // Records keep seven digits.
            let terms = MapTerm::ALL.map(|term| or_empty(term.of(cell).map(|value| value as f32)));
            let sticking = or_empty(cell.share_sticking);
            let passes = or_empty(cell.is_known().then(|| cell.passes()));
            let fails = fails.join(" ");
            let mut cells: Vec<&dyn Display> = vec![x, y];
            cells.extend(terms.iter().map(|term| term as &dyn Display));
            cells.extend([&sticking as &dyn Display, &passes, &fails]);
            table.row(&cells)?;
        }
    }
    table.finish()
}
