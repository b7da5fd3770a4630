//! The forces and internal variables of the last steps, from which the initial guess of Newton's method is predicted.
//! Nothing else depends on them.

use crate::algebra::{scaled, vector};
use crate::element::group::Before;
use crate::element::impulse::{Impulses, PLACES};

/// The factor by which the error of a predictor decays in each step. Any value that averages over several steps will do.
const MEMORY: f64 = 0.875;

/// The forces of the last two steps, and the errors of their predictions.
#[derive(Debug)]
pub(super) struct Past<const D: usize> {
    /// `Δp/h` of the last step and of the one before, N, zero before the first; and the impulse of the step that is being
    /// closed, N s. Per node; for an anchor only the impulse is meaningful.
    forces: Vec<[[f64; D]; PLACES]>,
    pub(super) history: History,
}

/// What does not depend on the dimension.
#[derive(Debug)]
pub(super) struct History {
    /// The row of [`TURNS`] that holds the index of each of these three.
    turn: usize,
    /// The error of each predictor, `Σ |ΔF/m|²`, with decreasing weights of earlier steps.
    errors: [f64; 3],
    /// `errors` before the last step.
    errors_before: [f64; 3],
    /// `errors` after the step that is being closed.
    errors_after: [f64; 3],
    /// Viscous stretches and temperatures at the start of the last step, and its size; the same of the one before. Empty
    /// for a scheme that does not predict them.
    internal: [Vec<f64>; 2],
    /// How many of them are viscous stretches.
    viscous: usize,
}

/// The indices of the forces of the last step, of the one before and of the next one, for each value of `turn`.
const TURNS: [[usize; PLACES]; PLACES] = [[0, 2, 1], [1, 0, 2], [2, 1, 0]];

/// The history in a checkpoint. Forces are per coordinate, N; those of anchors are meaningless.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct SavedPast {
    pub(crate) forces: [Vec<f64>; 2],
    pub(crate) errors: [f64; 3],
    /// Viscous stretches, m, and temperatures, K, at the start of the last step, and its size, s.
    pub(crate) internal: Vec<f64>,
}

impl SavedPast {
    /// The history of a scheme without a predictor.
    pub(crate) fn none() -> Self {
        Self::default()
    }
}

/// The predictors of the force of a step: weights of the forces of the last step and of the one before.
///
/// Zero, which is free flight; the last force; linear extrapolation.
const PREDICTORS: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [2.0, -1.0]];

impl<const D: usize> Past<D> {
    /// An empty history for these numbers of nodes, viscous stretches and temperatures.
    pub(super) fn none(nodes: usize, [viscous, temperatures]: [usize; 2]) -> Self {
        let size = match viscous + temperatures {
            0 => 0,
            variables => variables + 1,
        };
        Self {
            forces: vec![[[0.0; D]; PLACES]; nodes],
            history: History {
                internal: [vec![0.0; size], vec![0.0; size]],
                viscous,
                turn: 0,
                errors: [0.0; 3],
                errors_before: [0.0; 3],
                errors_after: [0.0; 3],
            },
        }
    }

    /// Forgets all steps.
    pub(super) fn clear(&mut self) {
        self.forces.fill([[0.0; D]; PLACES]);
        self.history.clear();
    }

    /// The force on a node by a predictor, N.
    #[inline]
    pub(super) fn predicted(&self, [by_last, by_before]: [f64; 2], node: usize) -> [f64; D] {
        let ([last, before, _], forces) = (TURNS[self.history.turn], &self.forces[node]);
        let (last, before) = (&forces[last], &forces[before]);
        vector(|axis| by_last * last[axis] + by_before * before[axis])
    }

    /// The impulses of the step that is being closed.
    #[inline]
    pub(super) fn impulses(&mut self) -> Impulses<'_, D> {
        let [_, _, next] = TURNS[self.history.turn];
        Impulses::new(&mut self.forces, next)
    }

    /// The impulse of a node in the step that is being closed, N s.
    #[inline]
    pub(super) fn impulse(&mut self, node: usize) -> &mut [f64; D] {
        let [_, _, next] = TURNS[self.history.turn];
        &mut self.forces[node][next]
    }

    /// Multiplies the impulse of a node by 1/h, which makes it a force, and adds its prediction errors, as accelerations.
    #[inline]
    pub(super) fn take(&mut self, node: usize, per_step: f64, per_mass: f64) {
        let [last, before, next] = TURNS[self.history.turn];
        let forces = &mut self.forces[node];
        let (last, before) = (forces[last], forces[before]);
        let mut errors = self.history.errors_after;
        for (axis, component) in forces[next].iter_mut().enumerate() {
            let force = *component * per_step;
            let change = force - last[axis];
            let misses = [force, change, change - (last[axis] - before[axis])];
            for (error, miss) in errors.iter_mut().zip(misses) {
                *error += (miss * per_mass) * (miss * per_mass);
            }
            *component = force;
        }
        self.history.errors_after = errors;
    }

    /// The history for a checkpoint.
    pub(super) fn save(&self) -> SavedPast {
        let zeros = vec![0.0; self.forces.len() * D];
        let mut saved = SavedPast {
            forces: [zeros.clone(), zeros],
            internal: self.history.internal[0].clone(),
            ..SavedPast::none()
        };
        self.save_to(&mut saved);
        saved
    }

    /// Saves the history into an earlier one of the same scene, without allocation.
    pub(super) fn save_to(&self, saved: &mut SavedPast) {
        let forces = self.forces.as_flattened().as_flattened();
        self.history.save_to(D, forces, saved);
    }

    /// Continues from a saved history of as many nodes.
    pub(super) fn restore(&mut self, saved: &SavedPast) {
        let forces = self.forces.as_flattened_mut().as_flattened_mut();
        self.history.restore(D, forces, saved);
    }
}

