//! The changes of the equations of a point along a direction, and of its internal variables.

use super::still;
use crate::element::conduction::InterfaceTemperatures;
use crate::element::conjugates::{Exact, Form};
use crate::element::error::StateError;
use crate::element::group::eliminate::{LocalSystem, eliminate};
use crate::element::group::placed::PlacedPoint;
use crate::element::group::point::{Point, temperature_in};
use crate::element::group::point_step::{Direction, PastStep};
use crate::element::group::site::HeatPath;
use crate::element::kinematics::{Blocks, Ends, Kinematics, MeasureSet, Numbers};
use crate::element::layout::Slots;
use eem_material::free_energy::{Array, Material};

/// The derivatives of the equations of a point, the same for all directions.
pub(super) struct Linearized<M: Material> {
    /// With the forces of Kelvin–Voigt dashpots.
    pub(super) form: Form<f64, M>,
    /// Of the response with respect to the variables of the old state.
    by_old: M::Tangent,
    /// The local equations before the elimination.
    local: LocalSystem<M>,
}

/// The changes of the forces, the local equations and θ* of a point at constant new variables.
pub(super) struct Change<M: Material> {
    forces: M::Variables,
    local: M::Variables,
    theta: f64,
}

/// The changes of viscosities with the parameters.
struct ViscosityChanges<M: Material> {
    viscosities: M::Viscosities,
    drag: M::Drag,
}

