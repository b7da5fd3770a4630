//! The ways of the nodes of an element in a step. Rounding of the sums of forces at nodes does work along them, and of the
//! ends of paths.

use core::array;

use super::view::{StepView, Trial};
use crate::element::tableau::{Ending, MOST_STAGES, Tableau};
use eem_material::number::scalar::Real;

/// `Σ |Δq|` of the components of nodes, m.
#[cold]
pub(super) fn way_of_nodes<S: Real, const D: usize>(nodes: &[u32], trial: &Trial<S, D>) -> S {
    let moved = nodes
        .iter()
        .map(|&node| &trial.displacements[node as usize]);
    moved.fold(S::zero(), |sum, moved| sum + size_of(moved))
}

/// The ways of the nodes of an element in a step through stages, m.
pub(super) struct StageWays<S> {
    /// `Σ |h q̇_j|` of the components of nodes at each stage.
    pub(super) at_stages: [S; MOST_STAGES],
    /// `Σ (h|v⁰| + Σ_j |displacements_j w_j|)` of those that move: times ε, the rounding of their new positions.
    pub(super) of_end: S,
}

impl<S: Real> StageWays<S> {
    #[cold]
    pub(super) fn new<const D: usize>(
        rule: &Tableau,
        nodes: &[u32],
        (view, trial): (&StepView<'_, S>, &Trial<S, D>),
    ) -> Self {
        let mut ways = Self {
            at_stages: [S::zero(); MOST_STAGES],
            of_end: S::zero(),
        };
        for node in nodes.iter().map(|&node| node as usize) {
            let moved = |set: usize| &trial.displacements_of_set(set)[node];
            for (way, shares) in ways.at_stages.iter_mut().zip(rule.motion) {
                let mut motion = [S::zero(); D];
                for (set, &share) in shares.iter().enumerate() {
                    for (motion, &moved) in motion.iter_mut().zip(moved(set)) {
                        *motion += S::from_f64(share) * moved;
                    }
                }
                *way += size_of(&motion);
            }
            if let Ending::Increments { displacements, .. } = rule.ending
                && view.masses.get(node).is_some()
            {
                let flight = view.old_velocity::<D>(node).map(|speed| view.step * speed);
                ways.of_end += size_of(&flight);
                for (set, &weight) in displacements.iter().enumerate() {
                    let time = S::from_f64(rule.times[rule.stage_of(set)]);
                    let beyond: [S; D] =
                        array::from_fn(|axis| moved(set)[axis] - time * flight[axis]);
                    ways.of_end += S::from_f64(weight).abs() * size_of(&beyond);
                }
            }
        }
        ways
    }
}

fn size_of<S: Real, const D: usize>(vector: &[S; D]) -> S {
    vector.iter().fold(S::zero(), |sum, x| sum + x.abs())
}
