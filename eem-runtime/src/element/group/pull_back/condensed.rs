//! The transposed equations of a point, and their elimination.

use crate::element::conduction::{InterfaceTemperatures, Partner};
use crate::element::conjugates::{Exact, Family, Form};
use crate::element::error::StateError;
use crate::element::group::arms::{add_scaled, measures_in};
use crate::element::group::eliminate::{LocalSystem, eliminate};
use crate::element::group::placed::PlacedPoint;
use crate::element::group::point::{Point, temperature_in};
use crate::element::group::point_step::StepBack;
use crate::element::group::pose::Pose;
use crate::element::group::share::{Heat, Momentum};
use crate::element::group::site::HeatPath;
use crate::element::group::view::StepView;
use crate::element::kinematics::{Arms, Gradient, Kinematics, MeasureSet, Measures, Numbers};
use crate::element::layout::Slots;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

/// The transposed equations of a point after the elimination of its own weights:
/// `Σ_a h (D*π_a·w_v) moduli_a + w_Θ by_heat + constant`, by measure.
pub(super) struct Reduced<Q: MeasureSet> {
    moduli: Q::Per<Numbers<Q>>,
    by_heat: Numbers<Q>,
    constant: Numbers<Q>,
}

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
    pub(super) fn condense_transposed(
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
        Ok(reduced)
    }
}

impl<A: Arrays, K: Kinematics<D>, const D: usize> PlacedPoint<A, K, D> {
    /// Adds the derivatives of `wᵀR` with respect to the arms: the constant part, and that linear in `w_v`, its rows.
    #[inline]
    pub(super) fn add_transposed(
        &self,
        step: f64,
        pose: &Pose<K, D>,
        (form, reduced): (&Form<A>, &Reduced<K::Measures>),
        sum: &mut Option<Momentum<K, D>>,
    ) {
        let (kinematics, at) = (&self.kinematics, Exact::placement(self.scheme));
        let mut forces = Measures::<K, D>::filled(0.0);
        let mut by_arm = pose.sensitivity;
        for a in 0..A::MEASURES {
            forces[a] = step * form.0[a];
            by_arm[a] = combined::<K, D>(&pose.sensitivity, &reduced.moduli[a], step);
        }
        let pull = combined::<K, D>(&pose.sensitivity, &reduced.constant, 1.0);
        match sum {
            None => {
                *sum = Some(Momentum {
                    pull,
                    blocks: pose.tangent(kinematics, at, &forces, &by_arm),
                });
            }
            Some(sum) => {
                add_scaled::<K, D>(&mut sum.pull, 1.0, &pull);
                pose.add_tangent(kinematics, at, (&forces, &by_arm), &mut sum.blocks);
            }
        }
    }

    /// The terms of the interface temperatures, its own and its partners': `by_arm` is the derivative of `wᵀR` with respect
    /// to `w_Θ` and the arms. `−(∂R_s/∂Q) w_s` is `pull` times `w_v` plus `slope` times `w_Θ` plus `residual`.
    pub(super) fn heat_transposed(
        &self,
        step: f64,
        pose: &Pose<K, D>,
        reduced: &Reduced<K::Measures>,
    ) -> Heat<K, D> {
        let (own, factor) = (A::DASHPOTS, self.condensed.heat_factor);
        let mut by_measure = Measures::<K, D>::filled(0.0);
        for a in 0..A::MEASURES {
            by_measure[a] = self.condensed.by_measure[a].get(own);
        }
        Heat {
            residual: factor * self.condensed.constant.get(own),
            by_arm: combined::<K, D>(&pose.sensitivity, &reduced.by_heat, 1.0),
            slope: factor * self.condensed.by_heat.get(own),
            pull: combined::<K, D>(&pose.direction, &by_measure, step * factor),
        }
    }
}

/// `factor Σ_b slopes_b rows_b`.
#[inline]
fn combined<K: Kinematics<D>, const D: usize>(
    rows: &Gradient<K, D>,
    slopes: &Measures<K, D>,
    factor: f64,
) -> Arms<K, D> {
    let mut sum = Arms::<K, D>::filled([0.0; D]);
    for (row, &slope) in rows.as_ref().iter().zip(slopes.as_ref()) {
        add_scaled::<K, D>(&mut sum, factor * slope, row);
    }
    sum
}
