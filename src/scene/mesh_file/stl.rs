//! STL: tells binary from text, and reads the binary form.

use std::io::{BufRead, Read, Seek, SeekFrom};

use super::MOST_TRIANGLES;
use super::assembly::{ALL, Assembly};
use super::defect::Defect;
use super::fault::{MeshFault, Place};
use super::stl_layout::{self, Layout, Record};

/// Bytes before the first triangle: 80 of comment and the number of triangles.
pub(super) const HEADER: u64 = 84;

/// Whether a file of this many bytes that begins like this is binary STL of the size that its header
/// promises, whatever it begins with: many programs write `solid` there.
pub(super) fn is_binary(head: &[u8], bytes: u64) -> bool {
    promised(head).is_some_and(|count| stl_layout::fits(bytes.saturating_sub(HEADER), count))
}

/// Whether a file that begins like this, and that is not binary by its size, is text STL.
pub(super) fn is_text(head: &[u8]) -> bool {
    let head = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head);
    let text = head.to_ascii_lowercase();
    let start = text.trim_ascii_start();
    let holds = |word: &[u8]| text.windows(word.len()).any(|window| window == word);
    let starts = start.starts_with(b"solid") || start.starts_with(b"facet");
    // A binary header may begin with `solid`, too; but triangles are full of zero bytes.
    starts && (holds(b"facet") || holds(b"endsolid") || !text.contains(&0))
}

/// Reads a binary STL file of this many bytes into the assembly.
pub(super) fn read(
    source: &mut (impl BufRead + Seek),
    head: &[u8],
    bytes: u64,
    assembly: &mut Assembly,
) -> Result<(), MeshFault> {
    let whole = |defect: Defect| defect.at(Place::File);
    let looks_binary = head.contains(&0) || !head.is_ascii();
    let promised = promised(head).filter(|_| is_binary(head, bytes) || looks_binary);
    let promised = promised.ok_or_else(|| {
        let expected =
            "`solid` at the start of a text STL file or the 84 byte header of a binary one";
        Defect::unexpected(expected, head).at(Place::Line(1))
    })?;
    let body = bytes.saturating_sub(HEADER);
    let layout = stl_layout::find(source, body, promised)?;
    let triangles = usize::try_from(layout.count)
        .ok()
        .filter(|count| *count <= MOST_TRIANGLES)
        .ok_or(whole(Defect::TooManyTriangles))?;
    assembly.expect_triangles(triangles);
    let start = source.seek(SeekFrom::Start(HEADER));
    start.map_err(|error| whole(error.into()))?;
    triangles_of(source, &layout, assembly)?;
    if let Some(mending) = layout.mending {
        assembly.mended(mending);
    }
    if layout.must_close {
        let held = layout.count;
        assembly.must_close(whole(Defect::WrongCount {
            promised,
            held,
            rest: 0,
        }));
    }
    Ok(())
}

fn triangles_of(
    source: &mut impl Read,
    layout: &Layout,
    assembly: &mut Assembly,
) -> Result<(), MeshFault> {
    let surface = assembly.surface(ALL);
    for number in 1..=layout.count {
        let here = |defect: Defect| defect.at(Place::Triangle(number));
        let record = Record::read(source).map_err(|error| here(error.into()))?;
        let mut corners = [0; 3];
        for (corner, coordinates) in corners.iter_mut().zip(record.corners()) {
            *corner = assembly.vertex(coordinates).map_err(here)?;
        }
        assembly.triangle(corners, surface).map_err(here)?;
        if layout.has_vendor_bytes {
            record
                .pass_over_vendor_bytes(source)
                .map_err(|error| here(error.into()))?;
        }
    }
    Ok(())
}

/// The number of triangles in the header.
fn promised(head: &[u8]) -> Option<u64> {
    let count = head.get(HEADER as usize - 4..HEADER as usize)?;
    Some(u64::from(u32::from_le_bytes(count.try_into().ok()?)))
}
