//! The nodes at the end of a step: new positions and momenta.

use crate::algebra::difference;
use crate::element::group::{StepView, points};
use crate::element::state::State;
use crate::element::tally::Tally;
use crate::step::certificate::{Motion, NodeStep, Speeds};
use crate::step::error::StepFailure;
use crate::step::newton::Largest;
use crate::step::scheme::Closing;
use crate::step::solver::Solver;

impl<const D: usize> Solver<D> {
    /// Sets new positions and momenta, all finite. With increments, impulses from these replace those of the elements,
    /// and the difference is judged. The impulses are recorded as forces for the predictor.
    pub(super) fn move_masses(
        &mut self,
        view: &StepView<'_>,
        next: &mut State,
        motion: &mut Motion<D>,
        tally: &mut Tally,
    ) -> Result<(), StepFailure> {
        if view.loads.has_force() || !self.rockets.are_none() {
            self.book_work(view, next);
        }
        let [twice_per_step, ..] = self.inertias(view);
        let has_load = view.loads.has_total_force() || !self.rockets.are_none();
        let is_exact = self.scheme.is_exact();
        let takes_increments = self.scheme.closing() == Closing::Increments;
        let mut largest = Largest::default();
        self.past.history.remember();
        if !self.coupling.is_none() {
            self.find_factors(0);
            self.coupling.find_impulses(Some(0), twice_per_step);
        }
        for (moving, node) in self.nodes.iter().enumerate() {
            let at = node.node;
            let [displacement, rest] = node.moved(&self.trial);
            let found = self.past.impulse(at);
            if takes_increments {
                let [impulse, terms] = (self.coupling).impulse((moving, node), &self.trial);
                let residual = difference(&impulse, found);
                largest.see_all(&residual);
                if is_exact {
                    let magnitude = match self.magnitudes.get(at) {
                        None => 0.0,
                        Some(&magnitude) => {
                            motion.fall_short(&residual, displacement, view.per_step);
                            magnitude
                        }
                    };
                    tally.balance_node(&residual, [&impulse, &terms], magnitude);
                }
                *found = impulse;
            }
            let impulse = &*found;
            let speeds = node.speeds(view, &self.trial, twice_per_step);
            let moved = NodeStep::new((view.state, at), speeds, displacement, impulse);
            let load = has_load.then(|| self.rockets.add_to(view.loads.total_force(at), [0, at]));
            motion.see(&moved, load.as_ref(), view.step);
            move_node(at, [displacement, rest, impulse], view.state, next)?;
            if let Speeds::Given { change, .. } = &moved.speeds {
                let (old, none) = (&view.state.velocities, [0.0; D]);
                next.velocities.advance_point(at, old, [change, &none]);
            }
            self.past.take(at, view.per_step, node.per_mass);
        }
        self.final_residual = largest.found();
        if view.masses.are_coupled() {
            follow_coupled_masses::<D>(view, next);
        }
        Ok(())
    }

    fn book_work(&self, view: &StepView<'_>, next: &mut State) {
        for node in &self.nodes {
            let at = node.node;
            let force: [f64; D] = self.rockets.add_to(view.loads.force(at), [0, at]);
            let moved = &self.trial.displacements[at];
            for axis in 0..D {
                if force[axis] != 0.0 {
                    next.work.add(force[axis] * moved[axis]);
                }
            }
        }
    }
}

/// Sets the new velocities of moved anchors, then the momenta of nodes that masses couple, from all velocities.
pub(super) fn follow_coupled_masses<const D: usize>(view: &StepView<'_>, next: &mut State) {
    for &node in &view.loads.moved {
        let (old, none) = (&view.state.velocities, [0.0; D]);
        let change = view.change_of_speed::<D>(node);
        next.velocities.advance_point(node, old, [&change, &none]);
    }
    next.follow_velocities(D, view.masses);
}

/// Sets the new position and momentum of a node from its displacement and impulse; an error unless all are finite.
#[inline]
pub(super) fn move_node<const D: usize>(
    node: usize,
    [displacement, rest, impulse]: [&[f64; D]; 3],
    old: &State,
    next: &mut State,
) -> Result<(), StepFailure> {
    let (positions, momenta) = (&mut next.positions, &mut next.momenta);
    let by_position = positions.advance_point(node, &old.positions, [displacement, rest]);
    let by_momentum = momenta.advance_point(node, &old.momenta, [impulse, &[0.0; D]]);
    // The compensation of a sum is finite only if the sum is.
    if (by_position + by_momentum).is_finite() {
        return Ok(());
    }
    find_unbounded(node, D, next)
}

/// The error with the first coordinate of a node that is not finite.
#[cold]
fn find_unbounded(node: usize, dimension: usize, state: &State) -> Result<(), StepFailure> {
    for axis in 0..dimension {
        let at = node * dimension + axis;
        let values = [state.positions.values()[at], state.momenta.values()[at]];
        for (quantity, value) in ["position", "momentum"].into_iter().zip(values) {
            if !value.is_finite() {
                return Err(StepFailure::Unbounded {
                    node,
                    axis,
                    quantity,
                    value,
                });
            }
        }
    }
    Ok(())
}

/// Adds the mass of a solid at a moved anchor, with the force of its loads if there are any, to the certificate; returns the work
/// `v̄·Δp` of the support on it, J.
pub(super) fn carry<const D: usize>(
    (node, displacement): (usize, &[f64; D]),
    load: Option<&[f64; D]>,
    view: &StepView<'_>,
    (next, motion): (&State, &mut Motion<D>),
) -> f64 {
    let [old, change] = [
        points::<D>(view.state.velocities.values())[node],
        view.change_of_speed(node),
    ];
    let momentum = |state: &State| points(state.momenta.values())[node];
    let impulse = difference(&momentum(next), &momentum(view.state));
    let speeds = Speeds::Given { old, change };
    let step = NodeStep::new((view.state, node), speeds, displacement, &impulse);
    motion.see(&step, load, view.step);
    step.energies()[0]
}
