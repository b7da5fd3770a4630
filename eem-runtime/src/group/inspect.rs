//! What the elements are in a state, from the definitions and not from what a step computed.

use super::evaluate::check_measures;
use super::geometry::MOST_MEASURES;
use super::{ElementGroup, ElementView, GroupTotals, variables};
use crate::error::StateError;
use crate::free_energy::FreeEnergy;
use crate::handle::Element;
use crate::kinematics::Kinematics;
use crate::scalar::Real;
use crate::scheme::{ElementScheme, Infeasible};
use crate::state::State;

impl<S, M, K, C> ElementGroup<S, M, K, C>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S>,
    C: ElementScheme<S, M>,
{
    /// See [`Elements::initialize`](super::Elements::initialize).
    pub(super) fn initialize_all(&mut self, state: &mut State<S>) -> Result<(), StateError> {
        for i in 0..self.members.len() {
            let x = self.locate(i, state)?;
            let member = &mut self.members[i];
            let theta = member
                .slots
                .thermal
                .map_or(S::zero(), |slot| state.temperatures[slot]);
            member.find_viscosities(theta)?;
            member.check_energy(&x)?;
            check_gradient::<S, M>(member.element, &member.model.gradient(&x))?;
            let Some(slot) = member.slots.thermal else {
                continue;
            };
            let caloric = member.model.caloric(&x);
            Infeasible::unless_stable(&caloric, theta)
                .map_err(|infeasible| infeasible.of(member.element))?;
            state.entropies.set(slot, caloric.entropy);
        }
        Ok(())
    }

    /// The variables of element `i` in a state, if it can have its deformation.
    pub(super) fn locate(&self, i: usize, state: &State<S>) -> Result<M::Variables, StateError> {
        let x = self.variables_at(i, state);
        let measures = &x.as_ref()[..M::MEASURES];
        check_measures(self.kinematics, self.members[i].element, measures)?;
        Ok(x)
    }

    /// The variables of element `i` in a state.
    fn variables_at(&self, i: usize, state: &State<S>) -> M::Variables {
        let mut measures = [S::zero(); MOST_MEASURES];
        self.geometry
            .measure_into(self.kinematics, i, state.positions.values(), &mut measures);
        variables::<S, M>(&measures[..M::MEASURES], self.members[i].slots, state)
    }

    /// `ψ + θ s` of element `i`, with the entropy that is the state, J.
    fn internal_energy(&self, i: usize, x: &M::Variables, state: &State<S>) -> S {
        let member = &self.members[i];
        let psi = member.model.free_energy(x);
        match member.slots.thermal {
            Some(slot) => psi + state.temperatures[slot] * state.entropies.values()[slot],
            None => psi,
        }
    }

    /// See [`Elements::totals`](super::Elements::totals).
    pub(super) fn sum(&self, state: &State<S>) -> GroupTotals<S> {
        let (mut energy, mut entropy) = (S::zero(), S::zero());
        for (i, member) in self.members.iter().enumerate() {
            energy += self.internal_energy(i, &self.variables_at(i, state), state);
            if let Some(slot) = member.slots.thermal {
                entropy += state.entropies.values()[slot];
            }
        }
        GroupTotals { energy, entropy }
    }

    /// See [`Elements::inspect`](super::Elements::inspect).
    pub(super) fn inspect_at(&self, place: usize, state: &State<S>) -> ElementView<S> {
        let x = self.variables_at(place, state);
        ElementView {
            measure: x.as_ref()[0],
            force: self.members[place].model.gradient(&x).as_ref()[0],
            internal_energy: self.internal_energy(place, &x, state),
        }
    }
}

/// Forces and entropy of an initial state are finite; in later states they are part of a response.
fn check_gradient<S: Real, M: FreeEnergy<S>>(
    element: Element,
    gradient: &M::Variables,
) -> Result<(), StateError> {
    match gradient
        .as_ref()
        .iter()
        .position(|slope| !slope.is_finite())
    {
        None => Ok(()),
        Some(index) => Err(StateError::NotFinite {
            element,
            quantity: if index < M::MEASURES {
                "force"
            } else if index < M::MEASURES + M::DASHPOTS {
                "dashpot force"
            } else {
                "entropy"
            },
            value: gradient.as_ref()[index].to_f64(),
        }),
    }
}
