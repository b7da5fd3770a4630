//! The algorithmic forms are the partitioned discrete derivatives, and their tangents are exact.

use crate::oracle::SymmetricKernels;
use crate::support::corners::{Evaluated, RANDOM, evaluated};
use crate::support::precise::{error, to_f64};
use eem_symbolic::{Arithmetic, Bounded, F64, Function, Operation, RunningError};
use eem_testkit::length::in_turn;
use eem_testkit::precise::BigFloat;

/// Increments of every variable relative to its size; the last one is negative for a change.
const INCREMENTS: [f64; 6] = [0.0, 1e-14, 1e-9, 1e-5, 1e-2, -0.1];

/// In high precision both sides differ by the rounding of 512 bits, magnified by quotients.
const PRECISE: f64 = 1e-60;

/// A central difference in high precision: offset 1e-30, squared.
const DIFFERENCE: f64 = 1e-50;

/// x¹ for a relative increment, each variable by another amount.
fn moved(state: &[f64], increment: f64) -> Vec<f64> {
    let factors = [1.0, -0.6, 0.8, 0.3].iter().cycle();
    state
        .iter()
        .zip(factors)
        .map(|(x, factor)| x * (1.0 + factor * increment))
        .collect()
}

/// Relative to the largest magnitude of the two.
fn relative(law: &Evaluated, a: &BigFloat, b: &BigFloat) -> f64 {
    let difference = to_f64(&law.precise.sub(a, b)).abs();
    let scale = to_f64(a).abs().max(to_f64(b).abs());
    if difference == 0.0 {
        0.0
    } else {
        difference / scale
    }
}

#[test]
fn responses_are_partitioned_quotients() {
    for (index, law) in evaluated(RANDOM).iter().enumerate() {
        for &increment in in_turn(&[1e-9, 1e-2, -0.1], index) {
            let x0 = law.precise.all(&law.law.state);
            let x1 = law.precise.all(&moved(&law.law.state, increment));
            let entropy = (law.entropy_form(&x0, &x1), law.entropy_quotients(&x0, &x1));
            let mut forms = vec![entropy];
            if law.thermal() {
                forms.push((
                    law.temperature_form(&x0, &x1),
                    law.temperature_quotients(&x0, &x1),
                ));
            }
            for (computed, defined) in forms {
                for (i, expected) in defined.iter().enumerate() {
                    let error = relative(law, &computed[i], expected);
                    assert!(
                        error < PRECISE,
                        "{} {increment} [{i}]: {error:e}",
                        law.law.name
                    );
                }
            }
        }
    }
}

#[test]
fn energy_is_the_sum_of_forces_times_increments() {
    for law in evaluated(RANDOM) {
        let p = &law.precise;
        let x0 = p.all(&law.law.state);
        let x1 = p.all(&moved(&law.law.state, 0.1));
        let (n, measures) = (law.mechanical(), law.law.model.measures.len());
        let mut forms = vec![law.entropy_form(&x0, &x1)];
        if law.thermal() {
            forms.push(law.temperature_form(&x0, &x1));
        }
        for response in forms {
            let mut work = p.from_f64(0.0);
            for i in 0..n {
                let force = if i < measures {
                    response[i].clone()
                } else {
                    p.neg(&response[i])
                };
                work = p.add(&work, &p.mul(&force, &p.sub(&x1[i], &x0[i])));
            }
            if law.thermal() {
                work = p.add(&work, &p.mul(&response[n], &response[n + 1]));
            }
            let change = p.sub(&law.energy(&x1), &law.energy(&x0));
            let error = relative(&law, &work, &change);
            assert!(error < PRECISE, "{}: {error:e}", law.law.name);
        }
    }
}

/// Tangent entry (i, j) against the central difference of response i in `x_j¹`.
#[test]
fn tangents_are_total_derivatives() {
    for (index, law) in evaluated(RANDOM).iter().enumerate() {
        for &increment in in_turn(&[0.0, 0.1, 1e-5], index) {
            let x0 = law.precise.all(&law.law.state);
            let x1 = law.precise.all(&moved(&law.law.state, increment));
            check_tangent(law, &x0, &x1, &|x0, x1| law.entropy_form(x0, x1));
            if law.thermal() {
                check_tangent(law, &x0, &x1, &|x0, x1| law.temperature_form(x0, x1));
            }
        }
    }
}

