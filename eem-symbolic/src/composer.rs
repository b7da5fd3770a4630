//! Writes a program of one stage, operation by operation; what has been computed before is not computed again.

use std::collections::HashMap;

use crate::number::Number;
use crate::operation::{Operation, Value};
use crate::program::{Input, Instruction, Program, Stage};
use crate::schedule::check;

/// A program in the making, all of it of [`Stage::New`].
pub(crate) struct Composer {
    inputs: Vec<Input>,
    operations: Vec<Operation>,
    /// Looked up, never iterated.
    numbering: HashMap<Operation, Value>,
}

/// A value up to its sign, which the sum that uses it absorbs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Signed {
    pub(crate) negative: bool,
    pub(crate) value: Value,
}

impl From<Value> for Signed {
    fn from(value: Value) -> Self {
        let negative = false;
        Self { negative, value }
    }
}

impl Signed {
    pub(crate) fn negated(self) -> Self {
        let negative = !self.negative;
        Self { negative, ..self }
    }
}

impl Composer {
    pub(crate) fn new(inputs: Vec<Input>) -> Self {
        let of_new = |input: Input| Input {
            stage: Stage::New,
            ..input
        };
        Self {
            inputs: inputs.into_iter().map(of_new).collect(),
            operations: Vec::new(),
            numbering: HashMap::new(),
        }
    }

    /// What has been written so far.
    pub(crate) fn operations(&self) -> &[Operation] {
        &self.operations
    }

    /// The value of an operation on values of this program; appends the operation if it is new.
    pub(crate) fn emit(&mut self, operation: Operation) -> Value {
        // Addition and multiplication commute, also in floating point.
        let operation = match operation {
            Operation::Add(a, b) if b < a => Operation::Add(b, a),
            Operation::Mul(a, b) if b < a => Operation::Mul(b, a),
            operation => operation,
        };
        if let Some(&value) = self.numbering.get(&operation) {
            return value;
        }
        let value = Value::new(self.operations.len());
        self.operations.push(operation.clone());
        self.numbering.insert(operation, value);
        value
    }

    pub(crate) fn number(&mut self, number: Number) -> Value {
        self.emit(Operation::Constant(number))
    }

    pub(crate) fn input(&mut self, index: usize) -> Value {
        self.emit(Operation::Input(index))
    }

    pub(crate) fn is_one(&self, value: Value) -> bool {
        self.operations[value.index()] == Operation::Constant(Number::ONE)
    }

    /// `a b`, a or b itself if the other one is 1.
    pub(crate) fn mul(&mut self, a: Value, b: Value) -> Value {
        match [a, b].map(|value| self.is_one(value)) {
            [true, _] => b,
            [_, true] => a,
            [false, false] => self.emit(Operation::Mul(a, b)),
        }
    }

    pub(crate) fn add(&mut self, a: Signed, b: Signed) -> Signed {
        let (negative, operation) = match [a.negative, b.negative] {
            [false, true] => (false, Operation::Sub(a.value, b.value)),
            [true, false] => (false, Operation::Sub(b.value, a.value)),
            [negative, _] => (negative, Operation::Add(a.value, b.value)),
        };
        let value = self.emit(operation);
        Signed { negative, value }
    }

    /// Appends another program, which has no joint differences, and returns its outputs. `input` returns
    /// the value that takes the place of an input.
    pub(crate) fn inline(
        &mut self,
        program: &Program,
        mut input: impl FnMut(&mut Self, usize) -> Value,
    ) -> Vec<Value> {
        let mut values: Vec<Value> = Vec::with_capacity(program.instructions.len());
        for Instruction { operation, .. } in &program.instructions {
            let value = match *operation {
                Operation::Input(index) => input(self, index),
                ref operation => self.emit(operation.map(|value| values[value.index()])),
            };
            values.push(value);
        }
        let outputs = program.outputs.iter();
        outputs.map(|output| values[output.index()]).collect()
    }

    /// The program of these outputs; `None` is zero.
    pub(crate) fn finish(mut self, outputs: &[Option<Signed>]) -> Program {
        let outputs = outputs.iter().map(|output| match *output {
            Some(Signed { negative, value }) if negative => self.emit(Operation::Neg(value)),
            Some(Signed { value, .. }) => value,
            None => self.number(Number::ZERO),
        });
        let outputs: Vec<_> = outputs.collect();
        let instructions = self.operations.into_iter().map(|operation| Instruction {
            operation,
            stage: Stage::New,
        });
        let program = Program {
            inputs: self.inputs,
            instructions: instructions.collect(),
            outputs,
        };
        let needed = program.needed_by(&program.outputs);
        let kept: Vec<usize> = (0..needed.len()).filter(|&index| needed[index]).collect();
        let program = program.in_order(&kept, program.outputs.len());
        let program = program.functions_first().with_joint_differences();
        check(&program);
        program
    }
}
