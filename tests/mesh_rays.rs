//! Shots in closed meshes of every kind, as points and with a size: none gets out, none hits what it
//! has just left, none is stuck.

#[path = "mesh_rays/random.rs"]
mod random;
#[path = "mesh_rays/rooms.rs"]
mod rooms;
#[path = "mesh_rays/solids.rs"]
mod solids;
#[path = "mesh_rays/walk.rs"]
mod walk;

use std::time::Instant;

use rayon::prelude::*;
use rooms::{Room, rooms};
use walk::{Count, Walk};

/// Casts of one walk, and of how many walks one is a sphere's.
const CASTS_OF_A_WALK: u64 = 5000;
const POINTS_PER_SPHERE: u64 = 5;

/// Walks in one room, each with random numbers of its own.
fn walks(room: &Room, casts: u64) -> Count {
    let walks = 0..casts.div_ceil(CASTS_OF_A_WALK).max(POINTS_PER_SPHERE);
    let counts = walks.into_par_iter().map(|number| {
        let is_sphere = number % POINTS_PER_SPHERE == 0;
        let radius = if is_sphere { room.radius } else { 0.0 };
        let seed = number.wrapping_mul(0x5851_F42D_4C95_7F2D);
        let mut walk = Walk::new(room, seed, radius);
        walk.run(CASTS_OF_A_WALK);
        walk.count
    });
    counts.reduce(Count::default, |mut all, one| {
        all += one;
        all
    })
}

/// Lets shots fly about in every room; says how they fared.
fn all_walks(casts: f64) {
    let rooms = rooms();
    let shares: f64 = rooms.iter().map(|room| room.share).sum();
    let mut all = Count::default();
    for room in &rooms {
        let start = Instant::now();
        let count = walks(room, (casts * room.share / shares).ceil() as u64);
        println!(
            "{:24} {:>7} triangles {:>11} casts, {:>10} of spheres: {} leaks, {} self-hits, {} stuck; {:.1} s",
            room.name,
            room.triangles.len(),
            count.casts,
            count.of_spheres,
            count.leaks,
            count.self_hits,
            count.stuck,
            start.elapsed().as_secs_f64()
        );
        count.notes.iter().for_each(|note| println!("{note}"));
        all += count;
    }
    println!("{} casts, {} faults", all.casts, all.faults());
    assert!(all.casts as f64 >= casts && all.of_spheres as f64 >= casts / 20.0);
    assert_eq!(all.faults(), 0, "{all:#?}");
}

#[test]
fn shots_stay_in_closed_meshes() {
    all_walks(2e5);
}

/// How many casts is told by the environment:
/// `PEENPOSE_CASTS=1e9 cargo test --release --test mesh_rays -- --ignored --nocapture`
#[test]
#[ignore = "takes a minute in release"]
fn ten_million_casts_stay_in_closed_meshes() {
    let casts = std::env::var("PEENPOSE_CASTS").map_or(1e7, |count| count.parse().unwrap());
    all_walks(casts);
}
