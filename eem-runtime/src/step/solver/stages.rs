//! Workspace of schemes with stages.

use crate::algebra::combined;
use crate::algebra::system::LinearSystem;
use crate::element::masses::Masses;
use crate::element::tableau::{MOST_STAGES, Tableau};

/// Workspace of a scheme with stages.
#[derive(Debug)]
pub(super) struct Stages<const D: usize> {
    pub(super) rule: &'static Tableau,
    /// The system of a stage whose displacements depend on its own force.
    pub(super) secant: Option<LinearSystem<D>>,
    /// `h` times (loads − forces of the elements), per node and stage, N s.
    pub(super) impulses: Vec<[[f64; D]; MOST_STAGES]>,
    /// The changes of the velocities of all nodes in the step, m/s; empty unless masses couple nodes.
    pub(super) changes: Vec<[f64; D]>,
}

impl<const D: usize> Stages<D> {
    /// Memory for a scene with these masses.
    pub(super) fn new(
        rule: &'static Tableau,
        secant: Option<LinearSystem<D>>,
        masses: &Masses,
    ) -> Self {
        let nodes = masses.len();
        let coupled = if masses.are_coupled() { nodes } else { 0 };
        Self {
            rule,
            secant,
            impulses: vec![[[0.0; D]; MOST_STAGES]; nodes],
            changes: vec![[0.0; D]; coupled],
        }
    }

    /// `Σ_i weight_i impulse_i` on a node, N s.
    pub(super) fn combined(&self, node: usize, weights: &[f64]) -> [f64; D] {
        combined(weights, self.impulses[node])
    }
}
