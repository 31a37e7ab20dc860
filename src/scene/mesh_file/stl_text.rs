//! STL as text: words in small or capital letters, usually one statement a line.

use std::collections::BTreeMap;
use std::io::BufRead;

use super::assembly::{ALL, Assembly};
use super::defect::Defect;
use super::fault::{MeshFault, Place};
use super::lines::{self, Line, Lines, coordinates};
use super::mending::Mending;

/// Reads a text STL file into the assembly.
///
/// Solids of the same name are one surface, and those without a name belong to [`ALL`]. Where the
/// names do not tell the solids apart, all belong to it.
pub(super) fn read(source: impl BufRead, assembly: &mut Assembly) -> Result<(), MeshFault> {
    let mut statements = Statements::new(source);
    // A number for each name; how many solids have it.
    let mut solids: BTreeMap<String, usize> = BTreeMap::new();
    let mut names: Vec<String> = Vec::new();
    while statements.advance()? {
        let name = match statements.take(&["solid"]) {
            true => statements.solid_name(),
            // Some programs leave the first line out.
            false if names.is_empty() && statements.is_at("facet") => {
                assembly.mended(Mending::NoSolid);
                String::new()
            }
            false => return Err(statements.unexpected("`solid` and a name")),
        };
        *solids.entry(name.clone()).or_default() += 1;
        names.push(name.clone());
        let surface = assembly.surface(&name);
        solid(&mut statements, surface, assembly)?;
    }
    if names.is_empty() {
        return Err(Defect::NoTriangles.at(Place::File));
    }
    let are_telling = solids.len() > 1;
    let merged = solids
        .iter()
        .filter(|(name, count)| !name.is_empty() && **count > 1);
    let merged: Vec<String> = merged.map(|(name, _)| name.clone()).collect();
    if are_telling && !merged.is_empty() {
        assembly.mended(Mending::MergedSolids { names: merged });
    }
    assembly.rename_surfaces(|name| match name {
        "" => ALL.to_owned(),
        _ if !are_telling => ALL.to_owned(),
        name => name.to_owned(),
    });
    Ok(())
}

/// Reads the facets of a solid and its end.
fn solid(
    statements: &mut Statements<impl BufRead>,
    surface: u32,
    assembly: &mut Assembly,
) -> Result<(), MeshFault> {
    const FACET: &str = "`facet normal` or `endsolid`";
    let mut corners = Vec::new();
    loop {
        if !statements.advance()? {
            let fault = statements.ends_early(FACET);
            if assembly.triangle_count() == 0 {
                return Err(fault);
            }
            assembly.mended(Mending::NoEndsolid);
            assembly.must_close(fault);
            return Ok(());
        }
        if statements.is_at("solid") || statements.take_end("solid") {
            return Ok(());
        }
        if !statements.take(&["facet"]) {
            return Err(statements.unexpected(FACET));
        }
        statements.pass_over_normal();
        statements.expect(&["outer", "loop"], "`outer loop`")?;
        corners.clear();
        loop {
            const ENDLOOP: &str = "`endloop` after three corners";
            let expected = if corners.len() < 3 {
                "`vertex`"
            } else {
                ENDLOOP
            };
            if !statements.advance()? {
                return Err(statements.ends_early(expected));
            }
            if corners.len() >= 3 && statements.take_end("loop") {
                break;
            }
            if !statements.take(&["vertex"]) {
                return Err(statements.unexpected(match corners.len() {
                    0..3 => "`vertex` and three coordinates",
                    _ => ENDLOOP,
                }));
            }
            let corner = statements
                .coordinates()
                .and_then(|coordinates| assembly.vertex(coordinates))
                .map_err(|defect| statements.fault(defect))?;
            corners.push(corner);
            if corners.len() > super::MOST_CORNERS {
                let corners = corners.len();
                return Err(statements.fault(Defect::TooManyCorners { corners }));
            }
        }
        if !statements.advance()? {
            return Err(statements.ends_early("`endfacet`"));
        }
        if !statements.take_end("facet") {
            return Err(statements.unexpected("`endfacet`"));
        }
        assembly
            .face(&corners, surface)
            .map_err(|defect| statements.fault(defect))?;
    }
}

/// The words of a file, of which several statements may stand in a line.
struct Statements<R> {
    lines: Lines<R>,
    /// How much of the current line has been read.
    read: usize,
}

