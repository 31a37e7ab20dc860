//! Damaged meshes: each kind of damage is told with its count, its place and what it means for the
//! answer; and shots fly as in the sound mesh, but for those that meet a hole.

mod block;

use crate::common::program;
use std::ffi::OsStr;
use std::path::Path;

use crate::common::held::held;
use block::{Block, CELLS};
use peenpose::jet::{Samples, Stream};
use peenpose::objective::Tally;
use peenpose::scenario::Scenario;
use tempfile::TempDir;

/// A block under a jet, with a lid that sends shots back.
const PROBLEM: &str = "
format: 1
lengths_in: mm
scene:
  block: { mesh: block.obj }
  lid: { box: { min: [-20, -20, 12], max: [20, 20, 14] } }
target: { surface: block.top, aim: [1.3, 0.7, 0], along: [1, 0, 0] }
shot: { radius: 0.2 mm, density: 7000 kg/m3 }
jet: { exit_diameter: 6 mm, divergence: 20 deg }
contacts:
  only: { mu_s: 0.15, mu_d: 0.075, restitution: 0.7 }
settings: { incidence: 70 deg, azimuth: 20 deg, standoff: 8 mm, speed: 20 m/s }
goals:
  normal_impulse: { target: 5 uN.s }
  tangential_impulse: { limit: 1 uN.s }
  rebound: { allow: 1 uN.s }
";

struct Case {
    folder: TempDir,
}

impl Case {
    fn new(block: &Block) -> Self {
        let folder = TempDir::new().unwrap();
        std::fs::write(folder.path().join("block.obj"), block.obj()).unwrap();
        std::fs::write(folder.path().join("block.yaml"), PROBLEM).unwrap();
        Self { folder }
    }

    /// The same with the free side given.
    fn faced(block: &Block) -> Self {
        let case = Self::new(block);
        let faced = PROBLEM.replace(
            "along: [1, 0, 0] }",
            "along: [1, 0, 0], facing: [0, 0, 1] }",
        );
        std::fs::write(case.folder.path().join("block.yaml"), faced).unwrap();
        case
    }

    /// What `peenpose check` says.
    fn check(&self) -> String {
        let path = self.folder.path().join("block.yaml");
        let arguments = [OsStr::new("check"), path.as_os_str()];
        let run = program::peenpose(arguments, Path::new("."));
        assert_eq!(run.status, 0, "{}", run.messages);
        run.out
    }

    /// What 4000 shots do, as points or with their size.
    fn tally(&self, shots_have_size: bool) -> Tally {
        let (mut scenario, _) = Scenario::load(&self.folder.path().join("block.yaml")).unwrap();
        scenario.problem.paths.shot_size = shots_have_size;
        let settings = held(&scenario);
        let shots = Samples::new(&scenario.problem, Stream::Search, 4000).shots;
        Tally::trace(&scenario, &settings, settings.speed, &shots)
    }
}

/// The damage is told in these words, and every shot does what it does in the sound mesh.
fn harmless(damage: impl FnOnce(&mut Block), words: &[&str]) {
    let sound = Case::new(&Block::new());
    assert!(!sound.check().contains("warning"), "{}", sound.check());
    let mut block = Block::new();
    damage(&mut block);
    let damaged = Case::new(&block);
    let said = damaged.check();
    for words in words {
        assert!(said.contains(words), "`{words}` is not in\n{said}");
    }
    for shots_have_size in [false, true] {
        let (expected, found) = (sound.tally(shots_have_size), damaged.tally(shots_have_size));
        assert!(expected.rays > 3 * expected.shots, "{}", expected.rays);
        assert_eq!(found.rays, expected.rays);
        assert_eq!(found.hits.len(), expected.hits.len());
        for (found, expected) in found.hits.iter().zip(expected.hits.iter()) {
            assert!((found.normal / expected.normal - 1.0).abs() < 1e-12);
        }
        assert!((found.rebound / expected.rebound - 1.0).abs() < 1e-9);
    }
}

#[test]
fn flipped_faces_are_turned_back() {
    // Three of them under the jet, one at the bottom.
    let flip = |block: &mut Block| {
        for number in [60, 61, 75, 200] {
            block.triangles[number].reverse();
        }
    };
    let words = [
        "4 triangles are turned to agree with the neighbours about the front, one of them near (",
        "; the answer is that of the mesh with fronts that agree",
    ];
    harmless(flip, &words);
}

