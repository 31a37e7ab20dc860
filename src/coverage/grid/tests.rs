use super::*;

fn grid(side: f64) -> Grid {
    Grid {
        middle: Point3::origin(),
        axes: [Vector3::x(), Vector3::y(), Vector3::z()],
        side,
    }
}

/// A triangle in a slanting plane, cut into cells whose areas are worked out by fine sampling.
#[test]
fn areas_of_cells_are_exact() {
    // 3 by 2 in two triangles, off the lines of the grid.
    let corner = |x: f64, y: f64| Point3::new(x, y, 0.0);
    let (a, b, c, d) = (
        corner(0.25, 0.5),
        corner(3.25, 0.5),
        corner(3.25, 2.5),
        corner(0.25, 2.5),
    );
    let areas = grid(1.0).areas(&[[a, b, c], [a, c, d]]);
    assert_eq!(areas.len(), 4 * 3);
    for (&[x, y, z], &area) in &areas {
        let part = |cell: i64, low: f64, high: f64| {
            (high.min(cell as f64 + 1.0) - low.max(cell as f64)).max(0.0)
        };
        let expected = part(x, 0.25, 3.25) * part(y, 0.5, 2.5);
        assert!(
            (area - expected).abs() < 1e-12 && z == 0,
            "{x}, {y}: {area}"
        );
    }
    // Leaning by the pitch 3:4 it is longer by 5/4, and climbs through the layers of the grid.
    let lean = |p: &Point3<f64>| Point3::new(p.x, p.y, 0.75 * p.x);
    let leaning = [[a, b, c], [a, c, d]].map(|corners| corners.map(|corner| lean(&corner)));
    let areas = grid(1.0).areas(&leaning);
    let all: f64 = areas.values().sum();
    assert!((all - 7.5).abs() < 1e-12, "{all}");
    // Up to x = 2/3 it is in the lower half of the first layer, whose middle is at 0.
    let first = areas[&[0, 1, 0]];
    assert!((first - (2.0 / 3.0 - 0.25) * 1.25).abs() < 1e-12, "{first}");
}

/// Corners on the lines of the grid make no slivers.
#[test]
fn a_target_that_fits_its_cells_is_cut_into_just_those() {
    let corner = |x: f64, y: f64| Point3::new(0.1 * x, 0.1 * y, 1e-18);
    let (a, b, c, d) = (
        corner(-3.0, -2.0),
        corner(3.0, -2.0),
        corner(3.0, 2.0),
        corner(-3.0, 2.0),
    );
    let areas = grid(0.1).areas(&[[a, b, c], [a, c, d]]);
    assert_eq!(areas.len(), 24);
    for area in areas.values() {
        assert!((area / 0.01 - 1.0).abs() < 1e-9);
    }
}

#[test]
fn slivers_count_with_their_largest_neighbour() {
    let grid = grid(1.0);
    let areas = BTreeMap::from([
        ([0, 0, 0], 1.0),
        ([1, 0, 0], 0.9),
        ([1, 1, 0], 0.1),
        ([9, 9, 9], 0.1),
    ]);
    let (cell_at, cells) = grid.cells(&areas);
    let found: Vec<f64> = cells.iter().map(|cell| cell.area).collect();
    assert_eq!(found, [1.1, 0.9, 0.1]);
    assert_eq!(cell_at[&[1, 1, 0]], cell_at[&[0, 0, 0]]);
    // A hit beside all cells counts in the largest one there, and far away in none.
    let cell = |x: f64, y: f64| grid.cell_of(&Point3::new(x, y, 0.0), &cell_at, &areas);
    assert_eq!(cell(-0.001, 0.5), Some(0));
    assert_eq!(cell(2.001, 0.5), Some(1));
    assert_eq!(cell(5.0, 5.0), None);
}
