//! How far the nozzle travels beyond an end of a stroke, so that the whole spot passes the end of the target.

use crate::feasibility::{infeasibility, infeasible_on_way};
use crate::problem::setting::Settings;
use crate::problem::stroke::{Leg, WHOLE};
use crate::scenario::Scenario;
use crate::scene::traverse::Traverse;
use crate::verdict::{StationVerdicts, Subject, Verdict};

use super::Spot;

/// The way of the aim point beyond an end of a stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunOut {
    /// Its length, along the line or along the axis that it goes round, m.
    pub length: f64,
    /// The length at which the whole spot has passed the end of the target, m; or what was asked for.
    pub wanted: f64,
    /// What fails farther out, where it is shorter than wanted.
    pub limit: Option<Subject>,
}

/// Into how many parts what is wanted is cut, at whose ends it is tried.
const PARTS: u32 = 8;
/// How often the part between what fits and what does not is halved then.
const HALVINGS: u32 = 2;

impl RunOut {
    /// One that was asked for.
    pub fn of(length: f64) -> Self {
        Self {
            length,
            wanted: length,
            limit: None,
        }
    }

    /// As far as there is target left beyond each end and the spot reaches back from there, or less where the
    /// nozzle does not fit or other surfaces receive too much.
    pub fn both(scenario: &Scenario, traverse: &Traverse, legs: &[Leg]) -> [Self; 2] {
        // Nothing travels beyond the ends where a part turns on the spot.
        if traverse.places_in(1.0) == 0.0 {
            return [Self::of(0.0); 2];
        }
        let (target, _) = scenario.target.cut_out(&scenario.scene);
        WHOLE.map(|end| {
            let settings = &Leg::at(legs, end).settings;
            let onwards = traverse.onwards(end > 0.0);
            let aim = traverse.frame_at(end).aim;
            let corners = target.iter().flatten();
            let left = corners.map(|corner| (corner - aim).dot(&onwards));
            let spot = Spot::of(scenario, settings);
            let reach = spot.map_or(0.0, |spot| spot.reach(&-onwards));
            let wanted = left.fold(0.0, f64::max) + reach;
            let (length, limit) = farthest(wanted, |[from, to]| {
                let places = [from, to].map(|length| traverse.beyond(end, length));
                harm(scenario, places, settings)
            });
            Self {
                length,
                wanted,
                limit,
            }
        })
    }
}

/// What fails at a place of a run-out: the nozzle does not fit there or on the way there from another place, or a surface
/// other than the target receives too much.
fn harm(scenario: &Scenario, [from, place]: [f64; 2], settings: &Settings) -> Option<Subject> {
    let station = scenario.station(place);
    let infeasible = infeasibility(&station.scenario, settings)
        .or_else(|| infeasible_on_way(scenario, settings, [from.min(place), from.max(place)]));
    if let Some(infeasible) = infeasible {
        return Some(match infeasible.obstacle.is_near_wall() {
            true => Subject::Clearance,
            false => Subject::FreeSpace,
        });
    }
    let fails =
        |verdict: &&Verdict| matches!(verdict.subject, Subject::Surface(_)) && !verdict.passes();
    StationVerdicts::at(&[&station], &scenario.problem, settings)
        .iter()
        .flat_map(|station| &station.verdicts)
        .find(fails)
        .map(|verdict| verdict.subject)
}

/// As far as nothing fails, to within a 32nd of a length, as the nozzle passes all that is nearer; and what fails farther
/// out.
fn farthest<T>(whole: f64, failing: impl Fn([f64; 2]) -> Option<T>) -> (f64, Option<T>) {
    let part = whole / f64::from(PARTS);
    let (mut length, mut limit) = (0.0, None);
    for parts in 1..=PARTS {
        let more = f64::from(parts) * part;
        limit = failing([length, more]);
        if limit.is_some() {
            break;
        }
        length = more;
    }
    if limit.is_some() {
        for halving in 1..=HALVINGS {
            let more = length + part / f64::from(1_u32 << halving);
            match failing([length, more]) {
                None => length = more,
                nearer => limit = nearer,
            }
        }
    }
    (length, limit)
}

#[cfg(test)]
mod tests {
    use super::farthest;

    #[test]
    fn it_goes_as_far_as_nothing_fails() {
        for limit in [0.0, 0.02, 0.3, 2.6, 3.99, 4.0, 9.0] {
            let (found, failing) = farthest(4.0, |[_, length]| (length > limit).then_some(length));
            let off = f64::min(limit, 4.0) - found;
            assert!((0.0..4.0 / 32.0).contains(&off), "{limit}: {found}");
            assert_eq!(failing.is_some(), limit < 4.0, "{limit}");
            assert!(failing.is_none_or(|it| it > limit), "{limit}: {failing:?}");
        }
        // What would do farther out cannot be reached.
        let (found, _) = farthest(4.0, |[_, length]| {
            ((length - 2.0).abs() < 0.3).then_some(())
        });
        assert!((1.5..1.7).contains(&found), "{found}");
        assert_eq!(farthest(0.0, |_| None::<()>), (0.0, None));
    }
}
