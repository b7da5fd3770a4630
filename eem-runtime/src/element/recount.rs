//! The energies of the elements, counted anew where the balance of a scene does not close.

use crate::element::handle::Element;
use eem_material::number::scalar::{Mask, Real};

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
