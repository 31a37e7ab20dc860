//! Sheets, pages, figures, charts and exports.

#[path = "../common/mod.rs"]
mod common;

mod chart;
mod evidence;
mod export;
mod report_page;
mod sheet;
mod strokes;
