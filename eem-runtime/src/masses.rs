//! The masses of the nodes, of which anchors have none.

use crate::scalar::{Mask, Real};

/// A mass per node, kg. That of an anchor is stored as zero, which no other node has.
#[derive(Clone, Debug)]
pub(crate) struct Masses<S>(Vec<S>);

impl<S: Real> Masses<S> {
    /// The masses of some nodes; `None` for anchors.
    pub(crate) fn new(masses: impl Iterator<Item = Option<S>>) -> Self {
        let mut masses: Vec<_> = masses.map(|mass| mass.unwrap_or(S::zero())).collect();
        masses.shrink_to_fit();
        Self(masses)
    }

    /// Number of nodes.
    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// The mass of a node; `None` for an anchor.
    #[inline]
    pub(crate) fn get(&self, node: usize) -> Option<S> {
        let mass = self.0[node];
        (!mass.equal(S::zero()).all()).then_some(mass)
    }

    /// The masses of all nodes.
    pub(crate) fn iter(&self) -> impl Iterator<Item = Option<S>> + Clone + '_ {
        (0..self.len()).map(|node| self.get(node))
    }

    /// The nodes that are anchors.
    pub(crate) fn anchors(&self) -> impl Iterator<Item = usize> + '_ {
        let nodes = self.iter().enumerate();
        nodes
            .filter(|(_, mass)| mass.is_none())
            .map(|(node, _)| node)
    }
}
