//! Workspace of schemes with stages.

use crate::algebra::system::LinearSystem;
use crate::element::masses::Masses;
use crate::element::tableau::{MOST_STAGES, Tableau};
use eem_material::number::scalar::Real;

/// Workspace of a scheme with stages.
#[derive(Debug)]
pub(super) struct Stages<S, const D: usize> {
    pub(super) rule: &'static Tableau,
    /// The system of a stage whose displacements depend on its own force.
    pub(super) secant: Option<LinearSystem<S, D>>,
    /// `h` times (loads − forces of the elements), per node and stage, N s.
    pub(super) impulses: Vec<[[S; D]; MOST_STAGES]>,
    /// Displacements of all nodes at the end of the step, m.
    pub(super) ends: Vec<[S; D]>,
    /// The changes of the velocities of all nodes in the step, m/s; empty unless masses couple nodes.
    pub(super) changes: Vec<[S; D]>,
}

impl<S: Real, const D: usize> Stages<S, D> {
    /// Memory for a scene with these masses.
    pub(super) fn new(
        rule: &'static Tableau,
        secant: Option<LinearSystem<S, D>>,
        masses: &Masses<S>,
    ) -> Self {
        let nodes = masses.len();
        let coupled = if masses.are_coupled() { nodes } else { 0 };
        Self {
            rule,
            secant,
            impulses: vec![[[S::zero(); D]; MOST_STAGES]; nodes],
            ends: vec![[S::zero(); D]; nodes],
            changes: vec![[S::zero(); D]; coupled],
        }
    }

    /// `Σ_i weight_i impulse_i` on a node, N s.
    pub(super) fn combined(&self, node: usize, weights: &[f64]) -> [S; D] {
        let mut sum = [S::zero(); D];
        for (&weight, impulse) in weights.iter().zip(&self.impulses[node]) {
            for (sum, &impulse) in sum.iter_mut().zip(impulse) {
                *sum += S::from_f64(weight) * impulse;
            }
        }
        sum
    }
}
