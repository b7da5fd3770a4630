//! Signs that an expression can have, from the signs of its parts: a sign is ruled out only if that is certain.

use std::collections::HashMap;

use crate::function::Function;
use crate::graph::Graph;
use crate::lower_bound::LowerBound;
use crate::node::{ExprId, Node, Symbol};
use crate::number::{Number, Rational};

/// The signs that a real expression may take where it is defined.
///
/// A sign that is ruled out cannot occur, in exact arithmetic; one that is not ruled out need not
/// occur either.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sign {
    /// It may be below zero.
    pub negative: bool,
    /// It may be zero.
    pub zero: bool,
    /// It may be above zero.
    pub positive: bool,
}

/// The signs of `e`, given bounds of symbols; all other symbols may have any sign.
///
/// ```
/// use eem_symbolic::{Graph, LowerBound, sign};
///
/// let mut graph = Graph::new();
/// let (theta, eta) = (graph.symbol("theta"), graph.symbol("eta"));
/// let (at, factor) = (graph.variable(theta), graph.variable(eta));
/// let square = graph.powi(factor, 2);
/// let law = graph.product(&[square, at]);
/// let law = graph.neg(law);
/// assert!(!sign(&graph, law, &[LowerBound::positive(theta)]).positive);
/// assert!(sign(&graph, law, &[]).positive);
/// ```
#[must_use]
pub fn sign(graph: &Graph, e: ExprId, bounds: &[LowerBound]) -> Sign {
    Signs::new(bounds).of(graph, e)
}

/// The signs of many expressions of one graph; each node is looked at once.
#[derive(Debug)]
pub(crate) struct Signs<'p> {
    bounds: &'p [LowerBound],
    known: HashMap<ExprId, Sign>,
}

impl<'p> Signs<'p> {
    pub(crate) fn new(bounds: &'p [LowerBound]) -> Self {
        Self {
            bounds,
            known: HashMap::new(),
        }
    }

    pub(crate) fn of(&mut self, graph: &Graph, e: ExprId) -> Sign {
        for id in graph.reachable(e, |id| !self.known.contains_key(&id)) {
            let node = graph.node(id);
            let mut sign = of_node(node, self.bounds, |operand| self.get(operand));
            if let (true, Node::Sum { constant, terms }) = (sign.is_open(), node) {
                sign = self.of_shifted(graph, *constant, terms).unwrap_or(sign);
            }
            self.known.insert(id, sign);
        }
        self.get(e)
    }

    /// The sign of a sum such as `1 + j` or `−2 − 2j`, which follows from the bound of j and not from its
    /// sign.
    fn of_shifted(
        &self,
        graph: &Graph,
        constant: Number,
        terms: &[(Number, ExprId)],
    ) -> Option<Sign> {
        let negative = terms.first()?.0.is_negative();
        let toward = |c: Number| if negative { -c } else { c };
        let mut lowest = toward(constant).exact()?;
        let mut reached = true;
        for &(coefficient, term) in terms {
            let coefficient = toward(coefficient).exact()?;
            if let Some(bound) = self.bound(graph, term) {
                if coefficient.is_negative() {
                    return None;
                }
                lowest = lowest.checked_add(coefficient.checked_mul(bound.bound)?)?;
                reached &= bound.reached;
            } else {
                let sign = Sign::of_number(coefficient.into()).times(self.get(term));
                if sign.negative {
                    return None;
                }
                reached &= sign.zero;
            }
        }
        let sign = match (lowest.is_negative(), lowest.is_zero() && reached) {
            (true, _) => return None,
            (false, true) => Sign::NOT_NEGATIVE,
            (false, false) => Sign::POSITIVE,
        };
        Some(if negative { sign.opposite() } else { sign })
    }

    fn bound(&self, graph: &Graph, term: ExprId) -> Option<LowerBound> {
        match graph.node(term) {
            Node::Variable(symbol) => bound_of(self.bounds, *symbol),
            _ => None,
        }
    }

    fn get(&self, e: ExprId) -> Sign {
        self.known.get(&e).copied().unwrap_or(Sign::ANY)
    }
}

fn bound_of(bounds: &[LowerBound], symbol: Symbol) -> Option<LowerBound> {
    let mut bounds = bounds.iter();
    bounds.find(|bound| bound.symbol == symbol).copied()
}

