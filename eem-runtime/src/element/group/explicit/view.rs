//! Data that elements exchange with the closing of an explicit step.

use crate::element::group::explicit::stage::{Place, Stage};
use crate::element::handle::Element;
use crate::element::state::{Energy, State};
use eem_material::number::compensated::Total;

/// The state that closes a step.
#[derive(Debug)]
pub(crate) struct ClosingView<'a, const D: usize> {
    /// Whether a component is still to be closed.
    pub(crate) open: &'a [bool],
    pub(crate) places: &'a [Place<D>],
    /// Its temperatures are guesses; `close` replaces them by those found from the entropies, except at thermostats.
    pub(crate) stage: &'a mut Stage,
    /// Per thermal slot.
    pub(crate) slots: &'a mut [Caloric],
    /// The first stored entropy that differs by more than rounding from that of the temperature found for it.
    pub(crate) unkept: &'a mut Option<UnkeptEntropy>,
    /// Entropies are input, except at thermostats; energies are output.
    pub(crate) next: &'a mut State,
    /// The energy of each component.
    pub(crate) energies: &'a mut [ComponentEnergy],
}

/// What the closing of a step knows of a thermal slot, J/K.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Caloric {
    /// c and `|∂c/∂ ln θ|`.
    pub(crate) capacity: f64,
    pub(crate) bend: f64,
    /// The entropy that its element has produced itself in this step.
    pub(crate) produced: f64,
}

/// A stored entropy that differs from `s(λ, γ, θ)`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnkeptEntropy {
    pub(crate) element: Element,
    /// The difference, and its bound for rounding, J/K.
    pub(crate) sizes: [f64; 2],
}

/// The internal energy of the elements of a component.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ComponentEnergy {
    /// `Σ (ψ + θ s)`, J.
    pub(crate) value: Total,
    /// `Σ (|e| + θ (|s| + c))`, J: times ε, its rounding error.
    pub(crate) magnitude: f64,
    /// See [`Energy`], J.
    pub(crate) terms: f64,
    pub(crate) excess: f64,
}

impl ComponentEnergy {
    /// Adds the energy of an element.
    #[inline]
    pub(crate) fn add(&mut self, energy: &Energy) {
        self.value.add(energy.value);
        self.magnitude += energy.magnitude;
        self.terms += energy.terms;
        self.excess += energy.excess;
    }
}
