//! The technique sheet of kept results against kept texts. `UPDATE_SHEETS=1 cargo test sheet`
//! writes the texts anew, and those of the documents; look at the difference before it is kept.

use peenpose::record::{
    AnswerRecord, CalibrationRecord, CoverageRecord, DensityRecord, DentedRecord, EstimateRecord,
    NoteRecord, RankingRecord, Record, StatusRecord,
};
use peenpose::report::{self, sheet};

use crate::common::kept::{NAMES, file, record};

/// A text without its line breaks.
fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What holds for every sheet.
fn assert_well_formed(text: &str) {
    for line in text.lines() {
        assert!(line.chars().count() <= 92, "too long: {line}\n{text}");
        assert_eq!(line, line.trim_end(), "space at the end:\n{text}");
        assert!(line.is_ascii(), "not plain: {line}");
    }
    for word in text.split(|c: char| !c.is_alphanumeric()) {
        assert!(!["NaN", "inf", "None", "Some"].contains(&word), "{text}");
    }
    let digits = |word: &str| word.chars().filter(char::is_ascii_digit).count();
    let numbers = text
        .lines()
        .filter(|line| {
            !line.contains("peenpose") && !line.contains("--set") && !line.contains("sha256")
        })
        .flat_map(str::split_whitespace)
        .filter(|word| word.parse::<f64>().is_ok());
    for number in numbers {
        assert!(digits(number) <= 9, "too many digits: {number}\n{text}");
    }
    assert!(text.ends_with(" s\n") && !text.contains("\n\n\n"), "{text}");
    assert!(
        ["PASS", "FAIL", "NO FEASIBLE POSE"]
            .iter()
            .any(|verdict| text.contains(&format!("verdict      {verdict}"))),
        "{text}"
    );
    assert!(text.contains("limited by   "));
}

#[test]
fn sheets_are_as_they_were() {
    for name in NAMES {
        let text = sheet(&record(name));
        let path = file(name, "txt");
        if std::env::var_os("UPDATE_SHEETS").is_some() {
            std::fs::write(&path, &text).unwrap();
        }
        let kept = std::fs::read_to_string(&path).unwrap();
        assert!(text == kept, "{name} has changed to\n{text}");
    }
}

#[test]
fn sheets_are_well_formed() {
    for name in NAMES {
        assert_well_formed(&sheet(&record(name)));
    }
}

#[test]
fn sheets_do_not_depend_on_anything_but_the_record() {
    let record = record("keyway");
    let again = Record::from_json(&record.to_json().unwrap()).unwrap();
    assert_eq!(sheet(&record), sheet(&again));
}

#[test]
fn only_the_last_line_tells_the_wall_time() {
    let first = record("keyway");
    let mut second = first.clone();
    second.work.seconds = 1234.5;
    let lines = |record| {
        let text = sheet(record);
        let kept: Vec<String> = text.lines().map(str::to_owned).collect();
        kept[..kept.len() - 1].to_vec()
    };
    assert_eq!(lines(&first), lines(&second));
}

#[test]
fn the_first_lines_tell_what_to_set_whether_it_passes_and_what_limits_it() {
    let text = sheet(&record("keyway"));
    let head: Vec<&str> = text.lines().take(15).collect();
    let head = head.join("\n");
    for needed in [
        "PASS",
        "limited by",
        "incidence",
        "azimuth",
        "standoff",
        "speed",
        "oiled",
    ] {
        assert!(head.contains(needed), "{needed} is not in\n{head}");
    }
}

/// Applies a change to the best answer and to the same among the choices.
fn change(record: &mut Record, change: impl Fn(&mut AnswerRecord)) {
    change(&mut record.best);
    change(&mut record.choices[0]);
}

