//! Statements about errors, which need a reference that is known well enough.

use crate::quantity::PerQuantity;

/// The largest difference of the references for which an error is stated, relative to it.
pub(crate) const DOUBT: f64 = 0.01;

/// The statement of a study about one error at the end time.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Statement {
    /// The relative error: the two references differ by at most a hundredth of it.
    Stated(f64),
    /// No error is stated. The references differ by `doubt`, more than a hundredth of the difference between the
    /// run and one of them: the motion is chaotic, or only rounding is left.
    Refused {
        /// The difference between the run and the first reference; NaN without references.
        difference: f64,
        /// The difference between the references; infinite without references.
        doubt: f64,
    },
    /// The scene has no such quantity, or the run did not reach the end.
    Absent,
}

impl Statement {
    /// The statement about a difference from the first of two references, which differ by `doubt`.
    pub(crate) fn of(difference: f64, doubt: f64) -> Self {
        if doubt <= DOUBT * difference {
            Self::Stated(difference)
        } else {
            Self::Refused { difference, doubt }
        }
    }

    /// The error, if it is stated.
    ///
    /// ```
    /// use eem::Statement;
    ///
    /// assert_eq!(Statement::Stated(1e-3).stated(), Some(1e-3));
    /// assert_eq!(Statement::Refused { difference: 1e-3, doubt: 1e-4 }.stated(), None);
    /// ```
    #[must_use]
    pub const fn stated(self) -> Option<f64> {
        match self {
            Self::Stated(error) => Some(error),
            Self::Refused { .. } | Self::Absent => None,
        }
    }
}

/// The largest number; NaN if there is one.
pub(crate) fn largest(numbers: &PerQuantity) -> Option<f64> {
    let there = numbers.iter().copied().flatten();
    there.reduce(super::quantity::larger)
}
