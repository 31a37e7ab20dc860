//! `report.html` by itself and in a browser.

mod browser;
mod html;

use crate::common::kept;
use std::path::Path;

use peenpose::evidence::Evidence;
use peenpose::problem::setting::Settings;
use peenpose::record::{EvidenceRecord, Record, SpotRecord};
use peenpose::report::{page, sheet};

use crate::common::shipped;
use browser::Browser;

/// A page for 16 384 shots must not be larger.
const MOST_BYTES: usize = 3_000_000;
const SHOTS: usize = 16_384;
/// Ends scripts, attributes, comments and elements where it is not escaped.
const HOSTILE: &str =
    "</script><img src=x onerror=alert(1)>\"'&amp;--><!--]]>{{ 7 }}</pre></style>";

/// The kept keyway with what its pictures are drawn from.
fn illustrated() -> Record {
    let mut record = kept::record("keyway");
    let scenario = shipped::scenario("keyway.yaml");
    let settings = &record.best.settings;
    let contacts = &scenario.problem.contacts;
    let contact = contacts
        .iter()
        .position(|it| it.name == record.best.contact)
        .unwrap();
    let settings = Settings {
        incidence: settings.incidence_deg.to_radians(),
        azimuth: settings.azimuth_deg.to_radians(),
        standoff: settings.standoff_m,
        speed: settings.speed_m_s,
        aim_along: settings.aim_along_m,
        aim_across: settings.aim_across_m,
        aim_above: settings.aim_above_m,
        contact,
        static_friction: contacts[contact].static_friction.min,
    };
    let evidence = Evidence::of(
        &scenario,
        &settings,
        SHOTS,
        &peenpose::control::Cancel::default(),
    );
    record.evidence = Some(EvidenceRecord::new(&scenario, &settings, &evidence));
    record
}

/// The same with names that try to break out of the page.
fn hostile() -> Record {
    let mut record = illustrated();
    record.problem.title = HOSTILE.into();
    record.problem.file = HOSTILE.into();
    record.command = HOSTILE.into();
    record.notes[0].text = HOSTILE.into();
    for answer in record.choices.iter_mut().chain([&mut record.best]) {
        answer.contact = HOSTILE.into();
        answer.clearance_surface = Some(HOSTILE.into());
        answer.verdicts.last_mut().unwrap().subject = HOSTILE.into();
        let (_, receipt) = answer.surfaces.pop_first().unwrap();
        answer.surfaces.insert(HOSTILE.into(), receipt);
    }
    record.windows[0].up.turns = Some(HOSTILE.into());
    let evidence = record.evidence.as_mut().unwrap();
    for surface in &mut evidence.surfaces {
        surface.name = HOSTILE.into();
    }
    for place in &mut evidence.places {
        place.surface = HOSTILE.into();
        place.text = HOSTILE.into();
    }
    record
}

fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for letter in text.chars() {
        match letter {
            '<' | '>' | '&' | '"' | '\'' => escaped += &format!("&#{};", u32::from(letter)),
            other => escaped.push(other),
        }
    }
    escaped
}

/// What of a page a browser would fetch.
fn fetched(page: &str) -> Vec<String> {
    let fetching = [
        "src",
        "href",
        "data",
        "action",
        "poster",
        "srcset",
        "xlink:href",
    ];
    let tags = html::tags(page);
    let attributes = tags.into_iter().flat_map(|tag| tag.attributes);
    let fetched = attributes
        .filter(|(name, value)| fetching.contains(&name.as_str()) && !value.starts_with('#'));
    fetched
        .map(|(name, value)| format!("{name}={value}"))
        .collect()
}

#[test]
fn pages_are_whole_stand_alone_and_hold_the_sheet() {
    let records = kept::NAMES
        .map(kept::record)
        .into_iter()
        .chain([illustrated()]);
    for record in records {
        let page = page(&record).unwrap();
        assert_eq!(fetched(&page), Vec::<String>::new());
        assert!(
            !page.contains("@import") && !page.contains("url("),
            "{}",
            record.problem.title
        );
        let text = format!("<pre id=\"sheet-text\">{}</pre>", escaped(&sheet(&record)));
        assert!(page.contains(&text), "{}", record.problem.title);
        assert!(page.len() < MOST_BYTES, "{} bytes", page.len());
    }
}

