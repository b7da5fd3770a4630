//! The end of a step: the new state from the found forces, temperatures and rates.

use super::Solver;
use crate::error::StepFailure;
use crate::group::{Group, StepView};
use crate::scalar::Real;
use crate::scheme::Closing;
use crate::state::State;

impl<S: Real> Solver<S> {
    /// Writes the new state to `next`, from the forces, temperatures and rates that were found.
    ///
    /// Where the nodal forces are `A q_m`, the displacements come from them by one linear solve,
    ///
    /// ```text
    /// (2m/h + ½h A) Δq = 2p⁰ − h A q⁰,      Δp = −h A (q⁰ + ½Δq)
    /// ```
    pub(super) fn close<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        next: &mut State<S>,
    ) -> Result<(), StepFailure> {
        match self.scheme.closing() {
            _ if !view.phase.moves() => {
                self.trial.displacements.fill(S::zero());
                self.impulse.fill(S::zero());
            }
            Closing::Secant => {
                self.system.clear();
                for group in groups.iter_mut() {
                    group.add_secant(view, &self.trial, &mut self.system);
                }
                self.solve_secant(view)?;
                self.find_impulse(groups, view);
            }
            Closing::Start => {
                self.find_impulse(groups, view);
                self.move_from_start(groups, view);
            }
            Closing::Open => self.find_impulse(groups, view),
        }
        next.copy_from(view.state);
        if view.phase.heats() {
            next.time.add(0, view.step);
        }
        for (node, mass) in self.masses.iter().enumerate() {
            for at in node * self.dimension..(node + 1) * self.dimension {
                let displacement = self.trial.displacements[at];
                next.positions.add(at, displacement);
                if mass.is_some() {
                    next.momenta.add(at, self.impulse[at]);
                    next.work.add(0, view.loads.force[at] * displacement);
                } else {
                    // The support bears the impulse of the springs.
                    let support = -self.impulse[at] / view.step;
                    next.work.add(0, support * displacement);
                }
            }
        }
        check_motion(next, self.dimension)?;
        for group in groups.iter_mut() {
            group.close(view, &self.trial, next);
        }
        for group in groups.iter_mut() {
            group.settle(view, next)?;
        }
        Ok(())
    }

    /// `−h F` of the found forces.
    fn find_impulse<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) {
        for (impulse, &force) in self.impulse.iter_mut().zip(&self.old_force) {
            *impulse = -view.step * force;
        }
        for group in groups.iter_mut() {
            group.add_impulse(view, &self.trial, &mut self.impulse);
        }
    }

    /// `Δq = (h/m)(p⁰ − ½h F⁰)`, `Δp = −½h (F⁰ + F¹)`, where F¹ acts along the gradient at q¹.
    fn move_from_start<const D: usize>(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) {
        let half = S::from_f64(0.5);
        let (q0, p0) = (view.state.positions.values(), view.state.momenta.values());
        for (node, mass) in self.masses.iter().enumerate() {
            let Some(mass) = *mass else { continue };
            for at in node * self.dimension..(node + 1) * self.dimension {
                let displacement = view.step / mass * (p0[at] + half * self.impulse[at]);
                self.trial.displacements[at] = displacement;
                self.trial.positions[at] = q0[at] + displacement;
            }
        }
        for group in groups.iter_mut() {
            group.aim(&self.trial);
            group.add_impulse(view, &self.trial, &mut self.impulse);
        }
        for (impulse, &force) in self.impulse.iter_mut().zip(&self.old_force) {
            *impulse = half * (*impulse - view.step * force);
        }
    }

    fn solve_secant(&mut self, view: &StepView<'_, S>) -> Result<(), StepFailure> {
        let momenta = view.state.momenta.values();
        for (node, mass) in self.masses.iter().enumerate() {
            let (Some(mass), Some(first)) = (*mass, view.layout.nodes[node]) else {
                continue;
            };
            for axis in 0..self.dimension {
                let at = node * self.dimension + axis;
                let rest = momenta[at] + momenta[at] - view.step * self.old_force[at];
                self.system
                    .add(first + axis, first + axis, (mass + mass) / view.step);
                self.system.add_right(first + axis, rest);
            }
        }
        for unknown in view.layout.coupled.iter().flatten() {
            self.system.add(*unknown, *unknown, S::one());
        }
        self.system
            .solve()
            .map_err(|_| StepFailure::SingularTangent)?;
        let solution = self.system.right();
        for (node, first) in view.layout.nodes.iter().enumerate() {
            let Some(first) = *first else { continue };
            for axis in 0..self.dimension {
                self.trial.displacements[node * self.dimension + axis] = solution[first + axis];
            }
        }
        Ok(())
    }
}

/// Positions and momenta are finite.
pub(super) fn check_motion<S: Real>(next: &State<S>, dimension: usize) -> Result<(), StepFailure> {
    let sums = [("position", &next.positions), ("momentum", &next.momenta)];
    for (quantity, sums) in sums {
        let values = sums.values();
        if let Some(at) = values.iter().position(|value| !value.is_finite()) {
            return Err(StepFailure::Unbounded {
                node: at / dimension,
                axis: at % dimension,
                quantity,
                value: values[at].to_f64(),
            });
        }
    }
    Ok(())
}
