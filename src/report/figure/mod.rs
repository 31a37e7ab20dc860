//! Figures, drawn from a chart or a record alone: SVG with texts, and PNG with the embedded font.
//!
//! This module is the only one that knows plotters, resvg and the ramps of colours.

mod axis;
mod effect;
mod hits;
mod linear;
mod plot;
mod png;
mod pose;
mod search;
mod sheet;
mod style;

pub(super) use axis::time;
pub(super) use pose::curve_name;

use crate::chart::Chart;
use crate::record::Record;

/// A figure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Figure {
    /// Name of its files, without ending.
    pub name: &'static str,
    /// The figure as SVG.
    pub svg: String,
}

/// Why a figure cannot be drawn.
#[derive(Debug)]
pub struct FigureFault(String);

impl Figure {
    /// The figures of a chart, each if there is something to show in it.
    ///
    /// # Errors
    /// None is expected: figures are written into memory.
    pub fn of_chart(chart: &Chart) -> Result<Vec<Self>, FigureFault> {
        Self::present([
            ("pose", pose::svg(chart)),
            ("search", search::svg(chart)),
            ("effect", effect::svg(chart)),
        ])
    }

    /// The figures of a record, each if there is something to show in it.
    ///
    /// # Errors
    /// None is expected: figures are written into memory.
    pub fn of_record(record: &Record) -> Result<Vec<Self>, FigureFault> {
        let hits = record
            .evidence
            .as_ref()
            .and_then(|evidence| hits::svg(record, evidence));
        Self::present([("hits", hits)])
    }

    /// What was drawn, by name.
    fn present<const N: usize>(
        drawn: [(&'static str, Option<Result<String, sheet::Fault>>); N],
    ) -> Result<Vec<Self>, FigureFault> {
        let present = drawn
            .into_iter()
            .filter_map(|(name, svg)| Some((name, svg?)));
        present
            .map(|(name, svg)| {
                svg.map(|svg| Self { name, svg })
                    .map_err(|fault| FigureFault::new(name, &fault))
            })
            .collect()
    }

    /// The figure as PNG.
    ///
    /// # Errors
    /// None is expected: the SVG is our own.
    pub fn png(&self) -> Result<Vec<u8>, FigureFault> {
        png::png(&self.svg).map_err(|fault| FigureFault::new(self.name, &fault))
    }
}

impl FigureFault {
    fn new(figure: &str, fault: &dyn std::fmt::Display) -> Self {
        Self(format!("cannot draw the figure `{figure}`: {fault}"))
    }
}

impl std::fmt::Display for FigureFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for FigureFault {}
