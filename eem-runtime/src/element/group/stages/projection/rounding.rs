//! The rounding of the conjugates of the stages where the terms of a path cancel.

use super::path::PointPath;
use super::vector::Vector;
use crate::element::group::point::Point;
use crate::element::kinematics::StrainMeasures;
use crate::element::tableau::MOST_STAGES;
use eem_material::arrays::Arrays;

impl<A: Arrays, G: StrainMeasures> PointPath<A, G> {
    /// Adds to the conditioning errors, in units of ε, those of a step whose increments are far above the variables: of the
    /// sums that give the points of the path and the projections, and of μ.
    ///
    /// ```text
    /// c_i = Σ_r |projection_ir| (|∂ê/∂x| + Σ_y |∂²ê/∂x∂y| Σ_j |integrals_rj R_j|)
    /// Σ_i b_i (c_i + |∇ê⁰| + |∇ê¹|)·|R_i| / Σ_i b_i R_i·W R_i · W |R_i|
    /// ```
    #[cold]
    pub(super) fn add_conditioning_of_path(&mut self, in_state: &Point<A, G::Measures>) {
        let Some(path) = self.point.rule.path else {
            return;
        };
        let temperatures = self.temperatures;
        let mut own = [Vector::<A, G>::zero(); MOST_STAGES];
        for (r, shares) in path.integrals.iter().enumerate() {
            // It has been found at this trial before.
            let Ok((y, x)) = self.find_point(in_state, shares, r) else {
                break;
            };
            let (gradient, hessian) = in_state.model.hessian(&x);
            let (slopes, curvatures) = self.derivatives(&y.strain, (&x, &gradient, &hessian));
            let mut terms = Vector::<A, G>::zero();
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
}
