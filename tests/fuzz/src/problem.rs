//! Problem files: every text is a sound problem, or has faults that can be shown.

use std::path::Path;

use peenpose::problem::fault::{Fault, Span};
use peenpose::problem::part::Shape;
use peenpose::problem::{self, Problem, Reading, Source};
use peenpose::scenario::Scenario;
use peenpose::scene::Walls;
use peenpose::warnings;

pub fn run(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    let path = Path::new("problems/any.yaml");
    let Reading {
        source,
        faults,
        problem,
        ..
    } = problem::read_text(&text, path).expect("shorter than a problem file may be");
    assert_eq!(problem.is_some(), faults.is_empty());
    can_be_shown(&source, &faults);
    let Some(problem) = problem else {
        return;
    };
    is_in_order(&problem);
    let is_mesh = |shape: &Shape| matches!(shape, Shape::Mesh { .. });
    if problem.parts.iter().any(|part| is_mesh(&part.shape)) {
        return;
    }
    match Scenario::new(problem, Walls::Exact) {
        Ok(scenario) => {
            let found = warnings::of(&scenario, &source);
            for warning in &found {
                fits(&source, warning.at);
            }
            let shown = problem::render_warnings(&source, &found, false);
            assert_eq!(shown.is_empty(), found.is_empty());
        }
        Err(faults) => {
            assert!(!faults.is_empty());
            can_be_shown(&source, &faults);
        }
    }
}

fn can_be_shown(source: &Source, faults: &[Fault]) {
    for fault in faults {
        fits(source, fault.at.or_else(|| source.locate(&fault.key)));
        let line = problem::one_line(source, fault);
        assert!(!line.contains(char::is_control), "{line:?}");
        assert!(!fault.message.is_empty());
    }
    for is_coloured in [false, true] {
        let shown = problem::render(source, faults, is_coloured);
        assert_eq!(shown.is_empty(), faults.is_empty());
    }
}

fn fits(source: &Source, place: Option<Span>) {
    let Some(Span {
        line,
        column,
        start,
        end,
    }) = place
    else {
        return;
    };
    assert!(line >= 1 && column >= 1);
    assert!(start <= end && end <= source.text.len(), "{start} to {end}");
    assert!(source.text.is_char_boundary(start) && source.text.is_char_boundary(end));
}

fn is_in_order(problem: &Problem) {
    let ranges = &problem.ranges;
    for range in [
        ranges.incidence,
        ranges.azimuth,
        ranges.standoff,
        ranges.speed,
        ranges.aim_along,
        ranges.aim_across,
        ranges.aim_above,
    ] {
        assert!(range.min <= range.max && range.width().is_finite());
    }
    assert!(!ranges.contact.is_empty());
    assert!(
        ranges
            .contact
            .iter()
            .all(|&index| index < problem.contacts.len())
    );
    for settings in &problem.contacts {
        let friction = settings.static_friction;
        for value in [friction.min, friction.max] {
            assert_eq!(settings.at(value).validate(), Ok(()));
        }
    }
    let mass = problem.shot.mass();
    assert!(mass > 0.0 && mass.is_finite(), "a shot of {mass} kg");
}
