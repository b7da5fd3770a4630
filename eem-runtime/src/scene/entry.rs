//! What a scene knows of its nodes and elements.

use nalgebra::SVector;

use crate::element::group::NodesOf;
use crate::element::handle::Element;
use eem_material::number::scalar::Real;

/// A node: an anchor or a mass.
#[derive(Clone, Debug)]
pub(crate) struct NodeEntry<S, const D: usize> {
    /// `None` for an anchor.
    pub(crate) mass: Option<S>,
    /// What solids have at an anchor, kg.
    pub(crate) held: S,
    pub(crate) position: SVector<S, D>,
    pub(crate) velocity: SVector<S, D>,
    /// Given instead of the velocity.
    pub(crate) momentum: Option<SVector<S, D>>,
}

impl<S: Real, const D: usize> NodeEntry<S, D> {
    /// The initial momentum of a node of this mass, kg m/s.
    pub(crate) fn start_momentum(&self, mass: S) -> SVector<S, D> {
        let from_velocity = || self.velocity.map(|velocity| mass * velocity);
        self.momentum.unwrap_or_else(from_velocity)
    }
}

/// No group.
pub(crate) const UNMADE: usize = usize::MAX;

/// What the scene knows of an element apart from its model.
#[derive(Clone, Debug)]
pub(crate) struct ElementEntry<S> {
    pub(crate) nodes: Vec<usize>,
    pub(crate) temperature: Option<S>,
    /// `(dashpot, γ)` as given.
    pub(crate) viscous_stretches: Vec<(usize, S)>,
    /// The group that holds the model, and its place there; [`UNMADE`] for points of a solid that could not be made,
    /// which has been noted.
    pub(crate) group: usize,
    pub(crate) place: usize,
}

impl<S: core::fmt::Debug> NodesOf for Vec<ElementEntry<S>> {
    fn nodes_of(&self, element: Element) -> &[usize] {
        &self[element.index()].nodes
    }
}
