//! Bounds of the values of an expression, by interval arithmetic.
//!
//! Signs of operands do not suffice to show that `1 − e^(−x)` or `2 + sin x` are never negative. Every use of a
//! variable counts as if it were independent of the others, so that bounds are right and not always
//! sharp.

use std::collections::HashMap;

use crate::function::Function;
use crate::graph::Graph;
use crate::interpret::{Arithmetic, F64};
use crate::lower_bound::LowerBound;
use crate::node::{ExprId, Node, Symbol};
use crate::number::{Number, Rational};

/// An interval that holds all values of an expression, where it is defined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// No value is below, up to rounding; −∞ if nothing is known.
    pub lower: f64,
    /// No value is above, up to rounding; +∞ if nothing is known.
    pub upper: f64,
}

/// The range of `e` over all states. A state consists of the symbols with `bounds`, and of those in `any`, which have
/// any value.
///
/// Other symbols are parameters, taken as positive. So is a factor of parameters alone that can have
/// both signs, such as `1 − 2ν`: its sign does not change with the state. Sums are flat, so that
/// the terms of `λ − (l − a)` count one by one.
///
/// ```
/// use eem_symbolic::{Function, Graph, LowerBound, Number, range};
///
/// let mut graph = Graph::new();
/// let [lambda, l] = ["lambda", "l"].map(|name| graph.symbol(name));
/// let [stretch, length] = [lambda, l].map(|symbol| graph.variable(symbol));
/// let ratio = graph.div(stretch, length);
/// let difference = graph.sub(stretch, length);
/// let decay = graph.neg(ratio);
/// let decay = graph.apply(Function::Exp, decay);
/// let one = graph.integer(1);
/// let saturation = graph.sub(one, decay);
/// let lower = |e| range(&graph, e, &[LowerBound::positive(lambda)], &[]).lower;
/// assert_eq!(lower(ratio), 0.0);
/// assert_eq!(lower(saturation), 0.0);
/// assert_eq!(lower(difference), f64::NEG_INFINITY);
/// ```
#[must_use]
pub fn range(graph: &Graph, e: ExprId, bounds: &[LowerBound], any: &[Symbol]) -> Range {
    let mut known = HashMap::new();
    let bound = |symbol: &Symbol| {
        let mut bounds = bounds.iter();
        let found = bounds.find(|bound| bound.symbol == *symbol);
        found.map(|found| found.bound)
    };
    for id in graph.reachable(e, |_| true) {
        let get = |operand| known.get(&operand).copied().unwrap_or(Range::ALL);
        let node = graph.node(id);
        let mut range = match node {
            Node::Variable(symbol) if any.contains(symbol) => Range::ALL,
            Node::Variable(symbol) => Range {
                lower: bound(symbol).map_or(0.0, Rational::to_f64),
                upper: f64::INFINITY,
            },
            _ => of_node(node, get),
        };
        let mut state = bounds.iter().map(|bound| &bound.symbol).chain(any);
        let of_state = state.any(|&symbol| graph.depends_on(id, symbol));
        if !of_state && range.lower < 0.0 && range.upper > 0.0 {
            range.lower = 0.0;
        }
        known.insert(id, range);
    }
    known.get(&e).copied().unwrap_or(Range::ALL)
}

fn of_node(node: &Node, range: impl Fn(ExprId) -> Range) -> Range {
    match node {
        Node::Number(number) => Range::point(number.to_f64()),
        Node::Sum { constant, terms } => {
            let terms = terms.iter().map(|&(c, term)| range(term).scaled(c));
            terms.fold(Range::point(constant.to_f64()), Range::plus)
        }
        Node::Product(factors) => {
            let factors = factors.iter().map(|&(base, r)| range(base).to_the(r));
            factors.fold(Range::point(1.0), Range::times)
        }
        // Defined for a positive base only.
        Node::Power(..) => Range::NOT_NEGATIVE,
        Node::Apply(function, argument) => range(*argument).under(*function),
        Node::PairSum(a, b) => range(*a).plus(range(*b)),
        Node::Variable(_)
        | Node::DividedDifference(..)
        | Node::SecondDividedDifference(..)
        | Node::PowerDifference { .. } => Range::ALL,
    }
}

