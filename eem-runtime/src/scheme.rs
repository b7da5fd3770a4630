//! Time integration schemes: what one element does during one step.
//!
//! A scheme says where along the step the deformation is measured and turns old and new variables
//! of an element into algorithmic quantities `f*`, `g*`, `θ*`, `Δs` with their exact tangent. It
//! knows nothing of nodes, neighbours or solvers: a new scheme is one file here, and a row in
//! [`Scheme`].

mod eem_entropy;
mod eem_temperature;
mod gauss_4;
mod midpoint;
mod midpoint_temperature;
mod point;
mod staggered;
mod tableau;
mod temperature;
mod trapezoidal;
mod trapezoidal_temperature;
mod variational;
mod variational_4;

use crate::error::StateError;
use crate::free_energy::{Array, Entry, FreeEnergy};
use crate::handle::Element;
use crate::inversion::InversionError;
use crate::scalar::Real;
use crate::scene::is_positive;

pub(crate) use eem_entropy::EemEntropy;
pub(crate) use eem_temperature::EemTemperature;
pub(crate) use midpoint::Midpoint;
pub(crate) use midpoint_temperature::MidpointTemperature;
pub(crate) use staggered::Phase;
pub(crate) use tableau::{Ending, EntropyBalance, MOST_SETS, MOST_STAGES, Tableau, UnknownSet};
pub(crate) use temperature::{settled_at, temperature_at};
pub(crate) use trapezoidal::Trapezoidal;
pub(crate) use trapezoidal_temperature::TrapezoidalTemperature;
pub(crate) use variational::Variational;

/// The time integration schemes.
///
/// | scheme | first law | second law | momenta | order |
/// |---|---|---|---|---|
/// | `EemEntropy` | exact | exact | exact | 2 |
/// | `EemTemperature` | exact | exact | exact | 2 |
/// | `Variational` | bounded | in practice | exact | 2 |
/// | `Variational4` | bounded | exact | exact | 4 |
/// | `Staggered` | exact | exact | exact | 1 |
/// | `Midpoint` | no | no | exact | 2 |
/// | `MidpointTemperature` | no | no | exact | 2 |
/// | `Trapezoidal`, `TrapezoidalTemperature` | no | no | no | 2 |
/// | `Gauss4` | no | no | nearly | 4 |
///
/// "Exact" is to rounding, at every step and for any step size: a step that does not prove it is an error,
/// see [`StepReport::defect`](crate::StepReport::defect). `Variational4` is stable where vibrations
/// are resolved, `ωh < √8`; it solves for twice as many unknowns.
///
/// ```
/// use eem_runtime::Scheme;
///
/// assert_eq!(Scheme::EemEntropy.name(), "eem-entropy");
/// assert!(Scheme::ALL.iter().all(|scheme| Scheme::from_name(scheme.name()) == Some(*scheme)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Scheme {
    /// Energy–entropy–momentum scheme in entropy form (García Orden & Romero 2012, eqs. 25–28).
    EemEntropy,
    /// Energy–entropy–momentum scheme in temperature form (Conde Martín, Betsch & García Orden
    /// 2016, eqs. 37–39).
    EemTemperature,
    /// Variational integrator with thermacies (Kern, Romero, Conde Martín & García Orden 2021,
    /// §III.A).
    Variational,
    /// Variational integrator of fourth order, by Simpson's rule (as above, eqs. 21–24).
    Variational4,
    /// Fractional step, mechanics and then heat (Romero 2010, part II).
    Staggered,
    /// Implicit midpoint rule on positions, momenta, viscous stretches and entropies.
    Midpoint,
    /// Implicit midpoint rule on positions, momenta, viscous stretches and temperatures.
    MidpointTemperature,
    /// Trapezoidal rule on positions, momenta, viscous stretches and entropies.
    Trapezoidal,
    /// Trapezoidal rule on positions, momenta, viscous stretches and temperatures.
    TrapezoidalTemperature,
    /// Gauss collocation of two stages on positions, momenta, viscous stretches and entropies.
    Gauss4,
}

impl Scheme {
    /// All schemes.
    pub const ALL: [Self; 10] = [
        Self::EemEntropy,
        Self::EemTemperature,
        Self::Variational,
        Self::Variational4,
        Self::Staggered,
        Self::Midpoint,
        Self::MidpointTemperature,
        Self::Trapezoidal,
        Self::TrapezoidalTemperature,
        Self::Gauss4,
    ];

