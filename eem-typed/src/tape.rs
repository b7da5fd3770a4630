//! Straight-line programs as tapes: instructions of registers, evaluated one by one on any scalar.
//!
//! Every operation is the method of [`Scalar`] that generated code calls, so that results have the same bits. Values that
//! depend on parameters alone are computed once, when the tape is made ([`fold`]). A product with one reader is computed by
//! the instruction that reads it (`a b + c`), but rounded separately.

mod allocate;
mod fold;
mod instruction;
mod lower;

use core::cell::RefCell;

use crate::error::LawError;
use allocate::{Allocated, allocate};
pub(crate) use fold::fold;
use instruction::{File, Instruction, Register};
pub(crate) use lower::Wanted;

/// Sizes of register files: powers of two, so that a mask keeps every index within the file.
const SMALL: usize = 64;
const MEDIUM: usize = 128;
const LARGE: usize = 512;
const LARGEST: usize = 4096;

/// If a register holds a number for each of several elements, so many numbers are computed at a time: more do not fit the
/// processor's registers, fewer do not hide the latency of an operation.
const BLOCK: usize = 4;
const BLOCKS: usize = 8;

/// The most elements of a row, and the fewest for which a row pays: it takes as long as some five elements one by one.
pub(crate) const ROW: usize = BLOCK * BLOCKS;
pub(crate) const WORTH_A_ROW: usize = 6;

/// A file of zeros.
const fn empty<const P: usize, const B: usize, const Q: usize>() -> File<B, Q, P> {
    [[[0.0; B]; Q]; P]
}

thread_local! {
    /// Files for rows, kept because filling them with zeros took a fifth of a step.
    static SMALL_ROWS: RefCell<Box<File<BLOCK, BLOCKS, SMALL>>> = RefCell::new(Box::new(empty()));
    static MEDIUM_ROWS: RefCell<Box<File<BLOCK, BLOCKS, MEDIUM>>> = RefCell::new(Box::new(empty()));
}

/// Instructions for some values of a program.
///
/// Registers hold first the constants, then the inputs, then results.
#[derive(Debug)]
pub(crate) struct Tape {
    constants: Box<[f64]>,
    inputs: usize,
    instructions: Box<[Instruction]>,
    outputs: Box<[Register]>,
    registers: usize,
}

impl Tape {
    /// The tape for these values.
    pub(crate) fn new(wanted: &Wanted<'_>) -> Result<Self, LawError> {
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

    /// Evaluates the tape. Its inputs are the slices `inputs` in sequence, its results go to the slices `results` in sequence.
    #[inline]
    pub(crate) fn run<const I: usize, const O: usize>(
        &self,
        inputs: [&[f64]; I],
        results: [&mut [f64]; O],
    ) {
        let read = |_| inputs;
        let one = &mut [results];
        if self.registers <= SMALL {
            self.run_in(&mut empty::<SMALL, 1, 1>(), read, one, each_of);
        } else if self.registers <= MEDIUM {
            self.run_in(&mut empty::<MEDIUM, 1, 1>(), read, one, each_of);
        } else if self.registers <= LARGE {
            self.run_in(&mut empty::<LARGE, 1, 1>(), read, one, each_of);
        } else {
            self.run_in(&mut empty::<LARGEST, 1, 1>(), read, one, each_of);
        }
    }

    /// The same for at most [`ROW`] elements, given by their indices: each instruction for a row of them, with the same bits.
    pub(crate) fn run_rows<'a, R, const I: usize, const O: usize>(
        &self,
        inputs: impl Fn(usize) -> [&'a [f64]; I],
        results: &mut [R],
        parts: impl Fn(&mut R) -> [&mut [f64]; O],
    ) where
        f64: 'a,
    {
        debug_assert!(results.len() <= ROW, "a row");
        if results.len() >= WORTH_A_ROW && self.registers <= SMALL {
            SMALL_ROWS.with_borrow_mut(|file| self.run_in(file, inputs, results, parts));
        } else if results.len() >= WORTH_A_ROW && self.registers <= MEDIUM {
            MEDIUM_ROWS.with_borrow_mut(|file| self.run_in(file, inputs, results, parts));
        } else {
            for (element, result) in results.iter_mut().enumerate() {
                self.run(inputs(element), parts(result));
            }
        }
    }

    /// The same in a file of `P` registers, each of `Q` blocks of `B` numbers, one per element, with any numbers in it.
    fn run_in<
        'a,
        const P: usize,
        const B: usize,
        const Q: usize,
        R,
        const I: usize,
        const O: usize,
    >(
        &self,
        file: &mut File<B, Q, P>,
        inputs: impl Fn(usize) -> [&'a [f64]; I],
        results: &mut [R],
        parts: impl Fn(&mut R) -> [&mut [f64]; O],
    ) where
        f64: 'a,
    {
        const { assert!(P.is_power_of_two()) };
        if B * Q == 1 {
            self.load_one(file.as_flattened_mut().as_flattened_mut(), inputs(0));
        } else {
            self.load_row(file, results.len() - 1, inputs);
        }
        self.execute(file);
        for (element, result) in results.iter_mut().enumerate() {
            let mut outputs = self.outputs.iter();
            for part in parts(result) {
                for (number, &output) in part.iter_mut().zip(&mut outputs) {
                    *number = file[usize::from(output) & (P - 1)][element / B][element % B];
                }
            }
        }
    }

    /// Writes the constants, and the inputs of one element, to the registers.
    #[inline]
    fn load_one<const I: usize>(&self, registers: &mut [f64], inputs: [&[f64]; I]) {
        let mut first = self.constants.len();
        registers[..first].copy_from_slice(&self.constants);
        for input in inputs {
            registers[first..first + input.len()].copy_from_slice(input);
            first += input.len();
        }
        debug_assert_eq!(first, self.constants.len() + self.inputs, "all inputs");
    }

    /// The same of a row of elements, of which the last is the one at `last`.
    fn load_row<'a, const P: usize, const B: usize, const Q: usize, const I: usize>(
        &self,
        file: &mut File<B, Q, P>,
        last: usize,
        inputs: impl Fn(usize) -> [&'a [f64]; I],
    ) where
        f64: 'a,
    {
        for (register, &constant) in file.iter_mut().zip(&self.constants) {
            *register = [[constant; B]; Q];
        }
        let first = self.constants.len();
        for element in 0..B * Q {
            let mut registers = file[first..first + self.inputs].iter_mut();
            // Beyond the last element its inputs are repeated, and the results are not used.
            for input in inputs(element.min(last)) {
                for (&number, register) in input.iter().zip(registers.by_ref()) {
                    register[element / B][element % B] = number;
                }
            }
            debug_assert_eq!(registers.len(), 0, "an input is missing");
        }
    }

    /// Executes the instructions. Not inlined: it is large, and this way compiled once for each size of the file.
    #[inline(never)]
    fn execute<const P: usize, const B: usize, const Q: usize>(&self, file: &mut File<B, Q, P>) {
        for instruction in &self.instructions {
            instruction.execute(file);
        }
    }
}

/// The results of one element.
fn each_of<'a, const O: usize>(results: &'a mut [&mut [f64]; O]) -> [&'a mut [f64]; O] {
    results.each_mut().map(|part| &mut **part)
}
