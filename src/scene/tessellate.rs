//! Meshes of parametric shapes: for clearance, the target patch, pictures and comparison.

use nalgebra::{Point2, Point3};

use super::mesh::{Mesh, Triangle};
use super::profile::Profile;
use crate::elementary::sin_cos;
use crate::problem::part::{Ends, Place};

/// A prism as triangles; arcs become chords that turn by at most `chord_angle` rad each.
///
/// The corner points lie on the true surface, so facets lie inside an arc by up to
/// radius (1 - cos(chord_angle / 2)) and their normals are off by up to half the angle.
pub fn prism(profile: &Profile, length: f64, ends: Ends, chord_angle: f64) -> Mesh {
    let near = ends.near_closed.then_some("near");
    let far = ends.far_closed.then_some("far");
    capped(profile, length, [near, far], chord_angle)
}

/// The same with the names of its caps at z = 0 and z = `length`, where it has them.
pub(super) fn capped(
    profile: &Profile,
    length: f64,
    caps: [Option<&str>; 2],
    chord_angle: f64,
) -> Mesh {
    let mut mesh = Mesh {
        surfaces: profile.surfaces.clone(),
        ..Mesh::default()
    };
    let mut outline = Vec::new();
    let (mut near, mut far) = (Vec::new(), Vec::new());
    for (piece, chain) in profile.pieces.iter().zip(profile.chords(chord_angle)) {
        for pair in chain.windows(2) {
            let quad = wall(&mut mesh, pair[0], pair[1], length);
            add_quad(&mut mesh, quad, piece.surface);
            outline.push(pair[0]);
            near.push(quad[0]);
            far.push(quad[1]);
        }
    }
    let [near_cap, far_cap] = caps;
    if let Some(name) = near_cap {
        add_cap(&mut mesh, &outline, &near, true, name);
    }
    if let Some(name) = far_cap {
        add_cap(&mut mesh, &outline, &far, false, name);
    }
    mesh
}

