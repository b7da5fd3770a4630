//! Expressions → [`Program`]: one pass over all outputs, each value computed once.
//!
//! * Equal expressions are one instruction, whichever outputs they belong to. So are equal leading
//!   terms of sums and equal leading factors of products.
//! * Squares are products, higher integer powers one instruction, half-integer powers take a square root. A
//!   coefficient −1 in a sum is a subtraction.
//! * [`schedule`] keeps the structural order and divides once per product: an expression takes the
//!   same operations at the old and at the new state, and what is symmetric in the two is symmetric
//!   bit by bit. Only constant factors and terms come first.
//! * The programs of a [`Model`](crate::Model) reorder sums and products, which changes rounding only: operands that
//!   depend on parameters alone come first, then those that many products or sums have in common, and quotients are
//!   products with shared reciprocals. Arguments of functions are still divided, so that ln(λ/λ₀) vanishes where λ = λ₀.
//!   Last, function calls move to the front, so that few values have to be kept across a call, and divided differences
//!   of one function between the same ends become one call
//!   ([`Operation::JointDifferences`](crate::Operation::JointDifferences)).

mod builder;
mod context;
mod dependence;
mod difference;
mod locals;
mod plan;
mod power;
mod sharing;
mod sum;

pub(crate) use context::Schedule;
pub(crate) use dependence::Dependence;
pub(crate) use locals::Locals;

use crate::graph::Graph;
use crate::node::{ExprId, Node};
use crate::program::{Input, Program};
use crate::verify_error::VerifyError;
use builder::{Builder, Operand, Signed};
use plan::Plan;

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
    schedule.in_order(inputs, outputs)
}

impl Schedule<'_> {
    /// Every operation in structural order.
    fn in_order(&self, inputs: Vec<Input>, outputs: &[ExprId]) -> Program {
        self.emit_all(Builder::new(self, inputs), outputs)
    }

    /// Operations in the order that shares the most.
    pub(crate) fn program(&self, inputs: Vec<Input>, outputs: &[ExprId]) -> Program {
        let new = inputs.iter().skip(self.parameters);
        let new = new.map(|input| input.symbol).collect();
        let plan = Plan::new(self, &new, outputs);
        let mut builder = Builder::new(self, inputs);
        builder.plan = Some(plan);
        let program = self.emit_all(builder, outputs);
        let program = program.functions_first().with_joint_differences();
        check(&program);
        program
    }

    fn emit_all(&self, mut builder: Builder<'_>, outputs: &[ExprId]) -> Program {
        for &output in outputs {
            self.visit(&mut builder, output);
        }
        let program = builder.finish(outputs);
        check(&program);
        program
    }

    /// Emits `root` and all that it depends on, operands first, without recursion.
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
            for operand in self.operands(e).into_iter().rev() {
                // The sum evaluates a planned product itself, together with its coefficient.
                if builder.is_part_of_sum(e, operand) {
                    let factors = self.operands(operand).into_iter().rev();
                    pending.extend(factors.map(|factor| (factor, false)));
                } else {
                    pending.push((operand, false));
                }
            }
        }
    }

    fn emit(&self, builder: &mut Builder<'_>, e: ExprId) -> Signed {
        if let Some(definition) = self.definition(e) {
            return builder.signed(definition);
        }
        match self.graph.node(e) {
            Node::Sum { constant, terms } => return builder.sum(e, *constant, terms),
            Node::Product(factors) => return builder.product(e, factors),
            Node::Number(number) => Operand::Number(*number),
            Node::Variable(symbol) => builder.input(*symbol),
            Node::Power(base, exponent) => builder.power(*base, *exponent),
            Node::Apply(function, x) => builder.apply(*function, *x),
            Node::PairSum(a, b) => return builder.pair_sum(*a, *b),
            Node::DividedDifference(kernel, a, b) => {
                return builder.divided_difference(*kernel, *a, *b);
            }
            Node::SecondDividedDifference(kernel, a, b) => {
                return builder.second_divided_difference(*kernel, *a, *b);
            }
            Node::PowerDifference { values, logarithms } => {
                builder.power_difference(*values, *logarithms)
            }
        }
        .into()
    }
}

/// In debug builds, panics if the program is not valid. A constant that is not finite is left for the caller to report.
pub(crate) fn check(program: &Program) {
    debug_assert!(matches!(
        program.verify(),
        Ok(()) | Err(VerifyError::NonFiniteConstant { .. })
    ));
}
