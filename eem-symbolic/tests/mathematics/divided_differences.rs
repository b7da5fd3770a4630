//! Divided differences: the rules against plain quotients in high precision, and their limits.

use crate::oracle::{SymmetricKernels, assert_agree, value};
use crate::reader::read;
use crate::support::precise::Precise;
use crate::support::random::{self, Random};
use eem_symbolic::{
    Arithmetic, ExprId, F64, Function, Graph, Kernel, Node, diff, divided_difference, format,
    substitute,
};
use eem_testkit::precise::BigFloat;

/// Formulas that use every rule at least once; x, p > 0.
const FORMULAS: &[&str] = &[
    "p",
    "x",
    "3*x - p",
    "p*x^2/7",
    "x*ln(x)",
    "sin(x)*exp(x)*ln(x)*sqrt(x)*tanh(x)",
    "(1 + x)/(2 + x^2)",
    "p/(x*(x + p))",
    "ln(x/p)^2",
    "x^3 - x^5 + x^-2",
    "sqrt(x) + x^-0.5 + x^1.5",
    "x^(1/3)",
    "x^p",
    "p^x",
    "x^x",
    "(1 + x*p)^(sin(x)/p)",
    "exp(p*(1/x - 1/p))",
    "0.5*p*(x - 1)^2 - p*(x - 1)*ln(x)",
];

/// A formula of x between the versions a and b of x.
struct Secant {
    graph: Graph,
    e: ExprId,
    slope: ExprId,
}

impl Secant {
    fn new(build: impl FnOnce(&mut Graph) -> ExprId) -> Self {
        let mut graph = Graph::new();
        let x = graph.symbol("x");
        let ends = ["a", "b"].map(|name| graph.version(x, name));
        let [a, b] = ends.map(|end| graph.variable(end));
        let e = build(&mut graph);
        let slope = divided_difference(&mut graph, e, x, a, b);
        Secant { graph, e, slope }
    }

    fn slope<A: Arithmetic>(&mut self, arithmetic: &A, [a, b, p]: [A::Number; 3]) -> A::Number {
        value(
            arithmetic,
            &mut self.graph,
            self.slope,
            &[("a", a), ("b", b), ("p", p)],
        )
    }

    /// `(e(b) − e(a))/(b − a)`.
    fn quotient(&mut self, precise: &Precise, [a, b, p]: [BigFloat; 3]) -> BigFloat {
        let mut at = |x: &BigFloat| {
            let point = [("x", x.clone()), ("p", p.clone())];
            value(precise, &mut self.graph, self.e, &point)
        };
        let rise = precise.sub(&at(&b), &at(&a));
        precise.div(&rise, &precise.sub(&b, &a))
    }

    fn check(&mut self, a: f64, b: f64, p: f64) {
        let precise = Precise::new();
        let ends = [a, b, p].map(|x| precise.from_f64(x));
        let computed = self.slope(&precise, ends.clone());
        let exact = self.quotient(&precise, ends);
        let text = format(&self.graph, self.e);
        assert_agree(
            &precise,
            &computed,
            &exact,
            &format!("{text} between {a} and {b}"),
        );
    }
}

#[test]
fn every_rule_gives_the_plain_quotient() {
    for text in FORMULAS {
        let mut secant = Secant::new(|graph| read(graph, text));
        for (a, b) in [(0.7, 1.3), (1.3, 0.7), (2.0, 2.000_000_1), (0.01, 40.0)] {
            secant.check(a, b, 1.7);
        }
    }
}

#[test]
fn every_function_gives_the_plain_quotient() {
    for &function in Function::ALL {
        let mut secant = Secant::new(|graph| {
            let inner = read(graph, "0.9*tanh(x)");
            graph.apply(function, inner)
        });
        for (a, b) in [(0.7, 1.3), (0.2, 0.201)] {
            secant.check(a, b, 1.0);
        }
    }
}

#[test]
fn random_expressions_give_the_plain_quotient() {
    let mut random = Random::new(2);
    for _ in 0..200 {
        let mut secant = Secant::new(|graph| {
            let x = read(graph, "x");
            random::expression(graph, &mut random, x, 5)
        });
        let (a, b) = (0.5 + random.unit(), 0.5 + random.unit());
        secant.check(a, b, 1.0);
    }
}

#[test]
fn equal_ends_give_the_derivative() {
    for text in FORMULAS {
        let mut secant = Secant::new(|graph| read(graph, text));
        let precise = Precise::new();
        let (end, p) = (precise.from_f64(0.8), precise.from_f64(1.7));
        let computed = secant.slope(&precise, [end.clone(), end.clone(), p.clone()]);
        let x = secant.graph.symbol("x");
        let derivative = diff(&mut secant.graph, secant.e, x);
        let exact = value(
            &precise,
            &mut secant.graph,
            derivative,
            &[("x", end), ("p", p)],
        );
        assert_agree(&precise, &computed, &exact, text);
    }
}

