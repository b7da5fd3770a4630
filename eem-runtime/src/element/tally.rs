//! What the elements and the paths of heat of a step contribute to its certificate.

use eem_material::number::scalar::{Mask, Real};

/// Roundings of the amplitude that a law may be off by.
pub(crate) const ROUNDINGS: f64 = 64.0;

/// Roundings of the terms of the balance of a node, a dashpot or a temperature that it may be off by, when
/// the arguments of the forces are left out: what is left of a small update is of this size, where false
/// convergence is off by the terms themselves. Energy and momenta are judged apart.
const BALANCE_ROUNDINGS: f64 = 4096.0;

/// How much of what rounding explains is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Care {
    /// The terms of the balances alone, which is enough for most steps.
    Quick,
    /// Also the rounding of the arguments of the forces.
    Thorough,
}

/// What elements and paths of heat contribute to a certificate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tally<S: Real> {
    pub(crate) care: Care,
    /// Heat that flows, J.
    pub(crate) heat: S,
    /// `Σ h |f*|`, N s.
    pub(crate) impulse: S,
    /// What forces contribute to A, and A⁺, J.
    pub(crate) forces: S,
    /// What they have produced, J/K.
    pub(crate) production: S,
    /// The smallest of all productions; the largest number without any, J/K.
    pub(crate) least: S,
    /// Every balance of an internal variable holds to rounding.
    pub(crate) is_balanced: S::Mask,
}

impl<S: Real> Tally<S> {
    /// Of nothing.
    pub(crate) fn new(care: Care) -> Self {
        Self {
            care,
            heat: S::zero(),
            impulse: S::zero(),
            forces: S::zero(),
            production: S::zero(),
            least: S::MAX,
            is_balanced: !S::Mask::none(),
        }
    }

    /// Heat that takes part in the balance, J.
    #[inline]
    pub(crate) fn turn_over(&mut self, heat: S) {
        self.heat += heat.abs();
    }

    /// The impulse between the nodes of an element, N s.
    #[inline]
    pub(crate) fn exchange(&mut self, impulse: S) {
        self.impulse += impulse.abs();
    }

    /// What the forces of an element and the rounding of their arguments contribute, J.
    #[inline]
    pub(crate) fn force(&mut self, energy: S) {
        self.forces += energy;
    }

    /// Entropy that a dashpot or a path of heat has produced, J/K.
    #[inline]
    pub(crate) fn produce(&mut self, entropy: S) {
        self.production += entropy;
        self.least = self.least.minimum(entropy);
    }

    /// What the balance of a node is off by, N s, given its impulse, terms of each direction, and the magnitude of
    /// what the forces of its elements are computed from: forces of all directions leave their rounding in each.
    #[inline]
    pub(crate) fn balance_node<const D: usize>(
        &mut self,
        residual: &[S; D],
        [impulse, terms]: [&[S; D]; 2],
        magnitude: S,
    ) {
        let mut flowing = magnitude;
        for impulse in impulse {
            flowing += impulse.abs();
        }
        for (&residual, &terms) in residual.iter().zip(terms) {
            self.balance(residual, flowing + terms);
        }
    }

    /// What a balance is off by, and the magnitude of its terms.
    #[inline]
    pub(crate) fn balance(&mut self, residual: S, magnitude: S) {
        let roundings = match self.care {
            Care::Quick => BALANCE_ROUNDINGS,
            Care::Thorough => ROUNDINGS,
        };
        let bound = S::from_f64(roundings) * S::EPSILON * magnitude;
        self.is_balanced = self.is_balanced & residual.abs().at_most(bound);
    }
}
