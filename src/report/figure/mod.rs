//! Figures, drawn from a chart or a record alone: SVG with texts, and PNG with the embedded font.
//!
//! This module is the only one that knows plotters, resvg, png, base64, and the crates for contours and colours.

mod axis;
mod effect;
mod faces;
mod field;
mod front;
mod hits;
mod labels;
mod levels;
mod map;
mod marks;
mod panel;
mod png;
mod pose;
mod scale;
mod search;
mod sheet;
mod stroke;
mod style;
mod view;

pub(super) use pose::curve_name;

use super::map::{MAPS, MapView};
use crate::chart::Chart;
use crate::record::{MapTerm, Record};
use crate::scene::mesh::{Mesh, SmoothFaces};

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
        let drawn = [
            Self::named("pose", pose::svg(chart)),
            Self::named("search", search::svg(chart)),
            Self::named("effect", effect::svg(chart)),
        ];
        drawn.into_iter().filter_map(Result::transpose).collect()
    }

    /// The smooth faces of a mesh, the largest with their numbers, from two corners and cut open.
    ///
    /// # Errors
    /// None is expected: figures are written into memory.
    pub fn of_faces(mesh: &Mesh, faces: &SmoothFaces, most: usize) -> Result<Self, FigureFault> {
        Self::drawn("faces", faces::svg(mesh, faces, most))
    }

    /// The figure of a map; `None` when it has no extent.
    ///
    /// # Errors
    /// None is expected: figures are written into memory.
    pub fn of_map(view: &MapView, term: MapTerm) -> Result<Option<Self>, FigureFault> {
        Self::named("map", map::svg(view, term))
    }

    /// The figures of a record, each if there is something to show in it.
    ///
    /// # Errors
    /// None is expected: figures are written into memory.
    pub fn of_record(record: &Record) -> Result<Vec<Self>, FigureFault> {
        let evidence = record.evidence.as_ref();
        let hits = Self::named(
            "hits",
            evidence.and_then(|evidence| hits::svg(record, evidence)),
        );
        let maps = evidence.into_iter().flat_map(|evidence| &evidence.maps);
        let maps = MAPS.into_iter().zip(maps).map(|(name, map)| {
            let view = MapView {
                map,
                problem: &record.problem,
                answer: &record.best,
                marks_settings: true,
            };
            Self::named(name, map::svg(&view, MapTerm::Total))
        });
        let front = Self::named("trade_off", front::svg(record));
        let stroke = Self::named("stroke", stroke::svg(record));
        let all = [stroke, hits].into_iter().chain(maps).chain([front]);
        all.filter_map(Result::transpose).collect()
    }

    fn named(
        name: &'static str,
        svg: Option<Result<String, impl std::fmt::Display>>,
    ) -> Result<Option<Self>, FigureFault> {
        svg.map(|svg| Self::drawn(name, svg)).transpose()
    }

    fn drawn(
        name: &'static str,
        svg: Result<String, impl std::fmt::Display>,
    ) -> Result<Self, FigureFault> {
        match svg {
            Ok(svg) => Ok(Self { name, svg }),
            Err(fault) => Err(FigureFault::new(name, &fault)),
        }
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
