//! Divided differences of one function between the same ends become one call.
//!
//! ```text
//! v₇ = ln[v₃, v₅]               v₇ = (ln[v₃, v₅], ln[v₃, v₃, v₅], ln[v₃, v₅, v₅])
//! v₈ = v₆ v₇              →     v₈ = v₇.first
//! v₉ = ln[v₃, v₅, v₅]           v₉ = v₆ v₈
//!                               v₁₀ = v₇.second_b
//! ```
//!
//! Only where at least two of them are needed, and only for functions whose differences share most
//! of their work ([`ProgramKernel::has_joint_call`]). The order of the instructions stays.

use std::collections::{BTreeMap, BTreeSet};

use crate::operation::{DifferencePart, Operation, ProgramKernel, Value};
use crate::program::{Instruction, Program, Stage};

/// A program for some outputs of another one.
#[derive(Clone, Debug, PartialEq)]
pub struct Restriction {
    /// The smaller program.
    pub program: Program,
    /// For each value of the smaller program, the value of the larger one that has the same bits;
    /// `None` for joint differences.
    pub origins: Vec<Option<Value>>,
}

/// A function and two ends, the earlier value first.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Pair {
    kernel: ProgramKernel,
    ends: [Value; 2],
}

impl Pair {
    fn new(kernel: ProgramKernel, a: Value, b: Value) -> Self {
        if a <= b {
            let ends = [a, b];
            return Self { kernel, ends };
        }
        Self {
            kernel: kernel.mirrored(),
            ends: [b, a],
        }
    }
}

/// One divided difference, whichever end it was written with first.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Wanted {
    pair: Pair,
    part: DifferencePart,
}

impl Wanted {
    /// The difference that an instruction computes, if its kernel has a joint call.
    fn of(operation: &Operation) -> Option<Self> {
        let (kernel, a, b, part) = match *operation {
            Operation::DividedDifference(kernel, a, b) => (kernel, a, b, DifferencePart::First),
            Operation::SecondDividedDifference(kernel, a, b) if a <= b => {
                (kernel, a, b, DifferencePart::SecondB)
            }
            Operation::SecondDividedDifference(kernel, a, b) => {
                (kernel, a, b, DifferencePart::SecondA)
            }
            Operation::Input(_)
            | Operation::Constant(_)
            | Operation::Add(..)
            | Operation::Sub(..)
            | Operation::Mul(..)
            | Operation::Div(..)
            | Operation::Neg(_)
            | Operation::Powi(..)
            | Operation::Sqrt(_)
            | Operation::Power(..)
            | Operation::Apply(..)
            | Operation::JointDifferences(..)
            | Operation::Part(..) => return None,
        };
        let pair = Pair::new(kernel, a, b);
        kernel.has_joint_call().then_some(Self { pair, part })
    }
}

impl Program {
    /// The program of the first `outputs` outputs: the same instructions in the same order, without
    /// those that only the others depend on. Where one of several joint differences is left, it is
    /// computed alone.
    ///
    /// # Panics
    ///
    /// If there are fewer outputs.
    #[must_use]
    pub fn restricted_to(&self, outputs: usize) -> Restriction {
        let needed = self.needed_by(&self.outputs[..outputs]);
        let kept: Vec<usize> = (0..needed.len()).filter(|&index| needed[index]).collect();
        let all = self.in_order(&kept, outputs);
        let alone = Rewriting::alone(&all);
        let joint = Rewriting::joint(&alone.program);
        let mut origins = vec![None; joint.program.instructions.len()];
        for (moved, &origin) in alone.moved.iter().zip(&kept) {
            let moved = moved.and_then(|value| joint.moved[value.index()]);
            if let Some(value) = moved {
                origins[value.index()] = Some(Value::new(origin));
            }
        }
        let program = joint.program;
        Restriction { program, origins }
    }

    /// The same with every divided difference in an instruction of its own.
    pub(crate) fn alone(&self) -> Program {
        Rewriting::alone(self).program
    }

    /// The same with one call for the differences of one function between the same ends.
    pub(crate) fn with_joint_differences(&self) -> Program {
        Rewriting::joint(self).program
    }
}

/// A program that is written anew, instruction by instruction.
struct Rewriting {
    program: Program,
    /// For each instruction of the old program, its value in the new one.
    moved: Vec<Option<Value>>,
}

