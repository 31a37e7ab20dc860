//! Shots in closed meshes of every kind, as points and with a size: none gets out, none hits what it
//! has just left, none is stuck.

mod random;
mod rooms;
mod solids;
mod walk;

use std::time::Instant;

use peenpose::scene::ray::{HitId, Ray};
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
    let only = std::env::var("PEENPOSE_ROOM").unwrap_or_default();
    let mut rooms = rooms();
    rooms.retain(|room| room.name.contains(&only));
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

/// How many casts is told by the environment, and in which rooms, if not in all:
/// `PEENPOSE_CASTS=1e8 PEENPOSE_ROOM=stairs cargo test --release --test geometry mesh_rays -- --ignored --nocapture`
#[test]
#[ignore = "takes half a minute"]
fn ten_million_casts_stay_in_closed_meshes() {
    let casts = std::env::var("PEENPOSE_CASTS").map_or(1e7, |count| count.parse().unwrap());
    all_walks(casts);
}

/// Rays that come to a corner of a facet so flat that rounding moves where they meet its plane by 1e-10 to
/// 1e-5 of its size: what they meet first there is this facet and not the backs of those behind it. Each
/// with the facet that it leaves.
#[test]
fn grazing_rays_do_not_slip_through_at_corners() {
    all_meet_fronts("spikes and dents", &GRAZING_RAYS);
}

/// Rays that run in the plane of a facet: they neither go through the next one in this plane nor
/// meet the back of the one beyond its edge.
#[test]
fn rays_along_facets_do_not_slip_through_at_edges() {
    all_meet_fronts("stairs", &[ALONG_A_STEP]);
    all_meet_fronts("gap of a micrometre", &[ALONG_A_GAP]);
}

/// The facet that a ray leaves, where it starts, m, and its direction.
type Leaving = (u32, [f64; 3], [f64; 3]);

fn all_meet_fronts(name: &str, rays: &[Leaving]) {
    let rooms = rooms();
    let room = rooms.iter().find(|room| room.name == name).unwrap();
    for &(piece, origin, direction) in rays {
        let ray = Ray {
            origin: origin.into(),
            direction: direction.into(),
        };
        let leaving = HitId {
            part: 0,
            piece,
            front: !room.is_hollow,
        };
        let hit = room
            .scene
            .first_hit(&ray, Some(leaving))
            .expect("the mesh is closed");
        assert!(room.shows(&hit.hit_id), "{piece}: {hit:?}");
    }
}

#[rustfmt::skip]
const ALONG_A_STEP: Leaving =
    (835, [0.007126772744263015, 0.0048828125, 0.0009765624999992676], [-0.9382678131193981, 0.0, -0.3459096859935296]);
#[rustfmt::skip]
const ALONG_A_GAP: Leaving =
    (6658, [-0.04473813140252604, 0.0007453057582945551, 0.04479265914037489], [0.7024517325041854, -0.18909459505675252, -0.686152167978934]);

#[rustfmt::skip]
const GRAZING_RAYS: [Leaving; 11] = [
    (319, [-0.00011201444112346881, 0.006997253903423467, 0.01964957311901516], [-0.0526027039549817, -0.36830651266455455, -0.9282150980594416]),
    (774, [-0.003948674937052885, 0.016811402240274307, -0.014572782655758105], [0.16155952518879543, -0.7692359727616607, 0.6182026674402116]),
    (152, [-0.014454532541278266, -0.013407478815675118, -0.009474610271452194], [0.6621378185327452, 0.6431529229042771, 0.38461386744159703]),
    (614, [-4.161829563652159e-07, -0.02649144436635736, -0.010911269403016812], [-0.03442952401768147, 0.9341489875889856, 0.35521863248201]),
    (464, [0.018016410643546144, 0.012123657941532825, -0.0031920544818162893], [-0.859228266109634, -0.5083559187186898, 0.05745473541762101]),
    (557, [0.01317368427821525, -0.0007643352362091646, 0.024363260300335036], [-0.4270375192734066, 0.03040896381797279, -0.9037224419324398]),
    (483, [0.0009028407461726785, 0.010151784339117962, 0.008733900527322985], [0.0167312586794099, -0.8465405098991352, -0.5320613029367149]),
    (389, [-0.0016163616941008993, 0.012405525890822987, -0.00042008887591328054], [0.08916159971733559, -0.9932184270189127, -0.07461477980884451]),
    (700, [0.01864709661509724, -0.00886437842157924, -0.0016004808204783468], [-0.90590688055396, 0.40227339419072083, 0.1323209737391249]),
    (319, [-0.0007584381239256198, 0.0076318264747678305, 0.02013883504353245], [0.027055444122851244, -0.4126569548704279, -0.9104846185083969]),
    (553, [0.01456903895889275, -0.0036326903078353926, 0.024886884148371428], [-0.5460567531544828, 0.1336984110692465, -0.8270107358504742]),
];
