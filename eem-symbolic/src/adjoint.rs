//! The reverse sweep over a program: the derivatives of one weighted sum of outputs with respect to many inputs.

use crate::program::{Input, Program};
use crate::sweep::Sweep;

/// `[Σ_i w_i ∂y_i/∂x_j …]` for the outputs `y_i` of a program, a weight `w_i` of each, and the wanted inputs `x_j`.
///
/// ```text
/// ȳ_i = w_i      x̄ += ∂v/∂x · v̄  for every instruction v = f(x, …), last one first
/// ```
///
/// The inputs of the result are those of the program and, after them, the weights, all of
/// [`Stage::New`](crate::Stage::New). It contains the instructions of the program that derivatives need, with the same
/// bits; with the derivatives for all wanted inputs it is about two to three times as long.
///
/// Divided differences are differentiated through second ones. Where the derivative of a second one would be needed,
/// the result has the constant NaN, which [`Program::verify`] refuses.
///
/// # Panics
///
/// If there are fewer weights than outputs.
///
/// ```
/// use eem_symbolic::{F64, Graph, Input, Stage, adjoint, schedule};
///
/// let mut graph = Graph::new();
/// let [x, y, w] = ["x", "y", "w"].map(|name| Input {
///     symbol: graph.symbol(name),
///     name: name.to_owned(),
///     stage: Stage::New,
/// });
/// let [a, b] = [&x, &y].map(|input| graph.variable(input.symbol));
/// let square = graph.powi(b, 2);
/// let product = graph.mul(a, square);
/// let program = schedule(&graph, vec![x, y], &[product]);
/// // w y² and 2 w x y.
/// let derivatives = adjoint(&program, &[w], &[0, 1]);
/// assert_eq!(derivatives.interpret(&F64, &[3.0, 5.0, 10.0]), [250.0, 300.0]);
/// ```
#[must_use]
pub fn adjoint(program: &Program, weights: &[Input], wanted: &[usize]) -> Program {
    let mut sweep = Sweep::new(program, weights);
    let outputs = program.outputs.len();
    assert!(
        weights.len() >= outputs,
        "{} weights for {outputs} outputs",
        weights.len()
    );
    let inputs = (program.inputs.len()..).take(outputs);
    let weights = inputs.map(|input| Some(sweep.composer.input(input).into()));
    let weights: Vec<_> = weights.collect();
    let derivatives = sweep.backward(&weights, wanted);
    sweep.finish(&derivatives)
}
