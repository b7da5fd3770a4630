//! Products in canonical form: one rational exponent per base, numeric factors in front.

use std::collections::BTreeMap;

use crate::graph::Graph;
use crate::node::{ExprId, Node};
use crate::number::{Number, Rational};
use crate::order::compare;

/// Products of more factors, and sums of more terms, are not flattened into the surrounding product
/// or sum: otherwise the lengths of products of growing products would add up to a square.
pub(crate) const WIDTH: usize = 8;

impl Graph {
    /// `Π base ^ exponent`.
    ///
    /// Laws:
    /// * `x^a · x^b = x^(a + b)`: keeps or extends the domain (`x·x⁻¹ = 1` also at 0,
    ///   `√x·√x = x` also below 0), never shrinks it;
    /// * `(x^a)^n = x^(a·n)` and `(x·y)^n = xⁿ·yⁿ` for integers n only: `√(x²)` is not x;
    /// * numbers to integer powers move to the coefficient, except 0 to a negative one;
    /// * square roots of rational squares are exact;
    /// * a product of more than 8 factors is not taken apart.
    ///
    /// Products are not distributed over sums.
    pub fn power_product(&mut self, factors: &[(ExprId, Rational)]) -> ExprId {
        let mut collected = Collected {
            coefficient: Number::ONE,
            numbers: Vec::new(),
            exponents: BTreeMap::new(),
        };
        let mut pending = factors.to_vec();
        while let Some((base, exponent)) = pending.pop() {
            collected.multiply(self, base, exponent, &mut pending);
            if pending.is_empty() {
                pending = collected.take_expandable(self);
            }
        }
        let coefficient = collected.coefficient;
        if coefficient.is_zero() {
            return self.number(Number::ZERO);
        }
        for number in collected.numbers {
            let powers = collected.exponents.entry(number).or_insert(Rational::ZERO);
            *powers = powers.checked_add(Rational::ONE).unwrap_or(*powers);
        }
        let mut factors: Vec<_> = collected.exponents.into_iter().collect();
        let product = match factors[..] {
            [] => return self.number(coefficient),
            [(base, Rational::ONE)] => base,
            _ => {
                factors.sort_by(|p, q| compare(self, p.0, q.0));
                self.intern(Node::Product(factors))
            }
        };
        self.scale(coefficient, product)
    }

    /// `a · b`.
    pub fn mul(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.product(&[a, b])
    }

    /// `a / b`.
    pub fn div(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.power_product(&[(a, Rational::ONE), (b, Rational::MINUS_ONE)])
    }

    /// `1/x`.
    pub fn recip(&mut self, x: ExprId) -> ExprId {
        self.power_product(&[(x, Rational::MINUS_ONE)])
    }

    /// `√x`.
    pub fn sqrt(&mut self, x: ExprId) -> ExprId {
        self.power_product(&[(x, Rational::HALF)])
    }

    /// `xⁿ`.
    pub fn powi(&mut self, x: ExprId, exponent: i32) -> ExprId {
        self.power_product(&[(x, Rational::integer(i64::from(exponent)))])
    }

    /// `Π factors`.
    pub fn product(&mut self, factors: &[ExprId]) -> ExprId {
        let factors: Vec<_> = factors
            .iter()
            .map(|&factor| (factor, Rational::ONE))
            .collect();
        self.power_product(&factors)
    }

    /// Coefficient and term of an expression that is `coefficient · term`.
    pub(crate) fn as_scaled(&self, e: ExprId) -> Option<(Number, ExprId)> {
        let Node::Sum { constant, terms } = self.node(e) else {
            return None;
        };
        if constant.is_zero() && terms.len() == 1 {
            Some(terms[0])
        } else {
            None
        }
    }
}

/// A product that is being collected; exponents are never 0.
struct Collected {
    coefficient: Number,
    /// Numbers whose product with the coefficient is not within the range of floats.
    numbers: Vec<ExprId>,
    exponents: BTreeMap<ExprId, Rational>,
}

