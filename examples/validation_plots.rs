//! Draws the contact model against published measurements and simulations, its known miss included.
//!
//! `cargo run --release --example validation_plots -- docs/validation.svg`

use std::error::Error;

use nalgebra::Vector3;
use peenpose::impact::{Contact, Oblique, Sphere, rebound};
use plotters::prelude::*;

/// Okabe and Ito's colours, which colour-blind people can tell apart.
const MODEL: RGBColor = RGBColor(0, 114, 178);
const SPRINGY: RGBColor = RGBColor(230, 159, 0);
const DATA: RGBColor = RGBColor(34, 34, 34);
const MISS: RGBColor = RGBColor(213, 94, 0);

type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
type Points = Vec<(f64, f64)>;
/// A curve with its name and colour.
type Curve = (&'static str, RGBColor, Points);

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args()
        .nth(1)
        .ok_or("usage: validation_plots PICTURE.svg")?;
    let sheet = SVGBackend::new(&path, (1200, 960)).into_drawing_area();
    sheet.fill(&WHITE)?;
    let panels = sheet.split_evenly((2, 2));
    for (area, panel) in panels
        .iter()
        .zip([sideways(), spin(), patch(), low_restitution()])
    {
        panel.draw(area)?;
    }
    sheet.present()?;
    Ok(())
}

