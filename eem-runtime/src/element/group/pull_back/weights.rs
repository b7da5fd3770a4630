//! The weights of the equations of a point, and the derivatives that follow from them.

use crate::element::conjugates::Exact;
use crate::element::group::arms::measures_in;
use crate::element::group::point::Point;
use crate::element::group::point_step::{
    PerVariable, SeeParameters, StepWeights, Surroundings, Weighed,
};
use crate::element::group::terms::Terms;
use crate::element::kinematics::{MeasureSet, Numbers};
use crate::element::layout::Slots;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

/// The derivatives of `wᵀR` with respect to the response, the increments and the viscosities of a point, its terms of
/// `−(∂R/∂h)ᵀ w`, and the weight of its balance of heat.
struct OfPoint<A: Arrays> {
    pub(super) rho: A::Response,
    pub(super) increments: A::Variables,
    pub(super) by_size: Terms,
    viscosities: A::Viscosities,
    drag: A::Drag,
    own: f64,
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// See [`PastPoints::weigh`](crate::element::group::points::PastPoints::weigh).
    pub(in crate::element::group) fn weighed(
        &self,
        around: &Surroundings<'_>,
        (along, has_by_new): (&Numbers<Q>, bool),
        (by_old, weights): (&mut PerVariable, &mut StepWeights),
        (see, workspaces): (&mut SeeParameters<'_>, &mut [Vec<f64>; 2]),
    ) -> Weighed<Q> {
        let of_point = self.weigh(around, along);
        let by = self.by_old(&of_point.rho, &of_point.increments);
        let mut weighed = Weighed {
            forces: self.pulls::<Exact>(),
            by_old: measures_in::<Q>(&by),
            by_new: Numbers::<Q>::filled(0.0),
        };
        if has_by_new {
            let by = self.by_new(&of_point.rho, &of_point.increments);
            weighed.by_new = measures_in::<Q>(&by);
        }
        self.write(&by, &of_point, by_old, weights);
        weights.by_size.add_all(&of_point.by_size);
        see(self.element, self.by_parameters(&of_point, workspaces));
        weighed
    }

    /// The weights of its equations, given `D*π·w_v`, and its terms of `−(∂R/∂h)ᵀ w`. The forces
    /// there are replaced by inertia, by means of the momentum balances,
    ///
    /// ```text
    /// w_v·(MΔv + Σ η_d Δλ D*λ)/h + w_γ η Δγ/h² + (w_s/θ*)(Σ κ (Θ_b − Θ_a) + Σ κ_r (θ_r − θ*) − Σ η Δγ²/h² − Σ η_d Δλ²/h²)
    /// ```
    ///
    /// The term with M is not included.
    #[inline]
    fn weigh(&self, around: &Surroundings<'_>, along: &Numbers<Q>) -> OfPoint<A> {
        let (h, per_step) = (around.step.past.view.step, around.step.past.view.per_step);
        let own = |u: usize| {
            let mut sum = self.condensed.constant.get(u);
            for a in 0..A::MEASURES {
                sum += self.condensed.by_measure[a].get(u) * (h * along[a]);
            }
            if around.paths.is_some() {
                sum += self.condensed.by_heat.get(u) * around.theta;
            }
            -sum
        };
        let mut of = OfPoint::<A> {
            rho: A::Response::filled(0.0),
            increments: A::Variables::filled(0.0),
            by_size: Terms::none(),
            viscosities: A::Viscosities::filled(0.0),
            drag: A::Drag::filled(0.0),
            own: 0.0,
        };
        let theta = self.temperature();
        // Without a temperature there is no balance of entropy.
        let mut per_theta = 0.0;
        if self.is_thermal() {
            of.own = own(A::DASHPOTS);
            per_theta = theta.recip();
        }
        let entropy = if self.is_prescribed { 0.0 } else { of.own };
        let per_heat = entropy * per_theta;
        let (mut by_theta, mut heat, mut slope) = (0.0, 0.0, 0.0);
        for a in 0..A::MEASURES {
            of.rho[a] = h * along[a];
        }
        for k in 0..self.dashpots() {
            let (eta, by_eta) = (self.viscosities.0[k], self.viscosities.1[k]);
            let (weight, rate) = (own(k), self.creep[k] * per_step);
            of.rho[A::MEASURES + k] = -weight;
            of.increments[A::MEASURES + k] =
                eta * (weight * per_step - (per_heat + per_heat) * rate);
            of.viscosities[k] = rate * (weight - h * per_heat * rate);
            of.by_size.add(weight * eta * rate * per_step);
            by_theta += weight * by_eta * rate;
            heat += eta * rate * rate;
            slope += by_eta * rate * rate;
        }
        for a in 0..self.drags() {
            let (eta, by_eta) = (self.drag.viscosity.0[a], self.drag.viscosity.1[a]);
            let rate = self.drag.extension[a] * per_step;
            of.increments[a] = eta * (along[a] - (per_heat + per_heat) * rate);
            of.drag[a] = h * rate * (along[a] - per_heat * rate);
            of.by_size.add(eta * rate * along[a]);
            by_theta += by_eta * self.drag.extension[a] * along[a];
            heat += eta * rate * rate;
            slope += by_eta * rate * rate;
        }
        if self.is_thermal() {
            let flow = self.heat_flow(
                &around.step.past.view,
                around.paths,
                around.interface,
                theta,
            );
            of.by_size.add(per_heat * flow.heat);
            of.by_size.add(-per_heat * heat);
            heat += flow.heat;
            slope -= flow.conductance;
            by_theta += h * per_heat * (heat * per_theta - slope);
            by_theta -= self.of_reservoirs(around.step) + around.theta;
            of.rho[Self::TEMPERATURE] = by_theta;
            of.rho[Self::ENTROPY] = entropy;
        }
        of
    }

    /// The derivatives of `wᵀR` with respect to the variables of the old state.
    #[inline]
    fn by_old(&self, rho: &A::Response, increments: &A::Variables) -> A::Variables {
        self.pulled(rho, &self.slopes_by_old(), increments, -1.0)
    }

    /// The derivatives of `wᵀR` with respect to the variables of the new state, without those to prescribed temperatures.
    fn by_new(&self, rho: &A::Response, increments: &A::Variables) -> A::Variables {
        let (_, tangent) = self.form::<Exact>(false);
        self.pulled(rho, &tangent, increments, 1.0)
    }

    /// `Tᵀρ ± increments`. Rows of dashpots that there might be are left out: a zero of theirs would take the sign of another.
    #[inline]
    fn pulled(
        &self,
        rho: &A::Response,
        tangent: &A::Tangent,
        increments: &A::Variables,
        sign: f64,
    ) -> A::Variables {
        let unused = A::MEASURES + self.dashpots()..Self::TEMPERATURE;
        let mut pulled = A::Variables::filled(0.0);
        for (at, pulled) in pulled.as_mut().iter_mut().enumerate() {
            *pulled = sign * increments[at];
            let rows = rho.as_ref().iter().zip(tangent.as_ref()).enumerate();
            for (_, (&rho, slopes)) in rows.filter(|(row, _)| !unused.contains(row)) {
                *pulled += rho * slopes[at];
            }
        }
        pulled
    }

    /// Writes the derivatives with respect to its old internal variables, and the weights of its balance of heat.
    #[inline]
    fn write(
        &self,
        by: &A::Variables,
        of: &OfPoint<A>,
        by_old: &mut PerVariable,
        weights: &mut StepWeights,
    ) {
        let Slots { viscous, thermal } = self.slots();
        for k in 0..self.dashpots() {
            by_old.viscous[viscous + k] = -by[A::MEASURES + k];
        }
        if let Some(slot) = thermal {
            by_old.temperatures[slot] = -by[Self::TEMPERATURE];
            weights.temperatures[slot] = self.temperature();
            weights.entropies[slot] = of.rho[Self::ENTROPY];
            if self.is_prescribed {
                weights.held[slot] = of.own;
            }
        }
    }

    /// The derivatives of the number with respect to the parameters in this step, in the first of two workspaces.
    #[inline]
    fn by_parameters<'a>(&self, of: &OfPoint<A>, [sum, by]: &'a mut [Vec<f64>; 2]) -> &'a [f64] {
        for workspace in [&mut *sum, &mut *by] {
            workspace.resize(self.model.facts().derivatives, 0.0);
        }
        let (start, x) = (&self.start, &self.x);
        start.form_adjoint(&self.model, x, &self.corners, &of.rho, sum);
        let theta = self.temperature();
        if self.dashpots() > 0 {
            self.model.viscosity_adjoint(theta, &of.viscosities, by);
            add(sum, by);
        }
        if self.drags() > 0 {
            self.model.drag_adjoint(theta, &of.drag, by);
            add(sum, by);
        }
        for entry in &mut *sum {
            *entry = -*entry;
        }
        sum
    }
}

fn add(sum: &mut [f64], by: &[f64]) {
    for (sum, &by) in sum.iter_mut().zip(by) {
        *sum += by;
    }
}
