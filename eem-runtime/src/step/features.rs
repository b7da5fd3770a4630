//! Which scheme can step which scene: the table behind the errors of a new simulation and the choice of [`Scheme::Auto`].

use crate::step::scheme::Scheme;

/// What a scene can have and not every scheme can step.
///
/// All schemes step springs with their dashpots, temperatures, conduction, reservoirs, thermostats, moved anchors and forces,
/// which may all be functions of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Feature {
    /// Solids, whose masses couple nodes. The end of a step has to follow from its increments; a force at a stage or at the end
    /// of a step would need a linear system of its own.
    Solids,
    /// Rockets, whose force turns within a step: the same.
    Rockets,
    /// Dashpots in parallel with springs: their force needs one gradient of the step, and mechanics and heat in one solve.
    ParallelDashpots,
}

impl Scheme {
    /// Whether it can step a feature.
    pub(crate) const fn steps(self, feature: Feature) -> bool {
        match self {
            Self::EemEntropy
            | Self::EemTemperature
            | Self::EemDamped
            | Self::EemEntropy4
            | Self::EemEntropy6
            | Self::Midpoint
            | Self::MidpointTemperature
            | Self::Trapezoidal
            | Self::TrapezoidalTemperature
            // Those of the schemes among which it chooses.
            | Self::Auto => true,
            Self::Staggered => matches!(feature, Feature::Solids | Feature::Rockets),
            Self::EemExplicit | Self::Variational | Self::Variational4 | Self::Gauss4 => false,
        }
    }

    /// Whether gradients can be taken through its steps.
    #[cfg(feature = "gradients")]
    pub(crate) const fn has_adjoint(self) -> bool {
        matches!(self, Self::EemEntropy | Self::EemTemperature)
    }
}
