//! The sweeps over programs: forwards against differences in high precision, backwards against forwards.

use crate::support::precise::{Precise, to_f64};
use crate::support::random::{Random, expression};
use eem_symbolic::{
    Arithmetic, Bounded, ExprId, F64, Function, Graph, Input, Instruction, Operation, Program,
    ProgramKernel, RunningError, Stage, Symbol, Value, VerifyError, adjoint, divided_difference,
    schedule, substitute, tangent,
};
use eem_testkit::length::at_length;
use eem_testkit::precise::BigFloat;

/// How many random expressions.
fn random() -> u64 {
    at_length(200, 70)
}

const DEPTH: usize = 4;
/// Central differences in high precision: offset 1e-30, squared, and magnified by large third derivatives.
const DIFFERENCE: f64 = 1e-45;
/// Both sides differ by the rounding of 512 bits, magnified by quotients.
const PRECISE: f64 = 1e-60;

/// Values p, a, b: a parameter, and a variable at two states.
const POINT: [f64; 3] = [1.3, 0.4, 0.55];

fn input(graph: &mut Graph, name: &str) -> Input {
    Input {
        symbol: graph.symbol(name),
        name: name.to_owned(),
        stage: Stage::New,
    }
}

fn inputs(name: &str, count: usize) -> Vec<Input> {
    let mut graph = Graph::new();
    let names = (0..count).map(|index| format!("{name}{index}"));
    names.map(|name| input(&mut graph, &name)).collect()
}

/// An expression of p and x at x = a, its divided difference between a and b, and a mixture of both.
fn secant(write: impl FnOnce(&mut Graph, ExprId, ExprId) -> ExprId) -> Program {
    let mut graph = Graph::new();
    let [p, x] = ["p", "x"].map(|name| graph.symbol(name));
    let (a, b) = (graph.version(x, "a"), graph.version(x, "b"));
    let variables = [p, x, a, b].map(|symbol| graph.variable(symbol));
    let e = write(&mut graph, variables[0], variables[1]);
    let difference = divided_difference(&mut graph, e, x, variables[2], variables[3]);
    let value = substitute(&mut graph, e, &[(x, variables[2])]);
    let mixture = graph.div(difference, variables[3]);
    let mixture = graph.mul(mixture, value);
    let input = |symbol: Symbol, stage| Input {
        symbol,
        name: graph.name(symbol).to_owned(),
        stage,
    };
    let inputs = vec![
        input(p, Stage::Old),
        input(a, Stage::Old),
        input(b, Stage::New),
    ];
    schedule(&graph, inputs, &[value, difference, mixture])
}

/// All functions, roots and powers, those with the exponent p too.
fn everything(graph: &mut Graph, p: ExprId, x: ExprId) -> ExprId {
    let argument = {
        let scaled = graph.mul(p, x);
        graph.powi(scaled, 3)
    };
    let mut terms = Vec::new();
    for &function in Function::ALL {
        terms.push(graph.apply(function, argument));
    }
    let one = graph.integer(1);
    let base = graph.add(one, x);
    terms.push(graph.power(base, p));
    terms.push(graph.power(base, x));
    terms.push(graph.sqrt(argument));
    terms.push(graph.recip(base));
    terms.push(graph.powi(base, 5));
    terms.push(graph.powi(base, -3));
    let ends = [argument, base];
    terms.push(graph.div(ends[0], ends[1]));
    let sum = graph.sum(&terms);
    graph.neg(sum)
}

fn programs() -> Vec<Program> {
    let random = (0..random()).map(|seed| {
        secant(|graph, p, x| {
            let product = graph.mul(p, x);
            expression(graph, &mut Random::new(seed), product, DEPTH)
        })
    });
    random.chain([secant(everything)]).collect()
}

/// `[output …]` where one input is moved by ± 2⁻¹⁰⁰, and the derivative that this means.
fn difference(
    p: &Precise,
    at: &[BigFloat],
    j: usize,
    run: impl Fn(&[BigFloat]) -> Vec<BigFloat>,
) -> Vec<BigFloat> {
    let offset = p.mul(&p.two_to(-100), &at[j]);
    let end = |x: BigFloat| {
        let mut at = at.to_vec();
        at[j] = x;
        run(&at)
    };
    let (above, below) = (end(p.add(&at[j], &offset)), end(p.sub(&at[j], &offset)));
    let width = p.add(&offset, &offset);
    let pairs = above.iter().zip(&below);
    pairs
        .map(|(above, below)| p.div(&p.sub(above, below), &width))
        .collect()
}

/// |a − b| over the larger magnitude, which is at least `floor`.
fn relative(p: &Precise, a: &BigFloat, b: &BigFloat, floor: f64) -> f64 {
    let scale = to_f64(a).abs().max(to_f64(b).abs()).max(floor);
    to_f64(&p.sub(a, b)).abs() / scale
}

/// Whether the numbers say something about rounding.
fn is_moderate(values: &[BigFloat]) -> bool {
    values.iter().all(|value| to_f64(value).abs() < 1e6)
}

