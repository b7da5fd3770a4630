//! The time integration schemes, a row of data each, with their names.

use core::{fmt, str::FromStr};

use crate::element::conjugates::{Conjugates, ExactForm, OneSet, PointRule};
use crate::element::tableau::{Tableau, UnknownSet};
use crate::step::control::{Accuracy, Estimate};
use crate::step::rule::{eem_entropy_4, eem_entropy_6, gauss_4, variational_4};

/// The time integration schemes. The default, [`Auto`](Self::Auto), chooses among them.
///
/// | scheme | first law | second law | momenta | order |
/// |---|---|---|---|---|
/// | `EemEntropy` | exact | exact | exact | 2 |
/// | `EemTemperature` | exact | exact | exact | 2 |
/// | `EemDamped` | exact | exact | exact | 2 |
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
/// Momenta are exact to the rounding of `Σ |q||p|`, with q from the origin, or from the anchor if that is farther; where the
/// impulses of a step are larger than the momenta, near a singular force, to the rounding of these.
///
/// `Variational4` is stable if vibrations are resolved, `ωh < √8`. The schemes of order 4 have twice as many
/// unknowns, that of order 6 three times as many. `EemExplicit`, the variational schemes and `Gauss4` are for springs
/// only, without rockets. `EemEntropy4` and `EemEntropy6` use mean temperatures along the step, which are positive if no
/// temperature changes by more than a factor of 13.9 or 7.2 within a step; one that is not is an error.
///
/// In steps longer than their relaxation times, conduction and dashpots decay with `EemDamped` only. With the other implicit
/// schemes differences alternate or stay although all laws hold, as with any Gauss collocation:
/// [`Simulation::warning`](crate::Simulation::warning) says so, with an example.
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
    /// 2016, eqs. 37–39). Conduction and dashpots that relax faster than a step alternate; see [`EemDamped`](Self::EemDamped).
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
    /// `EemTemperature`, damped towards the end of the step so that fast conduction and dashpots in series decay in steps of any
    /// size: exactly for small differences of temperature between two bodies, and for held dashpots with quadratic energies. Steady
    /// states, steady creep and both laws stay exact. Where steps are much longer than relaxation times, slow changes have errors of
    /// first order.
    EemDamped,
    /// Chooses the cheapest exact scheme for a [tolerance](crate::Simulation::control_steps), by the effort that it counts,
    /// among those that can step the scene: it begins with `EemExplicit`, with solids, rockets and dashpots in parallel
    /// with springs with `EemTemperature`. The laws also hold when the [scheme in use](crate::Simulation::scheme_in_use)
    /// changes.
    #[default]
    Auto,
}

impl Scheme {
    /// All schemes except [`Auto`](Self::Auto), which uses these.
    pub const ALL: [Self; 14] = [
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
        Self::EemDamped,
    ];

    /// The name used on command lines and in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.rule().name
    }

    /// The scheme of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        named().find(|scheme| scheme.name() == name)
    }
}

/// How the state at the end of a step follows from the solution of Newton's method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Closing {
    /// From the increments: `Δp = (2m/h) Δq − 2p⁰`.
    Increments,
    /// The force at the start gives the displacements, the force at the end the momenta.
    Start,
    /// From the stages, by the coefficients of the [`Tableau`].
    Stages,
    /// No Newton iteration: the [explicit scheme](crate::step::explicit) closes its steps itself.
    Explicit,
}

/// The data of a scheme.
struct Rule {
    name: &'static str,
    conjugates: Conjugates,
    closing: Closing,
    /// See [`Scheme::is_exact`].
    is_exact: bool,
    /// See [`Scheme::is_classical`].
    is_classical: bool,
    order: u8,
    /// See [`Scheme::may_change_steps`].
    may_change_steps: bool,
}

impl Rule {
    const fn exact(name: &'static str, conjugates: Conjugates) -> Self {
        Self {
            name,
            conjugates,
            closing: Closing::Increments,
            is_exact: true,
            is_classical: false,
            order: 2,
            may_change_steps: true,
        }
    }

    const fn classical(name: &'static str, conjugates: Conjugates) -> Self {
        Self {
            is_exact: false,
            is_classical: true,
            ..Self::exact(name, conjugates)
        }
    }

    const fn variational(name: &'static str, conjugates: Conjugates) -> Self {
        Self {
            closing: Closing::Start,
            is_exact: false,
            may_change_steps: false,
            ..Self::exact(name, conjugates)
        }
    }

    const fn of_order(self, order: u8) -> Self {
        Self { order, ..self }
    }

    const fn closed(self, closing: Closing) -> Self {
        Self { closing, ..self }
    }

    const fn through_stages(self, order: u8) -> Self {
        self.of_order(order).closed(Closing::Stages)
    }
}

