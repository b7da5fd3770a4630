//! The path of a spring through a step at a trial, and the projections from it.

use super::ProjectedMember;
use crate::element::conjugates::{Infeasible, temperature_at};
use crate::element::error::StateError;
use crate::element::group::arms::{add_scaled, along, change_in_set, scale};
use crate::element::group::respond::check_measures;
use crate::element::group::stages::member::StatePoint;
use crate::element::group::view::Trial;
use crate::element::handle::Element;
use crate::element::kinematics::{Arms, Kinematics};
use crate::element::tableau::{MOST_POINTS, MOST_STAGES, Path, Tableau};
use crate::material::free_energy::{Array, FreeEnergy};
use crate::number::scalar::{Real, is_positive};

impl<S, M, K, const D: usize> ProjectedMember<S, M, K, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
{
    /// Arms, their motion and the increments of C at the stages.
    pub(super) fn move_along(
        &mut self,
        point: &StatePoint<S, M, K, D>,
        rule: &Tableau,
        trial: &Trial<S, D>,
    ) -> Result<(), StateError> {
        let nodes = &self.site.common().nodes;
        let mut changes = [Arms::<K, S, D>::filled([S::zero(); D]); MOST_STAGES];
        for (set, change) in changes.iter_mut().enumerate().take(rule.sets()) {
            *change = change_in_set::<K, S, D>(nodes, trial, set);
        }
        for (stage, row) in rule.motion.iter().enumerate() {
            let mut r = changes[stage];
            add_scaled::<K, S, D>(&mut r, S::one(), &self.r0);
            let measures = self.kinematics.measure(&r);
            check_measures::<K, S, D>(&self.kinematics, point.element, &measures, &r)?;
            scale::<K, S, D>(&mut r, S::from_f64(2.0));
            let mut motion = Arms::<K, S, D>::filled([S::zero(); D]);
            for (change, &share) in changes.iter().zip(*row) {
                add_scaled::<K, S, D>(&mut motion, S::from_f64(share), change);
            }
            self.own.rates[stage][0] = along::<K, S, D>(&r, &motion);
            (self.own.directions[stage], self.own.motions[stage]) = (r, motion);
        }
        Ok(())
    }

    /// The conjugates of the stages and their derivatives, before they are made exact.
    pub(super) fn project(
        &mut self,
        point: &StatePoint<S, M, K, D>,
        rule: &Tableau,
    ) -> Result<(), StateError> {
        let Some(path) = rule.path else {
            return Ok(());
        };
        let zeros = M::Variables::filled(S::zero());
        self.own.conjugates = [zeros; MOST_STAGES];
        self.own.resolution = [zeros; MOST_STAGES];
        for row in &mut self.own.by_rates {
            *row = row.map(|_| M::Hessian::filled(zeros));
        }
        for (r, shares) in path.integrals.iter().enumerate() {
            let (y, x) = self.find_point(point, shares, r)?;
            let (gradient, hessian) = point.model.hessian(&x);
            if M::THERMAL {
                // ∂²ψ/∂θ² = −c/θ
                let (last, theta) = (M::Variables::LEN - 1, x[M::Variables::LEN - 1]);
                Infeasible::unless_stable(-theta * hessian[last][last], theta)
                    .map_err(|infeasible| infeasible.of(point.element))?;
            }
            let sum = gradient.as_ref().iter();
            unless_infinite(
                point.element,
                sum.fold(S::zero(), |sum, &value| sum + value),
            )?;
            let (slopes, curvatures) = derivatives::<S, M>(&x, &gradient, &hessian);
            self.take((&path, r), &y, &slopes, &curvatures);
        }
        Ok(())
    }

    /// What a point of the path contributes to the projections.
    fn take(
        &mut self,
        (path, r): (&Path, usize),
        y: &M::Variables,
        slopes: &M::Variables,
        curvatures: &M::Hessian,
    ) {
        let own = &mut self.own;
        for (stage, shares) in path.projection.iter().enumerate() {
            let share = S::from_f64(shares[r]);
            for index in 0..M::Variables::LEN {
                own.conjugates[stage][index] += share * slopes[index];
                let terms = curvatures[index].as_ref().iter().zip(y.as_ref());
                let size = terms.fold(S::zero(), |sum, (&a, &y)| sum + (a * y).abs());
                own.resolution[stage][index] += share.abs() * size;
            }
            for (by, &reach) in own.by_rates[stage].iter_mut().zip(path.integrals[r]) {
                let factor = share * S::from_f64(reach);
                for (row, curvatures) in by.as_mut().iter_mut().zip(curvatures.as_ref()) {
                    for (entry, &curvature) in row.as_mut().iter_mut().zip(curvatures.as_ref()) {
                        *entry += factor * curvature;
                    }
                }
            }
        }
    }

