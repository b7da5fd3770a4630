//! Derivatives of a law by its parameters: against differences in high precision, corners found anew, and one sweep
//! against the other.

use crate::support::corners::{Evaluated, evaluated};
use crate::support::precise::{Precise, to_f64};
use crate::support::random::Random;
use eem_symbolic::{
    Arithmetic, Bounded, DifferencePart, Operation, ParameterPrograms, Program, RunningError, Stage,
};
use eem_testkit::length::{at_length, in_turn};
use eem_testkit::precise::BigFloat;

/// A central difference in high precision: offset 1e-30, squared.
const DIFFERENCE: f64 = 1e-50;
/// Increments of every variable relative to its size.
const INCREMENTS: [f64; 3] = [0.0, -0.1, 1e-9];
/// What an adjoint may cost, values included, over what it is the derivative of. Baur & Strassen 1983: four times.
const COST: usize = 3;

fn moved(state: &[f64], increment: f64) -> Vec<f64> {
    let factors = [1.0, -0.6, 0.8, 0.3].into_iter().cycle();
    let pairs = state.iter().zip(factors);
    pairs
        .map(|(x, factor)| x * (1.0 + factor * increment))
        .collect()
}

/// Numbers between −½ and ½.
fn numbers(count: usize, seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    (0..count).map(|_| random.unit() - 0.5).collect()
}

/// `Σ a b`.
fn product(p: &Precise, a: &[BigFloat], b: &[BigFloat]) -> BigFloat {
    let terms = a.iter().zip(b).map(|(a, b)| p.mul(a, b));
    terms.fold(p.from_f64(0.0), |sum, term| p.add(&sum, &term))
}

/// `∂(outputs)/∂μ_j` by a central difference; the outputs are a function of the law with other parameters.
fn difference(
    law: &mut Evaluated,
    j: usize,
    outputs: &dyn Fn(&Evaluated) -> Vec<BigFloat>,
) -> Vec<BigFloat> {
    let at = law.parameters[j].clone();
    let offset = law.precise.mul(&law.precise.two_to(-100), &at);
    law.parameters[j] = law.precise.add(&at, &offset);
    let above = outputs(law);
    law.parameters[j] = law.precise.sub(&at, &offset);
    let below = outputs(law);
    law.parameters[j] = at;
    let p = &law.precise;
    let width = p.add(&offset, &offset);
    let pairs = above.iter().zip(&below);
    pairs
        .map(|(above, below)| p.div(&p.sub(above, below), &width))
        .collect()
}

/// An adjoint at weights `w`, a tangent if there is one along every parameter, against differences of the outputs.
fn check(
    law: &mut Evaluated,
    what: &str,
    [adjoint, tangent]: [Option<&Program>; 2],
    inputs: &[BigFloat],
    outputs: &dyn Fn(&Evaluated) -> Vec<BigFloat>,
) {
    let rows = outputs(law).len();
    let weights = law.precise.all(&numbers(rows, 3));
    let found = adjoint.map(|program| law.run(program, &[inputs, &weights]));
    for j in 0..law.parameters.len() {
        let expected = difference(law, j, outputs);
        let p = &law.precise;
        let name = law.law.name;
        // Derivatives are of very different sizes: they count by what a parameter of its size does.
        let scale = |value: f64| value.abs().max(to_f64(&law.parameters[j]).abs().recip());
        if let Some(found) = &found {
            let expected = product(p, &expected, &weights);
            let error = to_f64(&p.sub(&found[j], &expected)).abs() / scale(to_f64(&expected));
            assert!(error < DIFFERENCE, "{name}, {what} by {j}: {error:e}");
        }
        if let Some(tangent) = tangent {
            let mut direction = vec![p.from_f64(0.0); law.parameters.len()];
            direction[j] = p.from_f64(1.0);
            let found = law.run(tangent, &[inputs, &direction]);
            for (i, (found, expected)) in found.iter().zip(&expected).enumerate() {
                let error = to_f64(&p.sub(found, expected)).abs() / scale(to_f64(expected));
                assert!(error < DIFFERENCE, "{name}, {what} [{i}] by {j}: {error:e}");
            }
        }
    }
}

