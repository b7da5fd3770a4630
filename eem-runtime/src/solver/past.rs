//! The forces of the last steps. They decide where Newton's method starts, and nothing else.

use core::mem;

use crate::scalar::Real;

/// What is left of the error of a forecast one step later. Any memory of some steps will do.
const MEMORY: f64 = 0.875;

/// The forces of the last two steps, and how well they would have been foretold.
#[derive(Debug)]
pub(super) struct Past<S, const D: usize> {
    /// `Δp/h` of the last step and of the one before, per node that moves, N; zero before the first.
    /// Those of anchors mean nothing.
    forces: [Vec<[S; D]>; 2],
    /// By how much each forecast has been wrong, `Σ |ΔF/m|²`, the last steps counting most.
    errors: [S; 3],
    /// The same before the last step.
    errors_before: [S; 3],
    /// The same after the step that is being closed.
    errors_after: [S; 3],
}

/// By how much the forecasts are wrong for a step, found node by node.
#[derive(Debug)]
pub(super) struct Misses<'a, S, const D: usize> {
    last: &'a [[S; D]],
    before: &'a [[S; D]],
    errors: [S; 3],
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
            errors_after: [S::zero(); 3],
        }
    }

    /// The weights of the forecast that has been best, and the forces that they belong to.
    pub(super) fn best(&self) -> ([S; 2], [&[[S; D]]; 2]) {
        let [nothing, constant, linear] = self.errors;
        let best = if linear < constant && linear < nothing {
            2
        } else {
            usize::from(constant < nothing)
        };
        let forces = self.forces.each_ref().map(Vec::as_slice);
        (FORECASTS[best].map(S::from_f64), forces)
    }

    /// Begins to compare the forces of another step with the forecasts of them.
    #[inline]
    pub(super) fn misses(&self) -> Misses<'_, S, D> {
        let [last, before] = self.forces.each_ref().map(Vec::as_slice);
        Misses {
            last,
            before,
            errors: self.errors.map(|error| S::from_f64(MEMORY) * error),
        }
    }

    /// Keeps what has been found for the step that is being closed, until it is remembered.
    #[inline]
    pub(super) fn expect(&mut self, errors: [S; 3]) {
        self.errors_after = errors;
    }

    /// Takes the forces of a step that has succeeded; leaves room for those of the next one in their place.
    #[inline]
    pub(super) fn remember(&mut self, forces: &mut Vec<[S; D]>) {
        self.errors_before = self.errors;
        self.errors = self.errors_after;
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

impl<S: Real, const D: usize> Misses<'_, S, D> {
    /// Looks at the force on a node with a mass.
    #[inline]
    pub(super) fn see(&mut self, node: usize, force: &[S; D], mass: S) {
        let per_mass = mass.recip();
        let (last, before) = (&self.last[node], &self.before[node]);
        for axis in 0..D {
            let change = force[axis] - last[axis];
            let misses = [force[axis], change, change - (last[axis] - before[axis])];
            for (error, miss) in self.errors.iter_mut().zip(misses) {
                *error += (miss * per_mass) * (miss * per_mass);
            }
        }
    }

    /// The errors with those of all nodes that it has looked at.
    #[inline]
    pub(super) fn found(self) -> [S; 3] {
        self.errors
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn go_on(past: &mut Past<f64, 1>, room: &mut Vec<[f64; 1]>, force: f64) {
        room[0] = [force];
        let mut misses = past.misses();
        misses.see(0, &room[0], 2.0);
        let errors = misses.found();
        past.expect(errors);
        past.remember(room);
    }

    fn after(forces: [f64; 3]) -> (Past<f64, 1>, Vec<[f64; 1]>) {
        let (mut past, mut room) = (Past::none(1), vec![[0.0]]);
        for force in forces {
            go_on(&mut past, &mut room, force);
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
        go_on(&mut past, &mut room, 9.0);
        assert_ne!(past.save(), before);
        past.forget(&mut room);
        assert_eq!(past.save(), before);
    }
}
