//! The time integration schemes, a row of data each.

use crate::element::conjugates::{Conjugates, PointRule};
use crate::step::control::{Accuracy, Estimate};
use crate::step::rule::{eem_entropy_4, eem_entropy_6, gauss_4, variational_4};

/// The time integration schemes. The default, [`Auto`](Self::Auto), chooses among them.
///
/// | scheme | first law | second law | momenta | order |
/// |---|---|---|---|---|
/// | `EemEntropy` | exact | exact | exact | 2 |
/// | `EemTemperature` | exact | exact | exact | 2 |
/// | `EemEntropy4` | exact | exact | exact | 4 |
/// | `EemEntropy6` | exact | exact | exact | 6 |
/// | `EemExplicit` | exact | exact | exact | 8 |
/// | `Variational` | bounded | in practice | exact | 2 |
/// | `Variational4` | bounded | exact | exact | 4 |
/// | `Staggered` | exact | exact | exact | 1 |
/// | `Midpoint` | no | no | exact | 2 |
/// | `MidpointTemperature` | no | no | exact | 2 |
/// | `Trapezoidal`, `TrapezoidalTemperature` | no | no | no | 2 |
/// | `Gauss4` | no | no | nearly | 4 |
/// | `Auto` | exact | exact | exact | 8 or less |
///
/// "Exact" means to rounding, in every step of any size. The schemes that are exact in all three columns prove it
/// in every step, or return an error; see [`StepReport::defect`](crate::StepReport::defect). The others prove
/// nothing: they report the same numbers and do not fail.
/// Momenta are exact to the rounding of `Σ |q||p|`, with q from the origin, or from the anchor if that is farther.
///
/// `Variational4` is stable if vibrations are resolved, `ωh < √8`. The schemes of order 4 have twice as many
/// unknowns, that of order 6 three times as many. `EemExplicit`, the variational schemes and `Gauss4` are for springs
/// only, without rockets. `EemEntropy4` and `EemEntropy6` use mean temperatures along the step. One that is not positive is an error; they are positive if no temperature
/// changes by more than a factor of 13.9 or 7.2 within a step. Dashpots and conduction much faster than a step
/// decay slowly, as with any Gauss collocation.
///
/// ```
/// use eem::Scheme;
///
/// assert_eq!(Scheme::EemEntropy.name(), "eem-entropy");
/// assert!(Scheme::ALL.iter().all(|scheme| scheme.to_string().parse() == Ok(*scheme)));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Scheme {
    /// Energy–entropy–momentum scheme in entropy form (García Orden & Romero 2012, eqs. 25–28).
    EemEntropy,
    /// Energy–entropy–momentum scheme in temperature form (Conde Martín, Betsch & García Orden
    /// 2016, eqs. 37–39).
    EemTemperature,
    /// Explicit Runge–Kutta stages of order 8 (DOP853), entropies by quadrature, and one correction of energy and
    /// momenta per step. For accuracy if vibrations are resolved: `ωh < 5.96`.
    EemExplicit,
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
    /// Energy–entropy–momentum scheme of order 4: Gauss collocation with two stages; forces, dashpot forces and
    /// temperatures are projected in time (Groß & Betsch 2011; strain assumed in time: Betsch & Steinmann 2001).
    EemEntropy4,
    /// Energy–entropy–momentum scheme of order 6, with three stages.
    EemEntropy6,
    /// Chooses the cheapest exact scheme for a [tolerance](crate::Simulation::control_steps): `EemExplicit`, unless
    /// stability limits its steps more than accuracy does, and `EemTemperature` for solids and for dashpots in
    /// parallel with springs. The laws also hold when the [scheme in use](crate::Simulation::scheme_in_use)
    /// changes.
    #[default]
    Auto,
}

impl Scheme {
    /// All schemes except [`Auto`](Self::Auto), which uses these.
    pub const ALL: [Self; 13] = [
        Self::EemEntropy,
        Self::EemTemperature,
        Self::EemExplicit,
        Self::Variational,
        Self::Variational4,
        Self::Staggered,
        Self::Midpoint,
        Self::MidpointTemperature,
        Self::Trapezoidal,
        Self::TrapezoidalTemperature,
        Self::Gauss4,
        Self::EemEntropy4,
        Self::EemEntropy6,
    ];

    /// The name used on command lines and in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.rule().name
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
    /// No Newton iteration: the [explicit scheme](crate::step::explicit) closes its steps itself.
    Explicit,
}

/// What a scheme is.
struct Rule {
    name: &'static str,
    conjugates: Conjugates,
    closing: Closing,
    /// See [`Scheme::is_exact`].
    is_exact: bool,
    /// See [`Scheme::foretells_its_start`].
    is_ordinary: bool,
    order: u8,
    /// Whether what it keeps does not depend on the sizes of steps.
    may_change_steps: bool,
}

impl Rule {
    const fn exact(name: &'static str, conjugates: Conjugates) -> Self {
        Self {
            name,
            conjugates,
            closing: Closing::Increments,
            is_exact: true,
            is_ordinary: false,
            order: 2,
            may_change_steps: true,
        }
    }

