//! The entropy production of paths of heat and dashpots in a step, never negative.
//!
//! The weights of order 8 are not all positive, so that the sum of productions that are positive at every
//! stage may be negative where it is below its own error. It is then combined with the sums of positive weights so that
//! the result is zero.

use super::tableau::{POSITIVE_WEIGHTS, WEIGHTED, WEIGHTS};

/// A number for each stage that has weights.
pub(super) type PerWeight = [f64; WEIGHTED.len()];

/// The flow of entropy along a path of heat, and its entropy production, at the stages that have weights, W/K.
#[derive(Clone, Copy, Debug)]
pub(super) struct PathRates {
    /// `X/θ_a` and `X (θ_b − θ_a)/(θ_a θ_b)` with `X = κ (θ_b − θ_a)`.
    flows: PerWeight,
    productions: PerWeight,
}

/// The change of the integral of some rates by a shift from the usual weights towards the positive ones.
pub(super) fn shifted(shift: f64, rates: &PerWeight) -> f64 {
    shift * (integral(&POSITIVE_WEIGHTS, rates) - integral(&WEIGHTS, rates))
}

/// `Σ w x`.
#[inline]
fn integral(weights: &[f64; WEIGHTED.len()], rates: &PerWeight) -> f64 {
    let terms = weights.iter().zip(rates);
    terms.fold(0.0, |sum, (&weight, &rate)| sum + weight * rate)
}

/// `∫ (x_b − x_a)` in units of the step.
pub(super) fn mean_drop([a, b]: [&PerWeight; 2]) -> f64 {
    let mut drops = [0.0; _];
    for (drop, (&a, &b)) in drops.iter_mut().zip(a.iter().zip(b)) {
        *drop = b - a;
    }
    integral(&WEIGHTS, &drops)
}

impl PathRates {
    /// Of a path of this conductance, W/K, between two temperatures, K.
    #[inline]
    pub(super) fn new(conductance: f64, [a, b]: [&PerWeight; 2]) -> Self {
        let (mut flows, mut productions) = ([0.0; _], [0.0; _]);
        for stage in 0..WEIGHTED.len() {
            let drop = b[stage] - a[stage];
            flows[stage] = conductance * drop * a[stage].recip();
            productions[stage] = flows[stage] * drop * b[stage].recip();
        }
        Self { flows, productions }
    }

    /// The flow and the guarded production in a step of the size h, J/K, and by how much of the way from the usual weights to
    /// the positive ones the guard has shifted them: zero where it did nothing.
    #[inline]
    pub(super) fn guarded(&self, h: f64) -> ([f64; 2], f64) {
        let usual = self.integrals(&WEIGHTS);
        let (counting, shift) = if usual[1] < 0.0 {
            mixed(usual, self.integrals(&POSITIVE_WEIGHTS))
        } else {
            (usual, 0.0)
        };
        ([h * counting[0], h * counting[1]], shift)
    }

    #[inline]
    fn integrals(&self, weights: &[f64; WEIGHTED.len()]) -> [f64; 2] {
        [
            integral(weights, &self.flows),
            integral(weights, &self.productions),
        ]
    }
}

/// Flow and a negative production, combined with the positive sums so that the production becomes zero.
#[cold]
fn mixed([flow, production]: [f64; 2], positive: [f64; 2]) -> ([f64; 2], f64) {
    // φ with Π + φ (Π⁺ − Π) = 0
    let all = positive[1] - production;
    let has_positive = positive[1] > 0.0;
    let share = if has_positive { -production / all } else { 1.0 };
    let mixed = flow + share * (positive[0] - flow);
    ([mixed, 0.0], share)
}

/// The guarded production of a dashpot, J/K, or its heat, J.
#[inline]
pub(super) fn guarded(production: f64) -> f64 {
    if production < 0.0 { 0.0 } else { production }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A path between two temperatures, K, at each weighted stage.
    fn path(stages: [[f64; 2]; 8]) -> PathRates {
        PathRates::new(1.0, [&stages.map(|[a, _]| a), &stages.map(|[_, b]| b)])
    }

    /// Flow and production by both weights.
    fn sums(path: &PathRates) -> [[f64; 2]; 2] {
        [&WEIGHTS, &POSITIVE_WEIGHTS].map(|weights| path.integrals(weights))
    }

    #[test]
    fn honest_stages_pass_unchanged() {
        let path = path([[300.0, 310.0]; 8]);
        let ([flow, production], shift) = path.guarded(1.0);
        let [usual, _] = sums(&path);
        let found = [flow, production, shift].map(f64::to_bits);
        assert_eq!(found, [usual[0], usual[1], 0.0].map(f64::to_bits));
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
        let shifted = usual[0] + shifted(shift, &path.flows);
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
