//! Data that groups and solvers exchange.

use crate::algebra::system::LinearSystem;
use crate::algebra::vector;
use crate::element::conduction::{Conduction, InterfaceTemperatures};
use crate::element::conjugates::Placement;
use crate::element::ends::Ends;
use crate::element::layout::Layout;
use crate::element::loads::StepLoads;
use crate::element::masses::Masses;
use crate::element::phase::Phase;
use crate::element::state::State;
use crate::element::tableau::MOST_STAGES;
use eem_material::number::compensated::Total;

/// Data common to all elements during one step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepView<'a> {
    /// The variables that change: all, or those of one split step.
    pub(crate) phase: Phase,
    /// h, s, and 1/h.
    pub(crate) step: f64,
    pub(crate) per_step: f64,
    /// The old state.
    pub(crate) state: &'a State,
    pub(crate) conduction: &'a Conduction,
    pub(crate) loads: &'a StepLoads,
    /// Loads at the times of the stages; empty for a scheme without stages.
    pub(crate) stages: &'a [StepLoads],
    /// m per node, kg; `None` for anchors.
    pub(crate) masses: &'a Masses,
}

impl StepView<'_> {
    /// The old velocity of a node; that of an anchor is its mean over the step, m/s.
    pub(super) fn old_velocity<const D: usize>(&self, node: usize) -> [f64; D] {
        match self.masses.get(node) {
            Some(mass) => self.state.velocity(node, mass),
            None => self
                .loads
                .motion(node)
                .map(|motion: f64| motion / self.step),
        }
    }

    /// The change of the velocity of a moved anchor in the step, where masses couple nodes, m/s.
    pub(crate) fn change_of_speed<const D: usize>(&self, node: usize) -> [f64; D] {
        let speed = self.loads.speed::<D>(node);
        let old = self.state.velocities.point::<D>(node)[0];
        vector(|axis| speed[axis] - old[axis])
    }

    /// The time during which internal variables evolve, s.
    #[inline]
    pub(super) fn thermal_step(&self) -> f64 {
        if self.phase.heats() { self.step } else { 0.0 }
    }

    /// The temperatures prescribed on a thermal slot at the stages, or at the supports of a path, K.
    pub(super) fn prescribed_at_stages(&self, slot: usize) -> Option<[f64; MOST_STAGES]> {
        let mut temperatures = [1.0; MOST_STAGES];
        for (temperature, loads) in temperatures.iter_mut().zip(self.stages) {
            *temperature = loads.prescribed(slot)?.end;
        }
        Some(temperatures)
    }

    /// The temperature prescribed on a thermal slot, at the time that a scheme with this placement uses.
    #[inline]
    pub(super) fn prescribed(&self, slot: usize, at: Placement) -> Option<f64> {
        let prescribed = self.loads.prescribed(slot)?;
        Some(match at {
            Placement::Ends | Placement::End => prescribed.end,
            Placement::Middle | Placement::Start => prescribed.middle,
        })
    }
}

/// The global part of the new state that Newton's method tries.
#[derive(Clone, Debug)]
pub(crate) struct Trial<const D: usize> {
    /// Number of sets of unknowns, stored one after the other: one, or one per stage.
    pub(crate) sets: usize,
    /// `q − q⁰` of all nodes, m.
    pub(crate) displacements: Vec<[f64; D]>,
    /// Their compensations of rounding, m.
    pub(crate) carries: Vec<[f64; D]>,
    /// The interface temperatures Θ = θ*; unknowns where the slot is coupled.
    pub(crate) interface: InterfaceTemperatures,
    /// Elements use the [starting form](crate::element::conjugates::Start::starting_form) of their scheme, if
    /// it has one.
    pub(crate) is_start: bool,
}

impl<const D: usize> Trial<D> {
    /// At rest, for these numbers of sets of unknowns, nodes and interface temperatures.
    pub(crate) fn new(sets: usize, nodes: usize, interface: usize) -> Self {
        let points = vec![[0.0; D]; sets * nodes];
        Self {
            sets,
            displacements: points.clone(),
            carries: points,
            interface: InterfaceTemperatures::new(sets * interface),
            is_start: false,
        }
    }

    /// The index of the first node of a set.
    pub(crate) fn first_of_set(&self, set: usize) -> usize {
        set * (self.displacements.len() / self.sets)
    }

    /// The displacements of a set, m.
    pub(crate) fn displacements_of_set(&self, set: usize) -> &[[f64; D]] {
        &self.displacements[self.first_of_set(set)..self.first_of_set(set + 1)]
    }
}

/// The trial of a step, as elements see it.
pub(super) type At<'a, const D: usize> = (&'a StepView<'a>, &'a Trial<D>);

/// Sums over elements, in twice the precision.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ElementTotals {
    /// `Σ (ψ + θ s)` with the stored entropies, J.
    pub(crate) energy: Total,
    /// `Σ s` as stored, with the compensations, J/K.
    pub(crate) entropy: Total,
    /// `Σ s(λ, γ, θ)`, J/K.
    pub(crate) entropy_of_state: Total,
}

