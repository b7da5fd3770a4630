//! Time integration schemes: what one element does during one step.
//!
//! A scheme says where along the step the deformation is measured and turns old and new variables
//! of an element into algorithmic quantities `f*`, `g*`, `θ*`, `Δs` with their exact tangent. It
//! knows nothing of nodes, neighbours or solvers: a new scheme is one file here, and a row in
//! [`Scheme`].

mod eem_entropy;
mod eem_temperature;
mod element;
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

use core::fmt;
use core::str::FromStr;

pub(crate) use eem_entropy::EemEntropy;
pub(crate) use eem_temperature::EemTemperature;
pub(crate) use element::{ElementScheme, Form, Infeasible, Placement, Start};
pub(crate) use midpoint::Midpoint;
pub(crate) use midpoint_temperature::MidpointTemperature;
pub(crate) use staggered::Phase;
pub(crate) use tableau::{Ending, EntropyBalance, MOST_SETS, MOST_STAGES, Tableau, UnknownSet};
pub(crate) use temperature::settled_at;
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
/// assert!(Scheme::ALL.iter().all(|scheme| scheme.to_string().parse() == Ok(*scheme)));
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

impl fmt::Display for Scheme {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// There is no scheme of this name; the message lists those there are.
///
/// ```
/// use eem_runtime::Scheme;
///
/// assert_eq!("eem-entropy".parse(), Ok(Scheme::EemEntropy));
/// let error = "euler".parse::<Scheme>().unwrap_err();
/// assert!(error.to_string().starts_with("no scheme is named `euler`; there are eem-entropy, "));
/// ```
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no scheme is named `{name}`; there are {}", names())]
pub struct UnknownScheme {
    /// What was asked for.
    pub name: String,
}

fn names() -> String {
    Scheme::ALL.map(Scheme::name).join(", ")
}

impl FromStr for Scheme {
    type Err = UnknownScheme;

    fn from_str(name: &str) -> Result<Self, UnknownScheme> {
        Self::from_name(name).ok_or_else(|| UnknownScheme {
            name: name.to_owned(),
        })
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
