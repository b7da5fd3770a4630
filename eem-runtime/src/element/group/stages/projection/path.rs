//! The path of a point through a step at a trial, and the projections from it.

use super::ProjectedPoint;
use super::derivatives::{chained, derivatives};
use super::vector::{Matrix, Vector};
use crate::element::conjugates::{Infeasible, temperature_at};
use crate::element::error::StateError;
use crate::element::group::arms::add_scaled;
use crate::element::group::respond::check_measures;
use crate::element::group::stages::member::{StageArms, StatePoint};
use crate::element::handle::Element;
use crate::element::kinematics::{Arms, Measures, PerStrain, QuadraticStrain};
use crate::element::tableau::{MOST_POINTS, MOST_STAGES, Path, Tableau};
use eem_material::free_energy::{Array, FreeEnergy, Material};
use eem_material::number::scalar::{Real, is_positive};

/// `y = (C, γ, s)` and `x = (π, γ, θ)` somewhere along a path.
type PathPoint<S, M, K, const D: usize> = (Vector<S, M, K, D>, <M as FreeEnergy<S>>::Variables);

impl<S: Real, M: Material<S>, K: QuadraticStrain<S, D>, const D: usize> ProjectedPoint<S, M, K, D> {
    /// Arms, their motion and the increments of C at the stages.
    pub(super) fn move_along(
        &mut self,
        in_state: &StatePoint<S, M, K, D>,
        rule: &Tableau,
        arms: &StageArms<K, S, D>,
    ) -> Result<(), StateError> {
        for (stage, row) in rule.motion.iter().enumerate() {
            let r = arms.of_set(stage);
            let measures = self.kinematics.measure(&r);
            check_measures::<K, S, D>(&self.kinematics, in_state.element, &measures, &r)?;
            let mut motion = Arms::<K, S, D>::filled([S::zero(); D]);
            for (change, &share) in arms.changes.iter().zip(*row) {
                add_scaled::<K, S, D>(&mut motion, S::from_f64(share), change);
            }
            self.own.rates[stage].strain = self.kinematics.strain_rate(&r, &motion);
            (self.own.arms[stage], self.own.motions[stage]) = (r, motion);
        }
        Ok(())
    }

    /// The conjugates of the stages and their derivatives, before they are made exact.
    pub(super) fn project(
        &mut self,
        in_state: &StatePoint<S, M, K, D>,
        rule: &Tableau,
    ) -> Result<(), StateError> {
        let Some(path) = rule.path else {
            return Ok(());
        };
        self.own.conjugates = [Vector::zero(); MOST_STAGES];
        self.own.resolution = [Vector::zero(); MOST_STAGES];
        let stages = rule.stages();
        for row in &mut self.own.by_rates[..stages] {
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
            let sum = gradient.as_ref().iter();
            unless_infinite(
                in_state.element,
                sum.fold(S::zero(), |sum, &value| sum + value),
            )?;
            let of_model = (&x, &gradient, &hessian);
            let (slopes, curvatures) =
                derivatives::<S, M, K, D>(&self.kinematics, &y.strain, of_model);
            self.take((&path, r), &y, &slopes, &curvatures);
        }
        Ok(())
    }

    /// What a point of the path contributes to the projections.
    fn take(
        &mut self,
        (path, r): (&Path, usize),
        y: &Vector<S, M, K, D>,
        slopes: &Vector<S, M, K, D>,
        curvatures: &Matrix<S, M, K, D>,
    ) {
        let mut sizes = *y;
        sizes.strain = self.kinematics.strain_sizes(&y.strain);
        let own = &mut self.own;
        for (stage, shares) in path.projection.iter().enumerate() {
            let share = S::from_f64(shares[r]);
            for index in 0..Vector::<S, M, K, D>::LEN {
                own.conjugates[stage][index] += share * slopes[index];
                let terms = 0..Vector::<S, M, K, D>::LEN;
                let size = terms.fold(S::zero(), |sum, column| {
                    sum + (curvatures[[index, column]] * sizes[column]).abs()
                });
                own.resolution[stage][index] += share.abs() * size;
            }
            for (by, &reach) in own.by_rates[stage].iter_mut().zip(path.integrals[r]) {
                let factor = share * S::from_f64(reach);
                for row in 0..Vector::<S, M, K, D>::LEN {
                    for column in 0..Vector::<S, M, K, D>::LEN {
                        by[[row, column]] += factor * curvatures[[row, column]];
                    }
                }
            }
        }
    }

