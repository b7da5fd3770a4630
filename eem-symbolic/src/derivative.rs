//! The derivatives of the elementary functions, one rule for every function.

use crate::function::Function;
use crate::graph::Graph;
use crate::node::ExprId;
use crate::number::{Number, Rational};

impl Function {
    /// `f′(x)`, in a form that keeps its relative accuracy wherever `f′` is well conditioned.
    pub(crate) fn derivative(self, graph: &mut Graph, x: ExprId) -> ExprId {
        match self {
            Function::Exp | Function::ExpM1 => graph.apply(Function::Exp, x),
            Function::Ln => graph.recip(x),
            Function::Ln1p => {
                let shifted = one_plus(graph, x);
                graph.recip(shifted)
            }
            Function::Log2 => logarithm_derivative(graph, x, 2),
            Function::Log10 => logarithm_derivative(graph, x, 10),
            Function::Sin => graph.apply(Function::Cos, x),
            Function::Cos => {
                let sine = graph.apply(Function::Sin, x);
                graph.neg(sine)
            }
            Function::Tan => {
                let tangent = graph.apply(Function::Tan, x);
                let square = graph.powi(tangent, 2);
                one_plus(graph, square)
            }
            Function::Sinh => graph.apply(Function::Cosh, x),
            Function::Cosh => graph.apply(Function::Sinh, x),
            // 1 − tanh² cancels for large arguments, 1/cosh² does not.
            Function::Tanh => {
                let cosine = graph.apply(Function::Cosh, x);
                graph.powi(cosine, -2)
            }
            Function::Asinh => {
                let square = graph.powi(x, 2);
                let radicand = one_plus(graph, square);
                let root = graph.sqrt(radicand);
                graph.recip(root)
            }
            Function::Atan => {
                let square = graph.powi(x, 2);
                let denominator = one_plus(graph, square);
                graph.recip(denominator)
            }
            Function::Atanh => atanh_derivative(graph, x),
            Function::Cbrt => {
                let root = graph.apply(Function::Cbrt, x);
                let power = graph.powi(root, -2);
                graph.scale(Number::ONE / Number::from(3_i64), power)
            }
            Function::Abs => {
                let magnitude = graph.apply(Function::Abs, x);
                graph.div(x, magnitude)
            }
        }
    }
}

/// `1 + x`.
fn one_plus(graph: &mut Graph, x: ExprId) -> ExprId {
    graph.weighted_sum(Number::ONE, &[(Number::ONE, x)])
}

/// `1/(x ln base)`; the logarithm stays symbolic, so that no digits of it are lost.
fn logarithm_derivative(graph: &mut Graph, x: ExprId, base: i64) -> ExprId {
    let base = graph.integer(base);
    let scale = graph.apply(Function::Ln, base);
    graph.power_product(&[(x, Rational::MINUS_ONE), (scale, Rational::MINUS_ONE)])
}

/// `1/((1 − x)(1 + x))`; the expanded form `1 − x²` loses digits next to ±1.
fn atanh_derivative(graph: &mut Graph, x: ExprId) -> ExprId {
    let above = one_plus(graph, x);
    let below = graph.weighted_sum(Number::ONE, &[(Number::MINUS_ONE, x)]);
    graph.power_product(&[(above, Rational::MINUS_ONE), (below, Rational::MINUS_ONE)])
}
