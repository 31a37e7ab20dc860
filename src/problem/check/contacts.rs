//! `contacts`: the friction choices.

use super::library;
use super::scope::Scope;
use crate::impact::{Contact, Law, Restitution};
use crate::problem::equipment::ContactChoice;
use crate::problem::fault_code::FaultCode;
use crate::problem::field::{Field, Needed};
use crate::problem::file::Named;
use crate::problem::file::contact::{ContactEntry, ContactsItem, LawEntry, RestitutionEntry};
use crate::problem::file::quantity::{Friction, Quantity};
use crate::problem::key_index::homes_of;
use crate::problem::media::LibraryContact;
use crate::problem::setting::Range;
use crate::units::shortened;

/// The contacts of the file by name; `None` for a faulty one.
pub(super) struct Contacts {
    choices: Vec<(String, Option<ContactChoice>)>,
    /// Whether the names are all known.
    pub complete: bool,
}

impl Contacts {
    /// All contacts, if all of them are sound.
    pub fn sound(&self) -> Option<Vec<ContactChoice>> {
        let choices = self.choices.iter().map(|(_, settings)| settings.clone());
        choices
            .collect::<Option<Vec<_>>>()
            .filter(|_| self.complete)
    }

    /// Names, in the order of the file.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.choices.iter().map(|(name, _)| name.as_str())
    }
}

/// The key that may hold names of library contacts instead of a contact.
const USE: &str = "use";

/// The groups that hold the keys of a contact.
const OWN: &str = "contacts.<name>";

pub(super) fn check(root: &Scope<'_>, field: &Needed<Named<ContactsItem>>) -> Contacts {
    let expected = "at least one contact, such as \
                    `dry: { mu_s: 0.30, mu_d: 0.27, restitution: 0.25 }`";
    let Some(Named(entries)) = root.required("contacts", field, expected) else {
        return Contacts {
            choices: Vec::new(),
            complete: false,
        };
    };
    if entries.is_empty() {
        root.report(
            root.fault(FaultCode::NothingListed, "contacts", "has no contacts")
                .expecting(expected),
        );
    }
    let scope = root.of("contacts");
    let given: Vec<&str> = entries.iter().map(|(name, _)| name.as_str()).collect();
    let mut choices = Vec::new();
    let mut complete = true;
    for (name, item) in entries {
        let item = scope.required(name, item, "mu_s, mu_d and restitution");
        if name == USE
            && let Some(names) = item.and_then(library::names_under_use)
        {
            let list = scope.of(USE);
            let found = library::named(&list, &names);
            complete &= found.is_some();
            // What the file gives under the same name goes before the library's.
            let found = found.into_iter().flatten();
            choices.extend(
                found
                    .filter(|known| !given.contains(&known.name))
                    .map(|known| {
                        let entry = library::merged(&ContactEntry::default(), known);
                        let settings = choice_of(&list, known.name, &entry, Some(known));
                        (known.name.to_owned(), settings)
                    }),
            );
            continue;
        }
        let valid = scope.valid_name(name);
        let settings = item
            .and_then(|item| own(&scope, name, item))
            .and_then(|entry| settings(&scope.of(name), name, entry))
            .filter(|_| valid);
        choices.push((name.clone(), settings));
    }
    Contacts {
        complete: complete && !choices.is_empty(),
        choices,
    }
}

/// The keys of a contact of the file's own.
fn own<'f>(scope: &Scope<'_>, name: &str, item: &'f ContactsItem) -> Option<&'f ContactEntry> {
    let found = match item {
        ContactsItem::Own(entry) => return Some(entry),
        ContactsItem::Name(_) if homes_of(name).iter().any(|home| home == OWN) => {
            let fault = scope.fault(FaultCode::MisplacedKey, name, format!("belongs to {OWN}"));
            let expected =
                "a name first, such as `dry: { mu_s: 0.30, mu_d: 0.27, restitution: 0.25 }`";
            scope.report_name(fault.expecting(expected));
            return None;
        }
        ContactsItem::Name(text) => format!("`{}` is not a contact", shortened(text)),
        ContactsItem::Names(_) => "is a list".to_owned(),
    };
    scope.report(
        scope
            .fault(FaultCode::WrongKind, name, found)
            .expecting("a group of keys"),
    );
    None
}

fn settings(scope: &Scope<'_>, name: &str, entry: &ContactEntry) -> Option<ContactChoice> {
    match &entry.library {
        Field::Missing => choice_of(scope, name, entry, None),
        Field::Faulty => None,
        Field::Present(library) => {
            let known = library::looked_up(&scope.of(USE), library)?;
            choice_of(scope, name, &library::merged(entry, known), Some(known))
        }
    }
}

