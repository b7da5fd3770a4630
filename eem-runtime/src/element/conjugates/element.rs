//! The schemes with one set of forces in a step, as elements see them.

use crate::element::conjugates::corners::find_corners;
use crate::element::conjugates::exact::ExactForm;
use crate::element::conjugates::point::PointRule;
use crate::element::error::StateError;
use crate::element::handle::Element;
pub(crate) use eem_material::free_energy::Form;
use eem_material::free_energy::{Array, FreeEnergy};
use eem_material::inversion::InversionError;
use eem_material::number::scalar::is_positive;

/// Where along a step the measures and their gradient are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Placement {
    /// New measures; force along the mean-value gradient between both ends.
    Ends,
    /// Measures and gradient of the mean configuration.
    Middle,
    /// Measures and gradient of the new configuration.
    End,
    /// Means of the old and new measures; force along the gradient of the old configuration, and
    /// then along that of the new one.
    Start,
}

/// A scheme with one set of forces in a step.
#[derive(Clone, Copy, Debug)]
pub(crate) enum OneSet {
    /// Discrete derivatives.
    Exact(ExactForm),
    /// Those in temperature form, damped towards the end of the step.
    Damped,
    /// Values at one point of the step.
    Point(PointRule),
}

impl OneSet {
    /// Where the measures are taken.
    pub(crate) fn placement(self) -> Placement {
        match self {
            Self::Exact(_) | Self::Damped => Placement::Ends,
            Self::Point(rule) => rule.placement(),
        }
    }

    /// Whether its step keeps the laws exactly.
    pub(crate) fn is_exact(self) -> bool {
        !matches!(self, Self::Point(_))
    }

    /// The fraction w of forces and rates that is taken from the response; the rest is that of the old state.
    pub(crate) fn implicit(self) -> f64 {
        match self {
            Self::Exact(_) | Self::Damped => 1.0,
            Self::Point(rule) => rule.implicit(),
        }
    }

    /// Whether the temperature is the state that the scheme integrates, and not the entropy.
    pub(crate) fn is_in_temperature(self) -> bool {
        match self {
            Self::Exact(_) | Self::Damped => false,
            Self::Point(rule) => rule.is_in_temperature(),
        }
    }
}

/// What is known of a scheme where code is compiled. The functions of a step are compiled for each family, with only its branches;
/// which one a group calls is decided once per call.
///
/// The variables of an element are `x = (π…, γ…, τ)` with a temperature τ > 0 that depends on the scheme: the new one for
/// schemes that evaluate the ends of the step, the mean one for those that evaluate its middle. Newton's method
/// corrects τ, or the entropy change Δs if [`PointRule::temperature`] finds τ from it.
pub(crate) trait Family: 'static {
    /// Whether `f*Δλ − g*Δγ + θ*Δs = Δe` exactly, so that every step has to keep the laws. Then Newton's method works on
    /// `θ* r_s` instead of `r_s`, which converges for stiff conduction too.
    const EXACT: bool;

    /// Whether it is damped towards the end of the step.
    const IS_DAMPED: bool = false;

    /// [`OneSet::placement`].
    #[inline]
    fn placement(scheme: OneSet) -> Placement {
        if Self::EXACT {
            Placement::Ends
        } else {
            scheme.placement()
        }
    }

    /// [`OneSet::implicit`].
    #[inline]
    fn implicit(scheme: OneSet) -> f64 {
        if Self::EXACT { 1.0 } else { scheme.implicit() }
    }

    /// [`OneSet::is_in_temperature`].
    #[inline]
    fn is_in_temperature(scheme: OneSet) -> bool {
        !Self::EXACT && scheme.is_in_temperature()
    }
}

/// [`OneSet::Exact`].
pub(crate) enum Exact {}

impl Family for Exact {
    const EXACT: bool = true;
}

/// [`OneSet::Damped`].
pub(crate) enum Damped {}

impl Family for Damped {
    const EXACT: bool = true;
    const IS_DAMPED: bool = true;
}

/// [`OneSet::Point`], the classical schemes.
pub(crate) enum Classical {}

impl Family for Classical {
    const EXACT: bool = false;
}

/// The old state of an element as its scheme sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start<M: FreeEnergy<f64>> {
    /// x⁰.
    pub(crate) x0: M::Variables,
    /// What the scheme keeps of the old state.
    pub(crate) old: KeptOf<M>,
}

/// What a scheme keeps of the old state. It tells the form of the step.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kept<E, T> {
    Entropy(E),
    Temperature(T),
    /// s⁰, J/K, for the classical schemes.
    State(f64),
}

/// The same for a model.
pub(crate) type KeptOf<M> =
    Kept<<M as FreeEnergy<f64>>::EntropyFormOld, <M as FreeEnergy<f64>>::TemperatureFormOld>;

impl<M: FreeEnergy<f64>> Start<M> {
    /// Before the first step.
    pub(crate) fn nothing() -> Self {
        Self {
            x0: M::Variables::filled(0.0),
            old: Kept::State(0.0),
        }
    }

    /// Stores what the scheme keeps of the old variables and the old entropy, once per step, and whether a thermostat prescribes
    /// the temperature.
    // Each in its own place: one value for all forms would be copied as the largest one.
    #[inline]
    pub(crate) fn keep(&mut self, scheme: OneSet, model: &M, entropy: f64, is_prescribed: bool) {
        match scheme {
            OneSet::Exact(ExactForm::Entropy) if !is_prescribed => {
                self.old = Kept::Entropy(model.entropy_form_old(&self.x0));
            }
            OneSet::Exact(_) | OneSet::Damped => {
                self.old = Kept::Temperature(model.temperature_form_old(&self.x0));
            }
            OneSet::Point(_) => self.old = Kept::State(entropy),
        }
    }