#[test]
fn long_names_do_not_break_the_columns() {
    let mut record = record("given_fails");
    let long = format!("housing.{}", "a_very_long_region_name_".repeat(5));
    record.problem.title = "A long title ".repeat(20);
    record.problem.file = format!("{}/part.yaml", "deep/".repeat(40));
    change(&mut record, |answer| {
        answer.contact = "a contact with a long name".into();
        let receipt = answer.surfaces.remove("hub.bore").unwrap();
        answer.surfaces.insert(long.clone(), receipt);
        let verdict = answer.verdicts.iter_mut().find(|v| v.subject == "hub.bore");
        verdict.unwrap().subject = long.clone();
        answer.clearance_surface = Some(long.clone());
    });
    let text = sheet(&record);
    assert_well_formed(&text);
    let joined: String = text.split_whitespace().collect();
    assert!(joined.contains(&long));
}

#[test]
fn a_verdict_that_the_shots_do_not_decide_is_marked() {
    let mut record = record("keyway");
    change(&mut record, |answer| answer.verdicts[1].certain = false);
    let text = sheet(&record);
    assert_well_formed(&text);
    assert!(text.contains("PASS near"), "{text}");
    assert!(
        text.contains("too near to be certain: normal_impulse"),
        "{text}"
    );
}

#[test]
fn a_contact_that_passes_is_named_when_the_best_does_not() {
    let mut record = record("long_keyway");
    record.choices[2].passes = true;
    assert!(sheet(&record).contains("but dry passes every verdict"));
}

#[test]
fn an_accuracy_beyond_what_is_known_of_the_objective_is_not_claimed() {
    let mut record = record("keyway");
    record.problem.accuracy = 1e-7;
    change(&mut record, |answer| {
        let objective = answer.objective.as_mut().unwrap();
        (objective.total, objective.standard_error) = (0.004, 0.000_006);
    });
    let says = "converged within the standard error of the score J, 0.15 % (0.00001 % asked for)";
    assert!(words(&sheet(&record)).contains(says), "{}", sheet(&record));
    change(&mut record, |answer| {
        let objective = answer.objective.as_mut().unwrap();
        objective.standard_error = 1e-10;
    });
    let says = "converged to 0.00001 % of the score J (lower is better)";
    assert!(words(&sheet(&record)).contains(says), "{}", sheet(&record));
}

#[test]
fn what_passing_costs_and_what_would_pass_is_said() {
    let mut record = record("keyway");
    record.ranking = Some(RankingRecord::Passing);
    change(&mut record, |answer| {
        let total = answer.objective.as_ref().unwrap().total;
        answer.least_objective = Some(total / 2.0);
    });
    let text = words(&sheet(&record));
    assert!(
        text.contains("fails; passing costs 2.00 times that"),
        "{text}"
    );
    change(&mut record, |answer| {
        answer.passes = false;
        answer.verdicts[1].passes = false;
        answer.verdicts[1].share = 0.1234;
    });
    record.ranking = Some(RankingRecord::LeastViolation);
    let text = words(&sheet(&record));
    for said in [
        "No settings were found that pass; these are the nearest.",
        "They would pass with these shares allowed: normal_impulse 13 %",
    ] {
        assert!(text.contains(said), "{text}");
    }
    record.status = StatusRecord::BestFound;
    record.spread = Some(0.0256);
    let text = words(&sheet(&record));
    assert!(
        text.contains("independent searches end 2.6 % apart"),
        "{text}"
    );
}

#[test]
fn a_search_that_ended_early_says_so() {
    let mut record = record("keyway");
    record.status = StatusRecord::Interrupted;
    assert!(sheet(&record).contains("INTERRUPTED"));
    record.status = StatusRecord::BestFound;
    assert!(sheet(&record).contains("BEST FOUND"));
}

#[test]
fn a_jet_that_misses_altogether_is_told_without_numbers() {
    let mut record = record("given_fails");
    change(&mut record, |answer| {
        if let Some(target) = &mut answer.target {
            target.share_on_target = 0.0;
            target.share_sticking = 0.0;
        }
        for verdict in &mut answer.verdicts {
            if verdict.subject.ends_with("impulse") {
                verdict.counted = 0;
                verdict.share = 0.0;
                verdict.interval_95 = [0.0, 1.0];
                verdict.passes = false;
            }
        }
    });
    let text = sheet(&record);
    assert_well_formed(&text);
    assert!(
        text.contains("NONE of 65 536 shots hits hub.floor first"),
        "{text}"
    );
    assert!(text.contains("nothing counted"), "{text}");
}