    /// `y = (C, γ, s)` and `x = (λ, γ, θ)` where the path has gone these shares of the increments.
    fn find_point(
        &mut self,
        point: &StatePoint<S, M, K, D>,
        shares: &[f64],
        place: usize,
    ) -> Result<(M::Variables, M::Variables), StateError> {
        let mut y = self.increments(shares);
        for (y, &old) in y.as_mut().iter_mut().zip(self.own.old.as_ref()) {
            *y += old;
        }
        let square = y[0];
        if !is_positive(square) {
            return Err(StateError::Path {
                element: point.element,
                value: square.to_f64(),
            });
        }
        let mut x = y;
        x[0] = square.sqrt();
        if M::THERMAL {
            let last = M::Variables::LEN - 1;
            let near = self.own.temperatures[place];
            let found = temperature_at(&point.model, x, y[last], near);
            x[last] = found.map_err(|infeasible| infeasible.of(point.element))?;
            self.own.temperatures[place] = x[last];
        }
        Ok((y, x))
    }

    /// The end of the path: `∇ê` there, and the discrete derivatives between both ends, whose sum with the
    /// increments is Δê.
    pub(super) fn reach_end(
        &mut self,
        point: &StatePoint<S, M, K, D>,
        rule: &Tableau,
    ) -> Result<[M::Variables; 2], StateError> {
        let (end, x) = self.find_point(point, rule.weights, MOST_POINTS)?;
        self.own.end = end;
        let mut slopes = point.model.gradient(&x);
        let response = point
            .model
            .temperature_form_response(&self.own.old_form, &x);
        let mut mean = M::Variables::filled(S::zero());
        for index in 0..M::MEASURES + M::DASHPOTS {
            let is_dashpot = index >= M::MEASURES;
            mean[index] = if is_dashpot {
                -response[index]
            } else {
                response[index]
            };
        }
        let stretch = x[0];
        slopes[0] /= stretch + stretch;
        mean[0] /= self.own.old_stretch + stretch;
        if M::THERMAL {
            let last = M::Variables::LEN - 1;
            slopes[last] = x[last];
            mean[last] = response[last];
        }
        let sum = [slopes, mean].iter().fold(S::zero(), |sum, values| {
            values.as_ref().iter().fold(sum, |sum, &value| sum + value)
        });
        unless_infinite(point.element, sum)?;
        self.own.end_slopes[1] = slopes;
        Ok([slopes, mean])
    }

    /// The viscosities at the temperatures of the stages, which are positive.
    pub(super) fn find_viscosities(
        &mut self,
        point: &mut StatePoint<S, M, K, D>,
        rule: &Tableau,
    ) -> Result<(), StateError> {
        for stage in 0..rule.stages() {
            let theta = self.mean_temperature(stage);
            if M::THERMAL && !is_positive(theta) {
                return Err(StateError::MeanTemperature {
                    element: point.element,
                    value: theta.to_f64(),
                });
            }
            point.find_viscosities(theta)?;
            self.own.viscosities[stage] = point.viscosities;
        }
        Ok(())
    }
}

/// `∇ê` and `∇²ê` by `(C, γ, s)` from the derivatives of ψ by `(λ, γ, θ)`.
///
/// ```text
/// e_x = ψ_x,   e_s = θ,   e_xy = ψ_xy − ψ_xθ ψ_yθ/ψ_θθ,   e_xs = −ψ_xθ/ψ_θθ,   e_ss = −1/ψ_θθ
/// ê_C = e_λ/2λ,   ê_CC = (e_λλ − e_λ/λ)/4λ²,   ê_Cx = e_λx/2λ
/// ```
pub(super) fn derivatives<S: Real, M: FreeEnergy<S>>(
    x: &M::Variables,
    gradient: &M::Variables,
    hessian: &M::Hessian,
) -> (M::Variables, M::Hessian) {
    let last = M::Variables::LEN - 1;
    let (mut slopes, mut curvatures) = (*gradient, *hessian);
    if M::THERMAL {
        let by_theta = hessian[last];
        let per_capacity = -by_theta[last].recip();
        for row in 0..last {
            let answer = per_capacity * by_theta[row];
            for column in 0..last {
                curvatures[row][column] += answer * by_theta[column];
            }
            (curvatures[row][last], curvatures[last][row]) = (answer, answer);
        }
        curvatures[last][last] = per_capacity;
        slopes[last] = x[last];
    }
    let stretch = x[0];
    let shrink = (stretch + stretch).recip();
    curvatures[0][0] -= slopes[0] / stretch;
    for index in 0..=last {
        curvatures[0][index] *= shrink;
        curvatures[index][0] *= shrink;
    }
    slopes[0] *= shrink;
    (slopes, curvatures)
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
