//! The interface of schemes to elements.

use crate::element::error::StateError;
use crate::element::handle::Element;
pub(crate) use eem_material::free_energy::Form;
use eem_material::free_energy::{Array, Entry, FormRows, FreeEnergy};
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

/// The response of an element in a step.
///
/// Variables are `x = (π…, γ…, τ)` with a temperature τ > 0 that depends on the scheme: the new one for
/// schemes that evaluate the ends of the step, the mean one for those that evaluate its middle. Newton's method
/// corrects τ, or the entropy change Δs if [`temperature`](Self::temperature) finds τ from it.
pub(crate) trait ElementScheme<M: FreeEnergy<f64>>: Copy + Send + Sync + 'static {
    /// Whether `f*Δλ − g*Δγ + θ*Δs = Δe` exactly, so that every step has to keep the laws.
    const EXACT: bool = false;

    /// Whether Newton's method works on `θ* r_s` instead of `r_s`, which converges for stiff
    /// conduction too. The classical schemes use `r_s` as usual.
    const SCALES_HEAT: bool = true;

    /// What the scheme keeps of the old state.
    type Old: Copy + Send + Sync;

    /// What it keeps from one iteration to the next, as starting values.
    type Memory: Copy + Send + Sync;

    /// `[T; 1]` for a rule that evaluates the model at one point of the step, `[T; 0]` for others.
    type AtPoint<T: Entry>: Array<T>;

    /// `[T; 1]` for a scheme that is damped towards the end of the step, `[T; 0]` for others.
    type Damping<T: Entry>: Array<T>;

    /// Where the measures are taken.
    fn placement(self) -> Placement;

    /// The fraction w of forces and rates that is taken from the response; the rest is that of the old state.
    #[inline]
    fn implicit(self) -> f64 {
        1.0
    }

    /// Whether the temperature is the state that the scheme integrates, and not the entropy.
    #[inline]
    fn is_in_temperature(self) -> bool {
        false
    }

    /// What is kept before the first step.
    fn nothing(self) -> Self::Old;

    /// Computes [`Old`](Self::Old) in its place from the old variables and the old entropy, once per step, and whether a
    /// thermostat prescribes the temperature.
    fn keep(
        self,
        model: &M,
        x0: &M::Variables,
        entropy: f64,
        is_prescribed: bool,
        old: &mut Self::Old,
    );

    /// [`keep`](Self::keep), [`form`](Self::form) and [`response`](Self::response) of several elements in one call, where the model
    /// has them. The elements of a call have no thermostats.
    fn rows(self) -> Option<FormRows<f64, M, Self::Old, Self::Memory>> {
        None
    }

    /// The first starting values of a step, from the old temperature.
    fn memory(theta0: f64) -> Self::Memory;

    /// The temperature τ of the trial, given its other variables and Δs, if the scheme has the entropy as its unknown;
    /// the present τ otherwise.
    fn temperature(
        self,
        _: &M,
        _: &Start<M, Self::Old>,
        x: &M::Variables,
        _entropy_change: f64,
    ) -> Result<f64, Infeasible> {
        Ok(x.as_ref()[M::Variables::LEN - 1])
    }

    /// Finds what the form needs besides the variables.
    #[inline]
    fn prepare(
        _: &M,
        _: &Start<M, Self::Old>,
        _: &M::Variables,
        _: &mut Self::Memory,
    ) -> Result<(), Infeasible> {
        Ok(())
    }

    /// [`prepare`](Self::prepare) of several elements, with [rows](Self::rows).
    #[inline]
    fn prepare_rows<'a>(
        _: impl Fn(usize) -> (&'a M, &'a Start<M, Self::Old>, &'a M::Variables),
        _: &mut [Self::Memory],
    ) -> Result<(), Infeasible>
    where
        M: 'a,
    {
        Ok(())
    }

    /// The response `(f*…, g*…, θ*, Δs)` and its tangent.
    fn form(
        self,
        model: &M,
        start: &Start<M, Self::Old>,
        x: &M::Variables,
        memory: &Self::Memory,
    ) -> Form<f64, M>;

    /// A fallback form that is easier to solve and gives an initial guess for this one, if there is one.
    #[cold]
    fn starting_form(_: &M, _: &Start<M, Self::Old>, _: &M::Variables) -> Option<Form<f64, M>> {
        None
    }

    /// Rejects an unstable trial of an exact scheme, by `∂Δs/∂θ¹ = C/θ¹` in its form.
    #[inline]
    fn check(x: &M::Variables, form: &Form<f64, M>) -> Result<(), Infeasible> {
        if !Self::EXACT || !M::THERMAL {
            return Ok(());
        }
        let last = M::Variables::LEN - 1;
        Infeasible::unless_stable(x[last] * form.1[last + 1][last], x[last])
    }

    /// For a scheme in temperature: replaces the Δs of the form by `Σ_i (∂s/∂x_i) δ_i`, where `δ` are the
    /// increments of measures, viscous stretches and temperature along the step, less the contributions of the
    /// old state. Returns `∂s/∂x`.
    fn change_entropy_at_rates(
        self,
        _: &M,
        _: &Start<M, Self::Old>,
        _: &M::Variables,
        _: &M::Variables,
        _: &mut Form<f64, M>,
    ) -> M::Variables {
        M::Variables::filled(0.0)
    }

    /// The response alone, without its tangent, at the end of a step. That the new state is stable is
    /// checked where its temperature is found.
    #[inline]
    fn response(
        self,
        model: &M,
        start: &Start<M, Self::Old>,
        x: &M::Variables,
        memory: &Self::Memory,
    ) -> M::Response {
        self.form(model, start, x, memory).0
    }

    /// What [`prepare`](Self::prepare) finds for the step back from the new state to the old one.
    #[cfg(feature = "gradients")]
    fn exchanged(memory: &Self::Memory) -> Self::Memory {
        *memory
    }

    /// The derivative of the weighted response with respect to the parameters at fixed `x⁰` and `x¹`; NaN unless the form is
    /// exact.
    #[cfg(feature = "gradients")]
    fn form_adjoint(
        self,
        _: &M,
        _: &Start<M, Self::Old>,
        _: &M::Variables,
        _: &Self::Memory,
        _weights: &M::Response,
    ) -> M::Parameters {
        M::Parameters::filled(f64::NAN)
    }

    /// The derivative of the response along a direction of the parameters, likewise.
    #[cfg(feature = "gradients")]
    fn form_tangent(
        self,
        _: &M,
        _: &Start<M, Self::Old>,
        _: &M::Variables,
        _: &Self::Memory,
        _direction: &M::Parameters,
    ) -> M::Response {
        M::Response::filled(f64::NAN)
    }
}

/// The old state of an element as its scheme sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start<M: FreeEnergy<f64>, Old> {
    /// x⁰.
    pub(crate) x0: M::Variables,
    /// What the scheme keeps of the old state.
    pub(crate) old: Old,
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
