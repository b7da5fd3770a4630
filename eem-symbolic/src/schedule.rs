//! Expressions → [`Program`]: one pass over all outputs, every value computed once, none for nothing.
//!
//! * Equal expressions are one instruction, whichever outputs they belong to, and so are equal
//!   beginnings of sums and products.
//! * A product is a numerator over a denominator: one division. Whole powers are products, halves
//!   square roots. Coefficients ±1 cost a sign, which a sum absorbs.
//! * Of derivatives that serve Newton's method alone, a relative error of some roundings more is no
//!   loss: what only they need multiplies by shared reciprocals instead of dividing.
//! * Factors and terms of parameters alone come first, so that they are old-stage values. The others
//!   stay in structural order whatever their stage is: an expression takes the same operations at
//!   the old and at the new state, and what is symmetric in the two is symmetric bit by bit.

mod builder;
mod locals;
mod power;
mod sum;

pub(crate) use locals::Locals;

use crate::graph::Graph;
use crate::node::{ExprId, Node};
use crate::program::{Input, Program};
use builder::{Builder, Operand, Signed};

/// Schedules expressions as the outputs of one program.
///
/// # Panics
///
/// If an output depends on a symbol that is not an input.
///
/// ```
/// use eem_symbolic::{Graph, Input, Stage, schedule};
///
/// let mut graph = Graph::new();
/// let symbol = graph.symbol("x");
/// let x = graph.variable(symbol);
/// let outputs = [graph.powi(x, -1), graph.powi(x, 2)];
/// let name = String::from("x");
/// let program = schedule(&graph, vec![Input { symbol, name, stage: Stage::New }], &outputs);
/// let count = program.operation_count().new;
/// assert_eq!((count.multiplications, count.divisions), (1, 1));
/// ```
#[must_use]
pub fn schedule(graph: &Graph, inputs: Vec<Input>, outputs: &[ExprId]) -> Program {
    let schedule = Schedule {
        graph,
        locals: &Locals::default(),
        parameters: 0,
    };
    schedule.program(inputs, outputs, &[])
}

/// What a schedule is made from besides inputs and outputs.
pub(crate) struct Schedule<'g> {
    pub(crate) graph: &'g Graph,
    pub(crate) locals: &'g Locals,
    /// How many of the first inputs are parameters.
    pub(crate) parameters: usize,
}

impl Schedule<'_> {
    /// Outputs are the values and then their tangents, for which rounding matters less.
    pub(crate) fn program(
        &self,
        inputs: Vec<Input>,
        values: &[ExprId],
        tangents: &[ExprId],
    ) -> Program {
        let mut builder = Builder::new(self, inputs);
        for &value in values {
            self.visit(&mut builder, value);
        }
        builder.reciprocals = true;
        for &tangent in tangents {
            self.visit(&mut builder, tangent);
        }
        let program = builder.finish(&[values, tangents].concat());
        debug_assert_eq!(program.verify(), Ok(()));
        program
    }

    /// Emits what `root` depends on, operands first, without recursion.
    fn visit(&self, builder: &mut Builder<'_>, root: ExprId) {
        let mut pending = vec![(root, false)];
        while let Some((e, operands_done)) = pending.pop() {
            if builder.has(e) {
                continue;
            }
            if operands_done {
                let result = self.emit(builder, e);
                builder.set(e, result);
                continue;
            }
            pending.push((e, true));
            let first = pending.len();
            if let Some(definition) = self.definition(e) {
                pending.push((definition, false));
            } else {
                let node = self.graph.node(e);
                node.for_each_operand(|operand| pending.push((operand, false)));
            }
            // The first operand is on top, and done first.
            pending[first..].reverse();
        }
    }

    /// The expression that a local stands for.
    fn definition(&self, e: ExprId) -> Option<ExprId> {
        let resolved = self.locals.resolve(self.graph, e);
        (resolved != e).then_some(resolved)
    }

    fn emit(&self, builder: &mut Builder<'_>, e: ExprId) -> Signed {
        if let Some(definition) = self.definition(e) {
            return builder.signed(definition);
        }
        match self.graph.node(e) {
            Node::Sum { constant, terms } => return builder.sum(*constant, terms),
            Node::Product(factors) => return builder.product(factors),
            Node::Number(number) => Operand::Number(*number),
            Node::Variable(symbol) => builder.input(*symbol),
            Node::Power(base, exponent) => builder.power(*base, *exponent),
            Node::Apply(function, x) => builder.apply(*function, *x),
            Node::PairSum(a, b) => builder.pair_sum(*a, *b),
            Node::DividedDifference(kernel, a, b) => builder.divided_difference(*kernel, *a, *b),
            Node::SecondDividedDifference(kernel, a, b) => {
                builder.second_divided_difference(*kernel, *a, *b)
            }
            Node::PowerDifference { values, logarithms } => {
                builder.power_difference(*values, *logarithms)
            }
        }
        .into()
    }
}
