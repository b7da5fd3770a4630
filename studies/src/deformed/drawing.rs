//! The drawing itself: projection, faces in the order of their depth, colours and their legend, a bar of length.

use std::error::Error;
use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::{Mark, Picture, State, View};

/// Width of a picture, and of the area of the legend, in pixels.
const WIDTH: f64 = 1600.0;
const LEGEND: f64 = 150.0;

/// Heights of the title, of the area of a state, at most, and of its caption, in pixels.
const TITLE: f64 = 80.0;
const STATE: f64 = 560.0;
const CAPTION: f64 = 50.0;

/// Space between a state and the edges of its area, in pixels.
const MARGIN: f64 = 30.0;

/// Fonts in pixels.
const TITLE_FONT: f64 = 40.0;
const FONT: f64 = 28.0;

/// Colours of the least, the middle and the greatest value: colour-blind readers can tell them apart.
const COLOURS: [[f64; 3]; 3] = [
    [0.0, 114.0, 178.0],
    [240.0, 240.0, 225.0],
    [213.0, 94.0, 0.0],
];

/// Colours of marks, by the order of their names.
const MARKS: [RGBColor; 3] = [
    RGBColor(150, 0, 130),
    RGBColor(0, 0, 0),
    RGBColor(110, 220, 40),
];

/// Width of lines and radius of dots, in pixels.
const MARK: u32 = 4;
const DOT: i32 = 5;

type Canvas<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// A projected face: its corners, m to the right and upwards, how near it is, m, and its value.
struct Face {
    corners: Vec<[f64; 2]>,
    nearness: f64,
    value: f64,
}

/// Draws a picture into the file `path`.
pub(super) fn draw(picture: &Picture, path: &Path) -> Result<(), Box<dyn Error>> {
    let states: Vec<Vec<Face>> = picture
        .states
        .iter()
        .map(|state| project(state, picture.view))
        .collect();
    let count = states.len().max(1);
    let columns = count.min(if count == 4 { 2 } else { 3 });
    let rows = count.div_ceil(columns);
    let wide = WIDTH / real(columns);
    // Every state is in the middle of its area.
    let windows: Vec<[[f64; 2]; 2]> = picture
        .states
        .iter()
        .map(|state| window(state, picture.view))
        .collect();
    let extent = [0, 1].map(|axis| {
        let spans = windows
            .iter()
            .map(|window| window[axis][1] - window[axis][0]);
        spans.fold(f64::MIN_POSITIVE, f64::max)
    });
    let room = [wide - 2.0 * MARGIN, STATE - 2.0 * MARGIN];
    let scale = (room[0] / extent[0]).min(room[1] / extent[1]);
    let area = scale * extent[1] + 2.0 * MARGIN;
    let high = area + CAPTION;
    let height = TITLE + real(rows) * high + LEGEND;
    let canvas = SVGBackend::new(
        path,
        (pixels(WIDTH).unsigned_abs(), pixels(height).unsigned_abs()),
    )
    .into_drawing_area();
    canvas.fill(&WHITE)?;
    text(
        &canvas,
        (&picture.title, TITLE_FONT),
        [0.5 * WIDTH, 0.5 * TITLE],
        HPos::Center,
    )?;

    let values = range(states.iter().flatten().map(|face| face.value));
    let kinds = kinds(&picture.states);
    for (at, (faces, state)) in states.iter().zip(&picture.states).enumerate() {
        let corner = [wide * real(at % columns), TITLE + high * real(at / columns)];
        let centre = [corner[0] + 0.5 * wide, corner[1] + 0.5 * area];
        let middle = windows[at].map(|[from, to]| f64::midpoint(from, to));
        let place = |at: &[f64; 2]| {
            let off = [0, 1].map(|axis| scale * (at[axis] - middle[axis]));
            (pixels(centre[0] + off[0]), pixels(centre[1] - off[1]))
        };
        for face in faces {
            let mut corners: Vec<_> = face.corners.iter().map(place).collect();
            canvas.draw(&Polygon::new(
                corners.clone(),
                colour(face.value, values).filled(),
            ))?;
            corners.extend(corners.first().copied());
            canvas.draw(&PathElement::new(
                corners,
                RGBColor(60, 60, 60).stroke_width(1),
            ))?;
        }
        for mark in &state.marks {
            let places = mark.places.iter();
            let places = places.map(|&at| place(&projected(at, picture.view)));
            draw_mark(&canvas, places.collect(), colour_of(&kinds, mark.name))?;
        }
        text(
            &canvas,
            (&state.caption, FONT),
            [centre[0], corner[1] + area + 0.5 * CAPTION],
            HPos::Center,
        )?;
    }
    legend(&canvas, (&picture.quantity, values), height - LEGEND)?;
    bar(&canvas, scale, height - LEGEND)?;
    legend_of_marks(&canvas, &kinds, height - LEGEND)?;
    canvas.present()?;
    Ok(())
}

