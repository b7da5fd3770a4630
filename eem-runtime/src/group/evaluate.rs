//! Old state and trial state of the elements: responses, viscosities, condensed local systems.

use super::member::Member;
use super::{ElementGroup, StepView, Trial, variables};
use crate::error::StateError;
use crate::free_energy::{Array, FreeEnergy};
use crate::handle::Element;
use crate::kinematics::Kinematics;
use crate::scalar::Real;
use crate::scene::is_positive;
use crate::scheme::{ElementScheme, ElementTrial, Placement, Start};

impl<S, M, K, C> ElementGroup<S, M, K, C>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S>,
    C: ElementScheme<S, M>,
{
    /// See [`Group::begin`](super::Group::begin).
    pub(super) fn begin_step(
        &mut self,
        view: &StepView<'_, S>,
        old_force: &mut [S],
    ) -> Result<(), StateError> {
        let positions = view.state.positions.values();
        for i in 0..self.members.len() {
            self.geometry.measure_at(self.kinematics, i, positions);
            let member = &mut self.members[i];
            let measures = &self.geometry.old_measures[self.geometry.measures_range(i)];
            let x0 = variables::<S, M>(measures, member.slots, view.state);
            let entropy = member
                .slots
                .thermal
                .map(|slot| view.state.entropies.values()[slot]);
            member.start = Some(Start {
                x0,
                entropy: entropy.unwrap_or(S::zero()),
                old: C::old(&member.model, &x0),
            });
            member.x = x0;
            member.entropy_change = S::zero();
            if M::THERMAL {
                let theta = x0.as_ref()[M::Variables::LEN - 1];
                member.corners = M::Corners::filled(theta);
                let prescribed = view.prescribed(member.slots.thermal, C::PLACEMENT);
                member.x.as_mut()[M::Variables::LEN - 1] = prescribed.unwrap_or(theta);
            }
            member.hold();
            if C::IMPLICIT < 1.0 {
                self.old_share(view, i, old_force)?;
            }
        }
        Ok(())
    }

    /// The part of rates and nodal forces that the scheme takes from the old state.
    fn old_share(
        &mut self,
        view: &StepView<'_, S>,
        i: usize,
        old_force: &mut [S],
    ) -> Result<(), StateError> {
        let share = S::one() - S::from_f64(C::IMPLICIT);
        let member = &mut self.members[i];
        let x0 = member.old_variables();
        let theta = x0.as_ref()[M::Variables::LEN - 1];
        member.find_viscosities(theta)?;
        let gradient = member.model.gradient(&x0);
        let mut heat = S::zero();
        for k in 0..M::DASHPOTS {
            let index = M::MEASURES + k;
            let g = -gradient.as_ref()[index];
            let rate = g / member.viscosities.0.as_ref()[k];
            member.old_rates.as_mut()[index] = share * rate;
            heat += g * rate;
        }
        if let Some(slot) = member.slots.thermal {
            let temperatures = &view.state.temperatures;
            heat += view.conduction.heat_flow(slot, theta, temperatures);
            member.old_rates.as_mut()[M::Variables::LEN - 1] = share * heat / theta;
        }
        if M::THERMAL && C::IN_TEMPERATURE {
            self.old_heating(view, i, heat / theta);
        }
        let positions = view.state.positions.values();
        self.geometry.gather(i, C::PLACEMENT, positions, positions);
        self.geometry.place(self.kinematics, i, C::PLACEMENT);
        let direction = self.geometry.direction(i);
        let rows = direction.chunks_exact(self.geometry.width());
        for (row, &force) in rows.zip(gradient.as_ref()) {
            for (coordinate, &entry) in self.geometry.coordinates_of(i).zip(row) {
                old_force[coordinate] += share * force * entry;
            }
        }
        Ok(())
    }

    /// `(1 − w) θ̇⁰` of a scheme in temperature, which takes the place of `(1 − w) ṡ⁰`.
    fn old_heating(&mut self, view: &StepView<'_, S>, i: usize, entropy_rate: S) {
        let positions = view.state.positions.values();
        self.geometry
            .gather(i, Placement::End, positions, positions);
        self.geometry.place(self.kinematics, i, Placement::End);
        let dimension = self.geometry.dimension();
        let velocity = |coordinate| view.old_velocity(coordinate, dimension);
        self.geometry
            .increase(self.kinematics, i, Placement::End, velocity);
        let own = self.geometry.measures_range(i);
        let share = S::one() - S::from_f64(C::IMPLICIT);
        let member = &mut self.members[i];
        let last = M::Variables::LEN - 1;
        let (_, hessian) = member.model.hessian(&member.old_variables());
        // ∂s/∂x = −∂²ψ/∂θ∂x
        let slope = |index: usize| -hessian.as_ref()[last].as_ref()[index];
        let mut rest = share * entropy_rate;
        for (a, &rate) in self.geometry.increments[own].iter().enumerate() {
            rest -= slope(a) * share * rate;
        }
        for index in M::MEASURES..last {
            rest -= slope(index) * member.old_rates.as_ref()[index];
        }
        member.old_heating = rest / slope(last);
        member.old_rates.as_mut()[last] = S::zero();
    }

    /// The increments of the measures of element `i`: those of `q¹ − q⁰ − (1 − w) h q̇⁰`.
    fn increase(&mut self, view: &StepView<'_, S>, trial: &Trial<S>, i: usize) {
        let rest = (S::one() - S::from_f64(C::IMPLICIT)) * view.step;
        let dimension = self.geometry.dimension();
        let motion = |coordinate: usize| {
            let old = rest * view.old_velocity(coordinate, dimension);
            trial.displacements[coordinate] - old
        };
        self.geometry
            .increase(self.kinematics, i, C::PLACEMENT, motion);
    }

    /// See [`Group::evaluate`](super::Group::evaluate).
    pub(super) fn evaluate_trial(
        &mut self,
        view: &StepView<'_, S>,
        trial: &Trial<S>,
    ) -> Result<(), StateError> {
        let old = view.state.positions.values();
        for i in 0..self.members.len() {
            self.geometry.gather(i, C::PLACEMENT, old, &trial.positions);
            self.geometry.place(self.kinematics, i, C::PLACEMENT);
            if C::IN_TEMPERATURE {
                self.increase(view, trial, i);
            }
            let own = self.geometry.measures_range(i);
            let own_increments = own.clone();
            let measures = &self.geometry.measures[own];
            let member = &mut self.members[i];
            check_measures(self.kinematics, member.element, measures)?;
            member.x.as_mut()[..M::MEASURES].copy_from_slice(measures);
            let Some(start) = &member.start else {
                unreachable!("a step begins before it is evaluated");
            };
            let element = member.element;
            if M::THERMAL
                && view
                    .prescribed(member.slots.thermal, C::PLACEMENT)
                    .is_none()
            {
                let theta = C::temperature(&member.model, start, &member.x, member.entropy_change);
                member.x.as_mut()[M::Variables::LEN - 1] =
                    theta.map_err(|infeasible| infeasible.of(element))?;
            }
            let trial_variables = ElementTrial {
                x: member.x,
                increments: if C::IN_TEMPERATURE {
                    increments(member, &self.geometry.increments[own_increments], view.step)
                } else {
                    M::Variables::filled(S::zero())
                },
            };
            let answer = C::respond(&member.model, start, &trial_variables, &mut member.corners);
            let answer = answer.map_err(|infeasible| infeasible.of(element))?;
            member.response = answer.response;
            member.tangent = answer.tangent;
            member.by_increment = answer.by_increment;
            check_response::<S, M>(member.element, &member.response)?;
            member.find_viscosities(member.temperature())?;
            self.local
                .condense(view, &trial.seen_temperatures, member)?;
        }
        Ok(())
    }
}

