//! The end of a step: the new state from the found forces, temperatures and rates of the stages.

use super::StageSolver;
use super::assemble::{inertia, loads};
use crate::error::StepFailure;
use crate::group::{StageGroup, StageView};
use crate::scalar::Real;
use crate::scheme::variational_4;
use crate::solver::closing::check_motion;
use crate::state::State;

impl<S: Real> StageSolver<S> {
    /// Writes the new state to `next`, from what was found at the stages.
    ///
    /// The forces of the middle are `A q_m`, so that its displacements come from one linear solve;
    /// those of the end and the momenta follow explicitly.
    pub(super) fn close<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
        next: &mut State<S>,
    ) -> Result<(), StepFailure> {
        self.find_forces(groups, view, 0);
        self.move_to_middle(groups, view)?;
        self.find_forces(groups, view, 1);
        self.move_to_end(view);
        self.find_forces(groups, view, 2);
        next.copy_from(view.state);
        next.time.add(0, view.step);
        let weights = variational_4::STEP.map(|weight| view.step * S::from_f64(weight));
        for (node, mass) in self.masses.iter().enumerate() {
            for at in node * self.dimension..(node + 1) * self.dimension {
                next.positions.add(at, self.trial.displacements[1][at]);
                if mass.is_some() {
                    let forces = self.forces.iter().zip(weights);
                    let impulse =
                        forces.fold(S::zero(), |sum, (force, weight)| sum + weight * force[at]);
                    next.momenta.add(at, impulse);
                    let work = self.work(at, |stage| view.loads[stage].force[at]);
                    next.work.add(0, work);
                } else {
                    // The support bears the forces of the springs.
                    next.work
                        .add(0, self.work(at, |stage| -self.forces[stage][at]));
                }
            }
        }
        check_motion(next, self.dimension)?;
        for group in groups.iter_mut() {
            group.close(view, next);
        }
        for group in groups.iter_mut() {
            group.settle(&view.at_end(), next)?;
        }
        Ok(())
    }

    /// `h Σ b_i f_i v_i` of a coordinate, with the velocities of the quadratic motion, J.
    fn work(&self, at: usize, force: impl Fn(usize) -> S) -> S {
        let [middle, end] = self.trial.displacements.each_ref().map(|all| all[at]);
        let stages = variational_4::STEP.iter().zip(variational_4::MOTION);
        let terms = stages.enumerate().map(|(stage, (&weight, motion))| {
            let [by_middle, by_end] = motion.map(S::from_f64);
            S::from_f64(weight) * force(stage) * (by_middle * middle + by_end * end)
        });
        terms.fold(S::zero(), |sum, term| sum + term)
    }

    /// Loads less forces of the elements at a stage, N.
    fn find_forces<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
        stage: usize,
    ) {
        self.forces[stage].copy_from_slice(&view.loads[stage].total_force);
        for group in groups.iter_mut() {
            group.subtract_forces(stage, &self.trial, &mut self.forces[stage]);
        }
    }

    /// `(2m/h + (h/12) A)(q_m − q⁰) = p⁰ − (h/12)(2F_0 + A q⁰)`, with the loads among the forces.
    fn move_to_middle<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
    ) -> Result<(), StepFailure> {
        self.closing.clear();
        for group in groups.iter_mut() {
            group.add_secant(view, &self.trial, &mut self.closing);
        }
        let momenta = view.state.momenta.values();
        let start = view.step * S::from_f64(variational_4::MIDDLE_AND_END[0][0]);
        for (node, first) in view.layout.nodes.iter().enumerate() {
            let (Some(mass), Some(first)) = (self.masses[node], *first) else {
                continue;
            };
            for axis in 0..self.dimension {
                let (at, row) = (node * self.dimension + axis, first + axis);
                // The loads of both stages, and the springs of the start.
                let springs = self.forces[0][at] - view.loads[0].total_force[at];
                let rest = momenta[at] + loads(view, 0, at) + start * springs;
                self.closing.add(row, row, inertia(mass, 0, view.step));
                self.closing.add_right(row, rest);
            }
        }
        for unknown in view.layout.coupled.iter().flatten() {
            self.closing.add(*unknown, *unknown, S::one());
        }
        self.closing
            .solve()
            .map_err(|_| StepFailure::SingularTangent)?;
        for (node, first) in view.layout.nodes.iter().enumerate() {
            let Some(first) = *first else { continue };
            for axis in 0..self.dimension {
                let at = node * self.dimension + axis;
                self.place(view, 0, at, self.closing.right()[first + axis]);
            }
        }
        Ok(())
    }

    /// `q¹ − q⁰ = (h/m)(p⁰ + (h/6)(G_0 + 2G_m))` with the total forces G.
    fn move_to_end(&mut self, view: &StageView<'_, S>) {
        let momenta = view.state.momenta.values();
        let [start, middle] =
            variational_4::MIDDLE_AND_END[1].map(|weight| view.step * S::from_f64(weight));
        for (at, &momentum) in momenta.iter().enumerate() {
            if let Some(mass) = self.masses[at / self.dimension] {
                let impulse = start * self.forces[0][at] + middle * self.forces[1][at];
                self.place(view, 1, at, view.step / mass * (momentum + impulse));
            }
        }
    }

    /// Moves a coordinate of the middle or the end.
    fn place(&mut self, view: &StageView<'_, S>, half: usize, at: usize, displacement: S) {
        self.trial.displacements[half][at] = displacement;
        self.trial.positions[1 + half][at] = view.state.positions.values()[at] + displacement;
    }
}
