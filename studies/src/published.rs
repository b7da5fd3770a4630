//! Published figures: which quantities of which schemes a figure of a paper shows.

use std::error::Error;
use std::path::Path;

use eem::Scheme;

use super::comparison::{self, Comparison};
use super::figures::{Axes, Curve, Figure};
use super::record::Record;
use super::statistics;

/// A curve of a run: its points (t, value).
type Points = fn(&Record) -> Vec<(f64, f64)>;

/// A figure of a paper, drawn from our runs.
#[derive(Clone, Copy, Debug)]
pub struct Published {
    /// Name of the file, without extension: paper, year, number, subject.
    pub file: &'static str,
    /// Title of the picture: paper, number, subject.
    pub title: &'static str,
    /// Quantity and unit of the vertical axis.
    pub y_label: &'static str,
    /// The schemes that the figure shows.
    pub schemes: &'static [Scheme],
    /// What it shows of each: symbol and points; one quantity needs no symbol.
    pub quantities: &'static [(&'static str, Points)],
    /// Against what.
    pub against: Against,
    /// How the axes are divided.
    pub axes: Axes,
}

/// What the reference does in a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Against {
    /// It is not shown.
    Nothing,
    /// It is drawn, too.
    Reference,
    /// It is subtracted.
    Deviation,
}

/// Writes one SVG file per figure that shows at least one of the runs.
pub fn write(
    comparison: Comparison<'_>,
    directory: &Path,
    figures: &[Published],
) -> Result<(), Box<dyn Error>> {
    for published in figures {
        let curves = published.curves(comparison);
        if curves.is_empty() {
            continue;
        }
        let figure = Figure {
            title: published.title.to_owned(),
            x_label: "time (s)".to_owned(),
            y_label: published.y_label.to_owned(),
            axes: published.axes,
            curves,
        };
        figure.write_svg(&directory.join(format!("{}.svg", published.file)))?;
    }
    Ok(())
}

impl Published {
    /// The curves; none when no run is of the figure's schemes.
    fn curves(&self, comparison: Comparison<'_>) -> Vec<Curve> {
        let Comparison {
            reference, runs, ..
        } = comparison;
        let shown = |run: &&Record| self.schemes.iter().any(|own| own.name() == run.scheme);
        let runs: Vec<&Record> = runs.iter().filter(shown).collect();
        if runs.is_empty() {
            return Vec::new();
        }
        let drawn = reference.filter(|_| self.against == Against::Reference);
        let mut curves: Vec<Curve> = drawn.into_iter().flat_map(|run| self.of(run, 0)).collect();
        for (place, run) in runs.iter().enumerate() {
            let mut own = self.of(run, place);
            if let Some(exact) = reference.filter(|_| self.against == Against::Deviation) {
                for (curve, (_, points)) in own.iter_mut().zip(self.quantities) {
                    curve.points = statistics::deviations(&curve.points, &points(exact));
                }
            }
            curves.extend(own);
        }
        curves
    }

    /// All quantities of a run, the `place`-th of its kind. The first has the scheme's look, a
    /// second one a look that no scheme has.
    fn of(&self, run: &Record, place: usize) -> Vec<Curve> {
        let looks = [
            comparison::look(&run.scheme),
            comparison::look_beside_schemes(place),
        ];
        let quantities = self.quantities.iter().zip(looks.into_iter().cycle());
        let curve = |(&(symbol, points), look): (&(&str, Points), usize)| {
            let curve = comparison::curve(run, points(run), look, self.axes);
            let label = format!("{} {symbol}", curve.label);
            Curve {
                label: label.trim_end().to_owned(),
                ..curve
            }
        };
        quantities.map(curve).collect()
    }
}
