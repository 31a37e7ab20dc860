//! `peenpose map`: the objective or a term of it over two settings.

use std::process::ExitCode;
use std::sync::Arc;

use peenpose::control::Control;
use peenpose::map::Axis;
use peenpose::problem::given::{contact_named, setting_named};
use peenpose::problem::setting::{Range, Setting, Settings};
use peenpose::problem::{Problem, given};
use peenpose::record::{AnswerRecord, MapRecord, MapTerm, QuestionRecord};
use peenpose::report::figure::Figure;
use peenpose::report::table::Table;
use peenpose::report::{self, MapView};
use peenpose::solve::{Answer, solve};
use peenpose::study::Study;

use crate::args::MapArgs;
use crate::checkpoint;
use crate::folder::Staged;
use crate::output::{self, Failure, both};
use crate::progress::{ENDED, Watcher};
use crate::settings::{self, Earlier};
use crate::start;

/// Draws a map and writes it as SVG, PNG and CSV.
pub fn run(args: &MapArgs) -> Result<ExitCode, Failure> {
    let axes = [("--x", &args.x), ("--y", &args.y)];
    let [x, y] = axes.map(|(option, text)| Asked::new(option, text));
    let (x, y) = (x?, y?);
    if x.setting == y.setting {
        let name = x.setting.name();
        return Err(format!("--y {name}: both axes are the same setting").into());
    }
    let (set, changes) = settings::split(&args.set)?;
    let mut study = start::open(&args.start, &args.file, &changes, Some(&args.out))?;
    let from = args
        .from
        .as_deref()
        .map(|path| Earlier::read(path, &study, args.start.quiet))
        .transpose()?;
    if let Some(name) = &args.contact {
        let contact = contact_named(name, study.problem())
            .map_err(|message| format!("--contact: {message}"))?;
        study = study.with_contact(contact);
    }
    x.check(study.problem())?;
    y.check(study.problem())?;
    let varied = [x.setting, y.setting];
    let checkpoint = checkpoint::open(args.checkpoint.as_deref(), study.scenario())?.map(Arc::new);
    let given = given(args, set, from.as_ref(), study.problem(), varied)?;
    let watcher = Watcher::new(args.start.quiet);
    let control = Control {
        checkpoint: checkpoint.clone(),
        ..watcher.control()
    };
    let (settings, is_known) = match given {
        Some(given) => given,
        None => (searched(args, &study, &control)?, true),
    };
    let axis = |asked: &Asked| -> Result<Axis, String> {
        let range = asked.range(study.problem(), &settings)?;
        Ok(Axis::over(asked.setting, range, args.steps.into()))
    };
    let axes = [axis(&x)?, axis(&y)?];
    watcher.say("drawing the map");
    let map = study.map(&settings, axes, args.shots as usize, &control);
    watcher.finish();
    checkpoint::close(checkpoint.as_deref(), args.start.quiet);
    let scenario = study.scenario().as_asked();
    let answer = Answer::evaluated(&scenario, &settings, None);
    let view = MapView {
        map: &MapRecord::new(&scenario, &map),
        problem: &QuestionRecord::new(&scenario.problem, study.source()),
        answer: &AnswerRecord::new(&scenario, &answer),
        marks_settings: is_known,
    };
    write(args, &view, varied)
}

/// Writes the files and says what they show: of a map that was asked to stop, what is known of it.
fn write(args: &MapArgs, view: &MapView, varied: [Setting; 2]) -> Result<ExitCode, Failure> {
    let (known, all) = (view.map.known_places(), view.map.cells.len());
    if known == 0 {
        output::note("stopped before anything of the map was known: nothing is written");
        return Ok(ExitCode::from(ENDED));
    }
    let term = args.term;
    let mut stem = format!("map-{}-{}", varied[0].name(), varied[1].name());
    if term != MapTerm::Total {
        stem += &format!("-{}", term.name());
    }
    let figure = Figure::of_map(view, term).map_err(|fault| fault.to_string())?;
    let figure = figure.ok_or("the map has no extent".to_owned())?;
    let table =
        Table::of_map(view.map).map_err(|error| format!("cannot write the table: {error}"))?;
    // What is printed is not lost whatever becomes of the files.
    let printed = output::text(report::map(view, term));
    let mut files = Staged::new(&args.out);
    files.add_figure(&stem, &figure);
    files.add(&format!("{stem}.csv"), table.csv.as_bytes());
    let shown = both(printed, files.put())?;
    let written = args.out.join(stem);
    output::text(format!(
        "  {:<10} {}.svg, .png, .csv\n",
        "written",
        written.display()
    ))?;
    if known == all {
        return Ok(shown);
    }
    output::note("stopped: the map is blank where nothing is known");
    Ok(ExitCode::from(ENDED))
}

