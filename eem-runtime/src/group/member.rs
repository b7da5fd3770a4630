//! One element of a group: its model and its part of the trial state.

use crate::error::StateError;
use crate::free_energy::{Array, FreeEnergy};
use crate::handle::Element;
use crate::layout::Slots;
use crate::scalar::Real;
use crate::scene::is_positive;
use crate::scheme::{ElementScheme, Placement, Start};

/// An element, with everything that one step of the scheme `C` needs to remember of it.
pub(crate) struct Member<S: Real, M: FreeEnergy<S>, C: ElementScheme<S, M>> {
    pub(crate) element: Element,
    pub(crate) model: M,
    pub(crate) slots: Slots,
    /// The old state; `None` before the first step.
    pub(crate) start: Option<Start<S, M, C::Old>>,
    /// What the old state alone contributes to the rates of the internal variables.
    pub(crate) old_rates: M::Variables,
    /// The trial variables `(π, γ, τ)`.
    pub(crate) x: M::Variables,
    /// The trial Δs, before the last correction, and the correction, J/K.
    pub(crate) entropy_change: S,
    pub(crate) previous_entropy_change: S,
    pub(crate) entropy_correction: S,
    /// The trial variables before the last correction, and the correction.
    pub(crate) previous: M::Variables,
    pub(crate) correction: M::Variables,
    /// Corner temperatures, kept as starting values.
    pub(crate) corners: M::Corners,
    pub(crate) response: M::Response,
    pub(crate) tangent: M::Tangent,
    /// For a scheme in temperature: the derivative of Δs by the increments of the measures.
    pub(crate) by_increment: M::Variables,
    /// For a scheme in temperature: what the old state contributes to θ̇, K/s.
    pub(crate) old_heating: S,
    /// `η_k` and `dη_k/dθ` at θ*.
    pub(crate) viscosities: (M::Viscosities, M::Viscosities),
    /// The entropy that dashpots and conduction gave it in the step, J/K.
    pub(crate) entropy_received: S,
    /// Local unknowns as functions of the global ones.
    pub(crate) condensed: Condensed<S, M>,
}

/// The solved local system: `δu = −(constant + Σ_a by_measure_a δπ_a + by_heat δr_s)`, where the
/// first entries of each array are used.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Condensed<S: Real, M: FreeEnergy<S>> {
    pub(crate) constant: M::Variables,
    pub(crate) by_measure: M::Hessian,
    pub(crate) by_heat: M::Variables,
}

impl<S: Real, M: FreeEnergy<S>, C: ElementScheme<S, M>> Member<S, M, C> {
    pub(crate) fn new(element: Element, model: M, slots: Slots) -> Self {
        let zeros = M::Variables::filled(S::zero());
        let viscosities = M::Viscosities::filled(S::zero());
        Self {
            element,
            model,
            slots,
            start: None,
            old_rates: zeros,
            x: zeros,
            entropy_change: S::zero(),
            previous_entropy_change: S::zero(),
            entropy_correction: S::zero(),
            previous: zeros,
            correction: zeros,
            corners: M::Corners::filled(S::zero()),
            response: M::Response::filled(S::zero()),
            tangent: M::Tangent::filled(zeros),
            by_increment: zeros,
            old_heating: S::zero(),
            viscosities: (viscosities, viscosities),
            entropy_received: S::zero(),
            condensed: Condensed {
                constant: zeros,
                by_measure: M::Hessian::filled(zeros),
                by_heat: zeros,
            },
        }
    }

    /// The old variables x⁰.
    pub(crate) fn old_variables(&self) -> M::Variables {
        let Some(start) = &self.start else {
            unreachable!("a step begins before its old state is used");
        };
        start.x0
    }

    /// The index of the temperature among the variables, and of θ* in the response.
    pub(crate) const fn temperature_index() -> usize {
        M::MEASURES + M::DASHPOTS
    }

    /// The new temperature that τ stands for, given the old one, K.
    pub(crate) fn new_temperature(&self, old: S) -> S {
        let theta = self.x.as_ref()[M::Variables::LEN - 1];
        match C::PLACEMENT {
            Placement::Ends | Placement::End => theta,
            Placement::Middle | Placement::Start => theta + theta - old,
        }
    }

    /// The algorithmic temperature θ*, K; zero without temperature.
    pub(crate) fn temperature(&self) -> S {
        if M::THERMAL {
            self.response.as_ref()[Self::temperature_index()]
        } else {
            S::zero()
        }
    }

    /// The power of the dashpots that the scheme takes from the old state, `Σ g⁰ (1 − w) γ̇⁰`, W.
    pub(crate) fn old_dissipation(&self) -> S {
        let Some(start) = self.start.as_ref().filter(|_| C::IMPLICIT < 1.0) else {
            return S::zero();
        };
        let dashpots = M::MEASURES..M::MEASURES + M::DASHPOTS;
        let forces = self.model.gradient(&start.x0);
        let pairs = forces.as_ref()[dashpots.clone()]
            .iter()
            .zip(&self.old_rates.as_ref()[dashpots]);
        pairs.fold(S::zero(), |sum, (&force, &rate)| sum - force * rate)
    }

    /// The free energy is finite.
    pub(crate) fn check_energy(&self, x: &M::Variables) -> Result<(), StateError> {
        let psi = self.model.free_energy(x);
        if psi.is_finite() {
            return Ok(());
        }
        Err(StateError::NotFinite {
            element: self.element,
            quantity: "free energy",
            value: psi.to_f64(),
        })
    }

    /// The viscosities at a temperature, all positive.
    pub(crate) fn find_viscosities(&mut self, theta: S) -> Result<(), StateError> {
        self.viscosities = self.model.viscosity(theta);
        let bad = self
            .viscosities
            .0
            .as_ref()
            .iter()
            .position(|&eta| !is_positive(eta));
        match bad {
            None => Ok(()),
            Some(dashpot) => Err(StateError::Viscosity {
                element: self.element,
                dashpot,
                value: self.viscosities.0.as_ref()[dashpot].to_f64(),
                temperature: M::THERMAL.then(|| theta.to_f64()),
            }),
        }
    }

    /// Starts the next correction from the present trial, with none.
    pub(crate) fn hold(&mut self) {
        self.previous = self.x;
        self.correction = M::Variables::filled(S::zero());
        self.previous_entropy_change = self.entropy_change;
        self.entropy_correction = S::zero();
    }

    /// Applies the fraction `share` of the correction: viscous stretches linearly, the temperature
    /// in its logarithm, so that it stays positive.
    pub(crate) fn apply(&mut self, share: S) {
        for index in M::MEASURES..M::MEASURES + M::DASHPOTS {
            let change = share * self.correction.as_ref()[index];
            self.x.as_mut()[index] = self.previous.as_ref()[index] + change;
        }
        if M::THERMAL {
            let index = Self::temperature_index();
            let theta = self.previous.as_ref()[index];
            let change = share * self.correction.as_ref()[index] / theta;
            self.x.as_mut()[index] = theta * limited(change).exp();
            self.entropy_change = self.previous_entropy_change + share * self.entropy_correction;
        }
    }
}

/// A change of ln θ, at most the largest that one iteration may make.
pub(super) fn limited<S: Real>(change: S) -> S {
    let most = S::from_f64(LARGEST_LOGARITHMIC_CHANGE);
    change.minimum(most).maximum(-most)
}

/// The largest change of ln θ in one Newton iteration: a factor of about 7. It bounds the reach of
/// a wild first iteration and is never met near the solution.
const LARGEST_LOGARITHMIC_CHANGE: f64 = 2.0;
