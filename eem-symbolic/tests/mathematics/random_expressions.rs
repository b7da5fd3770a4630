//! Divided differences of random expressions: right to their running error bound at any increment.

use crate::support::precise::{Precise, error, to_f64};
use crate::support::random::{Random, expression};
use eem_symbolic::{
    Arithmetic, Bounded, ExprId, F64, Graph, Input, Instruction, Operation, Program, RunningError,
    Stage, Symbol, Value, diff, divided_difference, schedule,
};
use eem_testkit::length::at_length;
use eem_testkit::precise::BigFloat;

const EXPRESSIONS: u64 = 2000;
/// Of these with a high precision.
const PRECISE: u64 = 500;
const DEPTH: usize = 6;
/// |b − a|/a, zero and from far below rounding to the same size.
const INCREMENTS: [f64; 9] = [0.0, 1e-17, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1e-1, 1.0];
/// Expressions that grow beyond this, or whose derivatives do, say nothing about rounding.
const LARGE: f64 = 1e6;
/// The quadrature that stands for kernels here does not resolve sin between larger arguments.
const OSCILLATING: f64 = 50.0;

/// f(a), f(b), f\[a, b\] and ∂f\[a, b\]/∂b of a random expression.
struct Secant {
    value: Program,
    difference: Program,
    slope: Program,
}

fn secant(seed: u64) -> Secant {
    let mut random = Random::new(seed);
    let mut graph = Graph::new();
    let x = graph.symbol("x");
    let variable = graph.variable(x);
    let e = expression(&mut graph, &mut random, variable, DEPTH);
    let (a, b) = (graph.version(x, "a"), graph.version(x, "b"));
    let ends = [graph.variable(a), graph.variable(b)];
    let difference = divided_difference(&mut graph, e, x, ends[0], ends[1]);
    let slope = diff(&mut graph, difference, b);
    Secant {
        value: program(&graph, &[x], e),
        difference: program(&graph, &[a, b], difference),
        slope: program(&graph, &[a, b], slope),
    }
}

fn program(graph: &Graph, symbols: &[Symbol], output: ExprId) -> Program {
    let input = |&symbol: &Symbol| Input {
        symbol,
        name: graph.name(symbol).to_owned(),
        stage: Stage::New,
    };
    schedule(graph, symbols.iter().map(input).collect(), &[output])
}

fn run<A: Arithmetic>(program: &Program, arithmetic: &A, inputs: &[A::Number]) -> A::Number {
    program.interpret(arithmetic, inputs).swap_remove(0)
}

/// The ends of random expression `seed` for one increment.
fn ends(seed: u64, increment: f64) -> [f64; 2] {
    let a = 0.3 + 1.5 * Random::new(seed ^ 0xabcd).unit();
    [a, a * (1.0 + increment)]
}

/// Whether all quantities are of moderate size at these ends, and the arguments of all divided
/// differences below [`OSCILLATING`].
fn moderate(secant: &Secant, ends: [f64; 2]) -> bool {
    let mut all = secant.difference.clone();
    all.outputs = (0..all.instructions.len()).map(Value::new).collect();
    let values = all.interpret(&F64, &ends);
    let resolved = |instruction: &Instruction| match &instruction.operation {
        Operation::DividedDifference(_, a, b) => {
            let ends = [a, b].map(|end| values[end.index()]);
            ends.iter().all(|end| end.abs() < OSCILLATING)
        }
        _ => true,
    };
    let difference = values[secant.difference.outputs[0].index()];
    let values = ends.map(|x| run(&secant.value, &F64, &[x]));
    let sizes = [values[0], values[1], difference];
    sizes.iter().all(|size| size.abs() < LARGE) && all.instructions.iter().all(resolved)
}

#[test]
fn differences_are_within_their_bound() {
    let precise = Precise::new();
    let (mut checked, mut worst, mut ulps) = (0, 0.0_f64, Vec::new());
    for seed in 0..at_length(EXPRESSIONS, PRECISE) {
        let secant = secant(seed);
        let increment = INCREMENTS[(seed % 9) as usize];
        let ends = ends(seed, increment);
        if !moderate(&secant, ends) {
            continue;
        }
        let bounded = run(&secant.difference, &RunningError, &ends.map(Bounded::exact));
        let exact = run(&secant.difference, &precise, &precise.all(&ends));
        let error = error(&precise, bounded.value, &exact);
        assert!(
            error <= bounded.error,
            "expression {seed} at {increment:e}: error {error:e}, bound {:e}",
            bounded.error
        );
        checked += 1;
        if error > 0.0 {
            worst = worst.max(error / bounded.error);
            ulps.push(error / to_f64(&exact).abs() / f64::EPSILON);
        }
    }
    ulps.sort_by(f64::total_cmp);
    println!(
        "{checked} expressions, largest error / bound {worst:.2}, median error {:.2} ulp",
        ulps[ulps.len() / 2]
    );
    assert!(
        checked > at_length(1500, 375),
        "only {checked} expressions are of moderate size"
    );
}

#[test]
fn differences_times_increments_are_differences() {
    let precise = Precise::new();
    for seed in 0..EXPRESSIONS / 10 {
        let secant = secant(seed);
        let ends = ends(seed, [1e-9, 1e-3, 1.0][(seed % 3) as usize]);
        if !moderate(&secant, ends) {
            continue;
        }
        let exact = precise.all(&ends);
        let [at_a, at_b] = [0, 1].map(|i| run(&secant.value, &precise, &exact[i..=i]));
        let quotient = precise.sub(&at_b, &at_a);
        let quotient = precise.div(&quotient, &precise.sub(&exact[1], &exact[0]));
        let difference = run(&secant.difference, &precise, &exact);
        let error = to_f64(&precise.sub(&difference, &quotient)).abs();
        // 512 bits less those that the quotient and the kernels' own quotients cancel.
        assert!(error < 1e-80, "expression {seed}: {error:e}");
    }
}

#[test]
fn second_differences_are_derivatives_of_first() {
    let precise = Precise::new();
    for seed in 0..EXPRESSIONS / 10 {
        let secant = secant(seed);
        let ends = ends(seed, INCREMENTS[(seed % 9) as usize]);
        if !moderate(&secant, ends) {
            continue;
        }
        let exact = precise.all(&ends);
        let offset = precise.two_to(-100);
        let at = |b: BigFloat| run(&secant.difference, &precise, &[exact[0].clone(), b]);
        let above = at(precise.add(&exact[1], &offset));
        let below = at(precise.sub(&exact[1], &offset));
        let width = precise.add(&offset, &offset);
        let expected = precise.div(&precise.sub(&above, &below), &width);
        let slope = run(&secant.slope, &precise, &exact);
        let error = to_f64(&precise.sub(&slope, &expected)).abs();
        // The offset 2⁻¹⁰⁰ squared, times third derivatives.
        assert!(error < 1e-40, "expression {seed}: {error:e}");
        let bounded = run(&secant.slope, &RunningError, &ends.map(Bounded::exact));
        let error = crate::support::precise::error(&precise, bounded.value, &slope);
        assert!(
            error <= bounded.error,
            "expression {seed}: {error:e}, {:e}",
            bounded.error
        );
    }
}
