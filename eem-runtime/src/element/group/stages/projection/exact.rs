//! The correction by which the conjugates of the stages give the change of energy exactly.

use super::ProjectedPoint;
use super::vector::Vector;
use crate::element::kinematics::QuadraticStrain;
use crate::element::tableau::{MOST_STAGES, Tableau};
use eem_material::free_energy::Material;
use eem_material::number::scalar::Real;

/// Roundings of the terms of `Δê − Σ b a·R` below which it is nothing else: a product and two sums of a term, in
/// each of the two parts. The correction is then constant for the tangent, whose derivative of it would be
/// noise divided by small increments.
const DEFECT_ROUNDINGS: f64 = 8.0;

impl<S: Real, M: Material<S>, K: QuadraticStrain<S, D>, const D: usize> ProjectedPoint<S, M, K, D> {
    /// Corrects conjugates that have been projected, given `∇ê` at the end and the discrete derivatives ē.
    ///
    /// ```text
    /// Δê − Σ b a·R = Σ b (ē − a)·R
    /// ```
    ///
    /// Without increments there is nothing to correct.
    pub(super) fn make_exact(&mut self, rule: &Tableau, [slopes, mean]: &[Vector<S, M, K, D>; 2]) {
        let (mut defect, mut norm, mut terms) = (S::zero(), S::zero(), S::zero());
        for (stage, &weight) in rule.weights.iter().enumerate() {
            let weight = S::from_f64(weight);
            let (a, rates) = (&self.own.conjugates[stage], &self.own.rates[stage]);
            for index in 0..Vector::<S, M, K, D>::LEN {
                let rate = weight * rates[index];
                defect += (mean[index] - a[index]) * rate;
                terms += (a[index] * rate).abs();
                norm += self.own.metric[index] * rates[index] * rate;
            }
        }
        // A smaller sum of squares has lost digits.
        let is_moving = (S::MIN_POSITIVE / S::EPSILON).less(norm);
        let zero = S::zero();
        let factor = S::select(is_moving, defect / norm, zero);
        let noise = S::from_f64(DEFECT_ROUNDINGS) * S::EPSILON * terms;
        let is_noise = !is_moving | defect.abs().at_most(noise);
        let per_norm = S::select(is_noise, zero, norm.recip());
        let slopes = self.slopes_of_factor(rule, slopes, factor, per_norm);
        let known_to = S::select(is_moving, terms / norm, zero);
        self.apply_factor(rule, [factor, known_to], &slopes);
    }

    /// `∂μ/∂R_j`.
    fn slopes_of_factor(
        &self,
        rule: &Tableau,
        slopes: &Vector<S, M, K, D>,
        factor: S,
        per_norm: S,
    ) -> [Vector<S, M, K, D>; MOST_STAGES] {
        let own = &self.own;
        let mut by = [Vector::zero(); MOST_STAGES];
        for (j, &weight) in rule.weights.iter().enumerate() {
            let weight = S::from_f64(weight);
            for index in 0..Vector::<S, M, K, D>::LEN {
                let stretched = factor * own.metric[index] * own.rates[j][index];
                let direct = slopes[index] - own.conjugates[j][index];
                let mut sum = weight * (direct - stretched - stretched);
                for (i, &weight) in rule.weights.iter().enumerate() {
                    let rows = 0..Vector::<S, M, K, D>::LEN;
                    let answer = rows.fold(S::zero(), |sum, row| {
                        sum + own.by_rates[i][j][[row, index]] * own.rates[i][row]
                    });
                    sum -= S::from_f64(weight) * answer;
                }
                by[j][index] = per_norm * sum;
            }
        }
        by
    }

    /// `a_i + μ W R_i` with derivatives, given μ and, in units of ε, to what it is known.
    fn apply_factor(
        &mut self,
        rule: &Tableau,
        [factor, known_to]: [S; 2],
        slopes: &[Vector<S, M, K, D>; MOST_STAGES],
    ) {
        let own = &mut self.own;
        for i in 0..rule.stages() {
            for index in 0..Vector::<S, M, K, D>::LEN {
                let along = own.metric[index] * own.rates[i][index];
                own.conjugates[i][index] += factor * along;
                own.resolution[i][index] += known_to * along.abs();
                own.by_rates[i][i][[index, index]] += factor * own.metric[index];
                for (by, slopes) in own.by_rates[i].iter_mut().zip(slopes).take(rule.stages()) {
                    for column in 0..Vector::<S, M, K, D>::LEN {
                        by[[index, column]] += along * slopes[column];
                    }
                }
            }
        }
    }
}
