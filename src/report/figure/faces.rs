//! The smooth faces of a mesh with their numbers: from two opposite corners, and both halves cut open.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use base64::prelude::{BASE64_STANDARD, Engine};
use nalgebra::Vector3;
use plotters::style::{Color, HSLColor};

use super::png;
use super::view::View;
use crate::digits::significant;
use crate::elementary::extremes;
use crate::report::faces::largest;
use crate::scene::mesh::{Mesh, SmoothFaces};

/// Directions towards the eye, and whether the part is cut open.
const VIEWS: [([f64; 3], bool); 6] = [
    ([1.0, -1.4, 0.9], false),
    ([-1.0, 1.4, -0.9], false),
    ([1.0, -1.4, 0.9], true),
    ([-1.0, -1.4, 0.9], true),
    ([1.0, 1.4, 0.9], true),
    ([-1.0, 1.4, 0.9], true),
];
const COLUMNS: usize = 3;
/// Side of a view, and between views.
const SIDE: f64 = 540.0;
const MARGIN: f64 = 20.0;
/// Below a view, for its name.
const FOOT: f64 = 34.0;
/// Pixels of a view for each unit of the picture: edges are even on fine screens as well.
const FINENESS: f64 = 2.0;
const SIZE: usize = (SIDE * FINENESS) as usize;
/// Turns from face to face by this share of the circle of colours, which comes back to no colour soon.
const GOLDEN: f64 = 0.381_966;
/// A face has a number if this many pixels lie between that and its edges.
const LEAST_ROOM: u32 = 4;

/// The picture; the largest faces have a number wherever they are seen.
pub(super) fn svg(mesh: &Mesh, faces: &SmoothFaces, most: usize) -> Result<String, String> {
    let (low, high) = extremes(mesh.vertices.iter().map(|it| it.y));
    let half_way = 0.5 * (low + high);
    let largest = largest(faces).into_iter().take(most);
    let numbered: BTreeSet<usize> = largest.map(|(number, _)| number).collect();
    let mut unseen = numbered.clone();
    let width = COLUMNS as f64 * (SIDE + MARGIN) + MARGIN;
    let height = (VIEWS.len() / COLUMNS) as f64 * (SIDE + FOOT) + MARGIN;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" \
         font-size=\"15\" text-anchor=\"middle\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
    );
    // Writing to a string cannot fail.
    for (index, (towards, is_cut)) in VIEWS.into_iter().enumerate() {
        let left = MARGIN + (index % COLUMNS) as f64 * (SIDE + MARGIN);
        let top = MARGIN + (index / COLUMNS) as f64 * (SIDE + FOOT);
        let cut = is_cut.then_some(half_way);
        let seen = seen(mesh, faces, &View::new(mesh, towards.into(), cut, SIZE));
        let picture = BASE64_STANDARD.encode(png::of_pixels(&colours(&seen), SIZE as u32)?);
        let _ = writeln!(
            svg,
            "<image x=\"{left}\" y=\"{top}\" width=\"{SIDE}\" height=\"{SIDE}\" \
             href=\"data:image/png;base64,{picture}\"/>\n<text x=\"{}\" y=\"{}\" fill=\"#555\">{}</text>",
            left + 0.5 * SIDE,
            top + SIDE + 0.45 * FOOT,
            name(towards.into(), cut)
        );
        for (number, [x, y]) in places(&seen) {
            if !numbered.contains(&number) {
                continue;
            }
            unseen.remove(&number);
            let _ = writeln!(
                svg,
                "<text x=\"{:.1}\" y=\"{:.1}\" dominant-baseline=\"central\" stroke=\"white\" stroke-width=\"4\" \
                 stroke-linejoin=\"round\" paint-order=\"stroke\">{}</text>",
                left + x,
                top + y,
                number + 1
            );
        }
    }
    if !unseen.is_empty() {
        let numbers: Vec<String> = unseen.iter().map(|it| (it + 1).to_string()).collect();
        let _ = writeln!(
            svg,
            "<text x=\"{MARGIN}\" y=\"{MARGIN}\" text-anchor=\"start\" fill=\"#555\">hidden, or too small here: \
             {}</text>",
            numbers.join(", ")
        );
    }
    Ok(svg + "</svg>\n")
}