    const fn ordinary(name: &'static str, conjugates: Conjugates) -> Self {
        Self {
            name,
            conjugates,
            closing: Closing::Increments,
            is_exact: false,
            is_ordinary: true,
            order: 2,
            may_change_steps: true,
        }
    }

    const fn variational(name: &'static str, conjugates: Conjugates) -> Self {
        Self {
            name,
            conjugates,
            closing: Closing::Start,
            is_exact: false,
            is_ordinary: false,
            order: 2,
            may_change_steps: false,
        }
    }

    const fn of_order(self, order: u8) -> Self {
        Self { order, ..self }
    }

    const fn closed_explicitly(self) -> Self {
        Self {
            closing: Closing::Explicit,
            ..self
        }
    }

    const fn through_stages(self, order: u8) -> Self {
        Self {
            closing: Closing::Stages,
            order,
            ..self
        }
    }
}

impl Scheme {
    const fn rule(self) -> Rule {
        use Conjugates::{EntropyForm, Point, Stages, TemperatureForm};
        match self {
            Self::EemEntropy => Rule::exact("eem-entropy", EntropyForm),
            Self::EemTemperature => Rule::exact("eem-temperature", TemperatureForm),
            // Its elements have no algorithmic quantities of their own.
            Self::EemExplicit => Rule::exact("eem-explicit", Point(PointRule::Variational))
                .of_order(8)
                .closed_explicitly(),
            // That of its first one.
            Self::Auto => Rule {
                name: "auto",
                ..Self::EemExplicit.rule()
            },
            Self::Staggered => Rule::exact("staggered", EntropyForm).of_order(1),
            Self::Variational => Rule::variational("variational", Point(PointRule::Variational)),
            Self::Variational4 => {
                Rule::variational("variational-4", Stages(&variational_4::TABLEAU))
                    .through_stages(4)
            }
            Self::Midpoint => Rule::ordinary("midpoint", Point(PointRule::Midpoint)),
            Self::MidpointTemperature => Rule::ordinary(
                "midpoint-temperature",
                Point(PointRule::MidpointTemperature),
            ),
            Self::Trapezoidal => Rule::ordinary("trapezoidal", Point(PointRule::Trapezoidal)),
            Self::TrapezoidalTemperature => Rule::ordinary(
                "trapezoidal-temperature",
                Point(PointRule::TrapezoidalTemperature),
            ),
            Self::Gauss4 => Rule::ordinary("gauss-4", Stages(&gauss_4::TABLEAU)).through_stages(4),
            Self::EemEntropy4 => {
                Rule::exact("eem-entropy-4", Stages(&eem_entropy_4::TABLEAU)).through_stages(4)
            }
            Self::EemEntropy6 => {
                Rule::exact("eem-entropy-6", Stages(&eem_entropy_6::TABLEAU)).through_stages(6)
            }
        }
    }

    /// Where the algorithmic quantities of its elements come from.
    pub(crate) const fn conjugates(self) -> Conjugates {
        self.rule().conjugates
    }

    /// How the end of a step follows from what Newton's method has found.
    pub(crate) const fn closing(self) -> Closing {
        self.rule().closing
    }

    /// The order p: errors at a given time are proportional to `hᵖ`.
    ///
    /// ```
    /// use eem::Scheme;
    ///
    /// assert_eq!(Scheme::EemEntropy.order(), 2);
    /// assert_eq!(Scheme::Gauss4.order(), 4);
    /// ```
    #[must_use]
    pub const fn order(self) -> u8 {
        self.rule().order
    }

    /// Whether [step control](crate::Simulation::control_steps) can be used.
    ///
    /// Not for variational schemes: their energy is bounded only at constant step size, and drifts otherwise.
    ///
    /// ```
    /// use eem::Scheme;
    ///
    /// assert!(Scheme::EemEntropy.may_change_steps());
    /// assert!(!Scheme::Variational4.may_change_steps());
    /// ```
    #[must_use]
    pub const fn may_change_steps(self) -> bool {
        self.rule().may_change_steps
    }

    /// How the error of a step goes with its size.
    pub(crate) const fn accuracy(self) -> Accuracy {
        Accuracy {
            order: self.order(),
            estimate: match self.closing() {
                Closing::Explicit => Estimate::Embedded,
                Closing::Increments | Closing::Start | Closing::Stages => Estimate::Halves,
            },
        }
    }

    /// Whether every step proves energy, entropy and momenta, or is an error.
    ///
    /// ```
    /// use eem::Scheme;
    ///
    /// assert!(Scheme::EemEntropy.is_exact() && !Scheme::Midpoint.is_exact());
    /// ```
    #[must_use]
    pub const fn is_exact(self) -> bool {
        self.rule().is_exact
    }

    /// Whether Newton's method starts from a motion under foretold forces, which saves most of an
    /// iteration. The ordinary rules start at the old state, as ordinary codes do: beyond
    /// their stable steps it depends on the start which state is found, if any, and so they
    /// break down where the literature says.
    pub(crate) const fn foretells_its_start(self) -> bool {
        !self.rule().is_ordinary
    }

    /// Whether a solution that is not found at once is followed from a small step on. Not for the
    /// ordinary rules, for the same reason.
    pub(crate) const fn follows_its_solution(self) -> bool {
        !self.rule().is_ordinary
    }
}
