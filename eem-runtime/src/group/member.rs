//! One element of a group: its model and its part of the trial state.

use super::site::Site;
use crate::error::StateError;
use crate::free_energy::{Array, FreeEnergy};
use crate::handle::Element;
use crate::kinematics::{Arms, Gradient, Kinematics};
use crate::layout::Slots;
use crate::scalar::Real;
use crate::scene::is_positive;
use crate::scheme::{Answer, ElementScheme, Placement, Start};

/// An element, with everything that one step of the scheme `C` needs to remember of it.
pub(crate) struct Member<S, M, K, C, const D: usize>
where
    S: Real,
    M: FreeEnergy<S>,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    pub(super) element: Element,
    pub(super) model: M,
    pub(super) slots: Slots,
    pub(super) site: Site<K, S, D>,
    /// The old state.
    pub(super) start: Start<S, M, C::Old>,
    /// What the old state alone contributes to the rates of the internal variables.
    pub(super) old_rates: M::Variables,
    /// For a scheme in temperature: what the old state contributes to θ̇, K/s.
    pub(super) old_heating: S,
    /// The trial variables `(π, γ, τ)`.
    pub(super) x: M::Variables,
    /// The trial variables before the last correction, and the correction.
    pub(super) previous: M::Variables,
    pub(super) correction: M::Variables,
    /// The trial Δs, before the last correction, and the correction, J/K.
    pub(super) entropy_change: S,
    pub(super) previous_entropy_change: S,
    pub(super) entropy_correction: S,
    /// Corner temperatures, kept as starting values.
    pub(super) corners: M::Corners,
    /// The response at the trial and its tangent.
    pub(super) answer: Answer<S, M>,
    /// `η_k` and `dη_k/dθ` at θ*.
    pub(super) viscosities: (M::Viscosities, M::Viscosities),
    /// The derivative of the measures by the new arms.
    pub(super) sensitivity: Gradient<K, S, D>,
    /// For a scheme in temperature: the derivative of Δs by the new arms through the increments
    /// of the measures.
    pub(super) by_increment: Arms<K, S, D>,
    /// Local unknowns as functions of the global ones.
    pub(super) condensed: Condensed<S, M>,
    /// The entropy that dashpots and conduction gave it in the step, J/K.
    pub(super) entropy_received: S,
}

/// The solved local system: `δu = −(constant + by_measure δπ + by_heat δr_s)`, a row per local
/// unknown, of which there are fewer than variables: the first entries and rows are used.
#[derive(Clone, Copy, Debug)]
pub(super) struct Condensed<S: Real, M: FreeEnergy<S>> {
    pub(super) constant: M::Variables,
    pub(super) by_measure: M::Hessian,
    pub(super) by_heat: M::Variables,
}

