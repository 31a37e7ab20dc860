//! The same worlds of triangles seen in other ways.

use nalgebra::Vector3;
use peenpose::jet::ShotSample;
use peenpose::scenario::Scenario;
use peenpose::trace::PathImpact;
use proptest::prelude::*;

use crate::common::cases::cases;
use crate::physics_properties::conditioning::starts_in_a_wall;
use crate::physics_properties::view::{PLAIN, View, path};
use crate::physics_properties::views::{figures, same_in, same_in_mirror, shots};
use crate::physics_properties::world::meshed_world;

/// All digits of every impact of a shot, with the name of what it meets.
fn impacts(scenario: &Scenario, shot: &ShotSample) -> Vec<String> {
    let told = |impact: &PathImpact| {
        let surface = &scenario.scene.surfaces()[impact.surface as usize];
        let impact = PathImpact {
            surface: 0,
            ..*impact
        };
        format!("{surface} {impact:?}")
    };
    path(scenario, shot).iter().map(told).collect()
}

proptest! {
    #![proptest_config(cases(40))]

    #[test]
    fn turned_and_moved_meshes_have_turned_and_moved_paths(
        world in meshed_world(),
        turn in [-180.0..180.0, -180.0..180.0, -180.0..180.0],
        shift in [-0.1..0.1, -0.1..0.1, -0.1..0.1],
    ) {
        let shift = Vector3::from(shift);
        same_in(&View { turn, shift, ..PLAIN }, &world)?;
    }

    #[test]
    fn scaled_meshes_have_scaled_impulses_and_the_same_objective(
        world in meshed_world(),
        length in 0.05..20.0,
        density in 0.1..10.0,
        speed in 0.1..10.0,
    ) {
        same_in(&View { length, density, speed, ..PLAIN }, &world)?;
    }

    #[test]
    fn units_of_mesh_files_say_the_same(world in meshed_world()) {
        for unit in [(1.0, "m"), (1e6, "um"), (1.0 / 25.4e-3, "in")] {
            same_in(&View { unit, ..PLAIN }, &world)?;
        }
    }

    #[test]
    fn mirrored_meshes_have_mirrored_paths(world in meshed_world()) {
        same_in_mirror(&world)?;
    }

    /// To the last bit.
    #[test]
    fn names_of_groups_do_not_matter(world in meshed_world()) {
        let prefix = "zz_";
        let renamed = View { prefix, ..PLAIN }.of(&world);
        prop_assert_eq!(figures(&PLAIN.of(&world), prefix), figures(&renamed, prefix));
    }

    /// Of parts, and of triangles and groups in their files; to the last bit.
    #[test]
    fn order_in_mesh_files_does_not_matter(world in meshed_world()) {
        let (one, other) = (PLAIN.of(&world), View { backwards: true, ..PLAIN }.of(&world));
        let shots = shots(&one, 256);
        // Those in two triangles at once meet the one that comes first.
        let free: Vec<_> = shots.iter().filter(|shot| !starts_in_a_wall(&one, shot)).collect();
        prop_assert!(free.len() * 8 > shots.len(), "{}", free.len());
        for shot in free {
            prop_assert_eq!(impacts(&one, shot), impacts(&other, shot));
        }
    }
}
