//! The forward sweep over a program: the derivatives of all outputs along one direction.

use crate::program::{Input, Program};
use crate::sweep::Sweep;

/// `[Σ_j ∂y_i/∂x_j · d_j …]` for the outputs `y_i` of a program, the wanted inputs `x_j` and a component `d_j` of each.
///
/// ```text
/// ẋ_j = d_j      v̇ = Σ ∂v/∂x · ẋ  for every instruction v = f(x, …), first one first
/// ```
///
/// The inputs of the result are those of the program and, after them, the directions, all of
/// [`Stage::New`](crate::Stage::New). Instructions, bits and NaN are as in [`adjoint`](crate::adjoint()).
///
/// # Panics
///
/// If there are fewer directions than wanted inputs.
///
/// ```
/// use eem_symbolic::{F64, Graph, Input, Stage, schedule, tangent};
///
/// let mut graph = Graph::new();
/// let [x, y, d] = ["x", "y", "d"].map(|name| Input {
///     symbol: graph.symbol(name),
///     name: name.to_owned(),
///     stage: Stage::New,
/// });
/// let [a, b] = [&x, &y].map(|input| graph.variable(input.symbol));
/// let square = graph.powi(b, 2);
/// let product = graph.mul(a, square);
/// let program = schedule(&graph, vec![x, y], &[product]);
/// // 2 x y d, along y alone.
/// let derivative = tangent(&program, &[d], &[1]);
/// assert_eq!(derivative.interpret(&F64, &[3.0, 5.0, 10.0]), [300.0]);
/// ```
#[must_use]
pub fn tangent(program: &Program, directions: &[Input], wanted: &[usize]) -> Program {
    let mut sweep = Sweep::new(program, directions);
    assert!(
        directions.len() >= wanted.len(),
        "{} directions for {} inputs",
        directions.len(),
        wanted.len()
    );
    let inputs = (program.inputs.len()..).zip(wanted);
    let directions = inputs.map(|(input, &of)| (of, sweep.composer.input(input).into()));
    let directions: Vec<_> = directions.collect();
    let derivatives = sweep.forward(&directions);
    sweep.finish(&derivatives)
}