impl<S, M, K, C, const D: usize> Member<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S>,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// Number of variables.
    pub(super) const VARIABLES: usize = M::Variables::LEN;

    /// Number of variables that are eliminated within the element: viscous stretches, temperature.
    pub(super) const UNKNOWNS: usize = M::Variables::LEN - M::MEASURES;

    /// The index of the temperature among the variables, and of θ* in the response.
    pub(super) const TEMPERATURE: usize = M::MEASURES + M::DASHPOTS;

    /// The index of Δs in the response.
    pub(super) const ENTROPY: usize = Self::TEMPERATURE + 1;

    pub(super) fn new(element: Element, model: M, slots: Slots, nodes: &[usize]) -> Self {
        let zeros = M::Variables::filled(S::zero());
        let viscosities = M::Viscosities::filled(S::zero());
        let nowhere = Arms::<K, S, D>::filled([S::zero(); D]);
        let old = C::old(&model, &zeros);
        Self {
            element,
            model,
            slots,
            site: Site::unconnected(nodes),
            start: Start {
                x0: zeros,
                entropy: S::zero(),
                old,
            },
            old_rates: zeros,
            old_heating: S::zero(),
            x: zeros,
            previous: zeros,
            correction: zeros,
            entropy_change: S::zero(),
            previous_entropy_change: S::zero(),
            entropy_correction: S::zero(),
            corners: M::Corners::filled(S::zero()),
            answer: Answer::none(),
            viscosities: (viscosities, viscosities),
            sensitivity: Gradient::<K, S, D>::filled(nowhere),
            by_increment: nowhere,
            condensed: Condensed {
                constant: zeros,
                by_measure: M::Hessian::filled(zeros),
                by_heat: zeros,
            },
            entropy_received: S::zero(),
        }
    }

    /// The new temperature that τ stands for, given the old one, K.
    pub(super) fn new_temperature(&self, old: S) -> S {
        let theta = self.x[Self::TEMPERATURE];
        match C::PLACEMENT {
            Placement::Ends | Placement::End => theta,
            Placement::Middle | Placement::Start => theta + theta - old,
        }
    }

    /// The algorithmic temperature θ*, K; zero without temperature.
    #[inline]
    pub(super) fn temperature(&self) -> S {
        if M::THERMAL {
            self.answer.response[Self::TEMPERATURE]
        } else {
            S::zero()
        }
    }

    /// The power of the dashpots that the scheme takes from the old state, `Σ g⁰ (1 − w) γ̇⁰`, W.
    pub(super) fn old_dissipation(&self) -> S {
        if C::IMPLICIT >= 1.0 || M::DASHPOTS == 0 {
            return S::zero();
        }
        let forces = self.model.gradient(&self.start.x0);
        let dashpots = M::MEASURES..Self::TEMPERATURE;
        dashpots.fold(S::zero(), |sum, k| sum - forces[k] * self.old_rates[k])
    }

    /// The free energy is finite.
    pub(super) fn check_energy(&self, x: &M::Variables) -> Result<(), StateError> {
        self.unless_infinite(self.model.free_energy(x))
    }

    /// See [`check_energy`](Self::check_energy).
    pub(super) fn unless_infinite(&self, psi: S) -> Result<(), StateError> {
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
    #[inline]
    pub(super) fn find_viscosities(&mut self, theta: S) -> Result<(), StateError> {
        if M::DASHPOTS == 0 {
            return Ok(());
        }
        self.viscosities = self.model.viscosity(theta);
        let viscosities = self.viscosities.0.as_ref();
        match viscosities.iter().position(|&eta| !is_positive(eta)) {
            None => Ok(()),
            Some(dashpot) => Err(StateError::Viscosity {
                element: self.element,
                dashpot,
                value: viscosities[dashpot].to_f64(),
                temperature: M::THERMAL.then(|| theta.to_f64()),
            }),
        }
    }

    /// Starts the next correction from the present trial, with none.
    pub(super) fn hold(&mut self) {
        self.previous = self.x;
        self.correction = M::Variables::filled(S::zero());
        self.previous_entropy_change = self.entropy_change;
        self.entropy_correction = S::zero();
    }

    /// Applies the fraction `share` of the correction: viscous stretches linearly, the temperature
    /// in its logarithm, so that it stays positive.
    #[inline]
    pub(super) fn apply(&mut self, share: S) {
        for index in M::MEASURES..Self::TEMPERATURE {
            self.x[index] = self.previous[index] + share * self.correction[index];
        }
        if M::THERMAL {
            let theta = self.previous[Self::TEMPERATURE];
            let change = share * self.correction[Self::TEMPERATURE];
            self.x[Self::TEMPERATURE] = grown(theta, change);
            self.entropy_change = self.previous_entropy_change + share * self.entropy_correction;
        }
    }

    /// Applies the correction to the measures and, through the tangent, to forces and temperature.
    ///
    /// What that leaves out is of second order in the correction.
    #[inline]
    pub(super) fn extrapolate(&mut self) {
        self.apply(S::one());
        for a in 0..M::MEASURES {
            self.x[a] = self.previous[a] + self.correction[a];
        }
        let mut heating = S::zero();
        for row in 0..Self::VARIABLES {
            let mut change = S::zero();
            for column in 0..Self::VARIABLES {
                change += self.answer.tangent[row][column] * self.correction[column];
            }
            self.answer.response[row] += change;
            heating = change;
        }
        if M::THERMAL {
            for k in 0..M::DASHPOTS {
                self.viscosities.0[k] += self.viscosities.1[k] * heating;
            }
        }
    }
}

/// A temperature after the correction δθ, `θ (θ + ½δθ)/(θ − ½δθ)`.
///
/// It is `θ e^(δθ/θ)` up to `(δθ/θ)³/12`, positive, and limited to what one iteration may do.
#[inline]
pub(super) fn grown<S: Real>(theta: S, change: S) -> S {
    let most = S::from_f64(LARGEST_HALF_CHANGE) * theta;
    let half = (S::from_f64(0.5) * change).minimum(most).maximum(-most);
    theta * ((theta + half) / (theta - half))
}

/// Half the largest change of ln θ in one Newton iteration: a factor of 7. It bounds the reach of
/// a wild first iteration and is never met near the solution.
const LARGEST_HALF_CHANGE: f64 = 0.75;