fn choice_of(
    scope: &Scope<'_>,
    name: &str,
    entry: &ContactEntry,
    library: Option<&'static LibraryContact>,
) -> Option<ContactChoice> {
    let law = entry.law.or(LawEntry::StickSlip).map(law);
    let restitution = scope
        .required_here("restitution", &entry.restitution, "a number such as 0.25")
        .and_then(|entry| restitution(scope, entry));
    let tangential_restitution =
        scope.optional("tangential_restitution", &entry.tangential_restitution, 0.0);
    let static_friction = scope
        .required_here("mu_s", &entry.mu_s, Friction::LIMIT.expected)
        .and_then(|mu_s| scope.range("mu_s", mu_s));
    let dynamic = dynamic_friction(scope, entry, static_friction);

    let (static_friction, dynamic) = (static_friction?, dynamic?);
    let contact = Contact {
        law: law?,
        static_friction: static_friction.min,
        dynamic_friction: dynamic.of(static_friction.min),
        restitution: restitution?,
        tangential_restitution: tangential_restitution?,
    };
    debug_assert!(contact.validate().is_ok(), "each key keeps to its limit");
    Some(ContactChoice {
        name: name.to_owned(),
        contact,
        static_friction,
        dynamic_ratio: match dynamic {
            Dynamic::Ratio(ratio) if !static_friction.is_held() => Some(ratio),
            _ => None,
        },
        library,
    })
}

/// The contact of a single surface, which cannot be tuned.
pub(super) fn fixed(scope: &Scope<'_>, entry: &ContactEntry) -> Option<ContactChoice> {
    let settings = settings(scope, "", entry)?;
    if !settings.static_friction.is_held() {
        scope.report(
            scope
                .fault(
                    FaultCode::SearchedOnASurface,
                    "mu_s",
                    "the contact of a surface is not searched",
                )
                .expecting("a single number"),
        );
        return None;
    }
    Some(settings)
}

/// How dynamic friction is given.
#[derive(Clone, Copy)]
enum Dynamic {
    Value(f64),
    Ratio(f64),
}

impl Dynamic {
    fn of(self, static_friction: f64) -> f64 {
        match self {
            Self::Value(value) => value,
            Self::Ratio(ratio) => ratio * static_friction,
        }
    }
}

fn dynamic_friction(
    scope: &Scope<'_>,
    entry: &ContactEntry,
    static_friction: Option<Range>,
) -> Option<Dynamic> {
    let searched = static_friction.is_some_and(|range| !range.is_held());
    if entry.mu_d_ratio.is_given() {
        if entry.mu_d.is_given() {
            scope.report_name(
                scope
                    .fault(FaultCode::EitherOr, "mu_d_ratio", "mu_d is given as well")
                    .expecting("either mu_d or mu_d_ratio"),
            );
            return None;
        }
        let ratio = entry.mu_d_ratio.value()?;
        return scope.sound("mu_d_ratio", *ratio).map(Dynamic::Ratio);
    }
    if searched {
        let expected = "a number from 0 to 1, as mu_s is a range";
        if entry.mu_d.is_given() {
            scope.report_name(
                scope
                    .fault(
                        FaultCode::HeldWhileSearched,
                        "mu_d",
                        "cannot be held while mu_s is searched",
                    )
                    .expecting("mu_d_ratio, a number from 0 to 1"),
            );
        } else {
            scope.required_here("mu_d_ratio", &entry.mu_d_ratio, expected);
        }
        return None;
    }
    let value = scope.needed_here("mu_d", &entry.mu_d)?;
    if let Some(range) = static_friction
        && value > range.min
    {
        scope.report(
            scope
                .fault(
                    FaultCode::DynamicAboveStatic,
                    "mu_d",
                    format!(
                        "dynamic friction {value} exceeds static friction {}",
                        range.min
                    ),
                )
                .expecting("mu_d at most mu_s"),
        );
        return None;
    }
    Some(Dynamic::Value(value))
}

fn restitution(scope: &Scope<'_>, entry: &RestitutionEntry) -> Option<Restitution> {
    match entry {
        RestitutionEntry::Constant(value) => scope
            .sound("restitution", *value)
            .map(Restitution::Constant),
        RestitutionEntry::Falling(entry) => {
            let scope = scope.of("restitution");
            let reference = scope.needed("value", &entry.value);
            let speed = scope.needed("at", &entry.at);
            let exponent = scope.needed("exponent", &entry.exponent);
            Some(Restitution::Falling {
                reference: reference?,
                speed: speed?,
                exponent: exponent?,
            })
        }
    }
}

fn law(entry: LawEntry) -> Law {
    match entry {
        LawEntry::StickSlip => Law::StickSlip,
        LawEntry::Kinetic => Law::Kinetic,
        LawEntry::Irrotational => Law::Irrotational,
        LawEntry::AlwaysSlip => Law::AlwaysSlip,
    }
}