impl Scheme {
    const fn rule(self) -> Rule {
        use Conjugates::{One, Stages};
        use ExactForm::{Entropy, Temperature};
        use OneSet::{Damped, Exact, Point};
        use PointRule::{Midpoint, MidpointTemperature, Trapezoidal, TrapezoidalTemperature};
        match self {
            Self::EemEntropy => Rule::exact("eem-entropy", One(Exact(Entropy))),
            Self::EemTemperature => Rule::exact("eem-temperature", One(Exact(Temperature))),
            Self::EemDamped => Rule::exact("eem-damped", One(Damped)),
            // Explicit elements are built without conjugates.
            Self::EemExplicit => Rule::exact("eem-explicit", One(Point(PointRule::Variational)))
                .of_order(8)
                .closed(Closing::Explicit),
            // The data of the scheme with which it starts.
            Self::Auto => Rule {
                name: "auto",
                ..Self::EemExplicit.rule()
            },
            Self::Staggered => Rule::exact("staggered", One(Exact(Entropy))).of_order(1),
            Self::Variational => {
                Rule::variational("variational", One(Point(PointRule::Variational)))
            }
            Self::Variational4 => {
                Rule::variational("variational-4", Stages(&variational_4::TABLEAU))
                    .through_stages(4)
            }
            Self::Midpoint => Rule::classical("midpoint", One(Point(Midpoint))),
            Self::MidpointTemperature => {
                Rule::classical("midpoint-temperature", One(Point(MidpointTemperature)))
            }
            Self::Trapezoidal => Rule::classical("trapezoidal", One(Point(Trapezoidal))),
            Self::TrapezoidalTemperature => Rule::classical(
                "trapezoidal-temperature",
                One(Point(TrapezoidalTemperature)),
            ),
            Self::Gauss4 => Rule::classical("gauss-4", Stages(&gauss_4::TABLEAU)).through_stages(4),
            Self::EemEntropy4 => {
                Rule::exact("eem-entropy-4", Stages(&eem_entropy_4::TABLEAU)).through_stages(4)
            }
            Self::EemEntropy6 => {
                Rule::exact("eem-entropy-6", Stages(&eem_entropy_6::TABLEAU)).through_stages(6)
            }
        }
    }

    /// How the forces and temperatures of elements in a step are computed.
    pub(crate) const fn conjugates(self) -> Conjugates {
        self.rule().conjugates
    }

    /// How the state at the end of a step follows from the solution of Newton's method.
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

    /// How the error of a step depends on its size.
    pub(crate) const fn accuracy(self) -> Accuracy {
        Accuracy {
            order: self.order(),
            least_order: if self.is_damped() { 1 } else { self.order() },
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

    /// Whether Newton's method starts at the old state and tries nothing else. Others start from a motion under predicted
    /// forces, which saves most of an iteration, and if that fails continue the solution from that of a smaller step. With steps
    /// beyond the stability limit of a classical scheme, the start decides which solution is found, if any, and with the old state
    /// they break down where the literature reports it.
    pub(crate) const fn is_classical(self) -> bool {
        self.rule().is_classical
    }

    /// Whether the nodal forces have a part that depends on the old state only; see
    /// [`implicit`](crate::element::conjugates::OneSet::implicit).
    pub(crate) const fn has_old_forces(self) -> bool {
        matches!(self.conjugates(), Conjugates::One(OneSet::Point(rule)) if rule.has_old_share())
    }

    /// Whether it damps conduction and dashpots that relax within a step.
    pub(crate) const fn is_damped(self) -> bool {
        matches!(self.conjugates(), Conjugates::One(OneSet::Damped))
    }

    /// Whether its elements have a
    /// [starting form](crate::element::conjugates::Start::starting_form).
    pub(crate) const fn has_starting_form(self) -> bool {
        matches!(
            self.conjugates(),
            Conjugates::One(OneSet::Exact(ExactForm::Entropy))
        )
    }

    /// Whether mechanics and heat are stepped one after the other.
    pub(crate) const fn is_split(self) -> bool {
        matches!(self, Self::Staggered)
    }

    /// The coefficients of a scheme with stages.
    pub(crate) const fn tableau(self) -> Option<&'static Tableau> {
        match self.conjugates() {
            Conjugates::Stages(rule) => Some(rule),
            Conjugates::One(_) => None,
        }
    }

    /// The sets of unknowns.
    pub(crate) fn sets(self) -> Vec<UnknownSet> {
        let Some(rule) = self.tableau() else {
            // `(2m/h)(q¹ − q⁰) − 2p⁰ + h F`: twice the equation of one stage at the end of the step.
            return vec![UnknownSet {
                time: 1.0,
                inertia: 2.0,
            }];
        };
        let times = (0..rule.sets()).map(|set| rule.times[rule.stage_of(set)]);
        let sets = times.map(|time| UnknownSet {
            time,
            inertia: time.recip(),
        });
        sets.collect()
    }
}

impl fmt::Display for Scheme {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// No scheme has this name; the message lists the names of all schemes.
///
/// ```
/// use eem::Scheme;
///
/// assert_eq!("eem-entropy".parse(), Ok(Scheme::EemEntropy));
/// let error = "euler".parse::<Scheme>().unwrap_err();
/// assert!(error.to_string().starts_with("no scheme is named `euler`; there are eem-entropy, "));
/// ```
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no scheme is named `{name}`; there are {}", names())]
pub struct UnknownScheme {
    /// The requested name.
    pub name: String,
}

/// All schemes, and `Auto`.
fn named() -> impl Iterator<Item = Scheme> {
    Scheme::ALL.into_iter().chain([Scheme::Auto])
}

fn names() -> String {
    let names: Vec<_> = named().map(Scheme::name).collect();
    names.join(", ")
}

impl FromStr for Scheme {
    type Err = UnknownScheme;

    fn from_str(name: &str) -> Result<Self, UnknownScheme> {
        Self::from_name(name).ok_or_else(|| UnknownScheme {
            name: name.to_owned(),
        })
    }
}
