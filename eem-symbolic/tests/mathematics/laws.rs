//! The canonical form: which expressions are one, which are not, and that building them is cheap.

use crate::reader::{different, read, same};
use eem_symbolic::{Function, Graph, Node, Number, Rational, substitute};

#[test]
fn opposite_terms_vanish() {
    same("1 - 1", "0");
    same("x - x", "0");
    same("x + y - (y + x)", "0");
    same("2*(x + y) - 2*(x + y)", "0");
}

#[test]
fn a_quantity_cancels_its_inverse() {
    same("theta*theta^-1", "1");
    same("theta/theta", "1");
    same("c*theta*(1/theta)", "c");
    same("(x + y)/(y + x)", "1");
    same("theta*(1/(theta/r))", "r");
}

#[test]
fn coefficients_are_collected() {
    same("x + x", "2*x");
    same("3*x - 2*x", "x");
    same("0.1*x + 0.2*x", "0.3*x");
    same("x/3 + x/3 + x/3", "x");
    same("0*x", "0");
    same("2*(3*x)", "6*x");
}

#[test]
fn exponents_are_collected() {
    same("x*x", "x^2");
    same("x^2*x^-3", "1/x");
    same("sqrt(x)*sqrt(x)", "x");
    same("x^(1/3)*x^(2/3)", "x");
    same("sqrt(2*x)*sqrt(2*x)", "2*x");
    same("x^0", "1");
}

#[test]
fn sums_and_products_commute_and_associate() {
    same("x + (y + z)", "(z + x) + y");
    same("x - (y - z)", "x + z - y");
    same("x*(y*z)", "(z*x)*y");
    same("x/(y/z)", "x*z/y");
}

#[test]
fn integer_powers_distribute_over_products() {
    same("(x*y)^2", "x^2*y^2");
    same("(x^(1/2))^2", "x");
    same("(2*x)^-1", "0.5/x");
    same("(-x)^3", "-x^3");
}

#[test]
fn powers_that_would_change_the_domain_stay() {
    different("sqrt(x^2)", "x");
    different("sqrt(x*y)", "sqrt(x)*sqrt(y)");
    different("(x^p)^q", "x^(p*q)");
    different("exp(ln(x))", "x");
}

#[test]
fn products_are_not_distributed() {
    different("c*(x - y)", "c*x - c*y");
    different("0.3*(x - y)", "0.3*x - 0.3*y");
    different("0.3*(x - y) + z", "0.3*x - 0.3*y + z");
    same("-(x - y)", "y - x");
}

#[test]
fn exact_values_of_functions_are_folded() {
    for zero in [
        "ln(1)",
        "log2(1)",
        "log10(1)",
        "exp_m1(0)",
        "ln_1p(0)",
        "sin(0)",
        "tan(0)",
    ] {
        same(zero, "0");
    }
    for zero in [
        "sinh(0)", "tanh(0)", "asinh(0)", "atan(0)", "atanh(0)", "cbrt(0)", "abs(0)",
    ] {
        same(zero, "0");
    }
    for one in [
        "exp(0)", "cos(0)", "cosh(0)", "cbrt(1)", "abs(-1)", "1^p", "sqrt(1)",
    ] {
        same(one, "1");
    }
    same("sqrt(4)", "2");
    same("sqrt(2)*sqrt(2)", "2");
}

#[test]
fn other_constants_stay_symbolic() {
    different("ln(2)", "0.6931471805599453");
    different("sqrt(2)", "1.4142135623730951");
    different("1/0", "0");
    different("0/0", "1");
}

#[test]
fn division_by_zero_is_left_to_the_evaluation() {
    let mut graph = Graph::new();
    let inverse = read(&mut graph, "1/0");
    assert!(matches!(graph.node(inverse), Node::Product(_)));
}

#[test]
fn numbers_that_do_not_fit_become_floats() {
    let large = Number::parse_decimal("1e38").unwrap();
    assert!(large.exact().is_some());
    assert_eq!(large * large, Number::Float(1e38 * 1e38));
    assert_eq!(Number::parse_decimal("1e300"), Some(Number::Float(1e300)));
    assert_eq!(Number::parse_decimal("infinity"), None);
    assert_eq!(Number::parse_decimal("theta"), None);
    assert_eq!(Number::from(2.0), Number::from(2_i64));
}

