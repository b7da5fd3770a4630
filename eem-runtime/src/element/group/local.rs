//! The internal variables of one element: their balance equations, and their elimination.
//!
//! ```text
//! r_γk = η_k γ̇_k − g*_k,   Δγ_k = h (w γ̇_k + c_k)                 k = 1 … K
//! r_s  = Δs − h (w (Σ η γ̇² + Q)/θ* + c_s),   Q = Σ κ (Θ_partner − Θ) + Σ κ (θ_r − θ*)
//! ```
//!
//! where `w` is the implicit weight of the scheme and `c` the contribution of the old state. Nothing is divided by η,
//! so that very small and very large η need no special case. The classical schemes, included for comparison, are solved
//! as usual, with `γ̇_k = g*_k/η_k` and `r_γk = Δγ_k − h (w γ̇_k + c_k)`: other equations would change where they fail. The
//! unknowns `u = (Δγ…, τ)` occur in no other element, since elements in contact are coupled by the global unknown Θ =
//! θ*. So their corrections are eliminated here.

use super::eliminate::{LocalSystem, eliminate};
use super::point::Point;
use super::site::HeatPath;
use crate::algebra::lu::Singular;
use crate::element::conduction::{HeatFlow, InterfaceTemperatures};
use crate::element::conjugates::{Any, Family, Form};
use crate::element::error::StateError;
use crate::element::group::point::temperature_in;
use crate::element::group::view::StepView;
use crate::element::kinematics::MeasureSet;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

