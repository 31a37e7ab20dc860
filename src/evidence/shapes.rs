//! The surfaces of a scene as triangles with shared corners.

use std::collections::HashMap;

use nalgebra::Point3;

use crate::jet::Pose;
use crate::scenario::Scenario;
use crate::scene::patch::Triangle;

/// A surface, or the part of one that is the target, as triangles.
#[derive(Clone, Debug)]
pub struct Shape {
    /// Index of the surface in the scene.
    pub surface: u32,
    /// Whether it is the target patch.
    pub is_target: bool,
    /// Share of its triangles that is left: 1 unless there are too many for a picture.
    pub share_drawn: f64,
    /// Corners, m.
    pub points: Vec<Point3<f64>>,
    /// Three corners each.
    pub triangles: Vec<[u32; 3]>,
}

/// The target patch, then every surface of the scene without it, in the scene's order; parts that
/// move with the nozzle as they are at a pose.
pub(super) fn all(scenario: &Scenario, pose: &Pose) -> Vec<Shape> {
    let target = &scenario.target;
    let (patch, rest) = target.cut_out(&scenario.scene);
    let shape = |surface, is_target, triangles: &[Triangle]| {
        let mut shape = Shape::of(triangles);
        (shape.surface, shape.is_target) = (surface, is_target);
        shape
    };
    let mut shapes = vec![shape(target.surface, true, &patch)];
    for surface in 0..scenario.surfaces.len() as u32 {
        if surface != target.surface {
            shapes.push(shape(
                surface,
                false,
                &triangles_at(scenario, pose, surface),
            ));
        } else if target.within.is_some() {
            shapes.push(shape(surface, false, &rest));
        }
    }
    shapes
}

/// The triangles of a surface as they are when the nozzle stands at a pose.
fn triangles_at(scenario: &Scenario, pose: &Pose, surface: u32) -> Vec<Triangle> {
    let triangles = scenario.scene.surface_triangles(surface);
    if !scenario.scene.surface_moves_with_nozzle(surface) {
        return triangles.collect();
    }
    let nozzle_frame = pose.nozzle_frame();
    triangles
        .map(|corners| corners.map(|corner| nozzle_frame.point_back(&corner)))
        .collect()
}

impl Shape {
    /// Triangles with equal corners made one; those without area are left out.
    pub(super) fn of(triangles: &[Triangle]) -> Self {
        let mut known: HashMap<[u64; 3], u32> = HashMap::new();
        let mut points = Vec::new();
        let mut index = |point: &Point3<f64>| {
            // Adding 0 makes -0 the same as 0.
            let bits = [point.x, point.y, point.z].map(|x| (x + 0.0).to_bits());
            *known.entry(bits).or_insert_with(|| {
                points.push(*point);
                points.len() as u32 - 1
            })
        };
        let is_flat = |[a, b, c]: &&Triangle| (b - a).cross(&(c - a)).norm_squared() == 0.0;
        let triangles = triangles
            .iter()
            .filter(|triangle| !is_flat(triangle))
            .map(|corners| [0, 1, 2].map(|i| index(&corners[i])))
            .collect();
        Self {
            surface: 0,
            is_target: false,
            share_drawn: 1.0,
            points,
            triangles,
        }
    }
}
