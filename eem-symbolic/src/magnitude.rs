//! A bound of the rounding error of an expression, as another expression.
//!
//! Every node gets a bound to first order. With u = ε/2, one rounding,
//!
//! ```text
//! |computed − exact| ≤ u (r |e| + 16 m)
//!
//! x, a variable   r = 0                   m = 0
//! Σ cᵢ tᵢ         r = 0                   m = Σ |cᵢ| (⌈(rᵢ + n)/16⌉ |tᵢ| + mᵢ)
//!   of one sign   r = max rᵢ + n          m = Σ |cᵢ| mᵢ
//! Π bᵢ^pᵢ         r = n + Σ |pᵢ| rᵢ       m = Σ |pᵢ| mᵢ |bᵢ^(pᵢ − 1) Π others|
//! g^h             r = 2                   m = |h| (⌈r_g/16⌉ |g^h| + m_g |g^(h − 1)|) + |g^h ln g| (⌈r_h/16⌉ |h| + m_h)
//! f(a)            r = 2                   m = |f′(a)| (⌈r_a/16⌉ |a| + m_a)
//! ```
//!
//! with n the number of operations of the node. The relative part r is a number, so that products,
//! quotients and their powers cost nothing; only sums that cancel and functions need an expression m.
//! Wilkinson 1986, *Error analysis revisited*.

use std::collections::HashMap;

use crate::function::Function;
use crate::graph::Graph;
use crate::lower_bound::LowerBound;
use crate::node::{ExprId, Node};
use crate::number::{Number, Rational};
use crate::sign::{Sign, Signs};

/// Roundings that one unit of a magnitude stands for: 16 u = 8 ε.
const UNIT: u32 = 16;
/// Roundings of a constant, in u.
const CONSTANT: u32 = 1;
/// Roundings of an elementary function or a general power, in u: 1 ε.
const FUNCTION: u32 = 2;
/// Effect of rounding a constant exponent p on `x^p`, in u: `|p ln x|`, below 16 for powers between
/// 1e−7 and 1e7.
const EXPONENT: u32 = UNIT;
/// Added to x in the logarithm of a power `x^p`, so that it stays finite where x and the power
/// vanish: the smallest normal number of `f32`.
const SMALLEST: f32 = f32::MIN_POSITIVE;

/// An expression whose value times `8 ε` bounds the rounding error of the value of `e`, to first
/// order.
///
/// It is at least |e|, and `Σ |terms|` for a sum of plain terms. Rounding errors of operands are
/// propagated through products, powers and functions. Symbols are taken as exact; `bounds` are lower
/// bounds of their values. A divided difference counts as one operation.
///
/// ```
/// use eem_symbolic::{Function, Graph, LowerBound, Number, format, magnitude};
///
/// // The terms of 1e8 (λ − ln λ − 1) cancel near λ = 1.
/// let mut graph = Graph::new();
/// let lambda = graph.symbol("lambda");
/// let stretch = graph.variable(lambda);
/// let logarithm = graph.apply(Function::Ln, stretch);
/// let one = graph.integer(1);
/// let sum = graph.sub(stretch, logarithm);
/// let sum = graph.sub(sum, one);
/// let psi = graph.scale(Number::from(100_000_000_i64), sum);
/// let bound = magnitude(&mut graph, psi, &[LowerBound::positive(lambda)]);
/// assert_eq!(
///     format(&graph, bound),
///     "100000000*(lambda + abs(ln(lambda)) + 1) + abs(100000000*(lambda - ln(lambda) - 1))"
/// );
/// ```
#[must_use]
pub fn magnitude(graph: &mut Graph, e: ExprId, bounds: &[LowerBound]) -> ExprId {
    let nodes = graph.reachable(e, |_| true);
    let mut analysis = Analysis {
        graph,
        signs: Signs::new(bounds),
        known: HashMap::new(),
    };
    for id in nodes {
        let error = analysis.of_node(id);
        analysis.known.insert(id, error);
    }
    let error = analysis.error(e);
    let mut parts = Vec::new();
    // Without a relative part e is a variable, or a sum whose m is not below |e|.
    if error.relative > 0 || error.absolute.is_none() {
        parts.push((units(error.relative), analysis.abs(e)));
    }
    parts.extend(error.absolute.map(|absolute| (Number::ONE, absolute)));
    analysis.graph.weighted_sum(Number::ZERO, &parts)
}

