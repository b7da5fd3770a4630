//! Values of expressions, on any arithmetic.

#![allow(dead_code)] // Every test file is a crate of its own and uses a part.

use astro_float::BigFloat;
use eem_symbolic::{Arithmetic, ExprId, Graph, Input, Stage, schedule};

use crate::support::precise::{Precise, to_f64};

/// The value of an expression at given values of its symbols.
pub fn value<A: Arithmetic>(
    arithmetic: &A,
    graph: &mut Graph,
    e: ExprId,
    at: &[(&str, A::Number)],
) -> A::Number {
    let input = |name: &str, graph: &mut Graph| Input {
        symbol: graph.symbol(name),
        name: name.to_owned(),
        stage: Stage::New,
    };
    let inputs = at.iter().map(|(name, _)| input(name, graph)).collect();
    let values: Vec<_> = at.iter().map(|(_, value)| value.clone()).collect();
    schedule(graph, inputs, &[e])
        .interpret(arithmetic, &values)
        .swap_remove(0)
}

/// Whether two values agree to 60 digits of the larger one.
pub fn assert_agree(precise: &Precise, computed: &BigFloat, exact: &BigFloat, what: &str) {
    const DIGITS: f64 = 1e-60;
    let difference = to_f64(&precise.sub(computed, exact)).abs();
    let scale = to_f64(computed).abs().max(to_f64(exact).abs());
    assert!(
        difference <= DIGITS * scale,
        "{what}: {} and {}",
        to_f64(computed),
        to_f64(exact)
    );
}