#[test]
fn forms_are_what_differences_say() {
    for (index, mut law) in evaluated(1).into_iter().enumerate() {
        let derivatives = law.law.model.parameter_programs(&law.programs);
        let rows = law.responses();
        for &increment in in_turn(&INCREMENTS, index) {
            let x0 = law.precise.all(&law.law.state);
            let x1 = law.precise.all(&moved(&law.law.state, increment));
            let corners = law.corners(&x0, &x1);
            let programs = [
                &derivatives.entropy_form_adjoint,
                &derivatives.entropy_form_tangent,
            ];
            check(
                &mut law,
                "entropy form",
                programs.map(Some),
                &[&x0[..], &x1, &corners].concat(),
                &|law| law.entropy_form(&x0, &x1)[..rows].to_vec(),
            );
            let programs = [
                derivatives.temperature_form_adjoint.as_ref(),
                derivatives.temperature_form_tangent.as_ref(),
            ];
            if law.thermal() {
                check(
                    &mut law,
                    "temperature form",
                    programs,
                    &[&x0[..], &x1].concat(),
                    &|law| law.temperature_form(&x0, &x1)[..rows].to_vec(),
                );
            }
        }
    }
}

#[test]
fn functions_of_a_state_are_what_differences_say() {
    for mut law in evaluated(1) {
        let derivatives = law.law.model.parameter_programs(&law.programs);
        let x = law.precise.all(&law.law.state);
        let gradient = [Some(&derivatives.gradient_adjoint), None];
        check(&mut law, "gradient", gradient, &x, &|law| {
            law.run(&law.programs.gradient, &[&x])
        });
        for j in 0..law.parameters.len() {
            let expected = difference(&mut law, j, &|law| vec![law.energy(&x)]);
            let found = law.run(&derivatives.energy_by_parameters, &[&x]);
            let error = to_f64(&law.precise.sub(&found[j], &expected[0])).abs();
            let scale = to_f64(&expected[0])
                .abs()
                .max(to_f64(&law.parameters[j]).abs().recip());
            assert!(
                error < DIFFERENCE * scale,
                "{}, energy by {j}: {error:e}",
                law.law.name
            );
        }
        let theta = x[law.mechanical()..].to_vec();
        let laws = law.law.model.viscosities.len();
        if let Some(program) = &derivatives.viscosity_adjoint {
            check(
                &mut law,
                "viscosity",
                [Some(program), None],
                &theta,
                &|law| {
                    let program = law.programs.viscosity.as_ref().expect("dashpots");
                    law.run(program, &[&theta])[..laws].to_vec()
                },
            );
        }
    }
}

/// `wᵀ (∂(response)/∂μ δμ)` by an adjoint and by a tangent, within the bounds of double precision.
fn agree(law: &Evaluated, [adjoint, tangent]: [&Program; 2], inputs: &[f64]) -> [f64; 2] {
    let weights = numbers(law.responses(), 5);
    // In parts of the parameters.
    let parts = numbers(law.parameters.len(), 6)
        .into_iter()
        .zip(&law.law.parameters);
    let direction: Vec<f64> = parts.map(|(part, parameter)| part * parameter).collect();
    let side = |program: &Program, seed: &[f64], factors: &[f64]| {
        let inputs = [&law.law.parameters[..], inputs, seed].concat().into_iter();
        let inputs: Vec<_> = inputs.map(Bounded::exact).collect();
        let outputs = program.interpret(&RunningError, &inputs);
        let terms = outputs.into_iter().zip(factors);
        terms.fold((0.0, 0.0), |(value, error), (output, factor)| {
            (
                value + output.value * factor,
                error + output.error * factor.abs(),
            )
        })
    };
    let sides = [
        side(adjoint, &weights, &direction),
        side(tangent, &direction, &weights),
    ];
    let off = (sides[0].0 - sides[1].0).abs();
    [off / (sides[0].1 + sides[1].1), off / sides[0].0.abs()]
}

