//! The work of the supports of moved anchors in a step through stages.
//!
//! ```text
//! work = h Σ_i b_i (F_i·q̇_i + v_i·ṗ_i),     p = M v of what a solid has at the anchor
//! ```
//!
//! with the forces F of the elements and the motion of the path at the stages, and polynomials for v and p.

use crate::algebra::{add, combined, scaled};
use crate::element::group::StepView;
use crate::element::state::State;
use crate::element::tableau::{MOST_STAGES, Path};
use crate::step::certificate::Motion;
use crate::step::solver::Solver;
use crate::step::solver::closing::masses::carry;
use crate::step::solver::closing::stages::weight_of;
use crate::step::solver::coupling::changes_at_stages;
use crate::step::solver::stages::Stages;

impl<const D: usize> Solver<D> {
    /// Sets moved anchors to their new positions, and adds the work of their supports.
    pub(super) fn move_supports(
        &self,
        view: &StepView<'_>,
        next: &mut State,
        motion: &mut Motion<D>,
    ) {
        let Some(stages) = &self.stages else {
            return;
        };
        for &node in &view.loads.moved {
            let displacement = view.loads.motion::<D>(node);
            for (axis, &displacement) in displacement.iter().enumerate() {
                let old = &view.state.positions;
                next.positions.advance(node * D + axis, old, displacement);
                // The support bears the forces of the elements.
                let support = |stage: usize| -stages.impulses[node][stage][axis] * view.per_step;
                next.work.add(self.work(stages, node, axis, &support));
            }
            if let Some(path) = stages.rule.path
                && view.masses.are_coupled()
            {
                self.carry(node, (stages, &path), view, (next, motion));
            }
        }
    }

    /// Moves the mass of a solid at a moved anchor; the support does the work.
    fn carry(
        &self,
        node: usize,
        (stages, path): (&Stages<D>, &Path),
        view: &StepView<'_>,
        (next, motion): (&mut State, &mut Motion<D>),
    ) {
        let [&old, _] = view.state.velocities.point::<D>(node);
        let changes = changes_at_stages::<D>(path, node, view);
        let impulses = self.impulses_at_stages(node, (stages, path), view);
        for (stage, &weight) in stages.rule.weights.iter().enumerate() {
            for axis in 0..D {
                let speed = old[axis] + changes[stage][axis];
                next.work.add(weight * speed * impulses[stage][axis]);
            }
        }
        let displacement = view.loads.motion::<D>(node);
        carry((node, &displacement), None, view, (next, motion));
        for (weight, displacement) in weight_of::<D>(view, node).iter().zip(displacement) {
            motion.work(weight * displacement);
        }
    }

    /// `h ṗ = h Σ_b M_mb v̇_b` of a moved anchor at the stages, N s.
    fn impulses_at_stages(
        &self,
        node: usize,
        (stages, path): (&Stages<D>, &Path),
        view: &StepView<'_>,
    ) -> [[f64; D]; MOST_STAGES] {
        let mut impulses = [[0.0; D]; MOST_STAGES];
        for pair in view.masses.held() {
            let other = match pair.nodes() {
                [a, b] if a == node => b,
                [a, b] if b == node => a,
                _ => continue,
            };
            let changes = if view.loads.moved.binary_search(&other).is_ok() {
                changes_at_stages(path, other, view)
            } else {
                self.changes_of_mass(other, stages, view)
            };
            let rates = differentiated(stages.rule.motion, &changes);
            add(impulses.as_flattened_mut(), pair.mass, rates.as_flattened());
        }
        impulses
    }

    /// The change of the velocity of a node from the old state to each stage, m/s; zero for a fixed anchor.
    fn changes_of_mass(
        &self,
        node: usize,
        stages: &Stages<D>,
        view: &StepView<'_>,
    ) -> [[f64; D]; MOST_STAGES] {
        let masses = self.nodes_of_set(0);
        let mut beyond = [[0.0; D]; MOST_STAGES];
        if let Ok(index) = masses.binary_search_by_key(&node, |mass| mass.node) {
            for (set, beyond) in beyond.iter_mut().enumerate().take(self.sets.len()) {
                let change = self.nodes_of_set(set)[index].change(&self.trial);
                *beyond = scaled(view.per_step, &change);
            }
        }
        differentiated(stages.rule.motion, &beyond)
    }
}

/// `h ẋ` at the stages of a polynomial x(t) that vanishes at the start of the step, from its values at the stages.
fn differentiated<const D: usize>(
    motion: &[&[f64]],
    values: &[[f64; D]; MOST_STAGES],
) -> [[f64; D]; MOST_STAGES] {
    let mut rates = [[0.0; D]; MOST_STAGES];
    for (rate, shares) in rates.iter_mut().zip(motion) {
        *rate = combined(shares, *values);
    }
    rates
}