#[test]
fn sticking_that_makes_friction_irrelevant_is_said_in_so_many_words() {
    let mut record = record("keyway");
    assert!(sheet(&record).contains("With damp and dry every shot grips on first impact"));
    record.choices.remove(0);
    record.best = record.choices[0].clone();
    let text = sheet(&record);
    assert!(
        text.contains(
            "Every shot grips on first impact: friction makes no difference to the target"
        ),
        "{text}"
    );
    // Contacts that slide are no proof of it.
    for settings in &mut record.choices {
        if let Some(target) = &mut settings.target {
            target.share_sticking = 0.5;
        }
    }
    assert!(!sheet(&record).contains("friction makes no difference"));
}

#[test]
fn windows_are_rounded_inwards_and_keep_their_setting_inside() {
    let mut record = record("keyway");
    let window = &mut record.windows[0];
    window.down.to = 67.911;
    window.up.to = 67.928;
    let text = sheet(&record);
    let row = text
        .lines()
        .find(|line| line.contains("  incidence "))
        .unwrap();
    assert!(
        row.contains("67.915") && row.contains("67.911 to 67.928 deg"),
        "{row}"
    );
    record.windows[0].up.to = 75.987;
    let text = sheet(&record);
    assert!(text.contains("67.92 to 75.98 deg"), "{text}");
}

#[test]
fn pressure_stands_beside_the_speed_where_it_is_known() {
    let mut record = record("keyway");
    record.problem.calibration = [(1e5, 8.0), (1.5e5, 14.0), (3e5, 20.0)]
        .map(|(pressure, speed_m_s)| CalibrationRecord {
            pressure,
            speed_m_s,
        })
        .to_vec();
    record.best.pressure = Some(1.12e5);
    let text = sheet(&record);
    assert_well_formed(&text);
    let line =
        "  pressure   1.12 bar for that speed: linear from 8 m/s at 1 bar to 14 m/s at 1.5 bar\n";
    assert!(text.contains(line), "{text}");
    record.best.settings.speed_m_s = 21.0;
    record.best.pressure = None;
    let text = sheet(&record);
    let line =
        "  pressure   not known: the calibration goes from 8 m/s at 1 bar to 20 m/s at 3 bar\n";
    assert!(text.contains(line), "{text}");
}

