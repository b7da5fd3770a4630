//! Line charts as SVG: several curves in one picture, told apart by colour, dash and marker.
//!
//! A run that blows up does not destroy the picture: the axes follow the trusted curves, the
//! others may widen them within reason and are clipped beyond.

mod axis;
mod chart;
mod clip;
mod legend;
pub(crate) mod look;
mod range;
mod ticks;

use std::error::Error;
use std::path::Path;

/// One picture.
#[derive(Clone, Debug)]
pub(crate) struct Figure {
    /// Title above the picture.
    pub(crate) title: String,
    /// Quantity and unit of the horizontal axis, for example `time (s)`.
    pub(crate) x_label: String,
    /// Quantity and unit of the vertical axis.
    pub(crate) y_label: String,
    /// The curves, drawn in this order: later ones lie on top.
    pub(crate) curves: Vec<Curve>,
    /// How the axes are divided.
    pub(crate) axes: Axes,
}

/// How the axes of a picture are divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Axes {
    /// Both evenly.
    Even,
    /// Both evenly, and a unit is as long on both, as in a map: for trajectories.
    Map,
    /// The vertical axis by powers of ten: for errors over time.
    Logarithmic,
    /// Both by powers of ten: for errors over step sizes.
    DoublyLogarithmic,
}

/// One curve of a picture.
#[derive(Clone, Debug)]
pub(crate) struct Curve {
    /// What the legend says; a curve without a label is not in it.
    pub(crate) label: String,
    /// The points in the order in which they are joined.
    pub(crate) points: Vec<(f64, f64)>,
    /// Which colour, dash and marker it has: the same index looks the same in every picture.
    pub(crate) look: usize,
    /// Whether the axes must show the curve as a whole.
    pub(crate) trusted: bool,
    /// How many of the first points have a say in the axes' ranges.
    pub(crate) decisive: usize,
}

impl Figure {
    /// Draws the picture into the SVG file `path`.
    pub(crate) fn write_svg(&self, path: &Path) -> Result<(), Box<dyn Error>> {
        chart::draw(self, path).map_err(|error| format!("{}: {error}", path.display()).into())
    }
}
