#[path = "../../tests/common/cases.rs"]
mod cases;

use cases::cases;
use proptest::prelude::*;

use super::*;

#[test]
fn every_unit_leads_to_si() {
    let cases = [
        (Dimension::Length, "500 um", 0.0005),
        (Dimension::Length, "500 µm", 0.0005),
        (Dimension::Length, "0.5 mm", 0.0005),
        (Dimension::Length, "0.5mm", 0.0005),
        (Dimension::Length, "1e-3 mm", 1e-6),
        (Dimension::Length, "1e-3mm", 1e-6),
        (Dimension::Length, "1e-9999999999 mm", 0.0),
        (Dimension::Length, "+.5 cm", 0.005),
        (Dimension::Length, "-5. m", -5.0),
        (Dimension::Length, "1 in", 0.0254),
        (Dimension::Length, "2 inch", 0.0508),
        (Dimension::Length, "4\"", 0.1016),
        (Dimension::Length, "4″", 0.1016),
        (Dimension::Length, "5 mil", 5.0 * 0.0254 / 1000.0),
        (Dimension::Length, "5 thou", 5.0 * 0.0254 / 1000.0),
        (Dimension::Length, "2 ft", 0.6096),
        (Dimension::Length, "2'", 0.6096),
        (Dimension::Length, "0.5\u{a0}mm", 0.0005),
        (Dimension::Length, "0.5\u{202f}mm\u{200b}", 0.0005),
        (Dimension::Length, "−0.5 mm", -0.0005),
        (Dimension::Length, "–5e−1 mm", -0.0005),
        (Dimension::Angle, "180 deg", std::f64::consts::PI),
        (Dimension::Angle, "180°", std::f64::consts::PI),
        (Dimension::Angle, "1.5 rad", 1.5),
        (Dimension::Angle, "60′", std::f64::consts::PI / 180.0),
        (Dimension::Angle, "−180\u{2009}°", -std::f64::consts::PI),
        (Dimension::Speed, "10 m/s", 10.0),
        (Dimension::Speed, "10 mm/s", 0.01),
        (Dimension::Speed, "36 km/h", 10.0),
        (Dimension::Speed, "10 ft/s", 3.048),
        (Dimension::Speed, "10 fps", 3.048),
        (Dimension::Speed, "600 ft/min", 600.0 * (0.3048 / 60.0)),
        (Dimension::Speed, "10 in/s", 0.254),
        (Dimension::Speed, "60 m/min", 1.0),
        (Dimension::Speed, "10 m / s", 10.0),
        (Dimension::Speed, "10 m⁄s", 10.0),
        (Dimension::Impulse, "40 uN.s", 40e-6),
        (Dimension::Impulse, "40 uN s", 40e-6),
        (Dimension::Impulse, "40 µN.s", 40e-6),
        (Dimension::Impulse, "40 μN·s", 40e-6),
        (Dimension::Impulse, "40 uNs", 40e-6),
        (Dimension::Impulse, "3 mN.s", 3e-3),
        (Dimension::Impulse, "3 nN.s", 3e-9),
        (Dimension::Impulse, "3 N.s", 3.0),
        (Dimension::Density, "7000 kg/m3", 7000.0),
        (Dimension::Density, "7.8 g/cm3", 7800.0),
        (Dimension::Density, "7.8 g/cm^3", 7800.0),
        (Dimension::Density, "7000 kg/m³", 7000.0),
        (Dimension::Density, "7.8 g/cc", 7800.0),
        (Dimension::Density, "7.8 kg/dm³", 7800.0),
        // A pound on 28.316 846 592 l, and on 16.387 064 ml.
        (Dimension::Density, "1 lb/ft3", 16.018_463_373_960_138),
        (Dimension::Density, "1 lb/in^3", 27_679.904_710_203_12),
        (Dimension::MassFlow, "6 kg/min", 0.1),
        (Dimension::MassFlow, "0.1 kg/s", 0.1),
        (Dimension::MassFlow, "100 g/s", 0.1),
        (Dimension::MassFlow, "6000 g/min", 0.1),
        (Dimension::MassFlow, "60 lb/min", 0.453_592_37),
        (Dimension::MassFlow, "3600 kg/h", 1.0),
        (Dimension::MassFlow, "3600 lb/h", 0.453_592_37),
        (Dimension::Pressure, "2.5 bar", 250e3),
        (Dimension::Pressure, "250 kPa", 250e3),
        (Dimension::Pressure, "0.25 MPa", 250e3),
        (Dimension::Pressure, "3 Pa", 3.0),
        // A pound-force, 4.448 221 615 260 5 N, on 645.16 mm2.
        (Dimension::Pressure, "1 psi", 6_894.757_293_168_361),
        // A kilogram-force on a square millimetre.
        (Dimension::Hardness, "300 HB", 2.941_995e9),
        (Dimension::Hardness, "300 HBW", 2.941_995e9),
        (Dimension::Fraction, "5 %", 0.05),
        (Dimension::Fraction, "0.1%", 0.001),
    ];
    for (dimension, text, si) in cases {
        let read = parse(dimension, text).expect(text);
        // A factor is rounded once for each of its parts.
        assert!(
            (read - si).abs() <= 2.0 * f64::EPSILON * si.abs(),
            "{text}: {read} {si}"
        );
    }
}

