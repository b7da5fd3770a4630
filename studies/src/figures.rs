//! Line charts as SVG: several curves in one picture, told apart by colour, dash and marker.
//!
//! A run that blows up does not destroy the picture: the axes follow the trusted curves, the
//! others may widen them within reason and are clipped beyond.

mod axis;
mod chart;
mod clip;
mod legend;
pub mod look;
mod range;
mod ticks;

use std::error::Error;
use std::path::Path;

/// One picture.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Title above the picture.
    pub title: String,
    /// Quantity and unit of the horizontal axis, for example `time (s)`.
    pub x_label: String,
    /// Quantity and unit of the vertical axis.
    pub y_label: String,
    /// The curves, drawn in this order: later ones lie on top.
    pub curves: Vec<Curve>,
    /// How the axes are divided.
    pub axes: Axes,
}

/// How the axes of a picture are divided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axes {
    /// Both evenly.
    Even,
    /// Both evenly, and a unit is as long on both, as in a map: for trajectories.
    Map,
    /// The vertical axis by powers of ten: for errors over time.
    Logarithmic,
    /// Both by powers of ten: for errors over step sizes.
    DoublyLogarithmic,
    /// The horizontal axis by powers of ten: for results over the size of meshes.
    LogarithmicAcross,
    /// The horizontal one by whole numbers: for what is counted.
    Counted,
    /// Each curve lies about its number, counted from 1, and has its label below; there is no legend.
    Named,
    /// The same, and the vertical axis by powers of ten.
    NamedLogarithmic,
}

/// One curve of a picture.
#[derive(Clone, Debug)]
pub struct Curve {
    /// What the legend says; a curve without a label is not in it.
    pub label: String,
    /// The points in the order in which they are joined.
    pub points: Vec<(f64, f64)>,
    /// Which colour, dash and marker it has: the same index looks the same in every picture.
    pub look: usize,
    /// Whether the axes must show the curve as a whole.
    pub trusted: bool,
    /// How many of the first points have a say in the axes' ranges.
    pub decisive: usize,
}

impl Figure {
    /// With its axes divided otherwise.
    #[must_use]
    pub fn with(self, axes: Axes) -> Self {
        Self { axes, ..self }
    }

    /// Draws the picture into the SVG file `path`.
    pub fn write_svg(&self, path: &Path) -> Result<(), Box<dyn Error>> {
        write_stack(std::slice::from_ref(self), path)
    }
}

/// Draws pictures one below the other into the SVG file `path`.
pub fn write_stack(figures: &[Figure], path: &Path) -> Result<(), Box<dyn Error>> {
    chart::draw(figures, path).map_err(|error| format!("{}: {error}", path.display()).into())
}
