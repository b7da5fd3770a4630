//! What every [`Program`] satisfies, checked from scratch.

use std::collections::HashMap;
use std::error::Error;
use std::fmt;

use crate::program::{Operation, Program, ProgramKernel, Stage, Value};

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
    /// An output is not the value of an instruction.
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
    /// A whole power with an exponent for which there is a simpler operation.
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
}

impl Program {
    /// Checks that the program is a schedule.
    ///
    /// * Operands and outputs are values of earlier instructions, inputs exist.
    /// * The stage of an instruction is that of its input or the latest one of its operands;
    ///   constants are used at their own stage.
    /// * Every value is used, and none is computed twice at one stage.
    /// * Whole powers are n ≥ 3, those of divided differences n ≠ 0, 1, 2. Constants are finite.
    ///
    /// # Errors
    ///
    /// The first violation.
    pub fn verify(&self) -> Result<(), VerifyError> {
        for instruction in 0..self.instructions.len() {
            self.check_operands(instruction)?;
            self.check_stage(instruction)?;
            self.check_numbers(instruction)?;
        }
        self.check_outputs()?;
        self.check_used()?;
        self.check_distinct()
    }

    fn check_operands(&self, instruction: usize) -> Result<(), VerifyError> {
        let operation = &self.instructions[instruction].operation;
        let mut operands = operation.operands().into_iter();
        if let Some(operand) = operands.find(|operand| operand.index() >= instruction) {
            return Err(VerifyError::UseBeforeDefinition {
                instruction,
                operand,
            });
        }
        match *operation {
            Operation::Input(input) if input >= self.inputs.len() => {
                Err(VerifyError::UnknownInput { instruction, input })
            }
            _ => Ok(()),
        }
    }

    fn check_stage(&self, instruction: usize) -> Result<(), VerifyError> {
        let this = &self.instructions[instruction];
        let operands = this.operation.operands();
        for &operand in &operands {
            let earlier = &self.instructions[operand.index()];
            let constant = matches!(earlier.operation, Operation::Constant(_));
            if constant && earlier.stage != this.stage {
                return Err(VerifyError::ConstantAcrossStages {
                    instruction,
                    operand,
                });
            }
        }
        let stages = operands
            .iter()
            .map(|operand| self.instructions[operand.index()].stage);
        let expected = match this.operation {
            Operation::Input(input) => self.inputs[input].stage,
            Operation::Constant(_) => this.stage,
            _ => stages.max().unwrap_or(this.stage),
        };
        if this.stage == expected {
            Ok(())
        } else {
            Err(VerifyError::WrongStage {
                instruction,
                expected,
            })
        }
    }

    fn check_numbers(&self, instruction: usize) -> Result<(), VerifyError> {
        match self.instructions[instruction].operation {
            Operation::Constant(number) if !number.to_f64().is_finite() => {
                Err(VerifyError::NonFiniteConstant { instruction })
            }
            Operation::Powi(_, exponent) if exponent < 3 => Err(VerifyError::TrivialPower {
                instruction,
                exponent,
            }),
            Operation::DividedDifference(ProgramKernel::Powi(exponent @ 0..=2), ..)
            | Operation::SecondDividedDifference(ProgramKernel::Powi(exponent @ 0..=2), ..) => {
                Err(VerifyError::TrivialPower {
                    instruction,
                    exponent,
                })
            }
            _ => Ok(()),
        }
    }

    fn check_outputs(&self) -> Result<(), VerifyError> {
        let count = self.instructions.len();
        match self
            .outputs
            .iter()
            .position(|output| output.index() >= count)
        {
            Some(output) => Err(VerifyError::UnknownOutput { output }),
            None => Ok(()),
        }
    }

    fn check_used(&self) -> Result<(), VerifyError> {
        let mut used = vec![false; self.instructions.len()];
        let instructions = self.instructions.iter();
        let operands = instructions.flat_map(|instruction| instruction.operation.operands());
        for value in operands.chain(self.outputs.iter().copied()) {
            used[value.index()] = true;
        }
        match used.iter().position(|used| !used) {
            Some(instruction) => Err(VerifyError::Unused { instruction }),
            None => Ok(()),
        }
    }

    fn check_distinct(&self) -> Result<(), VerifyError> {
        // Looked up, never iterated.
        let mut seen = HashMap::new();
        for (second, instruction) in self.instructions.iter().enumerate() {
            if let Some(first) = seen.insert((instruction.stage, &instruction.operation), second) {
                return Err(VerifyError::Duplicate { first, second });
            }
        }
        Ok(())
    }
}

impl fmt::Display for VerifyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UseBeforeDefinition {
                instruction,
                operand,
            } => {
                let operand = operand.index();
                write!(
                    f,
                    "instruction {instruction} reads value {operand}, which is not there yet"
                )
            }
            Self::UnknownOutput { output } => {
                write!(f, "output {output} is the value of no instruction")
            }
            Self::UnknownInput { instruction, input } => {
                write!(
                    f,
                    "instruction {instruction} reads input {input}, which does not exist"
                )
            }
            Self::WrongStage {
                instruction,
                expected,
            } => {
                write!(f, "instruction {instruction} belongs to stage {expected:?}")
            }
            Self::ConstantAcrossStages {
                instruction,
                operand,
            } => {
                let operand = operand.index();
                write!(
                    f,
                    "instruction {instruction} uses constant {operand} of another stage"
                )
            }
            Self::Unused { instruction } => {
                write!(f, "the value of instruction {instruction} is never used")
            }
            Self::Duplicate { first, second } => {
                write!(f, "instructions {first} and {second} compute the same")
            }
            Self::TrivialPower {
                instruction,
                exponent,
            } => {
                write!(
                    f,
                    "instruction {instruction} is a power with exponent {exponent}"
                )
            }
            Self::NonFiniteConstant { instruction } => {
                write!(f, "the constant of instruction {instruction} is not finite")
            }
        }
    }
}

impl Error for VerifyError {}
