//! The solvers of other crates, behind one function.

mod bdf;
mod dop853;

use crate::systems::System;

/// What a solver has to do.
#[derive(Debug)]
pub(crate) struct Task<'a, S, const N: usize> {
    pub(crate) system: &'a S,
    /// The sizes of the unknowns: the tolerance of `y` is `tolerance · (size + |y|)`.
    pub(crate) sizes: [f64; N],
    /// s.
    pub(crate) end: f64,
    pub(crate) tolerance: f64,
}

/// What it did.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solved<const N: usize> {
    /// y at the end time.
    pub(crate) y: [f64; N],
    /// Steps that were taken.
    pub(crate) steps: u64,
    /// Steps that were tried and not taken.
    pub(crate) rejected: u64,
    /// Evaluations of all rates, those within Jacobians not counted.
    pub(crate) evaluations: u64,
    /// Wall time of the steps, s.
    pub(crate) seconds: f64,
}

/// A solver of another crate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Solver {
    /// Explicit, of order 8.
    Dop853,
    /// Implicit, of orders 1 to 5, for stiff problems.
    Bdf,
}

impl Solver {
    /// Both.
    pub(crate) const ALL: [Self; 2] = [Self::Dop853, Self::Bdf];

    /// The name in tables and pictures.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Dop853 => "dop853",
            Self::Bdf => "bdf",
        }
    }

    /// Runs it; `watch` sees the state at the start and after every step.
    pub(crate) fn solve<const N: usize, S: System<N>>(
        self,
        task: &Task<'_, S, N>,
        watch: impl FnMut(&[f64; N]),
    ) -> Result<Solved<N>, String> {
        match self {
            Self::Dop853 => dop853::solve(task, watch),
            Self::Bdf => bdf::solve(task, watch),
        }
    }
}