impl<R: BufRead> Statements<R> {
    fn new(source: R) -> Self {
        Self {
            lines: Lines::new(source),
            read: 0,
        }
    }

    /// Goes to the next statement, in this line or a later one; false at the end of the file. What
    /// stands behind a statement and begins none, such as a colour, is passed over.
    fn advance(&mut self) -> Result<bool, MeshFault> {
        while self.read > 0 && !self.rest().is_empty() && !self.begins_a_statement() {
            self.pass();
        }
        while self.rest().is_empty() {
            self.read = 0;
            if !self.lines.skip_blank()? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// What is left of the line.
    fn rest(&self) -> &[u8] {
        let text = self.lines.current().text;
        text.get(self.read..).unwrap_or_default().trim_ascii()
    }

    /// The next word of the line; empty at its end.
    fn word(&self) -> &[u8] {
        lines::words(self.rest()).next().unwrap_or_default()
    }

    fn is_at(&self, keyword: &str) -> bool {
        self.word().eq_ignore_ascii_case(keyword.as_bytes())
    }

    fn begins_a_statement(&self) -> bool {
        const KEYWORDS: [&str; 9] = [
            "solid", "facet", "outer", "vertex", "endloop", "endfacet", "endsolid", "end", "loop",
        ];
        KEYWORDS.iter().any(|keyword| self.is_at(keyword))
    }

    /// Passes over the next word of the line.
    fn pass(&mut self) {
        let text = self.lines.current().text;
        let rest = text.get(self.read..).unwrap_or_default();
        let blank = rest.len() - rest.trim_ascii_start().len();
        self.read += blank + self.word().len();
    }

    /// Passes over these words, if they are the next ones of the line.
    fn take(&mut self, keywords: &[&str]) -> bool {
        let start = self.read;
        for keyword in keywords {
            if !self.is_at(keyword) {
                self.read = start;
                return false;
            }
            self.pass();
        }
        true
    }

    /// Passes over `endsolid`, `end solid` or `endsolidNAME`, the rest of whose line is the name; over
    /// `endloop` and `endfacet` likewise, behind which there is no name.
    fn take_end(&mut self, of: &str) -> bool {
        let found = self.take(&[&format!("end{of}")]) || self.take(&["end", of]);
        if of != "solid" {
            return found;
        }
        let word = self.word();
        const GLUED: &[u8] = b"endsolid";
        let start = word.get(..GLUED.len());
        let is_glued = start.is_some_and(|start| start.eq_ignore_ascii_case(GLUED));
        if found || is_glued {
            self.read = self.lines.current().text.len();
        }
        found || is_glued
    }

    /// The name of a solid: the rest of the line, or up to its first facet.
    fn solid_name(&mut self) -> String {
        let rest = self.rest();
        let facet = b"facet normal";
        let lower = rest.to_ascii_lowercase();
        let mut windows = lower.windows(facet.len());
        let end = windows.position(|window| window == facet);
        let name = lines::name(&rest[..end.unwrap_or(rest.len())]);
        let text = self.lines.current().text;
        self.read = end.map_or(text.len(), |end| {
            text.trim_ascii_end().len() - rest.len() + end
        });
        name
    }

    /// Passes over what stands between `facet` and `outer`, in this line.
    fn pass_over_normal(&mut self) {
        while !self.rest().is_empty() && !self.is_at("outer") {
            self.pass();
        }
    }

    fn expect(&mut self, keywords: &[&str], expected: &'static str) -> Result<(), MeshFault> {
        if !self.advance()? {
            return Err(self.ends_early(expected));
        }
        match self.take(keywords) {
            true => Ok(()),
            false => Err(self.unexpected(expected)),
        }
    }

    /// The next three words of the line as coordinates.
    fn coordinates(&mut self) -> Result<[f64; 3], Defect> {
        let coordinates = coordinates(&mut lines::words(self.rest()))?;
        for _ in 0..3 {
            self.pass();
        }
        Ok(coordinates)
    }

    fn ends_early(&self, expected: &'static str) -> MeshFault {
        self.lines.ends_early(expected)
    }

    fn fault(&self, defect: Defect) -> MeshFault {
        self.lines.current().fault(defect)
    }

    /// A fault that shows what is left of the line.
    fn unexpected(&self, expected: &'static str) -> MeshFault {
        let Line { number, .. } = self.lines.current();
        let text = self.rest();
        Line { text, number }.unexpected(expected)
    }
}
