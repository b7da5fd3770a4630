//! The magnitude of an expression bounds what rounding has done to its value, and not much more.

use crate::reader::read;
use crate::support::laws::{self, Law};
use crate::support::precise::{Precise, error};
use crate::support::random::{Random, expression};
use eem_symbolic::{Bounded, F64, Graph, LowerBound, Program, RunningError, magnitude};
use eem_testkit::length::at_length;
use eem_testkit::secant::program;

/// A magnitude is worth this many ε.
const UNITS: f64 = 8.0;
const DEPTH: usize = 6;
/// Larger expressions say nothing about rounding.
const LARGE: f64 = 1e6;
/// Roundings of the magnitude itself, relative.
const OWN: f64 = 1e-12;

fn run(program: &Program, inputs: &[f64]) -> f64 {
    program.interpret(&F64, inputs)[0]
}

/// Value and magnitude of a formula in lambda, gamma, theta and k.
fn of_formula(text: &str, inputs: [f64; 4]) -> [f64; 2] {
    let mut graph = Graph::new();
    let names = ["lambda", "gamma", "theta", "k"];
    let symbols = names.map(|name| graph.symbol(name));
    let e = read(&mut graph, text);
    let positive = [symbols[0], symbols[2]].map(LowerBound::positive);
    let bound = magnitude(&mut graph, e, &positive);
    [e, bound].map(|e| run(&program(&graph, &symbols, e), &inputs))
}

/// One random expression of x with the value of its error, its bound by running error analysis and
/// its magnitude.
struct Sample {
    value: f64,
    error: f64,
    bound: f64,
    magnitude: f64,
}

fn sample(precise: &Precise, seed: u64) -> Sample {
    let mut random = Random::new(seed);
    let mut graph = Graph::new();
    let symbol = graph.symbol("x");
    let variable = graph.variable(symbol);
    let e = expression(&mut graph, &mut random, variable, DEPTH);
    let of_value = program(&graph, &[symbol], e);
    let bound = magnitude(&mut graph, e, &[LowerBound::positive(symbol)]);
    let of_magnitude = program(&graph, &[symbol], bound);
    let x = 0.3 + 1.5 * Random::new(seed ^ 0xabcd).unit();
    let exact = of_value.interpret(precise, &precise.all(&[x]));
    let value = run(&of_value, &[x]);
    Sample {
        value,
        error: error(precise, value, &exact[0]),
        bound: of_value.interpret(&RunningError, &[Bounded::exact(x)])[0].error,
        magnitude: run(&of_magnitude, &[x]),
    }
}

#[test]
fn errors_of_random_expressions_are_within_their_magnitude() {
    let precise = Precise::new();
    let (mut checked, mut worst, mut wasted) = (0, 0.0_f64, Vec::new());
    for seed in 0..at_length(2000, 700) {
        let sample = sample(&precise, seed);
        if sample.value.abs() > LARGE || sample.value.is_nan() {
            continue;
        }
        let allowed = UNITS * f64::EPSILON * sample.magnitude;
        assert!(
            sample.error <= allowed,
            "expression {seed}: error {:e}, allowed {allowed:e}",
            sample.error
        );
        assert!(
            sample.value.abs() <= sample.magnitude * (1.0 + OWN),
            "expression {seed}"
        );
        checked += 1;
        worst = worst.max(sample.error / allowed);
        if sample.bound > 0.0 {
            wasted.push(allowed / sample.bound);
        }
    }
    wasted.sort_by(f64::total_cmp);
    let [least, median, most] = [0, wasted.len() / 2, wasted.len() - 1].map(|i| wasted[i]);
    println!("{checked} expressions, largest error / allowed {worst:.2}");
    println!("allowed / running error: least {least:.2}, median {median:.1}, most {most:.1}");
    assert!(
        checked > at_length(1900, 665),
        "only {checked} expressions are of moderate size"
    );
    assert!(least >= 1.0, "{least}");
}

/// Largest error and smallest magnitude of a formula next to λ = 1.
fn next_to_one(text: &str) -> [f64; 2] {
    let precise = Precise::new();
    let mut graph = Graph::new();
    let lambda = graph.symbol("lambda");
    let psi = read(&mut graph, text);
    let bound = magnitude(&mut graph, psi, &[LowerBound::positive(lambda)]);
    let [of_psi, of_bound] = [psi, bound].map(|e| program(&graph, &[lambda], e));
    let [mut largest, mut smallest] = [0.0_f64, f64::INFINITY];
    for i in 0..20 {
        let x = 1.0 + 1e-6 * (1.0 + 0.01 * f64::from(i));
        let exact = of_psi.interpret(&precise, &precise.all(&[x]));
        let value = run(&of_psi, &[x]);
        // ½ ψ″ (1e−6)² J out of terms of 1e8 J.
        assert!((1e-5..1e-3).contains(&value), "{text}: {value:e}");
        largest = largest.max(error(&precise, value, &exact[0]));
        smallest = smallest.min(run(&of_bound, &[x]));
    }
    [largest, smallest]
}

