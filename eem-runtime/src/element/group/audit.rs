//! Validation of elements in a state from outside, and of the response of their models there.

use super::kelvin_voigt::check_drag;
use super::point::Point;
use crate::element::conjugates::Infeasible;
use crate::element::error::StateError;
use crate::element::kinematics::MeasureSet;
use crate::element::state::State;
use eem_material::arrays::Arrays;
use eem_material::number::scalar::{Scalar, is_positive};

/// The largest difference of a stored entropy and that of the model, in ε of its terms.
///
/// A step finds the temperature to 4 ε of the terms of S, or to `2 ε max(1, |ln θ|)` in ln θ, times the heat capacity in the
/// entropy (`inversion`); stretches and viscous stretches are rounded once each. The evaluation of S here may add as much
/// again.
const ENTROPY_ROUNDINGS: f64 = 8.0;

/// Why an element cannot have a state from outside.
#[derive(Clone, Debug)]
pub(crate) enum Misfit {
    /// The state is inadmissible.
    State(StateError),
    /// Its entropy, J/K, differs from that of its temperature, K, by more than the bound for rounding.
    Entropy {
        element: usize,
        entropy: f64,
        expected: f64,
        temperature: f64,
        bound: f64,
    },
}

impl From<StateError> for Misfit {
    fn from(error: StateError) -> Self {
        Self::State(error)
    }
}

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// An error unless energy and forces are finite and viscosities positive.
    pub(super) fn audit_response(&self, x: &A::Variables) -> Result<(), StateError> {
        self.unless_infinite(self.model.free_energy(x))?;
        let gradient = self.model.gradient(x);
        if let Some(value) = gradient.as_ref().iter().find(|value| !value.is_finite()) {
            return Err(StateError::NotFinite {
                element: self.element,
                quantity: "force or entropy",
                value: *value,
            });
        }
        let theta = if self.is_thermal() {
            x[Self::TEMPERATURE]
        } else {
            0.0
        };
        let (drag, _) = self.model.drag(theta);
        check_drag::<A, Q>(&self.model, drag, theta).map_err(|error| error.of(self.element))?;
        let (viscosities, _) = self.model.viscosity(theta);
        let mut viscosities = viscosities.as_ref()[..self.dashpots()].iter().enumerate();
        match viscosities.find(|&(_, &eta)| !is_positive(eta)) {
            None => Ok(()),
            Some((dashpot, eta)) => Err(StateError::Viscosity {
                element: self.element,
                dashpot,
                value: *eta,
                unit: Q::VISCOSITY_UNIT,
                temperature: self.is_thermal().then_some(theta),
            }),
        }
    }

    /// An error unless `s = S(λ, γ, θ)` to rounding,
    ///
    /// ```text
    /// |S − s| ≤ 8 ε (Σ|terms of S| + Σ |∂S/∂x| |x| + C max(1, |ln θ|)),   x = λ, γ
    /// ```
    pub(super) fn audit_entropy(&self, x: &A::Variables, state: &State) -> Result<(), Misfit> {
        let Some(slot) = self.slots().thermal else {
            return Ok(());
        };
        let theta = x[Self::TEMPERATURE];
        let caloric = self.model.caloric(x);
        Infeasible::unless_stable(caloric.heat_capacity, theta)
            .map_err(|infeasible| infeasible.of(self.element))?;
        let entropy = state.entropies.values()[slot];
        let (_, hessian) = self.model.hessian(x);
        let by = hessian[Self::TEMPERATURE];
        let resolution = Scalar::maximum(Scalar::ln(theta).abs(), 1.0);
        let mut size = Scalar::maximum(caloric.magnitude, entropy.abs());
        size += caloric.heat_capacity * resolution;
        for index in 0..Self::TEMPERATURE {
            size += (by[index] * x[index]).abs();
        }
        let bound = ENTROPY_ROUNDINGS * f64::EPSILON * size;
        if (caloric.entropy - entropy).abs() <= bound {
            return Ok(());
        }
        Err(Misfit::Entropy {
            element: self.element.index(),
            entropy,
            expected: caloric.entropy,
            temperature: theta,
            bound,
        })
    }
}
