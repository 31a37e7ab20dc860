//! `nozzle`: the body that carries the jet.

use super::coordinates::direction;
use super::scope::Scope;
use crate::problem::equipment::{Body, Nozzle};
use crate::problem::fault::one_of;
use crate::problem::fault_code::FaultCode;
use crate::problem::field::Field;
use crate::problem::file::equipment::{BallEntry, BodyEntry, CapsuleEntry, NozzleEntry};

pub(super) fn check(scope: &Scope<'_>, entry: &NozzleEntry) -> Option<Nozzle> {
    let clearance = scope.optional("clearance", &entry.clearance, 0.0);
    let pieces = entry.body.or(Vec::new()).and_then(|pieces| {
        let list = scope.of("body");
        let pieces: Vec<Option<Body>> = pieces
            .iter()
            .enumerate()
            .map(|(index, piece)| self::piece(&list.item(index), piece))
            .collect();
        pieces.into_iter().collect::<Option<Vec<Body>>>()
    });
    Some(Nozzle {
        body: pieces?,
        clearance: clearance?,
    })
}

fn piece(scope: &Scope<'_>, field: &Field<BodyEntry>) -> Option<Body> {
    let expected = || format!("exactly {}", one_of(&BodyEntry::SHAPES));
    let entry = match field {
        Field::Present(entry) => entry,
        Field::Faulty => return None,
        Field::Missing => {
            scope.report(
                scope
                    .own_fault(FaultCode::Missing, "is missing")
                    .expecting(expected()),
            );
            return None;
        }
    };
    match (entry.ball.is_given(), entry.capsule.is_given()) {
        (true, false) => ball(&scope.of("ball"), entry.ball.value()?),
        (false, true) => capsule(&scope.of("capsule"), entry.capsule.value()?),
        (true, true) => {
            scope.report_name(
                scope
                    .fault(FaultCode::EitherOr, "capsule", "is a second shape")
                    .expecting(expected()),
            );
            None
        }
        (false, false) => {
            if !scope.is_misspelt("ball") && !scope.is_misspelt("capsule") {
                scope.report(
                    scope
                        .own_fault(FaultCode::NoneOfSeveral, "has no shape")
                        .expecting(expected()),
                );
            }
            None
        }
    }
}

fn ball(scope: &Scope<'_>, entry: &BallEntry) -> Option<Body> {
    let radius = scope.needed("radius", &entry.radius)?;
    Some(Body::Ball { radius })
}

fn capsule(scope: &Scope<'_>, entry: &CapsuleEntry) -> Option<Body> {
    let length = scope.needed("length", &entry.length);
    let radius = scope.needed("radius", &entry.radius);
    let direction = match &entry.direction {
        Field::Missing => Some(None),
        Field::Faulty => None,
        Field::Present(fixed) => direction(&scope.of("direction"), fixed).map(Some),
    };
    Some(Body::Capsule {
        length: length?,
        radius: radius?,
        direction: direction?,
    })
}
