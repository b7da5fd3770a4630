//! The internal variables of one element: their balance equations, and their elimination.
//!
//! ```text
//! r_γk = γ_k − γ_k⁰ − h (w g*_k/η_k + c_k)                       k = 1 … K
//! r_s  = Δs − h (w (Σ g*²/η + Q)/θ* + c_s),   Q = Σ κ (Θ_partner − Θ) + Σ κ (θ_r − θ*)
//! ```
//!
//! where `w` is the implicit share of the scheme and `c` what the old state contributes. The
//! unknowns `u = (γ…, τ)` occur in no other element: what elements in contact see of each other is
//! the global unknown Θ = θ*. So their corrections are eliminated here.

use super::StepView;
use super::member::{Condensed, Member};
use crate::error::StateError;
use crate::free_energy::{Array, FreeEnergy};
use crate::kinematics::Kinematics;
use crate::lu::Singular;
use crate::scalar::Real;
use crate::scheme::ElementScheme;

impl<S, M, K, C, const D: usize> Member<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S>,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// Eliminates the internal variables of an element whose response and viscosities are known.
    #[inline]
    pub(super) fn condense(
        &mut self,
        view: &StepView<'_, S>,
        seen_temperatures: &[S],
    ) -> Result<(), StateError> {
        if Self::UNKNOWNS == 0 {
            return Ok(());
        }
        let mut dissipation = Dissipation {
            power: S::zero(),
            by: M::Variables::filled(S::zero()),
        };
        for k in 0..M::DASHPOTS {
            self.dashpot_balance(view, k, &mut dissipation);
        }
        self.condensed.by_heat = M::Variables::filled(S::zero());
        if M::THERMAL {
            let row = M::DASHPOTS;
            if view.prescribed(self.slots.thermal, C::PLACEMENT).is_some() {
                // r_s = τ − τ_prescribed, which is zero from the start.
                self.condensed.constant[row] = S::zero();
                self.condensed.by_measure[row] = M::Variables::filled(S::zero());
                self.condensed.by_measure[row][Self::TEMPERATURE] = S::one();
            } else {
                self.condensed.by_heat[row] = S::one();
                self.heat_balance(view, seen_temperatures, &dissipation);
            }
        }
        // A finite local system is singular only where the response has no derivative.
        eliminate::<S, M>(&mut self.condensed).map_err(|Singular| StateError::NotFinite {
            element: self.element,
            quantity: "inverse of the local tangent",
            value: f64::INFINITY,
        })
    }

    /// `r_γk` and its derivatives; adds to the dissipated power and its derivatives.
    #[inline]
    fn dashpot_balance(
        &mut self,
        view: &StepView<'_, S>,
        k: usize,
        dissipation: &mut Dissipation<S, M>,
    ) {
        let (h, share) = (view.thermal_step(), S::from_f64(C::IMPLICIT));
        let index = M::MEASURES + k;
        let per_eta = self.viscosities.0[k].recip();
        let slope = self.viscosities.1[k];
        let g = self.answer.response[index];
        let rate = g * per_eta;
        dissipation.power += g * rate;
        let change = self.x[index] - self.start.x0[index];
        self.condensed.constant[k] = change - h * (share * rate + self.old_rates[index]);
        for column in 0..Self::VARIABLES {
            let g_by = self.answer.tangent[index][column];
            let theta_by = if M::THERMAL {
                self.answer.tangent[Self::TEMPERATURE][column]
            } else {
                S::zero()
            };
            let rate_by = (g_by - rate * slope * theta_by) * per_eta;
            dissipation.by[column] += g_by * rate + g * rate_by;
            let identity = if column == index { S::one() } else { S::zero() };
            self.condensed.by_measure[k][column] = identity - h * share * rate_by;
        }
    }

    /// `r_s` and its derivatives.
    #[inline]
    fn heat_balance(
        &mut self,
        view: &StepView<'_, S>,
        seen_temperatures: &[S],
        dissipation: &Dissipation<S, M>,
    ) {
        let (h, share) = (view.thermal_step(), S::from_f64(C::IMPLICIT));
        let theta = self.answer.response[Self::TEMPERATURE];
        let per_theta = theta.recip();
        let (mut heat, mut conductance) = (dissipation.power, S::zero());
        if let Some(slot) = self.slots.thermal {
            let flow = view.conduction.heat_flow(slot, theta, seen_temperatures);
            heat += flow.heat;
            conductance = flow.conductance;
        }
        let rate = heat * per_theta;
        let old_rate = self.old_rates[Self::TEMPERATURE];
        let row = M::DASHPOTS;
        let residual = self.answer.response[Self::ENTROPY] - h * (share * rate + old_rate);
        self.condensed.constant[row] = residual;
        for column in 0..Self::VARIABLES {
            let theta_by = self.answer.tangent[Self::TEMPERATURE][column];
            let power_by = dissipation.by[column] - conductance * theta_by;
            let rate_by = (power_by - rate * theta_by) * per_theta;
            let mut entry = self.answer.tangent[Self::ENTROPY][column] - h * share * rate_by;
            if C::SCALES_HEAT {
                // Newton's method on θ* r_s, which is far less curved than r_s where conduction is
                // stiff, and the same where r_s = 0.
                entry += theta_by * residual * per_theta;
            }
            self.condensed.by_measure[row][column] = entry;
        }
    }
}