type Form<'f> = &'f dyn Fn(&[BigFloat], &[BigFloat]) -> Vec<BigFloat>;

fn check_tangent(law: &Evaluated, x0: &[BigFloat], x1: &[BigFloat], form: Form<'_>) {
    let p = &law.precise;
    let (rows, columns) = (law.responses(), x1.len());
    let computed = form(x0, x1);
    assert_eq!(computed.len(), rows * (columns + 1));
    for j in 0..columns {
        let offset = p.two_to(-100);
        let end = |x: BigFloat| {
            let mut x1 = x1.to_vec();
            x1[j] = x;
            form(x0, &x1)
        };
        let (above, below) = (end(p.add(&x1[j], &offset)), end(p.sub(&x1[j], &offset)));
        for i in 0..rows {
            let difference = p.div(&p.sub(&above[i], &below[i]), &p.add(&offset, &offset));
            let error = to_f64(&p.sub(&computed[rows + i * columns + j], &difference)).abs();
            let scale = to_f64(&difference).abs().max(1.0);
            let name = law.law.name;
            assert!(
                error < DIFFERENCE * scale,
                "{name} [{i}, {j}]: {error:e} of {scale:e}"
            );
        }
    }
}

/// Largest error in double precision of responses and of tangents.
struct Worst {
    response: f64,
    tangent: f64,
}

fn in_double_precision(law: &Evaluated, entropy: bool, increment: f64) -> Worst {
    let x0 = law.law.state.clone();
    let x1 = moved(&x0, increment);
    let (p0, p1) = (law.precise.all(&x0), law.precise.all(&x1));
    let mut inputs = law.law.parameters.clone();
    inputs.extend(&x0);
    inputs.extend(&x1);
    let (computed, exact) = if entropy {
        inputs.extend(law.corners(&p0, &p1).iter().map(to_f64));
        let computed = law.programs.entropy_form.interpret(&F64, &inputs);
        (computed, law.entropy_form(&p0, &p1))
    } else {
        let program = law
            .programs
            .temperature_form
            .as_ref()
            .expect("a thermal law");
        (
            program.interpret(&F64, &inputs),
            law.temperature_form(&p0, &p1),
        )
    };
    let rows = law.responses();
    let mut worst = Worst {
        response: 0.0,
        tangent: 0.0,
    };
    for i in 0..rows {
        let scale = to_f64(&exact[i]).abs();
        let error_of_row = error(&law.precise, computed[i], &exact[i]);
        if error_of_row > 0.0 {
            worst.response = worst.response.max(error_of_row / scale);
        }
        // An entry counts by what it does to the row: ∂R/∂x_j times the size of x_j.
        let row = rows + i * x1.len()..rows + (i + 1) * x1.len();
        let weights = || {
            computed[row.clone()]
                .iter()
                .zip(&x1)
                .map(|(d, x)| (d * x).abs())
        };
        let size = weights().fold(0.0, f64::max);
        for (entry, x) in row.clone().zip(&x1) {
            let error = error(&law.precise, computed[entry], &exact[entry]) * x.abs();
            worst.tangent = worst.tangent.max(error / size);
        }
    }
    worst
}

/// The quadrature of [`F64`] is right to about 1e-15, a form has some tens of operations.
const TANGENT: f64 = 1e-13;
const RESPONSE: f64 = 1e-14;

#[test]
fn double_precision_keeps_responses_and_tangents() {
    for law in evaluated(0) {
        for increment in INCREMENTS {
            for entropy in [true, false] {
                if !entropy && !law.thermal() {
                    continue;
                }
                let worst = in_double_precision(&law, entropy, increment);
                let name = law.law.name;
                println!(
                    "{name}, entropy {entropy}, {increment:e}: response {:.1e}, tangent {:.1e}",
                    worst.response, worst.tangent
                );
                assert!(worst.response < RESPONSE, "{name} {increment:e}");
                assert!(worst.tangent < TANGENT, "{name} {increment:e}");
            }
        }
    }
}

