//! The changes of the equations of a point along a direction, and of its internal variables.

use crate::element::conduction::InterfaceTemperatures;
use crate::element::conjugates::{Exact, Form};
use crate::element::error::StateError;
use crate::element::group::eliminate::{LocalSystem, eliminate};
use crate::element::group::point::{Point, temperature_in};
use crate::element::group::point_step::{Direction, PastStep};
use crate::element::group::site::HeatPath;
use crate::element::kinematics::{MeasureSet, Numbers};
use crate::element::layout::Slots;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

/// The derivatives of the equations of a point, the same for all directions.
pub(in crate::element::group) struct Linearized<A: Arrays> {
    /// With the forces of Kelvin–Voigt dashpots.
    pub(in crate::element::group) form: Form<A>,
    /// Of the response with respect to the variables of the old state.
    by_old: A::Tangent,
    /// The local equations before the elimination.
    local: LocalSystem<A>,
}

/// The changes of the forces, the local equations and θ* of a point at constant new variables.
pub(in crate::element::group) struct Change<A: Arrays> {
    forces: A::Variables,
    local: A::Variables,
    theta: f64,
}

/// The changes of viscosities with the parameters.
struct ViscosityChanges<A: Arrays> {
    viscosities: A::Viscosities,
    drag: A::Drag,
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Linearizes its equations at both states, set by `return_to`, and eliminates its unknowns.
    #[inline]
    pub(in crate::element::group) fn linearize_past(
        &mut self,
        step: &PastStep<'_>,
        interface: &InterfaceTemperatures,
        paths: Option<&[HeatPath]>,
    ) -> Result<Linearized<A>, StateError> {
        let form = self.tangent_in(step.view.per_step)?;
        self.slopes_of(&form);
        let theta = temperature_in::<A>(&form.0);
        let flow = self.heat_flow(&step.view, paths, interface, theta);
        let mut local = LocalSystem::<A>::empty(self.pivot_units::<Exact>(theta));
        self.balances::<Exact, false>(&step.view, &flow, &form, &mut local);
        if Self::UNKNOWNS > 0 {
            let mut solved = LocalSystem::<A> {
                rows: local.rows,
                by_heat: local.by_heat,
                ..LocalSystem::empty(local.unit)
            };
            eliminate::<A, true>(&mut solved, self.own_unknowns())
                .map_err(|singular| self.unsolved(singular))?;
            self.keep_solved(&solved, paths.is_some());
        }
        Ok(Linearized {
            form,
            by_old: self.slopes_by_old(),
            local,
        })
    }

    /// Keeps the derivatives of θ*.
    fn slopes_of(&mut self, (_, tangent): &Form<A>) {
        if self.is_thermal() {
            self.slopes[Self::TEMPERATURE] = tangent[Self::TEMPERATURE];
        }
    }

    /// The changes of its equations along a direction, in which its old measures change by `moved`.
    #[inline]
    pub(in crate::element::group) fn change(
        &self,
        step: &PastStep<'_>,
        (interface, paths): (&InterfaceTemperatures, Option<&[HeatPath]>),
        moved: &Numbers<Q>,
        linear: &Linearized<A>,
        direction: &Direction,
    ) -> Change<A> {
        let (h, per_step) = (step.view.step, step.view.per_step);
        let Slots { viscous, thermal } = self.slots();
        let mut x = A::Variables::filled(0.0);
        for a in 0..A::MEASURES {
            x[a] = moved[a];
        }
        for k in 0..self.dashpots() {
            x[A::MEASURES + k] = direction.old.viscous[viscous + k];
        }
        if let Some(slot) = thermal {
            x[Self::TEMPERATURE] = direction.old.temperatures[slot];
        }
        let mut response = A::Response::filled(0.0);
        for (row, slopes) in linear.by_old.as_ref().iter().enumerate() {
            response[row] = sum_of(slopes.as_ref(), x.as_ref());
        }
        let by_parameters = self.add_parameters(direction, &mut response);
        let theta = temperature_in::<A>(&response);
        let mut change = Change::<A> {
            forces: A::Variables::filled(0.0),
            local: A::Variables::filled(0.0),
            theta,
        };
        for a in 0..A::MEASURES {
            change.forces[a] = response[a];
        }
        let (mut heat, mut d_heat) = (0.0, 0.0);
        for k in 0..self.dashpots() {
            let (at, eta) = (A::MEASURES + k, self.viscosities.0[k]);
            let (rate, d_rate) = (self.creep[k] * per_step, -x[at] * per_step);
            let d_eta = self.viscosities.1[k] * theta + by_parameters.viscosities[k];
            let force = d_eta * rate + eta * d_rate;
            change.local[k] = force - response[at];
            heat += eta * rate * rate;
            d_heat += (force + eta * d_rate) * rate;
        }
        for a in 0..self.drags() {
            let eta = self.drag.viscosity.0[a];
            let (rate, d_rate) = (self.drag.extension[a] * per_step, -x[a] * per_step);
            let d_eta = self.drag.viscosity.1[a] * theta + by_parameters.drag[a];
            let force = d_eta * rate + eta * d_rate;
            change.forces[a] += force;
            heat += eta * rate * rate;
            d_heat += (force + eta * d_rate) * rate;
        }
        let Some(slot) = thermal else {
            return change;
        };
        change.local[A::DASHPOTS] = if self.is_prescribed {
            -direction.new.temperatures[slot]
        } else {
            let own = self.temperature();
            let per_theta = own.recip();
            let flow = self.heat_flow(&step.view, paths, interface, own);
            heat += flow.heat;
            d_heat -= flow.conductance * theta;
            if let Some(&[given, per_degree]) = direction.heat.get(slot) {
                d_heat += given - per_degree * own;
            }
            response[Self::ENTROPY] - h * per_theta * (d_heat - heat * per_theta * theta)
        };
        change
    }

