//! Derivatives: every function against a difference quotient in high precision, known results, and size.

use crate::oracle::{assert_agree, value};
use crate::reader::read;
use crate::support::precise::Precise;
use eem_symbolic::{Arithmetic, ExprId, Function, Graph, Kernel, diff, diff_total, format};

/// `∂text/∂x` is `expected`.
fn derivative_is(text: &str, expected: &str) {
    let mut graph = Graph::new();
    let (e, expected) = (read(&mut graph, text), read(&mut graph, expected));
    let x = graph.symbol("x");
    let slope = diff(&mut graph, e, x);
    assert_eq!(
        slope,
        expected,
        "{}, not {}",
        format(&graph, slope),
        format(&graph, expected)
    );
}

/// `∂e/∂x` at x = `at`, p = 0.7 against a central difference: error of the formula 2⁻³⁰⁰.
fn check(graph: &mut Graph, e: ExprId, name: &str, at: f64) {
    const OFFSET: i32 = -150;
    let precise = Precise::new();
    let x = graph.symbol(name);
    let slope = diff(graph, e, x);
    let mut evaluate = |e: ExprId, shift: f64| {
        let shift = precise.mul(&precise.from_f64(shift), &precise.two_to(OFFSET));
        let shifted = precise.add(&precise.from_f64(at), &shift);
        let rest = ["x", "a", "b", "p", "q"].map(|name| (name, precise.from_f64(0.3)));
        let point: Vec<_> = rest
            .into_iter()
            .enumerate()
            .map(|(i, (other, base))| {
                let spread = precise.from_f64(0.1 * [0.0, 1.0, 2.0, 3.0, 4.0][i]);
                (
                    other,
                    if other == name {
                        shifted.clone()
                    } else {
                        precise.add(&base, &spread)
                    },
                )
            })
            .collect();
        value(&precise, graph, e, &point)
    };
    let rise = precise.sub(&evaluate(e, 1.0), &evaluate(e, -1.0));
    let width = precise.two_to(OFFSET + 1);
    let quotient = precise.div(&rise, &width);
    assert_agree(
        &precise,
        &evaluate(slope, 0.0),
        &quotient,
        &format(graph, e),
    );
}

#[test]
fn every_function_has_the_right_derivative() {
    for &function in Function::ALL {
        for at in [0.001, 0.4, 0.93, -0.4, -0.93] {
            let logarithmic = matches!(function, Function::Ln | Function::Log2 | Function::Log10);
            if at < 0.0 && logarithmic {
                continue;
            }
            let mut graph = Graph::new();
            let x = read(&mut graph, "x");
            let e = graph.apply(function, x);
            check(&mut graph, e, "x", at);
        }
    }
}

#[test]
fn every_kind_of_node_has_the_right_derivative() {
    let formulas = [
        "x^p",
        "p^x",
        "x^x",
        "(x*p)^(x + p)",
        "sqrt(x)",
        "x^-3",
        "x^2.5",
        "x^(-1/3)",
    ];
    let composites = [
        "ln(x)*sin(x)*exp(-x)/x",
        "tanh(x^2 + p*x)/(1 + x)",
        "(x + 1)*(x + 2)*(x + p)",
    ];
    for text in formulas.into_iter().chain(composites) {
        let mut graph = Graph::new();
        let e = read(&mut graph, text);
        check(&mut graph, e, "x", 0.8);
        check(&mut graph, e, "p", 0.6);
    }
}

#[test]
fn divided_differences_have_the_right_derivatives() {
    let mut graph = Graph::new();
    let [a, b, p] = ["a", "b", "p"].map(|name| read(&mut graph, name));
    let mut kernels = vec![
        Kernel::Sqrt,
        Kernel::Recip,
        Kernel::Powi(3),
        Kernel::Powi(-2),
        Kernel::Powf(p),
    ];
    kernels.extend(
        Function::ALL
            .iter()
            .map(|&function| Kernel::Function(function)),
    );
    let scaled = graph.mul(a, p);
    for kernel in kernels {
        for (first, second) in [(a, b), (scaled, b)] {
            let e = graph.kernel_difference(kernel, first, second);
            for name in ["a", "b", "p"] {
                check(&mut graph, e, name, 0.8);
            }
        }
    }
}

