//! The same law gives the same programs, byte for byte.

use crate::support::laws;
use eem_symbolic::{ExprId, Function, Graph, Model, Number};

#[test]
fn two_builds_are_equal() {
    for (first, second) in crate::support::all_laws()
        .into_iter()
        .zip(crate::support::all_laws())
    {
        let [first, second] = [first, second].map(|law| {
            let programs = format!("{:?}", law.model.programs());
            (programs, format!("{:?}", law.model.formulas()))
        });
        assert_eq!(first, second);
    }
}

#[test]
fn a_model_is_not_changed_by_its_programs() {
    let law = laws::pendulum();
    let first = format!("{:?}", law.model.programs());
    assert_eq!(first, format!("{:?}", law.model.programs()));
}

/// ψ = k/2 ln²(λ/λ0) − β θ ln(λ/λ0) − c θ ln θ, sums and products in one order or the other.
fn spring(reversed: bool) -> Model {
    let mut graph = Graph::new();
    let names = ["lambda", "theta", "k", "beta", "c", "lambda0"];
    let symbols = names.map(|name| graph.symbol(name));
    let variables = symbols.map(|symbol| graph.variable(symbol));
    let [lambda, theta, k, beta, c, lambda0] = variables;
    let product = |graph: &mut Graph, factors: &[ExprId]| {
        let mut factors = factors.to_vec();
        if reversed {
            factors.reverse();
        }
        let one = graph.integer(1);
        factors
            .into_iter()
            .fold(one, |product, factor| graph.mul(product, factor))
    };
    let ratio = graph.div(lambda, lambda0);
    let strain = graph.apply(Function::Ln, ratio);
    let half = graph.number(Number::HALF);
    let elastic = product(&mut graph, &[half, k, strain, strain]);
    let coupling = product(&mut graph, &[beta, theta, strain]);
    let logarithm = graph.apply(Function::Ln, theta);
    let caloric = product(&mut graph, &[c, theta, logarithm]);
    let terms = [elastic, graph.neg(coupling), graph.neg(caloric)];
    let psi = if reversed {
        let tail = graph.add(terms[2], terms[1]);
        graph.add(tail, terms[0])
    } else {
        graph.sum(&terms)
    };
    Model {
        graph,
        measures: vec![symbols[0]],
        strains: vec![],
        dashpots: Vec::new(),
        temperature: Some(symbols[1]),
        parameters: symbols[2..].to_vec(),
        psi,
        viscosities: Vec::new(),
        drag: None,
    }
}

#[test]
fn the_order_of_writing_does_not_matter() {
    let [first, second] = [false, true].map(spring);
    assert_eq!(
        format!("{:?}", first.formulas()),
        format!("{:?}", second.formulas())
    );
    assert_eq!(
        format!("{:?}", first.programs()),
        format!("{:?}", second.programs())
    );
}
