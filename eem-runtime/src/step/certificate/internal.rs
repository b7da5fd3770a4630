//! What the energies of the stored states contribute to the certificate of a step.

use crate::element::state::State;
use eem_material::number::scalar::Real;

/// The change of the internal energy in a step, from values at both ends.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Internal<S> {
    /// `Σ Δe + Σ θ_r Δσ_r + heat lost − heat`, J.
    pub(super) change: S,
    /// The magnitude of its terms at both ends, J.
    pub(super) magnitude: S,
    /// `Σ (|ψ| + θ|s| + cθ + Σ|f||π| + Σ|g||γ|)` of both ends, J.
    pub(super) terms: S,
    /// The part of them that neither `magnitude` nor the amplitude of forces has, J.
    pub(super) excess: S,
}

impl<S: Real> Internal<S> {
    /// Between two states.
    pub(crate) fn new(reservoirs: &[S], [old, next]: [&State<S>; 2]) -> Self {
        let zero = S::zero();
        let (mut change, mut magnitude, mut terms, mut excess) = (zero, zero, zero, zero);
        for (old, new) in old.energies.iter().zip(&next.energies) {
            change += new.value - old.value;
            magnitude += old.magnitude + new.magnitude;
            terms += old.terms + new.terms;
            excess += old.excess + new.excess;
        }
        for (index, &theta) in reservoirs.iter().enumerate() {
            let sums = &next.reservoir_entropies;
            change += theta * sums.change(index, &old.reservoir_entropies);
        }
        let heat = next.heat.change(old.heat);
        change += next.dissipated.change(old.dissipated) - heat;
        Self {
            change,
            magnitude: magnitude + heat.abs(),
            terms,
            excess,
        }
    }
}
