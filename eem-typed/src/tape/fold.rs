//! Constant folding: values that depend on parameters alone are computed once, by the methods that generated code calls.

use eem_material::kernel::Differences;
use eem_material::number::scalar::Scalar;
use eem_symbolic::{DifferencePart, Operation, Program, ProgramKernel, Value};

use super::instruction::{apply, first, joint, second};

/// A value, if it depends on parameters alone.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Folded {
    /// It depends on the state.
    No,
    Number(f64),
    Differences(Differences<f64>),
}

impl Folded {
    /// The number, unless it depends on the state.
    pub(crate) fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            Self::No | Self::Differences(_) => None,
        }
    }
}

/// The values of a program whose first inputs are these parameters.
pub(crate) fn fold(program: &Program, parameters: &[f64]) -> Vec<Folded> {
    let mut folded = Vec::with_capacity(program.instructions.len());
    for instruction in &program.instructions {
        let value = evaluate(&instruction.operation, parameters, &folded);
        folded.push(value.unwrap_or(Folded::No));
    }
    folded
}

/// The value of an operation, if all its operands are known.
fn evaluate(operation: &Operation, parameters: &[f64], folded: &[Folded]) -> Option<Folded> {
    let of = |value: Value| folded[value.index()].number();
    Some(Folded::Number(match *operation {
        Operation::Input(index) => *parameters.get(index)?,
        Operation::Constant(number) => number.to_f64(),
        Operation::Add(a, b) => of(a)? + of(b)?,
        Operation::Sub(a, b) => of(a)? - of(b)?,
        Operation::Mul(a, b) => of(a)? * of(b)?,
        Operation::Div(a, b) => of(a)? / of(b)?,
        Operation::Neg(a) => -of(a)?,
        Operation::Powi(a, n) => Scalar::powi(of(a)?, n),
        Operation::Sqrt(a) => of(a)?.sqrt(),
        Operation::Power(a, b) => Scalar::powf(of(a)?, of(b)?),
        Operation::Apply(function, a) => apply(function, of(a)?),
        Operation::DividedDifference(f, a, b) => first(kernel(f, of)?, of(a)?, of(b)?),
        Operation::SecondDividedDifference(f, a, b) => second(kernel(f, of)?, of(a)?, of(b)?),
        Operation::JointDifferences(f, a, b) => {
            let all = joint(kernel(f, of)?, of(a)?, of(b)?);
            return Some(Folded::Differences(all));
        }
        Operation::Part(call, part) => {
            let Folded::Differences(all) = folded[call.index()] else {
                return None;
            };
            match part {
                DifferencePart::First => all.first,
                DifferencePart::SecondA => all.second_a,
                DifferencePart::SecondB => all.second_b,
            }
        }
    }))
}

/// The function of a difference, if the values that it depends on are known.
fn kernel(f: ProgramKernel, of: impl Fn(Value) -> Option<f64>) -> Option<ProgramKernel<f64>> {
    Some(match f {
        ProgramKernel::Function(function) => ProgramKernel::Function(function),
        ProgramKernel::Powi(n) => ProgramKernel::Powi(n),
        ProgramKernel::Sqrt => ProgramKernel::Sqrt,
        ProgramKernel::Powf(exponent) => ProgramKernel::Powf(of(exponent)?),
        ProgramKernel::Power(value_a, value_b) => ProgramKernel::Power(of(value_a)?, of(value_b)?),
    })
}
