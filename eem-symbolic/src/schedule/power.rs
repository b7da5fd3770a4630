//! A product of powers as numerator over denominator.

use super::builder::{Builder, Operand};
use crate::node::ExprId;
use crate::number::{Number, Rational};
use crate::program::Operation;

/// How a constant exponent r ≠ 0 is evaluated.
enum Exponent {
    /// `xⁿ √x` or `xⁿ`, in the numerator if r > 0 and in the denominator if r < 0.
    Algebraic { whole: i32, root: bool },
    /// `xʳ` by the general power.
    General,
}

impl Builder<'_> {
    /// `Π base ^ exponent`.
    pub(super) fn product(&mut self, factors: &[(ExprId, Rational)]) -> Operand {
        let (mut numerator, mut denominator) = (Vec::new(), Vec::new());
        for &(base, exponent) in factors {
            let base = self.done(base);
            match classify(exponent) {
                Exponent::Algebraic { whole, root } => {
                    let power = self.algebraic(base, whole, root);
                    let side = if exponent.is_negative() { &mut denominator } else { &mut numerator };
                    side.push(power);
                }
                Exponent::General => {
                    let exponent = Operand::Number(Number::Exact(exponent));
                    numerator.push(self.emit([base, exponent], |[a, b]| Operation::Power(a, b)));
                }
            }
        }
        let numerator = self.multiply(numerator);
        let denominator = self.multiply(denominator);
        match (numerator, denominator) {
            (Some(numerator), None) => numerator,
            (None, None) => Operand::Number(Number::ONE),
            (numerator, Some(denominator)) => {
                let numerator = numerator.unwrap_or(Operand::Number(Number::ONE));
                self.emit([numerator, denominator], |[a, b]| Operation::Div(a, b))
            }
        }
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
        self.multiply(factors).unwrap_or(Operand::Number(Number::ONE))
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
