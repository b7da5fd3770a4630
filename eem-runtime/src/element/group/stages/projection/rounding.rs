//! The rounding of the conjugates of the stages where the terms of a path cancel.

use super::Projections;
use super::vector::{Vector, derivatives};
use crate::element::group::stages::point::StatePoint;
use crate::element::group::ways::StageWays;
use crate::element::kinematics::{Arms, QuadraticStrain};
use crate::element::tableau::MOST_STAGES;
use eem_material::free_energy::Material;

impl<M: Material, K: QuadraticStrain<D>, const D: usize> Projections<M, K, D> {
    /// Adds to the conditioning errors, in units of ε, those of a step whose increments are far above the variables: of the
    /// sums that give the points of the path and the projections, and of μ.
    ///
    /// ```text
    /// c_i = Σ_r |projection_ir| (|∂ê/∂x| + Σ_y |∂²ê/∂x∂y| Σ_j |integrals_rj R_j|)
    /// Σ_i b_i (c_i + |∇ê⁰| + |∇ê¹|)·|R_i| / Σ_i b_i R_i·W R_i · W |R_i|
    /// ```
    #[cold]
    pub(super) fn add_conditioning_of_path(&mut self, in_state: &StatePoint<M, K, D>) {
        let Some(path) = self.point.rule.path else {
            return;
        };
        let temperatures = self.temperatures;
        let mut own = [Vector::<M, K, D>::zero(); MOST_STAGES];
        for (r, shares) in path.integrals.iter().enumerate() {
            // It has been found at this trial before.
            let Ok((y, x)) = self.find_point(in_state, shares, r) else {
                break;
            };
            let (gradient, hessian) = in_state.model.hessian(&x);
            let kinematics = &self.point.kinematics;
            let (slopes, curvatures) = derivatives::<M, K, D>(
                kinematics,
                &y.strain,
                (&x, &gradient, &hessian),
                self.is_held(),
            );
            let mut terms = Vector::<M, K, D>::zero();
            for (rates, &share) in self.rates.iter().zip(*shares) {
                for index in 0..Self::LEN {
                    terms[index] += (share * rates[index]).abs();
                }
            }
            for (own, row) in own.iter_mut().zip(path.projection) {
                let share = row[r].abs();
                for index in 0..Self::LEN {
                    let size = (0..Self::LEN).fold(slopes[index].abs(), |sum, column| {
                        sum + (curvatures.at([index, column]) * terms[column]).abs()
                    });
                    own[index] += share * size;
                }
            }
        }
        self.temperatures = temperatures;
        let (mut work, mut norm) = (0.0, self.warming);
        for (stage, &weight) in self.point.rule.weights.iter().enumerate() {
            let [old, new] = &self.end_slopes;
            for index in 0..Self::LEN {
                let rate = weight * self.rates[stage][index].abs();
                work += (own[stage][index] + old[index].abs() + new[index].abs()) * rate;
                norm += self.metric[index] * self.rates[stage][index].abs() * rate;
            }
        }
        let is_moving = norm > f64::MIN_POSITIVE;
        let factor = if is_moving { work / norm } else { 0.0 };
        for (stage, own) in own.iter().enumerate() {
            for index in 0..Self::LEN {
                let along = self.metric[index] * self.rates[stage][index].abs();
                self.conditioning[stage][index] += own[index] + factor * along;
            }
        }
    }

    /// See [`Source::work_along`](crate::element::group::stages::source::Source::work_along):
    ///
    /// ```text
    /// Σ_j b_j (|F_j| Σ |h q̇_j| + |∇ê¹ ∂C/∂d_j| |h ḋ_j|) + |F¹| times the way of the end
    /// ```
    ///
    /// with the terms of `R_j = ∂C/∂d_j·h ḋ_j`, by which the path misses the new arms.
    #[cold]
    pub(super) fn work_of_rounding(&self, ways: &StageWays, new_arms: &Arms<K, D>) -> f64 {
        let at_end = |arms: &Arms<K, D>| self.force_size(arms, |q| self.end_slopes[1][q].abs());
        let mut work = at_end(new_arms) * ways.of_end;
        for (stage, &weight) in self.point.rule.weights.iter().enumerate() {
            let arms = &self.arms[stage];
            let force = self.force_size(arms, |q| self.conjugates[stage][q].abs());
            let motion = self.motions[stage].as_ref().as_flattened().iter();
            let motion = motion.fold(0.0, |sum, x| sum + x.abs());
            work += weight * (force * ways.at_stages[stage] + at_end(arms) * motion);
        }
        work
    }
}
