//! Takes out of a mesh what no ray can use, and reports what is odd about the rest.

use nalgebra::Point3;

use super::defect::Defect;
use super::warning::MeshWarning;
use crate::scene::mesh::{EdgeFinding, Mesh, Triangle, duplicates, examine};

/// Height over longest edge below which a triangle has no area: some thousand roundings.
const NO_HEIGHT: f64 = 1e-12;

/// Marks a vertex or surface that nothing uses.
const UNUSED: u32 = u32::MAX;

/// Drops triangles without area, duplicates and unused vertices; gives the warnings.
pub(super) fn clean(mesh: &mut Mesh, metres_per_unit: f64) -> Result<Vec<MeshWarning>, Defect> {
    let read = mesh.triangles.len();
    let mut degenerate = Dropped::default();
    degenerate.drop_where(mesh, |_, triangle| {
        let [a, b, c] = triangle.corners;
        a == b || b == c || c == a
    });
    let mut duplicate = Dropped::default();
    duplicate.drop_duplicates(mesh);
    // Edges are examined before flat triangles go: those join their neighbours all the same.
    let findings = examine(mesh);
    let edges = [
        &findings.open,
        &findings.non_manifold,
        &findings.inconsistent,
    ]
    .map(|finding: &EdgeFinding| Some((finding.count, finding.middle(mesh)?)));
    degenerate.drop_where(mesh, has_no_area);
    if mesh.triangles.is_empty() {
        return Err(Defect::AllDegenerate { triangles: read });
    }
    drop_unused(mesh);
    mesh.triangles.shrink_to_fit();
    mesh.vertices.shrink_to_fit();

    let [open, non_manifold, inconsistent] = edges;
    let mut warnings = Vec::new();
    let mut warn = |finding: Option<(usize, Point3<f64>)>, warning: fn(_, _) -> MeshWarning| {
        warnings.extend(finding.map(|(count, near)| warning(count, near / metres_per_unit)));
    };
    warn(degenerate.finding(), |count, near| {
        MeshWarning::DegenerateTriangles { count, near }
    });
    warn(duplicate.finding(), |count, near| {
        MeshWarning::DuplicateTriangles { count, near }
    });
    warn(open, |count, near| MeshWarning::OpenEdges { count, near });
    warn(non_manifold, |count, near| MeshWarning::NonManifoldEdges {
        count,
        near,
    });
    warn(inconsistent, |count, near| {
        MeshWarning::InconsistentWinding { count, near }
    });
    let topology = findings.topology;
    if topology.is_closed() && topology.is_consistently_wound() && topology.signed_volume < 0.0 {
        warnings.push(MeshWarning::InsideOut {
            signed_volume: topology.signed_volume,
        });
    }
    Ok(warnings)
}

/// How many triangles were dropped, and the centre of the first.
#[derive(Default)]
struct Dropped {
    count: usize,
    first: Option<Point3<f64>>,
}

impl Dropped {
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