#[test]
fn what_must_be_known_at_once_stands_before_everything_else() {
    let text = page(&illustrated()).unwrap();
    let places = [
        "PASS: all 7 verdicts",
        "Limited by",
        "Set this",
        ">incidence<",
        ">speed<",
        "<nav",
    ];
    let places = places.map(|needed| text.find(needed).unwrap_or_else(|| panic!("no {needed}")));
    assert!(places.is_sorted(), "{places:?}");
    let text = page(&kept::record("no_room")).unwrap();
    assert!(text.contains("verdict bad") && text.contains("What would cure it"));
}

#[test]
fn the_head_of_a_page_says_what_that_of_the_sheet_says() {
    let labels = [
        ("  beware  ", "<dt>Beware<"),
        ("  spot  ", "<dt>Spot<"),
        ("  limited by  ", "<dt>Limited by<"),
        ("  search  ", "<dt>Search<"),
    ];
    let with_spot = |mut record: Record| {
        record.spot = Some(SpotRecord {
            length_m: 1.7e-3,
            width_m: 1.6e-3,
            share_of_target: 0.036,
        });
        record
    };
    let records = kept::NAMES.map(kept::record);
    let records = records.clone().into_iter().chain(records.map(with_spot));
    let mut hold_on_spots_alone = 0;
    for record in records {
        let (sheet, page) = (sheet(&record), page(&record).unwrap());
        let (head, _) = page.split_once("<nav").unwrap();
        for (on_sheet, on_page) in labels {
            let title = &record.problem.title;
            let (said, shown) = (sheet.contains(on_sheet), head.contains(on_page));
            assert_eq!(said, shown, "{title}: {on_page}");
        }
        let alone = "PASS holds there alone";
        assert_eq!(sheet.contains(alone), head.contains(alone));
        hold_on_spots_alone += usize::from(head.contains(alone));
    }
    assert!(hold_on_spots_alone > 0);
}

#[test]
fn pages_are_made_at_once_and_are_the_same_each_time() {
    let record = illustrated();
    let start = std::time::Instant::now();
    let first = page(&record).unwrap();
    assert!(start.elapsed().as_secs_f64() < 1.0, "{:?}", start.elapsed());
    let again = Record::from_json(&record.to_json().unwrap()).unwrap();
    assert!(first == page(&again).unwrap());
}

#[test]
fn names_cannot_break_out_of_the_page() {
    let names =
        |page: &str| -> Vec<String> { html::tags(page).into_iter().map(|tag| tag.name).collect() };
    let (kind, bad) = (page(&illustrated()).unwrap(), page(&hostile()).unwrap());
    let scripts = |page: &str| names(page).iter().filter(|name| *name == "script").count();
    assert_eq!(scripts(&kind), scripts(&bad));
    assert!(!names(&bad).contains(&"img".to_owned()));
    assert!(!bad.contains("<img") && !bad.contains("</script><"));
    assert!(bad.contains(&escaped(HOSTILE)));
    assert_eq!(fetched(&bad), Vec::<String>::new());
    // The data of the view comes back as it was.
    let (_, rest) = bad
        .split_once("<script type=\"application/json\" id=\"scene\">")
        .unwrap();
    let (json, _) = rest.split_once("</script>").unwrap();
    let scene: serde_json::Value = serde_json::from_str(json).unwrap();
    assert_eq!(scene["surfaces"][0]["name"], HOSTILE);
}

#[test]
fn rare_faults_are_not_shown_as_if_they_were_the_rule() {
    let record = illustrated();
    let paths = &record.evidence.as_ref().unwrap().paths;
    let as_they_come = paths.iter().filter(|path| !path.picked).count();
    assert!(as_they_come < paths.len());
    assert!(
        page(&record)
            .unwrap()
            .contains(&format!("{as_they_come} shots as they come"))
    );
}

/// Writes a page into a folder; gives its address.
fn written(folder: &Path, record: &Record) -> String {
    let file = folder.join("report.html");
    std::fs::write(&file, page(record).unwrap()).unwrap();
    format!("file://{}", file.display())
}

/// How many colours the canvas shows, coarsely.
const COLOURS: &str = "(() => {
    const canvas = document.querySelector('#viewer canvas');
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const context = copy.getContext('2d');
    context.drawImage(canvas, 0, 0);
    const pixels = context.getImageData(0, 0, copy.width, copy.height).data;
    const seen = new Set();
    for (let at = 0; at < pixels.length; at += 4) {
        seen.add((pixels[at] >> 4) << 8 | (pixels[at + 1] >> 4) << 4 | pixels[at + 2] >> 4);
    }
    return seen.size;
})()";
const PICTURE: &str = "document.querySelector('#viewer canvas').toDataURL()";

