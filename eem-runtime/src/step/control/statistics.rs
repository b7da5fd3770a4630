//! What step control has done so far.

use crate::algebra::memory::TooLarge;
use crate::step::error::StepFailure;

/// Steps of a run with [`control_steps`](crate::Simulation::control_steps), and why others were not taken.
///
/// Those that were tried on the way to an error are counted too; they are all that a failed step leaves behind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[non_exhaustive]
pub struct StepStatistics {
    /// Steps that were taken.
    pub accepted: u64,
    /// Rejected since their error exceeded the tolerance.
    pub rejected_by_error: u64,
    /// Rejected since Newton's method did not find a new state.
    pub rejected_by_newton: u64,
    /// Rejected since an element cannot be where they led.
    pub rejected_by_domain: u64,
    /// Rejected since they did not prove their laws.
    pub rejected_by_law: u64,
    /// How often [`Scheme::Auto`](crate::Scheme::Auto) has gone on with another scheme.
    #[cfg_attr(feature = "serde", serde(default))]
    pub changes_of_scheme: u64,
    /// What a scheme would have taken that [`Scheme::Auto`](crate::Scheme::Auto) wanted to try, or to return to, and
    /// for which there was no memory; the last one. Steps may then be far shorter than they have to be.
    #[cfg_attr(feature = "serde", serde(default))]
    pub too_large: Option<TooLarge>,
}

impl StepStatistics {
    /// Counts a step that failed; false if no other size would help.
    pub(crate) const fn note_failure(&mut self, failure: &StepFailure) -> bool {
        let cause = match failure {
            StepFailure::NotConverged { .. } | StepFailure::SingularTangent => {
                &mut self.rejected_by_newton
            }
            StepFailure::State(_)
            | StepFailure::Unbounded { .. }
            | StepFailure::Unstable { .. }
            | StepFailure::TooCold { .. }
            | StepFailure::Energy { .. } => &mut self.rejected_by_domain,
            StepFailure::LawNotKept { .. }
            | StepFailure::Correction { .. }
            | StepFailure::NotClosed { .. } => &mut self.rejected_by_law,
            _ => return false,
        };
        *cause += 1;
        true
    }

    /// Those that were rejected for another reason than their error.
    pub(crate) const fn failures(&self) -> u64 {
        self.rejected() - self.rejected_by_error
    }

    /// All that were rejected.
    #[must_use]
    pub const fn rejected(&self) -> u64 {
        self.rejected_by_error
            + self.rejected_by_newton
            + self.rejected_by_domain
            + self.rejected_by_law
    }
}
