//! The entropies of a step: integrals over its stages, with a guard for the second law.
//!
//! Integrals of a step, J/K: A, the entropy that body 0 gets by conduction; Π, the entropy that conduction produces;
//! D, the entropy that a dashpot produces. Body 0 takes A + D, body 1 takes Π − A. The rates of Π and D are not
//! negative at any stage, but some weights of order 8 are. An integral Π < 0 is therefore blended with the one by
//! positive weights until it is zero, and A with it; an integral D < 0 is set to zero, which is the same blend.

use super::model::Pendulum;
use super::stages::Stages;

/// A.
pub(super) const GIVEN: usize = 0;
/// Π.
pub(super) const PRODUCED: usize = 1;
/// D of the first spring; there is no such integral without dashpots.
pub(super) const DASHPOT: usize = 2;

/// The entropies of the two bodies, each the sum of a value and a carry that holds what rounding took from it, J/K.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entropies {
    pub(super) value: [f64; 2],
    carry: [f64; 2],
}

impl Entropies {
    pub(super) const fn new(value: [f64; 2]) -> Self {
        Self {
            value,
            carry: [0.0; 2],
        }
    }

    #[inline(always)]
    pub(super) fn add(&mut self, body: usize, change: f64) {
        let change = change + self.carry[body];
        let before = self.value[body];
        self.value[body] = before + change;
        self.carry[body] = change - (self.value[body] - before);
    }
}

/// What a step produces, J/K; none of it is negative.
#[derive(Clone, Copy, Debug)]
pub(super) struct Production {
    /// Π.
    pub(super) by_conduction: f64,
    /// D.
    pub(super) by_dashpot: f64,
}

/// Adds a step's entropies to those of the bodies. The integrals are guarded first.
#[inline(always)]
pub(super) fn book<C: Pendulum<N, X>, const N: usize, const X: usize>(
    mut integrals: [f64; X],
    stages: &Stages<N, X>,
    h: f64,
    entropies: &mut Entropies,
) -> Production {
    if integrals[PRODUCED] < 0.0 {
        let [given, produced] = [GIVEN, PRODUCED].map(|i| stages.positive_change(h, i));
        let lacking = -integrals[PRODUCED];
        let blend = if produced > 0.0 {
            lacking / (produced + lacking)
        } else {
            1.0
        };
        integrals[GIVEN] += blend * (given - integrals[GIVEN]);
        integrals[PRODUCED] = 0.0;
    }
    let by_conduction = integrals[PRODUCED];
    let mut change = [integrals[GIVEN], by_conduction - integrals[GIVEN]];
    let mut by_dashpot = 0.0;
    if C::DASHPOTS > 0 {
        by_dashpot = integrals[DASHPOT].max(0.0);
        change[0] += by_dashpot;
    }
    entropies.add(0, change[0]);
    entropies.add(1, change[1]);
    Production {
        by_conduction,
        by_dashpot,
    }
}

#[cfg(test)]
mod tests {
    use super::{Entropies, GIVEN, PRODUCED, book};
    use crate::prototype::Krueger;
    use crate::prototype::stages::Stages;

    /// Production at the eighth stage only, whose weight is −5.8.
    #[test]
    fn conduction_that_would_destroy_entropy_is_guarded() {
        let mut stages = Stages::<14, 2>::new();
        stages.x[7][GIVEN] = 3.0;
        stages.x[7][PRODUCED] = 1.0;
        stages.x[8][GIVEN] = 1.0;
        let (_, integrals) = stages.changes(0.5);
        assert!(integrals[PRODUCED] < -2.0);
        let positive = [GIVEN, PRODUCED].map(|i| stages.positive_change(0.5, i));
        assert!(positive[PRODUCED] > 0.0);

        let mut entropies = Entropies::new([1.0, 2.0]);
        let production = book::<Krueger, 14, 2>(integrals, &stages, 0.5, &mut entropies);
        // The blend with Π = 0, on the line through (A, Π) by both weights.
        let blend = -integrals[PRODUCED] / (positive[PRODUCED] - integrals[PRODUCED]);
        let given = (1.0 - blend) * integrals[GIVEN] + blend * positive[GIVEN];
        assert_eq!(production.by_conduction.to_bits(), 0.0_f64.to_bits());
        assert!((entropies.value[0] - (1.0 + given)).abs() < 1e-14);
        assert!((entropies.value[1] - (2.0 - given)).abs() < 1e-14);
    }
}
