//! Formulas as text: minimal parentheses, and nothing lost.

use crate::reader::read;
use crate::support::random::{self, Random};
use eem_symbolic::{Graph, Kernel, format};

/// The formula is printed as `expected`.
fn shows(text: &str, expected: &str) {
    let mut graph = Graph::new();
    // Symbols in alphabetical order, so that the order of the text below is alphabetical, too.
    for name in ["a", "b", "c", "k", "theta", "theta_r", "x", "y"] {
        graph.symbol(name);
    }
    let e = read(&mut graph, text);
    assert_eq!(format(&graph, e), expected);
}

#[test]
fn sums_have_their_signs() {
    shows("a + b - c", "a + b - c");
    shows("-a", "-a");
    shows("b - a", "b - a");
    shows("-a - b", "-a - b");
    shows("1 - x", "1 - x");
    shows("x + 1", "x + 1");
    shows("-x - 1", "-x - 1");
    shows("a - 2*b*c", "a - 2*b*c");
    shows("0.5*(a + b) + c", "c + 0.5*(a + b)");
}

#[test]
fn products_have_one_fraction_bar() {
    shows("a*b/c", "a*b/c");
    shows("a/(b*c)", "a/(b*c)");
    shows("1/a", "1/a");
    shows("-1/a", "-1/a");
    shows("a/b/c*k", "a*k/(b*c)");
    shows("(a + b)*c", "c*(a + b)");
    shows("a/(b + c)", "a/(b + c)");
    shows("a/3", "a/3");
    shows("2*a/3", "2*a/3");
    shows("a/(3*b)", "a/(3*b)");
    shows("a/2", "0.5*a");
    shows("1.5e-3*a", "0.0015*a");
}

#[test]
fn powers_have_parentheses_where_needed() {
    shows("x^2", "x^2");
    shows("x^-2", "1/x^2");
    shows("(a + b)^2", "(a + b)^2");
    shows("sqrt(a + b)", "sqrt(a + b)");
    shows("a/sqrt(x)", "a/sqrt(x)");
    shows("x^1.5", "x^1.5");
    shows("x^(1/3)", "x^(1/3)");
    shows("x^(a + b)", "x^(a + b)");
    shows("x^a", "x^a");
    shows("(x^a)^b", "(x^a)^b");
    shows("x^(y^a)", "x^(y^a)");
    shows("sqrt(x^3)", "sqrt(x^3)");
    shows("(-2)^x", "(-2)^x");
    shows("x^(-a)", "x^(-a)");
    shows("ln(x)^2", "ln(x)^2");
}

#[test]
fn a_free_energy_reads_as_written() {
    let psi = "k*ln(x/a)^2/2 - b*(theta - theta_r)*ln(x/a)";
    shows(psi, "0.5*k*ln(x/a)^2 - b*(theta - theta_r)*ln(x/a)");
    let caloric = "c*(theta - theta_r - theta*ln(theta/theta_r))";
    shows(caloric, "c*(theta - theta_r - theta*ln(theta/theta_r))");
}

#[test]
fn divided_differences_show_their_arguments() {
    let mut graph = Graph::new();
    let [a, b, p] = ["a", "b", "p"].map(|name| read(&mut graph, name));
    let shown = [
        (
            Kernel::Function(eem_symbolic::Function::Ln1p),
            "ln_1p[a, b]",
            "ln_1p[a, b, b]",
        ),
        (Kernel::Sqrt, "sqrt[a, b]", "sqrt[a, b, b]"),
        (Kernel::Recip, "recip[a, b]", "recip[a, b, b]"),
        (Kernel::Powi(3), "pow3[a, b]", "pow3[a, b, b]"),
        (Kernel::Powi(-2), "pow(-2)[a, b]", "pow(-2)[a, b, b]"),
        (Kernel::Powf(p), "pow(p)[a, b]", "pow(p)[a, b, b]"),
    ];
    for (kernel, first, second) in shown {
        let difference = graph.kernel_difference(kernel, a, b);
        assert_eq!(format(&graph, difference), first);
        let difference = graph.second_kernel_difference(kernel, a, b);
        assert_eq!(format(&graph, difference), second);
    }
}

#[test]
fn text_is_read_back_as_the_same_text() {
    let mut random = Random::new(5);
    for depth in (1..=5).cycle().take(500) {
        let mut graph = Graph::new();
        let x = read(&mut graph, "x");
        let e = random::expression(&mut graph, &mut random, x, depth);
        let text = format(&graph, e);
        if !text.contains("where") {
            // Not the same expression: a number that did not fit into a rational is now a decimal.
            let again = read(&mut graph, &text);
            assert_eq!(format(&graph, again), text);
        }
    }
}

#[test]
fn laws_are_read_back() {
    for mut law in crate::support::all_laws() {
        let text = format(&law.model.graph, law.model.psi);
        assert_eq!(read(&mut law.model.graph, &text), law.model.psi, "{text}");
    }
}

#[test]
fn the_text_grows_with_the_graph_and_not_with_the_tree() {
    let mut graph = Graph::new();
    let mut e = read(&mut graph, "x");
    for _ in 0..200 {
        let square = graph.mul(e, e);
        let sine = graph.apply(eem_symbolic::Function::Sin, e);
        let sum = graph.add(square, sine);
        e = graph.apply(eem_symbolic::Function::Tanh, sum);
    }
    let text = format(&graph, e);
    assert!(text.contains("\nwhere\nt1 = "), "{text}");
    assert!(text.len() < 200 * 40, "{}", text.len());
}