impl Collected {
    /// Multiplies by `base ^ exponent`; if a law splits it, the factors go to `pending` instead.
    fn multiply(
        &mut self,
        graph: &mut Graph,
        base: ExprId,
        exponent: Rational,
        pending: &mut Vec<(ExprId, Rational)>,
    ) {
        if exponent.is_zero() {
            return;
        }
        if let Some(expansion) = expand(graph, base, exponent) {
            match self.coefficient.product_in_range(expansion.coefficient) {
                Some(product) => self.coefficient = product,
                None => self.numbers.push(graph.number(expansion.coefficient)),
            }
            pending.extend(expansion.factors);
            return;
        }
        let present = self.exponents.get(&base).copied().unwrap_or(Rational::ZERO);
        match present.checked_add(exponent) {
            Some(Rational::ZERO) => {
                self.exponents.remove(&base);
            }
            Some(sum) => {
                self.exponents.insert(base, sum);
            }
            // Exponents beyond 128 bits: the factor keeps a float exponent of its own.
            None => {
                let exponent = graph.number(exponent.to_f64());
                let power = graph.intern(Node::Power(base, exponent));
                self.exponents.insert(power, Rational::ONE);
            }
        }
    }

    /// Takes out the factors that collecting has made expandable, such as `√(2x)·√(2x) = 2·x`.
    fn take_expandable(&mut self, graph: &Graph) -> Vec<(ExprId, Rational)> {
        let expandable = |(&base, &exponent): (&ExprId, &Rational)| {
            expand(graph, base, exponent)
                .is_some()
                .then_some((base, exponent))
        };
        let taken: Vec<_> = self.exponents.iter().filter_map(expandable).collect();
        for (base, _) in &taken {
            self.exponents.remove(base);
        }
        taken
    }
}

/// `coefficient · Π factors`.
struct Expansion {
    coefficient: Number,
    factors: Vec<(ExprId, Rational)>,
}

/// Takes `base ^ exponent` apart where a law of [`Graph::power_product`] applies.
fn expand(graph: &Graph, base: ExprId, exponent: Rational) -> Option<Expansion> {
    match graph.node(base) {
        Node::Number(number) => {
            let coefficient = exact_power(*number, exponent)?;
            Some(Expansion {
                coefficient,
                factors: Vec::new(),
            })
        }
        Node::Sum { .. } => {
            let (coefficient, term) = graph.as_scaled(base)?;
            exponent.is_integer().then_some(())?;
            let coefficient = exact_power(coefficient, exponent)?;
            Some(Expansion {
                coefficient,
                factors: vec![(term, exponent)],
            })
        }
        Node::Product(factors) => {
            (exponent.is_integer() && factors.len() <= WIDTH).then_some(())?;
            let powers = factors
                .iter()
                .map(|&(b, r)| Some((b, r.checked_mul(exponent)?)));
            Some(Expansion {
                coefficient: Number::ONE,
                factors: powers.collect::<Option<_>>()?,
            })
        }
        Node::Variable(_)
        | Node::Power(..)
        | Node::Apply(..)
        | Node::PairSum(..)
        | Node::DividedDifference(..)
        | Node::SecondDividedDifference(..)
        | Node::PowerDifference { .. } => None,
    }
}

/// `number ^ exponent` where it folds to a number: integer exponents and roots of squares, as long as
/// the result is within the range of floats.
fn exact_power(number: Number, exponent: Rational) -> Option<Number> {
    if number == Number::ONE {
        return Some(Number::ONE);
    }
    if number.is_zero() {
        return (!exponent.is_negative()).then_some(Number::ZERO);
    }
    if let Some(integer) = exponent.to_i32() {
        let power = number.powi(integer);
        let in_range = power.to_f64().is_finite() && !power.is_zero();
        return (in_range || !number.to_f64().is_finite()).then_some(power);
    }
    let root = number.exact()?.checked_sqrt()?;
    let halves = exponent.checked_mul(Rational::TWO)?.to_i32()?;
    Some(Number::Exact(root.checked_powi(halves)?))
}
