//! Where Newton's method starts.
//!
//! ```text
//! q¹ = q⁰ + (h/m)(p⁰ + ½h F)      F: the mean force of the step, foretold from those of the last ones
//! ```

use core::array;

use super::{SavedPast, Solver};
use crate::error::StepFailure;
use crate::group::{Group, Old, StepView, points};
use crate::scalar::{Mask, Real};

impl<S: Real, const D: usize> Solver<S, D> {
    /// Starts at the old state, or at a foretold motion away from it if the scheme wants one.
    pub(super) fn begin(
        &mut self,
        groups: &mut [Box<dyn Group<S, D>>],
        view: &StepView<'_, S>,
    ) -> Result<(), StepFailure> {
        for (node, force) in self.old_force.iter_mut().enumerate() {
            *force = view.loads.total_force(node).map(|load: S| -load);
        }
        for length in &mut self.lengths {
            *length = S::MAX;
        }
        let mut old = Old {
            force: &mut self.old_force,
            lengths: &mut self.lengths,
        };
        for group in groups.iter_mut() {
            group.begin(view, &mut old)?;
        }
        self.weigh(view);
        self.place_anchors(view);
        self.start(view);
        Ok(())
    }

    /// Inertia and impulses that do not change during the step.
    pub(super) fn weigh(&mut self, view: &StepView<'_, S>) {
        let per_step = view.step.recip();
        let momenta = points::<S, D>(view.state.momenta.values());
        let moves = view.phase.moves();
        for node in &mut self.nodes {
            if !moves {
                (node.inertia, node.rest) = (S::one(), [S::zero(); D]);
                continue;
            }
            let at = node.place.node;
            let (momentum, force) = (&momenta[at], old_force(&self.old_force, at));
            node.inertia = (node.place.mass + node.place.mass) * per_step;
            node.rest =
                array::from_fn(|axis| momentum[axis] + momentum[axis] - view.step * force[axis]);
        }
    }

    /// Anchors are where the step will have moved them.
    fn place_anchors(&mut self, view: &StepView<'_, S>) {
        let old = points::<S, D>(view.state.positions.values());
        let moves = view.phase.moves();
        for &node in &self.anchors {
            let displacement = if moves {
                view.loads.motion(node)
            } else {
                [S::zero(); D]
            };
            self.trial.displacements[node] = displacement;
            self.trial.positions[node] =
                array::from_fn(|axis| old[node][axis] + displacement[axis]);
        }
    }

    fn start(&mut self, view: &StepView<'_, S>) {
        self.trial.settled = S::Mask::none();
        let old = points::<S, D>(view.state.positions.values());
        let momenta = points::<S, D>(view.state.momenta.values());
        let is_foretold = view.phase.moves() && self.scheme.foretells_its_start();
        let half_step = S::from_f64(0.5) * view.step;
        let ([by_last, by_before], [last, before]) = self.past.best();
        for node in &mut self.nodes {
            let at = node.place.node;
            node.per_length = inverse_length(self.lengths[at]);
            node.previous = [S::zero(); D];
            node.correction = node.previous;
            if is_foretold {
                let mobility = view.step / node.place.mass;
                let (momentum, last, before) = (&momenta[at], &last[at], &before[at]);
                node.correction = array::from_fn(|axis| {
                    let force = by_last * last[axis] + by_before * before[axis];
                    mobility * (momentum[axis] + half_step * force)
                });
            }
            let correction = node.correction;
            self.trial.displacements[at] = correction;
            self.trial.positions[at] = array::from_fn(|axis| old[at][axis] + correction[axis]);
        }
        for seen in &mut self.seen {
            let slot = seen.place.slot;
            seen.previous = view.state.temperatures[slot];
            seen.correction = S::zero();
            self.trial.seen_temperatures[slot] = seen.previous;
        }
    }

    /// Remembers the forces of a step that has succeeded.
    pub(super) fn remember_forces(&mut self, step: S) {
        if !self.scheme.foretells_its_start() {
            return;
        }
        let per_step = step.recip();
        for impulse in self.impulse.as_flattened_mut() {
            *impulse *= per_step;
        }
        let nodes = self.nodes.iter();
        let masses = nodes.map(|node| (node.place.node, node.place.mass));
        self.past.remember(&mut self.impulse, masses);
    }

    /// Takes back what the last step left for the next ones.
    pub(crate) fn undo(&mut self) {
        if self.scheme.foretells_its_start() {
            self.past.forget(&mut self.impulse);
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
    if length == S::MAX {
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
