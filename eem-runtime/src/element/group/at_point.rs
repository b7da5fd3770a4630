//! What only a rule that looks at one point of the step needs to remember of an element.

use crate::element::kinematics::Arms;
use eem_material::free_energy::{Array, FreeEnergy};
use eem_material::number::scalar::Real;

/// What a rule that looks at one point needs to remember of an element; `V` is per variable, `A` per
/// arm.
#[derive(Clone, Copy, Debug)]
pub(super) struct PointMemory<S, V, A> {
    /// What the old state alone contributes to the rates of the internal variables.
    pub(super) old_rates: V,
    /// For a rule in temperature: what the old state contributes to θ̇, K/s.
    pub(super) old_heating: S,
    /// The trial Δs, before the last correction, and the correction, J/K.
    pub(super) entropy_change: S,
    pub(super) previous_entropy_change: S,
    pub(super) entropy_correction: S,
    /// The derivative of the Δs of the response by the variables.
    pub(super) entropy_by: V,
    /// For a rule in temperature: the derivative of Δs by the new arms through the increments of
    /// the measures.
    pub(super) by_increment: A,
}

/// The same of an element with this model and these kinematics.
pub(super) type MemoryAtPoint<S, M, K, const D: usize> =
    PointMemory<S, <M as FreeEnergy<S>>::Variables, Arms<K, S, D>>;

impl<S: Real, V: Array<S>, A> PointMemory<S, V, A> {
    /// Before the first step, of an element whose arms are all zero.
    pub(super) fn zero(arms: A) -> Self {
        Self {
            old_rates: V::filled(S::zero()),
            old_heating: S::zero(),
            entropy_change: S::zero(),
            previous_entropy_change: S::zero(),
            entropy_correction: S::zero(),
            entropy_by: V::filled(S::zero()),
            by_increment: arms,
        }
    }
}
