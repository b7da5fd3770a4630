//! A schedule of expressions: single assignments, operands first, nothing twice, nothing unused.
//!
//! A [`Program`] is what generated code prints line by line and what
//! [`Program::interpret`] evaluates on any arithmetic. Every instruction belongs to a [`Stage`], so
//! that what depends on the parameters and the old state alone is computed once per step.

use crate::function::Function;
use crate::node::Symbol;
use crate::number::Number;

/// Straight-line code for several outputs at once.
///
/// Value `i` is the result of instruction `i`. [`Program::verify`] says what else holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program {
    /// What [`Operation::Input`] refers to, in the order in which values are handed over. An input
    /// that no output depends on is listed here and read by no instruction.
    pub inputs: Vec<Input>,
    /// The assignments.
    pub instructions: Vec<Instruction>,
    /// The results, in the order in which the expressions were given; not necessarily distinct.
    pub outputs: Vec<Value>,
}

/// The result of one instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Value(u32);

impl Value {
    /// The value of instruction `index`.
    ///
    /// # Panics
    ///
    /// If there are more than 2³² instructions.
    #[must_use]
    pub fn new(index: usize) -> Self {
        Self(u32::try_from(index).expect("a program has fewer than 2³² instructions"))
    }

    /// The position of the instruction that computes the value.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A number that comes from outside.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Input {
    /// The symbol of the expressions that it stands for.
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

/// What one instruction computes.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Operation {
    /// The input of this position.
    Input(usize),
    /// A number, exact if it was written so.
    Constant(Number),
    /// `a + b`.
    Add(Value, Value),
    /// `a − b`.
    Sub(Value, Value),
    /// `a b`.
    Mul(Value, Value),
    /// `a / b`.
    Div(Value, Value),
    /// `−a`.
    Neg(Value),
    /// `aⁿ` with n ≥ 3: squares and reciprocals are products and quotients.
    Powi(Value, i32),
    /// `√a`.
    Sqrt(Value),
    /// `aᵇ`.
    Power(Value, Value),
    /// `f(a)`.
    Apply(Function, Value),
    /// `f[a, b] = (f(b) − f(a)) / (b − a)`, which is f′(a) for a = b.
    DividedDifference(ProgramKernel, Value, Value),
    /// `f[a, b, b] = ∂f[a, b]/∂b`, which is ½ f″(a) for a = b.
    SecondDividedDifference(ProgramKernel, Value, Value),
}

/// The function f of a divided difference; V is a [`Value`], or the number that an interpreter has
/// in its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ProgramKernel<V = Value> {
    /// An elementary function.
    Function(Function),
    /// `xⁿ`, n ≠ 0, 1, 2; −1 is the reciprocal.
    Powi(i32),
    /// `√x`.
    Sqrt,
    /// `xᵖ` with p the given value, the same at both ends.
    Powf(V),
    /// `eˣ` between the logarithms of two powers, with the powers themselves at the two ends: the
    /// values `exp(a)` and `exp(b)`, which are more accurate than what is computed from a and b.
    Power(V, V),
}

impl Operation {
    /// The operands, in the order of the formula.
    #[must_use]
    pub fn operands(&self) -> Vec<Value> {
        match self {
            Self::Input(_) | Self::Constant(_) => Vec::new(),
            Self::Neg(a) | Self::Powi(a, _) | Self::Sqrt(a) | Self::Apply(_, a) => vec![*a],
            Self::Add(a, b)
            | Self::Sub(a, b)
            | Self::Mul(a, b)
            | Self::Div(a, b)
            | Self::Power(a, b) => vec![*a, *b],
            Self::DividedDifference(kernel, a, b) | Self::SecondDividedDifference(kernel, a, b) => {
                let mut operands = kernel.operands();
                operands.extend([*a, *b]);
                operands
            }
        }
    }
}

impl Operation {
    /// The same operation of other values.
    fn map(&self, of: impl Fn(Value) -> Value) -> Self {
        match *self {
            Self::Input(index) => Self::Input(index),
            Self::Constant(number) => Self::Constant(number),
            Self::Add(a, b) => Self::Add(of(a), of(b)),
            Self::Sub(a, b) => Self::Sub(of(a), of(b)),
            Self::Mul(a, b) => Self::Mul(of(a), of(b)),
            Self::Div(a, b) => Self::Div(of(a), of(b)),
            Self::Neg(a) => Self::Neg(of(a)),
            Self::Powi(a, n) => Self::Powi(of(a), n),
            Self::Sqrt(a) => Self::Sqrt(of(a)),
            Self::Power(a, b) => Self::Power(of(a), of(b)),
            Self::Apply(function, a) => Self::Apply(function, of(a)),
            Self::DividedDifference(kernel, a, b) => {
                Self::DividedDifference(kernel.map(&of), of(a), of(b))
            }
            Self::SecondDividedDifference(kernel, a, b) => {
                Self::SecondDividedDifference(kernel.map(&of), of(a), of(b))
            }
        }
    }
}

impl<V: Copy> ProgramKernel<V> {
    /// The values that f itself depends on.
    #[must_use]
    pub fn operands(self) -> Vec<V> {
        match self {
            Self::Function(_) | Self::Powi(_) | Self::Sqrt => Vec::new(),
            Self::Powf(exponent) => vec![exponent],
            Self::Power(value_a, value_b) => vec![value_a, value_b],
        }
    }

    /// The same function of other values.
    pub fn map<W>(self, mut of: impl FnMut(V) -> W) -> ProgramKernel<W> {
        match self {
            Self::Function(function) => ProgramKernel::Function(function),
            Self::Powi(n) => ProgramKernel::Powi(n),
            Self::Sqrt => ProgramKernel::Sqrt,
            Self::Powf(exponent) => ProgramKernel::Powf(of(exponent)),
            Self::Power(value_a, value_b) => ProgramKernel::Power(of(value_a), of(value_b)),
        }
    }
}

impl Program {
    /// The old-stage values that new-stage instructions or outputs use, in order of computation:
    /// what has to be kept from the first part of a step to the second.
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

    /// Which instructions some values depend on.
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

    /// The program of the first `outputs` outputs: the same instructions in the same order, without
    /// those that only the others depend on.
    ///
    /// # Panics
    ///
    /// If there are fewer outputs.
    #[must_use]
    pub fn restricted_to(&self, outputs: usize) -> Program {
        let needed = self.needed_by(&self.outputs[..outputs]);
        let kept = (0..needed.len()).filter(|&index| needed[index]);
        self.in_order(&kept.collect::<Vec<_>>(), outputs)
    }

    /// The same with functions and divided differences first, and what they depend on: few values
    /// have to outlive their branches and calls.
    pub(crate) fn functions_first(self) -> Program {
        let is_function = |operation: &Operation| {
            matches!(
                operation,
                Operation::Apply(..)
                    | Operation::Power(..)
                    | Operation::DividedDifference(..)
                    | Operation::SecondDividedDifference(..)
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

    /// The program of these instructions in this order, and of the first outputs.
    fn in_order(&self, order: &[usize], outputs: usize) -> Program {
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
