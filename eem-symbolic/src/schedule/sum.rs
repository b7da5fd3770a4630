//! A sum as additions and subtractions.

use super::builder::{Builder, Operand};
use crate::node::ExprId;
use crate::number::Number;
use crate::program::Operation;

impl Builder<'_> {
    /// `constant + Σ coefficient · term`.
    pub(super) fn sum(&mut self, constant: Number, terms: &[(Number, ExprId)]) -> Operand {
        if let Some(common) = common_magnitude(constant, terms) {
            let terms = terms.iter().map(|&(coefficient, term)| {
                let sign = if coefficient.is_negative() { Number::MINUS_ONE } else { Number::ONE };
                (sign, self.done(term))
            });
            let sum = terms.collect();
            let sum = self.accumulate(sum);
            return self.mul(Operand::Number(common), sum);
        }
        let mut summands = Vec::with_capacity(terms.len() + 1);
        if !constant.is_zero() {
            let sign = if constant.is_negative() { Number::MINUS_ONE } else { Number::ONE };
            summands.push((sign, Operand::Number(constant.abs())));
        }
        for &(coefficient, term) in terms {
            summands.push(self.scaled(coefficient, term));
        }
        self.accumulate(summands)
    }

    /// Sign and magnitude of `coefficient · term`.
    fn scaled(&mut self, coefficient: Number, term: ExprId) -> (Number, Operand) {
        let term = self.done(term);
        let sign = if coefficient.is_negative() { Number::MINUS_ONE } else { Number::ONE };
        let magnitude = coefficient.abs();
        if magnitude == Number::ONE {
            (sign, term)
        } else {
            (sign, self.mul(Operand::Number(magnitude), term))
        }
    }

    /// Adds up summands with coefficients ±1; what depends on parameters alone comes first.
    fn accumulate(&mut self, mut summands: Vec<(Number, Operand)>) -> Operand {
        summands.sort_by_key(|&(_, summand)| self.is_of_state(summand));
        // Starting with a positive summand saves a change of sign.
        let positive = summands.iter().position(|(sign, _)| !sign.is_negative());
        let (_, first) = summands.remove(positive.unwrap_or(0));
        let mut sum = first;
        for (sign, summand) in summands {
            sum = if sign.is_negative() && positive.is_some() {
                self.emit([sum, summand], |[a, b]| Operation::Sub(a, b))
            } else {
                self.add(sum, summand)
            };
        }
        if positive.is_some() {
            sum
        } else {
            self.emit([sum], |[a]| Operation::Neg(a))
        }
    }
}

/// The magnitude c of all coefficients, if it is one other than 1 and there is something to factor.
fn common_magnitude(constant: Number, terms: &[(Number, ExprId)]) -> Option<Number> {
    let ((first, _), others) = terms.split_first()?;
    let magnitude = first.abs();
    let common = others.iter().all(|(coefficient, _)| coefficient.abs() == magnitude);
    let factored = !others.is_empty() && constant.is_zero() && magnitude != Number::ONE;
    (common && factored).then_some(magnitude)
}
