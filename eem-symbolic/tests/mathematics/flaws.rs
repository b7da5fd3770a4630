//! Flaws of models are found where they are certain, and only there.

use crate::oracle::value;
use crate::reader::read;
use crate::support::random::{Random, expression};
use eem_symbolic::{F64, Flaw, Graph, LowerBound, Model, Rational, Sign, range, sign};

/// The flaws of a model of lambda, gamma and theta, told by the names of the variables.
fn flaws(psi: &str, viscosity: &str) -> Vec<String> {
    let mut graph = Graph::new();
    let [lambda, gamma, theta] = ["lambda", "gamma", "theta"].map(|name| graph.symbol(name));
    let (psi, viscosity) = (read(&mut graph, psi), read(&mut graph, viscosity));
    let model = Model {
        graph,
        measures: vec![lambda],
        strains: vec![],
        dashpots: vec![gamma],
        temperature: Some(theta),
        parameters: vec![],
        psi,
        viscosities: vec![viscosity],
        drag: Some(viscosity),
    };
    let words = model.flaws().into_iter().map(|flaw| match flaw {
        Flaw::Independent(symbol) => model.graph.name(symbol).to_owned(),
        Flaw::NoHeatCapacity => "linear".to_owned(),
        Flaw::NegativeHeatCapacity => "negative".to_owned(),
        Flaw::NoViscosity(dashpot) => format!("viscosity {dashpot}"),
        Flaw::NoDrag => "drag".to_owned(),
    });
    words.collect()
}

/// A free energy with nothing wrong in it.
const SOUND: &str = "k*(lambda - gamma)^2 - c*theta*ln(theta)";

#[test]
fn published_models_have_no_flaws() {
    let empty: [&str; 0] = [];
    assert_eq!(flaws(SOUND, "eta"), empty);
    let elastic = "(k - k1*(theta - r))*ln(lambda/l)^2/2 - b*(theta - r)*ln(lambda/l) \
        + c*(theta - r - theta*ln(theta/r))";
    let viscous = "(m - m1*(theta - r))*gamma^2 - q*gamma*lambda*theta";
    let psi = format!("{elastic} + {viscous}");
    assert_eq!(flaws(&psi, "eta*exp(a*(1/theta - 1/r))"), empty);
}

#[test]
fn what_cancels_is_no_dependence() {
    assert_eq!(flaws("k", "eta"), ["lambda", "gamma", "theta"]);
    let psi = "gamma^2 - c*theta*ln(theta) + (lambda - lambda)*k + lambda/lambda";
    assert_eq!(flaws(psi, "eta"), ["lambda"]);
    assert_eq!(flaws("lambda*gamma + theta - theta", "eta"), ["theta"]);
}

#[test]
fn a_linear_temperature_has_no_heat_capacity() {
    // The difference of squares is linear only after its second derivative has cancelled.
    for psi in [
        "k*(lambda - gamma)^2 + a*theta",
        "k*(lambda - gamma)^2 - b*(theta - r)*ln(lambda)",
        "theta*k*(lambda - gamma)^2 + (theta + a)^2 - (theta - a)^2",
        "theta*(lambda*gamma + exp(a))",
    ] {
        assert_eq!(flaws(psi, "eta"), ["linear"], "{psi}");
    }
}

#[test]
fn heat_capacities_of_the_wrong_sign_are_found() {
    for psi in [
        "lambda*gamma + 5*theta*ln(theta)",
        "lambda*gamma + 5*theta*ln(theta/r) + a^2*theta^2",
        "lambda*gamma + exp(a)*theta^3 + theta^-1",
        "lambda*gamma - theta^0.5",
    ] {
        // −θ^½ has ψ″ = θ^(−3/2)/4 > 0, hence c < 0.
        assert_eq!(flaws(psi, "eta"), ["negative"], "{psi}");
    }
    // The sign of a parameter is not known.
    assert!(flaws("lambda*gamma + c*theta*ln(theta)", "eta").is_empty());
    assert!(flaws("lambda*gamma + theta^2 - theta^3", "eta").is_empty());
}

#[test]
fn viscosities_that_are_nowhere_positive_are_found() {
    for law in [
        "0",
        "-1",
        "-a^2",
        "-exp(a/theta)",
        "a - a",
        "-theta*b^2 - 1",
    ] {
        assert_eq!(flaws(SOUND, law), ["viscosity 0", "drag"], "{law}");
    }
    for law in [
        "a",
        "-a",
        "1 - a^2",
        "a^2",
        "-a^3",
        "ln(theta)",
        "exp(-theta)",
    ] {
        assert!(flaws(SOUND, law).is_empty(), "{law}");
    }
}

