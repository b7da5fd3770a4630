//! The end of a step along the paths of its stages, from the displacements that were found.
//!
//! ```text
//! w_j = u_j − c_j (h/m) p⁰,   q¹ = q⁰ + (h/m) p⁰ + Σ_j displacements_j w_j,   p¹ = p⁰ + (m/h) Σ_j impulses_j w_j
//! ```
//!
//! Forces do not enter: their rounding, which acts along the arms, has no torque on a path of which positions
//! and momenta are those of its stages, and stiff forces do not amplify it. What Newton's method leaves of
//! the balances of the stages is judged.

use core::array;

use crate::element::group::{StepView, points};
use crate::element::state::State;
use crate::element::tally::Tally;
use crate::number::scalar::Real;
use crate::step::certificate::{Motion, NodeStep, Speeds};
use crate::step::error::StepFailure;
use crate::step::newton::Largest;
use crate::step::solver::Solver;
use crate::step::solver::closing::masses::move_node;
use crate::step::solver::stages::Stages;

impl<S: Real, const D: usize> Solver<S, D> {
    /// Judges the balances of the nodes at all stages.
    pub(super) fn judge_stages(
        &mut self,
        stages: &Stages<S, D>,
        view: &StepView<'_, S>,
        tally: &mut Tally<S>,
    ) {
        let inertias = self.inertias(view);
        let mut largest = Largest::none();
        for (set, weights) in stages.rule.positions.iter().enumerate() {
            for moving in self.nodes_of_set(set) {
                let node = moving.place.node();
                let inertia = inertias[set] * moving.place.mass;
                let change = moving.change(&self.trial);
                let impulse = stages.combined(node, weights);
                let gained = change.map(|change| inertia * change);
                let residual = array::from_fn(|axis| gained[axis] - impulse[axis]);
                for &residual in &residual {
                    largest.see(residual);
                }
                let magnitude = self.magnitudes.get(node).copied();
                let mut magnitude = magnitude.unwrap_or(S::zero());
                for (&weight, impulse) in weights.iter().zip(&stages.impulses[node]) {
                    for &impulse in impulse {
                        magnitude += (S::from_f64(weight) * impulse).abs();
                    }
                }
                tally.balance_node(&residual, [&gained, &[S::zero(); D]], magnitude);
            }
        }
        self.final_residual = largest.found();
    }

    /// New positions and momenta, all finite, and the work of loads.
    pub(super) fn move_along_path(
        &self,
        stages: &Stages<S, D>,
        [displacements, impulses]: [&[f64]; 2],
        view: &StepView<'_, S>,
        next: &mut State<S>,
        motion: &mut Motion<S, D>,
    ) -> Result<(), StepFailure> {
        for (index, moving) in self.nodes_of_set(0).iter().enumerate() {
            let (place, node) = (&moving.place, moving.place.node());
            let mobility = view.step * place.per_mass;
            let [momentum, carry] = view.state.momenta.point::<D>(node);
            let flight = momentum.map(|momentum| mobility * momentum);
            // What rounding took from the momentum moves the node, too.
            let mut rest = carry.map(|carry| mobility * carry);
            let mut gained = [S::zero(); D];
            for (set, (&weight, &gain)) in displacements.iter().zip(impulses).enumerate() {
                let change = self.nodes_of_set(set)[index].change(&self.trial);
                for axis in 0..D {
                    rest[axis] += S::from_f64(weight) * change[axis];
                    gained[axis] += S::from_f64(gain) * change[axis];
                }
            }
            let impulse = gained.map(|gained| place.mass * view.per_step * gained);
            let displacement = array::from_fn(|axis| flight[axis] + rest[axis]);
            move_node(node, [&flight, &rest, &impulse], view.state, next)?;
            let moved = NodeStep {
                speeds: Speeds::OfMass(place.per_mass),
                position: &points(view.state.positions.values())[node],
                momentum,
                displacement: &displacement,
                impulse: &impulse,
            };
            motion.see(&moved, None, view.step);
            self.see_loads(stages, view, &moved, node, (next, motion));
        }
        Ok(())
    }

    /// What loads and weight of a node have done in the step.
    fn see_loads(
        &self,
        stages: &Stages<S, D>,
        view: &StepView<'_, S>,
        moved: &NodeStep<'_, S, D>,
        node: usize,
        (next, motion): (&mut State<S>, &mut Motion<S, D>),
    ) {
        if !view.stages[0].has_total_force() {
            return;
        }
        for axis in 0..D {
            let load = |stage: usize| view.stages[stage].force::<D>(node)[axis];
            next.work.add(self.work(stages, node, axis, load));
            let weight = view.stages[0].total_force::<D>(node)[axis] - load(0);
            motion.work(weight * moved.displacement[axis]);
        }
        for (stage, &weight) in stages.rule.weights.iter().enumerate() {
            let share = view.step * S::from_f64(weight);
            let total = view.stages[stage].total_force::<D>(node);
            let impulse = total.map(|force| share * force);
            let displacement = &self.trial.displacements_of_set(stage)[node];
            motion.push([moved.position, displacement], &impulse);
        }
    }
}