#[test]
fn a_face_that_is_mostly_flipped_does_not_turn_the_target() {
    let flip = |block: &mut Block| {
        let top = &mut block.triangles[..2 * CELLS * CELLS];
        top.iter_mut().for_each(|corners| corners.reverse());
    };
    harmless(flip, &["128 triangles are turned"]);
}

#[test]
fn duplicate_faces_count_once() {
    let repeat = |block: &mut Block| {
        let mut backwards = block.triangles[70];
        backwards.reverse();
        block.triangles.extend([block.triangles[60], backwards]);
    };
    let words = [
        "2 duplicate triangles are dropped, one of them near (",
        "the answer is the same without the others",
    ];
    harmless(repeat, &words);
}

#[test]
fn faces_without_area_are_dropped() {
    let flatten = |block: &mut Block| {
        let [a, b, _] = block.triangles[60];
        block.triangles.push([a, b, b]);
    };
    let words = [
        "1 triangle of zero area is dropped, near (",
        "; the answer is the same without",
    ];
    harmless(flatten, &words);
}

#[test]
fn edges_of_more_than_two_faces_are_told() {
    // Another body that touches the block along an edge at the bottom.
    let body = |block: &mut Block| {
        let [a, b, _] = block.triangles[200];
        let [c, d] = [[1.0, 1.0, -30.0], [4.0, 1.0, -30.0]].map(|tip| block.add(tip));
        let faces = [[a, c, b], [a, b, d], [b, c, d], [a, d, c]];
        block.triangles.extend(faces);
    };
    let words = [
        "1 edge is shared by more than two triangles, near (",
        "shots bounce off all of their faces",
    ];
    harmless(body, &words);
}

#[test]
fn seams_between_faces_that_do_not_share_corners_are_told_from_holes() {
    let split = |block: &mut Block| block.split_on_one_side(60);
    let words = [
        "3 edges in the mesh, where triangles meet without sharing their corners, one of them near (",
        "narrower than a millionth of the part, and so is the share of the shots",
    ];
    harmless(split, &words);
    let mut block = Block::new();
    block.split_on_one_side(60);
    assert!(!Case::new(&block).check().contains("open edge"));
}

#[test]
fn tiny_pieces_are_told() {
    let crumb = |block: &mut Block| {
        let corners = [
            [0.0, 0.0, -13.0],
            [0.1, 0.0, -13.0],
            [0.0, 0.1, -13.0],
            [0.0, 0.0, -12.9],
        ];
        let [a, b, c, d] = corners.map(|corner| block.add(corner));
        let faces = [[a, c, b], [a, b, d], [b, c, d], [a, d, c]];
        block.triangles.extend(faces);
    };
    let words = [
        "1 piece is not joined to the rest and less than a hundredth of its size, near (0, 0, -13)",
        "shots bounce off them as well",
    ];
    harmless(crumb, &words);
}

/// A small hole in a part that is closed otherwise leaves its free side and all shots that do not meet
/// it alone.
#[test]
fn small_holes_are_told_and_cost_only_the_shots_that_meet_them() {
    let sound = Case::new(&Block::new());
    let mut block = Block::new();
    block.pierce_first();
    let damaged = Case::new(&block);
    let said = damaged.check();
    for words in [
        "3 open edges in the mesh, one of them near (",
        ": shots can leave there; the holes are small, and only shots that meet one go wrong",
    ] {
        assert!(said.contains(words), "`{words}` is not in\n{said}");
    }
    let (expected, found) = (sound.tally(true), damaged.tally(true));
    assert_eq!(found.rays, expected.rays);
    assert!((found.rebound / expected.rebound - 1.0).abs() < 1e-9);
}

#[test]
fn large_holes_are_told() {
    let mut block = Block::new();
    // All of its bottom.
    block.triangles.drain(2 * CELLS * CELLS..4 * CELLS * CELLS);
    let said = Case::faced(&block).check();
    for words in [
        "32 open edges in the mesh, one of them near (",
        "close the mesh, or where the part is meant to be open, give `facing`",
    ] {
        assert!(said.contains(words), "`{words}` is not in\n{said}");
    }
}
