//! The contributions of elements and paths of heat to the certificate of a step.

use crate::element::handle::Element;
use eem_material::number::scalar::{Mask, Real};

/// The bound of the defect of a law, in roundings of its amplitude.
pub(crate) const ROUNDINGS: f64 = 64.0;

/// The bound of the defect of the balance of a node, a dashpot or a temperature, in roundings of its terms, if these do
/// not contain the rounding of the arguments of the forces. A small update leaves a defect of this size; false convergence
/// leaves one of the size of the terms. Energy and momenta are checked separately.
const BALANCE_ROUNDINGS: f64 = 4096.0;

/// The level of the bound for rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Care {
    /// The terms of the balances alone, which is enough for most steps.
    Quick,
    /// Also the rounding of the arguments of the forces.
    Thorough,
}

/// The contributions of elements and paths of heat to a certificate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tally<S: Real> {
    pub(crate) care: Care,
    /// `Σ |Q|` of dashpots and paths of heat, J.
    pub(crate) heat: S,
    /// `Σ h |f*|`, N s.
    pub(crate) impulse: S,
    /// `Σ h k λ` of the forces at all nodes, whose rounding their balances leave, if bounds are thorough, N s.
    pub(crate) residues: S,
    /// The contribution of the forces to A* and A⁺ of `step/certificate.rs`, J.
    pub(crate) forces: S,
    /// The entropy production, J/K.
    pub(crate) production: S,
    /// The smallest production of a dashpot or a path of heat, J/K; `S::MAX` if there is none.
    pub(crate) least: S,
    /// Conductions and dashpots that relax faster than the step resolves.
    pub(crate) unresolved: usize,
    /// Every balance of a node or an internal variable holds to rounding.
    pub(crate) is_balanced: S::Mask,
}

impl<S: Real> Tally<S> {
    /// Without contributions.
    pub(crate) fn new(care: Care) -> Self {
        Self {
            care,
            heat: S::zero(),
            impulse: S::zero(),
            residues: S::zero(),
            forces: S::zero(),
            production: S::zero(),
            least: S::MAX,
            unresolved: 0,
            is_balanced: !S::Mask::none(),
        }
    }

    /// Adds heat of a dashpot or a path, J.
    #[inline]
    pub(crate) fn turn_over(&mut self, heat: S) {
        self.heat += heat.abs();
    }

    /// Adds the impulse between the nodes of an element, N s.
    #[inline]
    pub(crate) fn exchange(&mut self, impulse: S) {
        self.impulse += impulse.abs();
    }

    /// Adds the contribution of the forces of an element and of the rounding of their arguments, J.
    #[inline]
    pub(crate) fn force(&mut self, energy: S) {
        self.forces += energy;
    }

    /// Adds the entropy that a dashpot or a path of heat has produced, J/K.
    #[inline]
    pub(crate) fn produce(&mut self, entropy: S) {
        self.production += entropy;
        self.least = self.least.minimum(entropy);
    }

    /// Counts a conduction or a dashpot unless `step` resolves it: at most `resistance` times the other number.
    #[inline]
    pub(crate) fn see_relaxation(&mut self, step: S, driving: S, resistance: S) {
        self.unresolved += usize::from(resistance.less(step * driving).any());
    }

    /// Checks the defect of the balance of a node, N s, given its impulse, the terms of each direction, and the magnitude of
    /// the terms of the forces of its elements, whose rounding enters every direction.
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

    /// Checks the defect of a balance, given the magnitude of its terms. Below the smallest normal number, rounding is that of this
    /// number.
    #[inline]
    pub(crate) fn balance(&mut self, residual: S, magnitude: S) {
        let roundings = match self.care {
            Care::Quick => BALANCE_ROUNDINGS,
            Care::Thorough => ROUNDINGS,
        };
        let bound = S::from_f64(roundings) * S::EPSILON * (magnitude + S::MIN_POSITIVE);
        self.is_balanced = self.is_balanced & residual.abs().at_most(bound);
    }
}

/// The energies of the elements evaluated again, if the balance of a scene does not close.
///
/// If the terms of a free energy cancel, its values have more rounding than its differences. Then `Δe` by discrete
/// derivatives between the stored states, evaluated again, decides.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reevaluation<S> {
    /// `Σ (Δe by differences − Δe by values)`, J.
    pub(crate) correction: S,
    /// The magnitude of the terms of all free energies at both ends, J.
    pub(crate) magnitude: S,
    /// The element with the largest defect of its own balance, and this defect, J.
    worst: Option<(Element, S)>,
}

impl<S: Real> Reevaluation<S> {
    /// Without elements.
    pub(crate) fn new() -> Self {
        Self {
            correction: S::zero(),
            magnitude: S::zero(),
            worst: None,
        }
    }

    /// Adds an element with its `Δe` by values, the magnitude of the terms of its free energy at both ends, its `Δe`
    /// by differences, and `f*Δλ − Σ g*Δγ + θ*Δs` with the response of the step, J.
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

    /// The element with the largest defect of its own balance.
    pub(crate) fn worst(&self) -> Option<Element> {
        self.worst.map(|(element, _)| element)
    }
}
