//! Which parts are cut out of a part.

use super::scope::Scope;
use crate::problem::fault::one_of;
use crate::problem::fault_code::FaultCode;
use crate::problem::field::{Field, Needed};
use crate::problem::file::scene::PartEntry;
use crate::problem::part::{Part, Shape};

const EXPECTED: &str = "at least one part whose inside is cut out, such as `[hole]`";

/// The names in `cut`, as far as the part alone tells.
pub(super) fn names(scope: &Scope<'_>, field: &Field<Vec<Field<String>>>) -> Option<Vec<String>> {
    let names = match field {
        Field::Missing => return Some(Vec::new()),
        Field::Faulty => return None,
        Field::Present(names) => names,
    };
    let list = scope.of("cut");
    if names.is_empty() {
        let fault = list.own_fault(FaultCode::NothingListed, "names no part");
        list.report(fault.expecting(EXPECTED));
        return None;
    }
    let name = |(index, name): (usize, &Field<String>)| {
        if !name.is_given() {
            let item = list.item(index);
            let fault = item.own_fault(FaultCode::Missing, "is missing");
            item.report(fault.expecting("the name of a part"));
        }
        name.value().cloned()
    };
    let names: Vec<Option<String>> = names.iter().enumerate().map(name).collect();
    names.into_iter().collect()
}

/// Checks what parts say of each other; whether that is sound.
pub(super) fn check(
    scene: &Scope<'_>,
    entries: &[(String, Needed<PartEntry>)],
    parts: &[(String, Option<Part>)],
) -> bool {
    let sound = parts.iter().filter_map(|(_, part)| part.as_ref());
    let cut = sound.filter(|part| !part.cut.is_empty());
    // Of all of them, so that each is told.
    cut.fold(true, |all, part| {
        let scope = scene.of(&part.name);
        let is_sided = has_sides(&scope, part);
        let tools = part.cut.iter().enumerate();
        tools.fold(all && is_sided, |all, (index, name)| {
            let list = scope.of("cut");
            let tool = Tool { part, index, name };
            tool.is_sound(&list.item(index), entries, parts) && all
        })
    })
}

/// Whether it is known on which side of a bore its material is.
fn has_sides(scope: &Scope<'_>, part: &Part) -> bool {
    let Shape::Bore { free: None, .. } = part.shape else {
        return true;
    };
    let bore = scope.of("bore");
    let fault = bore.fault(FaultCode::Missing, "free", "is missing where a bore is cut");
    bore.report(fault.expecting("`inside` for a hole in material, `outside` for a pin or a shaft"));
    false
}

/// One of the parts that are cut out of a part.
struct Tool<'a> {
    part: &'a Part,
    index: usize,
    name: &'a str,
}

impl Tool<'_> {
    fn is_sound(
        &self,
        item: &Scope<'_>,
        entries: &[(String, Needed<PartEntry>)],
        parts: &[(String, Option<Part>)],
    ) -> bool {
        let shown = crate::units::shortened(self.name);
        let refuse = |code: FaultCode, message: String, expected: &str| {
            item.report(item.own_fault(code, message).expecting(expected));
            false
        };
        if self.name == self.part.name {
            return refuse(
                FaultCode::CutsItself,
                "a part cannot be cut out of itself".to_owned(),
                "the name of another part",
            );
        }
        if self.part.cut[..self.index].iter().any(|it| it == self.name) {
            return refuse(
                FaultCode::NamedTwice,
                format!("`{shown}` is named twice"),
                "every part once",
            );
        }
        let Some((_, entry)) = entries.iter().find(|(name, _)| name == self.name) else {
            let known: Vec<&str> = entries.iter().map(|(name, _)| name.as_str()).collect();
            let others: Vec<&str> = known
                .into_iter()
                .filter(|it| *it != self.part.name)
                .collect();
            let message = format!("there is no part `{shown}`");
            let fault = item.own_fault(FaultCode::UnknownPart, message);
            let expected = match others.as_slice() {
                [] => "a part beside this one".to_owned(),
                others => one_of(others),
            };
            item.report(fault.expecting(expected).nearest(self.name, others));
            return false;
        };
        if is_cut(entry) {
            return refuse(
                FaultCode::CutOfACut,
                format!("`{shown}` is cut itself"),
                "a part without `cut`; list here what opens it as well",
            );
        }
        let others = parts.iter().filter_map(|(_, part)| part.as_ref());
        let mut tools = others.filter(|part| part.name == self.name);
        if tools.any(|tool| tool.on_nozzle != self.part.on_nozzle) {
            return refuse(
                FaultCode::CutAcrossFrames,
                format!("`{shown}` and `{}` do not move together", self.part.name),
                "both in the scene, or both on the nozzle",
            );
        }
        true
    }
}

fn is_cut(entry: &Needed<PartEntry>) -> bool {
    entry.value().is_some_and(|entry| entry.cut.is_given())
}
