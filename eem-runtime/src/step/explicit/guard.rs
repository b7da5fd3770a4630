//! The entropy production of paths of heat and dashpots in a step, never negative.
//!
//! The weights of order 8 are not all positive, so that the sum of productions that are positive at every
//! stage may be negative where it is below its own error. It is then combined with the sums of positive weights so that
//! the result is zero.

use super::tableau::{POSITIVE_WEIGHTS, WEIGHTED, WEIGHTS};
use eem_material::number::scalar::{Mask, Real};

/// A number for each stage that has weights.
pub(super) type PerWeight<S> = [S; WEIGHTED.len()];

/// The flow of entropy along a path of heat, and its entropy production, at the stages that have weights, W/K.
#[derive(Clone, Copy, Debug)]
pub(super) struct PathRates<S> {
    /// `X/θ_a` and `X (θ_b − θ_a)/(θ_a θ_b)` with `X = κ (θ_b − θ_a)`.
    flows: PerWeight<S>,
    productions: PerWeight<S>,
}

/// By how much of the way from the usual weights to the positive ones the guard has gone: zero where it did nothing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shift<S>(S);

impl<S: Real> Shift<S> {
    fn none() -> Self {
        Self(S::zero())
    }

    /// Whether the guard did nothing.
    #[inline]
    pub(super) fn is_none(&self) -> bool {
        self.0.equal(S::zero()).all()
    }

    /// The change of the integral of some rates.
    pub(super) fn of(&self, rates: &PerWeight<S>) -> S {
        self.0 * (integral(&POSITIVE_WEIGHTS, rates) - integral(&WEIGHTS, rates))
    }
}

/// `Σ w x`.
#[inline]
fn integral<S: Real>(weights: &[f64; WEIGHTED.len()], rates: &PerWeight<S>) -> S {
    let terms = weights.iter().zip(rates);
    terms.fold(S::zero(), |sum, (&weight, &rate)| {
        sum + S::from_f64(weight) * rate
    })
}

/// `∫ (x_b − x_a)` in units of the step.
pub(super) fn mean_drop<S: Real>([a, b]: [&PerWeight<S>; 2]) -> S {
    let mut drops = [S::zero(); _];
    for (drop, (&a, &b)) in drops.iter_mut().zip(a.iter().zip(b)) {
        *drop = b - a;
    }
    integral(&WEIGHTS, &drops)
}

impl<S: Real> PathRates<S> {
    /// Of a path of this conductance, W/K, between two temperatures, K.
    #[inline]
    pub(super) fn new(conductance: S, [a, b]: [&PerWeight<S>; 2]) -> Self {
        let (mut flows, mut productions) = ([S::zero(); _], [S::zero(); _]);
        for stage in 0..WEIGHTED.len() {
            let drop = b[stage] - a[stage];
            flows[stage] = conductance * drop * a[stage].recip();
            productions[stage] = flows[stage] * drop * b[stage].recip();
        }
        Self { flows, productions }
    }

    /// The flow and the guarded production in a step of the size h, J/K, and how far the guard has shifted weights.
    #[inline]
    pub(super) fn guarded(&self, h: S) -> ([S; 2], Shift<S>) {
        let usual = self.integrals(&WEIGHTS);
        let (counting, shift) = if usual[1].less(S::zero()).any() {
            mixed(usual, self.integrals(&POSITIVE_WEIGHTS))
        } else {
            (usual, Shift::none())
        };
        (counting.map(|sum| h * sum), shift)
    }

    #[inline]
    fn integrals(&self, weights: &[f64; WEIGHTED.len()]) -> [S; 2] {
        [&self.flows, &self.productions].map(|rates| integral(weights, rates))
    }
}

/// Flow and production, combined with the positive sums so that a negative production becomes zero.
#[cold]
fn mixed<S: Real>([flow, production]: [S; 2], positive: [S; 2]) -> ([S; 2], Shift<S>) {
    let zero = S::zero();
    let is_negative = production.less(zero);
    // φ with Π + φ (Π⁺ − Π) = 0
    let all = positive[1] - production;
    let has_positive = zero.less(positive[1]);
    let share = S::select(has_positive, -production / all, S::one());
    let mixed = flow + share * (positive[0] - flow);
    let guarded = [
        S::select(is_negative, mixed, flow),
        S::select(is_negative, zero, production),
    ];
    (guarded, Shift(S::select(is_negative, share, zero)))
}

/// The guarded production of a dashpot, J/K, or its heat, J.
#[inline]
pub(super) fn guarded<S: Real>(production: S) -> S {
    let is_negative = production.less(S::zero());
    S::select(is_negative, S::zero(), production)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A path between two temperatures, K, at each weighted stage.
    fn path(stages: [[f64; 2]; 8]) -> PathRates<f64> {
        PathRates::new(1.0, [&stages.map(|[a, _]| a), &stages.map(|[_, b]| b)])
    }

    /// Flow and production by both weights.
    fn sums(path: &PathRates<f64>) -> [[f64; 2]; 2] {
        [&WEIGHTS, &POSITIVE_WEIGHTS].map(|weights| path.integrals(weights))
    }

    #[test]
    fn honest_stages_pass_unchanged() {
        let path = path([[300.0, 310.0]; 8]);
        let ([flow, production], shift) = path.guarded(1.0);
        let [usual, _] = sums(&path);
        assert!(shift.is_none());
        assert_eq!(
            [flow, production].map(f64::to_bits),
            usual.map(f64::to_bits)
        );
        assert!((flow - 10.0 / 300.0).abs() < 1e-16);
    }

    // Heat that flows at the one stage whose weight is −5.8: an honest motion has no such stages.
    #[test]
    fn a_negative_production_becomes_zero_and_its_flow_is_mixed() {
        let mut stages = [[300.0, 300.0]; 8];
        stages[3] = [300.0, 330.0];
        let path = path(stages);
        let [usual, positive] = sums(&path);
        assert!(usual[1] < 0.0 && positive[1] > 0.0);
        let ([flow, production], shift) = path.guarded(1.0);
        let shifted = usual[0] + shift.of(&path.flows);
        assert!((shifted - flow).abs() <= 1e-15 * usual[0].abs());
        assert_eq!(production.to_bits(), 0.0_f64.to_bits());
        // Between the two flows, in proportion to the productions.
        let share = usual[1] / (usual[1] - positive[1]);
        let mixed = (1.0 - share) * usual[0] + share * positive[0];
        assert!(
            (flow - mixed).abs() <= 1e-15 * usual[0].abs(),
            "{flow} {mixed}"
        );
        assert!(usual[0] < flow && flow < positive[0]);
        // Only one stage has a flow, so that none is left where the production vanishes.
        assert!(flow.abs() < 1e-15);
    }

    #[test]
    fn nothing_positive_replaces_all() {
        let (counts, _) = mixed([1e-20, -1e-40], [3e-20, 0.0]);
        assert_eq!(counts.map(f64::to_bits), [3e-20, 0.0].map(f64::to_bits));
    }

    #[test]
    fn a_dashpot_never_takes_entropy() {
        assert_eq!(guarded(-1e-3_f64).to_bits(), 0.0_f64.to_bits());
        assert_eq!(guarded(1e-3_f64).to_bits(), 1e-3_f64.to_bits());
    }
}