/// Exchanging the states changes no bit of f*, g*, θ*, and the sign of Δs: the scheme is
/// self-adjoint in floating-point arithmetic. A logarithm that one state has from the other one is
/// the same up to its rounding.
#[test]
fn temperature_form_is_symmetric_bit_by_bit() {
    let mut without_logarithm = 0;
    for law in evaluated(0) {
        let Some(program) = &law.programs.temperature_form else {
            continue;
        };
        let carried = program
            .instructions
            .iter()
            .any(|instruction| matches!(instruction.operation, Operation::Apply(Function::Ln, _)));
        without_logarithm += usize::from(!carried);
        for increment in [1e-12, 1e-3, 0.1] {
            let x0 = law.law.state.clone();
            let x1 = moved(&x0, increment);
            let inputs = |x0: &[f64], x1: &[f64]| [&law.law.parameters, x0, x1].concat();
            let forward = program.interpret(&SymmetricKernels, &inputs(&x0, &x1));
            let mut backward = program.interpret(&SymmetricKernels, &inputs(&x1, &x0));
            let last = law.responses() - 1;
            backward[last] = -backward[last];
            let exact = inputs(&x0, &x1).into_iter().map(Bounded::exact);
            let bounds = program.interpret(&RunningError, &exact.collect::<Vec<_>>());
            for i in 0..=last {
                // Both directions may be wrong by the bound.
                let allowed = if carried { 2.0 * bounds[i].error } else { 0.0 };
                assert!(
                    (forward[i] - backward[i]).abs() <= allowed,
                    "{} {increment:e}: {} and {}",
                    law.law.name,
                    forward[i],
                    backward[i]
                );
            }
        }
    }
    assert!(without_logarithm > 0);
}

#[test]
fn mixed_states_are_off_by_differences_of_the_entropy() {
    for law in evaluated(RANDOM).iter().filter(|law| law.thermal()) {
        let (p, n) = (&law.precise, law.mechanical());
        let program = law.programs.mixed_states.as_ref().expect("a thermal law");
        let caloric = law.programs.caloric.as_ref().expect("a thermal law");
        let moved = moved(&law.law.state, 1e-2);
        let [x0, x1] = [&law.law.state, &moved].map(|x| p.all(x));
        // Temperatures that are wrong by a few per cent.
        let factors = [1.01, 1.02, 0.99, 1.03].into_iter().cycle();
        let thetas = factors.map(|factor| p.mul(&x0[n], &p.from_f64(factor)));
        let thetas: Vec<_> = thetas.take(2 * n).collect();
        let found = law.run(program, &[&x0, &x1, &thetas]);
        for (index, theta) in thetas.iter().enumerate() {
            let (k, [to, from]) = if index < n {
                (index + 1, [&x1, &x0])
            } else {
                (index - n + 1, [&x0, &x1])
            };
            let mut state: Vec<_> = to[..k].iter().chain(&from[k..n]).cloned().collect();
            state.push(theta.clone());
            let at_state = law.run(caloric, &[&state]);
            let excess = p.sub(&at_state[0], &law.entropy(from));
            let size = to_f64(&at_state[2]);
            let off = to_f64(&p.sub(&found[index], &excess)).abs();
            assert!(off <= PRECISE * size, "{} {index}: {off:e}", law.law.name);
            let off = relative(law, &found[2 * n + index], &at_state[1]);
            assert!(off <= PRECISE, "{} {index}: {off:e}", law.law.name);
            if law.programs.has_constant_capacity {
                state[n] = p.mul(theta, &p.from_f64(2.0));
                let warmer = &law.run(caloric, &[&state])[1];
                assert!(
                    relative(law, warmer, &at_state[1]) <= PRECISE,
                    "{}",
                    law.law.name
                );
            }
        }
    }
}