#[test]
fn the_difference_of_a_general_power_has_the_right_derivatives() {
    let mut graph = Graph::new();
    let [value_a, value_b, x_a, x_b] =
        ["exp(a*p)", "exp(b*q)", "a*p", "b*q"].map(|text| read(&mut graph, text));
    let e = graph.power_difference([value_a, value_b], [x_a, x_b]);
    for name in ["a", "b", "p", "q"] {
        check(&mut graph, e, name, 0.8);
    }
}

#[test]
fn known_derivatives_are_in_canonical_form() {
    derivative_is("c", "0");
    derivative_is("x", "1");
    derivative_is("c*x^3", "3*c*x^2");
    derivative_is("x*ln(x)", "ln(x) + 1");
    derivative_is("ln(x/r)", "1/x");
    derivative_is("r*ln(x/r)", "r/x");
    derivative_is("sqrt(x)", "0.5/sqrt(x)");
    derivative_is("x^p", "p*x^(p - 1)");
    derivative_is("p^x", "p^x*ln(p)");
    derivative_is("k*ln(x/r)^2/2", "k*ln(x/r)/x");
    derivative_is("log10(x)", "1/(x*ln(10))");
}

#[test]
fn symbols_can_depend_on_the_variable() {
    let mut graph = Graph::new();
    let (x, y) = (graph.symbol("x"), graph.symbol("y"));
    let e = read(&mut graph, "x*y^2");
    let slope_of_y = read(&mut graph, "z");
    let total = diff_total(&mut graph, e, x, &[(y, slope_of_y)]);
    assert_eq!(total, read(&mut graph, "y^2 + 2*x*y*z"));
    let partial = diff(&mut graph, e, x);
    assert_eq!(partial, read(&mut graph, "y^2"));
}

#[test]
fn third_divided_differences_are_refused() {
    let mut graph = Graph::new();
    let [a, b] = ["a", "b"].map(|name| read(&mut graph, name));
    let kernel = Kernel::Function(Function::Ln);
    let second = graph.second_kernel_difference(kernel, a, b);
    let (a, c) = (graph.symbol("a"), graph.symbol("c"));
    let refused = diff(&mut graph, second, a);
    assert!(
        graph
            .as_number(refused)
            .is_some_and(|number| number.to_f64().is_nan())
    );
    let constant = diff(&mut graph, second, c);
    assert_eq!(graph.as_number(constant), Some(0.0.into()));
}

/// x ↦ x² + x, nested: the text doubles with every level, the graph grows by two nodes.
fn nested(graph: &mut Graph, levels: usize) -> ExprId {
    let mut e = read(graph, "x");
    for _ in 0..levels {
        let square = graph.mul(e, e);
        e = graph.add(square, e);
    }
    e
}

#[test]
fn shared_subexpressions_are_differentiated_once() {
    let mut graph = Graph::new();
    let mut e = nested(&mut graph, 200);
    let x = graph.symbol("x");
    for order in 1..=10 {
        e = diff(&mut graph, e, x);
        // Level k of the n-th derivative needs the n/2 products of Leibniz' rule and a sum.
        assert!(
            graph.size(e) <= 200 * (order + 3) * (order + 3),
            "{order}: {}",
            graph.size(e)
        );
    }
}

#[test]
fn deep_expressions_are_differentiated_without_recursion() {
    let mut graph = Graph::new();
    let mut e = read(&mut graph, "x");
    for _ in 0..1000 {
        let inner = graph.apply(Function::Tanh, e);
        e = graph.add(inner, inner);
    }
    let x = graph.symbol("x");
    let slope = diff(&mut graph, e, x);
    assert!(graph.size(slope) < 20 * 1000);
}

#[test]
fn wide_products_and_sums_are_differentiated() {
    let mut graph = Graph::new();
    let x = read(&mut graph, "x");
    let shifted: Vec<_> = (1..=300)
        .map(|i| {
            let number = graph.integer(i);
            graph.add(x, number)
        })
        .collect();
    let product = graph.product(&shifted);
    let x = graph.symbol("x");
    let slope = diff(&mut graph, product, x);
    assert!(graph.size(slope) < 1000);
}
