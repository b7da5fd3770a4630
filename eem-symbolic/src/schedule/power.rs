//! A product of powers as numerator over denominator.

use super::builder::{Builder, Operand, Signed};
use crate::node::ExprId;
use crate::number::{Number, Rational};
use crate::program::Operation;

const ONE: Operand = Operand::Number(Number::ONE);

/// How a constant exponent r ≠ 0 is evaluated.
enum Exponent {
    /// `xⁿ √x` or `xⁿ`, in the numerator if r > 0 and in the denominator if r < 0.
    Algebraic { whole: i32, root: bool },
    /// `xʳ` by the general power.
    General,
}

impl Builder<'_> {
    /// `Π base ^ exponent`: one division, or products with reciprocals.
    pub(super) fn product(&mut self, factors: &[(ExprId, Rational)]) -> Signed {
        let (mut numerator, mut denominator) = (Vec::new(), Vec::new());
        let mut negative = false;
        for &(base, exponent) in factors {
            match classify(exponent) {
                Exponent::Algebraic { whole, root } => {
                    let base = if root {
                        self.done(base).into()
                    } else {
                        self.signed(base)
                    };
                    negative ^= base.negative && whole % 2 == 1;
                    if !exponent.is_negative() {
                        numerator.push(self.algebraic(base.operand, whole, root));
                    } else if self.reciprocals {
                        let inverse = self.reciprocal(base.operand);
                        numerator.push(self.algebraic(inverse, whole, root));
                    } else {
                        denominator.push(self.algebraic(base.operand, whole, root));
                    }
                }
                Exponent::General => {
                    let base = self.done(base);
                    let exponent = Operand::Number(Number::Exact(exponent));
                    numerator.push(self.emit([base, exponent], |[a, b]| Operation::Power(a, b)));
                }
            }
        }
        let numerator = self.multiply(numerator);
        let operand = match self.multiply(denominator) {
            Some(denominator) => self.emit([numerator.unwrap_or(ONE), denominator], |[a, b]| {
                Operation::Div(a, b)
            }),
            None => numerator.unwrap_or(ONE),
        };
        Signed { negative, operand }
    }

    fn reciprocal(&mut self, x: Operand) -> Operand {
        self.emit([ONE, x], |[a, b]| Operation::Div(a, b))
    }

    /// `xⁿ` or `xⁿ √x`, n ≥ 0.
    fn algebraic(&mut self, x: Operand, whole: i32, root: bool) -> Operand {
        let power = match whole {
            0 => None,
            1 => Some(x),
            2 => Some(self.mul(x, x)),
            n => Some(self.emit([x], |[x]| Operation::Powi(x, n))),
        };
        let root = root.then(|| self.emit([x], |[x]| Operation::Sqrt(x)));
        let factors = power.into_iter().chain(root).collect();
        self.multiply(factors).unwrap_or(ONE)
    }

    /// The product of factors; what depends on parameters alone comes first.
    fn multiply(&mut self, mut factors: Vec<Operand>) -> Option<Operand> {
        factors.sort_by_key(|&factor| self.is_of_state(factor));
        let mut factors = factors.into_iter();
        let first = factors.next()?;
        Some(factors.fold(first, |product, factor| self.mul(product, factor)))
    }
}

fn classify(exponent: Rational) -> Exponent {
    let magnitude = exponent.numerator().abs();
    let whole = match exponent.denominator() {
        1 => i32::try_from(magnitude).ok(),
        2 => i32::try_from((magnitude - 1) / 2).ok(),
        _ => None,
    };
    match whole {
        Some(whole) => Exponent::Algebraic {
            whole,
            root: exponent.denominator() == 2,
        },
        None => Exponent::General,
    }
}
