//! The global system of an iteration over the stages, and what its solution means.

use super::StageSolver;
use crate::group::{StageGroup, StageView, points};
use crate::scalar::Real;
use crate::scheme::variational_4;

impl<S: Real, const D: usize> StageSolver<S, D> {
    /// Residual and tangent of the motions to the middle and to the end,
    ///
    /// ```text
    /// R_m = (2m/h)(q_m − q⁰) − p⁰ + (h/12)(2F_0 + F_m)
    /// R_1 = (m/h)(q¹ − q⁰) − p⁰ + (h/6)(F_0 + 2F_m)
    /// ```
    ///
    /// and of `Θ_i − θ_i = 0` for the temperatures that neighbours see. Returns the largest entry of R.
    pub(super) fn assemble(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
    ) -> S {
        self.tangent.clear();
        for group in groups.iter_mut() {
            group.assemble(view, &self.trial, &mut self.tangent);
        }
        let mut largest = S::zero();
        let (values, right) = self.tangent.parts();
        let momenta = points::<S, D>(view.state.momenta.values());
        let (middle, end) = right.as_flattened_mut().split_at_mut(self.half);
        for (half, (masses, rows)) in self.masses.iter().zip([middle, end]).enumerate() {
            for (mass, rows) in masses.iter().zip(rows.as_chunks_mut::<D>().0) {
                let inertia = inertia(mass.mass, half, view.step);
                let displacement = &self.trial.displacements[half][mass.node()];
                let loads = loads::<S, D>(view, half, mass.node());
                for (axis, (place, residual)) in mass.diagonal().into_iter().zip(rows).enumerate() {
                    values[place] += inertia;
                    let rest = momenta[mass.node()][axis] + loads[axis];
                    *residual += rest - inertia * displacement[axis];
                    largest = largest.maximum(residual.abs());
                }
            }
        }
        largest
    }

    /// Distributes the solution; the largest scaled update.
    pub(super) fn correct(
        &mut self,
        groups: &mut [Box<dyn StageGroup<S, D>>],
        view: &StageView<'_, S>,
    ) -> S {
        self.remember();
        self.tangent.clear_rest::<D>();
        let solution = self.tangent.solution_mut();
        let mut largest = S::zero();
        for (half, masses) in self.masses.iter().enumerate() {
            let correction = &mut self.correction[half];
            let changes = solution[half * self.half..].as_flattened().as_chunks().0;
            for (mass, displacement) in masses.iter().zip(changes) {
                let per_length = self.per_length[mass.node()];
                correction.0[mass.node()] = *displacement;
                for &change in displacement {
                    largest = largest.maximum((change * per_length).abs());
                }
            }
            for seen in &self.seen[half] {
                // What rounding to Θ + δΘ leaves of δΘ: with a large conductance a rounding of Θ is
                // a large heat; the local unknowns must answer to the Θ that will be used.
                let theta = self.trial.seen_temperatures[2 * half][seen.slot];
                let change = (theta + solution[seen.row][0]) - theta;
                solution[seen.row][0] = change;
                correction.1[seen.slot] = change;
                largest = largest.maximum((change / theta).abs());
            }
        }
        largest.maximum(correct_locally(groups, view, self.tangent.solution()))
    }
}

/// Corrects the local unknowns for given global corrections; the largest scaled update.
pub(super) fn correct_locally<S: Real, const D: usize>(
    groups: &mut [Box<dyn StageGroup<S, D>>],
    view: &StageView<'_, S>,
    solution: &[[S; 1]],
) -> S {
    let updates = groups.iter_mut().map(|group| group.correct(view, solution));
    updates.fold(S::zero(), S::maximum)
}

/// `2m/h` for the motion to the middle, `m/h` for that to the end.
pub(super) fn inertia<S: Real>(mass: S, half: usize, step: S) -> S {
    let inertia = mass / step;
    if half == 0 {
        inertia + inertia
    } else {
        inertia
    }
}

/// The impulse of the loads on a node in the equation of one half, N s.
pub(super) fn loads<S: Real, const D: usize>(
    view: &StageView<'_, S>,
    half: usize,
    node: usize,
) -> [S; D] {
    let mut impulse = [S::zero(); D];
    for (&weight, loads) in variational_4::MIDDLE_AND_END[half].iter().zip(view.loads) {
        let share = view.step * S::from_f64(weight);
        let force = loads.total_force::<D>(node);
        for (impulse, force) in impulse.iter_mut().zip(force) {
            *impulse += share * force;
        }
    }
    impulse
}
