//! The outcome of a step for all solvers: what its certificate proves.

use crate::step::certificate::Certificate;
use eem_material::number::scalar::Real;

/// The result of a step, from its certificate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome<S> {
    /// `ΔE − work − heat`, and its bound for rounding, J.
    pub(crate) defect: S,
    pub(crate) bound: S,
    pub(crate) is_bound_wide: bool,
    /// The entropy production of all dashpots and paths of heat, and the smallest one, J/K.
    pub(crate) production: S,
    pub(crate) least_production: S,
    /// Conductions and dashpots that relax faster than the step resolves.
    pub(crate) unresolved: usize,
    /// The energy error of an explicit step before its correction, relative to the energy terms: the largest of all
    /// connected bodies, with its sign.
    pub(crate) correction: S,
}

impl<S: Real> From<Certificate<S>> for Outcome<S> {
    fn from(certificate: Certificate<S>) -> Self {
        Self {
            defect: certificate.defect,
            bound: certificate.bound,
            is_bound_wide: certificate.is_bound_wide(),
            production: certificate.production,
            least_production: certificate.least_production,
            unresolved: certificate.unresolved,
            correction: S::zero(),
        }
    }
}

/// Energy corrections of explicit steps, relative to the energy terms.
///
/// They summarise [`StepReport::correction`](crate::StepReport::correction) over all steps of a simulation. For
/// small steps the correction is proportional to the ninth power of the step; if it is proportional to the step, a
/// force is wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corrections<S> {
    /// The largest correction.
    pub largest: S,
    /// `Σ |correction|`.
    pub total: S,
    /// `Σ correction`, positive if energy was missing.
    pub signed: S,
}

impl<S: Real> Corrections<S> {
    pub(crate) fn none() -> Self {
        Self {
            largest: S::zero(),
            total: S::zero(),
            signed: S::zero(),
        }
    }

    /// Counts a step.
    pub(crate) fn note(&mut self, correction: S) {
        self.largest = self.largest.maximum(correction.abs());
        self.total += correction.abs();
        self.signed += correction;
    }
}

/// An attempted step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Attempt<S> {
    /// The estimate of its error in units of the tolerance; zero without a tolerance.
    pub(crate) error: S,
    /// `None` if the error exceeds the tolerance: the step is then not made.
    pub(crate) outcome: Option<Outcome<S>>,
}

impl<S: Real> Attempt<S> {
    /// A step that was made without a tolerance.
    pub(crate) fn made(outcome: impl Into<Outcome<S>>) -> Self {
        Self {
            error: S::zero(),
            outcome: Some(outcome.into()),
        }
    }
}
