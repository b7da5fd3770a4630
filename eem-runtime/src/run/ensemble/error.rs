//! Errors of ensembles.

use core::error::Error;

use thiserror::Error;

use crate::scene::error::SceneError;
use crate::step::error::StepError;

/// A member of an ensemble without a result.
#[derive(Debug, Error)]
#[error("member {member}: {failure}")]
pub struct MemberError {
    /// The index of its input, from 0.
    pub member: usize,
    /// Why it has no result. It is part of the message, so it is not the `source`.
    pub failure: MemberFailure,
}

/// Why a member of an ensemble has no result.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MemberFailure {
    /// The scene, the step or the settings are rejected, or a requested quantity does not exist.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A step failed.
    #[error(transparent)]
    Step(Box<StepError>),
    /// The ensemble was stopped before the member began.
    #[error("the ensemble was stopped before it began")]
    Stopped,
    /// An error of the caller.
    #[error(transparent)]
    Other(Box<dyn Error + Send + Sync>),
}

impl From<StepError> for MemberFailure {
    fn from(error: StepError) -> Self {
        Self::Step(Box::new(error))
    }
}

impl MemberFailure {
    /// A failure from any error or text of the caller.
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
