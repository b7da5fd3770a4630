//! From recorded runs to pictures: the same quantity of all schemes in one figure.

use std::error::Error;
use std::path::Path;

use eem::Scheme;

use super::figures::{Axes, Curve, Figure};
use super::record::{Outcome, Record};
use super::statistics::{self, BREAKDOWN};

/// Defects on a logarithmic axis are drawn between a quarter of a rounding error, which stands for
/// none at all, and a value beyond which it does not matter how large they are.
const DRAWN_DEFECTS: [f64; 2] = [0.25 * f64::EPSILON, 100.0];

/// What one picture shows of every run.
#[derive(Clone, Copy, Debug)]
pub struct Plot {
    /// Name of the file, without extension.
    pub file: &'static str,
    /// Title of the picture.
    pub title: &'static str,
    /// Quantity and unit of the horizontal axis.
    pub x_label: &'static str,
    /// Quantity and unit of the vertical axis.
    pub y_label: &'static str,
    /// The points of a run's curve.
    pub points: fn(&Record) -> Vec<(f64, f64)>,
    /// How the axes are divided.
    pub axes: Axes,
}

impl Plot {
    /// A quantity over time.
    pub const fn history(
        file: &'static str,
        title: &'static str,
        y_label: &'static str,
        points: fn(&Record) -> Vec<(f64, f64)>,
    ) -> Self {
        Self {
            file,
            title,
            x_label: "time (s)",
            y_label,
            points,
            axes: Axes::Even,
        }
    }

    /// A relative defect over time, by powers of ten.
    pub const fn defect(
        file: &'static str,
        title: &'static str,
        y_label: &'static str,
        points: fn(&Record) -> Vec<(f64, f64)>,
    ) -> Self {
        Self {
            axes: Axes::Logarithmic,
            ..Self::history(file, title, y_label, points)
        }
    }
}

/// The curve of a run through `points`, clamped where only powers of ten are drawn.
pub fn curve(run: &Record, mut points: Vec<(f64, f64)>, look: usize, axes: Axes) -> Curve {
    let is_logarithmic = axes == Axes::Logarithmic;
    if let Some(row) = lost(run).filter(|_| !is_logarithmic) {
        // What follows shows nothing but the collapse of the run, and would be streaks over all else.
        points.retain(|&(x, _)| axes == Axes::Map || x <= run.time(row));
        points.truncate(row + 1);
    }
    if is_logarithmic {
        let [least, most] = DRAWN_DEFECTS;
        for (_, defect) in &mut points {
            *defect = defect.clamp(least, most);
        }
    }
    Curve {
        label: label(run, is_logarithmic),
        points,
        look,
        trusted: is_logarithmic || is_sound(run),
        decisive: lost(run).filter(|_| !is_logarithmic).unwrap_or(usize::MAX),
    }
}

/// The runs that are compared: the reference, drawn first if there is one, and a run per scheme.
#[derive(Clone, Copy, Debug)]
pub struct Comparison<'a> {
    /// The case, which stands before the titles; nothing where there is one only.
    pub case: &'a str,
    /// What the runs are compared with.
    pub reference: Option<&'a Record>,
    /// One per scheme.
    pub runs: &'a [Record],
}

impl Comparison<'_> {
    /// Writes one SVG file per plot.
    pub fn write(&self, directory: &Path, plots: &[Plot]) -> Result<(), Box<dyn Error>> {
        for plot in plots {
            let path = directory.join(format!("{}.svg", plot.file));
            self.figure(plot).write_svg(&path)?;
        }
        Ok(())
    }

    fn figure(&self, plot: &Plot) -> Figure {
        let runs = self.runs.iter().map(|run| (look(&run.scheme), run));
        let curves = self.reference.into_iter().map(|run| (0, run)).chain(runs);
        Figure {
            title: titled(self.case, plot.title),
            x_label: plot.x_label.to_owned(),
            y_label: plot.y_label.to_owned(),
            axes: plot.axes,
            curves: curves
                .map(|(look, run)| curve(run, (plot.points)(run), look, plot.axes))
                .collect(),
        }
    }
}

/// A curve per scheme over time, without a reference.
pub fn over_time(
    title: &str,
    y_label: &str,
    runs: &[Record],
    points: impl Fn(&Record) -> Vec<(f64, f64)>,
) -> Figure {
    let curve = |run: &Record| Curve {
        label: label(run, true),
        points: points(run),
        look: look(&run.scheme),
        trusted: run.completed(),
        decisive: usize::MAX,
    };
    Figure {
        title: title.to_owned(),
        x_label: "time (s)".to_owned(),
        y_label: y_label.to_owned(),
        curves: runs.iter().map(curve).collect(),
        axes: Axes::Even,
    }
}

/// What hardly depends on the scheme: the curve of the first one, and below it what the others differ by.
pub fn with_differences(
    title: &str,
    y_label: &str,
    runs: &[Record],
    points: impl Fn(&Record) -> Vec<(f64, f64)>,
) -> Vec<Figure> {
    let mut quantity = over_time(title, y_label, runs, &points);
    let Some((first, others)) = runs.split_first().filter(|(_, others)| !others.is_empty()) else {
        return vec![quantity];
    };
    quantity.curves.truncate(1);
    let exact = points(first);
    let title = format!("The same of each scheme minus that of {}", first.scheme);
    let differences = over_time(&title, &format!("difference of {y_label}"), others, |run| {
        statistics::deviations(&points(run), &exact)
    });
    vec![quantity, differences]
}

/// A title with its case.
pub fn titled(case: &str, title: &str) -> String {
    if case.is_empty() {
        title.to_owned()
    } else {
        format!("{case}: {title}")
    }
}

/// A run that reached its end and kept its energy decides what the axes show.
fn is_sound(run: &Record) -> bool {
    run.completed() && lost(run).is_none()
}

/// The row in which the energy is plainly wrong: what follows is not drawn.
fn lost(run: &Record) -> Option<usize> {
    statistics::first_energy_beyond(run, BREAKDOWN)
}

/// The scheme, and what went wrong unless the curve `shows_it`.
fn label(run: &Record, shows_it: bool) -> String {
    let scheme = &run.scheme;
    match (&run.outcome, lost(run).filter(|_| !shows_it)) {
        (Outcome::Failed { time, .. }, _) => format!("{scheme} (fails at {time:.1} s)"),
        (Outcome::Completed, Some(row)) => {
            format!("{scheme} (energy off at {:.1} s)", run.time(row))
        }
        (Outcome::Completed, None) => scheme.clone(),
    }
}

/// A scheme looks the same in every picture, whatever else is drawn; 0 is the reference's look.
pub fn look(name: &str) -> usize {
    let mut schemes = Scheme::ALL.into_iter().chain([Scheme::Auto]);
    let known = schemes.position(|scheme| scheme.name() == name);
    known.map_or(0, |scheme| 1 + scheme)
}

/// The `index`-th look that neither a scheme nor the reference has.
pub fn look_beside_schemes(index: usize) -> usize {
    2 + Scheme::ALL.len() + index
}
