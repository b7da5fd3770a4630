//! The drawing itself: title, legend, axes with grid, and the clipped curves.

use std::error::Error;
use std::path::Path;

use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axis::{Axis, Scale};
use super::clip::Window;
use super::look::{Dash, Look};
use super::{Axes, Curve, Figure, legend, range};

/// Size of a picture in pixels, and of one with equal scales; a reader scales them.
const SIZE: [i32; 2] = [1600, 1000];
const MAP_SIZE: [i32; 2] = [1300, 1300];

/// Rows of the labels below curves, and the height of each in pixels.
const NAME_ROWS: i32 = 3;
const NAME_ROW: i32 = 30;

/// Height in pixels of each of several pictures one below the other.
const STACKED: i32 = 700;

/// Fonts in pixels.
const TITLE_FONT: f64 = 40.0;
const AXIS_FONT: f64 = 32.0;
const TICK_FONT: f64 = 26.0;

/// Space around the chart in pixels: title above, axis labels below and on the left, and the
/// distance of these from the picture's edge.
const TITLE_HEIGHT: i32 = 70;
const EDGE: i32 = 24;
const LEFT: i32 = 150;
const BOTTOM: i32 = 90;
const RIGHT: i32 = 50;

/// Markers of one curve; a curve with more points carries them on every n-th only.
const MOST_MARKERS: usize = 34;

type Canvas<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Axis, Axis>>;

/// Draws figures one below the other into the file `path`.
pub(super) fn draw(figures: &[Figure], path: &Path) -> Result<(), Box<dyn Error>> {
    let [width, height] = match figures {
        [figure] if figure.axes == Axes::Map => MAP_SIZE,
        [_] => SIZE,
        _ => [SIZE[0], STACKED],
    };
    let size = (width.unsigned_abs(), height.unsigned_abs());
    let whole = (size.0, size.1 * u32::try_from(figures.len())?);
    let canvas = SVGBackend::new(path, whole).into_drawing_area();
    canvas.fill(&WHITE)?;
    let parts = canvas.split_evenly((figures.len(), 1));
    for (figure, part) in figures.iter().zip(parts) {
        draw_figure(figure, &part, [width, height])?;
    }
    canvas.present()?;
    Ok(())
}

fn draw_figure(
    figure: &Figure,
    canvas: &Canvas<'_>,
    [width, height]: [i32; 2],
) -> Result<(), Box<dyn Error>> {
    let is_map = figure.axes == Axes::Map;
    let is_named = matches!(figure.axes, Axes::Named | Axes::NamedLogarithmic);
    let title = font(title_font(&figure.title, width)).pos(Pos::new(HPos::Center, VPos::Center));
    canvas.draw_text(&figure.title, &title, (width / 2, TITLE_HEIGHT / 2))?;
    let top = if is_named {
        TITLE_HEIGHT
    } else {
        TITLE_HEIGHT + draw_legend(canvas, &figure.curves, [width, height])?
    };
    let bottom = BOTTOM + i32::from(is_named) * (NAME_ROWS - 1) * NAME_ROW;
    let aspect = f64::from(width - EDGE - LEFT - RIGHT) / f64::from(height - top - bottom - EDGE);
    let scales = Scale::of(figure.axes);
    let curves = placed(&figure.curves, scales);
    let mut window = window(&curves, is_map.then_some(aspect));
    if scales[1] == Scale::Logarithmic {
        // A decade has three numbers at least.
        window.y = range::widened(&window.y, 1.0);
    }
    if is_named {
        window.x = 0.5..0.5 + curves.iter().map(|_| 1.0).sum::<f64>();
    }
    let mut chart = ChartBuilder::on(canvas)
        .margin_top(top)
        .margin_right(RIGHT)
        .margin_bottom(EDGE)
        .margin_left(EDGE)
        .x_label_area_size(bottom)
        .y_label_area_size(LEFT)
        .build_cartesian_2d(
            Axis::new(scales[0], window.x.clone()),
            Axis::new(scales[1], window.y.clone()),
        )?;
    draw_axes(&mut chart, figure, is_named)?;
    for curve in &curves {
        draw_curve(&mut chart, curve, look_among(&curves, curve), &window)?;
    }
    if is_named {
        draw_names(&chart, canvas, &curves)?;
    }
    Ok(())
}

