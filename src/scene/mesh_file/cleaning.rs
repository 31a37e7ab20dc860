//! Takes out of a mesh what no ray can use, and reports what is odd about the rest.

use nalgebra::{Point3, center, distance};

use super::defect::Defect;
use super::warning::MeshWarning;
use super::weld::weld;
use crate::scene::mesh::{Mesh, Shells, Triangle, duplicates, examine, rims, tiny_pieces, unify};

/// Height over longest edge below which a triangle has no area: some thousand roundings.
const NO_HEIGHT: f64 = 1e-12;

/// Marks a vertex or surface that nothing uses.
const UNUSED: u32 = u32::MAX;

/// Open edges that together are shorter than this share of the mesh's diagonal are taken for damage
/// to a closed mesh.
const SMALL_HOLES: f64 = 0.1;

/// Joins corners that are one within the file's precision, drops triangles without area, duplicates and
/// unused vertices, turns triangles that disagree with their neighbours and shells that are inside out; gives
/// the warnings and the shells.
pub(super) fn clean(
    mesh: &mut Mesh,
    metres_per_unit: f64,
) -> Result<(Vec<MeshWarning>, Shells), Defect> {
    let read = mesh.triangles.len();
    let mut degenerate = Noticed::default();
    degenerate.drop_where(mesh, |_, triangle| {
        let [a, b, c] = triangle.corners;
        a == b || b == c || c == a
    });
    let mut duplicate = Noticed::default();
    duplicate.drop_duplicates(mesh);
    // Edges are examined before flat triangles go: those join their neighbours all the same.
    let mut turned = Noticed::default();
    let mut topology = examine(mesh).topology;
    let welded = if topology.open_edges > 0 {
        weld(mesh, metres_per_unit)
    } else {
        None
    };
    if welded.is_some() {
        duplicate.drop_duplicates(mesh);
        topology = examine(mesh).topology;
    }
    if !topology.is_consistently_wound() {
        turned.turn(mesh);
    }
    let edges = edge_warnings(mesh);
    degenerate.drop_where(mesh, has_no_area);
    if mesh.triangles.is_empty() {
        return Err(Defect::AllDegenerate { triangles: read });
    }
    drop_unused(mesh);
    mesh.triangles.shrink_to_fit();
    mesh.vertices.shrink_to_fit();
    let mut shells = Shells::of(mesh);
    let inside_out = shells.turn_inside_out(mesh);

    let mut warnings = Vec::new();
    warnings.extend(welded.map(|weld| MeshWarning::WeldedCorners {
        count: weld.corners,
        apart: weld.apart / metres_per_unit,
        near: weld.near,
    }));
    let mut warn = |finding: Option<(usize, Point3<f64>)>, warning: fn(_, _) -> MeshWarning| {
        warnings.extend(finding.map(|(count, near)| warning(count, near)));
    };
    warn(degenerate.finding(), |count, near| {
        MeshWarning::DegenerateTriangles { count, near }
    });
    warn(duplicate.finding(), |count, near| {
        MeshWarning::DuplicateTriangles { count, near }
    });
    warn(turned.finding(), |count, near| {
        MeshWarning::TurnedTriangles { count, near }
    });
    warnings.extend(edges);
    if !inside_out.is_empty() {
        let volume = |shell: &u32| shells.list[*shell as usize].volume;
        warnings.push(MeshWarning::InsideOut {
            bodies: inside_out.len(),
            signed_volume: -inside_out.iter().map(volume).sum::<f64>(),
        });
    }
    let pieces = tiny_pieces(mesh);
    warnings.extend(pieces.map(|(count, near)| MeshWarning::TinyPieces { count, near }));
    for warning in &mut warnings {
        warning.put_in_unit(metres_per_unit);
    }
    Ok((warnings, shells))
}