    /// The name used on command lines and in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::EemEntropy => "eem-entropy",
            Self::EemTemperature => "eem-temperature",
            Self::Variational => "variational",
            Self::Variational4 => "variational-4",
            Self::Staggered => "staggered",
            Self::Midpoint => "midpoint",
            Self::MidpointTemperature => "midpoint-temperature",
            Self::Trapezoidal => "trapezoidal",
            Self::TrapezoidalTemperature => "trapezoidal-temperature",
            Self::Gauss4 => "gauss-4",
        }
    }

    /// The scheme of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|scheme| scheme.name() == name)
    }
}

impl Scheme {
    /// Whether Newton's method starts from a motion under foretold forces, which saves most of an
    /// iteration. The ordinary rules start at the old state, as ordinary codes do: beyond
    /// their stable steps it depends on the start which state is found, if any, and so they
    /// break down where the literature says.
    pub(crate) const fn foretells_its_start(self) -> bool {
        !self.is_ordinary()
    }

    /// Whether a solution that is not found at once is followed from a small step on. Not for the
    /// ordinary rules, for the same reason.
    pub(crate) const fn follows_its_solution(self) -> bool {
        !self.is_ordinary()
    }

    const fn is_ordinary(self) -> bool {
        match self {
            Self::EemEntropy
            | Self::EemTemperature
            | Self::Variational
            | Self::Variational4
            | Self::Staggered => false,
            Self::Midpoint
            | Self::MidpointTemperature
            | Self::Trapezoidal
            | Self::TrapezoidalTemperature
            | Self::Gauss4 => true,
        }
    }
}

impl Scheme {
    /// Whether nodes feel forces that the old state alone decides; see
    /// [`IMPLICIT`](ElementScheme::IMPLICIT).
    pub(crate) const fn has_old_forces(self) -> bool {
        matches!(self, Self::Trapezoidal | Self::TrapezoidalTemperature)
    }
}

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

/// How the end of a step follows from what Newton's method has found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Closing {
    /// From the increments: `Δp = (2m/h) Δq − 2p⁰`.
    Increments,
    /// The force at the start gives the displacements, the force at the end the momenta.
    Start,
    /// As the [`Tableau`] says.
    Stages,
}

impl Scheme {
    /// The numbers of a scheme that goes through stages.
    pub(crate) const fn tableau(self) -> Option<&'static Tableau> {
        match self {
            Self::Variational4 => Some(&variational_4::TABLEAU),
            Self::Gauss4 => Some(&gauss_4::TABLEAU),
            Self::EemEntropy
            | Self::EemTemperature
            | Self::Variational
            | Self::Staggered
            | Self::Midpoint
            | Self::MidpointTemperature
            | Self::Trapezoidal
            | Self::TrapezoidalTemperature => None,
        }
    }

    /// The sets of unknowns.
    pub(crate) fn sets(self) -> Vec<UnknownSet> {
        let Some(rule) = self.tableau() else {
            // `(2m/h)(q¹ − q⁰) − 2p⁰ + h F`: twice that of one stage at the end.
            return vec![UnknownSet {
                time: 1.0,
                inertia: 2.0,
            }];
        };
        let sets = (0..rule.sets()).map(|set| {
            let time = rule.times[rule.stage_of(set)];
            let inertia = time.recip();
            UnknownSet { time, inertia }
        });
        sets.collect()
    }
}

impl Scheme {
    /// How the end of a step follows from what Newton's method has found.
    pub(crate) const fn closing(self) -> Closing {
        match self {
            Self::Variational => Closing::Start,
            Self::Variational4 | Self::Gauss4 => Closing::Stages,
            Self::EemEntropy
            | Self::EemTemperature
            | Self::Staggered
            | Self::Midpoint
            | Self::MidpointTemperature
            | Self::Trapezoidal
            | Self::TrapezoidalTemperature => Closing::Increments,
        }
    }

    /// Whether its elements have a [starting form](ElementScheme::starting_form).
    pub(crate) const fn has_starting_form(self) -> bool {
        matches!(self, Self::EemEntropy | Self::Staggered)
    }

    /// Whether every step has to keep energy, entropy and momenta.
    pub(crate) const fn is_exact(self) -> bool {
        matches!(
            self,
            Self::EemEntropy | Self::EemTemperature | Self::Staggered
        )
    }
}