/// The curves with the places of their points along the axes.
fn placed(curves: &[Curve], [x, y]: [Scale; 2]) -> Vec<Curve> {
    let place = |point: &(f64, f64)| (x.place(point.0), y.place(point.1));
    let placed = |curve: &Curve| Curve {
        points: curve.points.iter().map(place).collect(),
        ..curve.clone()
    };
    curves.iter().map(placed).collect()
}

/// The axes' ranges; with equal scales for a plotting area `map` times as wide as high.
fn window(curves: &[Curve], map: Option<f64>) -> Window {
    let along = |coordinate: fn(&(f64, f64)) -> f64| {
        let values = |curve: &Curve| {
            let decisive = curve.points.iter().take(curve.decisive);
            decisive.map(coordinate).collect::<Vec<_>>()
        };
        let (trusted, others): (Vec<_>, Vec<_>) = curves.iter().partition(|c| c.trusted);
        let trusted: Vec<f64> = trusted.into_iter().flat_map(values).collect();
        let others: Vec<Vec<f64>> = others.into_iter().map(values).collect();
        range::axis(&trusted, &others)
    };
    let (x, y) = (along(|point| point.0), along(|point| point.1));
    let (x, y) = match map {
        Some(aspect) => range::equal_scales(&x, &y, aspect),
        None => (x, y),
    };
    Window { x, y }
}

fn draw_axes(
    chart: &mut Chart<'_, '_>,
    figure: &Figure,
    is_named: bool,
) -> Result<(), Box<dyn Error>> {
    let mut mesh = chart.configure_mesh();
    if is_named {
        mesh.disable_x_mesh().disable_x_axis();
    }
    mesh.light_line_style(TRANSPARENT)
        .bold_line_style(RGBColor(210, 210, 210).stroke_width(1))
        .axis_style(BLACK.stroke_width(2))
        .x_labels(11)
        .y_labels(9)
        .label_style(font(TICK_FONT))
        .axis_desc_style(font(AXIS_FONT))
        .x_desc(&figure.x_label)
        .y_desc(&figure.y_label)
        .draw()?;
    Ok(())
}

/// The labels of curves below them, as large as fits; each is a row lower than the one before, up to the last row.
fn draw_names(
    chart: &Chart<'_, '_>,
    canvas: &Canvas<'_>,
    curves: &[Curve],
) -> Result<(), Box<dyn Error>> {
    let (across, down) = chart.plotting_area().get_pixel_range();
    let origin = canvas.get_pixel_range();
    let count = i32::try_from(curves.len())?.max(1);
    let room = NAME_ROWS * (across.end - across.start) / count;
    let longest = curves.iter().map(|curve| curve.label.chars().count()).max();
    let width = legend::text_width(i32::try_from(longest.unwrap_or(0))?, 100).max(1);
    let size = TICK_FONT.min(100.0 * f64::from(room) / f64::from(width));
    let style = font(size).pos(Pos::new(HPos::Center, VPos::Center));
    for (index, curve) in (0..).zip(curves) {
        let x = across.start + (2 * index + 1) * (across.end - across.start) / (2 * count);
        let y = down.end + NAME_ROW * (index % NAME_ROWS) + NAME_ROW * 3 / 4;
        let place = (x - origin.0.start, y - origin.1.start);
        canvas.draw_text(&curve.label, &style, place)?;
    }
    Ok(())
}

/// A curve's look; alone it needs neither dash nor marker to be told from others.
fn look_among(curves: &[Curve], curve: &Curve) -> Look {
    let look = Look::of(curve.look);
    if curves.len() == 1 {
        look.plain()
    } else {
        look
    }
}

