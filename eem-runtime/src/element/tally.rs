//! The contributions of elements and paths of heat to the certificate of a step.

use crate::element::handle::Element;
use eem_material::number::scalar::Scalar;

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
pub(crate) struct Tally {
    pub(crate) care: Care,
    /// `Σ |Q|` of dashpots and paths of heat, J.
    pub(crate) heat: f64,
    /// `Σ h |f*|`, N s.
    pub(crate) impulse: f64,
    /// The terms of the balances of all nodes and directions, whose rounding is left in their momenta, if bounds are thorough, N s.
    pub(crate) residues: f64,
    /// The contribution of the forces to A* and A⁺ of `step/certificate.rs`, J.
    pub(crate) forces: f64,
    /// The entropy production, J/K.
    pub(crate) production: f64,
    /// The smallest production of a dashpot or a path of heat, J/K; `f64::MAX` if there is none.
    pub(crate) least: f64,
    /// Conductions and dashpots that relax faster than the step resolves.
    pub(crate) unresolved: usize,
    /// Every balance of a node or an internal variable holds to rounding.
    pub(crate) is_balanced: bool,
}

impl Tally {
    /// Without contributions.
    #[inline]
    pub(crate) fn new(care: Care) -> Self {
        Self {
            care,
            heat: 0.0,
            impulse: 0.0,
            residues: 0.0,
            forces: 0.0,
            production: 0.0,
            least: f64::MAX,
            unresolved: 0,
            is_balanced: true,
        }
    }

    /// Adds heat of a dashpot or a path, J.
    #[inline]
    pub(crate) fn turn_over(&mut self, heat: f64) {
        self.heat += heat.abs();
    }

    /// Adds the impulse between the nodes of an element, N s.
    #[inline]
    pub(crate) fn exchange(&mut self, impulse: f64) {
        self.impulse += impulse.abs();
    }

    /// Adds the contribution of the forces of an element and of the rounding of their arguments, J.
    #[inline]
    pub(crate) fn force(&mut self, energy: f64) {
        self.forces += energy;
    }

    /// Adds the entropy that a dashpot or a path of heat has produced, J/K.
    #[inline]
    pub(crate) fn produce(&mut self, entropy: f64) {
        self.production += entropy;
        self.least = Scalar::minimum(self.least, entropy);
    }

    /// Counts a conduction or a dashpot unless `step` resolves it: at most `resistance` times the other number.
    #[inline]
    pub(crate) fn see_relaxation(&mut self, step: f64, driving: f64, resistance: f64) {
        self.unresolved += usize::from(resistance < step * driving);
    }

    /// Checks the defect of the balance of a node, N s, given its impulse, the terms of each direction, and the magnitude of
    /// the terms of the forces of its elements, whose rounding enters every direction.
    #[inline]
    pub(crate) fn balance_node<const D: usize>(
        &mut self,
        residual: &[f64; D],
        [impulse, terms]: [&[f64; D]; 2],
        magnitude: f64,
    ) {
        let mut flowing = magnitude;
        for impulse in impulse {
            flowing += impulse.abs();
        }
        for (&residual, &terms) in residual.iter().zip(terms) {
            self.balance(residual, flowing + terms);
            if self.care == Care::Thorough {
                self.residues += flowing + terms;
            }
        }
    }

    /// Checks the defect of a balance, given the magnitude of its terms. Below the smallest normal number, rounding is that of this
    /// number.
    #[inline]
    pub(crate) fn balance(&mut self, residual: f64, magnitude: f64) {
        let roundings = match self.care {
            Care::Quick => BALANCE_ROUNDINGS,
            Care::Thorough => ROUNDINGS,
        };
        let bound = roundings * f64::EPSILON * (magnitude + f64::MIN_POSITIVE);
        self.is_balanced &= residual.abs() <= bound;
    }
}

/// The energies of the elements evaluated again, if the balance of a scene does not close.
///
/// If the terms of a free energy cancel, its values have more rounding than its differences. Then `Δe` by discrete
/// derivatives between the stored states, evaluated again, decides.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reevaluation {
    /// `Σ (Δe by differences − Δe by values)`, J.
    pub(crate) correction: f64,
    /// The magnitude of the terms of all free energies at both ends, J.
    pub(crate) magnitude: f64,
    /// The element with the largest defect of its own balance, and this defect, J.
    worst: Option<(Element, f64)>,
}

impl Reevaluation {
    /// Without elements.
    #[inline]
    pub(crate) fn new() -> Self {
        Self {
            correction: 0.0,
            magnitude: 0.0,
            worst: None,
        }
    }

    /// Adds an element with its `Δe` by values, the magnitude of the terms of its free energy at both ends, its `Δe`
    /// by differences, and `f*Δλ − Σ g*Δγ + θ*Δs` with the response of the step, J.
    pub(crate) fn element(
        &mut self,
        element: Element,
        [by_values, magnitude]: [f64; 2],
        by_differences: f64,
        found: f64,
    ) {
        self.correction += by_differences - by_values;
        self.magnitude += magnitude;
        let defect = (by_differences - found).abs();
        let is_worse = self.worst.is_none_or(|(_, worst)| !(defect <= worst));
        if is_worse {
            self.worst = Some((element, defect));
        }
    }

    /// The element with the largest defect of its own balance.
    pub(crate) fn worst(&self) -> Option<Element> {
        self.worst.map(|(element, _)| element)
    }
}
