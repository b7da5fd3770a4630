//! Values of expressions, on any arithmetic.

use eem_symbolic::{
    Arithmetic, ExprId, F64, Function, Graph, Input, Number, ProgramKernel, Stage, schedule,
};
use eem_testkit::precise::BigFloat;

use crate::support::precise::{Precise, to_f64};

/// The value of an expression at given values of its symbols.
pub(crate) fn value<A: Arithmetic>(
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
pub(crate) fn assert_agree(precise: &Precise, computed: &BigFloat, exact: &BigFloat, what: &str) {
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

/// Double precision with the ends of a difference in ascending order: symmetric, as kernels are.
pub(crate) struct SymmetricKernels;

impl Arithmetic for SymmetricKernels {
    type Number = f64;

    fn constant(&self, number: &Number) -> f64 {
        F64.constant(number)
    }
    fn add(&self, a: &f64, b: &f64) -> f64 {
        F64.add(a, b)
    }
    fn sub(&self, a: &f64, b: &f64) -> f64 {
        F64.sub(a, b)
    }
    fn mul(&self, a: &f64, b: &f64) -> f64 {
        F64.mul(a, b)
    }
    fn div(&self, a: &f64, b: &f64) -> f64 {
        F64.div(a, b)
    }
    fn neg(&self, a: &f64) -> f64 {
        F64.neg(a)
    }
    fn powi(&self, a: &f64, n: i32) -> f64 {
        F64.powi(a, n)
    }
    fn sqrt(&self, a: &f64) -> f64 {
        F64.sqrt(a)
    }
    fn power(&self, a: &f64, b: &f64) -> f64 {
        F64.power(a, b)
    }
    fn apply(&self, function: Function, a: &f64) -> f64 {
        F64.apply(function, a)
    }
    fn divided_difference(&self, kernel: ProgramKernel<&f64>, a: &f64, b: &f64) -> f64 {
        let kernel = match kernel {
            ProgramKernel::Power(value_a, value_b) if b < a => {
                ProgramKernel::Power(value_b, value_a)
            }
            kernel => kernel,
        };
        F64.divided_difference(kernel, &a.min(*b), &a.max(*b))
    }
    fn second_divided_difference(&self, kernel: ProgramKernel<&f64>, a: &f64, b: &f64) -> f64 {
        F64.second_divided_difference(kernel, a, b)
    }
}
