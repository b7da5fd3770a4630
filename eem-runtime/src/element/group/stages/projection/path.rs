//! The path of a point through a step: its beginning, its points at a trial, and the projections from them.

use super::vector::{Matrix, Vector, chained, derivatives, sum_of};
use super::{Projections, combined};
use crate::element::conjugates::{Infeasible, temperature_at};
use crate::element::error::StateError;
use crate::element::group::stages::point::{StageArms, StatePoint};
use crate::element::handle::Element;
use crate::element::kinematics::{Measures, PerStrain, QuadraticStrain};
use crate::element::tableau::{MOST_POINTS, MOST_STAGES, Path};
use eem_material::free_energy::{Array, FreeEnergy, Material};
use eem_material::number::scalar::is_positive;

/// `y = (C, γ, s)` and `x = (π, γ, θ)` at a point of a path.
type PathPoint<M, K, const D: usize> = (Vector<M, K, D>, <M as FreeEnergy<f64>>::Variables);

impl<M: Material, K: QuadraticStrain<D>, const D: usize> Projections<M, K, D> {
    /// Finds arms, their motion and the increments of C at the stages.
    pub(super) fn move_along(
        &mut self,
        in_state: &StatePoint<M, K, D>,
        arms: &StageArms<K, D>,
    ) -> Result<(), StateError> {
        let kinematics = &self.point.kinematics;
        for (stage, row) in self.point.rule.motion.iter().enumerate() {
            let r = arms.of_set(stage);
            in_state.admissible_measures(&r)?;
            let motion = combined::<K, D>(row, &arms.changes);
            self.rates[stage].strain = kinematics.strain_rate(&r, &motion);
            (self.arms[stage], self.motions[stage]) = (r, motion);
        }
        Ok(())
    }

    /// Finds the conjugates of the stages and their derivatives, before [`make_exact`](Self::make_exact).
    pub(super) fn project(&mut self, in_state: &StatePoint<M, K, D>) -> Result<(), StateError> {
        let rule = self.point.rule;
        let Some(path) = rule.path else {
            return Ok(());
        };
        self.conjugates = [Vector::zero(); MOST_STAGES];
        self.conditioning = [Vector::zero(); MOST_STAGES];
        let stages = rule.stages();
        for row in &mut self.by_rates[..stages] {
            row[..stages].fill(Matrix::zero());
        }
        for (r, shares) in path.integrals.iter().enumerate() {
            let (y, x) = self.find_point(in_state, shares, r)?;
            let (gradient, hessian) = in_state.model.hessian(&x);
            if M::THERMAL {
                // ∂²ψ/∂θ² = −c/θ
                let (last, theta) = (M::Variables::LEN - 1, x[M::Variables::LEN - 1]);
                Infeasible::unless_stable(-theta * hessian[last][last], theta)
                    .map_err(|infeasible| infeasible.of(in_state.element))?;
            }
            check_finite(in_state.element, sum_of(gradient.as_ref()))?;
            let of_model = (&x, &gradient, &hessian);
            let kinematics = &self.point.kinematics;
            let of_energy = derivatives(kinematics, &y.strain, of_model, self.is_held());
            self.take((&path, r), &y, &of_energy);
        }
        Ok(())
    }

    /// Adds the contribution of a point of the path to the projections.
    fn take(
        &mut self,
        (path, r): (&Path, usize),
        y: &Vector<M, K, D>,
        (slopes, curvatures): &(Vector<M, K, D>, Matrix<M, K, D>),
    ) {
        let mut sizes = *y;
        sizes.strain = self.point.kinematics.strain_sizes(&y.strain);
        let variables = 0..Self::LEN;
        for (stage, shares) in path.projection.iter().enumerate() {
            let share = shares[r];
            for index in variables.clone() {
                self.conjugates[stage][index] += share * slopes[index];
                let size = variables.clone().fold(0.0, |sum, column| {
                    sum + (curvatures.at([index, column]) * sizes[column]).abs()
                });
                self.conditioning[stage][index] += share.abs() * size;
            }
            for (by, &reach) in self.by_rates[stage].iter_mut().zip(path.integrals[r]) {
                let factor = share * reach;
                for row in variables.clone() {
                    for column in variables.clone() {
                        *by.at_mut([row, column]) += factor * curvatures.at([row, column]);
                    }
                }
            }
        }
    }

