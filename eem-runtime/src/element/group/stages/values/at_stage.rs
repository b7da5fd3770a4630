//! One point at one stage: forces, rates of its internal variables, and their derivatives.

use crate::element::conduction::HeatFlow;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

/// The model at a stage.
#[derive(Clone, Copy, Debug)]
pub(super) struct AtStage<A: Arrays> {
    /// `∂ψ/∂x = (f, −g, −s)`.
    pub(super) gradient: A::Variables,
    /// `∂²ψ/∂x²`.
    pub(super) hessian: A::Hessian,
    /// `γ̇ = g/η` at the index of each dashpot, m/s, and `Φ` at that of the temperature, W/K.
    pub(super) rates: A::Variables,
    /// Their derivatives with respect to x, a row each, at constant heat from other elements.
    pub(super) rates_by: A::Hessian,
    /// `Σ g γ̇`, W.
    pub(super) dissipation: f64,
}

impl<A: Arrays> AtStage<A> {
    pub(super) fn zero() -> Self {
        let zeros = A::Variables::filled(0.0);
        Self {
            gradient: zeros,
            hessian: A::Hessian::filled(zeros),
            rates: zeros,
            rates_by: A::Hessian::filled(zeros),
            dissipation: 0.0,
        }
    }

    /// s, J/K; only with a temperature.
    pub(super) fn entropy(&self) -> f64 {
        -self.gradient[A::Variables::LEN - 1]
    }

    /// `∂s/∂x`.
    pub(super) fn entropy_by(&self) -> A::Variables {
        let mut row = self.hessian[A::Variables::LEN - 1];
        for entry in row.as_mut() {
            *entry = -*entry;
        }
        row
    }

    /// Finds the rates of the dashpots with the viscosities `η` and `dη/dθ`; returns `∂(Σ g γ̇)/∂x`.
    pub(super) fn creep(
        &mut self,
        dashpots: usize,
        viscosities: &(A::Viscosities, A::Viscosities),
    ) -> A::Variables {
        let mut dissipation_by = A::Variables::filled(0.0);
        self.dissipation = 0.0;
        for k in 0..dashpots {
            let index = A::MEASURES + k;
            let (eta, slope) = (viscosities.0[k], viscosities.1[k]);
            let g = -self.gradient[index];
            let rate = g / eta;
            self.rates[index] = rate;
            self.dissipation += g * rate;
            for column in 0..A::Variables::LEN {
                let g_by = -self.hessian[index][column];
                let is_temperature = A::THERMAL && column == A::Variables::LEN - 1;
                let eta_by = if is_temperature { slope } else { 0.0 };
                let rate_by = (g_by - rate * eta_by) / eta;
                self.rates_by[index][column] = rate_by;
                dissipation_by[column] += g_by * rate + g * rate_by;
            }
        }
        dissipation_by
    }

    /// Finds the rate `Φ` of the entropy at the temperature θ, with the heat received and `∂(Σ g γ̇)/∂x`.
    pub(super) fn warm(&mut self, theta: f64, flow: &HeatFlow, dissipation_by: &A::Variables) {
        let last = A::Variables::LEN - 1;
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