#[test]
fn terms_that_cancel_are_seen() {
    for text in [
        "100000000*(lambda - ln(lambda) - 1)",
        "100000000*(lambda^2 - 2*ln(lambda) - 1)",
    ] {
        let [error, magnitude] = next_to_one(text);
        assert!((1e8..4e8).contains(&magnitude), "{text}: {magnitude:e}");
        let allowed = UNITS * f64::EPSILON * magnitude;
        assert!(error <= allowed, "{text}: {error:e}");
    }
    // λ² is rounded before it cancels: far above 8 ε |ψ| ≈ 1e−19 J.
    let [error, _] = next_to_one("100000000*(lambda^2 - 2*ln(lambda) - 1)");
    assert!(error > 1e-10, "{error:e}");
}

/// Magnitudes by hand, of formulas that round in one place each.
#[test]
fn errors_of_operands_are_carried_on() {
    let close = |text: &str, inputs: [f64; 4], expected: f64| {
        let [_, found] = of_formula(text, inputs);
        assert!(
            (found / expected - 1.0).abs() < OWN,
            "{text}: {found:e}, not {expected:e}"
        );
    };
    let [l, g, t, k] = [1.25, 0.5, 300.0, 4.0];
    let at = [l, g, t, k];
    // A plain term is its own magnitude, whatever its sign.
    close("lambda", at, l);
    close("0-gamma", at, g);
    close("k*gamma^2*theta", at, k * g * g * t);
    close("lambda - gamma*k", at, l + g * k);
    // 2 |k (λ − γ)| (λ + |γ|) and the product itself.
    let square = k * (l - g) * (l - g);
    close(
        "k*(lambda - gamma)^2",
        at,
        square + 2.0 * k * (l - g) * (l + g),
    );
    // Nothing cancels in a sum of one sign.
    close("k*(lambda + gamma^2)", at, k * (l + g * g));
    // |x f′(x)| for a rounded argument, nothing for an exact one.
    close("exp(k*gamma)", at, (k * g).exp() * (1.0 + k * g));
    close("exp(gamma)", at, g.exp());
    close("ln(lambda/k)", at, 1.0 + (l / k).ln().abs());
    let argument = l + g;
    close(
        "ln(lambda - gamma)",
        at,
        (l - g).ln().abs() + argument / (l - g),
    );
    close(
        "sqrt(lambda - gamma)",
        at,
        (l - g).sqrt() + 0.5 * argument / (l - g).sqrt(),
    );
    close("abs(lambda - gamma)", at, argument);
}

/// At γ = 0 a power of γ² has neither an error nor a logarithm.
#[test]
fn magnitudes_are_finite_where_powers_vanish() {
    for text in [
        "lambda*(gamma^2)^k",
        "(gamma^2)^(k/2)",
        "(gamma^2 + gamma^4)^0.5",
        "(gamma^2)^1.25*theta",
        "(gamma*k)^0.5",
        "cbrt(gamma*k)",
    ] {
        let [value, bound] = of_formula(text, [1.25, 0.0, 300.0, 4.0]);
        assert_eq!([value, bound].map(f64::to_bits), [0; 2], "{text}");
    }
}

fn of_law(law: &Law) -> [f64; 2] {
    let programs = law.model.programs();
    let inputs = [&law.parameters[..], &law.state].concat();
    [&programs.free_energy, &programs.energy_magnitude].map(|program| run(program, &inputs))
}

/// Σ |terms| of ordinary springs, within a factor of ten: logarithms of quotients are what is more.
#[test]
fn ordinary_laws_have_ordinary_magnitudes() {
    for law in crate::support::all_laws() {
        let [psi, magnitude] = of_law(&law);
        println!("{}: ψ {psi:.3e}, magnitude {magnitude:.3e}", law.name);
        assert!(magnitude >= psi.abs() * (1.0 - OWN), "{}", law.name);
    }
    let law = laws::logarithmic_stiffness();
    let [lambda, theta] = law.state[..] else {
        panic!("two variables");
    };
    let (strain, ratio, excess) = ((lambda / 2.0).ln(), (theta / 300.0).ln(), theta - 300.0);
    let elastic = 0.5 * (5000.0 + 50.0 * 300.0 * ratio.abs()) * strain * strain;
    let coupling = 20.0 * (theta + 300.0) * strain.abs();
    let caloric = 5000.0 * (theta + 300.0 + theta * ratio.abs());
    let terms = elastic + coupling + caloric;
    let [_, magnitude] = of_law(&law);
    assert!(
        excess > 0.0 && (1.0..10.0).contains(&(magnitude / terms)),
        "{magnitude:e}, {terms:e}"
    );
}
