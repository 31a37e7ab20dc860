//! Contacts out of the library.

use super::scope::Scope;
use crate::problem::fault_code::FaultCode;
use crate::problem::field::Field;
use crate::problem::file::contact::{ContactEntry, ContactsItem, FallingEntry, RestitutionEntry};
use crate::problem::file::quantity::Friction;
use crate::problem::file::settings::OneOrRange;
use crate::problem::media::{self, LibraryContact};
use crate::units::shortened;

/// What a name out of the library is expected to be.
const LISTED: &str = "a contact that `peenpose media` lists";

/// The names under `use`, each with its place in the list; `None` for a contact that is called so.
pub(super) fn names_under_use(item: &ContactsItem) -> Option<Vec<(Option<usize>, Field<String>)>> {
    match item {
        ContactsItem::Name(name) => Some(vec![(None, Field::Present(name.clone()))]),
        ContactsItem::Names(names) => {
            let names = names.iter().cloned().enumerate();
            Some(names.map(|(index, name)| (Some(index), name)).collect())
        }
        ContactsItem::Own(_) => None,
    }
}

/// The contacts of these names; `None` where a fault is on record.
pub(super) fn named(
    list: &Scope<'_>,
    names: &[(Option<usize>, Field<String>)],
) -> Option<Vec<&'static LibraryContact>> {
    if names.is_empty() {
        list.report(
            list.own_fault(FaultCode::NothingListed, "names no contact")
                .expecting(LISTED),
        );
        return None;
    }
    let mut found: Vec<&'static LibraryContact> = Vec::new();
    let mut sound = true;
    for (index, name) in names {
        let item = index.map_or_else(|| list.clone(), |index| list.item(index));
        match known_under(&item, name) {
            Some(known) if found.contains(&known) => {
                let fault = item.own_fault(
                    FaultCode::NamedTwice,
                    format!("`{}` is named twice", known.name),
                );
                item.report(fault.expecting("every contact once"));
                sound = false;
            }
            Some(known) => found.push(known),
            None => sound = false,
        }
    }
    sound.then_some(found)
}

fn known_under(item: &Scope<'_>, name: &Field<String>) -> Option<&'static LibraryContact> {
    if !name.is_given() {
        item.report(
            item.own_fault(FaultCode::Missing, "is missing")
                .expecting(LISTED),
        );
    }
    looked_up(item, name.value()?)
}

/// The library's contact of this name; the fault is on record otherwise.
pub(super) fn looked_up(scope: &Scope<'_>, name: &str) -> Option<&'static LibraryContact> {
    let known = media::contact(name);
    if known.is_none() {
        let message = format!("the library has no contact `{}`", shortened(name));
        let names = media::contacts().iter().map(|known| known.name);
        let fault = scope
            .own_fault(FaultCode::NotInLibrary, message)
            .expecting(LISTED);
        scope.report(fault.nearest(name, names));
    }
    known
}

/// What was written, with the library's numbers where it says nothing.
pub(super) fn merged(entry: &ContactEntry, known: &LibraryContact) -> ContactEntry {
    let mut entry = entry.clone();
    let searched = matches!(entry.mu_s.value(), Some(OneOrRange::Range(_)));
    if !entry.mu_s.is_given() {
        entry.mu_s = Field::Present(OneOrRange::One(Friction(known.static_friction.value)));
    }
    if !entry.mu_d.is_given() && !entry.mu_d_ratio.is_given() && !searched {
        entry.mu_d = Field::Present(Friction(known.dynamic_friction.value));
    }
    if !entry.restitution.is_given() {
        entry.restitution = Field::Present(RestitutionEntry::Falling(FallingEntry::of(known)));
    }
    entry
}