impl Range {
    /// Nothing is known.
    const ALL: Range = Range {
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
    };
    /// Not below zero.
    const NOT_NEGATIVE: Range = Range {
        lower: 0.0,
        upper: f64::INFINITY,
    };

    fn point(value: f64) -> Self {
        Self::new(value, value)
    }

    /// An undetermined bound, such as ∞ − ∞, becomes infinite.
    fn new(lower: f64, upper: f64) -> Self {
        let or = |bound: f64, all: f64| if bound.is_nan() { all } else { bound };
        Self {
            lower: or(lower, f64::NEG_INFINITY),
            upper: or(upper, f64::INFINITY),
        }
    }

    fn plus(self, other: Self) -> Self {
        Self::new(self.lower + other.lower, self.upper + other.upper)
    }

    fn scaled(self, coefficient: Number) -> Self {
        self.times(Self::point(coefficient.to_f64()))
    }

    fn times(self, other: Self) -> Self {
        // 0 · ∞ counts as 0: values are finite, ∞ only says that they have no bound.
        let product = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
        let of = |a: f64| [product(a, other.lower), product(a, other.upper)];
        let [[a, b], [c, d]] = [of(self.lower), of(self.upper)];
        Self::new(a.min(b).min(c).min(d), a.max(b).max(c).max(d))
    }

    /// `|x|`.
    fn abs(self) -> Self {
        let (a, b) = (self.lower.abs(), self.upper.abs());
        let straddles = self.lower < 0.0 && self.upper > 0.0;
        Self::new(if straddles { 0.0 } else { a.min(b) }, a.max(b))
    }

    /// `1/x`.
    fn recip(self) -> Self {
        if self.lower >= 0.0 {
            // `abs` turns −0 into 0, whose inverse is +∞.
            Self::new(self.upper.recip(), self.lower.abs().recip())
        } else if self.upper <= 0.0 {
            Self::new((-self.upper.abs()).recip(), self.lower.recip())
        } else {
            Self::ALL
        }
    }

    /// `xʳ`.
    fn to_the(self, exponent: Rational) -> Self {
        let (magnitude, r) = (exponent.numerator().abs(), exponent.to_f64().abs());
        let power = match exponent.denominator() {
            1 if magnitude % 2 == 0 => self.abs().map(|x| x.powf(r)),
            1 => self.map(|x| x.abs().powf(r).copysign(x)),
            _ => self.map(|x| x.max(0.0).powf(r)),
        };
        if exponent.is_negative() {
            power.recip()
        } else {
            power
        }
    }

    /// The image under an increasing function.
    fn map(self, function: impl Fn(f64) -> f64) -> Self {
        Self::new(function(self.lower), function(self.upper))
    }

    /// The values of a function whose argument is in this range.
    fn under(self, function: Function) -> Self {
        let value = |x: f64| F64.apply(function, &x);
        match function {
            Function::Exp
            | Function::ExpM1
            | Function::Sinh
            | Function::Tanh
            | Function::Asinh
            | Function::Atan
            | Function::Cbrt => self.map(value),
            Function::Ln | Function::Log2 | Function::Log10 => self.map(|x| value(x.max(0.0))),
            Function::Ln1p => self.map(|x| value(x.max(-1.0))),
            Function::Atanh => self.map(|x| value(x.clamp(-1.0, 1.0))),
            Function::Cosh => self.abs().map(value),
            Function::Abs => self.abs(),
            Function::Sin | Function::Cos | Function::Tan if self.upper - self.lower == 0.0 => {
                self.map(value)
            }
            Function::Sin | Function::Cos => Self::new(-1.0, 1.0),
            Function::Tan => Self::ALL,
        }
    }
}
