//! STL as text: one statement a line, in small or capital letters.

use std::io::BufRead;

use super::assembly::Assembly;
use super::defect::Defect;
use super::fault::{MeshFault, Place};
use super::lines::{self, Line, Lines, coordinates, words};

/// Reads a text STL file into the assembly.
pub(super) fn read(source: impl BufRead, assembly: &mut Assembly) -> Result<(), MeshFault> {
    let mut lines = Lines::new(source);
    let mut names: Vec<String> = Vec::new();
    while let Some(line) = lines.next()? {
        if line.text.trim_ascii().is_empty() {
            continue;
        }
        let rest = statement(line, &["solid"], "`solid` and a name")?;
        let name = lines::name(rest);
        // The number keeps solids apart whose names are equal, until all are known.
        let surface = assembly.surface(&format!("{} {name}", names.len()));
        names.push(name);
        solid(&mut lines, surface, assembly)?;
    }
    if names.is_empty() {
        return Err(Defect::NoTriangles.at(Place::File));
    }
    if are_telling(&names) {
        assembly.rename_surfaces(names);
    } else {
        assembly.forget_surfaces();
    }
    Ok(())
}

/// Reads the facets of a solid and its end.
fn solid(
    lines: &mut Lines<impl BufRead>,
    surface: u32,
    assembly: &mut Assembly,
) -> Result<(), MeshFault> {
    const FACET: &str = "`facet normal` or `endsolid`";
    loop {
        let line = lines.next_filled(FACET)?;
        if statement(line, &["endsolid"], FACET).is_ok() {
            return Ok(());
        }
        statement(line, &["facet"], FACET)?;
        expect(lines, &["outer", "loop"], "`outer loop`")?;
        let mut corners = [0; 3];
        for corner in &mut corners {
            let line = lines.next_filled("`vertex`")?;
            let rest = statement(line, &["vertex"], "`vertex` and three coordinates")?;
            *corner = coordinates(&mut words(rest))
                .and_then(|coordinates| assembly.vertex(coordinates))
                .map_err(|defect| line.fault(defect))?;
        }
        expect(lines, &["endloop"], "`endloop` after three corners")?;
        expect(lines, &["endfacet"], "`endfacet`")?;
        assembly
            .triangle(corners, surface)
            .map_err(|defect| defect.at(Place::Line(lines.number())))?;
    }
}

fn expect(
    lines: &mut Lines<impl BufRead>,
    keywords: &[&str],
    expected: &'static str,
) -> Result<(), MeshFault> {
    let line = lines.next_filled(expected)?;
    statement(line, keywords, expected).map(|_| ())
}

/// What follows the keywords of a statement.
fn statement<'a>(
    line: Line<'a>,
    keywords: &[&str],
    expected: &'static str,
) -> Result<&'a [u8], MeshFault> {
    let mut rest = line.text;
    for keyword in keywords {
        rest = rest.trim_ascii_start();
        let end = rest
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(rest.len());
        let (word, after) = rest.split_at(end);
        if !word.eq_ignore_ascii_case(keyword.as_bytes()) {
            return Err(line.unexpected(expected));
        }
        rest = after;
    }
    Ok(rest)
}

/// Whether the names tell several solids apart.
fn are_telling(names: &[String]) -> bool {
    let mut sorted: Vec<&str> = names.iter().map(String::as_str).collect();
    sorted.sort_unstable();
    sorted.len() > 1 && !sorted[0].is_empty() && sorted.windows(2).all(|pair| pair[0] != pair[1])
}
