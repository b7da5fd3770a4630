//! The end of a step: the new state from the found forces, temperatures and rates.

use core::array;

use super::Solver;
use super::begin::old_force;
use crate::error::StepFailure;
use crate::group::{Along, Group, StepView, points};
use crate::scalar::{Mask, Real};
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
        next.copy_books(view.state);
        if view.phase.heats() {
            next.time.add(view.step);
        }
        if view.phase.moves() {
            self.find_motion(groups, view)?;
            self.move_masses(view, next)?;
            self.move_anchors(view, next);
        } else {
            next.positions.copy_from(&view.state.positions);
            next.momenta.copy_from(&view.state.momenta);
        }
        for group in groups.iter_mut() {
            group.close(view, &self.trial, next)?;
        }
        if view.phase.heats() && self.scheme.foretells_its_start() {
            self.past.keep();
        }
        Ok(())
    }

    /// Displacements and impulses.
    fn find_motion(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> Result<(), StepFailure> {
        match self.scheme.closing() {
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
        Ok(())
    }

    /// New positions and momenta, all finite, and the work of the loads. The forces are remembered.
    fn move_masses(
        &mut self,
        view: &StepView<'_, S>,
        next: &mut State<S>,
    ) -> Result<(), StepFailure> {
        if view.loads.has_force() {
            self.book_work(view, next);
        }
        let per_step = view.step.recip();
        let mut remembering = self.past.remember();
        for node in &self.nodes {
            let at = node.place.node();
            let (displacement, impulse) = (&self.trial.displacements[at], remembering.impulse(at));
            move_node(at, [displacement, impulse], view.state, next)?;
            remembering.take(at, per_step, node.place.mass);
        }
        remembering.finish();
        Ok(())
    }

    fn book_work(&self, view: &StepView<'_, S>, next: &mut State<S>) {
        for node in &self.nodes {
            let at = node.place.node();
            let force = view.loads.force::<D>(at);
            for (&force, &displacement) in force.iter().zip(&self.trial.displacements[at]) {
                if !force.equal(S::zero()).all() {
                    next.work.add(force * displacement);
                }
            }
        }
    }

    /// New positions of the anchors that are moved, and the work that this takes.
    fn move_anchors(&mut self, view: &StepView<'_, S>, next: &mut State<S>) {
        let old = &view.state.positions;
        let mut impulses = self.past.impulses();
        for &node in &view.loads.moved {
            for axis in 0..D {
                let at = node * D + axis;
                let displacement = self.trial.displacements[node][axis];
                next.positions.advance(at, old, displacement);
                // The support bears the impulse of the springs.
                let support = -impulses.of(node)[axis] / view.step;
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
        let mut impulses = self.past.impulses();
        for (node, impulse) in impulses.iter_mut().enumerate() {
            *impulse = old_force(&self.old_force, node).map(|force| -view.step * force);
        }
        for group in groups.iter_mut() {
            group.add_impulse(view, &self.trial, along, &mut impulses);
        }
    }

    /// `Δq = (h/m)(p⁰ − ½h F⁰)`, `Δp = −½h (F⁰ + F¹)`, where F¹ acts along the gradient at q¹.
    fn move_from_start(&mut self, groups: &mut [Box<dyn Group<S, D>>], view: &StepView<'_, S>) {
        let half = S::from_f64(0.5);
        let p0 = points::<S, D>(view.state.momenta.values());
        let mut impulses = self.past.impulses();
        for node in &self.nodes {
            let at = node.place.node();
            let mobility = view.step / node.place.mass;
            let impulse = impulses.of(at);
            let displacement =
                array::from_fn(|axis| mobility * (p0[at][axis] + half * impulse[axis]));
            self.trial.displacements[at] = displacement;
        }
        for group in groups.iter_mut() {
            group.add_impulse(view, &self.trial, Along::Gradient, &mut impulses);
        }
        for (node, impulse) in impulses.iter_mut().enumerate() {
            let force = old_force(&self.old_force, node);
            *impulse = array::from_fn(|axis| half * (impulse[axis] - view.step * force[axis]));
        }
    }

    fn solve_secant(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> Result<(), StepFailure> {
        let Some(secant) = &mut self.secant else {
            return Ok(());
        };
        let tangent = &mut self.tangent;
        let (values, right) = secant.renew(tangent);
        for (node, right) in self.nodes.iter().zip(&mut *right) {
            values[node.place.secant_diagonal()] = node.place.mass * self.twice_per_step;
            *right = node.rest;
        }
        for group in groups.iter_mut() {
            group.add_secant(view, &self.trial, (&mut *values, &mut *right));
        }
        let solved = secant.solve(tangent);
        solved.map_err(|_| StepFailure::SingularTangent)?;
        for (node, displacement) in self.nodes.iter().zip(secant.solution(tangent)) {
            self.trial.displacements[node.place.node()] = *displacement;
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
    let by_position = next
        .positions
        .advance_point(node, &old.positions, displacement);
    let by_momentum = next.momenta.advance_point(node, &old.momenta, impulse);
    // What rounding takes from a sum is a number only if the sum is one.
    if (by_position + by_momentum).is_finite() {
        return Ok(());
    }
    find_unbounded::<S, D>(node, next)
}

/// The error with the first coordinate of a node that is no finite number.
#[cold]
fn find_unbounded<S: Real, const D: usize>(
    node: usize,
    state: &State<S>,
) -> Result<(), StepFailure> {
    for axis in 0..D {
        let at = node * D + axis;
        let values = [state.positions.values()[at], state.momenta.values()[at]];
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
