//! What paths of heat and dashpots produce in a step, never negative.
//!
//! The weights of order 8 are not all positive, so that the sum of productions that are positive at every
//! stage may be negative where it is below its own error. Then as much of the sums with positive weights is
//! mixed in as makes it zero.

use crate::number::scalar::{Mask, Real};

/// Entropy that flows along a path of heat and what it produces, as integrals over a step, J/K.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PathSums<S> {
    /// `∫ X/θ_a` and `∫ X (θ_b − θ_a)/(θ_a θ_b)` with `X = κ (θ_b − θ_a)`, by the weights of order 8.
    pub(super) flow: S,
    pub(super) production: S,
    /// The same by positive weights.
    pub(super) flow_positive: S,
    pub(super) production_positive: S,
}

impl<S: Real> PathSums<S> {
    /// Nothing has flowed.
    pub(super) fn none() -> Self {
        Self {
            flow: S::zero(),
            production: S::zero(),
            flow_positive: S::zero(),
            production_positive: S::zero(),
        }
    }

    /// Adds a stage with its two weights: the flow and the production per second.
    #[inline]
    pub(super) fn add(&mut self, [weight, positive]: [S; 2], flow: S, production: S) {
        self.flow += weight * flow;
        self.production += weight * production;
        self.flow_positive += positive * flow;
        self.production_positive += positive * production;
    }

    /// The flow and the production that count; whether the guard has acted.
    #[inline]
    pub(super) fn guarded(&self) -> ([S; 2], bool) {
        let zero = S::zero();
        if !self.production.less(zero).all() {
            return ([self.flow, self.production], false);
        }
        // φ with Π + φ (Π⁺ − Π) = 0
        let all = self.production_positive - self.production;
        let has_positive = zero.less(self.production_positive);
        let share = S::select(has_positive, -self.production / all, S::one());
        let flow = self.flow + share * (self.flow_positive - self.flow);
        ([flow, zero], true)
    }
}

/// The production of a dashpot, J/K, or its heat, J, that counts; whether the guard has acted.
#[inline]
pub(super) fn guarded<S: Real>(production: S) -> (S, bool) {
    let is_negative = production.less(S::zero()).all();
    (
        if is_negative { S::zero() } else { production },
        is_negative,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::step::explicit::tableau::{POSITIVE_WEIGHTS, WEIGHTS};

    /// A path between two temperatures, K, at each weighted stage.
    fn path(stages: [[f64; 2]; 8]) -> PathSums<f64> {
        let mut sums = PathSums::none();
        let weights = WEIGHTS.into_iter().zip(POSITIVE_WEIGHTS);
        for ((weight, positive), [a, b]) in weights.zip(stages) {
            let flow = (b - a) / a;
            sums.add([weight, positive], flow, flow * (b - a) / b);
        }
        sums
    }

    #[test]
    fn honest_stages_pass_unchanged() {
        let sums = path([[300.0, 310.0]; 8]);
        let ([flow, production], has_acted) = sums.guarded();
        assert!(!has_acted);
        assert_eq!(
            [flow, production].map(f64::to_bits),
            [sums.flow, sums.production].map(f64::to_bits)
        );
        assert!((flow - 10.0 / 300.0).abs() < 1e-16);
    }

    // Heat that flows at the one stage whose weight is −5.8: an honest motion has no such stages.
    #[test]
    fn a_negative_production_becomes_zero_and_its_flow_is_mixed() {
        let mut stages = [[300.0, 300.0]; 8];
        stages[3] = [300.0, 330.0];
        let sums = path(stages);
        assert!(sums.production < 0.0 && sums.production_positive > 0.0);
        let ([flow, production], has_acted) = sums.guarded();
        assert!(has_acted);
        assert_eq!(production.to_bits(), 0.0_f64.to_bits());
        // Between the two flows, in proportion to the productions.
        let share = sums.production / (sums.production - sums.production_positive);
        let mixed = (1.0 - share) * sums.flow + share * sums.flow_positive;
        assert!(
            (flow - mixed).abs() <= 1e-15 * sums.flow.abs(),
            "{flow} {mixed}"
        );
        assert!(sums.flow < flow && flow < sums.flow_positive);
        // Only one stage has a flow, so that none is left where the production vanishes.
        assert!(flow.abs() < 1e-15);
    }

    #[test]
    fn nothing_positive_replaces_all() {
        let sums = PathSums {
            flow: 1e-20,
            production: -1e-40,
            flow_positive: 3e-20,
            production_positive: 0.0,
        };
        assert_eq!(sums.guarded(), ([3e-20, 0.0], true));
    }

    #[test]
    fn a_dashpot_never_takes_entropy() {
        assert_eq!(guarded(-1e-3), (0.0, true));
        assert_eq!(guarded(1e-3), (1e-3, false));
    }
}
