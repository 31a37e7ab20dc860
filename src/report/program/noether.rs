//! `stroke.yaml`: tool paths as Noether reads them: paths of segments of poses, in m.

use std::fmt::Write as _;

use super::Move;

/// One tool path with a segment for each pass.
pub fn write(moves: &[Move]) -> String {
    let mut text = String::new();
    let mut pass = 0;
    for it in moves {
        let marks = match (pass == it.pass, pass) {
            (true, _) => "    - ",
            (false, 0) => "- - - ",
            (false, _) => "  - - ",
        };
        pass = it.pass;
        let [x, y, z] = it.to.pose.exit_m;
        let [qx, qy, qz, qw] = it.to.pose.quaternion_xyzw;
        let _ = writeln!(
            text,
            "{marks}{{ x: {x}, y: {y}, z: {z}, qw: {qw}, qx: {qx}, qy: {qy}, qz: {qz} }}"
        );
    }
    text
}
