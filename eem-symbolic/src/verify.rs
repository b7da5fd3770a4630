//! The check of the invariants of a [`Program`], independent of how it was built.

use std::collections::HashMap;

use crate::operation::{Operation, ProgramKernel, Value};
use crate::program::Program;
use crate::verify_error::VerifyError;

impl Program {
    /// Checks that the program is a schedule.
    ///
    /// * Operands and outputs are values of earlier instructions, inputs exist.
    /// * The stage of an instruction is that of its input or the latest one of its operands;
    ///   constants are used at their own stage.
    /// * Every value is used, and none is computed twice at one stage.
    /// * Integer powers have n ≥ 3, in divided differences n ≠ 0, 1, 2. Constants are finite.
    /// * Parts are read from joint differences only, which nothing else reads. Joint differences have at
    ///   least two parts, and a function with a joint call.
    ///
    /// # Errors
    ///
    /// The first violation.
    pub fn verify(&self) -> Result<(), VerifyError> {
        for instruction in 0..self.instructions.len() {
            self.check_operands(instruction)?;
            self.check_stage(instruction)?;
            self.check_numbers(instruction)?;
            self.check_kinds(instruction)?;
        }
        self.check_outputs()?;
        self.check_used()?;
        self.check_parts()?;
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
            Operation::JointDifferences(kernel, ..) if !kernel.has_joint_call() => {
                Err(VerifyError::NoJointCall { instruction })
            }
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

    fn is_joint(&self, value: Value) -> bool {
        let operation = &self.instructions[value.index()].operation;
        matches!(operation, Operation::JointDifferences(..))
    }

    fn check_kinds(&self, instruction: usize) -> Result<(), VerifyError> {
        let operation = &self.instructions[instruction].operation;
        let reads_part = matches!(operation, Operation::Part(..));
        let mut operands = operation.operands().into_iter();
        match operands.find(|&operand| self.is_joint(operand) != reads_part) {
            Some(operand) => Err(VerifyError::WrongKind {
                instruction,
                operand,
            }),
            None => Ok(()),
        }
    }

    fn check_parts(&self) -> Result<(), VerifyError> {
        let mut parts = vec![0; self.instructions.len()];
        for instruction in &self.instructions {
            if let Operation::Part(differences, _) = instruction.operation {
                parts[differences.index()] += 1;
            }
        }
        let joint = |&index: &usize| self.is_joint(Value::new(index));
        match (0..parts.len())
            .filter(joint)
            .find(|&index| parts[index] < 2)
        {
            Some(instruction) => Err(VerifyError::FewParts { instruction }),
            None => Ok(()),
        }
    }

    /// Every output is the value of an instruction, and a number.
    fn check_outputs(&self) -> Result<(), VerifyError> {
        let count = self.instructions.len();
        match self
            .outputs
            .iter()
            .position(|&output| output.index() >= count || self.is_joint(output))
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