    /// Finds what the form needs besides the variables: temperatures of mixed states, only in entropy form.
    #[inline]
    pub(crate) fn prepare(
        &self,
        model: &M,
        x: &M::Variables,
        corners: &mut M::Corners,
    ) -> Result<(), Infeasible> {
        match &self.old {
            Kept::Entropy(old) if M::THERMAL => find_corners((model, [&self.x0, x], old), corners),
            _ => Ok(()),
        }
    }

    /// The response `(f*…, g*…, θ*, Δs)` and its tangent.
    #[inline]
    pub(crate) fn form<C: Family>(
        &self,
        scheme: OneSet,
        model: &M,
        x: &M::Variables,
        corners: &M::Corners,
    ) -> Form<f64, M> {
        if !C::EXACT {
            return scheme.point_rule().respond(model, self, x);
        }
        match &self.old {
            Kept::Entropy(old) => model.entropy_form(old, x, corners),
            Kept::Temperature(old) => model.temperature_form(old, x),
            Kept::State(_) => not_of_this_family(),
        }
    }

    /// A fallback form that is easier to solve and gives an initial guess for the entropy form: the temperature form, which has no
    /// mixed states. With a small heat capacity their temperatures overflow away from the solution.
    #[cold]
    #[inline(never)]
    pub(crate) fn starting_form(&self, model: &M, x: &M::Variables) -> Option<Form<f64, M>> {
        match self.old {
            Kept::Entropy(_) => {
                let old = model.temperature_form_old(&self.x0);
                Some(model.temperature_form(&old, x))
            }
            Kept::Temperature(_) | Kept::State(_) => None,
        }
    }

    /// The response alone, without its tangent, at the end of a step. That the new state is stable is
    /// checked where its temperature is found.
    #[inline]
    pub(crate) fn response<C: Family>(
        &self,
        scheme: OneSet,
        model: &M,
        x: &M::Variables,
        corners: &M::Corners,
    ) -> M::Response {
        if !C::EXACT {
            return scheme.point_rule().respond(model, self, x).0;
        }
        match &self.old {
            Kept::Entropy(old) => model.entropy_form_response(old, x, corners),
            Kept::Temperature(old) => model.temperature_form_response(old, x),
            Kept::State(_) => not_of_this_family(),
        }
    }

    /// The derivative of the weighted response of an exact scheme with respect to the parameters at fixed `x⁰` and `x¹`.
    #[cfg(feature = "gradients")]
    pub(crate) fn form_adjoint(
        &self,
        model: &M,
        x: &M::Variables,
        corners: &M::Corners,
        weights: &M::Response,
    ) -> M::Parameters {
        match self.old {
            Kept::Entropy(_) => model.entropy_form_adjoint(&self.x0, x, corners, weights),
            Kept::Temperature(_) => model.temperature_form_adjoint(&self.x0, x, weights),
            Kept::State(_) => not_of_this_family(),
        }
    }

    /// The derivative of the response along a direction of the parameters, likewise.
    #[cfg(feature = "gradients")]
    pub(crate) fn form_tangent(
        &self,
        model: &M,
        x: &M::Variables,
        corners: &M::Corners,
        direction: &M::Parameters,
    ) -> M::Response {
        match self.old {
            Kept::Entropy(_) => model.entropy_form_tangent(&self.x0, x, corners, direction),
            Kept::Temperature(_) => model.temperature_form_tangent(&self.x0, x, direction),
            Kept::State(_) => not_of_this_family(),
        }
    }
}

impl OneSet {
    /// The rule of a classical scheme.
    pub(crate) fn point_rule(self) -> PointRule {
        match self {
            Self::Point(rule) => rule,
            Self::Exact(_) | Self::Damped => not_of_this_family(),
        }
    }
}

/// Functions of a family are called for its schemes only.
#[cold]
pub(super) fn not_of_this_family() -> ! {
    unreachable!("a function of one family of schemes, called for another")
}

/// Why an element has no response.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Infeasible {
    /// No temperature has this entropy.
    Entropy {
        entropy: f64,
        source: InversionError,
    },
    /// The heat capacity is not positive at this temperature.
    HeatCapacity { value: f64, temperature: f64 },
}

impl Infeasible {
    /// An error unless the heat capacity is positive and finite.
    pub(crate) fn unless_stable(heat_capacity: f64, theta: f64) -> Result<(), Self> {
        if is_positive(heat_capacity) {
            return Ok(());
        }
        Err(Self::HeatCapacity {
            value: heat_capacity,
            temperature: theta,
        })
    }

    /// As the error of an element.
    pub(crate) fn of(self, element: Element) -> StateError {
        match self {
            // The inversion starts from a state of the same element: an unstable start is a heat
            // capacity that is not positive.
            Self::Entropy {
                source:
                    InversionError::UnstableStart {
                        start,
                        heat_capacity,
                    },
                ..
            } => StateError::HeatCapacity {
                element,
                value: heat_capacity,
                temperature: start,
            },
            Self::Entropy { entropy, source } => StateError::NoSuchTemperature {
                element,
                entropy,
                source,
            },
            Self::HeatCapacity { value, temperature } => StateError::HeatCapacity {
                element,
                value,
                temperature,
            },
        }
    }
}
