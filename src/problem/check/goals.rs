//! `goals`: what must be reached and what must not happen.

use super::scope::Scope;
use crate::problem::field::Field;
use crate::problem::file::quantity::{Share, Weight};
use crate::problem::file::settings::{
    GoalsEntry, MissEntry, NormalImpulseEntry, ReboundEntry, TangentialImpulseEntry,
};
use crate::problem::goal::{Goals, Miss, NormalImpulse, Rebound, TangentialImpulse};

pub(super) fn check(scope: &Scope<'_>, entry: &GoalsEntry) -> Option<Goals> {
    let normal_impulse = scope
        .required(
            "normal_impulse",
            &entry.normal_impulse,
            "`{ target: 40 uN.s }`",
        )
        .and_then(|entry| normal_impulse(&scope.of("normal_impulse"), entry));
    let tangential_impulse = match &entry.tangential_impulse {
        Field::Missing => Some(None),
        Field::Faulty => None,
        Field::Present(entry) => {
            tangential_impulse(&scope.of("tangential_impulse"), entry).map(Some)
        }
    };
    let rebound = match &entry.rebound {
        Field::Missing => Some(None),
        Field::Faulty => None,
        Field::Present(entry) => rebound(&scope.of("rebound"), entry).map(Some),
    };
    let miss = entry
        .miss
        .or(MissEntry::default())
        .and_then(|entry| miss(&scope.of("miss"), &entry));
    Some(Goals {
        normal_impulse: normal_impulse?,
        tangential_impulse: tangential_impulse?,
        rebound: rebound?,
        miss: miss?,
    })
}

fn normal_impulse(scope: &Scope<'_>, entry: &NormalImpulseEntry) -> Option<NormalImpulse> {
    let target = scope.needed("target", &entry.target);
    let tolerance = scope.optional("tolerance", &entry.tolerance, 0.1);
    let (share, weight) = share_and_weight(scope, &entry.share, 0.05, &entry.weight);
    Some(NormalImpulse {
        target: target?,
        tolerance: tolerance?,
        share: share?,
        weight: weight?,
    })
}

fn tangential_impulse(
    scope: &Scope<'_>,
    entry: &TangentialImpulseEntry,
) -> Option<TangentialImpulse> {
    let limit = scope.needed("limit", &entry.limit);
    let (share, weight) = share_and_weight(scope, &entry.share, 0.05, &entry.weight);
    Some(TangentialImpulse {
        limit: limit?,
        share: share?,
        weight: weight?,
    })
}

fn rebound(scope: &Scope<'_>, entry: &ReboundEntry) -> Option<Rebound> {
    let allow = scope.needed("allow", &entry.allow);
    let (share, weight) = share_and_weight(scope, &entry.share, 0.01, &entry.weight);
    Some(Rebound {
        allow: allow?,
        share: share?,
        weight: weight?,
    })
}

fn miss(scope: &Scope<'_>, entry: &MissEntry) -> Option<Miss> {
    let (share, weight) = share_and_weight(scope, &entry.share, 0.01, &entry.weight);
    Some(Miss {
        share: share?,
        weight: weight?,
    })
}

fn share_and_weight(
    scope: &Scope<'_>,
    share: &Field<Share>,
    usual_share: f64,
    weight: &Field<Weight>,
) -> (Option<f64>, Option<f64>) {
    (
        scope.optional("share", share, usual_share),
        scope.optional("weight", weight, 1.0),
    )
}