fn of_node(node: &Node, bounds: &[LowerBound], sign: impl Fn(ExprId) -> Sign) -> Sign {
    match *node {
        Node::Number(number) => Sign::of_number(number),
        Node::Variable(symbol) => bound_of(bounds, symbol).map_or(Sign::ANY, Sign::from_bound),
        Node::Sum {
            constant,
            ref terms,
        } => {
            let terms = terms.iter();
            let terms = terms.map(|&(c, term)| Sign::of_number(c).times(sign(term)));
            terms.fold(Sign::of_number(constant), Sign::plus)
        }
        Node::Product(ref factors) => {
            let factors = factors.iter();
            let factors = factors.map(|&(base, exponent)| sign(base).to_the(exponent));
            factors.fold(Sign::POSITIVE, Sign::times)
        }
        // Defined for a positive base only.
        Node::Power(..) => Sign::POSITIVE,
        Node::Apply(function, argument) => sign(argument).under(function),
        Node::PairSum(a, b) => sign(a).plus(sign(b)),
        Node::DividedDifference(..)
        | Node::SecondDividedDifference(..)
        | Node::PowerDifference { .. } => Sign::ANY,
    }
}

impl Sign {
    /// Nothing is known.
    const ANY: Sign = Sign {
        negative: true,
        zero: true,
        positive: true,
    };
    /// Above zero.
    const POSITIVE: Sign = Sign {
        negative: false,
        zero: false,
        positive: true,
    };

    /// Not below zero.
    const NOT_NEGATIVE: Sign = Sign {
        negative: false,
        zero: true,
        positive: true,
    };

    fn from_bound(bound: LowerBound) -> Sign {
        match (bound.bound.is_negative(), bound.bound.is_zero()) {
            (true, _) => Sign::ANY,
            (false, true) if bound.reached => Sign::NOT_NEGATIVE,
            (false, _) => Sign::POSITIVE,
        }
    }

    /// Both signs are possible.
    fn is_open(self) -> bool {
        self.negative && self.positive
    }

    /// The signs of −x.
    fn opposite(self) -> Sign {
        Sign {
            negative: self.positive,
            zero: self.zero,
            positive: self.negative,
        }
    }

    pub(crate) fn of_number(number: Number) -> Sign {
        if number.to_f64().is_nan() {
            return Sign::ANY;
        }
        Sign {
            negative: number.is_negative() && !number.is_zero(),
            zero: number.is_zero(),
            positive: !number.is_negative() && !number.is_zero(),
        }
    }

    pub(crate) fn plus(self, other: Sign) -> Sign {
        let cancel = self.negative && other.positive || self.positive && other.negative;
        Sign {
            negative: self.negative || other.negative,
            zero: self.zero && other.zero || cancel,
            positive: self.positive || other.positive,
        }
    }

    pub(crate) fn times(self, other: Sign) -> Sign {
        Sign {
            negative: self.negative && other.positive || self.positive && other.negative,
            zero: self.zero || other.zero,
            positive: self.positive && other.positive || self.negative && other.negative,
        }
    }

    /// `xʳ`: even powers are not negative; roots of negative numbers and `1/0` are not defined.
    fn to_the(self, exponent: Rational) -> Sign {
        let even = exponent.is_integer() && exponent.numerator() % 2 == 0;
        let odd = exponent.is_integer() && !even;
        Sign {
            negative: odd && self.negative,
            zero: self.zero && !exponent.is_negative(),
            positive: self.positive || even && self.negative,
        }
    }

    /// The signs of a function whose argument has these signs.
    fn under(self, function: Function) -> Sign {
        match function {
            Function::Exp | Function::Cosh => Sign::POSITIVE,
            Function::Abs => Sign {
                negative: false,
                zero: self.zero,
                positive: self.negative || self.positive,
            },
            Function::ExpM1
            | Function::Ln1p
            | Function::Sinh
            | Function::Tanh
            | Function::Asinh
            | Function::Atan
            | Function::Atanh
            | Function::Cbrt => self,
            Function::Ln
            | Function::Log2
            | Function::Log10
            | Function::Sin
            | Function::Cos
            | Function::Tan => Sign::ANY,
        }
    }
}
