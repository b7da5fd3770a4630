//! The ways of the nodes of an element in a step. Rounding of the sums of forces at nodes does work along them, and of the
//! ends of paths.

use super::view::{StepView, Trial};
use crate::algebra::vector;
use crate::element::tableau::{Ending, MOST_STAGES, Tableau};

/// `Σ |Δq|` of the components of nodes, m.
#[cold]
pub(super) fn way_of_nodes<const D: usize>(nodes: &[u32], trial: &Trial<D>) -> f64 {
    let moved = nodes
        .iter()
        .map(|&node| &trial.displacements[node as usize]);
    moved.fold(0.0, |sum, moved| sum + size_of(moved))
}

/// The ways of the nodes of an element in a step through stages, m.
pub(super) struct StageWays {
    /// `Σ |h q̇_j|` of the components of nodes at each stage.
    pub(super) at_stages: [f64; MOST_STAGES],
    /// `Σ (h|v⁰| + Σ_j |displacements_j w_j|)` of those that move: times ε, the rounding of their new positions.
    pub(super) of_end: f64,
}

impl StageWays {
    #[cold]
    pub(super) fn new<const D: usize>(
        rule: &Tableau,
        nodes: &[u32],
        (view, trial): (&StepView<'_>, &Trial<D>),
    ) -> Self {
        let mut ways = Self {
            at_stages: [0.0; MOST_STAGES],
            of_end: 0.0,
        };
        for node in nodes.iter().map(|&node| node as usize) {
            let moved = |set: usize| &trial.displacements_of_set(set)[node];
            for (way, shares) in ways.at_stages.iter_mut().zip(rule.motion) {
                let mut motion = [0.0; D];
                for (set, &share) in shares.iter().enumerate() {
                    for (motion, &moved) in motion.iter_mut().zip(moved(set)) {
                        *motion += share * moved;
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
                    let time = rule.times[rule.stage_of(set)];
                    let beyond: [f64; D] = vector(|axis| moved(set)[axis] - time * flight[axis]);
                    ways.of_end += weight.abs() * size_of(&beyond);
                }
            }
        }
        ways
    }
}

fn size_of<const D: usize>(vector: &[f64; D]) -> f64 {
    vector.iter().fold(0.0, |sum, x| sum + x.abs())
}
