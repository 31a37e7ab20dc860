//! Names of marked values above a histogram, beside their lines and off each other.

use super::sheet::width;
use super::style::LABEL;

/// A marked value: where its line stands, px, and its name.
pub struct Marked<'a> {
    /// px from the left.
    pub x: i32,
    /// The name.
    pub name: &'a str,
}

/// Where a name stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Standing {
    /// Left end, px.
    pub left: i32,
    /// Right end, px.
    pub right: i32,
    /// Line of text, from above.
    pub row: usize,
}

/// Room between a name and the line that it belongs to, and between names, px.
const APART: i32 = 8;

/// Where the names stand between two places, px: each beside its line, on the first row on which it
/// meets neither another name nor another line. Names of the left half rather stand on the left.
pub fn arrange(marks: &[Marked], (left, right): (i32, i32)) -> Vec<Standing> {
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
