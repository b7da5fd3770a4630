//! The end of a step: increments of all variables from the found forces, temperatures and rates.
//!
//! Newton's method leaves an error in the trial state. Taking `f*`, `g*` and `θ*` as given and
//! evaluating the remaining relations explicitly from them makes the balances of momentum and
//! entropy hold to rounding whatever that error is, and leaves the energy with its square.

use super::evaluate::check_temperature;
use super::{ElementGroup, StepView, Trial};
use crate::conduction::Partner;
use crate::error::StateError;
use crate::free_energy::{Array, Caloric, FreeEnergy};
use crate::kinematics::Kinematics;
use crate::scalar::Real;
use crate::scheme::{ElementScheme, Infeasible, Placement, temperature_at};
use crate::state::State;
use crate::system::LinearSystem;

impl<S, M, K, C> ElementGroup<S, M, K, C>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S>,
    C: ElementScheme<S, M>,
{
    /// A of the nodal force `A q_m` of element `i`, into the matrix of the geometry.
    fn secant(&mut self, i: usize) -> bool {
        let response = self.members[i].response;
        let forces = &response.as_ref()[..M::MEASURES];
        self.geometry
            .secant(self.kinematics, i, C::PLACEMENT, forces)
    }

    /// See [`Group::add_secant`](super::Group::add_secant).
    pub(super) fn add_secant_all(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S>,
        system: &mut LinearSystem<S>,
    ) {
        let (width, h) = (self.geometry.width(), view.step);
        let half = S::from_f64(0.5);
        let old = view.state.positions.values();
        for i in 0..self.members.len() {
            if !self.secant(i) {
                return;
            }
            for (p, at) in self.unknowns(view, i).enumerate() {
                let Some(at) = at else { continue };
                let row = &self.geometry.matrix[p * width..(p + 1) * width];
                let coordinates = self.geometry.coordinates_of(i);
                for ((&entry, to), coordinate) in
                    row.iter().zip(self.unknowns(view, i)).zip(coordinates)
                {
                    system.add_right(at, -h * entry * old[coordinate]);
                    let entry = half * h * entry;
                    match to {
                        Some(to) => system.add(at, to, entry),
                        None => system.add_right(at, -entry * trial.displacements[coordinate]),
                    }
                }
            }
        }
    }

    /// See [`Group::add_impulse`](super::Group::add_impulse).
    pub(super) fn add_impulse_all(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S>,
        impulse: &mut [S],
    ) {
        let (width, h) = (self.geometry.width(), view.step);
        let half = S::from_f64(0.5);
        let old = view.state.positions.values();
        for i in 0..self.members.len() {
            if self.secant(i) {
                for (p, at) in self.geometry.coordinates_of(i).enumerate() {
                    let row = &self.geometry.matrix[p * width..(p + 1) * width];
                    let pairs = row.iter().zip(self.geometry.coordinates_of(i));
                    let force = pairs.fold(S::zero(), |sum, (&entry, coordinate)| {
                        let mean = old[coordinate] + half * trial.displacements[coordinate];
                        sum + entry * mean
                    });
                    impulse[at] -= h * force;
                }
            } else {
                let share = h * S::from_f64(C::IMPLICIT);
                let rows = self.geometry.direction(i).chunks_exact(width);
                let forces = &self.members[i].response.as_ref()[..M::MEASURES];
                for (row, &force) in rows.zip(forces) {
                    for (&entry, at) in row.iter().zip(self.geometry.coordinates_of(i)) {
                        impulse[at] -= share * force * entry;
                    }
                }
            }
        }
    }

    /// See [`Group::close`](super::Group::close).
    pub(super) fn close_all(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S>,
        next: &mut State<S>,
    ) {
        let share = S::from_f64(C::IMPLICIT);
        for member in &mut self.members {
            let forces = &member.response.as_ref()[M::MEASURES..M::MEASURES + M::DASHPOTS];
            let viscosities = member.viscosities.0.as_ref();
            let mut heat = S::zero();
            for (k, (&g, &eta)) in forces.iter().zip(viscosities).enumerate() {
                let rate = g / eta;
                heat += g * rate;
                let old_rate = member.old_rates.as_ref()[M::MEASURES + k];
                next.viscous.add(
                    member.slots.viscous + k,
                    view.thermal_step() * (share * rate + old_rate),
                );
            }
            let Some(slot) = member.slots.thermal else {
                next.dissipated.add(
                    0,
                    view.thermal_step() * (share * heat + member.old_dissipation()),
                );
                continue;
            };
            let theta = member.temperature();
            heat += view
                .conduction
                .heat_flow(slot, theta, &trial.seen_temperatures);
            let old_rate = member.old_rates.as_ref()[M::MEASURES + M::DASHPOTS];
            member.entropy_received = view.thermal_step() * (share * heat / theta + old_rate);
            next.entropies.add(slot, member.entropy_received);
            let seen = share * theta + (S::one() - share) * view.state.temperatures[slot];
            for link in view.conduction.links(slot) {
                if let Partner::Reservoir(index) = link.partner {
                    let theta_r = view.conduction.reservoirs[index];
                    let flow = link.conductance * (seen - theta_r);
                    next.reservoir_entropies
                        .add(index, view.thermal_step() * flow / theta_r);
                }
            }
        }
    }

    /// See [`Elements::settle`](super::Elements::settle).
    pub(super) fn settle_all(
        &mut self,
        view: &StepView<'_, S>,
        state: &mut State<S>,
    ) -> Result<(), StateError> {
        for i in 0..self.members.len() {
            let guess = self.members[i].x.as_ref()[M::Variables::LEN - 1];
            let Some(caloric) = self.settle_one(i, view, state, guess)? else {
                continue;
            };
            let member = &self.members[i];
            let Some(slot) = member.slots.thermal else {
                continue;
            };
            if view.prescribed(Some(slot), Placement::End).is_some() {
                let change = caloric.entropy - view.state.entropies.values()[slot];
                let given = change - member.entropy_received;
                state.entropies.set(slot, caloric.entropy);
                state.heat.add(0, member.temperature() * given);
                state.thermostat_entropy.add(0, -given);
            }
        }
        Ok(())
    }

    /// The temperature of element `i` in a new state, near `guess`, and all that must be true of the
    /// state; its caloric quantities if it has a temperature.
    pub(super) fn settle_one(
        &mut self,
        i: usize,
        view: &StepView<'_, S>,
        state: &mut State<S>,
        guess: S,
    ) -> Result<Option<Caloric<S>>, StateError> {
        let mut x = self.locate(i, state)?;
        let member = &mut self.members[i];
        for (dashpot, &stretch) in x.as_ref()[M::MEASURES..][..M::DASHPOTS].iter().enumerate() {
            if !stretch.is_finite() {
                return Err(StateError::ViscousStretch {
                    element: member.element,
                    dashpot,
                    value: stretch.to_f64(),
                });
            }
        }
        let Some(slot) = member.slots.thermal else {
            member.check_energy(&x)?;
            return Ok(None);
        };
        let prescribed = view.prescribed(Some(slot), Placement::End);
        state.temperatures[slot] = if let Some(theta) = prescribed {
            theta
        } else if C::IN_TEMPERATURE {
            member.new_temperature(view.state.temperatures[slot])
        } else {
            let entropy = state.entropies.values()[slot];
            temperature_at(&member.model, x, entropy, guess)
                .map_err(|infeasible| infeasible.of(member.element))?
        };
        x.as_mut()[M::Variables::LEN - 1] = state.temperatures[slot];
        check_temperature(member.element, state.temperatures[slot])?;
        member.check_energy(&x)?;
        let caloric = member.model.caloric(&x);
        if C::IN_TEMPERATURE {
            state.entropies.set(slot, caloric.entropy);
        }
        Infeasible::unless_stable(&caloric, state.temperatures[slot])
            .map_err(|infeasible| infeasible.of(member.element))?;
        Ok(Some(caloric))
    }
}