impl History {
    fn clear(&mut self) {
        for variables in &mut self.internal {
            variables.fill(0.0);
        }
        self.turn = 0;
        (self.errors, self.errors_before) = ([0.0; 3], [0.0; 3]);
    }

    /// The predictor with the smallest error so far.
    #[inline]
    pub(super) fn predictor(&self) -> [f64; 2] {
        let [nothing, constant, linear] = self.errors;
        let is_linear = linear < constant && linear < nothing;
        let is_constant = constant < nothing;
        let [nothing, constant, linear] = PREDICTORS;
        let other = if is_constant { constant } else { nothing };
        if is_linear { linear } else { other }
    }

    /// Begins to record the forces of a step, which enters the history only with [`keep`](Self::keep).
    #[inline]
    pub(super) fn remember(&mut self) {
        self.errors_after = scaled(MEMORY, &self.errors);
    }

    /// The internal variables before the last step, for a step of this size; `None` before the first one, or if not
    /// predicted.
    #[inline]
    pub(super) fn before(&self, step: f64) -> Option<Before<'_>> {
        let [variables @ .., last] = &self.internal[0][..] else {
            return None;
        };
        let (viscous, temperatures) = variables.split_at(self.viscous);
        (*last > 0.0).then(|| Before {
            viscous,
            temperatures,
            ratio: step / *last,
        })
    }

    /// Commits the step of this size: its forces, and the viscous stretches and temperatures where it started, become
    /// the history of the predictors.
    #[inline]
    pub(super) fn keep(&mut self, [viscous, temperatures]: [&[f64]; 2], step: f64) {
        self.internal.swap(0, 1);
        if let [variables @ .., last] = &mut self.internal[0][..] {
            let (kept, own) = (variables.iter_mut(), viscous.iter().chain(temperatures));
            for (kept, &own) in kept.zip(own) {
                *kept = own;
            }
            *last = step;
        }
        self.turn = (self.turn + 1) % PLACES;
        self.errors_before = self.errors;
        self.errors = self.errors_after;
    }

    /// Takes back the last [`keep`](Self::keep).
    pub(super) fn forget(&mut self) {
        self.internal.swap(0, 1);
        self.turn = (self.turn + PLACES - 1) % PLACES;
        self.errors = self.errors_before;
    }

    fn save_to(&self, dimension: usize, forces: &[f64], saved: &mut SavedPast) {
        let [last, before, _] = TURNS[self.turn];
        for (step, saved) in [last, before].into_iter().zip(&mut saved.forces) {
            let nodes = forces.chunks_exact(PLACES * dimension);
            for (own, saved) in nodes.zip(saved.chunks_exact_mut(dimension)) {
                saved.copy_from_slice(&own[step * dimension..][..dimension]);
            }
        }
        saved.errors = self.errors;
        for (saved, &own) in saved.internal.iter_mut().zip(&self.internal[0]) {
            *saved = own;
        }
    }

    fn restore(&mut self, dimension: usize, forces: &mut [f64], saved: &SavedPast) {
        let [last, before, _] = TURNS[self.turn];
        for (step, saved) in [last, before].into_iter().zip(&saved.forces) {
            let nodes = forces.chunks_exact_mut(PLACES * dimension);
            for (own, saved) in nodes.zip(saved.chunks_exact(dimension)) {
                own[step * dimension..][..dimension].copy_from_slice(saved);
            }
        }
        self.errors = saved.errors;
        for (own, &saved) in self.internal[0].iter_mut().zip(&saved.internal) {
            *own = saved;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn go_on(past: &mut Past<1>, force: f64) {
        *past.impulse(0) = [0.5 * force];
        past.history.remember();
        past.take(0, 2.0, 0.5);
        past.history.keep([&[force], &[]], 2.0);
    }

    fn after(forces: [f64; 3]) -> Past<1> {
        let mut past = Past::none(1, [1, 0]);
        for force in forces {
            go_on(&mut past, force);
        }
        past
    }

    #[test]
    fn the_predictor_is_the_one_with_the_smallest_error() {
        let predicted = |forces: [f64; 3]| {
            let past = after(forces);
            past.predicted(past.history.predictor(), 0)
                .map(f64::to_bits)
        };
        assert_eq!(predicted([4.0, -4.0, 4.0]), [0.0_f64.to_bits()]);
        assert_eq!(predicted([4.0, 4.0, 4.0]), [4.0_f64.to_bits()]);
        assert_eq!(predicted([1.0, 2.0, 3.0]), [4.0_f64.to_bits()]);
    }

    #[test]
    fn what_was_forgotten_leaves_no_trace() {
        let mut past = after([1.0, 2.0, 4.0]);
        let before = past.save();
        go_on(&mut past, 9.0);
        assert_ne!(past.save(), before);
        past.history.forget();
        assert_eq!(past.save(), before);
        let mut again = after([0.0; 3]).save();
        past.save_to(&mut again);
        assert_eq!(again, before);
    }

    #[test]
    fn a_step_that_is_not_kept_leaves_no_trace() {
        let mut past = after([1.0, 2.0, 4.0]);
        let before = past.save();
        *past.impulse(0) = [9.0];
        past.history.remember();
        past.take(0, 1.0, 0.5);
        assert_eq!(past.save(), before);
    }
}
