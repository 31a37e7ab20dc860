//! The whole report as one page of HTML that needs nothing else: sheet, 3-D view, figures, tables.
//!
//! The page is `page.html`, filled with texts that are already formatted; the viewer is the plain
//! JavaScript in `viewer/`, on top of the bundled three.js in `vendor/`.

mod bars;
mod element;
mod look;
mod motion;
mod scene;
mod still;

use askama::Template;

use self::bars::{ChoiceBar, LoadBar, WindowBar};
use self::element::Element;
use self::scene::Scene;
use self::still::Still;
use super::figure::{Figure, FigureFault};
use super::number::{count, fixed};
use super::sheet;
use super::sheet::setting::{SETTINGS, Setting};
use super::typeset::{typeset, unit_behind};
use crate::record::{EvidenceRecord, PlaceRecord, Record, StatusRecord};

const STYLE: &str = include_str!("page.css");
const THREE: &str = include_str!("vendor/three.min.js");
/// In the order in which they build on each other.
const VIEWER: [&str; 8] = [
    include_str!("viewer/look.js"),
    include_str!("viewer/shapes.js"),
    include_str!("viewer/section.js"),
    include_str!("viewer/stage.js"),
    include_str!("viewer/panel.js"),
    include_str!("viewer/strips.js"),
    include_str!("viewer/motion.js"),
    include_str!("viewer/main.js"),
];

/// Why a page cannot be made.
#[derive(Debug)]
pub struct PageFault(String);

impl std::fmt::Display for PageFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "cannot make the page: {}", self.0)
    }
}

impl std::error::Error for PageFault {}

impl From<askama::Error> for PageFault {
    fn from(fault: askama::Error) -> Self {
        Self(fault.to_string())
    }
}

impl From<serde_json::Error> for PageFault {
    fn from(fault: serde_json::Error) -> Self {
        Self(fault.to_string())
    }
}

impl From<FigureFault> for PageFault {
    fn from(fault: FigureFault) -> Self {
        Self(fault.to_string())
    }
}

/// The report as one page of HTML.
///
/// # Errors
/// None is expected: the page is written into memory.
pub fn page(record: &Record) -> Result<String, PageFault> {
    page_with(record, &Figure::of_record(record)?)
}

/// The same with the figures of the record, which are drawn already.
pub(super) fn page_with(record: &Record, figures: &[Figure]) -> Result<String, PageFault> {
    let page = Page {
        title: &record.problem.title,
        file: &record.problem.file,
        style: STYLE,
        head: Head::new(record),
        sheet: sheet::sheet(record),
        parts: Parts::new(record),
        windows: WindowBar::of(record),
        no_windows: no_windows(record),
        loads: LoadBar::of(record),
        choices: ChoiceBar::of(record),
        term_names: record
            .best
            .objective
            .as_ref()
            .map_or_else(Vec::new, |objective| {
                let terms = sheet::objective::terms(objective);
                terms.iter().map(|(name, ..)| *name).collect()
            }),
        pictures: record
            .evidence
            .as_ref()
            .map(|evidence| Pictures::new(record, evidence, figures))
            .transpose()?,
    };
    Ok(page.render()?)
}

/// Why no setting has a window.
fn no_windows(record: &Record) -> &'static str {
    match record.status {
        StatusRecord::Evaluated => "Not computed for given settings.",
        StatusRecord::NoFeasiblePose => "Not computed: the nozzle fits nowhere.",
        _ if record.problem.ranges.iter().all(|it| it.min == it.max) => {
            "Every setting is held at one value in the file."
        }
        _ => "Not computed.",
    }
}

#[derive(Template)]
#[template(path = "page.html", config = "src/report/page/askama.toml")]
struct Page<'a> {
    title: &'a str,
    file: &'a str,
    style: &'static str,
    head: Head,
    sheet: String,
    parts: Parts,
    windows: Vec<WindowBar>,
    no_windows: &'static str,
    loads: Vec<LoadBar>,
    choices: Vec<ChoiceBar>,
    term_names: Vec<&'static str>,
    pictures: Option<Pictures<'a>>,
}