/// What an element does during one step.
///
/// Variables are `x = (π…, γ…, τ)` with a temperature τ > 0 of the scheme's own: the new one for
/// schemes that look at the ends, the mean one for those that look at the middle. Newton's method
/// corrects τ, or the entropy change Δs if [`temperature`](Self::temperature) finds τ from it.
pub(crate) trait ElementScheme<S: Real, M: FreeEnergy<S>>: Send + Sync + 'static {
    /// Where the measures are taken.
    const PLACEMENT: Placement;

    /// The part of forces and rates that is taken from the response; the rest, `1 − IMPLICIT`, is
    /// that of the old state.
    const IMPLICIT: f64;

    /// Whether `f*Δλ − g*Δγ + θ*Δs = Δe` exactly, so that every step has to keep the laws.
    const EXACT: bool = false;

    /// Whether Newton's method works on `θ* r_s` instead of `r_s`, which converges for stiff
    /// conduction too. The ordinary rules are solved the ordinary way.
    const SCALES_HEAT: bool = true;

    /// Whether the temperature is the state that the scheme integrates, and not the entropy.
    const IN_TEMPERATURE: bool = false;

    /// Whether the scheme takes the entropy for its unknown and finds τ from it.
    const FINDS_TEMPERATURE: bool = false;

    /// What the scheme keeps of the old state.
    type Old: Copy + Send + Sync;

    /// What it keeps from one look at a step to the next, as starting values.
    type Memory: Copy + Send + Sync;

    /// `[T; 1]` for a rule that looks at one point of the step, `[T; 0]` for others: room for what
    /// only such rules need.
    type AtPoint<T: Entry>: Array<T>;

    /// Looks at the old variables and the old entropy, once per step.
    fn old(model: &M, x0: &M::Variables, entropy: S) -> Self::Old;

    /// The first starting values of a step, from the old temperature.
    fn memory(theta0: S) -> Self::Memory;

    /// The temperature τ of the trial, given its other variables and Δs.
    ///
    /// The present τ unless the scheme takes the entropy for its unknown.
    fn temperature(
        _: &M,
        _: &Start<S, M, Self::Old>,
        x: &M::Variables,
        _entropy_change: S,
    ) -> Result<S, Infeasible> {
        Ok(x.as_ref()[M::Variables::LEN - 1])
    }

    /// Finds what the form needs besides the variables.
    #[inline]
    fn prepare(
        _: &M,
        _: &Start<S, M, Self::Old>,
        _: &M::Variables,
        _: &mut Self::Memory,
    ) -> Result<(), Infeasible> {
        Ok(())
    }

    /// The response `(f*…, g*…, θ*, Δs)` and its tangent.
    fn form(
        model: &M,
        start: &Start<S, M, Self::Old>,
        x: &M::Variables,
        memory: &Self::Memory,
    ) -> Form<S, M>;

    /// A form that is easier to solve for where this one is hard to start, if there is one.
    #[cold]
    fn starting_form(_: &M, _: &Start<S, M, Self::Old>, _: &M::Variables) -> Option<Form<S, M>> {
        None
    }

    /// Refuses a trial that is not stable, as its form tells.
    #[inline]
    fn check(_: &M::Variables, _: &Form<S, M>) -> Result<(), Infeasible> {
        Ok(())
    }

    /// For a scheme in temperature: replaces the Δs of the form by that of rates, where increments
    /// say by how much the rates along the step change measures, viscous stretches and temperature,
    /// apart from what the old state contributes. Returns its derivative by the increments.
    fn change_entropy_at_rates(
        _: &M,
        _: &Start<S, M, Self::Old>,
        _: &M::Variables,
        _: &M::Variables,
        _: &mut Form<S, M>,
    ) -> M::Variables {
        M::Variables::filled(S::zero())
    }

    /// The response alone: for the last look at a step. That the new state is stable is left to the
    /// one who finds its temperature.
    #[inline]
    fn response(
        model: &M,
        start: &Start<S, M, Self::Old>,
        x: &M::Variables,
        memory: &Self::Memory,
    ) -> M::Response {
        Self::form(model, start, x, memory).0
    }
}

/// A response and its derivative by the variables.
pub(crate) type Form<S, M> = (
    <M as FreeEnergy<S>>::Response,
    <M as FreeEnergy<S>>::Tangent,
);

/// The old state of an element as its scheme sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Start<S: Real, M: FreeEnergy<S>, Old> {
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
    pub(crate) fn unless_stable<S: Real>(heat_capacity: S, theta: S) -> Result<(), Self> {
        if is_positive(heat_capacity) {
            return Ok(());
        }
        Err(Self::HeatCapacity {
            value: heat_capacity.to_f64(),
            temperature: theta.to_f64(),
        })
    }

    /// The same, said of an element.
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
