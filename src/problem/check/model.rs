//! `model`: which effects are modelled.

use super::scope::Scope;
use crate::problem::fault::one_of;
use crate::problem::fault_code::FaultCode;
use crate::problem::field::Field;
use crate::problem::file::settings::OneOrMany;
use crate::problem::model::{Effect, Model};

pub(super) fn check(root: &Scope<'_>, field: &Field<OneOrMany>) -> Option<Model> {
    let scope = root.of("model");
    let names = match field {
        Field::Missing => return Some(Model::Auto),
        Field::Faulty => return None,
        Field::Present(OneOrMany::One(name)) => return one(&scope, name),
        Field::Present(OneOrMany::Many(names)) => names,
    };
    let known: Vec<&str> = Effect::ALL.iter().map(|effect| effect.name()).collect();
    let mut effects = Vec::new();
    let mut sound = true;
    for (index, name) in names.iter().enumerate() {
        let item = scope.item(index);
        let name = match name {
            Field::Present(name) => name,
            Field::Faulty => {
                sound = false;
                continue;
            }
            Field::Missing => {
                let fault = item.own_fault(FaultCode::Missing, "is missing");
                item.report(fault.expecting(one_of(&known)));
                sound = false;
                continue;
            }
        };
        match Effect::named(name) {
            Some(effect) if effects.contains(&effect) => {
                let fault =
                    item.own_fault(FaultCode::NamedTwice, format!("`{name}` is named twice"));
                item.report(fault.expecting("every effect once"));
                sound = false;
            }
            Some(effect) => effects.push(effect),
            None => {
                let shown = crate::units::shortened(name);
                let fault = item.own_fault(
                    FaultCode::UnknownWord,
                    format!("there is no effect `{shown}`"),
                );
                let fault = fault.expecting(one_of(&known));
                item.report(fault.nearest(name, known.iter().copied()));
                sound = false;
            }
        }
    }
    sound.then_some(Model::Only(effects))
}

fn one(scope: &Scope<'_>, name: &str) -> Option<Model> {
    match name {
        "auto" => Some(Model::Auto),
        "full" => Some(Model::Full),
        _ => {
            let shown = crate::units::shortened(name);
            let fault = scope.own_fault(
                FaultCode::UnknownWord,
                format!("there is no model `{shown}`"),
            );
            let fault = fault.expecting("`auto`, `full`, or a list of effects");
            scope.report(fault.nearest(name, ["auto", "full"]));
            None
        }
    }
}