/// The bound `u (relative |e| + 16 absolute)` of the rounding error of an expression e.
#[derive(Clone, Copy, Debug, Default)]
struct Error {
    relative: u32,
    absolute: Option<ExprId>,
}

type Terms = Vec<(Number, ExprId)>;

struct Analysis<'a> {
    graph: &'a mut Graph,
    signs: Signs<'a>,
    known: HashMap<ExprId, Error>,
}

impl Analysis<'_> {
    fn of_node(&mut self, e: ExprId) -> Error {
        match self.graph.node(e).clone() {
            Node::Variable(_) => Error::default(),
            Node::Number(_) => Error {
                relative: CONSTANT,
                absolute: None,
            },
            Node::Sum { constant, terms } => self.of_sum(constant, &terms),
            Node::PairSum(a, b) => self.of_sum(Number::ZERO, &[(Number::ONE, a), (Number::ONE, b)]),
            Node::Product(factors) => self.of_product(&factors),
            Node::Power(base, exponent) => self.of_power(e, base, exponent),
            Node::Apply(function, argument) => self.of_function(function, argument),
            Node::DividedDifference(..)
            | Node::SecondDividedDifference(..)
            | Node::PowerDifference { .. } => Error {
                relative: UNIT,
                absolute: None,
            },
        }
    }

    fn of_sum(&mut self, constant: Number, terms: &[(Number, ExprId)]) -> Error {
        let additions = count(terms.len()).saturating_sub(u32::from(constant.is_zero()));
        let mut error = Error::default();
        let mut sign = Sign::of_number(constant);
        let (mut sizes, mut inherited) = (Vec::new(), Vec::new());
        if !constant.is_zero() {
            let one = self.graph.number(Number::ONE);
            let roundings = additions.saturating_add(CONSTANT);
            sizes.push((constant.abs() * units(roundings), one));
        }
        for &(coefficient, term) in terms {
            let of_term = self.error(term);
            // A rounded coefficient, its product with the term, and the additions.
            let scaled = u32::from(coefficient.abs() != Number::ONE) * (CONSTANT + 1);
            let own = additions.saturating_add(scaled);
            let relative = of_term.relative.saturating_add(own);
            error.relative = error.relative.max(relative);
            sizes.push((coefficient.abs() * units(relative), self.abs(term)));
            inherited.extend(of_term.absolute.map(|m| (coefficient.abs(), m)));
            let of_term = self.signs.of(self.graph, term);
            sign = sign.plus(Sign::of_number(coefficient).times(of_term));
        }
        let single = terms.len() == 1 && constant.is_zero();
        if !single && sign.negative && sign.positive {
            error.relative = 0;
            inherited.extend(sizes);
        }
        error.absolute = self.total(&inherited);
        error
    }

    fn of_product(&mut self, factors: &[(ExprId, Rational)]) -> Error {
        let mut error = Error::default();
        let mut inherited = Vec::new();
        for &(base, exponent) in factors {
            let of_base = self.error(base);
            let relative = whole(exponent).saturating_mul(of_base.relative);
            let operations = operations(exponent);
            error.relative = error.relative.saturating_add(relative);
            error.relative = error.relative.saturating_add(operations);
            if let Some(absolute) = of_base.absolute {
                let mut slope = factors.to_vec();
                slope.push((base, Rational::MINUS_ONE));
                let slope = self.graph.power_product(&slope);
                let slope = self.abs(slope);
                let part = self.graph.mul(slope, absolute);
                inherited.push((Number::Exact(exponent).abs(), part));
            }
        }
        error.absolute = self.total(&inherited);
        error
    }

    fn of_power(&mut self, power: ExprId, base: ExprId, exponent: ExprId) -> Error {
        let mut inherited = Vec::new();
        let one = self.graph.number(Number::ONE);
        let reduced = self.graph.sub(exponent, one);
        let slope = self.graph.power(base, reduced);
        if let Some(error) = self.times(power, slope, base) {
            let exponent = self.abs(exponent);
            inherited.push((Number::ONE, self.graph.mul(exponent, error)));
        }
        let smallest = Number::from(f64::from(SMALLEST));
        let shifted = self.graph.weighted_sum(smallest, &[(Number::ONE, base)]);
        let logarithm = self.graph.apply(Function::Ln, shifted);
        let slope = self.graph.mul(power, logarithm);
        let relative = self.graph.mul(slope, exponent);
        let error = self.times(relative, slope, exponent);
        inherited.extend(error.map(|error| (Number::ONE, error)));
        Error {
            relative: FUNCTION,
            absolute: self.total(&inherited),
        }
    }

    fn of_function(&mut self, function: Function, argument: ExprId) -> Error {
        let of_argument = self.error(argument);
        let slope = function.derivative(self.graph, argument);
        let slope_times_argument = self.graph.mul(slope, argument);
        let absolute = match function {
            Function::Abs => return of_argument,
            Function::Cbrt => {
                let slope = self.abs(slope);
                let absolute = of_argument.absolute;
                let absolute = absolute.map(|absolute| self.graph.mul(slope, absolute));
                let relative = of_argument.relative.saturating_add(FUNCTION);
                return Error { relative, absolute };
            }
            Function::Exp
            | Function::ExpM1
            | Function::Ln
            | Function::Ln1p
            | Function::Log2
            | Function::Log10
            | Function::Sin
            | Function::Cos
            | Function::Tan
            | Function::Sinh
            | Function::Cosh
            | Function::Tanh
            | Function::Asinh
            | Function::Atan
            | Function::Atanh => self.times(slope_times_argument, slope, argument),
        };
        Error {
            relative: FUNCTION,
            absolute,
        }
    }

    /// `⌈r/16⌉ |slope a| + |slope| m` for the error r, m of a; `slope_times_a` is `slope a`, which can
    /// be finite where the slope is not.
    fn times(&mut self, slope_times_a: ExprId, slope: ExprId, a: ExprId) -> Option<ExprId> {
        let Error { relative, absolute } = self.error(a);
        let mut parts = Vec::new();
        if relative > 0 {
            parts.push((units(relative), self.abs(slope_times_a)));
        }
        if let Some(absolute) = absolute {
            let slope = self.abs(slope);
            parts.push((Number::ONE, self.graph.mul(slope, absolute)));
        }
        self.total(&parts)
    }

    fn total(&mut self, parts: &Terms) -> Option<ExprId> {
        (!parts.is_empty()).then(|| self.graph.weighted_sum(Number::ZERO, parts))
    }

    /// `|e|`, e itself where it is never negative.
    fn abs(&mut self, e: ExprId) -> ExprId {
        let sign = self.signs.of(self.graph, e);
        match (sign.negative, sign.positive) {
            (false, _) => e,
            (true, false) => self.graph.neg(e),
            (true, true) => self.graph.apply(Function::Abs, e),
        }
    }

    fn error(&self, e: ExprId) -> Error {
        self.known.get(&e).copied().unwrap_or_default()
    }
}

/// Units of a magnitude that cover this number of roundings.
fn units(roundings: u32) -> Number {
    Number::from(i64::from(roundings.div_ceil(UNIT).max(1)))
}

/// `⌈|p|⌉`.
fn whole(exponent: Rational) -> u32 {
    let (numerator, denominator) = (exponent.numerator(), exponent.denominator());
    let magnitude = numerator
        .unsigned_abs()
        .div_ceil(denominator.unsigned_abs());
    u32::try_from(magnitude).unwrap_or(u32::MAX)
}

/// Roundings of the factor `x^p` of a product: that of the multiplication, p − 1 of the power, one
/// more for a root; the power of a reciprocal has those of the reciprocal too.
fn operations(exponent: Rational) -> u32 {
    let n = whole(exponent);
    match exponent.denominator() {
        1 if exponent == Rational::ONE => 1,
        1 | 2 if exponent.is_negative() => n.saturating_mul(2).saturating_add(1),
        1 | 2 => n.saturating_add(1),
        _ => EXPONENT + FUNCTION + 1,
    }
}

fn count(length: usize) -> u32 {
    u32::try_from(length).unwrap_or(u32::MAX)
}