#[test]
fn signs_in_the_wrong_place_are_no_quantities() {
    for text in [
        "5−10 mm",
        "5 – 10 mm",
        "−−5 mm",
        "1'000 mm",
        "1\u{a0}000 mm",
        "5'6\"",
        "0.5 m m",
    ] {
        assert!(parse(Dimension::Length, text).is_err(), "{text}");
    }
    for text in ["−5", "5\u{a0}", "\u{2009}–0.25"] {
        assert!(parse_number(text).is_some(), "{text}");
    }
}

#[test]
fn faults_say_what_to_write() {
    let cases = [
        (
            Dimension::Speed,
            "0.5 mm",
            "`0.5 mm` is a length; expected a speed such as `10 m/s`",
        ),
        (
            Dimension::Length,
            "0.5",
            "`0.5` has no unit; expected a length such as `0.5 mm`; did you mean `0.5 mm`?",
        ),
        (
            Dimension::Fraction,
            "0.07",
            "`0.07` has no unit; expected a percentage such as `5 %`; did you mean `7 %`?",
        ),
        (
            Dimension::Fraction,
            "5",
            "`5` has no unit; expected a percentage such as `5 %`; did you mean `5 %`?",
        ),
        (
            Dimension::Fraction,
            "1",
            "`1` has no unit; expected a percentage such as `5 %`; did you mean `1 %`?",
        ),
        (
            Dimension::Angle,
            "60 degrees",
            "`degrees` is not a unit of angle; expected one of deg, rad; did you mean `deg`?",
        ),
        (
            Dimension::Length,
            "5 MM",
            "`MM` is not a unit of length; expected one of um, mm, cm, m, in, inch, mil, thou, ft; \
             did you mean `mm`?",
        ),
        (
            Dimension::Length,
            "1_000 mm",
            "`1_000 mm` is not a number with a unit; expected a length such as `0.5 mm`; \
             did you mean `1000 mm`?",
        ),
        (
            Dimension::Length,
            "0,5 mm",
            "`0,5 mm` is not a number with a unit; expected a length such as `0.5 mm`; \
             did you mean `0.5 mm`?",
        ),
        (
            Dimension::Length,
            "1,000 mm",
            "`1,000 mm` is not a number with a unit; expected a length such as `0.5 mm`",
        ),
        (
            Dimension::Length,
            "nan mm",
            "`nan mm` is not a number with a unit; expected a length such as `0.5 mm`",
        ),
        (
            Dimension::Length,
            "1e999 mm",
            "`1e999 mm` is too large a number; expected a length such as `0.5 mm`",
        ),
        (
            Dimension::Length,
            "",
            "has no value; expected a length such as `0.5 mm`",
        ),
    ];
    for (dimension, text, message) in cases {
        let fault = parse(dimension, text).unwrap_err();
        assert_eq!(fault.to_string(), message, "{text}");
    }
}

#[test]
fn angles_come_back_as_they_were_written() {
    assert_eq!(degrees(std::f64::consts::PI), 180.0);
    for written in [0.0, 0.1, 60.0, -33.3, 359.999_999_999_9] {
        let radians = parse(Dimension::Angle, &format!("{written} deg")).unwrap();
        assert_eq!(degrees(radians), written);
    }
    assert_eq!(degrees(1.234e-11_f64.to_radians()), 0.0);
    assert_eq!(degrees(-6e-11_f64.to_radians()), -1e-10);
}

#[test]
fn bare_numbers_are_decimal() {
    assert_eq!(parse_number("-1.5e-3"), Some(-0.0015));
    for text in [
        "1_000", "0x10", "inf", ".nan", "", "1 mm", "1e", "--1", "1 2",
    ] {
        assert_eq!(parse_number(text), None, "{text}");
    }
}

fn dimension() -> impl Strategy<Value = Dimension> {
    (0..Dimension::ALL.len()).prop_map(|i| Dimension::ALL[i])
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn printing_and_parsing_round_trips(
        value in -1e12..1e12_f64,
        dimension in dimension(),
        pick in 0_usize..10,
        gap in 0_usize..3,
    ) {
        let (name, scale) = dimension.units()[pick % dimension.units().len()];
        let text = format!("{value}{:gap$}{name}", "");
        let si = parse(dimension, &text).unwrap();
        let back = match scale {
            Scale::Shift(places) => si * 10_f64.powi(-places),
            Scale::Factor(factor) => si / factor,
        };
        // One rounding each for the scale, the product and the way back.
        prop_assert!((back - value).abs() <= 4.0 * f64::EPSILON * value.abs());
    }

    #[test]
    fn no_text_makes_it_panic(text in "[-+0-9.eE_x,µ°%a-zN/ \\PC]{0,12}") {
        for dimension in Dimension::ALL {
            if let Ok(value) = parse(dimension, &text) {
                prop_assert!(value.is_finite());
            }
        }
    }
}
