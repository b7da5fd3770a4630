//! Divided differences as instructions, computed from function values at the ends where that loses no digits.
//!
//! ```text
//! recip[a, b] = −(1/a)(1/b)        recip[a, b, b] = (1/a)(1/b)(1/b)
//! sqrt[a, b]  = r = 1/(√a + √b)    sqrt[a, b, b]  = −½ r² (1/√b)
//! exp[a, b]   from eᵃ and eᵇ
//! ```
//!
//! Values belong to one end, and all differences that end there share them; those at the old state
//! are computed once per step.

use super::builder::{Builder, Operand, Signed};
use crate::function::Function;
use crate::node::{ExprId, Kernel};
use crate::number::Number;
use crate::operation::{Operation, ProgramKernel, Value};

/// The constructor of a first or a second divided difference.
type Difference = fn(ProgramKernel, Value, Value) -> Operation;

impl Builder<'_> {
    /// `f[a, b]`.
    pub(super) fn divided_difference(&mut self, kernel: Kernel, a: ExprId, b: ExprId) -> Signed {
        let [a, b] = [self.done(a), self.done(b)];
        match kernel {
            Kernel::Recip => {
                let [inverse_a, inverse_b] = [a, b].map(|x| self.reciprocal(x));
                negated(self.mul(inverse_a, inverse_b))
            }
            Kernel::Sqrt => self.root_difference(a, b).into(),
            Kernel::Function(_) | Kernel::Powi(_) | Kernel::Powf(_) => {
                self.difference(kernel, a, b, Operation::DividedDifference)
            }
        }
    }

    /// `f[a, b, b]`.
    pub(super) fn second_divided_difference(
        &mut self,
        kernel: Kernel,
        a: ExprId,
        b: ExprId,
    ) -> Signed {
        let [a, b] = [self.done(a), self.done(b)];
        match kernel {
            Kernel::Recip => {
                let [inverse_a, inverse_b] = [a, b].map(|x| self.reciprocal(x));
                let first = self.mul(inverse_a, inverse_b);
                self.mul(first, inverse_b).into()
            }
            Kernel::Sqrt => {
                let first = self.root_difference(a, b);
                let square = self.mul(first, first);
                let root = self.emit([b], |[b]| Operation::Sqrt(b));
                let inverse = self.reciprocal(root);
                let half = self.mul(Operand::Number(Number::HALF), inverse);
                negated(self.mul(square, half))
            }
            Kernel::Function(_) | Kernel::Powi(_) | Kernel::Powf(_) => {
                self.difference(kernel, a, b, Operation::SecondDividedDifference)
            }
        }
    }

    /// `1/(√a + √b)`.
    fn root_difference(&mut self, a: Operand, b: Operand) -> Operand {
        let [a, b] = [a, b].map(|x| self.emit([x], |[x]| Operation::Sqrt(x)));
        let sum = self.add(a, b);
        self.reciprocal(sum)
    }

    fn difference(&mut self, kernel: Kernel, a: Operand, b: Operand, of: Difference) -> Signed {
        let plain = match kernel {
            Kernel::Function(Function::Exp | Function::ExpM1) => {
                let exp = Function::Exp;
                let [value_a, value_b] =
                    [a, b].map(|x| self.emit([x], |[x]| Operation::Apply(exp, x)));
                return self.exponential([value_a, value_b], [a, b], of).into();
            }
            Kernel::Function(function) => ProgramKernel::Function(function),
            Kernel::Sqrt => ProgramKernel::Sqrt,
            Kernel::Recip => ProgramKernel::Powi(-1),
            Kernel::Powi(n) => ProgramKernel::Powi(n),
            Kernel::Powf(exponent) => {
                let exponent = self.done(exponent);
                let difference = self.emit([exponent, a, b], |[exponent, a, b]| {
                    of(ProgramKernel::Powf(exponent), a, b)
                });
                return difference.into();
            }
        };
        self.emit([a, b], |[a, b]| of(plain, a, b)).into()
    }

    fn exponential(&mut self, values: [Operand; 2], ends: [Operand; 2], of: Difference) -> Operand {
        let ([value_a, value_b], [a, b]) = (values, ends);
        self.emit([value_a, value_b, a, b], |[value_a, value_b, a, b]| {
            of(ProgramKernel::Power(value_a, value_b), a, b)
        })
    }

    /// `exp[X_a, X_b]` for powers with the logarithms X.
    pub(super) fn power_difference(
        &mut self,
        values: [ExprId; 2],
        logarithms: [ExprId; 2],
    ) -> Operand {
        let values = values.map(|value| self.done(value));
        let ends = logarithms.map(|logarithm| self.done(logarithm));
        self.exponential(values, ends, Operation::DividedDifference)
    }
}

fn negated(operand: Operand) -> Signed {
    let negative = true;
    Signed { negative, operand }
}