/// What is odd about the edges of a mesh.
fn edge_warnings(mesh: &Mesh) -> Vec<MeshWarning> {
    let findings = examine(mesh);
    let topology = findings.topology;
    let mut warnings = Vec::new();
    if topology.open_edges > 0 {
        let rims = rims(mesh);
        if let Some(&[from, to]) = rims.holes.first() {
            let lengths = rims.holes.iter().map(|[a, b]| distance(a, b));
            let diagonal = mesh
                .bounds()
                .map_or(0.0, |(low, high)| distance(&low, &high));
            let small = lengths.sum::<f64>() < SMALL_HOLES * diagonal;
            warnings.push(MeshWarning::OpenEdges {
                count: rims.holes.len(),
                near: center(&from, &to),
                small,
            });
        }
        if let Some(&[from, to]) = rims.seams.first() {
            warnings.push(MeshWarning::Seams {
                count: rims.seams.len(),
                near: center(&from, &to),
            });
        }
    }
    if let Some(near) = findings.non_manifold.middle(mesh) {
        warnings.push(MeshWarning::NonManifoldEdges {
            count: findings.non_manifold.count,
            near,
        });
    }
    if let Some(near) = findings.inconsistent.middle(mesh) {
        warnings.push(MeshWarning::InconsistentWinding {
            count: findings.inconsistent.count,
            near,
        });
    }
    warnings
}

/// How many triangles were treated, and the centre of the first.
#[derive(Default)]
struct Noticed {
    count: usize,
    first: Option<Point3<f64>>,
}

impl Noticed {
    fn drop_where(&mut self, mesh: &mut Mesh, unwanted: fn(&Mesh, &Triangle) -> bool) {
        let mut triangles = std::mem::take(&mut mesh.triangles);
        triangles.retain(|triangle| {
            let drop = unwanted(mesh, triangle);
            if drop {
                self.add(mesh, triangle);
            }
            !drop
        });
        mesh.triangles = triangles;
    }

    fn drop_duplicates(&mut self, mesh: &mut Mesh) {
        let mut repeated = duplicates(mesh).into_iter().peekable();
        let mut triangles = std::mem::take(&mut mesh.triangles);
        let mut position = 0;
        triangles.retain(|triangle| {
            let drop = repeated.next_if_eq(&position).is_some();
            if drop {
                self.add(mesh, triangle);
            }
            position += 1;
            !drop
        });
        mesh.triangles = triangles;
    }

    fn turn(&mut self, mesh: &mut Mesh) {
        for position in unify(mesh) {
            let triangle = mesh.triangles[position as usize];
            self.add(mesh, &triangle);
        }
    }

    fn add(&mut self, mesh: &Mesh, triangle: &Triangle) {
        self.count += 1;
        self.first.get_or_insert_with(|| mesh.centre(triangle));
    }

    fn finding(&self) -> Option<(usize, Point3<f64>)> {
        Some((self.count, self.first?))
    }
}

fn has_no_area(mesh: &Mesh, triangle: &Triangle) -> bool {
    let [a, b, c] = mesh.corners(triangle);
    let longest = [b - a, c - b, a - c]
        .iter()
        .map(|edge| edge.norm_squared())
        .fold(0.0, f64::max);
    // not `<=`: what underflows to 0 or to no number has no area either
    let has_area = mesh.doubled_area(triangle).norm() > NO_HEIGHT * longest;
    !has_area
}

/// Drops vertices and surfaces without triangles and numbers the others anew, in their order.
pub(super) fn drop_unused(mesh: &mut Mesh) {
    let mut vertex_numbers = vec![UNUSED; mesh.vertices.len()];
    let mut surface_numbers = vec![UNUSED; mesh.surfaces.len()];
    for triangle in &mesh.triangles {
        surface_numbers[triangle.surface as usize] = 0;
        for corner in triangle.corners {
            vertex_numbers[corner as usize] = 0;
        }
    }
    keep_used(&mut mesh.vertices, &mut vertex_numbers);
    keep_used(&mut mesh.surfaces, &mut surface_numbers);
    for triangle in &mut mesh.triangles {
        triangle.surface = surface_numbers[triangle.surface as usize];
        triangle.corners = triangle
            .corners
            .map(|corner| vertex_numbers[corner as usize]);
    }
}

/// Keeps the items whose number is not [`UNUSED`] and sets the number to their new position.
fn keep_used<T>(items: &mut Vec<T>, numbers: &mut [u32]) {
    let mut next = 0;
    let mut number = numbers.iter_mut();
    items.retain(|_| match number.next() {
        Some(number) if *number != UNUSED => {
            *number = next;
            next += 1;
            true
        }
        _ => false,
    });
}

#[cfg(test)]
mod tests;