#[test]
fn adjoints_agree_with_tangents() {
    for law in evaluated(1) {
        let derivatives = law.law.model.parameter_programs(&law.programs);
        let mut worst = [0.0_f64; 2];
        for &increment in at_length(&INCREMENTS[..], &INCREMENTS[..2]) {
            let x0 = law.law.state.clone();
            let x1 = moved(&x0, increment);
            let corners = law.corners(&law.precise.all(&x0), &law.precise.all(&x1));
            let corners: Vec<_> = corners.iter().map(to_f64).collect();
            let states = [&x0[..], &x1].concat();
            let both = [
                &derivatives.entropy_form_adjoint,
                &derivatives.entropy_form_tangent,
            ];
            let mut found = vec![agree(&law, both, &[&states[..], &corners].concat())];
            if let (Some(adjoint), Some(tangent)) = (
                &derivatives.temperature_form_adjoint,
                &derivatives.temperature_form_tangent,
            ) {
                found.push(agree(&law, [adjoint, tangent], &states));
            }
            for [of_bound, relative] in found {
                assert!(
                    of_bound <= 1.0,
                    "{} {increment:e}: {of_bound}",
                    law.law.name
                );
                worst = [worst[0].max(of_bound), worst[1].max(relative)];
            }
        }
        let [of_bound, relative] = worst;
        println!(
            "{:22} {of_bound:.3} of the bound, {relative:.1e}",
            law.law.name
        );
    }
}

fn derivatives(law: &Evaluated) -> ParameterPrograms {
    law.law.model.parameter_programs(&law.programs)
}

#[test]
fn no_third_difference_is_needed() {
    for law in evaluated(1) {
        let derivatives = derivatives(&law);
        assert_eq!(derivatives.verify(), Ok(()), "{}", law.law.name);
        for (name, program) in derivatives.named() {
            let stages = program
                .instructions
                .iter()
                .map(|instruction| instruction.stage);
            assert!(
                stages.into_iter().all(|stage| stage == Stage::New),
                "{name}"
            );
        }
        // The responses hold first differences alone.
        for form in [
            Some(&law.programs.entropy_form),
            law.programs.temperature_form.as_ref(),
        ] {
            let Some(form) = form else { continue };
            let response = form.restricted_to(law.responses()).program;
            let is_second = |operation: &Operation| {
                matches!(
                    operation,
                    Operation::SecondDividedDifference(..)
                        | Operation::Part(_, DifferencePart::SecondA | DifferencePart::SecondB)
                )
            };
            let mut operations = response.instructions.iter();
            assert!(!operations.any(|instruction| is_second(&instruction.operation)));
        }
    }
}

#[test]
fn derivatives_cost_three_times_the_values_at_most() {
    for law in evaluated(1) {
        let derivatives = derivatives(&law);
        let all = |program: &Program| {
            let count = program.operation_count();
            [
                count.old.total() + count.new.total(),
                count.old.kernels + count.new.kernels,
            ]
        };
        let response = |form: &Program| all(&form.restricted_to(law.responses()).program);
        // The adjoint differentiates what determines the corners, too.
        let mut entropy = response(&law.programs.entropy_form);
        let corners = law.programs.mixed_states.as_ref().map_or([0, 0], all);
        println!("{:22} corners {corners:?}", law.law.name);
        entropy
            .iter_mut()
            .zip(corners)
            .for_each(|(sum, cost)| *sum += cost);
        let mut rows = vec![(
            "entropy",
            entropy,
            all(&derivatives.entropy_form_adjoint),
            all(&derivatives.entropy_form_tangent),
        )];
        if let (Some(form), Some(adjoint), Some(tangent)) = (
            &law.programs.temperature_form,
            &derivatives.temperature_form_adjoint,
            &derivatives.temperature_form_tangent,
        ) {
            rows.push(("temperature", response(form), all(adjoint), all(tangent)));
        }
        for (form, response, adjoint, tangent) in rows {
            println!(
                "{:22} {form:12} response {response:?}, adjoint {adjoint:?}, tangent {tangent:?}",
                law.law.name
            );
            for i in 0..2 {
                assert!(adjoint[i] <= COST * response[i], "{} {form}", law.law.name);
            }
        }
    }
}
