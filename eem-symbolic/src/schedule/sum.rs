//! A sum as additions and subtractions.

use super::builder::{Builder, Operand, Signed};
use super::plan::Term;
use super::sharing::Token;
use crate::node::ExprId;
use crate::number::Number;
use crate::operation::Operation;

impl Builder<'_> {
    /// `constant + Σ coefficient · term`.
    pub(super) fn sum(
        &mut self,
        e: ExprId,
        constant: Number,
        terms: &[(Number, ExprId)],
    ) -> Signed {
        match self.planned_sum(e) {
            Some(sum) => sum,
            None => self.sum_in_order(constant, terms),
        }
    }

    fn planned_sum(&mut self, e: ExprId) -> Option<Signed> {
        let entries = self.plan.as_ref()?.sums.entries(&e)?;
        let summands = entries.iter().map(|entry| {
            let Signed { negative, operand } = self.planned_term(entry.token);
            let negative = negative != entry.negative;
            Signed { negative, operand }
        });
        let summands = summands.collect();
        Some(self.accumulate(summands))
    }

    fn planned_term(&mut self, token: Token) -> Signed {
        if let Some(&term) = self.terms.get(&token) {
            return term;
        }
        let plan = self.plan.as_ref().expect("tokens are those of a plan");
        let term = if let Some(pair) = plan.sums.sharing.pair(token) {
            let [a, mut b] = [pair.first, pair.second].map(|token| self.planned_term(token));
            b.negative ^= pair.opposite;
            self.accumulate(vec![a, b])
        } else {
            match plan.sums.leaf(token).cloned() {
                Some(Term::Scaled(coefficient, term)) => self.scaled_term(coefficient, term),
                Some(Term::Hoisted(constant, terms)) => self.sum_in_order(constant, &terms),
                None => unreachable!("a token is a pair or a term"),
            }
        };
        self.terms.insert(token, term);
        term
    }

    /// `coefficient · term` with a positive coefficient.
    fn scaled_term(&mut self, coefficient: Number, term: ExprId) -> Signed {
        if let Some(product) = self.planned_product(coefficient, term) {
            return product;
        }
        let term = self.signed(term);
        if coefficient == Number::ONE {
            return term;
        }
        let operand = self.mul(Operand::Number(coefficient), term.operand);
        Signed { operand, ..term }
    }

    fn sum_in_order(&mut self, constant: Number, terms: &[(Number, ExprId)]) -> Signed {
        if let Some(common) = common_magnitude(constant, terms) {
            let signs = terms
                .iter()
                .map(|&(coefficient, term)| self.negated_if(coefficient, term));
            let sum = self.accumulate(signs.collect());
            let operand = self.mul(Operand::Number(common), sum.operand);
            return Signed { operand, ..sum };
        }
        let mut summands = Vec::with_capacity(terms.len() + 1);
        if !constant.is_zero() {
            summands.push(Signed {
                negative: constant.is_negative(),
                operand: Operand::Number(constant.abs()),
            });
        }
        for &(coefficient, term) in terms {
            let summand = self.negated_if(coefficient, term);
            let magnitude = coefficient.abs();
            summands.push(if magnitude == Number::ONE {
                summand
            } else {
                let operand = self.mul(Operand::Number(magnitude), summand.operand);
                Signed { operand, ..summand }
            });
        }
        self.accumulate(summands)
    }

    /// The term with the sign of the coefficient.
    fn negated_if(&self, coefficient: Number, term: ExprId) -> Signed {
        let Signed { negative, operand } = self.signed(term);
        let negative = negative != coefficient.is_negative();
        Signed { negative, operand }
    }

    /// Adds up summands; what depends on parameters alone comes first.
    pub(super) fn accumulate(&mut self, mut summands: Vec<Signed>) -> Signed {
        summands.sort_by_key(|summand| self.is_of_state(summand.operand));
        // Starting with a positive summand saves a change of sign.
        let positive = summands.iter().position(|summand| !summand.negative);
        let first = summands.remove(positive.unwrap_or(0));
        let mut sum = first.operand;
        for Signed { negative, operand } in summands {
            sum = if negative == first.negative {
                self.add(sum, operand)
            } else {
                self.emit([sum, operand], |[a, b]| Operation::Sub(a, b))
            };
        }
        let negative = first.negative;
        Signed {
            negative,
            operand: sum,
        }
    }
}

/// The magnitude of all coefficients, if it is the same and not 1, for several terms without a constant.
fn common_magnitude(constant: Number, terms: &[(Number, ExprId)]) -> Option<Number> {
    let ((first, _), others) = terms.split_first()?;
    let magnitude = first.abs();
    let common = others
        .iter()
        .all(|(coefficient, _)| coefficient.abs() == magnitude);
    let factored = !others.is_empty() && constant.is_zero() && magnitude != Number::ONE;
    (common && factored).then_some(magnitude)
}