/// The first mark of each name.
fn kinds(states: &[State]) -> Vec<&Mark> {
    let mut kinds: Vec<&Mark> = Vec::new();
    for mark in states.iter().flat_map(|state| &state.marks) {
        if kinds.iter().all(|own| own.name != mark.name) {
            kinds.push(mark);
        }
    }
    kinds
}

fn colour_of(kinds: &[&Mark], name: &str) -> RGBColor {
    let place = kinds.iter().position(|own| own.name == name);
    MARKS[place.unwrap_or(0) % MARKS.len()]
}

/// A line, or a dot.
fn draw_mark(
    canvas: &Canvas<'_>,
    places: Vec<(i32, i32)>,
    colour: RGBColor,
) -> Result<(), Box<dyn Error>> {
    if let [place] = places[..] {
        canvas.draw(&Circle::new(place, DOT, colour.filled()))?;
    } else {
        canvas.draw(&PathElement::new(places, colour.stroke_width(MARK)))?;
    }
    Ok(())
}

/// What marks mean, beside the colours.
fn legend_of_marks(canvas: &Canvas<'_>, kinds: &[&Mark], top: f64) -> Result<(), Box<dyn Error>> {
    for (row, mark) in kinds.iter().enumerate() {
        let [left, y] = [900.0, top + 25.0 + 39.0 * real(row)];
        let ends = if mark.places.len() == 1 {
            vec![left + 20.0]
        } else {
            vec![left, left + 40.0]
        };
        let sample = ends.into_iter().map(|x| (pixels(x), pixels(y)));
        draw_mark(canvas, sample.collect(), colour_of(kinds, mark.name))?;
        text(canvas, (mark.name, FONT), [left + 55.0, y], HPos::Left)?;
    }
    Ok(())
}

/// What a state covers to the right and upwards, m.
fn window(state: &State, view: View) -> [[f64; 2]; 2] {
    let faces = state.patches.iter().flat_map(|patch| &patch.corners);
    let marks = state.marks.iter().flat_map(|mark| &mark.places);
    let places: Vec<[f64; 2]> = faces.chain(marks).map(|&at| projected(at, view)).collect();
    [0, 1].map(|axis| range(places.iter().map(|at| at[axis])))
}

/// A place, m to the right and upwards.
fn projected(at: [f64; 3], view: View) -> [f64; 2] {
    let [right, up, _] = axes(view);
    [dot(at, right), dot(at, up)]
}

/// The faces that look at the viewer, the farthest first.
fn project(state: &State, view: View) -> Vec<Face> {
    let [_, _, near] = axes(view);
    let mut faces: Vec<Face> = Vec::new();
    for patch in &state.patches {
        let corners: Vec<_> = patch
            .corners
            .iter()
            .map(|&at| projected(at, view))
            .collect();
        let depths = patch.corners.iter().map(|&at| dot(at, near));
        let nearness = depths.sum::<f64>() / real(patch.corners.len());
        let next = corners.iter().skip(1).chain(&corners);
        let twice_area: f64 = corners
            .iter()
            .zip(next)
            .map(|(a, b)| a[0] * b[1] - a[1] * b[0])
            .sum();
        if twice_area > 0.0 {
            let value = patch.value;
            faces.push(Face {
                corners,
                nearness,
                value,
            });
        }
    }
    faces.sort_by(|a, b| a.nearness.total_cmp(&b.nearness));
    faces
}

