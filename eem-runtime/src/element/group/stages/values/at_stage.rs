//! One point at one stage: forces, rates of its internal variables, and their derivatives.

use crate::element::conduction::HeatFlow;
use eem_material::free_energy::{Array, FreeEnergy};

/// The model at a stage.
#[derive(Clone, Copy, Debug)]
pub(super) struct AtStage<M: FreeEnergy<f64>> {
    /// `∂ψ/∂x = (f, −g, −s)`.
    pub(super) gradient: M::Variables,
    /// `∂²ψ/∂x²`.
    pub(super) hessian: M::Hessian,
    /// `γ̇ = g/η` at the index of each dashpot, m/s, and `Φ` at that of the temperature, W/K.
    pub(super) rates: M::Variables,
    /// Their derivatives with respect to x, a row each, at constant heat from other elements.
    pub(super) rates_by: M::Hessian,
    /// `Σ g γ̇`, W.
    pub(super) dissipation: f64,
}

impl<M: FreeEnergy<f64>> AtStage<M> {
    pub(super) fn zero() -> Self {
        let zeros = M::Variables::filled(0.0);
        Self {
            gradient: zeros,
            hessian: M::Hessian::filled(zeros),
            rates: zeros,
            rates_by: M::Hessian::filled(zeros),
            dissipation: 0.0,
        }
    }

    /// s, J/K; only with a temperature.
    pub(super) fn entropy(&self) -> f64 {
        -self.gradient[M::Variables::LEN - 1]
    }

    /// `∂s/∂x`.
    pub(super) fn entropy_by(&self) -> M::Variables {
        let mut row = self.hessian[M::Variables::LEN - 1];
        for entry in row.as_mut() {
            *entry = -*entry;
        }
        row
    }

    /// Finds the rates of the dashpots with the viscosities `η` and `dη/dθ`; returns `∂(Σ g γ̇)/∂x`.
    pub(super) fn creep(
        &mut self,
        dashpots: usize,
        viscosities: &(M::Viscosities, M::Viscosities),
    ) -> M::Variables {
        let mut dissipation_by = M::Variables::filled(0.0);
        self.dissipation = 0.0;
        for k in 0..dashpots {
            let index = M::MEASURES + k;
            let (eta, slope) = (viscosities.0[k], viscosities.1[k]);
            let g = -self.gradient[index];
            let rate = g / eta;
            self.rates[index] = rate;
            self.dissipation += g * rate;
            for column in 0..M::Variables::LEN {
                let g_by = -self.hessian[index][column];
                let is_temperature = M::THERMAL && column == M::Variables::LEN - 1;
                let eta_by = if is_temperature { slope } else { 0.0 };
                let rate_by = (g_by - rate * eta_by) / eta;
                self.rates_by[index][column] = rate_by;
                dissipation_by[column] += g_by * rate + g * rate_by;
            }
        }
        dissipation_by
    }

    /// Finds the rate `Φ` of the entropy at the temperature θ, with the heat received and `∂(Σ g γ̇)/∂x`.
    pub(super) fn warm(&mut self, theta: f64, flow: &HeatFlow, dissipation_by: &M::Variables) {
        let last = M::Variables::LEN - 1;
        let rate = (self.dissipation + flow.heat) / theta;
        self.rates[last] = rate;
        for (column, &power_by) in dissipation_by.as_ref().iter().enumerate() {
            let by = if column == last {
                power_by - flow.conductance - rate
            } else {
                power_by
            };
            self.rates_by[last][column] = by / theta;
        }
    }
}
