//! STL: tells binary from text, and reads the binary form.

use std::io::{BufRead, Read};

use super::assembly::{ALL, Assembly};
use super::defect::Defect;
use super::fault::{MeshFault, Place};
use super::{MOST_TRIANGLES, stl_text};

/// Bytes before the first triangle: 80 of comment and the number of triangles.
const HEADER: usize = 84;
/// Bytes of a triangle: its normal and corners as twelve f32, two bytes of attributes.
const RECORD: usize = 50;
/// Where the corners begin in a record.
const CORNERS: usize = 12;

/// Reads an STL file of so many bytes into the assembly.
///
/// A file is binary if its size is right for the number of triangles in its header, whatever that
/// begins with: many programs write `solid` there. Otherwise it is text if it begins with `solid`
/// and no zero byte stands in its first lines.
pub(super) fn read(
    mut source: impl BufRead,
    bytes: u64,
    assembly: &mut Assembly,
) -> Result<(), MeshFault> {
    let mut header = Vec::with_capacity(HEADER);
    (&mut source)
        .take(HEADER as u64)
        .read_to_end(&mut header)
        .map_err(|error| Defect::from(error).at(Place::File))?;
    let promised = header
        .get(HEADER - 4..)
        .and_then(|count| count.try_into().ok());
    let promised = promised.map(u32::from_le_bytes).map(u64::from);
    let body = bytes.saturating_sub(HEADER as u64);
    // one line end after the last triangle does no harm
    let fits = |count: u64| (0..=2).contains(&(body as i64 - (count * RECORD as u64) as i64));
    let is_text = !header.contains(&0)
        && header
            .trim_ascii_start()
            .get(..5)
            .is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    match promised {
        Some(promised) if fits(promised) => read_binary(source, promised, assembly),
        _ if is_text => stl_text::read(header.as_slice().chain(source), assembly),
        Some(promised) if header.contains(&0) || !header.is_ascii() => Err(Defect::WrongCount {
            promised,
            held: body / RECORD as u64,
        }
        .at(Place::File)),
        _ => Err(Defect::unexpected(
            "`solid` at the start of a text STL file or the 84 byte header of a binary one",
            &header,
        )
        .at(Place::Line(1))),
    }
}

fn read_binary(
    mut source: impl Read,
    count: u64,
    assembly: &mut Assembly,
) -> Result<(), MeshFault> {
    let triangles = usize::try_from(count)
        .ok()
        .filter(|count| *count <= MOST_TRIANGLES)
        .ok_or(Defect::TooManyTriangles.at(Place::File))?;
    assembly.expect_triangles(triangles);
    let surface = assembly.surface(ALL);
    let mut record = [0; RECORD];
    for number in 1..=count {
        let here = |defect: Defect| defect.at(Place::Triangle(number));
        source
            .read_exact(&mut record)
            .map_err(|error| here(error.into()))?;
        let mut corners = [0; 3];
        for (corner, bytes) in corners.iter_mut().zip(record[CORNERS..].chunks_exact(12)) {
            let mut coordinates = [0.0; 3];
            for (coordinate, digits) in coordinates.iter_mut().zip(bytes.as_chunks::<4>().0) {
                *coordinate = f64::from(f32::from_le_bytes(*digits));
            }
            *corner = assembly.vertex(coordinates).map_err(here)?;
        }
        assembly.triangle(corners, surface).map_err(here)?;
    }
    Ok(())
}