/// The increments of measures, viscous stretches and temperature, less what the old state
/// contributes.
fn increments<S: Real, M: FreeEnergy<S>, C: ElementScheme<S, M>>(
    member: &Member<S, M, C>,
    measures: &[S],
    step: S,
) -> M::Variables {
    let mut increments = M::Variables::filled(S::zero());
    increments.as_mut()[..M::MEASURES].copy_from_slice(measures);
    let old = member.old_variables();
    let last = M::Variables::LEN - 1;
    for index in M::MEASURES..last {
        let change = member.x.as_ref()[index] - old.as_ref()[index];
        increments.as_mut()[index] = change - step * member.old_rates.as_ref()[index];
    }
    let change = member.new_temperature(old.as_ref()[last]) - old.as_ref()[last];
    increments.as_mut()[last] = change - step * member.old_heating;
    increments
}

/// The deformation is one that the element can have.
pub(super) fn check_measures<S: Real, K: Kinematics<S>>(
    kinematics: K,
    element: Element,
    measures: &[S],
) -> Result<(), StateError> {
    match measures
        .iter()
        .find(|&&measure| !kinematics.is_admissible(measure))
    {
        None => Ok(()),
        Some(measure) => Err(StateError::Stretch {
            element,
            value: measure.to_f64(),
        }),
    }
}

fn check_response<S: Real, M: FreeEnergy<S>>(
    element: Element,
    response: &M::Response,
) -> Result<(), StateError> {
    let response = response.as_ref();
    if M::THERMAL {
        let theta = response[M::MEASURES + M::DASHPOTS];
        check_temperature(element, theta)?;
    }
    match response.iter().find(|value| !value.is_finite()) {
        None => Ok(()),
        Some(value) => Err(StateError::NotFinite {
            element,
            quantity: "force or entropy",
            value: value.to_f64(),
        }),
    }
}

/// A temperature is positive and finite.
pub(super) fn check_temperature<S: Real>(element: Element, theta: S) -> Result<(), StateError> {
    if is_positive(theta) {
        return Ok(());
    }
    let value = theta.to_f64();
    Err(StateError::Temperature { element, value })
}