/// What the dashpots turn into heat, `Σ g*²/η`, W, and its derivative by the variables.
struct Dissipation<S: Real, M: FreeEnergy<S>> {
    power: S,
    by: M::Variables,
}

/// Gauss–Jordan elimination with partial pivoting: from `r` in `constant`, `∂r/∂x` in `by_measure`
/// and `∂r/∂r_s` in `by_heat` to the solved form.
#[inline]
fn eliminate<S: Real, M: FreeEnergy<S>>(system: &mut Condensed<S, M>) -> Result<(), Singular> {
    let Condensed {
        constant,
        by_measure: rows,
        by_heat,
    } = system;
    let unknowns = M::Variables::LEN - M::MEASURES;
    for k in 0..unknowns {
        let at = M::MEASURES + k;
        let pivot = largest_row::<S, M>(rows, k);
        // As a rule it stays, and a branch is foretold where a place would be waited for.
        if pivot != k {
            rows.as_mut().swap(pivot, k);
            constant.as_mut().swap(pivot, k);
            by_heat.as_mut().swap(pivot, k);
        }
        let value = rows[k][at];
        if !value.is_finite() || value == S::zero() {
            return Err(Singular);
        }
        let inverse = value.recip();
        // Whole rows, which is faster: columns that have been eliminated are not read again.
        for entry in rows[k].as_mut() {
            *entry *= inverse;
        }
        let pivot_row = rows[k];
        constant[k] *= inverse;
        by_heat[k] *= inverse;
        for row in (0..unknowns).filter(|&row| row != k) {
            let factor = rows[row][at];
            for (entry, &pivot) in rows[row].as_mut().iter_mut().zip(pivot_row.as_ref()) {
                *entry -= factor * pivot;
            }
            let (own, heat) = (constant[k], by_heat[k]);
            constant[row] -= factor * own;
            by_heat[row] -= factor * heat;
        }
    }
    Ok(())
}

/// The row with the largest entry in the column of the local unknown `k`, from its own row on.
#[inline]
fn largest_row<S: Real, M: FreeEnergy<S>>(rows: &M::Hessian, k: usize) -> usize {
    let (at, unknowns) = (M::MEASURES + k, M::Variables::LEN - M::MEASURES);
    let mut largest = k;
    for row in k + 1..unknowns {
        if rows[row][at].abs() > rows[largest][at].abs() {
            largest = row;
        }
    }
    largest
}
