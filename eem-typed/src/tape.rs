//! Straight-line programs as tapes: instructions of registers, evaluated one by one on any scalar.
//!
//! Every operation is the method of [`Scalar`] that generated code calls, so that a tape has its bits. What depends on
//! parameters alone is computed once, when the tape is made ([`fold`]). A product with one reader is computed by
//! the instruction that reads it (`a b + c`), rounded by itself.

mod allocate;
mod fold;
mod instruction;
mod lower;

use eem_material::number::scalar::Scalar;

use crate::error::LawError;
use allocate::{Allocated, allocate};
pub(crate) use fold::fold;
use instruction::{Instruction, Register};
pub(crate) use lower::Wanted;

/// Files of registers that a tape may use: powers of two, so that no index is beyond the end.
const SMALL: usize = 64;
const MEDIUM: usize = 128;
const LARGE: usize = 512;
const LARGEST: usize = 4096;

/// Instructions for some values of a program.
///
/// Registers hold first the constants, then the inputs, then results.
#[derive(Debug)]
pub(crate) struct Tape<S> {
    constants: Box<[S]>,
    inputs: usize,
    instructions: Box<[Instruction]>,
    outputs: Box<[Register]>,
    registers: usize,
}

impl<S: Scalar> Tape<S> {
    /// The tape for these values.
    pub(crate) fn new(wanted: &Wanted<'_, S>) -> Result<Self, LawError> {
        let lines = lower::lower(wanted);
        let Allocated {
            constants,
            instructions,
            outputs,
            registers,
        } = allocate(wanted, &lines);
        if registers > LARGEST {
            return Err(LawError::TooLarge {
                numbers: registers,
                most: LARGEST,
            });
        }
        Ok(Self {
            constants,
            inputs: wanted.inputs,
            instructions,
            outputs,
            registers,
        })
    }

    /// Number of results.
    pub(crate) fn results(&self) -> usize {
        self.outputs.len()
    }

    /// Evaluates the tape for inputs one after the other, into results one after the other.
    #[inline]
    pub(crate) fn run(&self, inputs: &[&[S]], results: &mut [&mut [S]]) {
        if self.registers <= SMALL {
            self.run_in::<SMALL>(inputs, results);
        } else if self.registers <= MEDIUM {
            self.run_in::<MEDIUM>(inputs, results);
        } else if self.registers <= LARGE {
            self.run_in::<LARGE>(inputs, results);
        } else {
            self.run_in::<LARGEST>(inputs, results);
        }
    }

    /// The same with so many registers.
    fn run_in<const P: usize>(&self, inputs: &[&[S]], results: &mut [&mut [S]]) {
        const { assert!(P.is_power_of_two()) };
        let mut file = [S::zero(); P];
        let first = self.constants.len();
        file[..first].copy_from_slice(&self.constants);
        let mut next = first;
        for &input in inputs {
            file[next..next + input.len()].copy_from_slice(input);
            next += input.len();
        }
        debug_assert_eq!(next, first + self.inputs, "an input is missing");
        for instruction in &self.instructions {
            instruction.execute(&mut file);
        }
        let mut outputs = self.outputs.iter();
        for result in results.iter_mut().flat_map(|part| part.iter_mut()) {
            if let Some(&output) = outputs.next() {
                *result = file[usize::from(output) & (P - 1)];
            }
        }
    }
}