    /// Adds the change of the response with the parameters; returns that of the viscosities.
    #[inline]
    fn add_parameters(
        &self,
        direction: &Direction,
        response: &mut A::Response,
    ) -> ViscosityChanges<A> {
        let mut changes = ViscosityChanges::<A> {
            viscosities: A::Viscosities::filled(0.0),
            drag: A::Drag::filled(0.0),
        };
        let own = direction.parameters.get(self.element.index());
        let Some(own) = own.filter(|own| !own.is_empty()) else {
            return changes;
        };
        let (start, x) = (&self.start, &self.x);
        let by = start.form_tangent(&self.model, x, &self.corners, own);
        for (sum, &by) in response.as_mut().iter_mut().zip(by.as_ref()) {
            *sum += by;
        }
        let theta = self.temperature();
        let mut by = vec![0.0; own.len()];
        for k in 0..self.dashpots() {
            let mut weights = A::Viscosities::filled(0.0);
            weights[k] = 1.0;
            self.model.viscosity_adjoint(theta, &weights, &mut by);
            changes.viscosities[k] = sum_of(&by, own);
        }
        for a in 0..self.drags() {
            let mut weights = A::Drag::filled(0.0);
            weights[a] = 1.0;
            self.model.drag_adjoint(theta, &weights, &mut by);
            changes.drag[a] = sum_of(&by, own);
        }
        changes
    }

    /// Eliminates its unknowns: keeps their constants in the new state of the direction, and returns the change of the forces.
    /// `unknown` is the row of its interface temperature.
    #[inline]
    pub(in crate::element::group) fn push(
        &self,
        linear: &Linearized<A>,
        change: &Change<A>,
        unknown: Option<usize>,
        direction: &mut Direction,
    ) -> Result<Numbers<Q>, StateError> {
        let mut solved = LocalSystem::<A> {
            constant: change.local,
            rows: linear.local.rows,
            ..LocalSystem::empty(linear.local.unit)
        };
        if Self::UNKNOWNS > 0 {
            eliminate::<A, false>(&mut solved, self.own_unknowns())
                .map_err(|singular| self.unsolved(singular))?;
        }
        let condensed = |row: usize, value: f64| {
            let slopes = &linear.form.1[row];
            self.unknowns().fold(value, |value, u| {
                value - slopes[A::MEASURES + u] * solved.constant[u]
            })
        };
        let mut forces = Numbers::<Q>::filled(0.0);
        for a in 0..A::MEASURES {
            forces[a] = condensed(a, change.forces[a]);
        }
        let Slots { viscous, thermal } = self.slots();
        for k in 0..self.dashpots() {
            direction.new.viscous[viscous + k] = solved.constant[k];
        }
        if let Some(slot) = thermal {
            direction.new.temperatures[slot] = solved.constant[A::DASHPOTS];
            direction.middle[slot] = change.theta;
            if let Some(unknown) = unknown {
                let theta = condensed(Self::TEMPERATURE, change.theta);
                direction.right[unknown][0] += theta;
            }
        }
        Ok(forces)
    }

    /// Finds the changes of its internal variables and of θ*, given those of its measures and `δr_s` of a contact.
    #[inline]
    pub(in crate::element::group) fn follow(
        &self,
        changes: &Numbers<Q>,
        heat: Option<f64>,
        direction: &mut Direction,
    ) {
        if Self::UNKNOWNS == 0 {
            return;
        }
        let mut x = A::Variables::filled(0.0);
        for a in 0..A::MEASURES {
            x[a] = changes[a];
        }
        let Slots { viscous, thermal } = self.slots();
        for u in self.unknowns() {
            let place = match thermal.filter(|_| u == A::DASHPOTS) {
                Some(slot) => &mut direction.new.temperatures[slot],
                None => &mut direction.new.viscous[viscous + u],
            };
            let mut change = *place;
            for a in 0..A::MEASURES {
                change += self.condensed.by_measure[a].get(u) * x[a];
            }
            if let Some(heat) = heat {
                change += self.condensed.by_heat.get(u) * heat;
            }
            *place = -change;
            x[A::MEASURES + u] = -change;
        }
        if let Some(slot) = thermal {
            direction.middle[slot] += sum_of(self.slopes[Self::TEMPERATURE].as_ref(), x.as_ref());
        }
    }
}

/// `Σ aᵢ bᵢ`.
#[inline]
fn sum_of(a: &[f64], b: &[f64]) -> f64 {
    let pairs = a.iter().zip(b);
    pairs.fold(0.0, |sum, (&a, &b)| sum + a * b)
}
