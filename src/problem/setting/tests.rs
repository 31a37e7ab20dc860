use super::*;

const CHOICE: Settings = Settings {
    incidence: 1.0,
    azimuth: 2.0,
    standoff: 3.0,
    speed: 4.0,
    aim_along: 5.0,
    aim_across: 6.0,
    aim_above: 7.0,
    contact: 1,
    static_friction: 8.0,
};

#[test]
fn a_range_holds_its_ends() {
    let range = Range {
        min: -1.0,
        max: 3.0,
    };
    let held: Vec<bool> = [-1.1, -1.0, 0.0, 3.0, 3.1]
        .map(|value| range.contains(value))
        .into();
    assert_eq!(held, [false, true, true, true, false]);
    assert_eq!(range.width(), 4.0);
    assert_eq!(
        [0.0, 0.25, 1.0].map(|share| range.at(share)),
        [-1.0, 0.0, 3.0]
    );
    assert!(!range.is_held());
    let held = Range::held(0.1);
    assert!(held.is_held());
    assert_eq!([held.at(0.3), held.width()], [0.1, 0.0]);
}

#[test]
fn every_setting_has_a_value_of_its_own() {
    let all = Setting::ALL;
    let values = all.map(|setting| setting.of(&CHOICE));
    assert_eq!(values, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
    assert_eq!(values, CHOICE.numbers());
    for (index, setting) in all.iter().enumerate() {
        let mut expected = CHOICE.numbers();
        expected[index] = -9.0;
        let changed = setting.with(&CHOICE, -9.0);
        assert_eq!(changed.numbers(), expected, "{setting:?}");
        assert_eq!(changed.contact, CHOICE.contact);
    }
}

#[test]
fn every_setting_has_a_range_of_its_own() {
    let from = |min: f64| Range {
        min,
        max: 2.0 * min,
    };
    let mut settings = SettingRanges {
        incidence: from(1.0),
        azimuth: from(2.0),
        standoff: from(3.0),
        speed: from(4.0),
        aim_along: from(5.0),
        aim_across: from(6.0),
        aim_above: from(7.0),
        contact: vec![2, 1],
    };
    for setting in Setting::OF_THE_NOZZLE {
        let range = settings.range(setting);
        assert_eq!(range, Some(from(setting.of(&CHOICE))), "{setting:?}");
        let middle = setting.of(&settings.middle());
        assert_eq!(middle, 1.5 * setting.of(&CHOICE), "{setting:?}");
    }
    assert_eq!(settings.range(Setting::StaticFriction), None);
    assert_eq!(settings.middle().contact, 2);
    assert!(settings.aims_above());
    settings.aim_above = Range { min: 0.0, max: 7.0 };
    assert!(!settings.aims_above());
}
