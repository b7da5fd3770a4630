//! The vocabulary of expressions: what a node of the graph can be, and nothing about how it is built.

use crate::function::Function;
use crate::number::{Number, Rational};

/// Name of an expression in its [`Graph`](crate::Graph).
///
/// Equal expressions have equal ids: comparing ids decides equality of canonical forms. Operands
/// are always older than the node that uses them, so ascending ids are a valid order of evaluation.
///
/// The order of ids is the order of creation. It is deterministic, but it is not the structural
/// order in which operands are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ExprId(pub(crate) u32);

impl ExprId {
    /// Position of the node in its graph: 0 for the oldest.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Name of a variable or parameter in its [`Graph`](crate::Graph).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Symbol(pub(crate) u32);

impl Symbol {
    /// Position of the symbol in its graph: 0 for the oldest.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A node in canonical form; only the constructors of [`Graph`](crate::Graph) build one.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A constant.
    Number(Number),
    /// A variable or a parameter.
    Variable(Symbol),
    /// `constant + Σ coefficient · term`.
    ///
    /// The only place where numeric coefficients live: `3·x·y` is a sum with one term. Terms are
    /// distinct, in structural order, with coefficients other than zero. A term is itself a sum only
    /// under a coefficient other than ±1, because `c·(a − b)` loses digits when distributed, or if it
    /// has more than 8 terms ([`weighted_sum`](crate::Graph::weighted_sum)).
    Sum {
        /// The number added to the terms.
        constant: Number,
        /// Coefficients and terms.
        terms: Vec<(Number, ExprId)>,
    },
    /// `Π base ^ exponent` with exponents other than zero; distinct bases in structural order.
    ///
    /// Quotients are exponents of −1, square roots exponents of ½.
    Product(Vec<(ExprId, Rational)>),
    /// `base ^ exponent` where the exponent is not a rational constant.
    Power(ExprId, ExprId),
    /// A function of the table.
    Apply(Function, ExprId),
    /// `a + b`, never flattened into a surrounding sum.
    ///
    /// Divided differences need `f(a) + f(b)`. Kept as one addition, which commutes in floating
    /// point, the whole difference stays bitwise symmetric in `a` and `b`.
    PairSum(ExprId, ExprId),
    /// First divided difference `f[a, b] = (f(b) − f(a))/(b − a)`, continued by `f[a, a] = f′(a)`.
    ///
    /// Symmetric, hence stored with its arguments in structural order.
    DividedDifference(Kernel, ExprId, ExprId),
    /// Second divided difference `f[a, b, b] = (f′(b) − f[a, b])/(b − a)`, the derivative of
    /// `f[a, b]` with respect to `b`; `f[a, a, a] = f″(a)/2`.
    SecondDividedDifference(Kernel, ExprId, ExprId),
    /// `exp[X_a, X_b]` for `X = h·ln g`, given the values `g^h` at both ends.
    ///
    /// ```text
    /// exp[X_a, X_b] = max(g_a^h_a, g_b^h_b) · φ(|X_b − X_a|),   φ(d) = (1 − e⁻ᵈ)/d
    /// ```
    ///
    /// The values are passed because `exp` of a rounded `h·ln g` would lose `|h·ln g|` units in the
    /// last place. Symmetric under exchange of the ends.
    PowerDifference {
        /// `g^h` at `a` and at `b`.
        values: [ExprId; 2],
        /// `h·ln g` at `a` and at `b`.
        logarithms: [ExprId; 2],
    },
}

/// A function of one argument whose divided differences the runtime evaluates to rounding.
///
/// The square is missing on purpose: `x²[a, b] = a + b` needs no kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kernel {
    /// A function of the table, never [`Function::Abs`].
    Function(Function),
    /// `√x`.
    Sqrt,
    /// `1/x`.
    Recip,
    /// `xⁿ` with n other than −1, 0, 1, 2.
    Powi(i32),
    /// `x^p`, x > 0; the exponent is the same at both ends.
    Powf(ExprId),
}

impl Kernel {
    /// The exponent that a kernel carries as an operand.
    #[must_use]
    pub fn operand(self) -> Option<ExprId> {
        match self {
            Kernel::Powf(exponent) => Some(exponent),
            Kernel::Function(_) | Kernel::Sqrt | Kernel::Recip | Kernel::Powi(_) => None,
        }
    }
}

impl Node {
    /// Calls `visit` for every operand, in the order in which they are stored.
    pub fn for_each_operand(&self, mut visit: impl FnMut(ExprId)) {
        match self {
            Node::Number(_) | Node::Variable(_) => {}
            Node::Sum { terms, .. } => terms.iter().for_each(|&(_, term)| visit(term)),
            Node::Product(factors) => factors.iter().for_each(|&(base, _)| visit(base)),
            Node::Apply(_, argument) => visit(*argument),
            Node::Power(a, b) | Node::PairSum(a, b) => {
                visit(*a);
                visit(*b);
            }
            Node::DividedDifference(kernel, a, b) | Node::SecondDividedDifference(kernel, a, b) => {
                kernel.operand().into_iter().for_each(&mut visit);
                visit(*a);
                visit(*b);
            }
            Node::PowerDifference { values, logarithms } => {
                values
                    .iter()
                    .chain(logarithms)
                    .for_each(|&operand| visit(operand));
            }
        }
    }
}

impl Node {
    /// The same node over other symbols and operands; the result need not be canonical.
    pub(crate) fn map(
        &self,
        symbol: impl Fn(Symbol) -> Symbol,
        operand: impl Fn(ExprId) -> ExprId,
    ) -> Node {
        let kernel_of = |kernel: Kernel| match kernel {
            Kernel::Powf(exponent) => Kernel::Powf(operand(exponent)),
            Kernel::Function(_) | Kernel::Sqrt | Kernel::Recip | Kernel::Powi(_) => kernel,
        };
        match self {
            Node::Number(number) => Node::Number(*number),
            Node::Variable(name) => Node::Variable(symbol(*name)),
            Node::Sum { constant, terms } => Node::Sum {
                constant: *constant,
                terms: terms.iter().map(|&(c, term)| (c, operand(term))).collect(),
            },
            Node::Product(factors) => Node::Product(
                factors
                    .iter()
                    .map(|&(base, r)| (operand(base), r))
                    .collect(),
            ),
            Node::Power(base, exponent) => Node::Power(operand(*base), operand(*exponent)),
            Node::Apply(function, argument) => Node::Apply(*function, operand(*argument)),
            Node::PairSum(a, b) => Node::PairSum(operand(*a), operand(*b)),
            Node::DividedDifference(kernel, a, b) => {
                Node::DividedDifference(kernel_of(*kernel), operand(*a), operand(*b))
            }
            Node::SecondDividedDifference(kernel, a, b) => {
                Node::SecondDividedDifference(kernel_of(*kernel), operand(*a), operand(*b))
            }
            Node::PowerDifference { values, logarithms } => Node::PowerDifference {
                values: values.map(&operand),
                logarithms: logarithms.map(&operand),
            },
        }
    }
}
