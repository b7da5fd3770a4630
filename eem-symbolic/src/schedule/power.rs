//! A product of powers as numerator over denominator.

use super::builder::{Builder, Operand, Signed};
use super::plan::Factor;
use super::sharing::Token;
use crate::node::ExprId;
use crate::number::{Number, Rational};
use crate::operation::Operation;

const ONE: Operand = Operand::Number(Number::ONE);

/// How a constant exponent r ≠ 0 is evaluated.
enum Exponent {
    /// `xⁿ √x` or `xⁿ`, in the numerator if r > 0 and in the denominator if r < 0.
    Algebraic { whole: i32, root: bool },
    /// `xʳ` by the general power.
    General,
}

impl Builder<'_> {
    /// `Π base ^ exponent`.
    pub(super) fn product(&mut self, e: ExprId, factors: &[(ExprId, Rational)]) -> Signed {
        if let Some(product) = self.planned_product(Number::ONE, e) {
            return product;
        }
        let plan = self.plan.as_ref();
        let whole = plan.is_none_or(|plan| plan.arguments.contains(&e));
        self.in_order(Number::ONE, factors, whole)
    }

    /// `coefficient · e` for a product e that has been planned.
    pub(super) fn planned_product(&mut self, coefficient: Number, e: ExprId) -> Option<Signed> {
        let entries = self.plan.as_ref()?.factors(coefficient, e)?;
        if let Some(&product) = self.scaled.get(&(coefficient, e)) {
            return Some(product);
        }
        let factors: Vec<_> = entries
            .iter()
            .map(|entry| self.planned_factor(entry.token))
            .collect();
        let negative = factors
            .iter()
            .fold(false, |sign, factor| sign ^ factor.negative);
        let operands = factors.into_iter().map(|factor| factor.operand).collect();
        let operand = self.multiply(operands).unwrap_or(ONE);
        let product = Signed { negative, operand };
        self.scaled.insert((coefficient, e), product);
        Some(product)
    }

    fn planned_factor(&mut self, token: Token) -> Signed {
        if let Some(&factor) = self.factors.get(&token) {
            return factor;
        }
        let plan = self.plan.as_ref().expect("tokens are those of a plan");
        let factor = if let Some(pair) = plan.products.sharing.pair(token) {
            let [a, b] = [pair.first, pair.second].map(|token| self.planned_factor(token));
            let operand = self.mul(a.operand, b.operand);
            let negative = a.negative != b.negative;
            Signed { negative, operand }
        } else {
            match plan.products.leaf(token).cloned() {
                Some(Factor::Power(base, exponent)) => {
                    self.in_order(Number::ONE, &[(base, exponent)], false)
                }
                Some(Factor::Hoisted(coefficient, factors)) => {
                    self.in_order(coefficient, &factors, false)
                }
                None => unreachable!("a token is a pair or a factor"),
            }
        };
        self.factors.insert(token, factor);
        factor
    }

    /// `coefficient · Π base ^ exponent` in structural order: divided once as a whole, or multiplied
    /// by reciprocals.
    fn in_order(
        &mut self,
        coefficient: Number,
        factors: &[(ExprId, Rational)],
        whole: bool,
    ) -> Signed {
        let (mut numerator, mut denominator) = (Vec::new(), Vec::new());
        if coefficient != Number::ONE {
            numerator.push(Operand::Number(coefficient));
        }
        let mut negative = false;
        for &(base, exponent) in factors {
            match classify(exponent) {
                Exponent::Algebraic { whole: n, root } => {
                    let base = if root {
                        self.done(base).into()
                    } else {
                        self.signed(base)
                    };
                    negative ^= base.negative && n % 2 == 1;
                    if !exponent.is_negative() {
                        numerator.push(self.algebraic(base.operand, n, root));
                    } else if whole {
                        denominator.push(self.algebraic(base.operand, n, root));
                    } else {
                        self.inverse_algebraic(base.operand, n, root, &mut numerator);
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

    /// `1/x`.
    pub(super) fn reciprocal(&mut self, x: Operand) -> Operand {
        self.emit([ONE, x], |[a, b]| Operation::Div(a, b))
    }

    /// `x⁻ⁿ` or `x⁻ⁿ/√x`, n ≥ 0, as factors.
    fn inverse_algebraic(&mut self, x: Operand, n: i32, root: bool, factors: &mut Vec<Operand>) {
        if n > 0 {
            let inverse = self.reciprocal(x);
            factors.push(self.algebraic(inverse, n, false));
        }
        if root {
            let root = self.algebraic(x, 0, true);
            factors.push(self.reciprocal(root));
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