impl Rewriting {
    fn new(old: &Program) -> Self {
        Self {
            program: Program {
                inputs: old.inputs.clone(),
                instructions: Vec::new(),
                outputs: Vec::new(),
            },
            moved: Vec::new(),
        }
    }

    /// Every difference in an instruction of its own.
    fn alone(old: &Program) -> Self {
        let mut new = Self::new(old);
        for Instruction { operation, stage } in &old.instructions {
            let value = match *operation {
                Operation::JointDifferences(..) => None,
                Operation::Part(call, part) => {
                    let call = &old.instructions[call.index()].operation;
                    Some(new.push(&alone(call, part), *stage))
                }
                _ => Some(new.push(operation, *stage)),
            };
            new.moved.push(value);
        }
        new.finish(old)
    }

    /// One call for all differences of one function between the same ends.
    fn joint(old: &Program) -> Self {
        let mut new = Self::new(old);
        let mut calls = calls(old);
        let mut parts = BTreeMap::new();
        for Instruction { operation, stage } in &old.instructions {
            let wanted = Wanted::of(operation);
            let value = match wanted.and_then(|wanted| Some((calls.get_mut(&wanted.pair)?, wanted)))
            {
                None => new.push(operation, *stage),
                Some((call, wanted)) => {
                    let of = *call
                        .value
                        .get_or_insert_with(|| new.push(&call.operation, *stage));
                    let part = if call.is_mirrored {
                        wanted.part.mirrored()
                    } else {
                        wanted.part
                    };
                    *parts
                        .entry(wanted)
                        .or_insert_with(|| new.push_as_it_is(Operation::Part(of, part), *stage))
                }
            };
            new.moved.push(Some(value));
        }
        new.finish(old)
    }

    /// Appends an operation on values of the old program.
    fn push(&mut self, operation: &Operation, stage: Stage) -> Value {
        let moved = |value: Value| {
            let moved = self.moved[value.index()];
            moved.expect("joint differences are read by their parts alone")
        };
        let operation = operation.map(moved);
        self.push_as_it_is(operation, stage)
    }

    fn push_as_it_is(&mut self, operation: Operation, stage: Stage) -> Value {
        let instructions = &mut self.program.instructions;
        instructions.push(Instruction { operation, stage });
        Value::new(instructions.len() - 1)
    }

    fn finish(mut self, old: &Program) -> Self {
        let outputs = old.outputs.iter().map(|output| self.moved[output.index()]);
        let outputs: Option<_> = outputs.collect();
        self.program.outputs = outputs.expect("an output is a number");
        self
    }
}

/// A call for several differences.
struct Call {
    /// The joint differences, with values of the old program.
    operation: Operation,
    /// Whether its ends are in the opposite order of those of the [`Pair`].
    is_mirrored: bool,
    /// Its value, once it has been written.
    value: Option<Value>,
}

/// A call for every pair of ends between which several differences are needed, with its ends in the
/// order of the first of these differences.
fn calls(program: &Program) -> BTreeMap<Pair, Call> {
    let mut parts: BTreeMap<Pair, BTreeSet<DifferencePart>> = BTreeMap::new();
    let mut calls = BTreeMap::new();
    for Instruction { operation, .. } in &program.instructions {
        let (Operation::DividedDifference(kernel, a, b)
        | Operation::SecondDividedDifference(kernel, a, b)) = *operation
        else {
            continue;
        };
        if let Some(Wanted { pair, part }) = Wanted::of(operation) {
            calls.entry(pair.clone()).or_insert_with(|| Call {
                operation: Operation::JointDifferences(kernel, a, b),
                is_mirrored: b < a,
                value: None,
            });
            parts.entry(pair).or_default().insert(part);
        }
    }
    calls.retain(|pair, _| parts[pair].len() > 1);
    calls
}

/// A part of a joint call as an operation of its own.
fn alone(call: &Operation, part: DifferencePart) -> Operation {
    let Operation::JointDifferences(kernel, a, b) = *call else {
        unreachable!("parts are those of joint differences")
    };
    match part {
        DifferencePart::First => Operation::DividedDifference(kernel, a, b),
        DifferencePart::SecondA => Operation::SecondDividedDifference(kernel.mirrored(), b, a),
        DifferencePart::SecondB => Operation::SecondDividedDifference(kernel, a, b),
    }
}
