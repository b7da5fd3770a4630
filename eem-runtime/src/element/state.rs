//! The state of a scene: everything a step changes, and nothing else.

use crate::algebra::vector;
use crate::element::masses::Masses;
use crate::element::meters::Meters;
use eem_material::free_energy::Caloric;
use eem_material::number::compensated::{Compensated, Sum};
use eem_material::number::digest::Digest;
use eem_material::number::scalar::Scalar;

/// Positions, momenta, viscous stretches, entropies and the accumulated balances.
///
/// Coordinates are stored node after node; viscous stretches and thermal quantities only for the
/// elements that have them.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct State {
    /// t, s.
    pub(crate) time: Sum,
    /// q, m.
    pub(crate) positions: Compensated,
    /// p, kg m/s; at anchors, that of the mass of solids there.
    pub(crate) momenta: Compensated,
    /// v, m/s, if masses couple nodes: then `p = M v` follows from them. Empty otherwise.
    #[cfg_attr(feature = "serde", serde(default = "Compensated::default"))]
    pub(crate) velocities: Compensated,
    /// γ, m.
    pub(crate) viscous: Compensated,
    /// s, J/K.
    pub(crate) entropies: Compensated,
    /// θ with S(λ, γ, θ) = s, K.
    pub(crate) temperatures: Vec<f64>,
    /// Per element of the scene; a checkpoint stores them separately.
    #[cfg_attr(feature = "serde", serde(skip, default = "Vec::new"))]
    pub(crate) energies: Vec<Energy>,
    /// `σ_r`, the entropy that each reservoir has received since the start, J/K.
    pub(crate) reservoir_entropies: Compensated,
    /// Work that loads and moved anchors have done, J.
    pub(crate) work: Sum,
    /// Heat that thermostats have given, J.
    pub(crate) heat: Sum,
    /// Entropy that thermostats have received, J/K.
    pub(crate) thermostat_entropy: Sum,
    /// Heat of dashpots in elements without temperature: it leaves the scene, J.
    pub(crate) dissipated: Sum,
    #[cfg_attr(feature = "serde", serde(default = "Meters::default"))]
    pub(crate) meters: Meters,
}

/// The internal energy of an element in a state, J.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct Energy {
    /// `ψ + θ s`.
    pub(crate) value: f64,
    /// `|ψ| + θ|s| + cθ` or, if the terms of s cancel, an eighth of `θ Σ |terms of s|`: times 64 ε, the bound for the
    /// rounding of `value` and of the temperature that is found from s.
    pub(crate) magnitude: f64,
    /// c, J/K: times ε, the error of an entropy by rounding of the temperature from which it is found.
    pub(crate) heat_capacity: f64,
    /// `|ψ| + θ|s| + cθ + Σ|f||π| + Σ|g||γ|` of this state, or a part of it.
    pub(crate) terms: f64,
    /// What the bound of the energy counts in addition to `magnitude`, J: `Σ|f||π| + Σ|g||γ|` for the rounding of the
    /// arguments of ψ; for schemes without discrete derivatives also a part for the rounding of ψ itself.
    pub(crate) excess: f64,
}

/// The fraction of the terms of an entropy that counts in the magnitude of an energy: their sum has an error of 8 ε of
/// them, and the bound of the energy is 64 ε of its magnitude.
const SHARE_OF_TERMS: f64 = 0.125;

/// The same for the terms of ψ, 16 ε of them: ψ has an error of 8 ε of its terms, and the closing adds as much.
const SHARE_OF_VALUES: f64 = 0.25;

/// The fraction of secant forces that forces reach at least, in elements without temperature: secants were at most 8.3
/// times too large in a million random steps, near the core of a Lennard-Jones spring.
const SHARE_OF_SECANTS: f64 = 0.0625;

impl Energy {
    /// The energy of an element with the free energy ψ, the temperature θ and the stored entropy s, given the caloric
    /// quantities of the model at θ.
    #[inline]
    pub(crate) fn new(psi: f64, [theta, entropy]: [f64; 2], caloric: &Caloric<f64>) -> Self {
        let terms = SHARE_OF_TERMS * theta * caloric.magnitude;
        let sizes = psi.abs() + theta * (entropy.abs() + caloric.heat_capacity);
        Self {
            value: psi + theta * entropy,
            magnitude: Scalar::maximum(sizes, terms),
            heat_capacity: caloric.heat_capacity,
            terms: sizes,
            excess: 0.0,
        }
    }