/// Unit vectors to the right, upwards and towards the viewer.
fn axes(view: View) -> [[f64; 3]; 3] {
    let unit = |axis: usize, size: f64| {
        let mut unit = [0.0; 3];
        unit[axis % 3] = size;
        unit
    };
    match view {
        View::Along(axis) => [unit(axis + 1, 1.0), unit(axis + 2, 1.0), unit(axis, 1.0)],
        View::Oblique(axis) => {
            let [half, third] = [2.0_f64, 3.0].map(|number| number.sqrt().recip());
            let sixth = half * third;
            let mut right = unit(axis + 2, half);
            right[(axis + 1) % 3] = -half;
            let mut up = [-sixth; 3];
            up[axis % 3] = 2.0 * sixth;
            [right, up, [third; 3]]
        }
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The least and the greatest value.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let start = [f64::INFINITY, f64::NEG_INFINITY];
    let range = values.fold(start, |[from, to], value| [from.min(value), to.max(value)]);
    if range[0] <= range[1] {
        range
    } else {
        [0.0, 1.0]
    }
}

/// The colour of a value in a range.
fn colour(value: f64, [from, to]: [f64; 2]) -> RGBColor {
    let at = if to > from {
        (value - from) / (to - from)
    } else {
        0.5
    };
    let [low, middle, high] = COLOURS;
    let (start, end, share) = if at < 0.5 {
        (low, middle, 2.0 * at)
    } else {
        (middle, high, 2.0 * at - 1.0)
    };
    let mixed = |channel: usize| {
        let value = start[channel] + share * (end[channel] - start[channel]);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 0 and 255"
        )]
        let byte = value.round() as u8;
        byte
    };
    RGBColor(mixed(0), mixed(1), mixed(2))
}

/// What colours mean, at the left.
fn legend(
    canvas: &Canvas<'_>,
    (quantity, range): (&str, [f64; 2]),
    top: f64,
) -> Result<(), Box<dyn Error>> {
    let [left, right] = [120.0, 820.0];
    let parts: u8 = 100;
    for part in 0..parts {
        let edge = |at: u8| left + (right - left) * f64::from(at) / f64::from(parts);
        let value = range[0] + (range[1] - range[0]) * (f64::from(part) + 0.5) / f64::from(parts);
        let corners = [
            (pixels(edge(part)), pixels(top + 10.0)),
            (pixels(edge(part + 1)), pixels(top + 40.0)),
        ];
        canvas.draw(&Rectangle::new(corners, colour(value, range).filled()))?;
    }
    let middle = f64::midpoint(range[0], range[1]);
    for (at, value) in [
        (left, range[0]),
        (0.5 * (left + right), middle),
        (right, range[1]),
    ] {
        text(
            canvas,
            (&short(value, range[1] - range[0]), FONT),
            [at, top + 62.0],
            HPos::Center,
        )?;
    }
    text(
        canvas,
        (quantity, FONT),
        [0.5 * (left + right), top + 104.0],
        HPos::Center,
    )
}

/// Four digits; what cannot be told from zero on a scale of this width is zero.
fn short(value: f64, width: f64) -> String {
    let size = value.abs();
    if size < 1e-4 * width {
        "0".to_owned()
    } else if size >= 100.0 {
        format!("{value:.1}")
    } else if size >= 0.01 || size <= 0.0 {
        format!("{value:.3}")
    } else {
        format!("{value:.2e}")
    }
}

/// A bar of one, two or five times a power of ten of a metre, at most 300 pixels long, at the right.
fn bar(canvas: &Canvas<'_>, scale: f64, top: f64) -> Result<(), Box<dyn Error>> {
    let most = 300.0 / scale;
    let power = 10.0_f64.powf(most.log10().floor());
    let factor = [5.0, 2.0].into_iter().find(|factor| factor * power <= most);
    let length = factor.unwrap_or(1.0) * power;
    let [right, height] = [WIDTH - 100.0, top + 25.0];
    let left = right - scale * length;
    let line = |points: [[f64; 2]; 2]| {
        let points = points.map(|[x, y]| (pixels(x), pixels(y)));
        PathElement::new(points.to_vec(), BLACK.stroke_width(3))
    };
    canvas.draw(&line([[left, height], [right, height]]))?;
    for end in [left, right] {
        canvas.draw(&line([[end, height - 10.0], [end, height + 10.0]]))?;
    }
    let middle = [0.5 * (left + right), top + 62.0];
    text(canvas, (&format!("{length} m"), FONT), middle, HPos::Center)
}

fn text(
    canvas: &Canvas<'_>,
    (text, size): (&str, f64),
    [x, y]: [f64; 2],
    across: HPos,
) -> Result<(), Box<dyn Error>> {
    // The SVG backend divides the size of a font by 1.24.
    let style = ("sans-serif", size * 1.24).into_font().color(&BLACK);
    let style = style.pos(Pos::new(across, VPos::Center));
    canvas.draw_text(text, &style, (pixels(x), pixels(y)))?;
    Ok(())
}

#[expect(clippy::cast_possible_truncation, reason = "a place in a picture")]
fn pixels(length: f64) -> i32 {
    length.round() as i32
}

#[expect(clippy::cast_precision_loss, reason = "small numbers of things")]
fn real(count: usize) -> f64 {
    count as f64
}
