use super::*;

const ANGLE: usize = Dimension::ConeAngle as usize;
const TURN: usize = Dimension::ConeTurn as usize;
const AZIMUTH: usize = Dimension::Azimuth as usize;

/// Cells of uniform points, and which of them violate.
fn violated(count: usize, violates: impl Fn(&Cells) -> bool) -> (Vec<Cells>, Vec<f64>) {
    let cell = |index: usize, step: f64| ImportanceDensity::cell((index as f64 * step).fract());
    let point = |index: usize| {
        let mut cells = [NO_CELL; DIMENSIONS];
        cells[ANGLE] = cell(index, 0.618_034);
        cells[TURN] = cell(index, 0.754_878);
        cells[AZIMUTH] = cell(index, 0.569_840);
        cells
    };
    let cells: Vec<Cells> = (0..count).map(point).collect();
    let violation = cells
        .iter()
        .map(|cells| f64::from(u8::from(violates(cells))));
    let violation = violation.collect();
    (cells, violation)
}

/// Low in one dimension, and on both sides of the seam of another.
fn is_at_seam(cells: &Cells) -> bool {
    cells[ANGLE] < 4 && !(2..14).contains(&cells[TURN])
}

/// All cells of the three dimensions.
fn all_cells() -> impl Iterator<Item = Cells> {
    (0..CELLS.pow(3)).map(|number| {
        let mut cells = [NO_CELL; DIMENSIONS];
        for (place, dimension) in [ANGLE, TURN, AZIMUTH].into_iter().enumerate() {
            cells[dimension] = (number / CELLS.pow(place as u32) % CELLS) as u8;
        }
        cells
    })
}

/// Which share of the points is drawn in some of the cells.
fn mass(importance: &ImportanceDensity, is_in: impl Fn(&Cells) -> bool) -> f64 {
    let densities = all_cells().filter(is_in).map(|it| importance.density(&it));
    densities.sum::<f64>() / CELLS.pow(3) as f64
}

#[test]
fn it_is_denser_where_violations_come_from_and_nowhere_empty() {
    let (cells, violation) = violated(4096, is_at_seam);
    let importance = ImportanceDensity::NONE.on(&cells, &violation);
    assert!((mass(&importance, |_| true) - 1.0).abs() < 1e-9);
    assert!(all_cells().all(|cells| importance.density(&cells) > 0.0));
    // Of the jet's it is a sixteenth.
    let found = mass(&importance, is_at_seam);
    assert!(found > 0.7, "{found}");
    // What tells nothing is left as it is, and what is not drawn from.
    for cell in 0..CELLS as u8 {
        let share = mass(&importance, |cells| cells[AZIMUTH] == cell) * CELLS as f64;
        assert!((share - 1.0).abs() < 0.2, "{cell} {share}");
    }
    let size = Dimension::Size as usize;
    let mut components = importance.components().iter();
    assert!(components.all(|it| it.density[size] == [1.0; CELLS]));
}

#[test]
fn opposite_corners_have_components_of_their_own() {
    let low = |cells: &Cells| cells[ANGLE] < 4 && cells[AZIMUTH] < 4;
    let high = |cells: &Cells| cells[ANGLE] >= 12 && cells[AZIMUTH] >= 12;
    let between = |cells: &Cells| {
        (cells[ANGLE] < 4 && cells[AZIMUTH] >= 12) || (cells[ANGLE] >= 12 && cells[AZIMUTH] < 4)
    };
    let (cells, violation) = violated(4096, |cells| low(cells) || high(cells));
    let importance = ImportanceDensity::NONE.on(&cells, &violation);
    for (share, corner) in [mass(&importance, low), mass(&importance, high)]
        .into_iter()
        .zip(["low", "high"])
    {
        assert!((0.3..0.6).contains(&share), "{corner} {share}");
    }
    // A product of histograms is as dense there.
    let elsewhere = mass(&importance, between);
    assert!(elsewhere < 0.1, "{elsewhere}");
    let events = events(&cells, &violation, 1.0);
    let all_of_one = vec![[1.0, 0.0, 0.0, 0.0]; events.len()];
    let one = ImportanceDensity::NONE.fitted(&events, &all_of_one);
    assert!(mass(&one, between) > 0.3, "{}", mass(&one, between));
}

#[test]
fn chance_and_absurd_violations_change_little_or_nothing() {
    let (cells, none) = violated(4096, |_| false);
    assert_eq!(
        ImportanceDensity::NONE.on(&cells, &none),
        ImportanceDensity::NONE
    );
    let mut one = none.clone();
    one[7] = 1e200;
    let importance = ImportanceDensity::NONE.on(&cells, &one);
    assert!(!importance.is_mixed());
    let all = importance.components[0].density.iter().flatten();
    assert!(all.into_iter().all(|density| (0.79..3.3).contains(density)));
    one[7] = f64::INFINITY;
    assert_eq!(
        ImportanceDensity::NONE.on(&cells, &one),
        ImportanceDensity::NONE
    );
}

#[test]
fn coordinates_are_drawn_by_the_density() {
    let (cells, violation) = violated(4096, is_at_seam);
    let importance = ImportanceDensity::NONE.on(&cells, &violation);
    let dimension = Dimension::ConeTurn;
    let draws = 160_000;
    let uniforms = || (0..draws).map(|draw| (f64::from(draw) + 0.5) / f64::from(draws));
    for (index, component) in importance.components().iter().enumerate() {
        let mut counts = [0; CELLS];
        for uniform in uniforms() {
            let drawn = importance.drawn(index, dimension, uniform);
            assert!((0.0..1.0).contains(&drawn));
            counts[usize::from(ImportanceDensity::cell(drawn))] += 1;
        }
        for (count, density) in counts.iter().zip(&component.density[dimension as usize]) {
            let expected = density * f64::from(draws) / CELLS as f64;
            assert!(
                (f64::from(*count) - expected).abs() < 2.0,
                "{count} {expected}"
            );
        }
        let last = importance.drawn(index, dimension, 1.0 - f64::EPSILON);
        assert_eq!(ImportanceDensity::cell(last), 15);
        let chosen = uniforms().filter(|&it| importance.component(it) == index);
        let expected = component.share * f64::from(draws);
        assert!((chosen.count() as f64 - expected).abs() < 2.0);
    }
    let shares = importance.components().iter().map(|it| it.share);
    assert!((shares.sum::<f64>() - 1.0).abs() < 1e-12);
    assert!((importance.density(&[NO_CELL; DIMENSIONS]) - 1.0).abs() < 1e-12);
}