fn draw_curve(
    chart: &mut Chart<'_, '_>,
    curve: &Curve,
    look: Look,
    window: &Window,
) -> Result<(), Box<dyn Error>> {
    let style = look.colour.stroke_width(look.width);
    for part in window.clip(&curve.points) {
        let part = part.into_iter();
        match look.dash {
            Dash::Solid => chart
                .plotting_area()
                .draw(&PathElement::new(part.collect::<Vec<_>>(), style))?,
            Dash::Dashed { length, gap } => chart
                .plotting_area()
                .draw(&DashedPathElement::new(part, length, gap, style))?,
            Dash::None | Dash::Filled => {}
        }
    }
    if look.dash == Dash::Filled {
        let area = Polygon::new(curve.points.clone(), look.colour.filled());
        chart.plotting_area().draw(&area)?;
        return Ok(());
    }
    // Without a line markers are all that there is.
    let every = match look.dash {
        Dash::None => 1,
        Dash::Solid | Dash::Dashed { .. } | Dash::Filled => {
            curve.points.len().div_ceil(MOST_MARKERS).max(1)
        }
    };
    let marked = curve.points.iter().step_by(every);
    for &point in marked.filter(|&&point| window.contains(point)) {
        draw_marker(chart.plotting_area(), point, look)?;
    }
    Ok(())
}

/// Draws the legend below the title and returns its height in pixels.
fn draw_legend(
    canvas: &Canvas<'_>,
    curves: &[Curve],
    picture: [i32; 2],
) -> Result<i32, Box<dyn Error>> {
    let named = || curves.iter().filter(|curve| !curve.label.is_empty());
    let labels: Vec<&str> = named().map(|curve| curve.label.as_str()).collect();
    let (size, places) = legend::layout(&labels, picture);
    let text = font(f64::from(size.font)).pos(Pos::new(HPos::Left, VPos::Center));
    for (curve, &(x, y)) in named().zip(&places) {
        let look = look_among(curves, curve);
        let style = look.colour.stroke_width(look.width);
        let middle = TITLE_HEIGHT + y + size.row / 2;
        let end = x + size.sample;
        let sample = [(x, middle), (end, middle)];
        match look.dash {
            Dash::Solid => canvas.draw(&PathElement::new(sample, style))?,
            Dash::Dashed { length, gap } => {
                canvas.draw(&DashedPathElement::new(sample, length, gap, style))?;
            }
            Dash::Filled => {
                let corners = [(x, middle - 12), (end, middle + 12)];
                canvas.draw(&Rectangle::new(corners, look.colour.filled()))?;
            }
            Dash::None => {}
        }
        draw_marker(canvas, (x + size.sample / 2, middle), look)?;
        canvas.draw_text(&curve.label, &text, (end + size.gap, middle))?;
    }
    Ok(places.last().map_or(0, |&(_, y)| y + size.row))
}

/// Draws a marker at a point of the chart or of the canvas.
fn draw_marker<C>(
    area: &DrawingArea<SVGBackend<'_>, C>,
    at: C::From,
    look: Look,
) -> Result<(), Box<dyn Error>>
where
    C: CoordTranslate,
    C::From: Copy,
{
    for stroke in look.marker.strokes() {
        let path = PathElement::new(*stroke, look.colour.stroke_width(look.width));
        area.draw(&(EmptyElement::at(at) + path))?;
    }
    Ok(())
}

/// The font of the title: smaller where it would be wider than the picture.
fn title_font(title: &str, width: i32) -> f64 {
    let characters = i32::try_from(title.chars().count()).unwrap_or(i32::from(i16::MAX));
    let usual = f64::from(legend::text_width(characters, 100)) * TITLE_FONT / 100.0;
    let room = f64::from(width - 2 * EDGE);
    TITLE_FONT * (room / usual.max(room))
}

/// A font whose size in the picture is `pixels`: the SVG backend divides the size by 1.24.
fn font(pixels: f64) -> TextStyle<'static> {
    const BACKEND_SHRINKS_BY: f64 = 1.24;
    ("sans-serif", pixels * BACKEND_SHRINKS_BY)
        .into_font()
        .color(&BLACK)
}
