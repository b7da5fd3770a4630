//! The forces of the last steps. They decide where Newton's method starts, and nothing else.

use core::{array, mem};

use crate::scalar::Real;

/// What is left of the error of a forecast one step later. Any memory of some steps will do.
const MEMORY: f64 = 0.875;

/// The forces of the last two steps, and how well they would have been foretold.
#[derive(Debug)]
pub(super) struct Past<S, const D: usize> {
    /// `Δp/h` of the last step and of the one before, per node, N; zero before the first.
    forces: [Vec<[S; D]>; 2],
    /// By how much each forecast has been wrong, `Σ |ΔF/m|²`, the last steps counting most.
    errors: [S; 3],
    /// The same before the last step.
    errors_before: [S; 3],
}

/// The past as it is saved: forces per coordinate.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct SavedPast<S> {
    pub(crate) forces: [Vec<S>; 2],
    pub(crate) errors: [S; 3],
}

impl<S: Real> SavedPast<S> {
    /// That of a scheme which has none.
    pub(crate) fn none() -> Self {
        Self {
            forces: [Vec::new(), Vec::new()],
            errors: [S::zero(); 3],
        }
    }
}

/// How the force of a step is foretold: weights of those of the last step and of the one before.
///
/// Not at all, which is free flight; as that of the last step; on the line through both.
const FORECASTS: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [2.0, -1.0]];

impl<S: Real, const D: usize> Past<S, D> {
    /// Nothing has happened yet.
    pub(super) fn none(nodes: usize) -> Self {
        let zeros = vec![[S::zero(); D]; nodes];
        Self {
            forces: [zeros.clone(), zeros],
            errors: [S::zero(); 3],
            errors_before: [S::zero(); 3],
        }
    }

    /// The weights of the forecast that has been best, and the forces that they belong to.
    pub(super) fn best(&self) -> ([S; 2], [&[[S; D]]; 2]) {
        let [nothing, constant, linear] = self.errors;
        let is_linear = linear.less(constant) & linear.less(nothing);
        let is_constant = constant.less(nothing);
        let weights = array::from_fn(|k| {
            let [nothing, constant, linear] = FORECASTS.map(|weights| S::from_f64(weights[k]));
            let other = S::select(is_constant, constant, nothing);
            S::select(is_linear, linear, other)
        });
        let forces = self.forces.each_ref().map(Vec::as_slice);
        (weights, forces)
    }

    /// Takes the forces of another step, given which nodes moved and their masses; leaves room for those
    /// of the next step in their place.
    pub(super) fn remember(
        &mut self,
        forces: &mut Vec<[S; D]>,
        masses: impl Iterator<Item = (usize, S)>,
    ) {
        self.errors_before = self.errors;
        let mut errors = self.errors.map(|error| S::from_f64(MEMORY) * error);
        let [last, before] = &self.forces;
        for (node, mass) in masses {
            let per_mass = mass.recip();
            let (force, last, before) = (&forces[node], &last[node], &before[node]);
            for axis in 0..D {
                let change = force[axis] - last[axis];
                let misses = [force[axis], change, change - (last[axis] - before[axis])];
                for (error, miss) in errors.iter_mut().zip(misses) {
                    *error += (miss * per_mass) * (miss * per_mass);
                }
            }
        }
        self.errors = errors;
        mem::swap(&mut self.forces[1], forces);
        self.forces.swap(0, 1);
    }

    /// Takes back the last [`remember`](Self::remember), given the room that it left.
    pub(super) fn forget(&mut self, room: &mut Vec<[S; D]>) {
        self.forces.swap(0, 1);
        mem::swap(&mut self.forces[1], room);
        self.errors = self.errors_before;
    }

    /// What a run goes on from.
    pub(super) fn save(&self) -> SavedPast<S> {
        SavedPast {
            forces: self
                .forces
                .each_ref()
                .map(|forces| forces.as_flattened().to_vec()),
            errors: self.errors,
        }
    }

    /// Goes on from what has been saved, of as many nodes.
    pub(super) fn restore(&mut self, saved: &SavedPast<S>) {
        for (own, saved) in self.forces.iter_mut().zip(&saved.forces) {
            own.copy_from_slice(saved.as_chunks().0);
        }
        self.errors = saved.errors;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(forces: [f64; 3]) -> (Past<f64, 1>, Vec<[f64; 1]>) {
        let mut past = Past::none(1);
        let mut room = vec![[0.0]];
        for force in forces {
            room[0] = [force];
            past.remember(&mut room, [(0, 2.0)].into_iter());
        }
        (past, room)
    }

    #[test]
    fn the_best_forecast_is_the_one_that_was() {
        let foretold = |forces: [f64; 3]| {
            let (past, _) = after(forces);
            let ([by_last, by_before], [last, before]) = past.best();
            by_last * last[0][0] + by_before * before[0][0]
        };
        assert_eq!(foretold([4.0, -4.0, 4.0]).to_bits(), 0.0_f64.to_bits());
        assert_eq!(foretold([4.0, 4.0, 4.0]).to_bits(), 4.0_f64.to_bits());
        assert_eq!(foretold([1.0, 2.0, 3.0]).to_bits(), 4.0_f64.to_bits());
    }

    #[test]
    fn what_was_forgotten_leaves_no_trace() {
        let (mut past, mut room) = after([1.0, 2.0, 4.0]);
        let before = past.save();
        room[0] = [9.0];
        past.remember(&mut room, [(0, 2.0)].into_iter());
        assert_ne!(past.save(), before);
        past.forget(&mut room);
        assert_eq!(past.save(), before);
    }
}
