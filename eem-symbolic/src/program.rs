//! A schedule of expressions: single assignments, operands first, no value twice or unused.
//!
//! Generated code is a [`Program`] printed line by line; [`Program::interpret`] evaluates one on any
//! arithmetic. Every instruction belongs to a [`Stage`], so that values that depend on parameters and
//! the old state alone are computed once per step.

use crate::node::Symbol;
use crate::operation::{Operation, Value};

/// Straight-line code for several outputs at once.
///
/// Value `i` is the result of instruction `i`. [`Program::verify`] lists the other invariants.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program {
    /// The inputs, in the order in which their values are passed; [`Operation::Input`] is a position here. An input
    /// that no output depends on is listed here and read by no instruction.
    pub inputs: Vec<Input>,
    /// The assignments.
    pub instructions: Vec<Instruction>,
    /// The results, in the order in which the expressions were given; not necessarily distinct.
    pub outputs: Vec<Value>,
}

/// A number that comes from outside.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Input {
    /// The symbol that it stands for in expressions.
    pub symbol: Symbol,
    /// The name of the symbol.
    pub name: String,
    /// [`Stage::Old`] for parameters and the old state, [`Stage::New`] for the new state.
    pub stage: Stage,
}

/// When a value can be computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// Once per step: from the parameters and the old state.
    Old,
    /// Once per iteration: from the new state too.
    New,
}

/// One assignment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Instruction {
    /// What is computed.
    pub operation: Operation,
    /// When it can be computed: the latest stage of the operands, except that a constant is
    /// repeated in each stage that uses it.
    pub stage: Stage,
}

impl Program {
    /// The old-stage values that new-stage instructions or outputs use, in order of computation.
    /// They are kept from the first part of a step to the second.
    #[must_use]
    pub fn hoisted(&self) -> Vec<Value> {
        let mut used = vec![false; self.instructions.len()];
        for instruction in &self.instructions {
            if instruction.stage == Stage::New {
                for operand in instruction.operation.operands() {
                    used[operand.index()] = true;
                }
            }
        }
        for output in &self.outputs {
            used[output.index()] = true;
        }
        let stages = self.instructions.iter().zip(used).enumerate();
        let hoisted =
            stages.filter(|(_, (instruction, used))| *used && instruction.stage == Stage::Old);
        hoisted.map(|(index, _)| Value::new(index)).collect()
    }

    /// For each instruction, whether one of the values depends on it.
    #[must_use]
    pub fn needed_by(&self, values: &[Value]) -> Vec<bool> {
        let mut needed = vec![false; self.instructions.len()];
        for value in values {
            needed[value.index()] = true;
        }
        for (index, instruction) in self.instructions.iter().enumerate().rev() {
            if needed[index] {
                for operand in instruction.operation.operands() {
                    needed[operand.index()] = true;
                }
            }
        }
        needed
    }

    /// The same with functions and divided differences, and all that they depend on, moved to the front,
    /// so that few values have to be kept in registers across their branches and calls.
    pub(crate) fn functions_first(self) -> Program {
        let is_function = |operation: &Operation| {
            matches!(
                operation,
                Operation::Apply(..)
                    | Operation::Power(..)
                    | Operation::DividedDifference(..)
                    | Operation::SecondDividedDifference(..)
                    | Operation::JointDifferences(..)
            )
        };
        let instructions = self.instructions.iter().enumerate();
        let functions: Vec<_> = instructions
            .filter(|(_, instruction)| is_function(&instruction.operation))
            .map(|(index, _)| Value::new(index))
            .collect();
        let needed = self.needed_by(&functions);
        let (first, rest): (Vec<_>, Vec<_>) = (0..needed.len()).partition(|&index| needed[index]);
        self.in_order(&[first, rest].concat(), self.outputs.len())
    }

    /// The program of the instructions `order`, in this order, with the first `outputs` outputs.
    pub(crate) fn in_order(&self, order: &[usize], outputs: usize) -> Program {
        let mut moved = vec![Value::new(0); self.instructions.len()];
        for (new, &old) in order.iter().enumerate() {
            moved[old] = Value::new(new);
        }
        let of = |value: Value| moved[value.index()];
        let instructions = order.iter().map(|&index| {
            let Instruction { operation, stage } = &self.instructions[index];
            Instruction {
                operation: operation.map(of),
                stage: *stage,
            }
        });
        let outputs = self.outputs[..outputs].iter().map(|&value| of(value));
        Program {
            inputs: self.inputs.clone(),
            instructions: instructions.collect(),
            outputs: outputs.collect(),
        }
    }
}