#[test]
#[ignore = "needs Chromium"]
fn a_browser_shows_the_page_and_the_view_obeys_the_keyboard() {
    let folder = tempfile::tempdir().unwrap();
    let record = illustrated();
    let mut browser = Browser::start(&[]);
    browser.open(&written(folder.path(), &record));
    browser.wait_for("document.documentElement.classList.contains('has-view')");
    let text = browser.value("document.getElementById('sheet-text').textContent");
    assert_eq!(text, sheet(&record));
    let colours = browser.value(COLOURS).as_u64().unwrap();
    assert!(colours > 30, "{colours} colours: the view is blank");

    browser.value("document.querySelector('#viewer canvas').focus()");
    browser.press("r");
    let first = browser.value(PICTURE);
    let mut last = first.clone();
    let keys = [
        "ArrowLeft",
        "ArrowUp",
        "ArrowRight",
        "ArrowDown",
        "+",
        "-",
        "s",
        "s",
        "]",
        "[",
        "w",
    ];
    for key in keys {
        browser.press(key);
        let next = browser.value(PICTURE);
        assert!(next != last, "nothing changes on {key}");
        last = next;
    }
    browser.press("r");
    assert!(browser.value(PICTURE) == first, "reset leads elsewhere");

    // What can be hidden is hidden, and a test strip can be picked from the table.
    browser.value("document.querySelector('.legend input').click()");
    assert!(browser.value(PICTURE) != first);
    browser.value("document.querySelector('[data-strip=\"1\"]').click()");
    browser.wait_for("document.querySelector('tr.picked') !== null");
    browser.wait_for(
        "document.querySelector('#viewer [role=status]').textContent.startsWith('Test strip 1')",
    );

    let elsewhere = |url: &&&str| !url.starts_with("file:") && !url.starts_with("data:");
    assert_eq!(
        browser.fetched().iter().filter(elsewhere).count(),
        0,
        "{:?}",
        browser.fetched()
    );
    browser.assert_no_complaints();
}

/// The nozzle of a stroke is dragged by its slider, moved by keys, and travels by itself.
#[test]
#[ignore = "needs Chromium"]
fn the_nozzle_of_a_stroke_travels() {
    let folder = tempfile::tempdir().unwrap();
    let record = crate::strokes::illustrated("keyway-stroke.yaml");
    let mut browser = Browser::start(&[]);
    browser.open(&written(folder.path(), record));
    browser.wait_for("document.documentElement.classList.contains('has-view')");
    let place = "document.querySelector('[data-motion=place]').value";
    let shown = "document.querySelector('[data-motion=shown]').textContent";
    let first = (browser.value(PICTURE), browser.value(place));
    assert_eq!(first.1, "500");
    browser.value(
        "(() => { const it = document.querySelector('[data-motion=place]'); it.value = 0; it.dispatchEvent(new Event('input')); })()",
    );
    let dragged = browser.value(PICTURE);
    assert!(dragged != first.0, "nothing moves");
    let text = browser.value(shown);
    assert!(text.as_str().unwrap().contains("z = 4 mm"), "{text}");
    browser.value("document.querySelector('#viewer canvas').focus()");
    browser.press(".");
    assert_eq!(browser.value(place), "20");
    browser.press(",");
    assert_eq!(browser.value(place), "0");
    browser.press("p");
    browser.wait_for(&format!("Number({place}) > 100"));
    browser.press("p");
    browser.assert_no_complaints();
}

#[test]
#[ignore = "needs Chromium"]
fn without_webgl_the_still_picture_stands_in() {
    let folder = tempfile::tempdir().unwrap();
    let mut browser = Browser::start(&["--disable-3d-apis"]);
    browser.open(&written(folder.path(), &illustrated()));
    browser.wait_for("document.querySelector('.still svg').getBoundingClientRect().height > 100");
    assert_eq!(
        browser.value("document.querySelector('#viewer').offsetHeight"),
        0
    );
    browser.assert_no_complaints();
}

#[test]
#[ignore = "needs Chromium"]
fn names_that_try_to_break_out_do_nothing_in_a_browser() {
    let folder = tempfile::tempdir().unwrap();
    let mut browser = Browser::start(&[]);
    browser.open(&written(folder.path(), &hostile()));
    browser.wait_for("document.documentElement.classList.contains('has-view')");
    assert_eq!(browser.value("document.images.length"), 0);
    assert_eq!(
        browser.value("document.querySelector('h1').textContent"),
        HOSTILE
    );
    browser.assert_no_complaints();
}
