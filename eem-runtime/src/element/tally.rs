//! What the elements and the paths of heat of a step contribute to its certificate.

use crate::element::handle::Element;
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

/// The energies of the elements counted anew, when the balance of a scene does not close.
///
/// Where a free energy is coded with terms that cancel, its values have more rounding than its
/// differences: then `Δe` by discrete derivatives, formed anew between the stored states, decides.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Recount<S> {
    /// `Σ (Δe by differences − Δe by values)`, J.
    pub(crate) correction: S,
    /// The magnitude of the terms of all free energies at both ends, J.
    pub(crate) magnitude: S,
    /// The element whose own balance is off by most, and by how much, J.
    worst: Option<(Element, S)>,
}

impl<S: Real> Recount<S> {
    /// Of no elements.
    pub(crate) fn new() -> Self {
        Self {
            correction: S::zero(),
            magnitude: S::zero(),
            worst: None,
        }
    }

    /// An element with its `Δe` by values, the magnitude of the terms of its free energy at both ends, its `Δe`
    /// by differences, and `f*Δλ − Σ g*Δγ + θ*Δs` with what the step has found, J.
    pub(crate) fn element(
        &mut self,
        element: Element,
        [by_values, magnitude]: [S; 2],
        by_differences: S,
        found: S,
    ) {
        self.correction += by_differences - by_values;
        self.magnitude += magnitude;
        let defect = (by_differences - found).abs();
        let is_worse = self
            .worst
            .is_none_or(|(_, worst)| !defect.at_most(worst).all());
        if is_worse {
            self.worst = Some((element, defect));
        }
    }

    /// The element whose own balance is off by most.
    pub(crate) fn worst(&self) -> Option<Element> {
        self.worst.map(|(element, _)| element)
    }
}
