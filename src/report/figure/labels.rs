//! Texts on a map that keep out of each other's way.

use super::sheet::{self, Place};
use super::style::LABEL;

/// Room round a label, px.
const ROOM: (i32, i32) = (24, 34);

/// Labels that have their places.
pub struct Labels<'a> {
    /// Text and middle of each.
    pub taken: Vec<(String, Place)>,
    /// Lower left and upper right corner of what may hold labels.
    corners: [Place; 2],
    /// Where there must be none.
    is_forbidden: &'a dyn Fn(Place) -> bool,
}

impl<'a> Labels<'a> {
    /// None yet.
    pub fn new(corners: [Place; 2], is_forbidden: &'a dyn Fn(Place) -> bool) -> Self {
        Self {
            taken: Vec::new(),
            corners,
            is_forbidden,
        }
    }

    /// Puts a label on a line, as near to its middle as there is room; none where there is none.
    pub fn put_on(&mut self, line: &[Place], text: &str) {
        let place = from_the_middle(line).find(|place| self.is_free(*place, text));
        self.taken.extend(place.map(|place| (text.into(), place)));
    }

    /// Puts a label beside a line where that is fitting, and would not be on the other side.
    pub fn put_beside(&mut self, line: &[Place], text: &str, is_fitting: impl Fn(Place) -> bool) {
        let aside = half_width(text) + 30;
        let beside = |(x, y): Place| {
            let steps = [(0, -50), (0, 50), (-aside, 0), (aside, 0)];
            steps.map(|(dx, dy)| [(x + dx, y + dy), (x - dx, y - dy)])
        };
        let place = from_the_middle(line)
            .flat_map(beside)
            .find(|[here, opposite]| {
                is_fitting(*here) && !is_fitting(*opposite) && self.is_free(*here, text)
            })
            .map(|[here, _]| here);
        self.taken.extend(place.map(|place| (text.into(), place)));
    }

    fn is_free(&self, place: Place, text: &str) -> bool {
        let [(left, bottom), (right, top)] = self.corners;
        let (x, y) = place;
        let half = half_width(text);
        let inside = (left + half..right - half).contains(&x)
            && (top + ROOM.1..bottom - ROOM.1).contains(&y);
        let is_near = |(other, there): &(String, Place)| {
            (there.0 - x).abs() < half + half_width(other) + ROOM.0
                && (there.1 - y).abs() < 2 * ROOM.1
        };
        let ends = [(x - half, y), place, (x + half, y)];
        inside && !self.taken.iter().any(is_near) && !ends.into_iter().any(self.is_forbidden)
    }
}

/// Half of the width of a label, px.
pub fn half_width(text: &str) -> i32 {
    sheet::width(text, LABEL) / 2 + 5
}

/// The points of a line, those nearest to its middle first.
fn from_the_middle(line: &[Place]) -> impl Iterator<Item = Place> + '_ {
    let middle = line.len() / 2;
    let places = (0..=middle).flat_map(move |step| [middle.checked_sub(step), Some(middle + step)]);
    let found = places.flatten().filter_map(|index| line.get(index));
    found.copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_keep_apart_and_inside() {
        let is_forbidden = |(x, _): Place| x > 700;
        let mut labels = Labels::new([(0, 1000), (1000, 0)], &is_forbidden);
        let line: Vec<Place> = (0..=100).map(|step| (10 * step, 500)).collect();
        for _ in 0..4 {
            labels.put_on(&line, "0.05");
        }
        labels.put_beside(&line, "slip", |(_, y)| y > 500);
        let places: Vec<Place> = labels.taken.iter().map(|(_, place)| *place).collect();
        assert!(places.len() > 3);
        assert_eq!(places[0], (500, 500));
        for (index, (x, y)) in places.iter().enumerate() {
            assert!((20..680).contains(x) && (20..980).contains(y));
            for (u, v) in &places[..index] {
                assert!((x - u).abs() > 60 || (y - v).abs() > 40, "{places:?}");
            }
        }
        assert!(
            labels
                .taken
                .iter()
                .any(|(text, (_, y))| text == "slip" && *y > 500)
        );
        // Where a line is too short there is none.
        let count = labels.taken.len();
        labels.put_on(&[(2, 2), (5, 5)], "0.1");
        assert_eq!(labels.taken.len(), count);
    }
}
