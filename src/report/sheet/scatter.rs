//! Where the scatter of N* comes from, to first order.

use super::unknowns::where_measured;
use crate::elementary::{power, sin, tan};
use crate::record::{AnswerRecord, Record, TargetRecord};
use crate::report::number::{fixed, plain, share_asked};

/// Standard deviation of a normal distribution that is cut at two, relative to the uncut one.
const CUT_AT_TWO: f64 = 0.8796;
/// Sources smaller than this part of the largest are not worth a word.
const WORTH_A_WORD: f64 = 0.1;
/// The sources must explain what was counted within this, or nothing is said.
const AGREES: f64 = 0.15;

/// A source of scatter: what it is, and the relative standard deviation of N* that it gives.
type Source = (String, f64);

/// Mean N* against the wanted one, and whether the rest is scatter.
pub struct Deviation {
    /// (mean - wanted) / wanted.
    pub bias: f64,
    /// Half the distance from 5 % to 95 %, relative to wanted.
    pub half_spread: f64,
}

impl Deviation {
    /// The deviation on a target; `None` when nothing hits it.
    pub fn new(record: &Record, target: &TargetRecord) -> Option<Self> {
        let wanted = record.problem.goals.normal_impulse;
        let spread = &target.normal_impulse;
        (target.share_on_target > 0.0 && wanted > 0.0).then(|| Self {
            bias: spread.mean / wanted - 1.0,
            half_spread: 0.5 * (spread.high_95 - spread.low_5) / wanted,
        })
    }

    /// Whether the mean is right and what is left is scatter.
    pub fn is_scatter(&self) -> bool {
        self.bias.abs() < 0.2 * self.half_spread
    }
}

/// The sources in a sentence, largest first; `None` where they do not explain the scatter that was
/// counted, as on a curved target.
pub fn sentence(record: &Record) -> Option<String> {
    let target = record.best.target.as_ref()?;
    let deviation = Deviation::new(record, target)?;
    let sources = sources(record);
    let total = sources.iter().map(|(_, sd)| sd * sd).sum::<f64>().sqrt();
    // 5 % and 95 % of a normal distribution are 1.645 standard deviations from the mean.
    let counted = deviation.half_spread / 1.645 / (1.0 + deviation.bias);
    if total <= 0.0 || (counted / total - 1.0).abs() > AGREES {
        return None;
    }
    let percent = |sd: f64| format!("{} %", fixed(sd * 100.0, 1));
    let largest = sources.first()?.1;
    let named: Vec<String> = sources
        .iter()
        .filter(|(_, sd)| *sd > WORTH_A_WORD * largest)
        .map(|(name, sd)| format!("{} from {name}", percent(*sd)))
        .collect();
    Some(format!(
        "Scatter of N* (standard deviation, to first order): {}; together {}.",
        named.join("; "),
        percent(total)
    ))
}

/// E of shots as they arrive.
struct Arriving {
    value: f64,
    /// By how much it shifts when E shifts by 1 where it was measured.
    per_reference: f64,
    /// The relative change of N* with a relative change of the normal speed: less than 1 where E falls.
    of_speed: f64,
}

impl Arriving {
    fn of(best: &AnswerRecord) -> Self {
        let contact = &best.contact_values;
        let normal_speed = best.settings.speed_m_s * sin(best.settings.incidence_deg.to_radians());
        let falls = contact.restitution_at_m_s.zip(contact.restitution_exponent);
        let Some((at, exponent)) = falls.filter(|_| normal_speed > 0.0) else {
            return Self {
                value: contact.restitution,
                per_reference: 1.0,
                of_speed: 1.0,
            };
        };
        let factor = power(normal_speed / at, -exponent);
        let value = contact.restitution * factor;
        if value >= 1.0 {
            return Self {
                value: 1.0,
                per_reference: 0.0,
                of_speed: 1.0,
            };
        }
        Self {
            value,
            per_reference: factor,
            of_speed: 1.0 - exponent * value / (1.0 + value),
        }
    }
}

/// N* goes with (1 + e) v sin(incidence) and the cube of the radius; largest source first.
fn sources(record: &Record) -> Vec<Source> {
    let (problem, best) = (&record.problem, &record.best);
    let tolerance = &problem.tolerance;
    // Half-width of a uniform distribution to its standard deviation.
    let uniform = 1.0 / 3.0_f64.sqrt();
    // A jet along the target meets it over a deflector, at an angle that the settings do not tell.
    let cotangent = match best.settings.incidence_deg {
        0.0 => 0.0,
        angle => tan(angle.to_radians()).recip(),
    };
    let restitution = Arriving::of(best);
    let mut sources = vec![
        (
            format!(
                "restitution +-{}{}",
                plain(tolerance.restitution),
                where_measured(&best.contact_values)
            ),
            tolerance.restitution * restitution.per_reference / (1.0 + restitution.value) * uniform,
        ),
        (
            format!("speed scatter {}", share_asked(problem.speed_spread)),
            CUT_AT_TWO * problem.speed_spread * restitution.of_speed,
        ),
        (
            format!("speed set within {}", share_asked(tolerance.speed)),
            tolerance.speed * uniform * restitution.of_speed,
        ),
        (
            format!(
                "incidence set within {} deg",
                plain(tolerance.incidence_deg)
            ),
            tolerance.incidence_deg.to_radians() * uniform * cotangent * restitution.of_speed,
        ),
        (
            // One component of a direction uniform in a narrow cone has half its half-angle.
            format!("jet cone {} deg", plain(problem.divergence_deg)),
            problem.divergence_deg.to_radians() * 0.5 * cotangent * restitution.of_speed,
        ),
        (
            format!("shot size {}", share_asked(problem.size_spread)),
            3.0 * problem.size_spread,
        ),
    ];
    sources.retain(|(_, sd)| *sd > 0.0);
    sources.sort_by(|a, b| b.1.total_cmp(&a.1));
    sources
}
