//! The correction with which the work of the conjugates of the stages is exactly the change of energy.

use super::path::PointPath;
use super::vector::Vector;
use crate::element::kinematics::StrainMeasures;
use crate::element::tableau::MOST_STAGES;
use eem_material::arrays::Arrays;

/// `Δê − Σ b a·R` is rounding up to this many roundings of its terms: a product and two sums of a term, in each of the two
/// parts. The tangent then takes the correction `μ W R_i` as constant: its derivatives, μ W among them, would be noise divided by
/// small increments, a stiffness of 10¹²⁰ N/m where the increments are 10⁻¹⁴⁰ m.
const DEFECT_ROUNDINGS: f64 = 8.0;

impl<A: Arrays, G: StrainMeasures> PointPath<A, G> {
    /// Corrects projected conjugates, given `∇ê` at the end and the discrete derivatives ē.
    ///
    /// ```text
    /// Δê − Σ b a·R = Σ b (ē − a)·R
    /// ```
    ///
    /// Without increments there is nothing to correct. What the given increments of a prescribed temperature do is heat.
    pub(super) fn make_exact(&mut self, [slopes, mean]: &[Vector<A, G>; 2]) {
        let (mut defect, mut norm, mut terms) = (0.0, self.warming, 0.0);
        for (stage, &weight) in self.point.rule.weights.iter().enumerate() {
            let (a, rates) = (&self.conjugates[stage], &self.rates[stage]);
            for index in 0..Self::LEN {
                let rate = weight * rates[index];
                defect += (mean[index] - a[index]) * rate;
                terms += (a[index] * rate).abs();
                norm += self.metric[index] * rates[index] * rate;
            }
        }
        // A smaller sum of squares has lost digits.
        let is_moving = norm > f64::MIN_POSITIVE / f64::EPSILON;
        let factor = if is_moving { defect / norm } else { 0.0 };
        self.heat_beyond = factor * self.warming;
        let noise = DEFECT_ROUNDINGS * f64::EPSILON * terms;
        let is_noise = !is_moving || defect.abs() <= noise;
        let per_norm = if is_noise { 0.0 } else { norm.recip() };
        let slopes = self.slopes_of_factor(slopes, [factor, per_norm]);
        let conditioning = if is_moving { terms / norm } else { 0.0 };
        let stiffness = if is_noise { 0.0 } else { factor };
        self.apply_factor([factor, stiffness, conditioning], &slopes);
    }

    /// `∂μ/∂R_j`.
    fn slopes_of_factor(
        &self,
        slopes: &Vector<A, G>,
        [factor, per_norm]: [f64; 2],
    ) -> [Vector<A, G>; MOST_STAGES] {
        let weights = self.point.rule.weights;
        let mut by = [Vector::zero(); MOST_STAGES];
        for (j, &weight) in weights.iter().enumerate() {
            for index in 0..Self::LEN {
                let stretched = factor * self.metric[index] * self.rates[j][index];
                let direct = slopes[index] - self.conjugates[j][index];
                let mut sum = weight * (direct - stretched - stretched);
                for (i, &weight) in weights.iter().enumerate() {
                    let rows = 0..Self::LEN;
                    let response = rows.fold(0.0, |sum, row| {
                        sum + self.by_rates[i][j].at([row, index]) * self.rates[i][row]
                    });
                    sum -= weight * response;
                }
                by[j][index] = per_norm * sum;
            }
        }
        by
    }

    /// Adds `μ W R_i` and its derivatives to `a_i`, given μ, that of the tangent and, in units of ε, its conditioning error.
    fn apply_factor(
        &mut self,
        [factor, stiffness, conditioning]: [f64; 3],
        slopes: &[Vector<A, G>; MOST_STAGES],
    ) {
        let stages = self.point.rule.stages();
        for i in 0..stages {
            for index in 0..Self::LEN {
                let along = self.metric[index] * self.rates[i][index];
                self.conjugates[i][index] += factor * along;
                self.conditioning[i][index] += conditioning * along.abs();
                *self.by_rates[i][i].at_mut([index, index]) += stiffness * self.metric[index];
                for (by, slopes) in self.by_rates[i].iter_mut().zip(slopes).take(stages) {
                    for column in 0..Self::LEN {
                        *by.at_mut([index, column]) += along * slopes[column];
                    }
                }
            }
        }
    }
}