/// The settings round which the map is made, and whether those on its axes are known; `None` where
/// nothing is given.
fn given(
    args: &MapArgs,
    mut set: Vec<String>,
    from: Option<&Earlier>,
    problem: &Problem,
    varied: [Setting; 2],
) -> Result<Option<(Settings, bool)>, String> {
    if set.is_empty() && from.is_none() {
        return Ok(None);
    }
    set.extend(args.contact.iter().map(|name| format!("contact={name}")));
    settings::choice_round(varied, &set, from, problem).map(Some)
}

/// The best settings, or the best so far when the search is asked to stop.
fn searched(args: &MapArgs, study: &Study, control: &Control) -> Result<Settings, String> {
    if !args.start.quiet {
        output::note("no --from and no --set: searching for the best settings first");
    }
    let solution = solve(study.scenario(), control);
    let best = solution.answers.first();
    let best = best.ok_or("there is no contact to choose")?;
    Ok(best.settings)
}

/// An axis as it was asked for.
struct Asked {
    option: &'static str,
    setting: Setting,
    range: Option<Range>,
}

impl Asked {
    /// Reads `NAME` or `NAME=FROM:TO`.
    fn new(option: &'static str, text: &str) -> Result<Self, String> {
        let wrong = |message: String| format!("{option} {text}: {message}");
        let (name, range) = match text.split_once('=') {
            Some((name, range)) => (name.trim(), Some(range)),
            None => (text.trim(), None),
        };
        let setting = setting_named(name).map_err(wrong)?;
        let range = range.map(|range| {
            let example = example(setting);
            let (from, to) = range
                .split_once(':')
                .ok_or_else(|| format!("expected NAME=FROM:TO, such as `{example}`"))?;
            given::range(setting, from, to)
        });
        Ok(Self {
            option,
            setting,
            range: range.transpose().map_err(wrong)?,
        })
    }

    /// What is wrong with it before the contact is known.
    fn check(&self, problem: &Problem) -> Result<(), String> {
        let own = problem.ranges.range(self.setting);
        if self.range.is_none() && own.is_some_and(Range::is_held) {
            return Err(format!(
                "{} {}: the file holds it at one value; say how far to draw, such as `{}`",
                self.option,
                self.setting.name(),
                example(self.setting)
            ));
        }
        Ok(())
    }

    /// The range that was asked for, or else the file's.
    fn range(&self, problem: &Problem, settings: &Settings) -> Result<Range, String> {
        let wrong = |message: &str| format!("{} {}: {message}", self.option, self.setting.name());
        let contact = &problem.contacts[settings.contact];
        let friction = contact.static_friction;
        if self.setting == Setting::StaticFriction && friction.is_held() {
            let message = format!(
                "the friction of contact `{}` is fixed in the file, not a range",
                contact.name
            );
            return Err(wrong(&message));
        }
        let own = problem.ranges.range(self.setting).unwrap_or(friction);
        let range = self.range.unwrap_or(own);
        if self.setting == Setting::Incidence && range.min <= 0.0 && settings.aim_above <= 0.0 {
            let message = "must be above 0 deg where aim_above is not above 0 mm";
            return Err(wrong(message));
        }
        Ok(range)
    }
}

/// How a range of a setting is written.
fn example(setting: Setting) -> String {
    let range = match setting {
        Setting::Incidence => "40deg:80deg",
        Setting::Azimuth => "-10deg:10deg",
        Setting::Standoff => "6mm:20mm",
        Setting::Speed => "5m/s:15m/s",
        Setting::AimAlong | Setting::AimAcross => "-2mm:2mm",
        Setting::AimAbove => "0mm:2mm",
        Setting::StaticFriction => "0.05:0.3",
    };
    format!("{}={range}", setting.name())
}
