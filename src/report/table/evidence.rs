//! The tables of what pictures are drawn from: hits, rebounds, places.

use std::io;

use super::{Rows, Table, or_empty};
use crate::record::{EvidenceRecord, HitsRecord, PlaceRecord, ReboundsRecord};

pub(super) fn all(evidence: &EvidenceRecord) -> io::Result<[Table; 3]> {
    Ok([
        hits(&evidence.hits)?,
        rebounds(evidence)?,
        places(&evidence.places)?,
    ])
}

/// One row for each first hit on the target; `along` and `across` are measured from the aim point.
fn hits(hits: &HitsRecord) -> io::Result<Table> {
    let mut table = Rows::headed(
        "hits",
        &[
            "x_m",
            "y_m",
            "z_m",
            "along_m",
            "across_m",
            "angle_deg",
            "normal_impulse_N_s",
            "tangential_impulse_N_s",
            "sticks",
        ],
    )?;
    let columns = hits
        .points_m
        .iter()
        .zip(&hits.plane_m)
        .zip(&hits.angle_deg)
        .zip(&hits.normal_impulse)
        .zip(&hits.tangential_impulse)
        .zip(&hits.sticks);
    for (((((point, plane), angle), normal), tangential), sticks) in columns {
        let ([x, y, z], [along, across]) = (point, plane);
        table.row(&[x, y, z, along, across, angle, normal, tangential, sticks])?;
    }
    table.finish()
}

/// One row for each impact on a secondary surface; the number is 1 for a direct hit.
fn rebounds(evidence: &EvidenceRecord) -> io::Result<Table> {
    let mut table = Rows::headed(
        "rebounds",
        &[
            "x_m",
            "y_m",
            "z_m",
            "surface",
            "number",
            "normal_impulse_N_s",
        ],
    )?;
    let ReboundsRecord {
        points_m,
        surface,
        number,
        normal_impulse,
    } = &evidence.rebounds;
    let columns = points_m.iter().zip(surface).zip(number).zip(normal_impulse);
    for (((point, surface), number), normal) in columns {
        let shape = evidence.surfaces.get(*surface as usize);
        let [x, y, z] = point;
        let name = or_empty(shape.map(|shape| &shape.name));
        table.row(&[x, y, z, &name, number, normal])?;
    }
    table.finish()
}

/// Where to put test strips.
fn places(places: &[PlaceRecord]) -> io::Result<Table> {
    let mut table = Rows::headed(
        "places",
        &[
            "place", "surface", "x_m", "y_m", "z_m", "normal_x", "normal_y", "normal_z", "value",
            "unit", "text",
        ],
    )?;
    for place in places {
        let unit = match place.name.as_str() {
            "most_grazing" => "deg",
            "shadow_edge" | "beginning_of_stroke" | "middle_of_stroke" | "end_of_stroke" => "m",
            "least_dented" => "1",
            _ => "N s",
        };
        let ([x, y, z], [a, b, c]) = (place.point_m, place.normal);
        table.row(&[
            &place.name,
            &place.surface,
            &x,
            &y,
            &z,
            &a,
            &b,
            &c,
            &place.value,
            &unit,
            &place.text,
        ])?;
    }
    table.finish()
}
