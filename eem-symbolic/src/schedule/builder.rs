//! Emits instructions. An operation that has been emitted before is not repeated: its value is reused.

use std::collections::{BTreeMap, HashMap};

use super::context::Schedule;
use super::plan::Plan;
use super::sharing::Token;
use crate::function::Function;
use crate::node::{ExprId, Node, Symbol};
use crate::number::Number;
use crate::operation::{Operation, Value};
use crate::program::{Input, Instruction, Program, Stage};

/// A result: an instruction, or a number that becomes a constant of the stage that uses it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Operand {
    Value(Value),
    Number(Number),
}

/// A result up to its sign, which the sum or product that uses it absorbs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Signed {
    pub(super) negative: bool,
    pub(super) operand: Operand,
}

impl From<Operand> for Signed {
    fn from(operand: Operand) -> Self {
        let negative = false;
        Self { negative, operand }
    }
}

pub(super) struct Builder<'s> {
    schedule: &'s Schedule<'s>,
    inputs: Vec<Input>,
    positions: BTreeMap<Symbol, usize>,
    instructions: Vec<Instruction>,
    /// Whether the value of the instruction depends on more than parameters.
    of_state: Vec<bool>,
    /// Looked up, never iterated.
    numbering: HashMap<(Stage, Operation), Value>,
    results: BTreeMap<ExprId, Signed>,
    /// The order of operations, if it is not the structural one.
    pub(super) plan: Option<Plan>,
    /// Products that are terms of sums, with their coefficients. Looked up, never iterated.
    pub(super) scaled: HashMap<(Number, ExprId), Signed>,
    /// Results of the tokens of the plan that have been emitted: of factors, and of terms.
    pub(super) factors: HashMap<Token, Signed>,
    pub(super) terms: HashMap<Token, Signed>,
}

impl<'s> Builder<'s> {
    pub(super) fn new(schedule: &'s Schedule<'s>, inputs: Vec<Input>) -> Self {
        let mut positions = BTreeMap::new();
        for (index, input) in inputs.iter().enumerate() {
            positions.insert(input.symbol, index);
        }
        Self {
            schedule,
            positions,
            inputs,
            instructions: Vec::new(),
            of_state: Vec::new(),
            numbering: HashMap::new(),
            results: BTreeMap::new(),
            plan: None,
            scaled: HashMap::new(),
            factors: HashMap::new(),
            terms: HashMap::new(),
        }
    }

    pub(super) fn finish(mut self, outputs: &[ExprId]) -> Program {
        let outputs = outputs.iter().map(|&output| {
            let operand = self.done(output);
            self.value(operand, Stage::New)
        });
        let outputs = outputs.collect();
        Program {
            inputs: self.inputs,
            instructions: self.instructions,
            outputs,
        }
    }

    /// Whether an expression has been emitted.
    pub(super) fn has(&self, e: ExprId) -> bool {
        self.results.contains_key(&e)
    }

    /// Whether `operand` is a product that the sum `e` evaluates with its coefficient.
    pub(super) fn is_part_of_sum(&self, e: ExprId, operand: ExprId) -> bool {
        let graph = self.schedule.graph;
        let Node::Sum { terms, .. } = graph.node(e) else {
            return false;
        };
        let Some(plan) = &self.plan else {
            return false;
        };
        let term = terms.iter().find(|(_, term)| *term == operand);
        term.is_some_and(|&(coefficient, term)| plan.factors(coefficient.abs(), term).is_some())
    }

    /// The result of an expression that has been emitted, up to its sign.
    pub(super) fn signed(&self, e: ExprId) -> Signed {
        let result = self.results.get(&e).copied();
        result.expect("operands are emitted before what uses them")
    }

    /// The result of an expression that has been emitted.
    pub(super) fn done(&mut self, e: ExprId) -> Operand {
        let Signed { negative, operand } = self.signed(e);
        match operand {
            _ if !negative => operand,
            Operand::Number(number) => Operand::Number(-number),
            Operand::Value(_) => self.emit([operand], |[a]| Operation::Neg(a)),
        }
    }

    pub(super) fn set(&mut self, e: ExprId, result: Signed) {
        self.results.insert(e, result);
    }

    pub(super) fn input(&mut self, symbol: Symbol) -> Operand {
        let Some(&position) = self.positions.get(&symbol) else {
            panic!("`{}` is not an input", self.schedule.graph.name(symbol));
        };
        let stage = self.inputs[position].stage;
        let of_state = position >= self.schedule.parameters;
        Operand::Value(self.insert(stage, Operation::Input(position), of_state))
    }

    pub(super) fn power(&mut self, base: ExprId, exponent: ExprId) -> Operand {
        let operands = [self.done(base), self.done(exponent)];
        self.emit(operands, |[a, b]| Operation::Power(a, b))
    }

    pub(super) fn apply(&mut self, function: Function, x: ExprId) -> Operand {
        let x = self.done(x);
        self.emit([x], |[x]| Operation::Apply(function, x))
    }

    pub(super) fn pair_sum(&mut self, a: ExprId, b: ExprId) -> Signed {
        let pair = [a, b].map(|term| self.signed(term));
        self.accumulate(pair.to_vec())
    }

    pub(super) fn add(&mut self, a: Operand, b: Operand) -> Operand {
        self.emit([a, b], |[a, b]| Operation::Add(a, b))
    }

    pub(super) fn mul(&mut self, a: Operand, b: Operand) -> Operand {
        self.emit([a, b], |[a, b]| Operation::Mul(a, b))
    }

    /// Whether an operand depends on more than parameters.
    pub(super) fn is_of_state(&self, operand: Operand) -> bool {
        match operand {
            Operand::Number(_) => false,
            Operand::Value(value) => self.of_state[value.index()],
        }
    }

    /// One instruction, at the latest stage of its operands.
    pub(super) fn emit<const N: usize>(
        &mut self,
        operands: [Operand; N],
        operation: impl FnOnce([Value; N]) -> Operation,
    ) -> Operand {
        let stages = operands.iter().map(|operand| match operand {
            Operand::Number(_) => Stage::Old,
            Operand::Value(value) => self.instructions[value.index()].stage,
        });
        let stage = stages.max().unwrap_or(Stage::Old);
        let of_state = operands.iter().any(|&operand| self.is_of_state(operand));
        let operands = operands.map(|operand| self.value(operand, stage));
        Operand::Value(self.insert(stage, operation(operands), of_state))
    }

    fn value(&mut self, operand: Operand, stage: Stage) -> Value {
        match operand {
            Operand::Value(value) => value,
            Operand::Number(number) => self.insert(stage, Operation::Constant(number), false),
        }
    }

    fn insert(&mut self, stage: Stage, operation: Operation, of_state: bool) -> Value {
        // Addition and multiplication commute, also in floating point.
        let operation = match operation {
            Operation::Add(a, b) if b < a => Operation::Add(b, a),
            Operation::Mul(a, b) if b < a => Operation::Mul(b, a),
            operation => operation,
        };
        let key = (stage, operation);
        if let Some(&value) = self.numbering.get(&key) {
            return value;
        }
        let value = Value::new(self.instructions.len());
        self.instructions.push(Instruction {
            operation: key.1.clone(),
            stage,
        });
        self.of_state.push(of_state);
        self.numbering.insert(key, value);
        value
    }
}