#[test]
fn one_end_put_in_for_the_other_gives_the_derivative_of_a_function() {
    let mut graph = Graph::new();
    for &function in Function::ALL {
        let [x, a, b] = ["x", "a", "b"].map(|name| read(&mut graph, name));
        let secant = graph.kernel_difference(Kernel::Function(function), a, b);
        let ends = ["a", "b"].map(|name| graph.symbol(name));
        let limit = substitute(&mut graph, secant, &ends.map(|end| (end, x)));
        let e = graph.apply(function, x);
        let symbol = graph.symbol("x");
        // |x|[a, b] is no node, and (x + x)/(|x| + |x|) = x/|x| all the same.
        assert_eq!(limit, diff(&mut graph, e, symbol), "{}", function.name());
    }
}

#[test]
fn exchanged_ends_give_the_same_bits() {
    let mut random = Random::new(3);
    for round in 0..300 {
        let mut secant = Secant::new(|graph| {
            let x = read(graph, "x");
            let e = random::expression(graph, &mut random, x, 5);
            FORMULAS.get(round).map_or(e, |text| read(graph, text))
        });
        let (a, b) = (0.5 + random.unit(), 0.5 + random.unit());
        let forth = secant.slope(&SymmetricKernels, [a, b, 1.7]);
        let back = secant.slope(&SymmetricKernels, [b, a, 1.7]);
        assert_eq!(
            forth.to_bits(),
            back.to_bits(),
            "{}",
            format(&secant.graph, secant.e)
        );
    }
}

#[test]
fn affine_expressions_have_exact_differences() {
    for (text, slope) in [
        ("3*x - p", "3"),
        ("p*(x - 1)/q", "p/q"),
        ("(p + q)*(q - x)", "-(p + q)"),
    ] {
        let mut secant = Secant::new(|graph| read(graph, text));
        assert_eq!(secant.slope, read(&mut secant.graph, slope), "{text}");
    }
}

#[test]
fn constant_expressions_have_none() {
    let mut secant = Secant::new(|graph| read(graph, "p*ln(q)"));
    assert_eq!(secant.slope, read(&mut secant.graph, "0"));
}

#[test]
fn the_square_is_a_sum_and_no_kernel() {
    let secant = Secant::new(|graph| read(graph, "x^2"));
    assert!(matches!(secant.graph.node(secant.slope), Node::PairSum(..)));
    assert_eq!(format(&secant.graph, secant.slope), "a + b");
}

#[test]
fn no_rule_divides_by_the_increment() {
    let mut random = Random::new(4);
    for _ in 0..100 {
        let mut secant = Secant::new(|graph| {
            let x = read(graph, "x");
            random::expression(graph, &mut random, x, 5)
        });
        let at = 0.5 + random.unit();
        assert!(
            secant.slope(&F64, [at, at, 1.7]).is_finite(),
            "{}",
            format(&secant.graph, secant.e)
        );
    }
}

#[test]
fn differences_of_differences_are_refused() {
    let mut graph = Graph::new();
    let (x, y) = (graph.symbol("x"), graph.symbol("y"));
    let [at_x, at_y, c] = ["x", "y", "c"].map(|name| read(&mut graph, name));
    let kernel = Kernel::Function(Function::Ln);
    let first = graph.kernel_difference(kernel, at_x, c);
    let scaled = graph.mul(first, at_y);
    let refused = divided_difference(&mut graph, scaled, x, at_y, c);
    assert!(
        graph
            .as_number(refused)
            .is_none_or(|number| number.to_f64().is_nan())
    );
    assert!(format(&graph, refused).contains("NaN"));
    let other = divided_difference(&mut graph, scaled, y, at_x, c);
    assert_eq!(other, first);
}

#[test]
fn shared_and_wide_expressions_stay_small() {
    let mut secant = Secant::new(|graph| {
        let mut e = read(graph, "x");
        for _ in 0..200 {
            let square = graph.mul(e, e);
            e = graph.add(square, e);
        }
        e
    });
    assert!(secant.graph.size(secant.slope) < 10 * 200);
    secant = Secant::new(|graph| {
        let factors: Vec<_> = (0..256)
            .map(|i| read(graph, &format!("(x + {i})")))
            .collect();
        graph.product(&factors)
    });
    assert!(secant.graph.size(secant.slope) < 10 * 256);
}
