//! Library and prototype end in the same state, and the prototype keeps its laws.

use std::error::Error;

use super::runs::{Form, library_after, of_case, step, temperature_after};
use crate::cases::CaseName;
use crate::prototype::{Pendulum, ROUNDING, Run};
use crate::systems::{Double, Single, State, System, Variables};

/// Steps of the case's size after which states are compared, before the double pendulums become chaotic.
const STEPS: u32 = 20;

/// The explicit steps compared are smaller by this factor: their truncation errors hide less of another difference.
const FINER: u32 = 4;

/// How many roundings of q, p and θ a step adds: twelve stages, with coefficients of up to 43.
const STEP_ROUNDINGS: f64 = 64.0;

/// How many roundings an energy may be away from its target: the closing allows 16, and a dozen make an energy from a
/// state, which is done at the start and here, from θ instead of s.
const ENERGY_ROUNDINGS: f64 = 40.0;

/// The same of a momentum, relative to Σ |q| |p|: four roundings make each component from q and p, one changes p, and
/// both counts at the start and here.
const MOMENTUM_ROUNDINGS: f64 = 16.0;

/// The same of a change of the entropy, relative to Σ |s|: one rounding of each s before and after the step, and one of
/// each sum.
const ENTROPY_ROUNDINGS: f64 = 4.0;

/// An error unless library and prototype agree, and the prototype keeps energy and angular momentum and loses no entropy.
///
/// Let y be the exact state, and y(h) that of a run with step h. If halving the step at least halves the error, then
/// |y(h) − y| ≤ |y(h) − y(h/2)| + |y(h) − y|/2, so that the error is at most 2 |y(h) − y(h/2)|. The states of library
/// and prototype differ by no more than the sum of their errors, and rounding.
pub(crate) fn check(case: CaseName) -> Result<(), Box<dyn Error>> {
    let (full, steps) = (step(case, Form::Explicit) / f64::from(FINER), FINER * STEPS);
    let (library, _) = library_after(case, Form::Explicit, full, steps)?;
    let (halved, _) = library_after(case, Form::Explicit, 0.5 * full, 2 * steps)?;
    compare(
        case,
        steps,
        [&library, &halved],
        [
            &of_case!(case, checked_steps(case, full, steps))?,
            &of_case!(case, checked_steps(case, 0.5 * full, 2 * steps))?,
        ],
    )
}

/// The same of the states in temperature form.
pub(crate) fn check_temperature(case: CaseName) -> Result<(), Box<dyn Error>> {
    let [[library, prototype], [halved_library, halved_prototype]] = temperature_states(case)?;
    compare(
        case,
        STEPS,
        [&library, &halved_library],
        [&prototype, &halved_prototype],
    )
}

/// States of library and prototype in temperature form, with the step of the case and with half of it.
pub(crate) fn temperature_states(case: CaseName) -> Result<[[State; 2]; 2], Box<dyn Error>> {
    let full = step(case, Form::Temperature);
    let states = |step, steps| -> Result<[State; 2], Box<dyn Error>> {
        let (library, _) = library_after(case, Form::Temperature, step, steps)?;
        let (prototype, _) = temperature_after(case, step, steps)?;
        Ok([library, prototype.state()])
    };
    Ok([states(full, STEPS)?, states(0.5 * full, 2 * STEPS)?])
}

/// An error unless two states differ by no more than their errors. Each is followed by the state with half the step.
fn compare(
    case: CaseName,
    steps: u32,
    [library, halved_library]: [&State; 2],
    [prototype, halved_prototype]: [&State; 2],
) -> Result<(), Box<dyn Error>> {
    let apart = library.errors(prototype);
    let library_changes = library.errors(halved_library);
    let prototype_changes = prototype.errors(halved_prototype);
    let rounding = f64::from(steps) * STEP_ROUNDINGS * ROUNDING;
    let quantities = ["positions", "momenta", "temperatures"];
    for (i, quantity) in quantities.into_iter().enumerate() {
        let bound = 2.0 * (library_changes[i] + prototype_changes[i]) + rounding;
        if exceeds(apart[i], bound) {
            return Err(format!(
                "{}: {quantity} of library and prototype differ by {:.1e}, more than their errors of {bound:.1e}",
                case.name(),
                apart[i],
            )
            .into());
        }
    }
    Ok(())
}

/// An error unless the prototype keeps its laws over many steps of the case's size.
#[cfg(test)]
pub(crate) fn check_laws(case: CaseName, steps: u32) -> Result<(), Box<dyn Error>> {
    of_case!(case, checked_steps(case, step(case, Form::Explicit), steps)).map(drop)
}

/// The prototype's state after some steps, with its laws checked after each.
fn checked_steps<C: Pendulum<N, X>, const N: usize, const X: usize>(
    case: CaseName,
    step: f64,
    steps: u32,
) -> Result<State, Box<dyn Error>> {
    let mut run = Run::<C, N, X>::new();
    let first = energy(case, &run);
    for _ in 0..steps {
        let before: f64 = run.entropies().iter().sum();
        run.step(step, None)
            .map_err(|_| "the prototype rejects a step")?;
        let defect = (energy(case, &run) - first).abs();
        let bound = ENERGY_ROUNDINGS * ROUNDING * run.energy_size();
        if exceeds(defect, bound) {
            return Err(format!("the prototype's energy is off by {defect:e} J").into());
        }
        let [defect, size] = run.momentum_defect();
        if exceeds(defect, MOMENTUM_ROUNDINGS * ROUNDING * size) {
            return Err(format!("the prototype's momentum is off by {defect:e} N m s").into());
        }
        let lost = before - run.entropies().iter().sum::<f64>();
        let size: f64 = run.entropies().iter().map(|s| s.abs()).sum();
        if exceeds(lost, ENTROPY_ROUNDINGS * ROUNDING * size) {
            return Err(format!("the prototype loses an entropy of {lost:e} J/K").into());
        }
    }
    Ok(run.state())
}

/// E by the formulas of `springs`, in temperature variables, J.
fn energy<C: Pendulum<N, X>, const N: usize, const X: usize>(
    case: CaseName,
    run: &Run<C, N, X>,
) -> f64 {
    let state = run.state();
    match case.double() {
        None => {
            let system = Single::new(Variables::Temperature, state);
            let mut y = system.start();
            y[6] = run.entropies()[1];
            system.energy(&y)
        }
        Some(case) => {
            let system = Double::new(&case, Variables::Temperature, state);
            system.energy(&system.start())
        }
    }
}

/// True for a value that is not a number, too.
fn exceeds(value: f64, bound: f64) -> bool {
    value.is_nan() || value > bound
}
