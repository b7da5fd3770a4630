//! Statistics of step control.

use crate::algebra::memory::TooLarge;
use crate::step::error::StepFailure;

/// Statistics of [`control_steps`](crate::Simulation::control_steps): accepted steps, and rejected ones by cause.
///
/// Steps that were tried before an error are counted too.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[non_exhaustive]
pub struct StepStatistics {
    /// Accepted steps.
    pub accepted: u64,
    /// Rejected because their error exceeded the tolerance.
    pub rejected_by_error: u64,
    /// Rejected because Newton's method found no new state.
    pub rejected_by_newton: u64,
    /// Rejected because an element had no admissible state.
    pub rejected_by_domain: u64,
    /// Rejected because they did not prove their laws.
    pub rejected_by_law: u64,
    /// How often [`Scheme::Auto`](crate::Scheme::Auto) has switched to another scheme.
    #[cfg_attr(feature = "serde", serde(default))]
    pub changes_of_scheme: u64,
    /// Memory that was missing for a scheme that [`Scheme::Auto`](crate::Scheme::Auto) wanted to try or return to;
    /// the last case. Steps may then be much shorter than necessary.
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

    /// All counts.
    pub(crate) const fn counts(&self) -> [u64; 6] {
        [
            self.accepted,
            self.rejected_by_error,
            self.rejected_by_newton,
            self.rejected_by_domain,
            self.rejected_by_law,
            self.changes_of_scheme,
        ]
    }

    /// Steps rejected for another reason than their error.
    pub(crate) const fn failures(&self) -> u64 {
        self.rejected() - self.rejected_by_error
    }

    /// All rejected steps.
    #[must_use]
    pub const fn rejected(&self) -> u64 {
        self.rejected_by_error
            + self.rejected_by_newton
            + self.rejected_by_domain
            + self.rejected_by_law
    }
}
