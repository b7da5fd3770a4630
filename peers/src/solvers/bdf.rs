//! BDF of the crate `diffsol`, with dense matrices of `nalgebra`.

use std::array;
use std::cell::Cell;
use std::time::Instant;

use diffsol::error::DiffsolError;
use diffsol::{
    NalgebraContext, NalgebraLU, NalgebraMat, NalgebraVec, OdeBuilder, OdeEquationsImplicit,
    OdeSolverMethod, OdeSolverProblem, OdeSolverStopReason,
};
use num_dual::Dual64;

use super::{Solved, Task};
use crate::systems::System;

pub(super) fn solve<const N: usize, S: System<N>>(
    task: &Task<'_, S, N>,
    watch: impl FnMut(&[f64; N]),
) -> Result<Solved<N>, String> {
    let system = task.system;
    let (start, evaluations) = (system.start(), Cell::new(0));
    let (warm, warm_along) = (Cell::new(system.warm()), Cell::new(system.warm()));
    let rates = |y: &[f64], _: &[f64], _, rates: &mut [f64]| {
        evaluations.set(evaluations.get() + 1);
        let mut found = warm.get();
        let y: [f64; N] = array::from_fn(|i| y[i]);
        rates.copy_from_slice(&system.rates(&y, &mut found));
        warm.set(found);
    };
    // The derivative of the rates along a direction: columns of the Jacobian, exact.
    let along = |y: &[f64], _: &[f64], _, direction: &[f64], change: &mut [f64]| {
        let mut found = warm_along.get();
        let y: [Dual64; N] = array::from_fn(|i| Dual64::new(y[i], direction[i]));
        for (change, rate) in change.iter_mut().zip(system.rates(&y, &mut found)) {
            *change = rate.eps;
        }
        warm_along.set(found);
    };
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(task.tolerance)
        .atol(task.sizes.map(|size| task.tolerance * size))
        .rhs_implicit(rates, along)
        .init(|_, _, y: &mut [f64]| y.copy_from_slice(&start), N)
        .build();
    let solved = problem.and_then(|problem| run(problem, task.end, watch));
    let solved = solved.map_err(|error| error.to_string())?;
    Ok(Solved {
        evaluations: evaluations.get(),
        ..solved
    })
}

fn run<const N: usize, E>(
    mut problem: OdeSolverProblem<E>,
    end: f64,
    mut watch: impl FnMut(&[f64; N]),
) -> Result<Solved<N>, DiffsolError>
where
    E: OdeEquationsImplicit<T = f64, M = NalgebraMat<f64>, V = NalgebraVec<f64>, C = NalgebraContext>,
{
    // The crate's limit of 50 is for a whole run, however long it is.
    problem.ode_options.max_nonlinear_solver_failures = usize::MAX;
    let mut solver = problem.bdf::<NalgebraLU<f64>>()?;
    solver.set_stop_time(end)?;
    let mut y: [f64; N] = array::from_fn(|i| solver.state().y[i]);
    watch(&y);
    let started = Instant::now();
    loop {
        let reason = solver.step()?;
        y = array::from_fn(|i| solver.state().y[i]);
        watch(&y);
        if reason == OdeSolverStopReason::TstopReached {
            break;
        }
    }
    let seconds = started.elapsed().as_secs_f64();
    let counts = solver.get_statistics();
    let rejected = counts.number_of_error_test_failures + counts.number_of_nonlinear_solver_fails;
    Ok(Solved {
        y,
        steps: counts.number_of_steps as u64,
        rejected: rejected as u64,
        evaluations: 0,
        seconds,
    })
}
