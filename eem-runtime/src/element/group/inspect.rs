//! Values of a point in a state, computed from the definitions and not taken from the last step.

use super::point::Point;
use crate::element::conjugates::Infeasible;
use crate::element::error::StateError;
use crate::element::handle::Element;
use crate::element::kinematics::MeasureSet;
use crate::element::state::{Energy, State};
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;
use eem_material::number::digest::Digest;
use eem_material::tabled::Tabled;

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Finds the entropy of an initial state, whose variables are given; returns its energy.
    pub(super) fn initialize(
        &mut self,
        x: &A::Variables,
        state: &mut State,
    ) -> Result<Energy, StateError> {
        let slot = self.slots().thermal;
        let theta = slot.map_or(0.0, |slot| state.temperatures[slot]);
        self.find_viscosities(theta)?;
        self.find_drag_viscosity(theta)?;
        let caloric = self.model.caloric(x);
        let energy = self.energy_at(x, caloric)?;
        check_gradient::<A>(self.element, &self.model.gradient(x))?;
        if let Some(slot) = slot {
            Infeasible::unless_stable(caloric.heat_capacity, theta)
                .map_err(|infeasible| infeasible.of(self.element))?;
            state.entropies.set(slot, caloric.entropy);
        }
        Ok(energy)
    }

    /// The power that its dashpots in series turn into heat, W.
    pub(super) fn power_in_series(&self, x: &A::Variables) -> f64 {
        let gradient = self.model.gradient(x);
        let (viscosities, _) = self.model.viscosity(x[A::Variables::LEN - 1]);
        (0..self.dashpots()).fold(0.0, |power, dashpot| {
            let g = gradient[A::MEASURES + dashpot];
            power + g * g / viscosities[dashpot]
        })
    }

    /// Adds its parameters.
    pub(super) fn digest(&self, digest: &mut Digest) {
        digest.count(self.element.index());
        for index in 0..self.model.facts().parameter_count {
            digest.number(self.model.parameter(index));
        }
    }

    /// The energy in a state whose temperature and entropy are known.
    pub(super) fn energy_in(&self, x: &A::Variables, state: &State) -> Energy {
        let psi = self.model.free_energy(x);
        let Some(slot) = self.slots().thermal else {
            return Energy::without_temperature(psi);
        };
        let theta = state.temperatures[slot];
        let entropy = state.entropies.values()[slot];
        Energy::new(psi, [theta, entropy], &self.model.caloric(x))
    }

    /// `ψ + θ s` with the stored entropy, J.
    pub(super) fn internal_energy(&self, x: &A::Variables, state: &State) -> f64 {
        let psi = self.model.free_energy(x);
        match self.slots().thermal {
            Some(slot) => psi + state.temperatures[slot] * state.entropies.values()[slot],
            None => psi,
        }
    }
}

/// Adds the kind of a model, or the names of its parameters.
pub(super) fn digest_kind<A: Arrays>(model: &Tabled<A>, digest: &mut Digest) {
    let kind = model.facts().kind;
    if kind != 0 {
        return digest.bytes(&kind.to_le_bytes());
    }
    for name in model.parameter_names() {
        digest.bytes(name.as_bytes());
        digest.bytes(&[0]);
    }
}

/// An error unless forces and entropy of an initial state are finite; those of later states are checked with a response.
fn check_gradient<A: Arrays>(element: Element, gradient: &A::Variables) -> Result<(), StateError> {
    match gradient
        .as_ref()
        .iter()
        .position(|slope| !slope.is_finite())
    {
        None => Ok(()),
        Some(index) => Err(StateError::NotFinite {
            element,
            quantity: if index < A::MEASURES {
                "force"
            } else if index < A::MEASURES + A::DASHPOTS {
                "dashpot force"
            } else {
                "entropy"
            },
            value: gradient.as_ref()[index],
        }),
    }
}
