//! What one element contributes to the GENERIC form of the equations.

use super::{ElementGroup, variables};
use crate::free_energy::{Array, FreeEnergy};
use crate::kinematics::Kinematics;
use crate::scalar::Real;
use crate::scheme::{ElementScheme, Placement};
use crate::state::State;

/// Derivatives of the energy of an element, and what makes its dashpots move.
#[derive(Clone, Debug)]
pub(crate) struct ElementGeneric<S> {
    /// `(coordinate, ∂e/∂q)`, N.
    pub(crate) forces: Vec<(usize, S)>,
    /// `(slot, g, η)`: dashpot force, N, and viscosity, N s/m.
    pub(crate) dashpots: Vec<(usize, S, S)>,
    /// `(slot, θ)`, K, if the element has a temperature.
    pub(crate) temperature: Option<(usize, S)>,
}

impl<S, M, K, C> ElementGroup<S, M, K, C>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S>,
    C: ElementScheme<S, M>,
{
    /// All elements in a state.
    pub(super) fn generic_in_all(&mut self, state: &State<S>) -> Vec<ElementGeneric<S>> {
        let positions = state.positions.values();
        let mut elements = Vec::with_capacity(self.members.len());
        for i in 0..self.members.len() {
            self.geometry
                .gather(i, Placement::End, positions, positions);
            self.geometry.place(self.kinematics, i, Placement::End);
            let measures = &self.geometry.measures[self.geometry.measures_range(i)];
            let member = &self.members[i];
            let x = variables::<S, M>(measures, member.slots, state);
            let gradient = member.model.gradient(&x);
            let theta = x.as_ref()[M::Variables::LEN - 1];
            let (viscosities, _) = member.model.viscosity(theta);
            let mut response = M::Response::filled(S::zero());
            for index in 0..M::MEASURES + M::DASHPOTS {
                let sign = if index < M::MEASURES {
                    S::one()
                } else {
                    -S::one()
                };
                response.as_mut()[index] = sign * gradient.as_ref()[index];
            }
            if M::THERMAL {
                response.as_mut()[M::MEASURES + M::DASHPOTS] = theta;
            }
            elements.push(self.generic_at(i, &response, &viscosities));
        }
        elements
    }

    /// All elements during the last step, with discrete derivatives in the place of derivatives.
    pub(super) fn generic_of_step_all(&self) -> Vec<ElementGeneric<S>> {
        let members = self.members.iter().enumerate();
        members
            .map(|(i, member)| self.generic_at(i, &member.response, &member.viscosities.0))
            .collect()
    }

    fn generic_at(
        &self,
        i: usize,
        response: &M::Response,
        viscosities: &M::Viscosities,
    ) -> ElementGeneric<S> {
        let (response, slots) = (response.as_ref(), self.members[i].slots);
        let rows = self
            .geometry
            .direction(i)
            .chunks_exact(self.geometry.width());
        let forces = rows.zip(response).flat_map(|(row, &force)| {
            let entries = self.geometry.coordinates_of(i).zip(row);
            entries.map(move |(coordinate, &entry)| (coordinate, force * entry))
        });
        let dashpots = response[M::MEASURES..][..M::DASHPOTS]
            .iter()
            .zip(viscosities.as_ref());
        ElementGeneric {
            forces: forces.collect(),
            dashpots: dashpots
                .enumerate()
                .map(|(k, (&force, &eta))| (slots.viscous + k, force, eta))
                .collect(),
            temperature: slots
                .thermal
                .map(|slot| (slot, response[M::MEASURES + M::DASHPOTS])),
        }
    }
}
