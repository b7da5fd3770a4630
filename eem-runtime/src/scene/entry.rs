//! The nodes and elements of a scene.

use crate::element::layout::{Layout, Shape};
use crate::element::masses::Masses;

/// A node: an anchor or a mass.
#[derive(Clone, Debug)]
pub(crate) struct NodeEntry {
    /// `None` for an anchor.
    pub(crate) mass: Option<f64>,
    /// The mass of solids at an anchor, kg.
    pub(crate) held: f64,
    /// The initial momentum, if it is given instead of the velocity.
    pub(crate) momentum: Option<Box<[f64]>>,
}

/// The components of a vector that are not finite, with their axes.
pub(crate) fn infinite(vector: &[f64]) -> impl Iterator<Item = (usize, f64)> {
    let components = vector.iter().copied().enumerate();
    components.filter(|(_, component)| !component.is_finite())
}

/// The group of the points of an invalid solid.
pub(crate) const INVALID: usize = usize::MAX;

/// An element without its model.
#[derive(Clone, Debug)]
pub(crate) struct ElementEntry {
    pub(crate) nodes: Vec<usize>,
    pub(crate) temperature: Option<f64>,
    /// `(dashpot, γ)` as given.
    pub(crate) viscous_stretches: Vec<(usize, f64)>,
    /// The group of the model, or [`INVALID`] if an error is recorded, and the index there.
    pub(crate) group: usize,
    pub(crate) place: usize,
}

/// The numbering of a scene of this dimension without interface temperatures, given the places of its elements and the
/// capabilities of each group.
pub(crate) fn layout(
    dimension: usize,
    masses: &Masses,
    (places, shapes): (&[[u32; 2]], &[Shape]),
) -> Layout {
    let is_mass = masses.iter().map(|mass| mass.is_some());
    let shapes = places.iter().map(|&[group, _]| shapes[group as usize]);
    Layout::new(dimension, is_mass, shapes)
}
