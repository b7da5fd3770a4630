//! Each generated function against the interpreter.
//!
//! The interpreter carries a bound of the rounding error of what it computes. The generated
//! function computes the same in the same order, so that both are within the bound of the exact
//! value and within twice the bound of each other.

use eem_runtime::Array;
use eem_symbolic::{Bounded, Program, RunningError};

use crate::generated_against_interpreter::laws::Law;
use crate::generated_against_interpreter::properties::{corners, steps};

/// Room for what the first-order bound leaves out.
const FACTOR: f64 = 2.5;
/// The error of a sum of all inputs, for outputs that are exactly zero in one of the evaluations.
const TINY: f64 = 1e-300;

/// The array with these elements.
pub(crate) fn array<A: Array<f64>>(elements: &[f64]) -> A {
    let mut array = A::filled(0.0);
    array.as_mut().copy_from_slice(elements);
    array
}

/// The rows of a matrix one after the other.
fn flat<R: Array<f64>, M: Array<R>>(matrix: &M) -> Vec<f64> {
    matrix
        .as_ref()
        .iter()
        .flat_map(|row| row.as_ref().to_vec())
        .collect()
}

fn parameters<L: Law>(law: &L) -> Vec<f64> {
    (0..L::PARAMETERS.len())
        .map(|index| law.parameter(index))
        .collect()
}

fn check(program: &Program, inputs: &[f64], generated: &[f64]) {
    program.verify().expect("the program is valid");
    let inputs: Vec<Bounded> = inputs.iter().map(|&value| Bounded::exact(value)).collect();
    let expected = program.interpret(&RunningError, &inputs);
    assert_eq!(expected.len(), generated.len());
    for (index, (expected, &generated)) in expected.iter().zip(generated).enumerate() {
        let difference = (expected.value - generated).abs();
        assert!(
            difference <= FACTOR * expected.error + TINY,
            "output {index}: generated {generated:e}, interpreted {:e} ± {:e}",
            expected.value,
            expected.error,
        );
    }
}

/// The functions of one state.
pub(crate) fn points<L: Law>() {
    let (law, programs) = (L::example(), L::symbolic().programs());
    for (_, x) in steps::<L>() {
        let state: L::Variables = array(&x);
        let inputs = [parameters(&law), x.clone()].concat();
        check(&programs.free_energy, &inputs, &[law.free_energy(&state)]);
        let magnitude = law.energy_magnitude(&state);
        check(&programs.energy_magnitude, &inputs, &[magnitude]);
        check(
            &programs.internal_energy,
            &inputs,
            &[law.internal_energy(&state)],
        );
        check(&programs.gradient, &inputs, law.gradient(&state).as_ref());
        let (gradient, hessian) = law.hessian(&state);
        check(
            &programs.hessian,
            &inputs,
            &[gradient.as_ref(), &flat(&hessian)].concat(),
        );
        if let Some(caloric) = &programs.caloric {
            let found = law.caloric(&state);
            let found = [found.entropy, found.heat_capacity, found.magnitude];
            check(caloric, &inputs, &found);
        }
        if let Some(viscosity) = &programs.viscosity {
            let theta = x.last().copied().unwrap_or_default();
            let (eta, eta_theta) = law.viscosity(theta);
            let inputs = [parameters(&law), vec![theta]].concat();
            check(
                viscosity,
                &inputs,
                &[eta.as_ref(), eta_theta.as_ref()].concat(),
            );
        }
    }
}

/// The algorithmic forms, from vanishing increments to large ones.
pub(crate) fn forms<L: Law>() {
    let (law, programs) = (L::example(), L::symbolic().programs());
    for (x0, x1) in steps::<L>() {
        let corners = corners(&law, &x0, &x1);
        let (old, new): (L::Variables, L::Variables) = (array(&x0), array(&x1));
        let inputs = [parameters(&law), x0, x1, corners.clone()].concat();
        let kept = law.entropy_form_old(&old);
        let (response, tangent) = law.entropy_form(&kept, &new, &array(&corners));
        let found = [response.as_ref(), &flat(&tangent)].concat();
        check(&programs.entropy_form, &inputs, &found);
        if let Some(program) = &programs.temperature_form {
            let kept = law.temperature_form_old(&old);
            let (response, tangent) = law.temperature_form(&kept, &new);
            let found = [response.as_ref(), &flat(&tangent)].concat();
            check(program, &inputs, &found);
        }
    }
}