/// One pair of axes.
struct Panel {
    title: &'static str,
    x: (&'static str, f64),
    y: (&'static str, std::ops::Range<f64>),
    curves: Vec<Curve>,
    measured: Vec<(&'static str, Points)>,
    legend: SeriesLabelPosition,
    /// Where the model is known to be wrong, along x, and what is said about it.
    miss: Option<(std::ops::Range<f64>, &'static str)>,
}

impl Panel {
    fn draw(self, area: &Area) -> Result<(), Box<dyn Error>> {
        let (low, high) = (self.y.1.start, self.y.1.end);
        let mut chart = ChartBuilder::on(area)
            .caption(self.title, ("sans-serif", 19))
            .margin(14)
            .x_label_area_size(46)
            .y_label_area_size(64)
            .build_cartesian_2d(0.0..self.x.1, self.y.1)?;
        chart
            .configure_mesh()
            .x_desc(self.x.0)
            .y_desc(self.y.0)
            .x_label_formatter(&short)
            .y_label_formatter(&short)
            .label_style(("sans-serif", 15))
            .axis_desc_style(("sans-serif", 16))
            .light_line_style(TRANSPARENT)
            .draw()?;
        if let Some((range, words)) = self.miss {
            let band = [(range.start, low), (range.end, high)];
            chart.draw_series([Rectangle::new(band, MISS.mix(0.12).filled())])?;
            let place = (range.start + 0.3, high - 0.04 * (high - low));
            chart.draw_series([Text::new(
                words,
                place,
                ("sans-serif", 14).into_font().color(&MISS),
            )])?;
        }
        for (name, colour, points) in self.curves {
            chart
                .draw_series([PathElement::new(points, colour.stroke_width(2))])?
                .label(name)
                .legend(move |(x, y)| {
                    PathElement::new([(x, y), (x + 22, y)], colour.stroke_width(2))
                });
        }
        for (number, (name, points)) in self.measured.into_iter().enumerate() {
            let filled = if number == 0 {
                DATA.filled()
            } else {
                DATA.stroke_width(1)
            };
            chart
                .draw_series(
                    points
                        .into_iter()
                        .map(|point| Circle::new(point, 4, filled)),
                )?
                .label(name)
                .legend(move |(x, y)| Circle::new((x + 11, y), 4, filled));
        }
        chart
            .configure_series_labels()
            .label_font(("sans-serif", 15))
            .position(self.legend)
            .background_style(WHITE.mix(0.9))
            .border_style(BLACK.mix(0.2))
            .draw()?;
        Ok(())
    }
}

/// A number of an axis, without zeros that say nothing.
fn short(value: &f64) -> String {
    let rounded = (value * 1000.0).round() / 1000.0;
    (rounded + 0.0).to_string()
}

/// Columns of a data file: the first one and another.
fn columns(text: &str, other: usize) -> Points {
    let rows = text.lines().filter(|line| !line.starts_with('#'));
    rows.filter_map(|row| {
        let values: Vec<f64> = row
            .split(',')
            .filter_map(|value| value.parse().ok())
            .collect();
        Some((*values.first()?, *values.get(other)?))
    })
    .collect()
}

/// The alumina spheres of Kharaz and others: tangential restitution e_t and spin, rad/s.
fn alumina(from_normal: f64, beta: f64) -> Option<(f64, f64)> {
    let shot = Oblique {
        sphere: Sphere {
            radius: 2.5e-3,
            density: 4000.0,
        },
        contact: Contact {
            tangential_restitution: beta,
            ..Contact::new(0.092, 0.092, 0.98).ok()?
        },
        speed: 3.9,
        angle: (90.0 - from_normal).to_radians(),
        spin: 0.0,
    };
    let outcome = shot.outcome()?;
    Some((
        outcome.tangential_velocity / (shot.speed * shot.angle.cos()),
        outcome.spin.abs(),
    ))
}

fn alumina_curve(beta: f64, of: fn((f64, f64)) -> f64) -> Points {
    let angles = (2..=170).map(|half| f64::from(half) / 2.0);
    angles
        .filter_map(|angle| Some((angle, of(alumina(angle, beta)?))))
        .collect()
}

/// e_t after an impact with v_n = 5 m/s and no spin, and the slip that is left, m/s.
fn flat(friction: f64, restitution: f64, along: f64) -> Option<(f64, f64)> {
    let contact = Contact::new(friction, friction, restitution).ok()?;
    let velocity = Vector3::new(along, 0.0, -5.0);
    let after = rebound(&contact, &velocity, &Vector3::zeros(), &Vector3::z())?;
    Some((after.velocity.x / along, after.velocity.x - after.rolling.y))
}

fn sideways() -> Panel {
    Panel {
        title: "Sideways speed kept: alumina on glass, 3.9 m/s",
        x: ("impact angle from the normal, deg", 85.0),
        y: ("v_t' / v_t", 0.45..1.0),
        curves: vec![
            ("model", MODEL, alumina_curve(0.0, |(e_t, _)| e_t)),
            (
                "model, tangential restitution 0.4",
                SPRINGY,
                alumina_curve(0.4, |(e_t, _)| e_t),
            ),
        ],
        measured: vec![
            (
                "measured (Kharaz, 2001)",
                columns(include_str!("../tests/data/kharaz2001_e_t.csv"), 1),
            ),
            (
                "DEM (Chung and Ooi, 2011, test 4)",
                columns(include_str!("../tests/data/chung_ooi2011_test4.csv"), 1),
            ),
        ],
        legend: SeriesLabelPosition::LowerRight,
        miss: Some((8.0..32.0, "known miss")),
    }
}

fn spin() -> Panel {
    Panel {
        title: "Spin after the impact: the same spheres",
        x: ("impact angle from the normal, deg", 85.0),
        y: ("spin, rad/s", 0.0..800.0),
        curves: vec![("model", MODEL, alumina_curve(0.0, |(_, spin)| spin))],
        measured: vec![
            (
                "measured (Kharaz, 2001)",
                columns(include_str!("../tests/data/kharaz2001_spin.csv"), 1),
            ),
            (
                "DEM (Chung and Ooi, 2011, test 4)",
                columns(include_str!("../tests/data/chung_ooi2011_test4.csv"), 2),
            ),
        ],
        legend: SeriesLabelPosition::LowerMiddle,
        miss: Some((8.0..32.0, "known miss")),
    }
}

fn patch() -> Panel {
    let friction = 0.3;
    let slip = |psi: f64| {
        Some((
            psi,
            flat(friction, 1.0, psi * friction * 5.0)?.1 / (friction * 5.0),
        ))
    };
    Panel {
        title: "Slip left at the contact: finite elements, mu 0.3, E 1",
        x: ("slip before, v_t / (mu v_n)", 15.0),
        y: ("slip after, s' / (mu v_n')", -4.6..8.0),
        curves: vec![(
            "model",
            MODEL,
            (1..=300)
                .filter_map(|i| slip(f64::from(i) / 20.0))
                .collect(),
        )],
        measured: vec![(
            "finite elements (Chung and Ooi, 2011, test 5)",
            columns(include_str!("../tests/data/chung_ooi2011_test5_fe.csv"), 1),
        )],
        legend: SeriesLabelPosition::LowerRight,
        miss: Some((0.5..7.0, "known miss")),
    }
}

fn low_restitution() -> Panel {
    let (friction, restitution) = (0.1, 0.25);
    let kept = |theta: f64| {
        let along = theta * friction * (1.0 + restitution) / 2.0 * 5.0;
        Some((theta, flat(friction, restitution, along)?.0))
    };
    let data = include_str!("../tests/data/thornton_e025.csv");
    Panel {
        title: "Nearest to peening: E 0.25, mu 0.1",
        x: ("2 tan(angle from the normal) / (mu (1 + E))", 15.0),
        y: ("v_t' / v_t", 0.6..1.0),
        curves: vec![(
            "model",
            MODEL,
            (1..=300)
                .filter_map(|i| kept(f64::from(i) / 20.0))
                .collect(),
        )],
        measured: vec![
            ("DEM, Hertz contact (Thornton)", columns(data, 1)),
            ("DEM, linear contact (Thornton)", columns(data, 2)),
        ],
        legend: SeriesLabelPosition::LowerRight,
        miss: None,
    }
}