    /// The measures of a strain of the path.
    pub(super) fn measures_in_path(
        &self,
        element: Element,
        strain: &PerStrain<K, D>,
    ) -> Result<Measures<K, D>, StateError> {
        let measures = self.point.kinematics.measures_of(strain);
        measures.ok_or_else(|| self.point.kinematics.refuse(element, strain))
    }

    /// The point of the path after these fractions of the increments.
    pub(super) fn find_point(
        &mut self,
        in_state: &StatePoint<M, K, D>,
        shares: &[f64],
        point: usize,
    ) -> Result<PathPoint<M, K, D>, StateError> {
        let y = self.path_at(shares);
        let measures = self.measures_in_path(in_state.element, &y.strain)?;
        let near = self.temperatures[point];
        let mut x = y.variables(measures.as_ref(), near);
        if M::THERMAL && !self.is_held() {
            let entropy = y[Self::ENTROPY];
            let found = temperature_at(&in_state.model, x, entropy, near);
            let theta = found.map_err(|infeasible| infeasible.of(in_state.element))?;
            (x[M::Variables::LEN - 1], self.temperatures[point]) = (theta, theta);
        }
        Ok((y, x))
    }

    /// Finds the end of the path; returns `∇ê` there, and the discrete derivatives between both ends, whose product with
    /// the increments is Δê. Of a prescribed temperature, the first are the derivatives of that product by the increments.
    pub(super) fn reach_end(
        &mut self,
        in_state: &StatePoint<M, K, D>,
    ) -> Result<[Vector<M, K, D>; 2], StateError> {
        let (end, x) = self.find_point(in_state, self.point.rule.weights, MOST_POINTS)?;
        let (kinematics, model) = (&self.point.kinematics, &in_state.model);
        self.end = end;
        self.end_sizes[1] = kinematics.strain_sizes(&end.strain);
        let mut gradient = model.gradient(&x);
        let response = model.temperature_form_response(&self.old_form, &x);
        let mut mean = M::Variables::filled(0.0);
        mean.as_mut()
            .copy_from_slice(&response.as_ref()[..M::Variables::LEN]);
        for force in &mut mean.as_mut()[M::MEASURES..M::MEASURES + self.point.dashpots] {
            *force = -*force;
        }
        if M::THERMAL {
            let last = M::Variables::LEN - 1;
            gradient[last] = x[last];
        }
        let between = |ends, by: M::Variables| Vector {
            strain: chained::<K, D>(&kinematics.strain_slopes(ends), by.as_ref()),
            rest: by,
        };
        let slopes = between([&end.strain, &end.strain], gradient);
        let discrete = between([&self.old.strain, &end.strain], mean);
        check_finite(in_state.element, slopes.sum() + discrete.sum())?;
        self.end_slopes[1] = slopes;
        if !self.is_held() {
            return Ok([slopes, discrete]);
        }
        // Δê + θ* (s − S), by (C, γ) and s: ψ_x + (θ − θ*) S_x, θ*
        let (last, (_, hessian)) = (M::Variables::LEN - 1, model.hessian(&x));
        for column in 0..last {
            gradient[column] -= (x[last] - mean[last]) * hessian[last][column];
        }
        gradient[last] = mean[last];
        Ok([between([&end.strain, &end.strain], gradient), discrete])
    }

    /// Finds the viscosities at the temperatures of the stages; an error unless both are positive.
    pub(super) fn find_viscosities(
        &mut self,
        in_state: &mut StatePoint<M, K, D>,
    ) -> Result<(), StateError> {
        for stage in 0..self.point.rule.stages() {
            let theta = self.mean_temperature(stage);
            if M::THERMAL && !is_positive(theta) {
                return Err(StateError::MeanTemperature {
                    element: in_state.element,
                    value: theta,
                });
            }
            in_state.find_viscosities(theta, None)?;
            self.viscosities[stage] = in_state.viscosities;
        }
        Ok(())
    }
}

/// An error unless a sum is finite.
fn check_finite(element: Element, sum: f64) -> Result<(), StateError> {
    if sum.is_finite() {
        return Ok(());
    }
    Err(StateError::NotFinite {
        element,
        quantity: "force or entropy",
        value: sum,
    })
}
