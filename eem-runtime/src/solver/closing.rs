//! The end of a step: the new state from the found forces, temperatures and rates.

use super::Solver;
use crate::error::StepFailure;
use crate::group::{Along, Group, StepView, points};
use crate::scalar::Real;
use crate::scheme::Closing;
use crate::state::State;

impl<S: Real, const D: usize> Solver<S, D> {
    /// Writes the new state to `next`, from the forces, temperatures and rates that were found.
    ///
    /// Where the nodal forces are `A q_m`, the displacements come from them by one linear solve,
    ///
    /// ```text
    /// (2m/h + ½h A) Δq = 2p⁰ − h A q⁰,      Δp = −h A (q⁰ + ½Δq)
    /// ```
    ///
    /// in which A is the same for every axis of space.
    pub(super) fn close(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        next: &mut State<S>,
    ) -> Result<(), StepFailure> {
        match self.scheme.closing() {
            _ if !view.phase.moves() => {
                self.trial.displacements.fill([S::zero(); D]);
                self.impulse.fill([S::zero(); D]);
            }
            Closing::Secant => {
                self.solve_secant(groups, view)?;
                self.find_impulse(groups, view, Along::Secant);
            }
            Closing::Start => {
                self.find_impulse(groups, view, Along::Scheme);
                self.move_from_start(groups, view);
            }
            Closing::Open => self.find_impulse(groups, view, Along::Scheme),
        }
        next.copy_books(view.state);
        if view.phase.heats() {
            next.time.add(view.step);
        }
        self.move_masses(view, next)?;
        self.move_anchors(view, next);
        self.remember_force(view, &mut next.past);
        for group in groups.iter_mut() {
            group.close(view, &self.trial, next)?;
        }
        Ok(())
    }

    /// New positions and momenta, all finite, and the work of the loads.
    fn move_masses(&self, view: &StepView<'_, S>, next: &mut State<S>) -> Result<(), StepFailure> {
        let old = view.state;
        for mass in &self.masses {
            let (displacement, impulse) = (
                &self.trial.displacements[mass.node],
                &self.impulse[mass.node],
            );
            for (axis, &displacement) in displacement.iter().enumerate() {
                let force = view.loads.force[mass.node * D + axis];
                if force != S::zero() {
                    next.work.add(force * displacement);
                }
            }
            move_node(mass.node, [displacement, impulse], old, next)?;
        }
        Ok(())
    }

    /// New positions of the anchors that are moved, and the work that this takes.
    fn move_anchors(&self, view: &StepView<'_, S>, next: &mut State<S>) {
        let old = &view.state.positions;
        for &node in &view.loads.moved {
            for axis in 0..D {
                let at = node * D + axis;
                let displacement = self.trial.displacements[node][axis];
                next.positions.advance(at, old, displacement);
                // The support bears the impulse of the springs.
                let support = -self.impulse[node][axis] / view.step;
                next.work.add(support * displacement);
            }
        }
    }

    /// `−h F` of the found forces.
    fn find_impulse(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        along: Along,
    ) {
        for (impulse, force) in self.impulse.iter_mut().zip(&self.old_force) {
            *impulse = force.map(|force| -view.step * force);
        }
        for group in groups.iter_mut() {
            group.add_impulse(view, &self.trial, along, &mut self.impulse);
        }
    }

    /// `Δq = (h/m)(p⁰ − ½h F⁰)`, `Δp = −½h (F⁰ + F¹)`, where F¹ acts along the gradient at q¹.
    fn move_from_start(&mut self, groups: &mut [Box<dyn Group<S, D>>], view: &StepView<'_, S>) {
        let half = S::from_f64(0.5);
        let q0 = points::<S, D>(view.state.positions.values());
        let p0 = points::<S, D>(view.state.momenta.values());
        for mass in &self.masses {
            let node = mass.node;
            let mobility = view.step / mass.mass;
            for axis in 0..D {
                let displacement = mobility * (p0[node][axis] + half * self.impulse[node][axis]);
                self.trial.displacements[node][axis] = displacement;
                self.trial.positions[node][axis] = q0[node][axis] + displacement;
            }
        }
        for group in groups.iter_mut() {
            group.add_impulse(view, &self.trial, Along::Gradient, &mut self.impulse);
        }
        for (impulse, force) in self.impulse.iter_mut().zip(&self.old_force) {
            for (impulse, &force) in impulse.iter_mut().zip(force) {
                *impulse = half * (*impulse - view.step * force);
            }
        }
    }

    fn solve_secant(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> Result<(), StepFailure> {
        self.secant.clear();
        for group in groups.iter_mut() {
            group.add_secant(view, &self.trial, &mut self.secant);
        }
        let momenta = points::<S, D>(view.state.momenta.values());
        let (values, right) = self.secant.parts();
        for mass in &self.masses {
            values[mass.secant_diagonal] += (mass.mass + mass.mass) / view.step;
            let (momentum, force) = (&momenta[mass.node], &self.old_force[mass.node]);
            for (axis, right) in right[mass.secant_row].iter_mut().enumerate() {
                *right += momentum[axis] + momentum[axis] - view.step * force[axis];
            }
        }
        self.secant
            .solve()
            .map_err(|_| StepFailure::SingularTangent)?;
        for mass in &self.masses {
            self.trial.displacements[mass.node] = self.secant.right()[mass.secant_row];
        }
        Ok(())
    }
}

/// The new position and the new momentum of a node, all finite, from its displacement and impulse.
#[inline]
pub(super) fn move_node<S: Real, const D: usize>(
    node: usize,
    [displacement, impulse]: [&[S; D]; 2],
    old: &State<S>,
    next: &mut State<S>,
) -> Result<(), StepFailure> {
    for axis in 0..D {
        let at = node * D + axis;
        next.positions
            .advance(at, &old.positions, displacement[axis]);
        next.momenta.advance(at, &old.momenta, impulse[axis]);
        let values = [next.positions.values()[at], next.momenta.values()[at]];
        for (quantity, value) in ["position", "momentum"].into_iter().zip(values) {
            if !value.is_finite() {
                return Err(StepFailure::Unbounded {
                    node,
                    axis,
                    quantity,
                    value: value.to_f64(),
                });
            }
        }
    }
    Ok(())
}
