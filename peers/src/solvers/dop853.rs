//! DOP853 of the crate `differential-equations`.

use std::cell::Cell;
use std::time::Instant;

use differential_equations::error::Error;
use differential_equations::interpolate::Interpolation;
use differential_equations::ode::{ODE, OrdinaryNumericalMethod, solve_ode};
use differential_equations::prelude::{ControlFlag, ExplicitRungeKutta, Solout, Solution};

use super::{Solved, Task};
use crate::systems::{System, Warm};

/// As good as no limit; the crate's own is 10 000, for all steps that one solver ever takes.
const MOST_STEPS: usize = 100_000_000;

/// The rates as the crate wants them: of an unchanging `self`.
pub(super) struct Equations<'a, S> {
    pub(super) system: &'a S,
    pub(super) warm: Cell<Warm>,
}

impl<S: System<N>, const N: usize> ODE<f64, [f64; N]> for Equations<'_, S> {
    fn diff(&self, _time: f64, y: &[f64; N], rates: &mut [f64; N]) {
        let mut warm = self.warm.get();
        *rates = self.system.rates(y, &mut warm);
        self.warm.set(warm);
    }
}

/// Keeps no solution, hands each state on, and starts the clock at the first, when the solver is set up.
pub(super) struct Watch<F> {
    pub(super) see: F,
    pub(super) started: Option<Instant>,
}

impl<const N: usize, F: FnMut(&[f64; N])> Solout<f64, [f64; N]> for Watch<F> {
    fn solout<I: Interpolation<f64, [f64; N]> + ?Sized>(
        &mut self,
        _time: f64,
        _previous_time: f64,
        y: &[f64; N],
        _previous: &[f64; N],
        _interpolator: &mut I,
        _solution: &mut Solution<f64, [f64; N]>,
    ) -> ControlFlag<f64, [f64; N]> {
        (self.see)(y);
        self.started.get_or_insert_with(Instant::now);
        ControlFlag::Continue
    }
}

pub(super) fn solve<const N: usize, S: System<N>>(
    task: &Task<'_, S, N>,
    watch: impl FnMut(&[f64; N]),
) -> Result<Solved<N>, String> {
    let method = ExplicitRungeKutta::dop853();
    let method = method.rtol(task.tolerance).max_steps(MOST_STEPS);
    run(
        task,
        method.atol(task.sizes.map(|size| task.tolerance * size)),
        watch,
    )
}

/// Runs any method of the crate.
pub(super) fn run<const N: usize, S: System<N>, M>(
    task: &Task<'_, S, N>,
    mut method: M,
    watch: impl FnMut(&[f64; N]),
) -> Result<Solved<N>, String>
where
    M: OrdinaryNumericalMethod<f64, [f64; N]> + Interpolation<f64, [f64; N]>,
{
    let equations = Equations {
        system: task.system,
        warm: Cell::new(task.system.warm()),
    };
    let mut watch = Watch {
        see: watch,
        started: None,
    };
    let start = task.system.start();
    let solution = solve_ode(&mut method, &equations, 0.0, task.end, &start, &mut watch)
        .map_err(|error: Error<f64, [f64; N]>| format!("{error:?}"))?;
    let seconds = watch
        .started
        .map_or(0.0, |time| time.elapsed().as_secs_f64());
    Ok(Solved {
        y: *method.y(),
        steps: solution.steps.accepted as u64,
        rejected: solution.steps.rejected as u64,
        evaluations: solution.evals.function as u64,
        seconds,
    })
}
