//! What elements see of an explicit scheme.

use crate::element::handle::Element;
use crate::element::layout::Layout;
use crate::element::state::{Energy, State};
use eem_material::number::compensated::Total;
use eem_material::number::scalar::{Real, unless};

/// Where the parts of a stage vector begin: positions, momenta, viscous stretches, temperatures of thermal
/// slots and then of reservoirs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Offsets {
    pub(crate) momenta: usize,
    pub(crate) viscous: usize,
    pub(crate) temperatures: usize,
    pub(crate) reservoirs: usize,
    pub(crate) size: usize,
    /// How long vectors are, with zeros at their ends.
    pub(crate) padded: usize,
}

impl Offsets {
    /// The length of vectors is a multiple of this, for the registers of the machine.
    pub(crate) const WIDTH: usize = 4;

    /// With so many coordinates and reservoirs.
    pub(crate) fn new(coordinates: usize, layout: &Layout, reservoirs: usize) -> Self {
        let viscous = 2 * coordinates;
        let temperatures = viscous + layout.viscous;
        let size = temperatures + layout.thermal + reservoirs;
        Self {
            momenta: coordinates,
            viscous,
            temperatures,
            reservoirs: temperatures + layout.thermal,
            size,
            padded: size.next_multiple_of(Self::WIDTH),
        }
    }
}

/// The state of a scene at a stage.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StageView<'a, S> {
    pub(crate) offsets: &'a Offsets,
    /// q, p, γ and θ, place after place and slot after slot.
    pub(crate) y: &'a [S],
    /// Whether a thermostat gives the temperature, per thermal slot; empty without thermostats.
    pub(crate) held: &'a [bool],
}

/// The rates of a stage.
#[derive(Debug)]
pub(crate) struct StageRates<'a, S> {
    /// Of the stage vector. On entry velocities, loads and the heat that flows into each thermal slot, W; then
    /// with the forces of elements, `γ̇` and `θ̇`, which is zero where the temperature is held.
    pub(crate) row: &'a mut [S],
    /// `g γ̇` of each dashpot, W.
    pub(crate) powers: &'a mut [S],
    /// `f λ̇` and the heat that flows in, of each thermal slot, W; empty without thermostats.
    pub(crate) supply: &'a mut [S],
}

/// The state that closes a step.
#[derive(Debug)]
pub(crate) struct ClosingView<'a, S: Real> {
    /// Whether a component is still to be closed.
    pub(crate) open: &'a [bool],
    /// Of several numbers in a component, those that keep what they have.
    pub(crate) waits: &'a [S::Mask],
    pub(crate) positions: &'a [S],
    pub(crate) viscous: &'a [S],
    /// θ per thermal slot: guesses that become temperatures, except where it is held, K.
    pub(crate) temperatures: &'a mut [S],
    pub(crate) held: &'a [bool],
    /// c per thermal slot, J/K.
    pub(crate) capacities: &'a mut [S],
    /// `|∂c/∂ ln θ|` per thermal slot, J/K.
    pub(crate) bends: &'a mut [S],
    /// The first entropy that is not that of the temperature found for it.
    pub(crate) unkept: &'a mut Option<UnkeptEntropy>,
    /// Its entropies are given, except where the temperature is held; its energies are written.
    pub(crate) next: &'a mut State<S>,
    /// Per component.
    pub(crate) energies: &'a mut [ComponentEnergy<S>],
}

impl<S: Real> ClosingView<'_, S> {
    /// Writes θ, c and `|∂c/∂ ln θ|` of a thermal slot, except for numbers that wait.
    #[inline]
    pub(crate) fn keep_heat(
        &mut self,
        slot: usize,
        waits: S::Mask,
        [theta, capacity, bend]: [S; 3],
    ) {
        self.temperatures[slot] = unless(waits, self.temperatures[slot], theta);
        self.capacities[slot] = unless(waits, self.capacities[slot], capacity);
        self.bends[slot] = unless(waits, self.bends[slot], bend);
    }
}

/// An entropy that is kept and differs from `s(λ, γ, θ)`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct UnkeptEntropy {
    pub(crate) element: Element,
    /// The difference, and what rounding explains of it, J/K.
    pub(crate) sizes: [f64; 2],
}

/// The internal energy of the elements of a component.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ComponentEnergy<S> {
    /// `Σ (ψ + θ s)`, J.
    pub(crate) value: Total<S>,
    /// `Σ (|e| + θ (|s| + c))`, J: times ε, what rounding does to it.
    pub(crate) magnitude: S,
    /// See [`Energy`], J.
    pub(crate) terms: S,
    pub(crate) excess: S,
}

impl<S: Real> ComponentEnergy<S> {
    /// Of no elements.
    pub(crate) fn none() -> Self {
        Self {
            value: Total::default(),
            magnitude: S::zero(),
            terms: S::zero(),
            excess: S::zero(),
        }
    }

    /// Adds the energy of an element, except for numbers that wait.
    #[inline]
    pub(crate) fn add(&mut self, waits: S::Mask, energy: &Energy<S>) {
        let added = |value: S| unless(waits, S::zero(), value);
        self.value.add(added(energy.value));
        self.magnitude += added(energy.magnitude);
        self.terms += added(energy.terms);
        self.excess += added(energy.excess);
    }

    /// Of no elements, except for numbers that wait.
    pub(crate) fn clear(&mut self, waits: S::Mask) {
        let mut cleared = Self::none();
        if S::LANES > 1 {
            cleared.value = Total::select(waits, self.value, cleared.value);
            cleared.magnitude = S::select(waits, self.magnitude, cleared.magnitude);
            cleared.terms = S::select(waits, self.terms, cleared.terms);
            cleared.excess = S::select(waits, self.excess, cleared.excess);
        }
        *self = cleared;
    }
}

/// How strongly a node is held by its elements.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NodeStiffness<S> {
    pub(crate) nodes: [usize; 2],
    /// The stiffness between them at constant entropy and viscous stretch, N/m.
    pub(crate) stiffness: S,
    /// The thermal slot and its heat capacity, J/K.
    pub(crate) capacity: Option<(usize, S)>,
    /// The largest rate of relaxation of a dashpot, 1/s.
    pub(crate) relaxation: S,
}

/// Where nodes are in the vectors of stages.
pub(crate) trait PlaceOf {
    /// The place of a node of an element of a component.
    fn place_of(&self, component: u32, node: u32) -> u32;
}