/// What is seen in the first seconds.
struct Head {
    passes: bool,
    verdict: Vec<String>,
    /// What must be known besides, each with its label.
    below_verdict: Vec<(&'static str, String)>,
    /// What the settings are: to be set, given, or the best that failed.
    settings_are: &'static str,
    cards: Vec<Card>,
}

/// A setting, large.
struct Card {
    name: &'static str,
    value: String,
    unit: String,
    remark: String,
}

impl Head {
    fn new(record: &Record) -> Self {
        let best = &record.best;
        let mut cards: Vec<Card> = SETTINGS
            .iter()
            .filter(|setting| setting.is_used(record))
            .map(|setting| Card {
                name: setting.name,
                value: setting.shown(record).value,
                unit: unit_behind(setting.unit_of(record)),
                remark: typeset(&remark(record, setting)),
            })
            .collect();
        cards.push(Card {
            name: "contact",
            value: best.contact.clone(),
            unit: String::new(),
            remark: sheet::settings::coefficients(&best.contact_values),
        });
        Self {
            passes: best.passes && best.feasible,
            verdict: typeset_all(sheet::headline::verdict(record)),
            below_verdict: sheet::headline::below_verdict(record)
                .into_iter()
                .map(|(label, text)| (label, typeset(&text)))
                .collect(),
            settings_are: match record.status {
                StatusRecord::Evaluated => "Settings given",
                StatusRecord::NoFeasiblePose => "Nearest miss",
                _ if best.passes => "Set this",
                _ => "Best found",
            },
            cards,
        }
    }
}

fn typeset_all(lines: Vec<String>) -> Vec<String> {
    lines.iter().map(|line| typeset(line)).collect()
}

/// What stands below a setting.
fn remark(record: &Record, setting: &Setting) -> String {
    if setting.is_any(record) {
        return "makes no difference at 90 deg".into();
    }
    let tolerance = setting.tolerance(record);
    tolerance.map_or_else(String::new, |tolerance| format!("set within {tolerance}"))
}

/// The blocks of the sheet.
struct Parts {
    settings: Vec<Element>,
    pose: Vec<Element>,
    cures: Vec<Element>,
    target: Vec<Element>,
    verdicts: Vec<Element>,
    surfaces: Vec<Element>,
    stroke: Vec<Element>,
    coverage: Vec<Element>,
    cause: Vec<Element>,
    unknowns: Vec<Element>,
    objective: Vec<Element>,
    contacts: Vec<Element>,
    trade_off: Vec<Element>,
    validity: Vec<Element>,
    model: Vec<Element>,
    reproduce: Vec<Element>,
    work: Vec<Element>,
}

impl Parts {
    fn new(record: &Record) -> Self {
        let best = &record.best;
        Self {
            settings: Element::of_block(sheet::settings::settings(record)),
            pose: Element::of(sheet::settings::pose(record)),
            cures: Element::of(sheet::blocked::cures(record)),
            target: Element::of(sheet::received::target(record)),
            verdicts: Element::of(sheet::verdicts::block(best, &record.problem.goals)),
            surfaces: Element::of(sheet::received::surfaces(record)),
            stroke: Element::of(sheet::stroke::block(record)),
            coverage: Element::of(sheet::coverage::block(record)),
            cause: Element::of(sheet::cause::block(record)),
            unknowns: Element::of(sheet::unknowns::block(record)),
            objective: Element::of(sheet::objective::block(best)),
            contacts: Element::of(sheet::contacts::block(record)),
            trade_off: Element::of(sheet::front::block(record)),
            validity: Element::of(sheet::closing::validity(record)),
            model: Element::of(sheet::model::block(record)),
            reproduce: Element::of_block(sheet::closing::reproduce(record)),
            work: Element::of_block(sheet::closing::work(record)),
        }
    }
}

/// What is drawn from the evidence.
struct Pictures<'a> {
    /// The scene as JSON that may stand in a script element.
    scene: String,
    three: &'static str,
    viewer: [&'static str; 8],
    still: String,
    /// Whether the nozzle travels.
    moves: bool,
    /// Verdicts along the stroke, and what it dents.
    stroke: Vec<Drawing<'a>>,
    hits: Vec<Drawing<'a>>,
    /// Where every verdict passes, over two settings.
    maps: Vec<Drawing<'a>>,
    /// What can be had instead of the recommended settings.
    trade_off: Vec<Drawing<'a>>,
    strips: Vec<Strip>,
}

const MAP_IN_WORDS: &str = "J over two settings, and where every verdict passes";
const STROKE_IN_WORDS: &str = "what each verdict uses up of what is allowed along the stroke, and what share of the target it dents where";
const TRADE_OFF_IN_WORDS: &str =
    "target error, tangential risk and rebound of settings of which none is better in all three";

/// A figure in the page.
struct Drawing<'a> {
    svg: &'a str,
    /// What it shows, for who cannot see it.
    words: String,
}

/// A place for a test strip.
struct Strip {
    number: usize,
    what: String,
    surface: String,
    /// mm.
    place: [String; 3],
    normal: [String; 3],
}

impl<'a> Pictures<'a> {
    fn new(
        record: &Record,
        evidence: &EvidenceRecord,
        figures: &'a [Figure],
    ) -> Result<Self, PageFault> {
        let scene = serde_json::to_string(&Scene::new(record, evidence))?;
        let hits_in_words = format!(
            "{} first hits on the target: where they lie, mean N* and f* there, and how often each \
             angle, N* and f* occurs",
            count(evidence.hits.points_m.len()),
        );
        let (mut hits, mut maps, mut trade_off) = (Vec::new(), Vec::new(), Vec::new());
        let mut stroke = Vec::new();
        for Figure { name, svg } in figures {
            let (group, words) = match *name {
                "hits" => (&mut hits, hits_in_words.as_str()),
                "trade_off" => (&mut trade_off, TRADE_OFF_IN_WORDS),
                "stroke" => (&mut stroke, STROKE_IN_WORDS),
                _ => (&mut maps, MAP_IN_WORDS),
            };
            let words = words.to_owned();
            group.push(Drawing { svg, words });
        }
        Ok(Self {
            scene: for_script(&scene),
            three: THREE,
            viewer: VIEWER,
            still: Still::new(record, evidence).render()?,
            moves: record.stroke.is_some(),
            stroke,
            hits,
            maps,
            trade_off,
            strips: evidence.places.iter().enumerate().map(Strip::new).collect(),
        })
    }
}

impl Strip {
    fn new((index, place): (usize, &PlaceRecord)) -> Self {
        Self {
            number: index + 1,
            what: typeset(&place.text),
            surface: place.surface.clone(),
            place: place.point_m.map(|metres| fixed(metres * 1e3, 2)),
            normal: place.normal.map(|part| fixed(part, 3)),
        }
    }
}

/// JSON in which nothing can end a script element or start a comment in it.
fn for_script(json: &str) -> String {
    // These letters stand in strings only.
    json.replace('<', "\\u003c")
        .replace('>', "\\u003e")
        .replace('&', "\\u0026")
}
