//! `peenpose surfaces`.

use std::fs;
use std::path::Path;

use crate::common::program::{self, Run};

fn peenpose(arguments: &[&str]) -> Run {
    program::peenpose(arguments, Path::new(env!("CARGO_MANIFEST_DIR")))
}

#[test]
fn faces_are_listed_and_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("faces.svg");
    let file = "problems/hub-blind-keyway.obj";
    let run = peenpose(&["surfaces", file, "--out", picture.to_str().unwrap()]);
    assert_eq!(run.status, 0, "{}", run.messages);
    for words in [
        "hole, radius 15,",
        "cylinder, radius 25,",
        "plane, normal 0 -1 0",
        "12 faces",
    ] {
        assert!(run.out.contains(words), "{words} is not in\n{}", run.out);
    }
    let svg = fs::read_to_string(picture).unwrap();
    assert_eq!(svg.matches("<image").count(), 6);
    // Whatever the number of triangles is, pixels are as many.
    assert!(svg.len() < 500_000, "{} bytes", svg.len());
    // The floor, walls and ends of the groove are seen where the hub is cut open, or through its mouth.
    for number in 1..=12 {
        assert!(svg.contains(&format!(">{number}</text>")), "no {number}");
    }
    let few = peenpose(&["surfaces", file, "--most", "2"]);
    assert!(
        few.out.contains("10 smaller ones are not shown"),
        "{}",
        few.out
    );
    for (arguments, words) in [
        (&["surfaces", "none.stl"][..], "none.stl"),
        (&["surfaces", file, "--angle", "90 deg"], "less than 90 deg"),
        (&["surfaces", file, "--angle", "3"], "--angle"),
    ] {
        let run = peenpose(arguments);
        assert_eq!((run.status, run.out.as_str()), (2, ""));
        assert!(run.messages.contains(words), "{}", run.messages);
    }
}