/// Rounding keeps the sign of sums and products of known sign, so that no tolerance is needed.
#[test]
fn a_sign_that_is_ruled_out_does_not_occur() {
    let mut decided = 0;
    for seed in 0..500 {
        let mut random = Random::new(seed);
        let mut graph = Graph::new();
        let symbol = graph.symbol("x");
        let x = graph.variable(symbol);
        let e = expression(&mut graph, &mut random, x, 5);
        let sign = sign(&graph, e, &[LowerBound::positive(symbol)]);
        for _ in 0..8 {
            let at = 0.1 + 3.0 * random.unit();
            let found = value(&F64, &mut graph, e, &[("x", at)]);
            assert!(
                sign.negative || found >= 0.0 || found.is_nan(),
                "seed {seed}: {found}"
            );
            assert!(
                sign.positive || found <= 0.0 || found.is_nan(),
                "seed {seed}: {found}"
            );
        }
        decided += usize::from(!sign.negative || !sign.positive);
    }
    // Otherwise the test says nothing.
    assert!(decided > 125, "{decided} of 500 signs are known");
}

/// Ends are rounded, and so are values.
const ROUNDING: f64 = 1e-12;

#[test]
fn values_are_in_their_range() {
    let mut decided = 0;
    for seed in 0..500 {
        let mut random = Random::new(seed);
        let mut graph = Graph::new();
        let symbol = graph.symbol("x");
        let x = graph.variable(symbol);
        let e = expression(&mut graph, &mut random, x, 5);
        let range = range(&graph, e, &[LowerBound::positive(symbol)], &[]);
        for _ in 0..8 {
            let at = 0.1 + 3.0 * random.unit();
            let found = value(&F64, &mut graph, e, &[("x", at)]);
            let room = ROUNDING * (1.0 + found.abs());
            let within = range.lower - room <= found && found <= range.upper + room;
            assert!(
                within || found.is_nan(),
                "seed {seed}: {found} is not in {range:?}"
            );
        }
        decided += usize::from(range.lower.is_finite() || range.upper.is_finite());
    }
    assert!(decided > 250, "{decided} of 500 ranges are bounded");
}

/// The lower bound of a formula of lambda, theta > 0, gamma and parameters.
fn lower(text: &str) -> f64 {
    let mut graph = Graph::new();
    let [lambda, gamma, theta] = ["lambda", "gamma", "theta"].map(|name| graph.symbol(name));
    let e = read(&mut graph, text);
    range(
        &graph,
        e,
        &[lambda, theta].map(LowerBound::positive),
        &[gamma],
    )
    .lower
}

#[test]
fn what_is_never_negative_is_known() {
    for text in [
        "lambda/l",
        "k*lambda^3/theta",
        "(1 - 2*nu)*lambda",
        "(a - b)*gamma^2",
        "lambda + gamma^2*exp(a - b)",
        "1 - exp(-lambda/l)",
        "2 + sin(gamma)",
        "1 - tanh(theta/r)",
        "cosh(gamma) - 1",
        "1 - 1/(1 + gamma^2)",
        "ln(1 + lambda/l)",
        "abs(lambda - l)",
        "sqrt(lambda - l)",
        "(lambda - l)^k",
        "-1/(-lambda)",
        "atan(lambda) + sin(2)",
    ] {
        assert!(lower(text) >= 0.0, "{text}: {}", lower(text));
    }
    for text in [
        "lambda - l",
        "lambda - (l - a)",
        "gamma",
        "gamma/lambda",
        "gamma^3",
        "1/gamma",
        "-k*lambda",
        "ln(lambda/l)",
        "1 - theta/r",
        "1 - exp(gamma)",
        "cos(lambda)",
        "lambda*sin(4)",
        "tan(theta)",
    ] {
        assert!(lower(text) < 0.0, "{text}: {}", lower(text));
    }
}

/// The sign of a formula of strains: e1 > −3/2, e2 ≥ 0, j > −1.
fn strained(text: &str) -> (Sign, f64) {
    let mut graph = Graph::new();
    let [e1, e2, j] = ["e1", "e2", "j"].map(|name| graph.symbol(name));
    let e = read(&mut graph, text);
    let bounds = [
        LowerBound::above(e1, Rational::new(-3, 2).expect("a fraction")),
        LowerBound::from(e2, Rational::ZERO),
        LowerBound::above(j, Rational::MINUS_ONE),
    ];
    let lower = range(&graph, e, &bounds, &[]).lower;
    (sign(&graph, e, &bounds), lower)
}

#[test]
fn strains_are_no_lengths() {
    for text in [
        "1 + j",
        "3 + 2*e1",
        "2 + j + e2",
        "1 + j + j^2",
        "(1 + j)*(3 + 2*e1)^3",
        "-1/(-1 - j)",
    ] {
        let (sign, lower) = strained(text);
        assert!(!sign.negative && !sign.zero, "{text}");
        assert!(lower >= 0.0, "{text}: {lower}");
    }
    let (sign, lower) = strained("e2");
    assert!(sign.zero && !sign.negative && lower >= 0.0);
    let (sign, _) = strained("-1 - j - e2");
    assert!(!sign.positive && !sign.zero && sign.negative);
    for text in [
        "j", "e1", "1/2 + j", "1 + e1", "1 - j", "e1 - j", "e2 - 1", "1 + e1*j",
    ] {
        let (sign, lower) = strained(text);
        assert!(sign.negative && sign.zero && sign.positive, "{text}");
        assert!(lower < 0.0, "{text}");
    }
}
