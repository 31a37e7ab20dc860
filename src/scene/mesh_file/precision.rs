//! How exactly a mesh file says where its corners are.

use nalgebra::distance;

use crate::elementary::whole_power;
use crate::scene::mesh::Mesh;

/// Programs that cut each face of a part into triangles by itself agree about a common corner to about
/// this share of the part's diagonal.
const MESHING: f64 = 1e-5;
/// Units of the last digit by which two roundings of one corner may differ: one in each direction, and
/// a quarter for the rounding of the comparison.
const LAST_DIGITS: f64 = 2.0;
/// Written digits that are coarser than this share of the diagonal are no rounding but the shape: a
/// part drawn on whole millimetres has gaps of one.
const COARSEST_DIGIT: f64 = 1e-4;
/// As [`LAST_DIGITS`] for f32, where both corners may be off by a unit in each direction.
const LAST_BITS: f64 = 4.0;
/// Decimals that are looked for.
const MOST_DECIMALS: i32 = 9;
/// Coordinates this much smaller than the largest say nothing about the number of decimals: `%g`
/// writes more of them.
const SMALL: f64 = 0.1;

/// The largest distance, m, of two corners that the file may mean as one.
pub(super) fn precision(mesh: &Mesh, metres_per_unit: f64) -> f64 {
    let Some((low, high)) = mesh.bounds() else {
        return 0.0;
    };
    let diagonal = distance(&low, &high);
    let largest = low.coords.amax().max(high.coords.amax()) / metres_per_unit;
    let single = if is_single(mesh, metres_per_unit) {
        LAST_BITS * last_bit(largest) * metres_per_unit
    } else {
        0.0
    };
    let written = last_digit(mesh, metres_per_unit, largest).map_or(0.0, |digit| {
        (LAST_DIGITS * digit * metres_per_unit).min(COARSEST_DIGIT * diagonal)
    });
    single.max(written).max(MESHING * diagonal)
}

/// Whether every coordinate is an f32, but for the rounding of the change of units.
fn is_single(mesh: &Mesh, metres_per_unit: f64) -> bool {
    let mut values = coordinates(mesh, metres_per_unit);
    values.all(|value| {
        let rounded = f64::from(value as f32);
        (rounded - value).abs() <= 4.0 * f64::EPSILON * value.abs()
    })
}

/// The distance from this number to the next f32.
fn last_bit(value: f64) -> f64 {
    let value = value as f32;
    f64::from(value.next_up()) - f64::from(value)
}

/// The unit of the last decimal that the large coordinates are written with; `None` if there is no
/// such: the numbers were computed and written in full.
fn last_digit(mesh: &Mesh, metres_per_unit: f64, largest: f64) -> Option<f64> {
    let is_written_with = |decimals: &i32| {
        let scale = whole_power(10.0, *decimals);
        coordinates(mesh, metres_per_unit)
            .filter(|value| value.abs() >= SMALL * largest)
            .all(|value| {
                let scaled = value * scale;
                (scaled - scaled.round()).abs() <= 8.0 * f64::EPSILON * scaled.abs()
            })
    };
    let decimals = (0..=MOST_DECIMALS).find(is_written_with)?;
    Some(whole_power(10.0, -decimals))
}

/// Every coordinate in the file's unit.
fn coordinates(mesh: &Mesh, metres_per_unit: f64) -> impl Iterator<Item = f64> {
    let vertices = mesh.vertices.iter();
    vertices.flat_map(move |vertex| (vertex / metres_per_unit).coords.data.0[0])
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use super::*;

    fn of(corners: &[[f64; 3]], metres_per_unit: f64) -> f64 {
        let mesh = Mesh {
            vertices: corners
                .iter()
                .map(|corner| Point3::from(corner.map(|it| it * metres_per_unit)))
                .collect(),
            ..Mesh::default()
        };
        precision(&mesh, metres_per_unit) / metres_per_unit
    }

    fn assert_is(found: f64, expected: f64) {
        assert!(
            (found / expected - 1.0).abs() < 1e-9,
            "{found:e} is not {expected:e}"
        );
    }

    /// A part of 3 by 4 by 12, whose diagonal is 13.
    #[test]
    fn it_is_what_meshing_or_the_last_digit_leaves_open() {
        for unit in [1.0, 1e-3, 0.0254] {
            let with = |corner: [f64; 3]| of(&[[0.0; 3], [3.0, 4.0, 12.0], corner], unit);
            // Digits that are finer than meshing is.
            assert_is(with([1.234_567, 2.0, 3.0]), 1.3e-4);
            // Two decimals: 0.02 is coarser than a ten thousandth of the part.
            assert_is(with([1.23, 2.0, 3.0]), 1.3e-3);
            assert_is(with([1.5, 2.25, 3.371]), 1.3e-3);
            assert_is(with([1.5, 2.25, 3.371_2]), 2e-4);
            // What is small may have more digits.
            assert_is(with([1.5, 1.1e-17, 3.371_2]), 2e-4);
        }
    }

    #[test]
    fn far_from_the_origin_f32_is_coarser_than_meshing() {
        let far = |value: f32| f64::from(value) + 0.0;
        // From 1024 to 2048, f32 is 2^-13 apart.
        let corners = [[far(1999.1), 1517.5, 0.25], [far(2003.3), 1521.5, 12.25]];
        assert_is(of(&corners, 1e-3), 4.0 / 8192.0);
        // The same with a coordinate that is no f32.
        let diagonal = 4.2_f64.hypot(4.0).hypot(12.0);
        let corners = [
            [1_999.123_456_789_012, 1517.5, 0.25],
            [1_999.123_456_789_012 + 4.2, 1521.5, 12.25],
        ];
        assert_is(of(&corners, 1e-3), MESHING * diagonal);
    }
}