impl<M: Material, Q: MeasureSet> Point<M, Q> {
    /// Linearizes its equations at both states, set by `return_to`, and eliminates its unknowns.
    #[inline]
    pub(super) fn linearize_past(
        &mut self,
        step: &PastStep<'_>,
        interface: &InterfaceTemperatures,
        paths: Option<&[HeatPath]>,
    ) -> Result<Linearized<M>, StateError> {
        let form = self.tangent_in(step.view.per_step)?;
        self.slopes_of(&form);
        let theta = temperature_in::<M>(&form.0);
        let flow = self.heat_flow(&step.view, paths, interface, theta);
        let mut local = LocalSystem::<M>::empty(self.pivot_units::<Exact>(theta));
        self.balances::<Exact, false>(&step.view, &flow, &form, &mut local);
        if Self::UNKNOWNS > 0 {
            let mut solved = LocalSystem::<M> {
                rows: local.rows,
                by_heat: local.by_heat,
                ..LocalSystem::empty(local.unit)
            };
            eliminate::<M, true>(&mut solved, self.own_unknowns())
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
    fn slopes_of(&mut self, (_, tangent): &Form<f64, M>) {
        if self.is_thermal() {
            self.slopes[Self::TEMPERATURE] = tangent[Self::TEMPERATURE];
        }
    }

    /// The changes of its equations along a direction, in which its old measures change by `moved`.
    #[inline]
    pub(super) fn change(
        &self,
        step: &PastStep<'_>,
        (interface, paths): (&InterfaceTemperatures, Option<&[HeatPath]>),
        moved: &Numbers<Q>,
        linear: &Linearized<M>,
        direction: &Direction,
    ) -> Change<M> {
        let (h, per_step) = (step.view.step, step.view.per_step);
        let Slots { viscous, thermal } = self.slots();
        let mut x = M::Variables::filled(0.0);
        for a in 0..M::MEASURES {
            x[a] = moved[a];
        }
        for k in 0..self.dashpots() {
            x[M::MEASURES + k] = direction.old.viscous[viscous + k];
        }
        if let Some(slot) = thermal {
            x[Self::TEMPERATURE] = direction.old.temperatures[slot];
        }
        let mut response = M::Response::filled(0.0);
        for (row, slopes) in linear.by_old.as_ref().iter().enumerate() {
            response[row] = sum_of(slopes, &x);
        }
        let by_parameters = self.add_parameters(direction, &mut response);
        let theta = temperature_in::<M>(&response);
        let mut change = Change::<M> {
            forces: M::Variables::filled(0.0),
            local: M::Variables::filled(0.0),
            theta,
        };
        for a in 0..M::MEASURES {
            change.forces[a] = response[a];
        }
        let (mut heat, mut d_heat) = (0.0, 0.0);
        for k in 0..self.dashpots() {
            let (at, eta) = (M::MEASURES + k, self.viscosities.0[k]);
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
        change.local[M::DASHPOTS] = if self.is_prescribed {
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
        response: &mut M::Response,
    ) -> ViscosityChanges<M> {
        let mut changes = ViscosityChanges::<M> {
            viscosities: M::Viscosities::filled(0.0),
            drag: M::Drag::filled(0.0),
        };
        let own = direction.parameters.get(self.element.index());
        let Some(own) = own.filter(|own| !own.is_empty()) else {
            return changes;
        };
        let mut parameters = M::Parameters::filled(0.0);
        // A model of a text has room for more parameters than it uses.
        for (parameter, &own) in parameters.as_mut().iter_mut().zip(own) {
            *parameter = own;
        }
        let (start, x) = (&self.start, &self.x);
        let by = start.form_tangent(&self.model, x, &self.corners, &parameters);
        for (sum, &by) in response.as_mut().iter_mut().zip(by.as_ref()) {
            *sum += by;
        }
        let theta = self.temperature();
        for k in 0..self.dashpots() {
            let mut weights = M::Viscosities::filled(0.0);
            weights[k] = 1.0;
            let by = self.model.viscosity_adjoint(theta, &weights);
            changes.viscosities[k] = sum_of(&by, &parameters);
        }
        for a in 0..self.drags() {
            let mut weights = M::Drag::filled(0.0);
            weights[a] = 1.0;
            changes.drag[a] = sum_of(&self.model.drag_adjoint(theta, &weights), &parameters);
        }
        changes
    }

    /// Eliminates its unknowns: keeps their constants in the new state of the direction, and returns the change of the forces.
    /// `unknown` is the row of its interface temperature.
    #[inline]
    pub(super) fn push(
        &self,
        linear: &Linearized<M>,
        change: &Change<M>,
        unknown: Option<usize>,
        direction: &mut Direction,
    ) -> Result<Numbers<Q>, StateError> {
        let mut solved = LocalSystem::<M> {
            constant: change.local,
            rows: linear.local.rows,
            ..LocalSystem::empty(linear.local.unit)
        };
        if Self::UNKNOWNS > 0 {
            eliminate::<M, false>(&mut solved, self.own_unknowns())
                .map_err(|singular| self.unsolved(singular))?;
        }
        let condensed = |row: usize, value: f64| {
            let slopes = &linear.form.1[row];
            self.unknowns().fold(value, |value, u| {
                value - slopes[M::MEASURES + u] * solved.constant[u]
            })
        };
        let mut forces = Numbers::<Q>::filled(0.0);
        for a in 0..M::MEASURES {
            forces[a] = condensed(a, change.forces[a]);
        }
        let Slots { viscous, thermal } = self.slots();
        for k in 0..self.dashpots() {
            direction.new.viscous[viscous + k] = solved.constant[k];
        }
        if let Some(slot) = thermal {
            direction.new.temperatures[slot] = solved.constant[M::DASHPOTS];
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
    pub(super) fn follow(
        &self,
        changes: &Numbers<Q>,
        heat: Option<f64>,
        direction: &mut Direction,
    ) {
        if Self::UNKNOWNS == 0 {
            return;
        }
        let mut x = M::Variables::filled(0.0);
        for a in 0..M::MEASURES {
            x[a] = changes[a];
        }
        let Slots { viscous, thermal } = self.slots();
        for u in self.unknowns() {
            let place = match thermal.filter(|_| u == M::DASHPOTS) {
                Some(slot) => &mut direction.new.temperatures[slot],
                None => &mut direction.new.viscous[viscous + u],
            };
            let mut change = *place;
            for a in 0..M::MEASURES {
                change += self.condensed.by_measure[a].get(u) * x[a];
            }
            if let Some(heat) = heat {
                change += self.condensed.by_heat.get(u) * heat;
            }
            *place = -change;
            x[M::MEASURES + u] = -change;
        }
        if let Some(slot) = thermal {
            direction.middle[slot] += sum_of(&self.slopes[Self::TEMPERATURE], &x);
        }
    }
}

impl<M: Material, K: Kinematics<D>, const D: usize> PlacedPoint<M, K, D> {
    /// Adds the derivative of its impulses with respect to the old arms at given forces.
    #[inline]
    pub(super) fn add_old_curvature(
        &self,
        step: f64,
        back: &Ends<K, D>,
        sum: &mut Option<Blocks<K, D>>,
    ) {
        let mut forces = self.pulls::<Exact>();
        for force in forces.as_mut() {
            *force *= step;
        }
        let (kinematics, still) = (&self.kinematics, still::<K, D>());
        match sum {
            None => *sum = Some(kinematics.discrete_tangent(back, &forces, &still)),
            Some(sum) => kinematics.add_discrete_tangent(back, &forces, &still, sum),
        }
    }
}

/// `Σ aᵢ bᵢ`.
#[inline]
fn sum_of<A: Array<f64>>(a: &A, b: &A) -> f64 {
    let pairs = a.as_ref().iter().zip(b.as_ref());
    pairs.fold(0.0, |sum, (&a, &b)| sum + a * b)
}