    /// `y = (C, γ, s)` where the path has gone these shares of the increments.
    pub(super) fn path_at(&self, shares: &[f64]) -> Vector<S, M, K, D> {
        let mut y = self.increments(shares);
        for index in 0..Vector::<S, M, K, D>::LEN {
            y[index] += self.own.old[index];
        }
        y
    }

    /// The measures of a strain of the path.
    pub(super) fn measures_in_path(
        &self,
        element: Element,
        strain: &PerStrain<K, S, D>,
    ) -> Result<Measures<K, S, D>, StateError> {
        let measures = self.kinematics.measures_of(strain);
        measures.ok_or_else(|| self.kinematics.refuse(element, strain))
    }

    /// `y = (C, γ, s)` and `x = (π, γ, θ)` where the path has gone these shares of the increments.
    fn find_point(
        &mut self,
        in_state: &StatePoint<S, M, K, D>,
        shares: &[f64],
        place: usize,
    ) -> Result<PathPoint<S, M, K, D>, StateError> {
        let y = self.path_at(shares);
        let measures = self.measures_in_path(in_state.element, &y.strain)?;
        let near = self.own.temperatures[place];
        let mut x = y.variables(measures.as_ref(), near);
        if M::THERMAL {
            let entropy = y[Vector::<S, M, K, D>::ENTROPY];
            let found = temperature_at(&in_state.model, x, entropy, near);
            let theta = found.map_err(|infeasible| infeasible.of(in_state.element))?;
            (x[M::Variables::LEN - 1], self.own.temperatures[place]) = (theta, theta);
        }
        Ok((y, x))
    }

    /// The end of the path: `∇ê` there, and the discrete derivatives between both ends, whose sum with the
    /// increments is Δê.
    pub(super) fn reach_end(
        &mut self,
        in_state: &StatePoint<S, M, K, D>,
        rule: &Tableau,
    ) -> Result<[Vector<S, M, K, D>; 2], StateError> {
        let (end, x) = self.find_point(in_state, rule.weights, MOST_POINTS)?;
        self.own.end = end;
        self.own.end_sizes[1] = self.kinematics.strain_sizes(&end.strain);
        let mut gradient = in_state.model.gradient(&x);
        let response = in_state
            .model
            .temperature_form_response(&self.own.old_form, &x);
        let mut mean = M::Variables::filled(S::zero());
        for index in 0..M::Variables::LEN {
            let is_dashpot = (M::MEASURES..M::MEASURES + M::DASHPOTS).contains(&index);
            mean[index] = if is_dashpot {
                -response[index]
            } else {
                response[index]
            };
        }
        if M::THERMAL {
            let last = M::Variables::LEN - 1;
            gradient[last] = x[last];
        }
        let between = |ends, by: &M::Variables| {
            let mut slopes = Vector::zero();
            slopes.take_rest(by);
            slopes.strain = chained::<S, K, D>(&self.kinematics.strain_slopes(ends), by.as_ref());
            slopes
        };
        let slopes = between([&end.strain, &end.strain], &gradient);
        let mean = between([&self.own.old.strain, &end.strain], &mean);
        let sum = slopes.entries().chain(mean.entries());
        unless_infinite(
            in_state.element,
            sum.fold(S::zero(), |sum, value| sum + value),
        )?;
        self.own.end_slopes[1] = slopes;
        Ok([slopes, mean])
    }

    /// The viscosities at the temperatures of the stages, which are positive.
    pub(super) fn find_viscosities(
        &mut self,
        in_state: &mut StatePoint<S, M, K, D>,
        rule: &Tableau,
    ) -> Result<(), StateError> {
        for stage in 0..rule.stages() {
            let theta = self.mean_temperature(stage);
            if M::THERMAL && !is_positive(theta) {
                return Err(StateError::MeanTemperature {
                    element: in_state.element,
                    value: theta.to_f64(),
                });
            }
            in_state.find_viscosities(theta)?;
            self.own.viscosities[stage] = in_state.viscosities;
        }
        Ok(())
    }
}

/// The sum of some numbers is one.
fn unless_infinite<S: Real>(element: Element, sum: S) -> Result<(), StateError> {
    if sum.is_finite() {
        return Ok(());
    }
    Err(StateError::NotFinite {
        element,
        quantity: "force or entropy",
        value: sum.to_f64(),
    })
}