#[test]
fn coverage_has_a_block_of_its_own() {
    let mut record = record("keyway");
    let density = |hits: f64, mass_kg: Option<f64>| DensityRecord {
        hits_per_shot_m2: hits,
        standard_error_m2: hits / 100.0,
        mass_kg,
        time_s: mass_kg.map(|mass| mass / 0.01),
    };
    let coverage = CoverageRecord {
        dent_diameter_m: 0.2e-3,
        dents_from: None,
        wanted: 0.98,
        wanted_times: 1.0,
        shots: 1 << 18,
        area_m2: 60e-6,
        cells: 64,
        cell_side_m: 0.97e-3,
        mean: density(1e5, None),
        lowest_5: density(0.0, None),
        variation: 0.8,
        share_not_hit: 0.4,
        dented: Some(DentedRecord {
            cells: 16_384,
            cell_side_m: 0.06e-3,
            even_mass_kg: Some(0.0456),
            by_even_mass: Some(EstimateRecord {
                value: 0.551,
                standard_error: 2e-4,
                resolution: 1e-3,
            }),
            mass_kg: None,
            not_hit_resolution: 0.005,
        }),
        shots_per_kg: 272_837.0,
        mass_flow_kg_s: Some(0.01),
    };
    record.coverage = Some(coverage);
    let text = sheet(&record);
    assert_well_formed(&text);
    let block = text.split("COVERAGE, nozzle at rest").nth(1).unwrap();
    let row = |index: usize| -> Vec<&str> {
        block
            .lines()
            .nth(index)
            .unwrap()
            .split_whitespace()
            .collect()
    };
    assert_eq!(
        row(0),
        "hits/mm2 per s std. error 98 % after 98 % takes"
            .split(' ')
            .collect::<Vec<_>>()
    );
    assert_eq!(row(1)[4..], ["273", "2.73", "never", "no", "end"]);
    assert_eq!(row(2)[7..], ["0", "0", "never", "no", "end"]);
    assert!(
        words(block).contains(
            "98 % of the target is dented never: 40.0 % of it is not reached (none of 262 144 shots falls \
             there; cell size at most 0.50 % more). After 4.56 s (45.6 g), which were enough if hits \
             fell evenly, 55.1 % of it is dented (std. error 0.020 %, cell size at most 0.10 %)."
        ),
        "{block}"
    );
    // Without a mass flow there is no time, and shares that are hit are no news.
    let unknown = |density: DensityRecord| DensityRecord {
        time_s: None,
        ..density
    };
    record.coverage = Some(CoverageRecord {
        mean: unknown(density(1e5, Some(0.0456))),
        dented: coverage.dented.map(|dented| DentedRecord {
            mass_kg: Some(EstimateRecord {
                value: 0.0456,
                standard_error: 1e-4,
                resolution: 2e-4,
            }),
            by_even_mass: None,
            ..dented
        }),
        lowest_5: unknown(density(0.9e5, Some(2.5))),
        share_not_hit: 0.0,
        mass_flow_kg_s: None,
        ..coverage
    });
    let text = sheet(&record);
    assert_well_formed(&text);
    assert!(text.contains("hits/mm2 per kg"), "{text}");
    assert!(
        !text.contains("98 % after") && text.contains("2.50 kg"),
        "{text}"
    );
    assert!(!text.contains("is not reached"), "{text}");
    let dented = "98 % of the target is dented after 45.6 g (std. error 0.100 g, cell size at most 0.200 g).";
    assert!(words(&text).contains(dented), "{text}");
}

/// Shots that meet in flight take the ground from under every figure: that stands in the head.
#[test]
fn strong_interference_stands_in_the_head() {
    let mut record = record("keyway");
    assert!(!sheet(&record).contains("beware"));
    let note = |name: &str| NoteRecord {
        name: name.into(),
        value: 0.4,
        text: "at 5 kg/min a rebounding shot meets 0.4 incoming ones".into(),
    };
    record.notes.push(note("interference_strong"));
    let text = sheet(&record);
    assert_well_formed(&text);
    let said = "beware at 5 kg/min a rebounding shot meets 0.4 incoming ones";
    assert!(words(&text).contains(said), "{text}");
    let place = |needle: &str| text.find(needle).unwrap();
    assert!(place("verdict  ") < place("beware  ") && place("beware  ") < place("limited by"));
    assert_eq!(text.matches("a rebounding shot meets").count(), 1, "{text}");
    // Some interference is a note among others.
    record.notes.pop();
    record.notes.push(note("interference"));
    let text = sheet(&record);
    assert!(
        !text.contains("beware  ") && text.contains("  - at 5 kg/min"),
        "{text}"
    );
}

#[test]
fn a_terminal_shows_the_head_of_every_sheet() {
    for name in NAMES {
        let record = record(name);
        let (brief, whole) = (report::brief(&record), sheet(&record));
        let lines: Vec<&str> = brief.lines().collect();
        assert!(lines.len() <= report::LINES, "{name}:\n{brief}");
        let is_next = |line: &&str| line.starts_with("  next  ");
        let next = lines.iter().position(is_next).expect("it says what next");
        // Up to there it is the sheet itself, but for the blocks between.
        assert!(
            whole.starts_with(&lines[..8].join("\n")),
            "{name}:\n{brief}"
        );
        for line in &lines[..next] {
            assert!(line.is_empty() || whole.contains(line), "{name}: {line}");
        }
        assert!(brief.contains("\n  incidence "), "{name}:\n{brief}");
        assert!(brief.contains("--full"), "{name}:\n{brief}");
    }
}