#[test]
fn forwards_is_what_differences_say() {
    let p = Precise::new();
    let mut compared = 0;
    for (index, program) in programs().iter().enumerate() {
        for j in 0..POINT.len() {
            let derivative = tangent(program, &inputs("d", 1), &[j]);
            assert_eq!(derivative.verify(), Ok(()), "{index}");
            let at = p.all(&POINT);
            let expected = difference(&p, &at, j, |at| program.interpret(&p, at));
            let found = derivative.interpret(&p, &[&at[..], &[p.from_f64(1.0)]].concat());
            if !is_moderate(&expected) {
                continue;
            }
            for (i, (found, expected)) in found.iter().zip(&expected).enumerate() {
                let error = relative(&p, found, expected, 1e-6);
                assert!(error < DIFFERENCE, "{index}: [{i}] by {j}: {error:e}");
            }
            compared += 1;
        }
    }
    assert!(compared > random(), "{compared}");
}

/// `wᵀ (∂y/∂x d)` forwards and backwards, in many digits and within the bounds of double precision. Whether there is a
/// bound: that of a power that vanishes is NaN.
fn agree([forwards, backwards]: [&Program; 2], at: &[f64], [rows, columns]: [usize; 2]) -> bool {
    let p = Precise::new();
    let mut random = Random::new(7);
    let mut numbers = |count| -> Vec<f64> { (0..count).map(|_| random.unit() - 0.5).collect() };
    let (weights, direction) = (numbers(rows), numbers(columns));
    let sides = [
        (forwards, &direction, &weights),
        (backwards, &weights, &direction),
    ];
    let precise = sides.map(|(program, seed, factors)| {
        let inputs = p.all(&[at, seed].concat());
        let factors = p.all(factors);
        let pairs = program.interpret(&p, &inputs).into_iter().zip(&factors);
        let terms = pairs.map(|(output, factor)| p.mul(&output, factor));
        terms.fold(p.from_f64(0.0), |sum, term| p.add(&sum, &term))
    });
    let error = relative(&p, &precise[0], &precise[1], 1e-6);
    assert!(error < PRECISE, "{error:e}");
    let bounded = sides.map(|(program, seed, factors)| {
        let inputs = [at, seed].concat().into_iter().map(Bounded::exact);
        let outputs = program.interpret(&RunningError, &inputs.collect::<Vec<_>>());
        let terms = outputs.iter().zip(factors);
        let terms =
            terms.map(|(output, factor)| (output.value * factor, output.error * factor.abs()));
        terms.fold((0.0, 0.0), |sum, term| (sum.0 + term.0, sum.1 + term.1))
    });
    let off = (bounded[0].0 - bounded[1].0).abs();
    let allowed = bounded[0].1 + bounded[1].1;
    assert!(
        off <= allowed || allowed.is_nan(),
        "{off:e} of {:e}, {allowed:e} are allowed",
        bounded[0].0
    );
    !allowed.is_nan()
}

#[test]
fn backwards_is_forwards() {
    let mut bounded = 0;
    let programs = programs();
    for program in &programs {
        for wanted in [&[0, 1, 2][..], &[0]] {
            let (rows, columns) = (program.outputs.len(), wanted.len());
            let forwards = tangent(program, &inputs("d", columns), wanted);
            let backwards = adjoint(program, &inputs("w", rows), wanted);
            bounded += usize::from(agree([&forwards, &backwards], &POINT, [rows, columns]));
        }
    }
    assert!(bounded > programs.len(), "{bounded}");
}

#[test]
fn what_no_output_depends_on_has_no_derivative() {
    let program = secant(|graph, _, x| graph.powi(x, 3));
    let derivative = adjoint(&program, &inputs("w", 3), &[0]);
    assert_eq!(derivative.verify(), Ok(()));
    assert_eq!(
        derivative.interpret(&F64, &[1.3, 0.4, 0.55, 1.0, 1.0, 1.0]),
        [0.0]
    );
    assert!(
        adjoint(&program, &inputs("w", 3), &[])
            .instructions
            .is_empty()
    );
}

#[test]
fn third_differences_are_refused() {
    let operations = [
        Operation::Input(0),
        Operation::Input(1),
        Operation::SecondDividedDifference(
            ProgramKernel::Function(Function::Sin),
            Value::new(0),
            Value::new(1),
        ),
    ];
    let stage = Stage::New;
    let instructions = operations.into_iter();
    let program = Program {
        inputs: inputs("x", 2),
        instructions: instructions
            .map(|operation| Instruction { operation, stage })
            .collect(),
        outputs: vec![Value::new(2)],
    };
    for derivative in [
        adjoint(&program, &inputs("w", 1), &[0]),
        tangent(&program, &inputs("d", 1), &[1]),
    ] {
        let refused = derivative.verify();
        assert!(matches!(
            refused,
            Err(VerifyError::NonFiniteConstant { .. })
        ));
    }
}
