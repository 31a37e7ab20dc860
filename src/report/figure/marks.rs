//! Marked values of a histogram: a line for each, and its name beside it.

use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

use super::panel::Panel;
use super::sheet::{self, Area, Drawn, width};
use super::style::{INK, LABEL, letters};

/// A value that is marked by name.
pub struct Mark {
    /// In the unit of what it is marked on.
    pub value: f64,
    /// Its name.
    pub name: String,
    /// Whether its line is dashed.
    pub is_dashed: bool,
}

/// Where the line of a marked value stands, px from the left, and its name.
struct Marked<'a> {
    x: i32,
    name: &'a str,
}

/// Where a name stands, px, and on which line of text, from above.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Standing {
    left: i32,
    right: i32,
    row: usize,
}

/// Height of a row of names, px.
const ROW: i32 = 30;

/// Room between a name and the line that it belongs to, and between names, px.
const APART: i32 = 8;

/// Lines over the whole height, with their names at the upper end, off each other.
pub fn draw(area: &Area, plot: &Panel, marks: &[&Mark]) -> Drawn {
    let [(left, bottom), (right, top)] = plot.corners;
    let marked = marks.iter().map(|mark| Marked {
        x: plot.place((mark.value, 0.0)).0,
        name: &mark.name,
    });
    let marked: Vec<Marked> = marked.collect();
    for (mark, Marked { x, .. }) in marks.iter().zip(&marked) {
        let (ends, style) = (vec![(*x, bottom), (*x, top)], INK.stroke_width(3));
        match mark.is_dashed {
            true => sheet::dashes(area, ends, style)?,
            false => area.draw(&PathElement::new(ends, style))?,
        }
    }
    for (mark, standing) in marked.iter().zip(arrange(&marked, (left, right))) {
        let y = top + 6 + ROW * standing.row as i32;
        let corners = [(standing.left - 2, y), (standing.right + 2, y + ROW)];
        area.draw(&Rectangle::new(corners, WHITE.mix(0.75).filled()))?;
        let (side, x) = match standing.left < mark.x {
            true => (HPos::Right, standing.right),
            false => (HPos::Left, standing.left),
        };
        sheet::text(area, mark.name, (x, y), side, &letters(LABEL), INK)?;
    }
    Ok(())
}

/// Where the names stand between two places, px: each beside its line, on the first row on which it
/// meets neither another name nor another line. Names of the left half rather stand on the left.
fn arrange(marks: &[Marked], (left, right): (i32, i32)) -> Vec<Standing> {
    let mut taken: Vec<Standing> = Vec::new();
    for mark in marks {
        let wide = width(mark.name, LABEL);
        let before = (mark.x - APART - wide, mark.x - APART);
        let behind = (mark.x + APART, mark.x + APART + wide);
        let sides = if mark.x < (left + right) / 2 {
            [before, behind]
        } else {
            [behind, before]
        };
        let fits = |(from, to): (i32, i32)| left <= from && to <= right;
        let is_off_lines = |(from, to): (i32, i32)| {
            let mut others = marks.iter().filter(|other| other.x != mark.x);
            others.all(|other| other.x < from || to < other.x)
        };
        let is_free = |(from, to): (i32, i32), row: usize| {
            let mut others = taken.iter().filter(|it| it.row == row);
            others.all(|it| it.right + APART < from || to + APART < it.left)
        };
        // A line may run through a name where there is no other room.
        let rows = 0..=marks.len();
        let places: Vec<((i32, i32), usize)> = rows
            .flat_map(|row| sides.map(|side| (side, row)))
            .filter(|(side, row)| is_free(*side, *row))
            .collect();
        let best = places
            .iter()
            .find(|(side, _)| fits(*side) && is_off_lines(*side))
            .or_else(|| places.iter().find(|(side, _)| fits(*side)))
            .or_else(|| places.first());
        if let Some(&((from, to), row)) = best {
            taken.push(Standing {
                left: from,
                right: to,
                row,
            });
        }
    }
    taken
}

#[cfg(test)]
mod tests {
    use super::*;

    fn overlap(a: &Standing, b: &Standing) -> bool {
        a.row == b.row && a.left < b.right && b.left < a.right
    }

    #[test]
    fn names_do_not_overlap_however_near_the_lines_are() {
        for apart in 0..200 {
            for at in [10, 150, 300, 470] {
                let place = |x: i32| x.clamp(0, 480);
                let marks = [
                    Marked {
                        x: place(at),
                        name: "wanted",
                    },
                    Marked {
                        x: place(at - apart),
                        name: "-2.345 %",
                    },
                    Marked {
                        x: place(at + apart),
                        name: "+2.345 %",
                    },
                ];
                let standing = arrange(&marks, (0, 480));
                assert_eq!(standing.len(), 3);
                for (index, one) in standing.iter().enumerate() {
                    assert!(0 <= one.left && one.right <= 480, "{apart} {at} {one:?}");
                    for other in &standing[..index] {
                        assert!(!overlap(one, other), "{apart} {at}: {one:?} {other:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn names_that_have_room_stand_on_the_first_row() {
        let marks = [(240, "wanted"), (90, "-15 %"), (390, "+15 %")];
        let marks = marks.map(|(x, name)| Marked { x, name });
        let standing = arrange(&marks, (0, 480));
        assert!(standing.iter().all(|it| it.row == 0), "{standing:?}");
    }
}
