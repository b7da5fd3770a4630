//! The loads of one step: forces, moved anchors, prescribed temperatures.

use crate::element::handle::Node;
use eem_material::number::scalar::Real;

/// A prescribed temperature during one step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Prescribed<S> {
    /// In the middle of the step, K.
    pub(crate) middle: S,
    /// At its end, K.
    pub(crate) end: S,
}

/// The node that a rocket pushes, and the ends of the line along which it does.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PushLine {
    pub(crate) node: Node,
    pub(crate) tail: Node,
    pub(crate) head: Node,
}

/// A rocket during one step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Push<S> {
    pub(crate) line: PushLine,
    /// In the middle of the step, N.
    pub(crate) thrust: S,
}

/// The loads of one step. Kinds of loads that the scene does not have take no memory.
#[derive(Clone, Debug)]
pub(crate) struct StepLoads<S> {
    /// Loads that do work, per coordinate, N.
    pub(crate) force: Vec<S>,
    /// Loads and weight, per coordinate, N.
    pub(crate) total_force: Vec<S>,
    pub(crate) pushes: Vec<Push<S>>,
    /// Displacements of moved anchors, per coordinate, m.
    pub(crate) motion: Vec<S>,
    /// Their velocities at the end of the step, per coordinate, m/s; only where masses couple nodes.
    pub(crate) speeds: Vec<S>,
    /// The nodes that are moved.
    pub(crate) moved: Vec<usize>,
    /// Per thermal slot.
    pub(crate) prescribed: Vec<Option<Prescribed<S>>>,
    /// The thermal slots of the elements whose temperatures are prescribed, in the order of the loads.
    pub(crate) slots: Vec<Option<usize>>,
}

impl<S: Real> StepLoads<S> {
    /// Whether there are loads that do work on nodes.
    pub(crate) fn has_force(&self) -> bool {
        !self.force.is_empty()
    }

    /// Whether there are loads or weights.
    pub(crate) fn has_total_force(&self) -> bool {
        !self.total_force.is_empty()
    }

    /// The load on a node that does work, N.
    #[inline]
    pub(crate) fn force<const D: usize>(&self, node: usize) -> [S; D] {
        point(&self.force, node)
    }

    /// Load and weight of a node, N.
    #[inline]
    pub(crate) fn total_force<const D: usize>(&self, node: usize) -> [S; D] {
        point(&self.total_force, node)
    }

    /// The displacement of a moved anchor, m.
    #[inline]
    pub(crate) fn motion<const D: usize>(&self, node: usize) -> [S; D] {
        point(&self.motion, node)
    }

    /// The velocity of a moved anchor at the end of the step, where masses couple nodes, m/s.
    #[inline]
    pub(crate) fn speed<const D: usize>(&self, node: usize) -> [S; D] {
        point(&self.speeds, node)
    }

    /// The temperature prescribed on a thermal slot.
    #[inline]
    pub(crate) fn prescribed(&self, slot: usize) -> Option<Prescribed<S>> {
        self.prescribed.get(slot).copied().flatten()
    }
}

/// The coordinates of a node; zero if none are stored.
#[inline]
pub(crate) fn point<S: Real, const D: usize>(coordinates: &[S], node: usize) -> [S; D] {
    let points = coordinates.as_chunks::<D>().0;
    points.get(node).copied().unwrap_or([S::zero(); D])
}
