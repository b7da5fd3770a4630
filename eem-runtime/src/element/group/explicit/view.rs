//! Data that elements exchange with the closing of an explicit step.

use crate::element::group::explicit::stage::Stage;
use crate::element::handle::Element;
use crate::element::state::{Energy, State};
use eem_material::number::compensated::Total;
use eem_material::number::scalar::{Real, unless};

/// The state that closes a step.
#[derive(Debug)]
pub(crate) struct ClosingView<'a, S: Real, const D: usize> {
    /// Whether a component is still to be closed.
    pub(crate) open: &'a [bool],
    /// Inactive lanes of each component, whose values stay.
    pub(crate) inactive: &'a [S::Mask],
    /// Its temperatures are guesses; `close` replaces them by those found from the entropies, except at thermostats.
    pub(crate) stage: &'a mut Stage<S, D>,
    /// c and `|∂c/∂ ln θ|` per thermal slot, J/K.
    pub(crate) capacities: &'a mut [[S; 2]],
    /// The first stored entropy that differs by more than rounding from that of the temperature found for it.
    pub(crate) unkept: &'a mut Option<UnkeptEntropy>,
    /// Entropies are input, except at thermostats; energies are output.
    pub(crate) next: &'a mut State<S>,
    /// The energy of each component.
    pub(crate) energies: &'a mut [ComponentEnergy<S>],
}

/// A stored entropy that differs from `s(λ, γ, θ)`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnkeptEntropy {
    pub(crate) element: Element,
    /// The difference, and its bound for rounding, J/K.
    pub(crate) sizes: [f64; 2],
}

/// The internal energy of the elements of a component.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ComponentEnergy<S> {
    /// `Σ (ψ + θ s)`, J.
    pub(crate) value: Total<S>,
    /// `Σ (|e| + θ (|s| + c))`, J: times ε, its rounding error.
    pub(crate) magnitude: S,
    /// See [`Energy`], J.
    pub(crate) terms: S,
    pub(crate) excess: S,
}

impl<S: Real> ComponentEnergy<S> {
    /// Zero sums.
    pub(crate) fn none() -> Self {
        Self {
            value: Total::default(),
            magnitude: S::zero(),
            terms: S::zero(),
            excess: S::zero(),
        }
    }

    /// Adds the energy of an element, except in inactive lanes.
    #[inline]
    pub(crate) fn add(&mut self, inactive: S::Mask, energy: &Energy<S>) {
        let added = |value: S| unless(inactive, S::zero(), value);
        self.value.add(added(energy.value));
        self.magnitude += added(energy.magnitude);
        self.terms += added(energy.terms);
        self.excess += added(energy.excess);
    }

    /// Sets all sums to zero, except in inactive lanes.
    pub(crate) fn clear(&mut self, inactive: S::Mask) {
        let mut cleared = Self::none();
        if S::LANES > 1 {
            cleared.value = Total::select(inactive, self.value, cleared.value);
            cleared.magnitude = S::select(inactive, self.magnitude, cleared.magnitude);
            cleared.terms = S::select(inactive, self.terms, cleared.terms);
            cleared.excess = S::select(inactive, self.excess, cleared.excess);
        }
        *self = cleared;
    }
}
