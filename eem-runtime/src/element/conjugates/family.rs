//! The schemes with one set of forces in a step, and what is known of them where code is compiled.

pub(crate) use eem_material::free_energy::ExactForm;

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

/// The rules at one point of a step, see the module [point](super::point).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PointRule {
    /// Midpoint rule for entropies.
    Midpoint,
    /// Midpoint rule for temperatures.
    MidpointTemperature,
    /// Trapezoidal rule for entropies.
    Trapezoidal,
    /// Trapezoidal rule for temperatures.
    TrapezoidalTemperature,
    /// No rule for steps: values at a state at rest.
    Rest,
    /// From Hamilton's principle.
    Variational,
}

impl PointRule {
    /// The time c of the point, as a fraction of the step.
    pub(super) const fn time(self) -> f64 {
        match self {
            Self::Midpoint | Self::MidpointTemperature | Self::Variational => 0.5,
            Self::Trapezoidal | Self::TrapezoidalTemperature | Self::Rest => 1.0,
        }
    }

    /// Whether the old state contributes to forces and rates.
    pub(crate) const fn has_old_share(self) -> bool {
        matches!(self, Self::Trapezoidal | Self::TrapezoidalTemperature)
    }

    fn placement(self) -> Placement {
        match self {
            Self::Midpoint | Self::MidpointTemperature => Placement::Middle,
            Self::Trapezoidal | Self::TrapezoidalTemperature | Self::Rest => Placement::End,
            Self::Variational => Placement::Start,
        }
    }

    fn implicit(self) -> f64 {
        if self.has_old_share() { 0.5 } else { 1.0 }
    }

    fn is_in_temperature(self) -> bool {
        matches!(
            self,
            Self::MidpointTemperature | Self::TrapezoidalTemperature
        )
    }
}

/// A scheme with one set of forces in a step.
#[derive(Clone, Copy, Debug)]
pub(crate) enum OneSet {
    /// Discrete derivatives, see the module [exact](super::exact).
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

    /// Its form, if its step keeps the laws exactly.
    pub(crate) fn form(self) -> Option<ExactForm> {
        match self {
            Self::Exact(form) => Some(form),
            Self::Damped => Some(ExactForm::Temperature),
            Self::Point(_) => None,
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

    /// The rule of a classical scheme.
    pub(crate) fn point_rule(self) -> PointRule {
        match self {
            Self::Point(rule) => rule,
            Self::Exact(_) | Self::Damped => not_of_this_family(),
        }
    }
}

/// What is known of a scheme where code is compiled. The functions of a step are compiled for [`Exact`], with only its branches, and for
/// [`Any`] scheme; which one a group calls is decided once per call.
///
/// The variables of an element are `x = (π…, γ…, τ)` with a temperature τ > 0 that depends on the scheme: the new one for
/// schemes that evaluate the ends of the step, the mean one for those that evaluate its middle. Newton's method
/// corrects τ, or the entropy change Δs if [`PointRule::temperature`] finds τ from it.
pub(crate) trait Family: Send + Sync + 'static {
    /// Whether the scheme is known to be [`OneSet::Exact`].
    const IS_EXACT: bool;

    /// Whether `f*Δλ − g*Δγ + θ*Δs = Δe` exactly, so that every step has to keep the laws. Then Newton's method works on
    /// `θ* r_s` instead of `r_s`, which converges for stiff conduction too.
    #[inline]
    fn is_exact(scheme: OneSet) -> bool {
        Self::IS_EXACT || scheme.is_exact()
    }

    /// Whether it is damped towards the end of the step.
    #[inline]
    fn is_damped(scheme: OneSet) -> bool {
        !Self::IS_EXACT && matches!(scheme, OneSet::Damped)
    }

    /// [`OneSet::placement`].
    #[inline]
    fn placement(scheme: OneSet) -> Placement {
        if Self::IS_EXACT {
            Placement::Ends
        } else {
            scheme.placement()
        }
    }

    /// [`OneSet::implicit`].
    #[inline]
    fn implicit(scheme: OneSet) -> f64 {
        if Self::IS_EXACT {
            1.0
        } else {
            scheme.implicit()
        }
    }

    /// [`OneSet::is_in_temperature`].
    #[inline]
    fn is_in_temperature(scheme: OneSet) -> bool {
        !Self::IS_EXACT && scheme.is_in_temperature()
    }
}

/// [`OneSet::Exact`].
pub(crate) enum Exact {}

impl Family for Exact {
    const IS_EXACT: bool = true;
}

/// Any scheme: the damped one and the classical ones.
pub(crate) enum Any {}

impl Family for Any {
    const IS_EXACT: bool = false;
}

/// Functions of a family are called for its schemes only.
#[cold]
pub(super) fn not_of_this_family() -> ! {
    unreachable!("a function of one family of schemes, called for another")
}
