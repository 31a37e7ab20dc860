//! Triangles turned so that neighbours agree on which side is the front.

use super::{Mesh, Triangle};

/// Both triangles at an edge, and whether they run along it in the same direction.
struct Joint {
    triangles: [u32; 2],
    disagrees: bool,
}

/// Turns triangles so that the two at an edge agree, wherever that is possible: in each patch that is
/// joined by such edges the fewer ones. Gives their positions, ascending.
pub(in crate::scene) fn unify(mesh: &mut Mesh) -> Vec<u32> {
    let joints = joints(mesh);
    let mut turned: Vec<u32> = patches(mesh.triangles.len(), &joints)
        .into_iter()
        .flat_map(|patch| {
            let count = patch.iter().filter(|(_, turned)| *turned).count();
            let are_fewer = 2 * count <= patch.len();
            let fewer = patch.into_iter();
            let fewer = fewer.filter(move |(_, turned)| *turned == are_fewer);
            fewer.map(|(triangle, _)| triangle).collect::<Vec<_>>()
        })
        .collect();
    turned.sort_unstable();
    for &position in &turned {
        let Triangle { corners, .. } = &mut mesh.triangles[position as usize];
        corners.swap(1, 2);
    }
    turned
}

/// Every edge of exactly two triangles.
fn joints(mesh: &Mesh) -> Vec<Joint> {
    let mut sides = Vec::with_capacity(3 * mesh.triangles.len());
    for (position, triangle) in (0..).zip(&mesh.triangles) {
        let [a, b, c] = triangle.corners;
        for (from, to) in [(a, b), (b, c), (c, a)] {
            sides.push(([from.min(to), from.max(to)], position, from > to));
        }
    }
    sides.sort_unstable();
    let edges = sides.chunk_by(|one, other| one.0 == other.0);
    let joint = |sides: &[([u32; 2], u32, bool)]| match *sides {
        [(_, one, backwards), (_, other, also)] => Some(Joint {
            triangles: [one, other],
            disagrees: backwards == also,
        }),
        _ => None,
    };
    edges.filter_map(joint).collect()
}

/// The triangles of each patch, and whether each disagrees with the first of its patch.
fn patches(triangles: usize, joints: &[Joint]) -> Vec<Vec<(u32, bool)>> {
    let mut links = Vec::with_capacity(2 * joints.len());
    for joint in joints {
        let [one, other] = joint.triangles;
        links.extend([(one, other, joint.disagrees), (other, one, joint.disagrees)]);
    }
    links.sort_unstable();
    let links_of = |triangle: u32| {
        let from = links.partition_point(|link| link.0 < triangle);
        links[from..]
            .iter()
            .take_while(move |link| link.0 == triangle)
    };
    let mut is_known = vec![false; triangles];
    let mut patches = Vec::new();
    for first in 0..triangles as u32 {
        if std::mem::replace(&mut is_known[first as usize], true) {
            continue;
        }
        let mut patch = vec![(first, false)];
        let mut next = 0;
        while let Some(&(triangle, turned)) = patch.get(next) {
            next += 1;
            for &(_, neighbour, disagrees) in links_of(triangle) {
                if !std::mem::replace(&mut is_known[neighbour as usize], true) {
                    patch.push((neighbour, turned != disagrees));
                }
            }
        }
        patches.push(patch);
    }
    patches
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use super::*;

    /// A strip of triangles one after the other, some of them turned over.
    fn strip(turned: &[bool]) -> Mesh {
        let count = turned.len() as u32;
        let vertices = (0..count + 2).map(|i| Point3::new(f64::from(i), f64::from(i % 2), 0.0));
        let triangles = (0..count).zip(turned).map(|(i, &is_turned)| {
            let clockwise = is_turned != (i % 2 == 1);
            let corners = if clockwise {
                [i, i + 1, i + 2]
            } else {
                [i, i + 2, i + 1]
            };
            Triangle {
                corners,
                surface: 0,
            }
        });
        Mesh {
            vertices: vertices.collect(),
            triangles: triangles.collect(),
            surfaces: vec!["all".to_owned()],
        }
    }

    fn inconsistent_edges(mesh: &Mesh) -> usize {
        mesh.topology().inconsistent_edges
    }

    #[test]
    fn the_fewer_triangles_of_a_patch_are_turned() {
        for (turned, expected) in [
            ("..........", vec![]),
            ("###.......", vec![0, 1, 2]),
            ("####......", vec![0, 1, 2, 3]),
            ("######....", vec![6, 7, 8, 9]),
            ("..#..#.##.", vec![2, 5, 7, 8]),
            ("##.##.#..#", vec![2, 5, 7, 8]),
            (".#########", vec![0]),
        ] {
            let mut mesh = strip(&turned.bytes().map(|it| it == b'#').collect::<Vec<_>>());
            let pairs = turned.as_bytes().windows(2);
            let changes = pairs.filter(|pair| pair[0] != pair[1]).count();
            assert_eq!(inconsistent_edges(&mesh), changes, "{turned}");
            let before = mesh.triangles.clone();
            assert_eq!(unify(&mut mesh), expected, "{turned}");
            assert_eq!(inconsistent_edges(&mesh), 0, "{turned}");
            for (position, (old, new)) in before.iter().zip(&mesh.triangles).enumerate() {
                let is_turned = expected.contains(&(position as u32));
                assert_eq!(old != new, is_turned, "{turned}: {position}");
            }
        }
    }

    #[test]
    fn patches_are_turned_one_by_one() {
        let mut mesh = strip(&[false, false, true, false]);
        let other = strip(&[true, true, true, false, true]);
        let (vertices, triangles) = (mesh.vertices.len() as u32, mesh.triangles.len() as u32);
        let far = other
            .vertices
            .iter()
            .map(|vertex| vertex + nalgebra::Vector3::y() * 9.0);
        mesh.vertices.extend(far);
        mesh.triangles
            .extend(other.triangles.iter().map(|triangle| Triangle {
                corners: triangle.corners.map(|corner| corner + vertices),
                ..*triangle
            }));
        assert_eq!(unify(&mut mesh), [2, triangles + 3]);
        assert_eq!(inconsistent_edges(&mesh), 0);
    }
}
