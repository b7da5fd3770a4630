//! The `f64` interpreter and its quadrature against high precision.

use crate::support::precise::{Precise, error, to_f64};
use crate::support::random::Random;
use eem_symbolic::{Arithmetic, Bounded, F64, Function, ProgramKernel, RunningError};

/// Relative error of the quadrature: some hundred positive terms of a few roundings each.
const QUADRATURE: f64 = 2e-14;

/// Ends of the same sign inside the domain of every function, where f′ and f″ keep their signs.
fn kernels() -> Vec<(ProgramKernel<f64>, f64)> {
    let mut kernels: Vec<_> = Function::ALL
        .iter()
        .filter(|function| **function != Function::Abs)
        .map(|&function| (ProgramKernel::Function(function), 0.3))
        .collect();
    let powers = [-3, -1, 3, 4, 7].map(|n| (ProgramKernel::Powi(n), 1.7));
    kernels.extend(powers);
    kernels.extend([0.3, 1.5, -0.7].map(|p| (ProgramKernel::Powf(p), 1.7)));
    kernels.push((ProgramKernel::Sqrt, 1.7));
    kernels
}

#[test]
fn quadrature_is_an_oracle_at_every_increment() {
    let precise = Precise::new();
    let mut worst = 0.0_f64;
    for (kernel, a) in kernels() {
        for increment in [
            0.0, 1e-17, 1e-15, 1e-12, 1e-8, 1e-4, 1e-2, 0.5, 1.0, -0.3, -0.99,
        ] {
            let b = a * (1.0 + increment);
            let ends = [a, b].map(|end| precise.from_f64(end));
            let first = F64.divided_difference(by_reference(&kernel), &a, &b);
            let second = F64.second_divided_difference(by_reference(&kernel), &a, &b);
            let exponent = match kernel {
                ProgramKernel::Powf(p) => precise.from_f64(p),
                _ => precise.from_f64(0.0),
            };
            let kernel = kernel.map(|_| &exponent);
            let exact = [
                precise.divided_difference(kernel, &ends[0], &ends[1]),
                precise.second_divided_difference(kernel, &ends[0], &ends[1]),
            ];
            for (computed, exact) in [first, second].into_iter().zip(&exact) {
                let relative = error(&precise, computed, exact) / to_f64(exact).abs();
                worst = worst.max(relative);
                assert!(relative < QUADRATURE, "{kernel:?} {a} {b}: {relative:e}");
            }
        }
    }
    println!("largest relative error {worst:.1e}");
}

fn by_reference(kernel: &ProgramKernel<f64>) -> ProgramKernel<&f64> {
    match kernel {
        ProgramKernel::Function(function) => ProgramKernel::Function(*function),
        ProgramKernel::Powi(n) => ProgramKernel::Powi(*n),
        ProgramKernel::Sqrt => ProgramKernel::Sqrt,
        ProgramKernel::Powf(p) => ProgramKernel::Powf(p),
        ProgramKernel::Power(a, b) => ProgramKernel::Power(a, b),
    }
}

#[test]
fn general_powers_take_their_values_from_the_ends() {
    // 2ˣ between 1 and 3: (8 − 2)/(3 ln 2 − ln 2).
    let [a, b] = [1.0, 3.0].map(|x: f64| x * 2.0_f64.ln());
    let kernel = ProgramKernel::Power(&2.0, &8.0);
    let difference = F64.divided_difference(kernel, &a, &b);
    assert!((difference / (6.0 / (2.0 * 2.0_f64.ln())) - 1.0).abs() < QUADRATURE);
    let kernel = ProgramKernel::Power(&2.0, &2.0);
    assert!((F64.divided_difference(kernel, &a, &a) - 2.0).abs() < QUADRATURE);
}

#[test]
fn magnitudes_have_a_difference_at_both_sides_of_zero() {
    let kernel = ProgramKernel::Function(Function::Abs);
    let cases = [(-3.0, -1.0, -1.0), (1.0, 3.0, 1.0), (-1.0, 3.0, 0.5)];
    for (a, b, expected) in cases {
        assert!((F64.divided_difference(kernel, &a, &b) - expected).abs() < QUADRATURE);
    }
}

/// Every program of every law within its running error bound of high precision.
#[test]
fn programs_are_within_their_bound() {
    let precise = Precise::new();
    let mut random = Random::new(7);
    for law in crate::support::all_laws() {
        let programs = law.model.programs();
        let mut all = vec![
            &programs.free_energy,
            &programs.hessian,
            &programs.internal_energy,
        ];
        all.extend(&programs.caloric);
        for program in all {
            for _ in 0..20 {
                let mut inputs = law.parameters.clone();
                inputs.extend(law.state.iter().map(|x| x * (0.8 + 0.4 * random.unit())));
                let bounded: Vec<_> = inputs.iter().copied().map(Bounded::exact).collect();
                let bounded = program.interpret(&RunningError, &bounded);
                let exact = program.interpret(&precise, &precise.all(&inputs));
                for (computed, exact) in bounded.iter().zip(&exact) {
                    let error = error(&precise, computed.value, exact);
                    assert!(error <= computed.error, "{}: {error:e}", law.name);
                }
            }
        }
    }
}
