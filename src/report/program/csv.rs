//! `stroke.csv`: a row for each waypoint of each pass, lengths in mm.

use std::fmt::Display;
use std::io;

use super::Move;
use crate::report::table::Rows;

pub fn write(moves: &[Move]) -> io::Result<String> {
    let mut table = Rows::headed(
        "stroke",
        &[
            "pass",
            "path_mm",
            "x_mm",
            "y_mm",
            "z_mm",
            "axis_x",
            "axis_y",
            "axis_z",
            "qx",
            "qy",
            "qz",
            "qw",
            "turn_deg",
            "feed_spot_mm_min",
            "feed_tip_mm_min",
        ],
    )?;
    for it in moves {
        let pose = &it.to.pose;
        let path = it.path * 1e3;
        let [x, y, z] = pose.exit_m.map(|length| length * 1e3);
        let [axis_x, axis_y, axis_z] = pose.direction;
        let [qx, qy, qz, qw] = pose.quaternion_xyzw;
        let per_minute =
            |feed: Option<f64>| feed.map_or(String::new(), |feed| (feed * 6e4).to_string());
        let (spot, tip) = (per_minute(it.at_spot), per_minute(it.at_tip));
        let cells: [&dyn Display; 15] = [
            &it.pass,
            &path,
            &x,
            &y,
            &z,
            &axis_x,
            &axis_y,
            &axis_z,
            &qx,
            &qy,
            &qz,
            &qw,
            &it.to.turn_deg,
            &spot,
            &tip,
        ];
        table.row(&cells)?;
    }
    Ok(table.finish()?.csv)
}
