//! The transposed equations of a point, and their elimination.

use crate::element::conduction::{InterfaceTemperatures, Partner};
use crate::element::conjugates::{Exact, Form};
use crate::element::error::StateError;
use crate::element::group::arms::measures_in;
use crate::element::group::eliminate::{CondensedRow, LocalSystem, eliminate};
use crate::element::group::point::{Point, temperature_in};
use crate::element::group::point_step::{Reduced, StepBack};
use crate::element::group::site::HeatPath;
use crate::element::group::view::StepView;
use crate::element::kinematics::{MeasureSet, Numbers};
use crate::element::layout::Slots;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// `Σ λ_σ h κ_r/θ_r`.
    #[inline]
    pub(super) fn of_reservoirs(&self, step: &StepBack<'_>) -> f64 {
        let mut sum = 0.0;
        let Some(slot) = self.slots().thermal.filter(|_| self.meets_reservoirs) else {
            return sum;
        };
        let StepView {
            conduction,
            step: h,
            ..
        } = step.past.view;
        for link in conduction.links(slot) {
            if let Partner::Reservoir(index) = link.partner {
                let conducted = h * link.conductance;
                sum += step.by_new.reservoirs[index] * conducted / conduction.reservoirs[index];
            }
        }
        sum
    }

    /// Eliminates its own weights, which are stored as functions of the others.
    #[inline]
    pub(in crate::element::group) fn condense_transposed(
        &mut self,
        step: &StepBack<'_>,
        interface: &InterfaceTemperatures,
        form: &Form<A>,
        paths: Option<&[HeatPath]>,
    ) -> Result<Reduced<Q>, StateError> {
        let (response, tangent) = form;
        let zeros = Numbers::<Q>::filled(0.0);
        let mut reduced = Reduced::<Q> {
            moduli: Q::Per::filled(zeros),
            by_heat: zeros,
            constant: zeros,
            forces: measures_in::<Q>(response),
            own_weight: CondensedRow::none(),
            heat_factor: 0.0,
        };
        for a in 0..A::MEASURES {
            reduced.moduli[a] = measures_in::<Q>(&tangent[a]);
        }
        if Self::UNKNOWNS == 0 {
            return Ok(reduced);
        }
        let theta = temperature_in::<A>(response);
        let flow = self.heat_flow(&step.past.view, paths, interface, theta);
        let mut system = LocalSystem::<A>::empty(self.pivot_units::<Exact>(theta));
        self.balances::<Exact, false>(&step.past.view, &flow, form, &mut system);
        let mut transposed = LocalSystem::<A>::empty(system.unit);
        let of_reservoirs = self.of_reservoirs(step);
        let Slots { viscous, thermal } = self.slots();
        for u in self.unknowns() {
            let column = A::MEASURES + u;
            for a in 0..A::MEASURES {
                transposed.rows[u][a] = tangent[a][column];
            }
            for v in self.unknowns() {
                transposed.rows[u][A::MEASURES + v] = system.rows[v][column];
            }
            let by_new = match thermal.filter(|_| u == A::DASHPOTS) {
                Some(slot) => step.by_new.temperatures[slot],
                None => step.by_new.viscous[viscous + u],
            };
            transposed.constant[u] = -by_new;
            if self.is_thermal() {
                let by_theta = tangent[Self::TEMPERATURE][column];
                transposed.constant[u] -= of_reservoirs * by_theta;
                transposed.by_heat[u] = -by_theta;
            }
        }
        let solved = if paths.is_some() {
            eliminate::<A, true>(&mut transposed, self.own_unknowns())
        } else {
            eliminate::<A, false>(&mut transposed, self.own_unknowns())
        };
        solved.map_err(|singular| self.unsolved(singular))?;
        self.keep_solved(&transposed, paths.is_some());
        for b in 0..A::MEASURES {
            if self.is_thermal() {
                let by_theta = tangent[Self::TEMPERATURE][b];
                reduced.constant[b] = -of_reservoirs * by_theta;
                reduced.by_heat[b] = -by_theta;
            }
            for u in self.unknowns() {
                let by = system.rows[u][b];
                reduced.constant[b] -= by * self.condensed.constant.get(u);
                if paths.is_some() {
                    reduced.by_heat[b] -= by * self.condensed.by_heat.get(u);
                }
                for a in 0..A::MEASURES {
                    reduced.moduli[a][b] -= by * self.condensed.by_measure[a].get(u);
                }
            }
        }
        let (own, condensed) = (A::DASHPOTS, &self.condensed);
        reduced.heat_factor = condensed.heat_factor;
        reduced.own_weight.value = condensed.constant.get(own);
        reduced.own_weight.by_heat = condensed.by_heat.get(own);
        for a in 0..A::MEASURES {
            reduced.own_weight.by_measure[a] = condensed.by_measure[a].get(own);
        }
        Ok(reduced)
    }
}
