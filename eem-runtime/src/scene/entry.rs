//! The nodes and elements of a scene.

use nalgebra::SVector;

use eem_material::number::scalar::Real;

/// A node: an anchor or a mass.
#[derive(Clone, Debug)]
pub(crate) struct NodeEntry<S, const D: usize> {
    /// `None` for an anchor.
    pub(crate) mass: Option<S>,
    /// The mass of solids at an anchor, kg.
    pub(crate) held: S,
    pub(crate) position: SVector<S, D>,
    pub(crate) velocity: SVector<S, D>,
    /// The initial momentum, if it is given instead of the velocity.
    pub(crate) momentum: Option<SVector<S, D>>,
}

impl<S: Real, const D: usize> NodeEntry<S, D> {
    /// The initial momentum of a node of this mass, kg m/s.
    pub(crate) fn start_momentum(&self, mass: S) -> SVector<S, D> {
        let from_velocity = || self.velocity.map(|velocity| mass * velocity);
        self.momentum.unwrap_or_else(from_velocity)
    }
}

/// The components of a vector that are not finite, with their axes.
pub(crate) fn infinite<S: Real>(vector: &[S]) -> impl Iterator<Item = (usize, f64)> {
    let components = vector.iter().enumerate();
    let infinite = components.filter(|(_, component)| !component.is_finite());
    infinite.map(|(axis, component)| (axis, component.to_f64()))
}

/// The group of the points of an invalid solid.
pub(crate) const INVALID: usize = usize::MAX;

/// An element without its model.
#[derive(Clone, Debug)]
pub(crate) struct ElementEntry<S> {
    pub(crate) nodes: Vec<usize>,
    pub(crate) temperature: Option<S>,
    /// `(dashpot, γ)` as given.
    pub(crate) viscous_stretches: Vec<(usize, S)>,
    /// The group of the model, or [`INVALID`] if an error is recorded, and the index there.
    pub(crate) group: usize,
    pub(crate) place: usize,
}
