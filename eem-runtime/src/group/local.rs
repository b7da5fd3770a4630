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
use super::member::Member;
use crate::error::StateError;
use crate::free_energy::{Array, FreeEnergy};
use crate::lu;
use crate::scalar::Real;
use crate::scheme::ElementScheme;

/// Working memory for the local systems of one group.
#[derive(Clone, Debug)]
pub(crate) struct LocalSolver<S> {
    /// ∂r/∂u, row-major.
    matrix: Vec<S>,
    pivots: Vec<usize>,
}

impl<S: Real> LocalSolver<S> {
    /// Memory for `unknowns` local unknowns.
    pub(crate) fn new(unknowns: usize) -> Self {
        Self {
            matrix: vec![S::zero(); unknowns * unknowns],
            pivots: vec![0; unknowns],
        }
    }

    /// Eliminates the internal variables of an element whose response and viscosities are known.
    pub(crate) fn condense<M: FreeEnergy<S>, C: ElementScheme<S, M>>(
        &mut self,
        view: &StepView<'_, S>,
        seen_temperatures: &[S],
        member: &mut Member<S, M, C>,
    ) -> Result<(), StateError> {
        let unknowns = self.pivots.len();
        if unknowns == 0 {
            return Ok(());
        }
        self.residual_and_tangent(view, seen_temperatures, member);
        if lu::factor(&mut self.matrix, &mut self.pivots).is_err() {
            // A finite local system is singular only where the response has no derivative.
            return Err(StateError::NotFinite {
                element: member.element,
                quantity: "inverse of the local tangent",
                value: f64::INFINITY,
            });
        }
        let condensed = &mut member.condensed;
        self.solve(condensed.constant.as_mut());
        for row in &mut condensed.by_measure.as_mut()[..M::MEASURES] {
            self.solve(row.as_mut());
        }
        condensed.by_heat = M::Variables::filled(S::zero());
        let prescribed = view.prescribed(member.slots.thermal, C::PLACEMENT);
        if M::THERMAL && prescribed.is_none() {
            condensed.by_heat.as_mut()[unknowns - 1] = S::one();
            self.solve(condensed.by_heat.as_mut());
        }
        Ok(())
    }

    fn solve(&self, vector: &mut [S]) {
        let unknowns = self.pivots.len();
        lu::solve(&self.matrix, &self.pivots, &mut vector[..unknowns]);
    }

    /// Writes `r` to `condensed.constant`, `∂r/∂π` to `condensed.by_measure`, `∂r/∂u` to `matrix`.
    fn residual_and_tangent<M: FreeEnergy<S>, C: ElementScheme<S, M>>(
        &mut self,
        view: &StepView<'_, S>,
        seen_temperatures: &[S],
        member: &mut Member<S, M, C>,
    ) {
        let (unknowns, h) = (self.pivots.len(), view.thermal_step());
        let share = S::from_f64(C::IMPLICIT);
        let response = member.response.as_ref();
        let tangent = member.tangent.as_ref();
        let (viscosities, slopes) = &member.viscosities;
        let heat_row = M::MEASURES + M::DASHPOTS;
        let (mut dissipation, mut heat) = (S::zero(), S::zero());
        // ∂(Σ g²/η)/∂x
        let mut dissipation_by = M::Variables::filled(S::zero());
        let old = member.old_variables();
        for k in 0..M::DASHPOTS {
            let index = M::MEASURES + k;
            let (g, eta, slope) = (response[index], viscosities.as_ref()[k], slopes.as_ref()[k]);
            let rate = g / eta;
            dissipation += g * rate;
            let change = member.x.as_ref()[index] - old.as_ref()[index];
            let old_rate = member.old_rates.as_ref()[index];
            member.condensed.constant.as_mut()[k] = change - h * (share * rate + old_rate);
            for column in 0..M::Variables::LEN {
                let g_by = tangent[index].as_ref()[column];
                let theta_by = if M::THERMAL {
                    tangent[heat_row].as_ref()[column]
                } else {
                    S::zero()
                };
                let rate_by = (g_by - rate * slope * theta_by) / eta;
                dissipation_by.as_mut()[column] += g_by * rate + g * rate_by;
                let identity = if column == index { S::one() } else { S::zero() };
                let entry = identity - h * share * rate_by;
                self.store(&mut member.condensed.by_measure, k, column, entry);
            }
        }
        let Some(slot) = member.slots.thermal else {
            return;
        };
        if view.prescribed(Some(slot), C::PLACEMENT).is_some() {
            self.hold_temperature(member);
            return;
        }
        let theta = response[heat_row];
        heat += view.conduction.heat_flow(slot, theta, seen_temperatures);
        let conductance = view.conduction.reservoir_conductance(slot);
        let rate = (dissipation + heat) / theta;
        let old_rate = member.old_rates.as_ref()[heat_row];
        let row = unknowns - 1;
        member.condensed.constant.as_mut()[row] =
            response[heat_row + 1] - h * (share * rate + old_rate);
        for column in 0..M::Variables::LEN {
            let theta_by = tangent[heat_row].as_ref()[column];
            let power_by = dissipation_by.as_ref()[column] - conductance * theta_by;
            let rate_by = (power_by - rate * theta_by) / theta;
            let entry = tangent[heat_row + 1].as_ref()[column] - h * share * rate_by;
            // Newton's method on θ* r_s, which is far less curved than r_s where conduction is
            // stiff, and the same where r_s = 0.
            let entry = if C::SCALES_HEAT {
                entry + theta_by * member.condensed.constant.as_ref()[row] / theta
            } else {
                entry
            };
            self.store(&mut member.condensed.by_measure, row, column, entry);
        }
    }

    /// `r_s = τ − τ_prescribed`, which is zero from the start.
    fn hold_temperature<M: FreeEnergy<S>, C: ElementScheme<S, M>>(
        &mut self,
        member: &mut Member<S, M, C>,
    ) {
        let row = self.pivots.len() - 1;
        member.condensed.constant.as_mut()[row] = S::zero();
        for column in 0..M::Variables::LEN {
            let own = column == M::Variables::LEN - 1;
            let entry = if own { S::one() } else { S::zero() };
            self.store(&mut member.condensed.by_measure, row, column, entry);
        }
    }

    /// Stores `∂r_row/∂x_column`: measures in `by_measure`, a row per measure; local unknowns in `matrix`.
    fn store<V: Array<S>, H: Array<V>>(
        &mut self,
        by_measure: &mut H,
        row: usize,
        column: usize,
        entry: S,
    ) {
        let unknowns = self.pivots.len();
        let measures = V::LEN - unknowns;
        if column < measures {
            by_measure.as_mut()[column].as_mut()[row] = entry;
        } else {
            self.matrix[row * unknowns + column - measures] = entry;
        }
    }
}
