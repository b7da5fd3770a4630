//! The loads of one step: forces, moved anchors, prescribed temperatures.

use crate::element::handle::Node;

/// A prescribed temperature during one step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Prescribed {
    /// In the middle of the step, K.
    pub(crate) middle: f64,
    /// At its end, K.
    pub(crate) end: f64,
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
pub(crate) struct Push {
    pub(crate) line: PushLine,
    /// In the middle of the step, N.
    pub(crate) thrust: f64,
}

/// The loads of one step. Kinds of loads that the scene does not have take no memory.
#[derive(Clone, Debug)]
pub(crate) struct StepLoads {
    /// Loads that do work, per coordinate, N.
    pub(crate) force: Vec<f64>,
    /// Loads and weight, per coordinate, N.
    pub(crate) total_force: Vec<f64>,
    pub(crate) pushes: Vec<Push>,
    /// Displacements of moved anchors, per coordinate, m.
    pub(crate) motion: Vec<f64>,
    /// Their velocities at the end of the step, per coordinate, m/s; only where masses couple nodes.
    pub(crate) speeds: Vec<f64>,
    /// The nodes that are moved.
    pub(crate) moved: Vec<usize>,
    /// Per thermal slot.
    pub(crate) prescribed: Vec<Option<Prescribed>>,
    /// Memory for the value of one load.
    pub(crate) value: Vec<f64>,
    /// The thermal slots of the elements whose temperatures are prescribed, in the order of the loads.
    pub(crate) slots: Vec<Option<usize>>,
}

impl StepLoads {
    /// Whether there are loads that do work on nodes.
    #[inline]
    pub(crate) fn has_force(&self) -> bool {
        !self.force.is_empty()
    }

    /// Whether there are loads or weights.
    #[inline]
    pub(crate) fn has_total_force(&self) -> bool {
        !self.total_force.is_empty()
    }

    /// The load on a node that does work, N.
    #[inline]
    pub(crate) fn force<const D: usize>(&self, node: usize) -> [f64; D] {
        point(&self.force, node)
    }

    /// Load and weight of a node, N.
    #[inline]
    pub(crate) fn total_force<const D: usize>(&self, node: usize) -> [f64; D] {
        point(&self.total_force, node)
    }

    /// The displacement of a moved anchor, m.
    #[inline]
    pub(crate) fn motion<const D: usize>(&self, node: usize) -> [f64; D] {
        point(&self.motion, node)
    }

    /// The velocity of a moved anchor at the end of the step, where masses couple nodes, m/s.
    #[inline]
    pub(crate) fn speed<const D: usize>(&self, node: usize) -> [f64; D] {
        point(&self.speeds, node)
    }

    /// The temperature prescribed on a thermal slot.
    #[inline]
    pub(crate) fn prescribed(&self, slot: usize) -> Option<Prescribed> {
        self.prescribed.get(slot).copied().flatten()
    }
}

/// The coordinates of a node; zero if none are stored.
#[inline]
pub(crate) fn point<const D: usize>(coordinates: &[f64], node: usize) -> [f64; D] {
    let points = coordinates.as_chunks::<D>().0;
    points.get(node).copied().unwrap_or([0.0; D])
}