    /// The energy of an element without temperature.
    #[inline]
    pub(crate) fn without_temperature(psi: f64) -> Self {
        Self {
            value: psi,
            magnitude: psi.abs(),
            heat_capacity: 0.0,
            terms: psi.abs(),
            excess: 0.0,
        }
    }

    /// Adds `Σ|f||π| + Σ|g||γ|` of this state, J.
    #[inline]
    pub(crate) fn add_forces(&mut self, forces: f64) {
        self.terms += forces;
        self.excess += forces;
    }

    /// Adds `Σ|f||π| + Σ|g||γ|` with secant forces, J, to `excess`; to `terms` only the fraction that is certain, zero if
    /// forces depend on the temperature.
    #[inline]
    pub(crate) fn add_secants(&mut self, forces: f64, is_thermal: bool) {
        self.excess += forces;
        if !is_thermal {
            self.terms += SHARE_OF_SECANTS * forces;
        }
    }

    /// Adds what rounding does to values of ψ with terms of this magnitude, J.
    #[inline]
    pub(crate) fn add_values(&mut self, magnitude: f64) {
        self.excess += SHARE_OF_VALUES * magnitude;
    }

    /// The fields in their order.
    pub(crate) fn numbers(&self) -> [f64; 5] {
        let Self {
            value,
            magnitude,
            heat_capacity,
            terms,
            excess,
        } = *self;
        [value, magnitude, heat_capacity, terms, excess]
    }

    /// From the fields in their order.
    pub(crate) const fn of([value, magnitude, heat_capacity, terms, excess]: [f64; 5]) -> Self {
        Self {
            value,
            magnitude,
            heat_capacity,
            terms,
            excess,
        }
    }

    /// No energy.
    pub(crate) fn zero() -> Self {
        Self::of([0.0; 5])
    }
}

impl State {
    /// Finds the momenta `p = M v` from the velocities, if masses couple nodes.
    pub(crate) fn follow_velocities(&mut self, dimension: usize, masses: &Masses) {
        if !masses.are_coupled() {
            return;
        }
        let velocities = self.velocities.values();
        let momenta = &mut self.momenta;
        momenta.write(|momenta| masses.find_momenta(dimension, velocities, momenta));
    }

    /// The digest of positions, momenta and internal variables, without time, velocities, work and heat.
    pub(crate) fn digest(&self) -> Digest {
        let sums = [
            &self.positions,
            &self.momenta,
            &self.viscous,
            &self.entropies,
        ];
        Digest::of(|digest| {
            for sums in sums {
                for (value, carry) in sums.sums() {
                    digest.number(value);
                    digest.number(carry);
                }
            }
            for &theta in &self.temperatures {
                digest.number(theta);
            }
        })
    }

    /// The velocity of a node of this mass, m/s.
    #[inline]
    pub(crate) fn velocity<const D: usize>(&self, node: usize, mass: f64) -> [f64; D] {
        let velocities = self.velocities.values().as_chunks::<D>().0;
        if let Some(velocity) = velocities.get(node) {
            return *velocity;
        }
        let momentum = self.momenta.values().as_chunks::<D>().0[node];
        vector(|axis| momentum[axis] / mass)
    }

    /// Copies the accumulated sums of `old`, a state of the same scene; a step adds to them.
    #[inline]
    pub(crate) fn copy_books(&mut self, old: &Self) {
        self.time = old.time;
        self.work = old.work;
        self.heat = old.heat;
        self.thermostat_entropy = old.thermostat_entropy;
        self.dissipated = old.dissipated;
        self.reservoir_entropies.copy_from(&old.reservoir_entropies);
        self.meters.copy_from(&old.meters);
    }

    /// Copies `other`, a state of the same scene, with its energies, without allocation.
    pub(crate) fn copy_all_from(&mut self, other: &Self) {
        self.copy_from(other);
        self.energies.copy_from_slice(&other.energies);
    }

    /// Copies `other`, a state of the same scene, without allocation and without its energies.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.copy_books(other);
        self.positions.copy_from(&other.positions);
        self.momenta.copy_from(&other.momenta);
        self.velocities.copy_from(&other.velocities);
        self.viscous.copy_from(&other.viscous);
        self.entropies.copy_from(&other.entropies);
        self.temperatures.copy_from_slice(&other.temperatures);
    }
}
