//! Why a program is not valid: the errors of [`Program::verify`](crate::Program::verify).

use std::error::Error;
use std::fmt;

use crate::operation::Value;
use crate::program::Stage;

/// Why a program is not valid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum VerifyError {
    /// An instruction reads a value that is not computed before it.
    UseBeforeDefinition {
        /// The instruction.
        instruction: usize,
        /// What it reads.
        operand: Value,
    },
    /// An output is not the value of an instruction, or not a number.
    UnknownOutput {
        /// The position of the output.
        output: usize,
    },
    /// An instruction reads an input that the program does not have.
    UnknownInput {
        /// The instruction.
        instruction: usize,
        /// The position of the input.
        input: usize,
    },
    /// An instruction is not at the stage at which its operands are complete.
    WrongStage {
        /// The instruction.
        instruction: usize,
        /// The stage that it should have.
        expected: Stage,
    },
    /// A constant is used at another stage than its own.
    ConstantAcrossStages {
        /// The instruction that uses it.
        instruction: usize,
        /// The constant.
        operand: Value,
    },
    /// No instruction and no output uses a value.
    Unused {
        /// The instruction.
        instruction: usize,
    },
    /// Two instructions of one stage compute the same.
    Duplicate {
        /// The earlier instruction.
        first: usize,
        /// The later one.
        second: usize,
    },
    /// An integer power with an exponent for which there is a simpler operation.
    TrivialPower {
        /// The instruction.
        instruction: usize,
        /// The exponent.
        exponent: i32,
    },
    /// A constant is infinite or not a number.
    NonFiniteConstant {
        /// The instruction.
        instruction: usize,
    },
    /// Joint differences of a function that has no call for them.
    NoJointCall {
        /// The instruction.
        instruction: usize,
    },
    /// Joint differences of which fewer than two are read: one is computed alone.
    FewParts {
        /// The instruction.
        instruction: usize,
    },
    /// A part is read from a number, or joint differences are read as if they were one.
    WrongKind {
        /// The instruction that reads.
        instruction: usize,
        /// What it reads.
        operand: Value,
    },
}

impl fmt::Display for VerifyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (instruction, fault) = match *self {
            Self::UnknownOutput { output } => {
                return write!(f, "output {output} is not a number that is computed");
            }
            Self::Duplicate { first, second } => {
                return write!(f, "instructions {first} and {second} compute the same");
            }
            Self::UseBeforeDefinition {
                instruction,
                operand,
            } => (instruction, reads(operand, "not computed before it")),
            Self::ConstantAcrossStages {
                instruction,
                operand,
            } => (instruction, reads(operand, "a constant of another stage")),
            Self::WrongKind {
                instruction,
                operand,
            } => (instruction, reads(operand, "of another kind than it needs")),
            Self::UnknownInput { instruction, input } => (
                instruction,
                format!("reads input {input}, which does not exist"),
            ),
            Self::WrongStage {
                instruction,
                expected,
            } => (instruction, format!("belongs to stage {expected:?}")),
            Self::Unused { instruction } => (instruction, "is never used".to_owned()),
            Self::TrivialPower {
                instruction,
                exponent,
            } => (instruction, format!("is a power with exponent {exponent}")),
            Self::NonFiniteConstant { instruction } => {
                (instruction, "is a constant that is not finite".to_owned())
            }
            Self::NoJointCall { instruction } => (
                instruction,
                "asks for joint differences of a function without".to_owned(),
            ),
            Self::FewParts { instruction } => (
                instruction,
                "computes joint differences for one reader".to_owned(),
            ),
        };
        write!(f, "instruction {instruction} {fault}")
    }
}

fn reads(operand: Value, fault: &str) -> String {
    format!("reads value {}, which is {fault}", operand.index())
}

impl Error for VerifyError {}