/// A cross-section turned about the z axis, whose points are (distance from the axis, z), as triangles; arcs and the way round become
/// chords that turn by at most `chord_angle` rad each.
pub fn revolved(profile: &Profile, chord_angle: f64) -> Mesh {
    let mut mesh = Mesh {
        surfaces: profile.surfaces.clone(),
        ..Mesh::default()
    };
    let steps = (std::f64::consts::TAU / chord_angle).ceil().max(3.0) as u32;
    let directions: Vec<[f64; 2]> = (0..steps)
        .map(|step| {
            let angle = std::f64::consts::TAU * f64::from(step) / f64::from(steps);
            let (sin, cos) = sin_cos(angle);
            [cos, sin]
        })
        .collect();
    // The ring of corners of each place of the outline; one corner on the axis.
    let mut rings: Vec<(Point2<f64>, Vec<u32>)> = Vec::new();
    let mut ring = |mesh: &mut Mesh, at: Point2<f64>| -> usize {
        let size = at.coords.norm().max(f64::MIN_POSITIVE);
        let known = rings
            .iter()
            .position(|(known, _)| (known - at).norm() <= 1e-9 * size);
        known.unwrap_or_else(|| {
            let first = mesh.vertices.len() as u32;
            let corners = if at.x <= 1e-9 * size {
                mesh.vertices.push(Point3::new(0.0, 0.0, at.y));
                vec![first; steps as usize]
            } else {
                let around = directions
                    .iter()
                    .map(|[x, y]| Point3::new(at.x * x, at.x * y, at.y));
                mesh.vertices.extend(around);
                (first..first + steps).collect()
            };
            rings.push((at, corners));
            rings.len() - 1
        })
    };
    let mut quads = Vec::new();
    for (piece, chain) in profile.pieces.iter().zip(profile.chords(chord_angle)) {
        let places: Vec<usize> = chain.into_iter().map(|at| ring(&mut mesh, at)).collect();
        quads.extend(
            places
                .windows(2)
                .map(|pair| ([pair[0], pair[1]], piece.surface)),
        );
    }
    for ([from, to], surface) in quads {
        let [from, to] = [from, to].map(|index| &rings[index].1);
        for step in 0..steps as usize {
            let next = (step + 1) % steps as usize;
            let corners = [from[step], to[step], to[next], from[next]];
            let halves = [[0, 1, 2], [0, 2, 3]].map(|half| half.map(|corner| corners[corner]));
            let flat = |[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
            let triangles = halves.into_iter().filter(flat);
            mesh.triangles
                .extend(triangles.map(|corners| Triangle { corners, surface }));
        }
    }
    mesh
}

/// A block as triangles, fronts outwards; surfaces `x_min`, `x_max`, `y_min`, ...
pub fn block(min: Point3<f64>, max: Point3<f64>) -> Mesh {
    let mut mesh = Mesh::default();
    let corner = |i: usize| {
        let pick = |bit: usize, low: f64, high: f64| if i >> bit & 1 == 0 { low } else { high };
        Point3::new(
            pick(0, min.x, max.x),
            pick(1, min.y, max.y),
            pick(2, min.z, max.z),
        )
    };
    mesh.vertices = (0..8).map(corner).collect();
    for (name, quad) in [
        ("x_min", [0, 4, 6, 2]),
        ("x_max", [1, 3, 7, 5]),
        ("y_min", [0, 1, 5, 4]),
        ("y_max", [2, 6, 7, 3]),
        ("z_min", [0, 2, 3, 1]),
        ("z_max", [4, 5, 7, 6]),
    ] {
        let surface = mesh.surface_index(name);
        add_quad(&mut mesh, quad, surface);
    }
    mesh
}

/// Moves a mesh to its place.
pub fn placed(mut mesh: Mesh, place: &Place) -> Mesh {
    for vertex in &mut mesh.vertices {
        *vertex = place.rotation * *vertex + place.shift;
    }
    mesh
}

/// Corner indices of the wall above one chord, counter-clockwise from the chord's left.
fn wall(mesh: &mut Mesh, from: Point2<f64>, to: Point2<f64>, length: f64) -> [u32; 4] {
    [
        vertex(mesh, from, 0.0),
        vertex(mesh, from, length),
        vertex(mesh, to, length),
        vertex(mesh, to, 0.0),
    ]
}

/// Index of a corner point, shared with the chord before or with the very first chord.
fn vertex(mesh: &mut Mesh, point: Point2<f64>, z: f64) -> u32 {
    let found = Point3::new(point.x, point.y, z);
    let same = |other: &Point3<f64>| (other - found).norm() <= 1e-12 * point.coords.norm();
    let count = mesh.vertices.len();
    let recent = count.saturating_sub(4)..count;
    let first = 0..count.min(4);
    let known = recent.chain(first).find(|&i| same(&mesh.vertices[i]));
    known.unwrap_or_else(|| {
        mesh.vertices.push(found);
        count
    }) as u32
}

fn add_quad(mesh: &mut Mesh, [a, b, c, d]: [u32; 4], surface: u32) {
    mesh.triangles
        .extend([[a, b, c], [a, c, d]].map(|corners| Triangle { corners, surface }));
}

fn add_cap(mesh: &mut Mesh, outline: &[Point2<f64>], corners: &[u32], front_up: bool, name: &str) {
    let surface = mesh.surface_index(name);
    let mut triangles: Vec<usize> = Vec::new();
    let points = outline.iter().map(|p| [p.x, p.y]);
    earcut::Earcut::new().earcut(points, &[], &mut triangles);
    for triple in triangles.chunks_exact(3) {
        let [a, b, c] = [triple[0], triple[1], triple[2]];
        let up = (outline[b] - outline[a]).perp(&(outline[c] - outline[a])) > 0.0;
        let ordered = if up == front_up { [a, b, c] } else { [a, c, b] };
        mesh.triangles.push(Triangle {
            corners: ordered.map(|i| corners[i]),
            surface,
        });
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{UnitQuaternion, Vector3};

    use super::*;

    /// Free space is inside a bore, so that its fronts look inwards.
    #[test]
    fn the_mesh_of_a_closed_prism_is_closed_and_its_fronts_look_to_free_space() {
        for (near_closed, far_closed) in [(true, true), (true, false), (false, true)] {
            let ends = Ends {
                near_closed,
                far_closed,
            };
            for (sides, size) in [(4, 1.0), (5, 1.0), (60, 1.0), (60, 1e-8), (60, 1e6)] {
                let angle = std::f64::consts::TAU / f64::from(sides);
                let mesh = prism(&Profile::circle(4.0 * size), 3.0 * size, ends, angle);
                let topology = mesh.topology();
                assert_eq!(topology.inconsistent_edges, 0, "{ends:?}, {sides}");
                let open_ends = usize::from(!near_closed) + usize::from(!far_closed);
                assert_eq!(topology.open_edges, open_ends * sides as usize);
                assert_eq!(mesh.is_closed(), open_ends == 0);
                if open_ends == 0 {
                    // A triangle with two sides of 2 for each side, times 3.
                    let volume = 6.0 * f64::from(sides) * angle.sin();
                    let found = topology.signed_volume / (size * size * size);
                    assert!((found + volume).abs() < 1e-9, "{sides}: {found}");
                }
            }
        }
    }

    /// A ring of rectangular section, closed: its volume and the radii of its surfaces are those of the drawing.
    #[test]
    fn a_closed_outline_turned_about_the_axis_is_a_body() {
        use crate::problem::part::Segment;
        let corners = [[6.0, 0.0], [9.0, 0.0], [9.0, 4.0], [6.0, 4.0], [6.0, 0.0]];
        // Clockwise, so that free space is outside.
        let segments: Vec<Segment> = corners
            .windows(2)
            .rev()
            .map(|pair| Segment {
                from: pair[1].into(),
                to: pair[0].into(),
                via: None,
                surface: "ring".to_owned(),
            })
            .collect();
        let mesh = revolved(&Profile::outline(&segments), 0.01);
        let topology = mesh.topology();
        assert!(mesh.is_closed() && topology.is_consistently_wound());
        let volume = std::f64::consts::PI * (81.0 - 36.0) * 4.0;
        assert!(
            (topology.signed_volume / volume - 1.0).abs() < 1e-4,
            "{topology:?}"
        );
        // A cone down to its point on the axis is closed by a disc.
        let cone = [[0.0, 5.0], [3.0, 0.0], [0.0, 0.0]].map(nalgebra::Point2::from);
        let segments: Vec<Segment> = cone
            .windows(2)
            .map(|pair| Segment {
                from: pair[0],
                to: pair[1],
                via: None,
                surface: "cone".to_owned(),
            })
            .collect();
        let mesh = revolved(&Profile::outline(&segments), 0.01);
        let volume = std::f64::consts::PI * 9.0 * 5.0 / 3.0;
        assert!(mesh.is_closed());
        assert!((mesh.topology().signed_volume / volume - 1.0).abs() < 1e-4);
    }

    #[test]
    fn a_mesh_is_turned_about_its_origin_and_then_shifted() {
        let mesh = block(Point3::new(1.0, 2.0, 3.0), Point3::new(4.0, 6.0, 8.0));
        let quarter =
            UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 0.5 * std::f64::consts::PI);
        let place = Place {
            rotation: quarter,
            shift: Vector3::new(10.0, 20.0, -30.0),
        };
        let (low, high) = placed(mesh, &place).bounds().expect("it has corners");
        // x becomes y, and y becomes -x.
        assert!(
            (low - Point3::new(4.0, 21.0, -27.0)).norm() < 1e-12,
            "{low}"
        );
        assert!(
            (high - Point3::new(8.0, 24.0, -22.0)).norm() < 1e-12,
            "{high}"
        );
    }
}