/// The power dissipated by the dashpots, `Σ η γ̇²`, W, and its derivatives with respect to the variables.
pub(super) struct Dissipation<A: Arrays> {
    pub(super) power: f64,
    pub(super) by: A::Variables,
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Eliminates the internal variables of an element, given its response with tangent and its viscosities.
    #[expect(
        clippy::inline_always,
        reason = "a call costs 1.5 % of a step of two springs"
    )]
    #[inline(always)]
    pub(super) fn condense<C: Family>(
        &mut self,
        view: &StepView<'_>,
        interface: &InterfaceTemperatures,
        form: &Form<A>,
        paths: Option<&[HeatPath]>,
    ) -> Result<(), StateError> {
        if Self::UNKNOWNS == 0 {
            return Ok(());
        }
        // Called first: the call would spill the registers used below.
        let theta = temperature_in::<A>(&form.0);
        let conducting = self.conducting_temperature::<C>(&form.0);
        let flow = self.heat_flow(view, paths, interface, conducting);
        let mut system = LocalSystem::<A>::empty(self.pivot_units::<C>(theta));
        self.balances::<C, true>(view, &flow, form, &mut system);
        let depends_on_heat = self.depends_on_heat::<C>(paths.is_some());
        let solved = if depends_on_heat {
            eliminate::<A, true>(&mut system, self.own_unknowns())
        } else {
            eliminate::<A, false>(&mut system, self.own_unknowns())
        };
        solved.map_err(|singular| self.unsolved(singular))?;
        self.keep_solved(&system, depends_on_heat);
        Ok(())
    }

    /// A finite local system is singular only where the response has no derivative.
    pub(super) fn unsolved(&self, Singular: Singular) -> StateError {
        StateError::NotFinite {
            element: self.element,
            quantity: "inverse of the local tangent",
            value: f64::INFINITY,
        }
    }

    /// Writes the local equations to an empty system; if `SCALED`, that of heat times θ* in exact schemes.
    #[expect(clippy::inline_always, reason = "the system stays in registers")]
    #[inline(always)]
    pub(super) fn balances<C: Family, const SCALED: bool>(
        &mut self,
        view: &StepView<'_>,
        flow: &HeatFlow,
        form: &Form<A>,
        system: &mut LocalSystem<A>,
    ) {
        let mut dissipation = Dissipation {
            power: 0.0,
            by: A::Variables::filled(0.0),
        };
        for k in 0..self.dashpots() {
            self.dashpot_balance::<C>(view, k, form, system, &mut dissipation);
        }
        self.dissipate_by_drag::<C>(view, form, &mut dissipation);
        self.dissipate_by_damping::<C>(view, &mut dissipation);
        if self.is_thermal() {
            let row = A::DASHPOTS;
            if self.is_prescribed {
                // r_s = τ − τ_prescribed, which is zero from the start.
                self.condensed.heat_factor = 0.0;
                system.rows[row][Self::TEMPERATURE] = 1.0;
            } else {
                system.by_heat[row] = 1.0;
                self.heat_balance::<C, SCALED>(view, flow, form, system, &dissipation);
            }
        }
    }

    /// Stores the solved local system.
    #[inline]
    pub(super) fn keep_solved(&mut self, system: &LocalSystem<A>, depends_on_heat: bool) {
        for u in 0..Self::UNKNOWNS {
            if !self.own_unknowns().has::<A>(u) {
                continue;
            }
            self.condensed.constant.set(u, system.constant[u]);
            for a in 0..A::MEASURES {
                self.condensed.by_measure[a].set(u, system.rows[u][a]);
            }
            if depends_on_heat {
                self.condensed.by_heat.set(u, system.by_heat[u]);
            }
        }
    }

    /// Factors that turn the rows of the local system into energies.
    #[inline]
    pub(super) fn pivot_units<C: Family>(&self, theta: f64) -> [f64; 2] {
        if C::is_exact(self.scheme) {
            [self.viscous_unit(), theta]
        } else {
            [1.0; 2]
        }
    }

    /// Whether `r_s` depends on global unknowns other than through the measures.
    #[inline]
    pub(super) fn depends_on_heat<C: Family>(&self, is_coupled: bool) -> bool {
        C::is_in_temperature(self.scheme)
            || (self.is_thermal() && (is_coupled || self.has_rates::<C>()))
    }

    /// The heat received by conduction.
    ///
    /// Flows between elements follow from the interface temperatures Θ of both ends, so that one end receives exactly
    /// what the other gives; flows from reservoirs follow from the temperature of the element itself.
    #[expect(clippy::inline_always, reason = "mostly there is none")]
    #[inline(always)]
    pub(super) fn heat_flow(
        &self,
        view: &StepView<'_>,
        paths: Option<&[HeatPath]>,
        interface: &InterfaceTemperatures,
        theta: f64,
    ) -> HeatFlow {
        let mut flow = HeatFlow::none();
        let Some(slot) = self.slots().thermal else {
            return flow;
        };
        if self.meets_reservoirs {
            flow = view.conduction.reservoir_flow(slot, theta);
        }
        for path in paths.unwrap_or_default() {
            flow.heat += path.conductance * interface.drop(slot, path.slot as usize);
        }
        flow
    }

    /// `γ̇_k` of the trial, to which the scheme gives the weight w, m/s.
    #[inline]
    pub(super) fn creep_rate<C: Family>(&self, k: usize, view: &StepView<'_>) -> f64 {
        if C::is_exact(self.scheme) {
            self.creep[k] * view.per_step
        } else {
            self.response[A::MEASURES + k] / self.viscosities.0[k]
        }
    }

    /// `η_k γ̇_k²`, W.
    #[inline]
    pub(super) fn power_of<C: Family>(&self, k: usize, view: &StepView<'_>) -> f64 {
        let rate = self.creep_rate::<C>(k, view);
        self.viscosities.0[k] * (rate * rate)
    }

    /// `r_γk` and its derivatives; adds to the dissipated power and its derivatives.
    #[inline]
    fn dashpot_balance<C: Family>(
        &self,
        view: &StepView<'_>,
        k: usize,
        (response, tangent): &Form<A>,
        system: &mut LocalSystem<A>,
        dissipation: &mut Dissipation<A>,
    ) {
        let index = A::MEASURES + k;
        if !view.phase.heats() {
            // Δγ = 0.
            system.rows[k][index] = 1.0;
            return;
        }
        if !C::is_exact(self.scheme) {
            self.ordinary_dashpot_balance(view, k, (response, tangent), system, dissipation);
            return;
        }
        let (eta, rate) = (self.viscosities.0[k], self.creep_rate::<C>(k, view));
        system.constant[k] = eta * rate - response[index];
        dissipation.power += eta * (rate * rate);
        let per_creep = eta * view.per_step;
        for column in 0..Self::VARIABLES {
            // The derivative of η γ̇ through the temperature.
            let thinning = if self.is_thermal() {
                rate * self.viscosities.1[k] * tangent[Self::TEMPERATURE][column]
            } else {
                0.0
            };
            let own = if column == index { per_creep } else { 0.0 };
            system.rows[k][column] = (own + thinning) - tangent[index][column];
            // ∂(η γ̇²)/∂x = γ̇ (2η ∂γ̇/∂x + γ̇ ∂η/∂x)
            let power_by = rate * ((own + own) + thinning);
            dissipation.by[column] = if k == 0 {
                power_by
            } else {
                dissipation.by[column] + power_by
            };
        }
    }

    /// `r_γk` of a classical scheme and its derivatives; adds to the derivatives of the dissipated power.
    fn ordinary_dashpot_balance(
        &self,
        view: &StepView<'_>,
        k: usize,
        (response, tangent): (&A::Response, &A::Tangent),
        system: &mut LocalSystem<A>,
        dissipation: &mut Dissipation<A>,
    ) {
        let index = A::MEASURES + k;
        let per_eta = self.viscosities.0[k].recip();
        let rate = response[index] * per_eta;
        dissipation.power += response[index] * rate;
        let h = view.thermal_step();
        system.constant[k] = self.creep[k] - self.increment::<Any>(index, rate, h);
        let mobility = -h * self.scheme.implicit() * per_eta;
        // ∂g/∂x − γ̇ ∂η/∂x, the derivative of γ̇ times η.
        let thinning = rate * self.viscosities.1[k];
        for column in 0..Self::VARIABLES {
            let by = tangent[index][column];
            let driving = if self.is_thermal() {
                by - thinning * tangent[Self::TEMPERATURE][column]
            } else {
                by
            };
            // ∂(g γ̇)/∂x = γ̇ (∂g/∂x + η ∂γ̇/∂x)
            let power_by = rate * (by + driving);
            dissipation.by[column] = if k == 0 {
                power_by
            } else {
                dissipation.by[column] + power_by
            };
            let own = if column == index { 1.0 } else { 0.0 };
            system.rows[k][column] = own + mobility * driving;
        }
    }

    /// `r_s` and its derivatives.
    #[inline]
    fn heat_balance<C: Family, const SCALED: bool>(
        &mut self,
        view: &StepView<'_>,
        flow: &HeatFlow,
        (response, tangent): &Form<A>,
        system: &mut LocalSystem<A>,
        dissipation: &Dissipation<A>,
    ) {
        let per_theta = temperature_in::<A>(response).recip();
        let rate = (dissipation.power + flow.heat) * per_theta;
        let h = view.thermal_step();
        let row = A::DASHPOTS;
        let received = self.increment::<C>(Self::TEMPERATURE, rate, h);
        let residual = response[Self::ENTROPY] - received;
        system.constant[row] = residual;
        // ∂r_s/∂(power) without the sign, and ∂r_s/∂θ*.
        let weight = h * C::implicit(self.scheme) * per_theta;
        self.condensed.heat_factor = -weight;
        let mut by_theta = weight * (flow.conductance + rate);
        if SCALED && C::is_exact(self.scheme) {
            // Newton's method on θ* r_s, which has the same root as r_s and is far less curved where conduction is
            // stiff.
            by_theta += residual * per_theta;
        }
        // ∂r_s/∂Θ beyond ∂r_s/∂θ*, by which a damped temperature depends on Δs.
        let by_change = weight * flow.conductance * self.shift_by_entropy::<C>(response);
        for column in 0..Self::VARIABLES {
            let mut entry =
                tangent[Self::ENTROPY][column] + by_theta * tangent[Self::TEMPERATURE][column];
            if C::is_damped(self.scheme) {
                entry += by_change * tangent[Self::ENTROPY][column];
            }
            if self.dashpots() + self.drags() > 0 {
                entry -= weight * dissipation.by[column];
            }
            system.rows[row][column] = entry;
        }
    }
}
