//! The colours of values between two ends, and the bar that shows them.

use std::ops::Range;

use colorous::Gradient;
use plotters::prelude::*;

use super::sheet::{Area, Drawn, Place};
use super::style::GHOST;

/// Values and their colours.
pub struct Scale {
    /// The values at both ends.
    pub range: Range<f64>,
    /// The colours from one end to the other.
    pub gradient: Gradient,
}

/// Bands of a bar.
const BANDS: i32 = 50;

impl Scale {
    /// The colour of a value; that of the nearer end beyond both.
    pub fn colour(&self, value: f64) -> RGBColor {
        let share = (value - self.range.start) / (self.range.end - self.range.start);
        let colour = self.gradient.eval_continuous(share.clamp(0.0, 1.0));
        RGBColor(colour.r, colour.g, colour.b)
    }

    /// The value at a share of the way from one end to the other.
    pub fn value(&self, share: f64) -> f64 {
        self.range.start + share * (self.range.end - self.range.start)
    }

    /// A bar of all colours between its upper left and lower right corner, px, the first one below.
    pub fn bar(&self, area: &Area, corners: [Place; 2]) -> Drawn {
        let [(left, top), (right, bottom)] = corners;
        let height = f64::from(bottom - top);
        let share = |band: i32| f64::from(band) / f64::from(BANDS);
        let edge = |band: i32| bottom - (share(band) * height).round() as i32;
        for band in 0..BANDS {
            let value = self.value(share(band) + share(1) / 2.0);
            let corners = [(left, edge(band + 1)), (right, edge(band))];
            area.draw(&Rectangle::new(corners, self.colour(value).filled()))?;
        }
        area.draw(&Rectangle::new(corners, GHOST.stroke_width(2)))
    }
}
