//! The cost of one run of a program: operations by kind and stage, and transcendental functions.

use std::collections::BTreeSet;

use crate::function::Function;
use crate::operation::{Operation, ProgramKernel, Value};
use crate::program::{Program, Stage};

impl Program {
    /// Counts the operations of each stage.
    #[must_use]
    pub fn operation_count(&self) -> OperationCount {
        let mut count = OperationCount::default();
        for instruction in &self.instructions {
            match instruction.stage {
                Stage::Old => count.old.add(&instruction.operation),
                Stage::New => count.new.add(&instruction.operation),
            }
        }
        count
    }

    /// Counts the transcendental functions that are evaluated once per iteration.
    #[must_use]
    pub fn transcendental_count(&self) -> TranscendentalCount {
        let mut count = TranscendentalCount::default();
        let mut arguments = BTreeSet::new();
        let instructions = self.instructions.iter();
        for instruction in instructions.filter(|instruction| instruction.stage == Stage::New) {
            count.calls += library_calls(&instruction.operation);
            let (family, ends) = match instruction.operation {
                Operation::Apply(function, x) => (family(function), vec![x]),
                Operation::Power(base, _) => (Some(Function::Ln), vec![base]),
                Operation::DividedDifference(kernel, a, b)
                | Operation::SecondDividedDifference(kernel, a, b)
                | Operation::JointDifferences(kernel, a, b) => (family_of(kernel), vec![a, b]),
                Operation::Input(_)
                | Operation::Constant(_)
                | Operation::Add(..)
                | Operation::Sub(..)
                | Operation::Mul(..)
                | Operation::Div(..)
                | Operation::Neg(_)
                | Operation::Powi(..)
                | Operation::Sqrt(_)
                | Operation::Part(..) => (None, Vec::new()),
            };
            let Some(family) = family else { continue };
            for end in ends {
                let argument = self.up_to_a_factor(family, end);
                if self.instructions[argument.index()].stage == Stage::New {
                    arguments.insert((family as usize, argument));
                }
            }
        }
        count.arguments = arguments.len();
        count
    }

    /// The argument of a logarithm without a factor of the old stage, as `ln(c·x) = ln c + ln x`.
    fn up_to_a_factor(&self, family: Function, argument: Value) -> Value {
        if family != Function::Ln {
            return argument;
        }
        let known = |value: Value| self.instructions[value.index()].stage == Stage::Old;
        let factors = self.instructions[argument.index()].operation.clone();
        if let Operation::Mul(a, b) | Operation::Div(a, b) = factors
            && known(b)
        {
            return a;
        }
        if let Operation::Mul(a, b) = factors
            && known(a)
        {
            return b;
        }
        argument
    }
}

/// Transcendental functions in one run of the new stage of a [`Program`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TranscendentalCount {
    /// Calls of functions of the library, those inside of divided differences between close ends
    /// included. Roots do not count.
    pub calls: usize,
    /// The calls that would be enough if every divided difference were computed from function values
    /// at its ends: pairs of a kind of function and an argument that depends on the new state.
    pub arguments: usize,
}

/// The kind of a function: functions of one kind can be computed from one library call, as the
/// hyperbolic ones from the exponential.
fn family(function: Function) -> Option<Function> {
    match function {
        Function::Exp | Function::ExpM1 | Function::Sinh | Function::Cosh | Function::Tanh => {
            Some(Function::Exp)
        }
        Function::Ln | Function::Log2 | Function::Log10 => Some(Function::Ln),
        Function::Sin | Function::Cos | Function::Tan => Some(Function::Sin),
        Function::Ln1p | Function::Asinh | Function::Atan | Function::Atanh => Some(function),
        Function::Cbrt | Function::Abs => None,
    }
}

fn family_of(kernel: ProgramKernel) -> Option<Function> {
    match kernel {
        ProgramKernel::Function(function) => family(function),
        ProgramKernel::Powf(_) => Some(Function::Ln),
        ProgramKernel::Power(..) => Some(Function::Exp),
        ProgramKernel::Powi(_) | ProgramKernel::Sqrt => None,
    }
}

/// How often an operation calls the library for a transcendental function; the ends of divided
/// differences are taken as close.
fn library_calls(operation: &Operation) -> usize {
    match *operation {
        Operation::Apply(function, _) => usize::from(family(function).is_some()),
        Operation::Power(..) => 1,
        Operation::DividedDifference(kernel, ..) => calls_of(kernel)[0],
        // A joint call makes the library calls of the second difference.
        Operation::SecondDividedDifference(kernel, ..)
        | Operation::JointDifferences(kernel, ..) => calls_of(kernel)[1],
        Operation::Input(_)
        | Operation::Constant(_)
        | Operation::Add(..)
        | Operation::Sub(..)
        | Operation::Mul(..)
        | Operation::Div(..)
        | Operation::Neg(_)
        | Operation::Powi(..)
        | Operation::Sqrt(_)
        | Operation::Part(..) => 0,
    }
}

/// The calls in a first and in a second difference.
fn calls_of(kernel: ProgramKernel) -> [usize; 2] {
    match kernel {
        ProgramKernel::Function(function) => match function {
            Function::Sin | Function::Cos => [3, 3],
            Function::Tan => [3, 4],
            Function::Sinh => [2, 3],
            Function::Cosh => [2, 4],
            Function::Tanh => [3, 6],
            Function::Exp
            | Function::ExpM1
            | Function::Asinh
            | Function::Atan
            | Function::Atanh => [1, 2],
            Function::Ln
            | Function::Log2
            | Function::Log10
            | Function::Ln1p
            | Function::Cbrt
            | Function::Abs => [0, 0],
        },
        ProgramKernel::Powf(_) => [3, 1],
        ProgramKernel::Power(..) | ProgramKernel::Powi(_) | ProgramKernel::Sqrt => [0, 0],
    }
}

/// Operations of both stages of a [`Program`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OperationCount {
    /// Once per step.
    pub old: StageCount,
    /// Once per iteration.
    pub new: StageCount,
}

/// Operations of one stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StageCount {
    /// Sums, differences, changes of sign and magnitudes.
    pub additions: usize,
    /// Products, those of integer powers included.
    pub multiplications: usize,
    /// Quotients.
    pub divisions: usize,
    /// Elementary functions, roots and general powers.
    pub functions: usize,
    /// First and second divided differences of elementary functions.
    pub kernels: usize,
}

impl StageCount {
    /// All operations, each counted once.
    #[must_use]
    pub fn total(&self) -> usize {
        self.additions + self.multiplications + self.divisions + self.functions + self.kernels
    }

    fn add(&mut self, operation: &Operation) {
        match operation {
            // Joint differences are counted where one of them is read.
            Operation::Input(_) | Operation::Constant(_) | Operation::JointDifferences(..) => {}
            Operation::Add(..)
            | Operation::Sub(..)
            | Operation::Neg(_)
            | Operation::Apply(Function::Abs, _) => self.additions += 1,
            Operation::Mul(..) => self.multiplications += 1,
            Operation::Div(..) => self.divisions += 1,
            Operation::Powi(_, n) => {
                let n = n.unsigned_abs().max(1);
                self.multiplications += (n.ilog2() + n.count_ones() - 1) as usize;
            }
            Operation::Sqrt(_) | Operation::Power(..) | Operation::Apply(..) => self.functions += 1,
            Operation::DividedDifference(..)
            | Operation::SecondDividedDifference(..)
            | Operation::Part(..) => {
                self.kernels += 1;
            }
        }
    }
}
