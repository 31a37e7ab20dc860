//! The command without the process.

use clap::Parser;

use super::{ImpactArgs, run};

#[derive(Parser)]
struct Line {
    #[command(flatten)]
    args: ImpactArgs,
}

fn result(flags: &[&str]) -> Result<String, String> {
    let words = ["impact"].into_iter().chain(flags.iter().copied());
    run(&Line::try_parse_from(words).unwrap().args)
}

#[test]
fn without_flags_it_is_the_case_of_the_paper() {
    let text = result(&[]).unwrap();
    for line in [
        "regime                             stick",
        "tangential velocity v_t'          3.5714  m/s",
        "energy after / before             0.2254",
        "sticks from tan(theta)           0.76190  so from 37.3039 deg without spin",
    ] {
        assert!(text.lines().any(|found| found == line), "{text}");
    }
}

#[test]
fn every_fault_is_named_at_once() {
    let text = result(&[
        "--speed",
        "10",
        "--angle",
        "100 deg",
        "--spin",
        "-5",
        "--mu-s",
        "x",
        "--mu-d",
        "-1",
        "--restitution",
        "2",
    ])
    .unwrap_err();
    let flags: Vec<&str> = text
        .lines()
        .filter_map(|line| line.split_once(':'))
        .map(|(flag, _)| flag)
        .collect();
    assert_eq!(
        flags,
        [
            "--speed",
            "--angle",
            "--spin",
            "--mu-s",
            "--mu-d",
            "--restitution"
        ],
        "{text}"
    );
}

#[test]
fn numbers_are_finite_at_the_ends_of_the_ranges_and_refused_beyond() {
    let ends = [
        (
            "--speed",
            ["0.001 mm/s", "10000 m/s"],
            ["0.0009 mm/s", "1e160 m/s"],
        ),
        ("--radius", ["0.001 um", "1000 m"], ["0.0009 um", "1e200 m"]),
        (
            "--density",
            ["1 kg/m3", "100000 kg/m3"],
            ["0 kg/m3", "1e300 kg/m3"],
        ),
        (
            "--spin",
            ["-1e12 rad/s", "1e12 rad/s"],
            ["-1e300 rad/s", "inf rad/s"],
        ),
    ];
    for corner in 0..1 << ends.len() {
        let end = |(index, (flag, within, _)): (usize, &(&'static str, [&'static str; 2], _))| {
            [*flag, within[corner >> index & 1]]
        };
        let mut flags: Vec<&str> = ends.iter().enumerate().flat_map(end).collect();
        flags.push("--json");
        let json: serde_json::Value = serde_json::from_str(&result(&flags).unwrap()).unwrap();
        let unbounded = json.as_object().unwrap().iter();
        let unbounded: Vec<_> = unbounded.filter(|(_, value)| value.is_null()).collect();
        assert!(unbounded.is_empty(), "{flags:?}: {unbounded:?}");
    }
    for (flag, _, beyond) in ends {
        for text in beyond {
            let fault = result(&[flag, text]).unwrap_err();
            assert!(
                fault.starts_with(&format!("{flag}: `{text}` is ")),
                "{fault}"
            );
            assert_eq!(fault.lines().count(), 1, "{fault}");
        }
    }
}

#[test]
fn json_is_in_si() {
    let text = result(&["--mu-s", "0", "--speed", "36 km/h", "--json"]).unwrap();
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(json["speed_m_s"], 10.0);
    assert_eq!(json["regime"], "slip");
    assert_eq!(json["stick_angle_rad"], serde_json::Value::Null);
    let energy = json["translation_energy_before_J"].as_f64().unwrap();
    assert!((energy - 183.2596e-6).abs() < 1e-10);
}

#[test]
fn tables_are_right_unless_they_shall_be_as_published() {
    let row = |flags: &[&str]| {
        let text = result(flags).unwrap();
        let line = text.lines().find(|line| line.starts_with("0.300"));
        line.unwrap()
            .split_whitespace()
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    assert_eq!(
        row(&["--table", "zohdi1"]),
        [
            "0.300",
            "stick",
            "2.1651",
            "3.5714",
            "31.2250",
            "-7142.8571"
        ]
    );
    assert_eq!(
        row(&["--table", "zohdi1", "--as-published"]),
        [
            "0.300",
            "slip",
            "2.1651",
            "2.0772",
            "46.1870",
            "-14614.1787"
        ]
    );
    assert_eq!(
        row(&["--table", "zohdi2", "--as-published"]),
        [
            "0.300", "slip", "39.6769", "10.7128", "183.2596", "16.4972", "0.0000", "39.1395",
            "0.3036"
        ]
    );
}