#[test]
fn coefficients_neither_vanish_nor_overflow() {
    different("1e-200*x*(1e-200*y)", "0");
    different("1e-200*(1e-200*x)", "0");
    same("1e-200*x*(1e-200*y)*1e300", "1e-200*(1e-200*x*y)*1e300");
    same(
        "1e-200*x*(1e-200*y*(1e-200*z))",
        "1e-200*(1e-200*(1e-200*x*y*z))",
    );
    different("1e-200*x*(1e-200*y*(1e-200*z))", "1e-200*x*(1e-200*y*z)");
    different("1e-200^2*x", "0");
    different("1e200*x*(1e200*y)", "1e200*x*(1e201*y)");
}

#[test]
fn rationals_convert_to_the_nearest_float() {
    let literals = [
        "0.1",
        "1.5e-3",
        "9007199254740993",
        "0.3333333333333333333",
        "1e-30",
    ];
    for text in literals
        .into_iter()
        .chain(["8.314462618", "123456789.123456789e10", "-7e22"])
    {
        let exact = Rational::parse_decimal(text).unwrap();
        assert_eq!(
            Ok(exact.to_f64().to_bits()),
            text.parse::<f64>().map(f64::to_bits),
            "{text}"
        );
    }
    assert_eq!(
        Rational::new(1, 3).unwrap().to_f64().to_bits(),
        (1.0_f64 / 3.0).to_bits()
    );
}

#[test]
fn rationals_are_ordered_by_value() {
    let rational = |n, d| Rational::new(n, d).unwrap();
    assert!(rational(1, 3) < rational(1, 2));
    assert!(rational(-1, 2) < rational(-1, 3));
    assert!(rational(i128::MAX - 1, i128::MAX) < Rational::ONE);
    assert!(rational(7, 2) > rational(3, 1));
    assert_eq!(rational(2, -4), rational(-1, 2));
    assert_eq!(Rational::new(1, 0), None);
}

#[test]
fn the_order_of_operands_ignores_the_version() {
    let mut graph = Graph::new();
    let e = read(
        &mut graph,
        "a*ln(x/y) - sin(y*x)/x + x^2*y - b*exp(x)*x + sqrt(x + y)*cos(x)",
    );
    let x = graph.symbol("x");
    let images: Vec<_> = ["x_old", "x_new"]
        .map(|name| {
            let version = graph.version(x, name);
            let version = graph.variable(version);
            substitute(&mut graph, e, &[(x, version)])
        })
        .to_vec();
    let [old, new] = [0, 1].map(|i| eem_symbolic::format(&graph, images[i]));
    assert_eq!(old.replace("x_old", "x_new"), new);
    assert_eq!(
        eem_symbolic::format(&graph, e)
            .replace('x', "x_new")
            .replace("ex_newp", "exp"),
        new
    );
}

#[test]
fn substitution_is_simultaneous_and_canonical() {
    let mut graph = Graph::new();
    let (x, y) = (graph.symbol("x"), graph.symbol("y"));
    let e = read(&mut graph, "x/y + ln(y)*z");
    let (of_x, of_y) = (read(&mut graph, "y"), read(&mut graph, "1"));
    let image = substitute(&mut graph, e, &[(x, of_x), (y, of_y)]);
    assert_eq!(image, of_x);
}

#[test]
fn a_pair_sum_is_not_flattened() {
    let mut graph = Graph::new();
    let [a, b, c] = ["a", "b", "c"].map(|name| read(&mut graph, name));
    let pair = graph.pair_sum(b, a);
    assert_eq!(pair, graph.pair_sum(a, b));
    let sum = graph.add(pair, c);
    let Node::Sum { terms, .. } = graph.node(sum) else {
        panic!("a sum")
    };
    assert_eq!(terms.len(), 2);
    assert_eq!(graph.pair_sum(a, a), read(&mut graph, "2*a"));
}

#[test]
fn every_function_is_found_by_its_name() {
    for &function in Function::ALL {
        assert_eq!(Function::from_name(function.name()), Some(function));
    }
    assert_eq!(Function::from_name("log"), None);
}

#[test]
fn dependence_is_known_for_every_node() {
    let mut graph = Graph::new();
    let e = read(&mut graph, "a*ln(x) + exp(y)");
    let symbols = ["a", "x", "y", "z"].map(|name| graph.symbol(name));
    assert_eq!(
        symbols.map(|symbol| graph.depends_on(e, symbol)),
        [true, true, true, false]
    );
    assert_eq!(graph.size(e), 7);
}

#[test]
fn deep_expressions_need_no_stack() {
    let mut graph = Graph::new();
    let x = graph.symbol("x");
    let at = graph.variable(x);
    let mut e = at;
    for _ in 0..20_000 {
        let inner = graph.apply(Function::Tanh, e);
        e = graph.mul(inner, at);
    }
    let y = read(&mut graph, "y");
    let image = substitute(&mut graph, e, &[(x, y)]);
    assert_eq!(graph.size(image), 40_001);
}
