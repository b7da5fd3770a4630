//! The system that closes a step: in memory of its own, or in that of the tangent.

use crate::lu::Singular;
use crate::pattern::Pattern;
use crate::scalar::Real;
use crate::system::{LinearSystem, Parts};

/// The secant system, with one unknown per mass and a right-hand side per axis of space.
#[derive(Debug)]
pub(super) enum Secant<S, const D: usize> {
    /// In memory of its own.
    Apart(LinearSystem<S, D>),
    /// In that of the tangent, which has the same graph and nothing to keep when a step closes.
    InTangent,
}

impl<S: Real, const D: usize> Secant<S, D> {
    /// The system of so many masses, whose pattern is asked for if it needs memory of its own.
    pub(super) fn new(
        tangent: &LinearSystem<S, 1>,
        masses: usize,
        pattern: impl FnOnce() -> Pattern,
    ) -> Self {
        if tangent.runs(D) == Some(masses) {
            Self::InTangent
        } else {
            Self::Apart(LinearSystem::new(&pattern(), 1))
        }
    }

    /// What has memory of its own.
    pub(super) fn apart(&self) -> Option<&LinearSystem<S, D>> {
        match self {
            Self::Apart(system) => Some(system),
            Self::InTangent => None,
        }
    }

    /// Its entries, all zero, and right-hand sides.
    #[inline]
    pub(super) fn renew<'a>(&'a mut self, tangent: &'a mut LinearSystem<S, 1>) -> Parts<'a, S, D> {
        match self {
            Self::Apart(system) => {
                let (values, right, _) = system.renew();
                (values, right)
            }
            Self::InTangent => tangent.renew_by_runs(),
        }
    }

    /// Finds the solutions; the matrix is lost.
    #[inline]
    pub(super) fn solve(&mut self, tangent: &mut LinearSystem<S, 1>) -> Result<(), Singular> {
        match self {
            Self::Apart(system) => system.solve(),
            Self::InTangent => tangent.solve_by_runs::<D>(),
        }
    }

    /// The solutions, once they have been found.
    #[inline]
    pub(super) fn solution<'a>(&'a self, tangent: &'a LinearSystem<S, 1>) -> &'a [[S; D]] {
        match self {
            Self::Apart(system) => system.solution(),
            Self::InTangent => tangent.solution_by_runs(),
        }
    }
}
