//! `surfaces`: where one surface differs from the others.

use super::contacts;
use super::scene::Scene;
use super::scope::Scope;
use crate::problem::equipment::{Role, SurfaceRule};
use crate::problem::fault_code::FaultCode;
use crate::problem::field::Field;
use crate::problem::file::Named;
use crate::problem::file::equipment::{RoleEntry, SurfaceEntry};
use crate::problem::source::child_key;

pub(super) fn check(
    root: &Scope<'_>,
    field: &Field<Named<SurfaceEntry>>,
    scene: &Scene,
    target: Option<&String>,
) -> Option<Vec<SurfaceRule>> {
    let entries = match field {
        Field::Missing => return Some(Vec::new()),
        Field::Faulty => return None,
        Field::Present(Named(entries)) => entries,
    };
    let scope = root.of("surfaces");
    let rules: Vec<Option<SurfaceRule>> = entries
        .iter()
        .map(|(name, entry)| {
            let fault = scene.surface_fault(&child_key("surfaces", name), name);
            let known = fault.is_none();
            if let Some(fault) = fault {
                scope.report_name(fault);
            }
            let entry = scope.required(name, entry, "keys such as `allow`, `contact` or `role`")?;
            let rule = rule(&scope.of(name), name, entry).filter(|_| known)?;
            let on_target = target == Some(name);
            match rule.fault_on_target().filter(|_| on_target) {
                Some(fault) => {
                    scope.report(fault);
                    None
                }
                None => Some(rule),
            }
        })
        .collect();
    rules.into_iter().collect()
}

fn rule(scope: &Scope<'_>, name: &str, entry: &SurfaceEntry) -> Option<SurfaceRule> {
    let allow = scope.maybe("allow", &entry.allow);
    let share = scope.maybe("share", &entry.share);
    let weight = scope.maybe("weight", &entry.weight);
    let roughness = scope.optional("roughness", &entry.roughness, 0.0);
    let contact = match &entry.contact {
        Field::Missing => Some(None),
        Field::Faulty => None,
        Field::Present(entry) => contacts::fixed(&scope.of("contact"), entry).map(Some),
    };
    let role = entry.role.or(RoleEntry::Part).map(|role| match role {
        RoleEntry::Part => Role::Part,
        RoleEntry::Deflector => Role::Deflector,
    });
    if role == Some(Role::Deflector) {
        for (key, given) in [
            ("allow", entry.allow.is_given()),
            ("share", entry.share.is_given()),
            ("weight", entry.weight.is_given()),
        ] {
            if given {
                scope.report_name(
                    scope
                        .fault(
                            FaultCode::NoEffect,
                            key,
                            "has no effect on a deflector, whose hits do not count",
                        )
                        .expecting("either this key or `role: deflector`"),
                );
            }
        }
    }
    Some(SurfaceRule {
        surface: name.to_owned(),
        allow: allow?,
        share: share?,
        weight: weight?,
        contact: contact.as_ref()?.as_ref().map(|settings| settings.contact),
        library: contact?.and_then(|settings| settings.library),
        roughness: roughness?,
        role: role?,
    })
}
