//! The state of a scene: everything a step changes, and nothing else.

use crate::compensated::{Compensated, Sum};
use crate::scalar::Real;

/// Positions, momenta, viscous stretches, entropies and what has been booked.
///
/// Coordinates are stored node after node; viscous stretches and thermal quantities only for the
/// elements that have them.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct State<S> {
    /// t, s.
    pub(crate) time: Sum<S>,
    /// q, m.
    pub(crate) positions: Compensated<S>,
    /// p, kg m/s; zero for anchors.
    pub(crate) momenta: Compensated<S>,
    /// γ, m.
    pub(crate) viscous: Compensated<S>,
    /// s, J/K.
    pub(crate) entropies: Compensated<S>,
    /// θ with S(λ, γ, θ) = s, K.
    pub(crate) temperatures: Vec<S>,
    /// `σ_r` since the start, J/K.
    pub(crate) reservoir_entropies: Compensated<S>,
    /// Work that loads and moved anchors have done, J.
    pub(crate) work: Sum<S>,
    /// Heat that thermostats have given, J.
    pub(crate) heat: Sum<S>,
    /// Entropy that thermostats have received, J/K.
    pub(crate) thermostat_entropy: Sum<S>,
    /// Heat that dashpots without temperature gave to nobody in the scene, J.
    pub(crate) dissipated: Sum<S>,
    /// What the start of the next step is extrapolated from.
    pub(crate) past: Past<S>,
}

/// The forces of the last steps. They decide where Newton's method starts, and nothing else.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
pub(crate) struct Past<S> {
    /// `Δp/h` of the last step and of the one before, N; zero before the first.
    pub(crate) forces: [Vec<S>; 2],
    /// By how much each forecast has been wrong, `Σ |ΔF/m|²`, the last steps counting most.
    pub(crate) errors: [S; 3],
}

/// How the force of a step is foretold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Forecast {
    /// None: free flight.
    Nothing,
    /// That of the last step.
    Constant,
    /// On the line through those of the last two steps.
    Linear,
}

impl Forecast {
    /// All of them.
    pub(crate) const ALL: [Self; 3] = [Self::Nothing, Self::Constant, Self::Linear];

    /// The force, given that of the last step and of the one before.
    #[inline]
    pub(crate) fn of<S: Real>(self, last: S, before: S) -> S {
        match self {
            Self::Nothing => S::zero(),
            Self::Constant => last,
            Self::Linear => last + last - before,
        }
    }

    /// The same as weights of the two forces.
    pub(crate) fn weights<S: Real>(self) -> [S; 2] {
        match self {
            Self::Nothing => [0.0, 0.0],
            Self::Constant => [1.0, 0.0],
            Self::Linear => [2.0, -1.0],
        }
        .map(S::from_f64)
    }
}

impl<S: Real> Past<S> {
    /// Nothing has happened yet.
    pub(crate) fn none(coordinates: usize) -> Self {
        let zeros = vec![S::zero(); coordinates];
        Self {
            forces: [zeros.clone(), zeros],
            errors: [S::zero(); 3],
        }
    }

    /// The forecast that has been best.
    pub(crate) fn best(&self) -> Forecast {
        match self.errors {
            [nothing, constant, linear] if linear < constant && linear < nothing => {
                Forecast::Linear
            }
            [nothing, constant, _] if constant < nothing => Forecast::Constant,
            _ => Forecast::Nothing,
        }
    }

    /// Takes over `other`, without allocation.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        for (own, other) in self.forces.iter_mut().zip(&other.forces) {
            own.copy_from_slice(other);
        }
        self.errors = other.errors;
    }
}

impl<S: Real> State<S> {
    /// Takes over what has been booked in `old`, a state of the same scene; a step adds to it.
    pub(crate) fn copy_books(&mut self, old: &Self) {
        self.time = old.time;
        self.work = old.work;
        self.heat = old.heat;
        self.thermostat_entropy = old.thermostat_entropy;
        self.dissipated = old.dissipated;
        self.reservoir_entropies.copy_from(&old.reservoir_entropies);
    }

    /// Takes over `other`, a state of the same scene, without allocation.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.copy_books(other);
        self.positions.copy_from(&other.positions);
        self.momenta.copy_from(&other.momenta);
        self.viscous.copy_from(&other.viscous);
        self.entropies.copy_from(&other.entropies);
        self.temperatures.copy_from_slice(&other.temperatures);
        self.past.copy_from(&other.past);
    }
}