impl ElementTotals {
    /// Zero sums.
    pub(crate) fn new() -> Self {
        let [energy, entropy, entropy_of_state] = [Total::default(); 3];
        Self {
            energy,
            entropy,
            entropy_of_state,
        }
    }
}

/// One element in a state, from the definitions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ElementView {
    /// First measure: the stretch of a spring, m.
    pub(crate) measure: f64,
    /// First component of ∂ψ/∂π: the force of a spring, N.
    pub(crate) force: f64,
    /// `ψ + θ s`, J.
    pub(crate) internal_energy: f64,
}

/// Derivatives of the energy of an element, and forces and viscosities of its dashpots.
#[derive(Clone, Debug)]
pub(crate) struct ElementGeneric {
    /// `(coordinate, ∂e/∂q)`, N.
    pub(crate) forces: Vec<(usize, f64)>,
    /// `(slot, g, η)`: dashpot force, N, and viscosity, N s/m.
    pub(crate) dashpots: Vec<(usize, f64, f64)>,
    /// `(η, ∂λ/∂q)` of a Kelvin–Voigt dashpot, N s/m, with its coordinates.
    pub(crate) drags: Vec<(f64, Vec<(usize, f64)>)>,
    /// `(slot, θ)`, K, if the element has a temperature.
    pub(crate) temperature: Option<(usize, f64)>,
    /// The derivatives of its entropy; `None` for a step.
    pub(crate) entropy: Option<EntropySlopes>,
}

/// The derivatives of the entropy of an element in a state.
#[derive(Clone, Debug)]
pub(crate) struct EntropySlopes {
    /// Its thermal slot.
    pub(crate) slot: usize,
    /// `(coordinate, ∂s/∂q)`, J/(K m).
    pub(crate) by_position: Vec<(usize, f64)>,
    /// `(slot, ∂s/∂γ)`.
    pub(crate) by_viscous: Vec<(usize, f64)>,
    /// `∂s/∂θ`, J/K².
    pub(crate) by_temperature: f64,
}

/// The contribution of the old state to the nodes.
#[derive(Debug)]
pub(crate) struct Old<'a, const D: usize> {
    /// The part of the nodal forces that depends on it only, N.
    pub(crate) force: &'a mut [[f64; D]],
    /// The unit of length of each node: the shortest measure of its elements, m.
    pub(crate) lengths: &'a mut [f64],
    /// The history from which γ and θ of the trial are predicted; `None` if the trial starts at the old ones.
    pub(crate) before: Option<Before<'a>>,
    /// Whether exact schemes, too, correct temperatures by factors, as classical ones do: then Newton's method goes other ways.
    pub(crate) by_factors: bool,
}

/// The internal variables at the start of the last step, from which those of the next one are predicted.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Before<'a> {
    /// γ, m, per viscous stretch.
    pub(crate) viscous: &'a [f64],
    /// θ, K, per thermal slot.
    pub(crate) temperatures: &'a [f64],
    /// The size of the next step over that of the last one.
    pub(crate) ratio: f64,
}

/// The gradient along which the forces act.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Along {
    /// That of the scheme, as the force `A q_m`.
    Secant,
    /// That of the scheme.
    Scheme,
    /// That of the new configuration.
    Gradient,
    /// That of a stage, with the forces found there.
    Stage(usize),
}

/// The nodes and state indices of all elements, from which a group takes its own.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed<'a> {
    pub(crate) nodes: &'a Ends,
    pub(crate) layout: &'a Layout,
}

/// The data from which the matrix indices of an element follow.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sites<'a, const D: usize> {
    pub(crate) layout: &'a Layout,
    pub(crate) conduction: &'a Conduction,
    /// The system of an iteration.
    pub(crate) tangent: &'a LinearSystem<1>,
    /// The system that closes a step stage by stage.
    pub(crate) secant: Option<&'a LinearSystem<D>>,
    /// The sets of unknowns to which rows and columns belong.
    pub(crate) sets: [usize; 2],
}

impl<const D: usize> Sites<'_, D> {
    /// The same for the rows of one set and the columns of another.
    pub(crate) fn of_sets(&self, sets: [usize; 2]) -> Self {
        Self { sets, ..*self }
    }

    /// The row of an unknown of the layout in the tangent.
    pub(crate) fn row(&self, unknown: Option<usize>) -> usize {
        let first = self.sets[0] * self.layout.unknowns;
        self.tangent.row(unknown.map(|unknown| unknown + first))
    }

    /// The index of the entry of two unknowns of the layout in the tangent.
    pub(crate) fn place(&self, row: Option<usize>, column: Option<usize>) -> usize {
        let [down, right] = self.sets.map(|set| set * self.layout.unknowns);
        let (row, column) = (
            row.map(|row| row + down),
            column.map(|column| column + right),
        );
        self.tangent.place(row, column)
    }

    /// The index of the entry of two masses in the secant matrix, if there is one.
    pub(crate) fn secant_place(&self, row: Option<usize>, column: Option<usize>) -> usize {
        self.secant.map_or(0, |secant| secant.place(row, column))
    }
}
