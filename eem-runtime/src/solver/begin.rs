//! Where Newton's method starts.
//!
//! ```text
//! q¹ = q⁰ + (h/m)(p⁰ + ½h F)      F: the mean force of the step, foretold from those of the last ones
//! ```

use core::array;

use super::places::Seen;
use super::{SavedPast, Solver};
use crate::error::StepFailure;
use crate::group::{Group, Old, StepView, points};
use crate::scalar::{Mask, Real};

/// Where a trial starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Start {
    /// Where the scheme starts: at a foretold motion, or at the old state.
    Foretold,
    /// At the old state.
    Rest,
}

impl<S: Real, const D: usize> Solver<S, D> {
    /// Starts at the old state, or at a foretold motion away from it if the scheme wants one.
    pub(super) fn begin(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
        start: Start,
    ) -> Result<(), StepFailure> {
        for (node, force) in self.old_force.iter_mut().enumerate() {
            *force = view.loads.total_force(node).map(|load: S| -load);
        }
        self.per_length.fill(S::MAX);
        let mut old = Old {
            force: &mut self.old_force,
            lengths: &mut self.per_length,
        };
        for group in groups.iter_mut() {
            group.begin(view, &mut old)?;
        }
        self.twice_per_step = S::from_f64(2.0) * view.per_step;
        self.place_moved_anchors(view);
        self.start(view, start);
        Ok(())
    }

    /// Inertia and impulses that do not change during the step.
    pub(super) fn weigh(&mut self, view: &StepView<'_, S>) {
        self.twice_per_step = S::from_f64(2.0) * view.per_step;
        let momenta = points::<S, D>(view.state.momenta.values());
        for node in &mut self.nodes {
            let at = node.place.node();
            node.weigh(view, &momenta[at], old_force(&self.old_force, at));
        }
    }

    /// Anchors that are moved are where the step will have moved them.
    fn place_moved_anchors(&mut self, view: &StepView<'_, S>) {
        for &node in &view.loads.moved {
            self.trial.displacements[node] = if view.phase.moves() {
                view.loads.motion(node)
            } else {
                [S::zero(); D]
            };
        }
    }

    /// Moving nodes are where they are foretold, seen temperatures where they were.
    fn start(&mut self, view: &StepView<'_, S>, start: Start) {
        self.trial.settled = S::Mask::none();
        let momenta = points::<S, D>(view.state.momenta.values());
        let (values, right, solution) = self.tangent.renew();
        for &Seen { slot, row } in &self.seen {
            self.trial.seen.set(slot, view.state.temperatures[slot]);
            (right[row], solution[row]) = ([S::zero()], [S::zero()]);
        }
        let rows = right.as_flattened_mut().as_chunks_mut::<D>().0;
        // The way from the old state is the first correction.
        let changes = solution.as_flattened_mut().as_chunks_mut::<D>().0;
        let is_foretold =
            start == Start::Foretold && view.phase.moves() && self.scheme.foretells_its_start();
        let half_step = S::from_f64(0.5) * view.step;
        let forecast = self.past.forecast();
        let nodes = self.nodes.iter_mut().zip(rows).zip(changes);
        for ((node, rows), change) in nodes {
            let at = node.place.node();
            let momentum = &momenta[at];
            node.weigh(view, momentum, old_force(&self.old_force, at));
            let per_length = &mut self.per_length[at];
            *per_length = inverse_length(*per_length);
            let mut displacement = [S::zero(); D];
            if is_foretold {
                let (force, mobility) = (forecast.of(at), view.step * node.place.per_mass);
                displacement =
                    array::from_fn(|axis| mobility * (momentum[axis] + half_step * force[axis]));
            }
            (self.trial.displacements[at], *change) = (displacement, displacement);
            let rest = [S::zero(); D];
            self.trial.rests[at] = rest;
            node.balance([&displacement, &rest], self.twice_per_step, values, rows);
        }
    }

    /// Takes back what the last step left for the next ones.
    pub(crate) fn undo(&mut self) {
        if self.scheme.foretells_its_start() {
            self.past.forget();
        }
    }

    /// What the start of the next step depends on besides the state.
    pub(crate) fn past(&self) -> SavedPast<S> {
        self.past.save()
    }

    /// Goes on from a saved past.
    pub(crate) fn restore(&mut self, past: &SavedPast<S>) {
        self.past.restore(past);
    }
}

/// The reciprocal of a unit of length; that of a node without elements, for which it is the largest
/// number there is, is 1 m.
#[inline]
pub(super) fn inverse_length<S: Real>(length: S) -> S {
    if length.equal(S::MAX).all() {
        S::one()
    } else {
        length.recip()
    }
}

/// The part of the force on a node that old state and loads decide.
#[inline]
pub(super) fn old_force<S: Real, const D: usize>(forces: &[[S; D]], node: usize) -> [S; D] {
    forces.get(node).copied().unwrap_or([S::zero(); D])
}
