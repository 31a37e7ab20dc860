//! The library of shot and contacts as text.

use super::layout::{Align, Block, Table};
use super::number::plain;
use crate::problem::media::{self, Number, Origin};

/// What a problem file may `use`, with the source of every number.
pub fn library() -> String {
    let mut sources = Sources::default();
    let shot = shot(&mut sources);
    let contacts = contacts(&mut sources);
    [shot, contacts, sources.listed()]
        .map(Block::into_text)
        .join("\n")
}

fn shot(sources: &mut Sources) -> Block {
    let mut block = Block::default();
    let mut table = Table::new(&[
        ("SHOT", Align::Left),
        ("diameter mm", Align::Right),
        ("from", Align::Left),
        ("kg/m3", Align::Right),
        ("from", Align::Left),
        ("material", Align::Left),
    ]);
    for medium in media::media() {
        table.row([
            medium.name.into(),
            plain(medium.diameter.value * 1e3),
            sources.cited(&medium.diameter),
            plain(medium.density.value),
            sources.cited(&medium.density),
            medium.material.into(),
        ]);
    }
    block.table(table);
    block.paragraph(
        "In a problem file: shot: { use: S110 }. Diameters are nominal; size_spread says how a \
         charge scatters about them. A radius or density beside use goes before the library's.",
    );
    block
}

fn contacts(sources: &mut Sources) -> Block {
    let mut block = Block::default();
    let mut table = Table::new(&[
        ("CONTACTS", Align::Left),
        ("mu_s", Align::Right),
        ("from", Align::Left),
        ("mu_d", Align::Right),
        ("from", Align::Left),
        ("restitution", Align::Right),
        ("at m/s", Align::Right),
        ("from", Align::Left),
    ]);
    let mut exponents: Vec<String> = Vec::new();
    for contact in media::contacts() {
        let mut cells = vec![contact.name.to_owned()];
        for number in [&contact.static_friction, &contact.dynamic_friction] {
            cells.extend([plain(number.value), sources.cited(number)]);
        }
        // The speed is part of what was measured, from the same source.
        let restitution = &contact.restitution;
        cells.extend([restitution, &contact.restitution_speed].map(|it| plain(it.value)));
        cells.push(sources.cited(restitution));
        table.row(cells);
        let exponent = &contact.restitution_exponent;
        let cited = format!("{} {}", plain(exponent.value), sources.cited(exponent));
        if !exponents.contains(&cited) {
            exponents.push(cited);
        }
    }
    block.table(table);
    block.paragraph(&format!(
        "Restitution was measured at a low normal speed, `at`, and falls beyond it: restitution x (speed / \
         at)^(-p), p being {}. A problem file writes it as {{ value: 0.71, at: 4.43 m/s, exponent: 0.25 }}.",
        exponents.join(" or ")
    ));
    block.paragraph(
        "In a problem file: contacts: { use: [steel-on-steel-dry, steel-on-steel-oiled] }, or \
         contacts: { dry: { use: steel-on-steel-dry, restitution: 0.5 } }, where keys beside use go \
         before the library's. Friction depends on surfaces and lubricants, restitution on speed \
         and hardness: measure them if you can, and give a tolerance for them if you cannot.",
    );
    block
}

/// The sources named so far, in the order of their first use.
#[derive(Default)]
struct Sources(Vec<Origin>);

impl Sources {
    /// The mark that stands beside a number.
    fn cited(&mut self, number: &Number) -> String {
        let known = self.0.iter().position(|source| *source == number.source);
        let index = known.unwrap_or_else(|| {
            self.0.push(number.source);
            self.0.len() - 1
        });
        let mark = mark(index);
        if number.source.is_assumed() {
            format!("{mark} assumed")
        } else {
            mark
        }
    }

    fn listed(&self) -> Block {
        let mut block = Block::titled("SOURCES");
        for (index, source) in self.0.iter().enumerate() {
            block.hanging(&format!("{:<5}", mark(index)), &source.to_string());
        }
        block
    }
}

fn mark(index: usize) -> String {
    format!("[{}]", index + 1)
}
