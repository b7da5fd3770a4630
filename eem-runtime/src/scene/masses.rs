//! The masses of a scene, of nodes and of what they have in common.

use super::Scene;
use crate::element::masses::Masses;
use eem_material::number::scalar::Real;

impl<const D: usize, S: Real> Scene<D, S> {
    /// The mass matrix. Anchors keep the masses that they have as nodes of solids.
    pub(crate) fn masses(&self) -> Masses<S> {
        let mut pairs = self.pairs.clone();
        let mut is_of_solid = vec![false; self.nodes.len()];
        for &(nodes, _) in &self.pairs {
            for node in nodes {
                is_of_solid[node] = true;
            }
        }
        for (index, node) in self.nodes.iter().enumerate() {
            if node.mass.is_none() && is_of_solid[index] {
                pairs.push(([index; 2], node.held));
            }
        }
        Masses::new(self.nodes.iter().map(|node| node.mass), pairs)
    }
}