/// Says where a view is from.
fn name(towards: Vector3<f64>, cut: Option<f64>) -> String {
    let sign = towards.map(|it| if it < 0.0 { '-' } else { '+' });
    let from = format!("from {}x, {}y, {}z", sign.x, sign.y, sign.z);
    match cut {
        None => from,
        Some(cut) => {
            let place = significant(cut, 4);
            format!("{from}, cut open at y = {place}; paler: from behind")
        }
    }
}

/// The face that a pixel sees.
#[derive(Clone, Copy)]
struct Seen {
    face: u32,
    /// Of the angle between its normal and the eye: below 0 from behind.
    cosine: f64,
}

/// What the pixels of a view see, row by row.
fn seen(mesh: &Mesh, faces: &SmoothFaces, view: &View) -> Vec<Option<Seen>> {
    let of = |triangle: usize| {
        let area = mesh.doubled_area(&mesh.triangles[triangle]);
        Seen {
            face: faces.of[triangle],
            cosine: area.normalize().dot(&view.towards()),
        }
    };
    let triangles = view.seen(mesh).into_iter();
    triangles.map(|triangle| triangle.map(of)).collect()
}

/// One colour for each face, darker where it is seen aslant and where it ends, paler from behind.
fn colours(seen: &[Option<Seen>]) -> Vec<[u8; 3]> {
    let face = |pixel: usize| seen.get(pixel).copied().flatten().map(|it| it.face);
    let of_pixel = |(pixel, seen): (usize, &Option<Seen>)| {
        let beside = [pixel + 1, pixel + SIZE];
        if beside.iter().any(|&beside| face(beside) != face(pixel)) {
            return EDGE;
        }
        let Some(Seen { face, cosine }) = *seen else {
            return WHITE;
        };
        let hue = (f64::from(face) * GOLDEN).fract();
        let light = 0.45 + 0.35 * cosine.abs();
        let (strength, light) = match cosine < 0.0 {
            true => (0.25, 0.6 + 0.4 * light),
            false => (0.45, light),
        };
        let (red, green, blue) = HSLColor(hue, strength, light).to_backend_color().rgb;
        [red, green, blue]
    };
    seen.iter().enumerate().map(of_pixel).collect()
}

/// For each face that is seen from its front, a pixel as far from its edges as any, where there is room for a number.
fn places(seen: &[Option<Seen>]) -> BTreeMap<usize, [f64; 2]> {
    let front = |pixel: usize| seen[pixel].filter(|it| it.cosine > 0.0).map(|it| it.face);
    // Distances from the edges along rows and columns: first from those before, then from those behind.
    let mut room = vec![0_u32; seen.len()];
    let is_inside = |pixel: usize| {
        let (x, y) = (pixel % SIZE, pixel / SIZE);
        (1..SIZE - 1).contains(&x) && (1..SIZE - 1).contains(&y)
    };
    let room_from = |room: &[u32], pixel: usize, beside: [usize; 2]| match beside
        .iter()
        .all(|&it| front(it) == front(pixel))
    {
        true => 1 + room[beside[0]].min(room[beside[1]]),
        false => 0,
    };
    for pixel in (0..seen.len()).filter(|&it| is_inside(it)) {
        room[pixel] = room_from(&room, pixel, [pixel - 1, pixel - SIZE]);
    }
    let mut places: BTreeMap<u32, (u32, usize)> = BTreeMap::new();
    for pixel in (0..seen.len()).rev().filter(|&it| is_inside(it)) {
        room[pixel] = room[pixel].min(room_from(&room, pixel, [pixel + 1, pixel + SIZE]));
        if let Some(face) = front(pixel)
            && room[pixel] >= LEAST_ROOM
        {
            let best = places.entry(face).or_insert((room[pixel], pixel));
            *best = (*best).max((room[pixel], pixel));
        }
    }
    let place = |pixel: usize| [pixel % SIZE, pixel / SIZE].map(|it| it as f64 / FINENESS);
    let places = places.into_iter();
    places
        .map(|(face, (_, pixel))| (face as usize, place(pixel)))
        .collect()
}

const WHITE: [u8; 3] = [255; 3];
/// Where a face ends.
const EDGE: [u8; 3] = [70; 3];
