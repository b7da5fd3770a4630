//! The outcome of a step for all solvers: what its certificate proves.

use crate::step::certificate::Certificate;
use eem_material::number::scalar::Scalar;

/// The result of a step, from its certificate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome {
    /// `ΔE − work − heat`, and its bound for rounding, J.
    pub(crate) defect: f64,
    pub(crate) bound: f64,
    pub(crate) is_bound_wide: bool,
    /// The entropy production of all dashpots and paths of heat, and the smallest one, J/K.
    pub(crate) production: f64,
    pub(crate) least_production: f64,
    /// Conductions and dashpots that relax faster than the step resolves.
    pub(crate) unresolved: usize,
    /// The energy error of an explicit step before its correction, relative to the energy terms: the largest of all
    /// connected bodies, with its sign.
    pub(crate) correction: f64,
}

impl From<&Certificate> for Outcome {
    #[inline]
    fn from(certificate: &Certificate) -> Self {
        Self {
            defect: certificate.defect,
            bound: certificate.bound,
            is_bound_wide: certificate.is_bound_wide(),
            production: certificate.production,
            least_production: certificate.least_production,
            unresolved: certificate.unresolved,
            correction: 0.0,
        }
    }
}

/// Energy corrections of explicit steps, relative to the energy terms.
///
/// They summarise [`StepReport::correction`](crate::StepReport::correction) over all steps of a simulation. For
/// small steps the correction is proportional to the ninth power of the step; if it is proportional to the step, a
/// force is wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corrections {
    /// The largest correction.
    pub largest: f64,
    /// `Σ |correction|`.
    pub total: f64,
    /// `Σ correction`, positive if energy was missing.
    pub signed: f64,
}

impl Corrections {
    pub(crate) fn none() -> Self {
        Self {
            largest: 0.0,
            total: 0.0,
            signed: 0.0,
        }
    }

    /// Counts a step.
    pub(crate) fn note(&mut self, correction: f64) {
        self.largest = Scalar::maximum(self.largest, correction.abs());
        self.total += correction.abs();
        self.signed += correction;
    }
}

/// An attempted step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Attempt {
    /// The estimate of its error in units of the tolerance; zero without a tolerance.
    pub(crate) error: f64,
    /// `None` if the error exceeds the tolerance: the step is then not made.
    pub(crate) outcome: Option<Outcome>,
}

impl Attempt {
    /// A step whose error is too large.
    pub(crate) fn rejected(error: f64) -> Self {
        let outcome = None;
        Self { error, outcome }
    }

    /// A step that was made without a tolerance.
    pub(crate) fn made(outcome: impl Into<Outcome>) -> Self {
        Self {
            error: 0.0,
            outcome: Some(outcome.into()),
        }
    }
}
