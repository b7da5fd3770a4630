//! The operations that a tape needs, in order, with products joined to the operations that read them.

use std::collections::BTreeMap;

use eem_symbolic::{Operation, Program, Value};

use super::fold::Folded;
use super::instruction::Action;

/// The program of a tape, with its inputs and outputs.
pub(crate) struct Wanted<'p> {
    pub(crate) program: &'p Program,
    /// The values that depend on parameters alone.
    pub(crate) folded: &'p [Folded],
    /// The values that are inputs of the tape, with their indices among these.
    pub(crate) known: BTreeMap<Value, usize>,
    /// Number of inputs.
    pub(crate) inputs: usize,
    pub(crate) outputs: &'p [Value],
}

/// An action that computes a value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub(super) value: Value,
    pub(super) action: Action<Value>,
}

/// The lines of a tape. Their operands are values of the program; folded values and inputs of the tape have no line.
pub(super) fn lower(wanted: &Wanted<'_>) -> Vec<Line> {
    let needed = needed(wanted);
    let instructions = wanted.program.instructions.iter().enumerate();
    let lines = instructions.filter(|(index, _)| needed[*index]);
    let mut lines: Vec<Line> = lines
        .filter_map(|(index, instruction)| {
            Some(Line {
                value: Value::new(index),
                action: action(&instruction.operation)?,
            })
        })
        .collect();
    fuse(&mut lines, wanted);
    lines
}

/// Which values have to be computed.
fn needed(wanted: &Wanted<'_>) -> Vec<bool> {
    let mut needed = vec![false; wanted.program.instructions.len()];
    let is_given = |value: Value| {
        wanted.known.contains_key(&value) || !matches!(wanted.folded[value.index()], Folded::No)
    };
    for &output in wanted.outputs {
        needed[output.index()] = !is_given(output);
    }
    for index in (0..needed.len()).rev() {
        if needed[index] {
            for operand in wanted.program.instructions[index].operation.operands() {
                needed[operand.index()] = !is_given(operand);
            }
        }
    }
    needed
}

/// The action of an operation; `None` for inputs, constants and parts, which have registers without one.
fn action(operation: &Operation) -> Option<Action<Value>> {
    Some(match *operation {
        Operation::Input(_) | Operation::Constant(_) | Operation::Part(..) => return None,
        Operation::Add(a, b) => Action::Add(a, b),
        Operation::Sub(a, b) => Action::Sub(a, b),
        Operation::Mul(a, b) => Action::Mul(a, b),
        Operation::Div(a, b) => Action::Div(a, b),
        Operation::Neg(a) => Action::Neg(a),
        Operation::Powi(a, n) => Action::Powi(a, n),
        Operation::Sqrt(a) => Action::Sqrt(a),
        Operation::Power(a, b) => Action::Power(a, b),
        Operation::Apply(function, a) => Action::Apply(function, a),
        Operation::DividedDifference(f, a, b) => Action::First(f, a, b),
        Operation::SecondDividedDifference(f, a, b) => Action::Second(f, a, b),
        Operation::JointDifferences(f, a, b) => Action::Joint(f, a, b),
    })
}

/// Joins every product with one reader to a sum, difference or product that reads it.
fn fuse(lines: &mut Vec<Line>, wanted: &Wanted<'_>) {
    let count = wanted.program.instructions.len();
    let mut readers = vec![0_usize; count];
    let mut place = vec![None; count];
    for (index, line) in lines.iter().enumerate() {
        place[line.value.index()] = Some(index);
        line.action
            .operands(|operand| readers[operand.index()] += 1);
    }
    for output in wanted.outputs {
        readers[output.index()] += 1;
    }
    let mut is_joined = vec![false; lines.len()];
    for index in 0..lines.len() {
        // The product, if it has no other reader.
        let mut product = |value: Value| {
            let at = place[value.index()].filter(|_| readers[value.index()] == 1)?;
            let Line {
                action: Action::Mul(a, b),
                ..
            } = lines[at]
            else {
                return None;
            };
            is_joined[at] = true;
            Some((a, b))
        };
        let joined = match lines[index].action {
            Action::Add(a, b) => match product(b) {
                Some((c, d)) => Some(Action::MulAdd(c, d, a)),
                None => product(a).map(|(c, d)| Action::MulAdd(c, d, b)),
            },
            Action::Sub(a, b) => match product(b) {
                Some((c, d)) => Some(Action::SubMul(c, d, a)),
                None => product(a).map(|(c, d)| Action::MulSub(c, d, b)),
            },
            Action::Mul(a, b) => match product(b) {
                Some((c, d)) => Some(Action::MulMul(c, d, a)),
                None => product(a).map(|(c, d)| Action::MulMul(c, d, b)),
            },
            _ => None,
        };
        if let Some(joined) = joined {
            lines[index].action = joined;
        }
    }
    let mut is_joined = is_joined.into_iter();
    lines.retain(|_| is_joined.next() != Some(true));
}
