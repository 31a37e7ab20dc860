//! All reports on a result, as files.

use std::io;

use rayon::prelude::*;

use super::figure::Figure;
use super::map::MAPS;
use super::page::page_with;
use super::program;
use super::sheet;
use super::table::Table;
use crate::record::Record;

/// Names of all files that any record may lead to.
pub fn names() -> impl Iterator<Item = String> {
    const TABLES: [&str; 11] = [
        "surfaces",
        "verdicts",
        "choices",
        "windows",
        "pose",
        "hits",
        "rebounds",
        "places",
        MAPS[0],
        MAPS[1],
        "trade_off",
    ];
    const FIGURES: [&str; 5] = ["stroke", "hits", MAPS[0], MAPS[1], "trade_off"];
    let tables = TABLES.map(|name| format!("{name}.csv"));
    let figures = FIGURES.map(|name| ["png", "svg"].map(|ending| format!("{name}.{ending}")));
    let texts = ["sheet.txt", "report.html"].map(str::to_owned);
    texts
        .into_iter()
        .chain(program::NAMES.map(str::to_owned))
        .chain(tables)
        .chain(figures.into_iter().flatten())
}

/// Every report that can be made from a record, by the name of its file; `result.json` itself is not
/// among them. The same record gives the same bytes.
///
/// # Errors
/// None is expected: reports are written to memory.
pub fn files(record: &Record) -> io::Result<Vec<(String, Vec<u8>)>> {
    let mut files = vec![("sheet.txt".to_owned(), sheet(record).into_bytes())];
    for Table { name, csv } in Table::of_record(record)? {
        files.push((format!("{name}.csv"), csv.into_bytes()));
    }
    let figures = Figure::of_record(record).map_err(io::Error::other)?;
    // Pixels take as long as all else.
    let (pixels, page): (Vec<_>, _) = rayon::join(
        || figures.par_iter().map(Figure::png).collect(),
        || page_with(record, &figures),
    );
    let page = page.map_err(io::Error::other)?;
    files.push(("report.html".to_owned(), page.into_bytes()));
    if let Some(stroke) = &record.stroke {
        files.extend(program::files(stroke, 1)?);
    }
    for (figure, png) in figures.into_iter().zip(pixels) {
        let png = png.map_err(io::Error::other)?;
        files.push((format!("{}.png", figure.name), png));
        files.push((format!("{}.svg", figure.name), figure.svg.into_bytes()));
    }
    Ok(files)
}
