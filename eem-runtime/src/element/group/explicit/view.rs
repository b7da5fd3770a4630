//! What elements see of an explicit scheme.

use crate::element::state::State;
use crate::number::compensated::Total;
use crate::number::scalar::Real;

/// The state of a scene at a stage.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StageView<'a, S> {
    /// q and its rate, place after place, m and m/s.
    pub(crate) positions: &'a [S],
    pub(crate) velocities: &'a [S],
    /// γ, m.
    pub(crate) viscous: &'a [S],
    /// θ per thermal slot, K.
    pub(crate) temperatures: &'a [S],
    /// Whether a thermostat gives the temperature, per thermal slot; empty without thermostats.
    pub(crate) held: &'a [bool],
}

/// The rates of a stage.
#[derive(Debug)]
pub(crate) struct StageRates<'a, S> {
    /// Forces on the places; those of elements are added, N.
    pub(crate) forces: &'a mut [S],
    /// `γ̇`, m/s.
    pub(crate) creep: &'a mut [S],
    /// On entry the heat that flows into each thermal slot, W; then `θ̇`, K/s, zero where it is held.
    pub(crate) heating: &'a mut [S],
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
    pub(crate) positions: &'a [S],
    pub(crate) viscous: &'a [S],
    /// θ per thermal slot: guesses that become temperatures, except where it is held, K.
    pub(crate) temperatures: &'a mut [S],
    pub(crate) held: &'a [bool],
    /// c per thermal slot, J/K.
    pub(crate) capacities: &'a mut [S],
    /// Its entropies are given, except where the temperature is held; its energies are written.
    pub(crate) next: &'a mut State<S>,
    /// Per component.
    pub(crate) energies: &'a mut [ComponentEnergy<S>],
}

/// The internal energy of the elements of a component.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ComponentEnergy<S> {
    /// `Σ (ψ + θ s)`, J.
    pub(crate) value: Total<S>,
    /// `Σ (|e| + θ (|s| + c))`, J: times ε, what rounding does to it.
    pub(crate) magnitude: S,
}

impl<S: Real> ComponentEnergy<S> {
    /// Of no elements.
    pub(crate) fn none() -> Self {
        Self {
            value: Total::new(),
            magnitude: S::zero(),
        }
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
