//! Which member of an ensemble has no result, and why.

use core::error::Error;

use thiserror::Error;

use crate::number::scalar::Discord;
use crate::scene::error::SceneError;
use crate::step::error::StepError;

/// A member of an ensemble without a result.
#[derive(Debug, Error)]
#[error("member {member}: {failure}")]
pub struct MemberError {
    /// The index of its input, from 0.
    pub member: usize,
    /// Why it has no result; the message has it, so that it is no `source` of its own.
    pub failure: MemberFailure,
}

/// Why a member of an ensemble has no result.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MemberFailure {
    /// The scene, the step or the settings of Newton's method are refused, or what was asked of
    /// the simulation does not exist.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A step failed.
    #[error(transparent)]
    Step(Box<StepError>),
    /// Members that are stepped together would go on differently. The ensemble then runs them one by one,
    /// so that it is no result of [`Ensemble::run_experiment`](crate::Ensemble::run_experiment).
    #[error(transparent)]
    Discord(#[from] Discord),
    /// The ensemble was stopped before the member began.
    #[error("the ensemble was stopped before it began")]
    Stopped,
    /// An error of the caller's own.
    #[error(transparent)]
    Other(Box<dyn Error + Send + Sync>),
}

impl From<StepError> for MemberFailure {
    fn from(error: StepError) -> Self {
        Self::Step(Box::new(error))
    }
}

impl MemberFailure {
    /// A failure that this crate does not know, from an error or a text.
    ///
    /// ```
    /// use eem::MemberFailure;
    ///
    /// assert_eq!(MemberFailure::other("too hot").to_string(), "too hot");
    /// ```
    pub fn other(error: impl Into<Box<dyn Error + Send + Sync>>) -> Self {
        Self::Other(error.into())
    }
}
