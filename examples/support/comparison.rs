//! From recorded runs to pictures: the same quantity of all schemes in one figure.

use std::error::Error;
use std::path::Path;

use eem::Scheme;

use super::figures::{Curve, Figure};
use super::record::{Outcome, Record};
use super::statistics::{self, BREAKDOWN};

/// Relative energy defect from which on a run shows nothing but its own collapse.
const LOST: f64 = 0.05;

/// What one picture shows of every run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plot {
    /// Name of the file, without extension.
    pub(crate) file: &'static str,
    /// Title of the picture.
    pub(crate) title: &'static str,
    /// Quantity and unit of the horizontal axis.
    pub(crate) x_label: &'static str,
    /// Quantity and unit of the vertical axis.
    pub(crate) y_label: &'static str,
    /// The points of a run's curve.
    pub(crate) points: fn(&Record) -> Vec<(f64, f64)>,
    /// Whether a unit is as long on both axes, as in a map.
    pub(crate) is_map: bool,
}

/// The runs that are compared: the reference, drawn first, and a run per scheme.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Comparison<'a> {
    pub(crate) reference: &'a Record,
    pub(crate) runs: &'a [Record],
}

impl Comparison<'_> {
    /// Writes one SVG file per plot.
    pub(crate) fn write(&self, directory: &Path, plots: &[Plot]) -> Result<(), Box<dyn Error>> {
        for plot in plots {
            let path = directory.join(format!("{}.svg", plot.file));
            self.figure(plot).write_svg(&path)?;
        }
        Ok(())
    }

    fn figure(&self, plot: &Plot) -> Figure {
        let runs = self.runs.iter().map(|run| (look(&run.scheme), run));
        let curves = std::iter::once((0, self.reference)).chain(runs);
        Figure {
            title: plot.title.to_owned(),
            x_label: plot.x_label.to_owned(),
            y_label: plot.y_label.to_owned(),
            is_map: plot.is_map,
            curves: curves
                .map(|(look, run)| Curve {
                    label: label(run),
                    points: (plot.points)(run),
                    look,
                    trusted: is_sound(run),
                    decisive: lost(run).unwrap_or(usize::MAX),
                })
                .collect(),
        }
    }
}

/// A run that reached its end and kept its energy decides what the axes show.
fn is_sound(run: &Record) -> bool {
    run.completed() && statistics::first_energy_beyond(run, BREAKDOWN).is_none()
}

/// The row in which the energy is plainly wrong: what follows shall not decide the axes.
fn lost(run: &Record) -> Option<usize> {
    statistics::first_energy_beyond(run, LOST)
}

fn label(run: &Record) -> String {
    let scheme = &run.scheme;
    match (&run.outcome, lost(run)) {
        (Outcome::Failed { time, .. }, _) => format!("{scheme} (fails at {time:.1} s)"),
        (Outcome::Completed, Some(row)) => {
            format!("{scheme} (energy off by 5 % at {:.1} s)", run.time(row))
        }
        (Outcome::Completed, None) => scheme.clone(),
    }
}

/// A scheme looks the same in every picture, whatever else is drawn; 0 is the reference's look.
fn look(name: &str) -> usize {
    let mut schemes = Scheme::ALL.iter();
    let known = schemes.position(|scheme| scheme.name() == name);
    1 + known.unwrap_or(Scheme::ALL.len())
}
