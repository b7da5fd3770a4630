//! The laws that exact schemes prove in every step.

/// A law that an exact scheme proves in every step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Law {
    /// `ΔE = work + heat`, J.
    Energy,
    /// The balance of linear momentum of the scene, kg m/s.
    LinearMomentum,
    /// The balance of angular momentum of the scene, kg m²/s.
    AngularMomentum,
    /// Every dashpot and every conductance produces entropy, J/K.
    Production,
    /// The stored entropy matches the temperature, `s = s(λ, γ, θ)`, J/K.
    KeptEntropy,
}

impl Law {
    /// The unit of its defect.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Energy => "J",
            Self::LinearMomentum => "kg m/s",
            Self::AngularMomentum => "kg m²/s",
            Self::Production | Self::KeptEntropy => "J/K",
        }
    }
}

impl core::fmt::Display for Law {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Energy => "the energy",
            Self::LinearMomentum => "the linear momentum",
            Self::AngularMomentum => "the angular momentum",
            Self::Production => "the production of entropy",
            Self::KeptEntropy => "the entropy",
        })
    }
}
