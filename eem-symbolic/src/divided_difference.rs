//! Divided differences of expressions, by rules on the tree that never subtract neighbouring values.

use std::collections::HashMap;

use crate::function::Function;
use crate::graph::Graph;
use crate::node::{ExprId, Kernel, Node, Symbol};
use crate::number::{Number, Rational};

/// `e[x: a, b]`, the divided difference of `e` in `x`; `∂e/∂x` in the limit `b → a`.
///
/// ```text
/// e[a, b] = (e(x = b) − e(x = a))/(b − a)
///
/// (c₀ + Σ cᵢ fᵢ)[·] = Σ cᵢ fᵢ[·]
/// (f·g)[·] = ½(f[·](g_a + g_b) + g[·](f_a + f_b))
/// (f∘g)[·] = f[g_a, g_b]·g[·]
/// (g^h)[·] = exp[X_a, X_b]·X[·],   X = h ln g,   when h varies
/// ```
///
/// No rule divides by `b − a`, so that the result keeps its digits for every increment. Factors
/// without `x` are taken out first, hence expressions affine in `x` have exact differences. Pairs
/// are added by [`Graph::pair_sum`]: if `a` and `b` are [versions](Graph::version) of one symbol,
/// evaluation at exchanged ends gives the same bits.
///
/// The difference of a divided difference is not part of the language (it would need `f[a, b, c]`):
/// where `e` contains one that depends on `x`, the result is the number NaN.
///
/// Source: Kahan & Fateman 1999, *Symbolic computation of divided differences*; Reps & Rall 2003,
/// *Computational divided differencing and divided-difference arithmetics*.
///
/// ```
/// use eem_symbolic::{Graph, divided_difference, format};
///
/// let mut graph = Graph::new();
/// let x = graph.symbol("x");
/// let at = graph.variable(x);
/// let inverse = graph.recip(at);
/// let e = graph.add(at, inverse);
/// let (a, b) = (graph.version(x, "a"), graph.version(x, "b"));
/// let (a, b) = (graph.variable(a), graph.variable(b));
/// let secant = divided_difference(&mut graph, e, x, a, b);
/// assert_eq!(format(&graph, secant), "recip[a, b] + 1");
/// ```
pub fn divided_difference(graph: &mut Graph, e: ExprId, x: Symbol, a: ExprId, b: ExprId) -> ExprId {
    let (zero, one) = (graph.number(Number::ZERO), graph.number(Number::ONE));
    let mut differences = Differences {
        zero,
        of: HashMap::new(),
    };
    for id in graph.dependents(e, &[x]) {
        let difference = if let Node::Variable(_) = graph.node(id) {
            Difference { a, b, slope: one }
        } else {
            let node = graph.node(id).clone();
            differences.of_node(graph, &node)
        };
        differences.of.insert(id, difference);
    }
    differences.get(e).slope
}

/// An expression at both ends, and its divided difference.
#[derive(Clone, Copy)]
struct Difference {
    a: ExprId,
    b: ExprId,
    slope: ExprId,
}

struct Differences {
    zero: ExprId,
    of: HashMap<ExprId, Difference>,
}

impl Differences {
    /// The difference of a subexpression that has been visited, or that does not contain `x`.
    fn get(&self, e: ExprId) -> Difference {
        self.of.get(&e).copied().unwrap_or(Difference {
            a: e,
            b: e,
            slope: self.zero,
        })
    }

    fn of_node(&self, graph: &mut Graph, node: &Node) -> Difference {
        match *node {
            Node::Number(number) => self.get(graph.number(number)),
            Node::Variable(symbol) => self.get(graph.variable(symbol)),
            Node::Sum {
                constant,
                ref terms,
            } => self.of_sum(graph, constant, terms),
            Node::Product(ref factors) => self.of_product(graph, factors),
            Node::Power(base, exponent) => self.of_power(graph, base, exponent),
            Node::Apply(function, argument) => self.of_apply(graph, function, argument),
            Node::PairSum(first, second) => {
                let (first, second) = (self.get(first), self.get(second));
                Difference {
                    a: graph.pair_sum(first.a, second.a),
                    b: graph.pair_sum(first.b, second.b),
                    slope: graph.add(first.slope, second.slope),
                }
            }
            Node::DividedDifference(..)
            | Node::SecondDividedDifference(..)
            | Node::PowerDifference { .. } => {
                let refused = graph.number(f64::NAN);
                Difference {
                    a: refused,
                    b: refused,
                    slope: refused,
                }
            }
        }
    }

    fn of_sum(
        &self,
        graph: &mut Graph,
        constant: Number,
        terms: &[(Number, ExprId)],
    ) -> Difference {
        let mut part = |constant: Number, part: fn(Difference) -> ExprId| {
            let terms: Vec<_> = terms
                .iter()
                .map(|&(c, term)| (c, part(self.get(term))))
                .collect();
            graph.weighted_sum(constant, &terms)
        };
        Difference {
            a: part(constant, |term| term.a),
            b: part(constant, |term| term.b),
            slope: part(Number::ZERO, |term| term.slope),
        }
    }

    /// `(f∘g)[·] = f[g_a, g_b]·g[·]`; for a logarithm the factors of g without `x` drop out,
    /// `ln(c·g)[·] = ln[g_a, g_b]·g[·]`.
    fn of_apply(&self, graph: &mut Graph, function: Function, argument: ExprId) -> Difference {
        let whole = apply(graph, function, self.get(argument));
        let (Function::Ln | Function::Log2 | Function::Log10) = function else {
            return whole;
        };
        let (_, term) = graph.as_scaled(argument).unwrap_or((Number::ONE, argument));
        let factors = if let Node::Product(factors) = graph.node(term) {
            factors.clone()
        } else {
            vec![(term, Rational::ONE)]
        };
        let (_, varying) = self.split(graph, &factors);
        let Some(varying) = self.multiply_all(graph, &varying) else {
            return whole;
        };
        let slope = apply(graph, function, varying).slope;
        Difference { slope, ..whole }
    }

    /// Takes out the factors without `x`; multiplies the others pairwise.
    fn of_product(&self, graph: &mut Graph, factors: &[(ExprId, Rational)]) -> Difference {
        let (constant, varying) = self.split(graph, factors);
        let constant = graph.power_product(&constant);
        let constant = Difference {
            a: constant,
            b: constant,
            slope: self.zero,
        };
        let varying = self.multiply_all(graph, &varying).unwrap_or(constant);
        self.multiply(graph, constant, varying)
    }

    /// The factors without `x`, and the differences of the others.
    fn split(
        &self,
        graph: &mut Graph,
        factors: &[(ExprId, Rational)],
    ) -> (Vec<(ExprId, Rational)>, Vec<Difference>) {
        let mut constant = Vec::new();
        let mut varying = Vec::new();
        for &(base, exponent) in factors {
            let difference = self.get(base);
            if difference.slope == self.zero {
                constant.push((difference.a, exponent));
            } else {
                varying.push(rational_power(graph, difference, exponent));
            }
        }
        (constant, varying)
    }

    /// The product of the factors, `None` without factors. It is a balanced tree, so that n factors have
    /// partial products of total length n·log n.
    fn multiply_all(&self, graph: &mut Graph, factors: &[Difference]) -> Option<Difference> {
        if factors.len() < 2 {
            return factors.first().copied();
        }
        let (left, right) = factors.split_at(factors.len() / 2);
        let left = self.multiply_all(graph, left)?;
        let right = self.multiply_all(graph, right)?;
        Some(self.multiply(graph, left, right))
    }

    /// `(f·g)[·] = ½(f[·](g_a + g_b) + g[·](f_a + f_b))`, and `f·g[·]` where f is constant.
    fn multiply(&self, graph: &mut Graph, f: Difference, g: Difference) -> Difference {
        let slope = if f.slope == self.zero {
            graph.mul(f.a, g.slope)
        } else if g.slope == self.zero {
            graph.mul(g.a, f.slope)
        } else {
            let (fs, gs) = (graph.pair_sum(f.a, f.b), graph.pair_sum(g.a, g.b));
            let (first, second) = (graph.mul(f.slope, gs), graph.mul(g.slope, fs));
            let sum = graph.pair_sum(first, second);
            graph.scale(Number::HALF, sum)
        };
        Difference {
            a: graph.mul(f.a, g.a),
            b: graph.mul(f.b, g.b),
            slope,
        }
    }

    fn of_power(&self, graph: &mut Graph, base: ExprId, exponent: ExprId) -> Difference {
        let (g, h) = (self.get(base), self.get(exponent));
        let (a, b) = (graph.power(g.a, h.a), graph.power(g.b, h.b));
        let slope = if h.slope == self.zero {
            let outer = graph.kernel_difference(Kernel::Powf(h.a), g.a, g.b);
            graph.mul(outer, g.slope)
        } else {
            let logarithm = apply(graph, Function::Ln, g);
            let x = self.multiply(graph, h, logarithm);
            let outer = graph.power_difference([a, b], [x.a, x.b]);
            graph.mul(outer, x.slope)
        };
        Difference { a, b, slope }
    }
}

/// `(f∘g)[·] = f[g_a, g_b]·g[·]`.
fn apply(graph: &mut Graph, function: Function, g: Difference) -> Difference {
    let outer = graph.kernel_difference(Kernel::Function(function), g.a, g.b);
    Difference {
        a: graph.apply(function, g.a),
        b: graph.apply(function, g.b),
        slope: graph.mul(outer, g.slope),
    }
}

/// `(g^r)[·] = f[g_a, g_b]·g[·]` for `f(x) = x^r`.
fn rational_power(graph: &mut Graph, g: Difference, exponent: Rational) -> Difference {
    let kernel = graph.power_kernel(exponent);
    let outer = graph.kernel_difference(kernel, g.a, g.b);
    Difference {
        a: graph.power_product(&[(g.a, exponent)]),
        b: graph.power_product(&[(g.b, exponent)]),
        slope: graph.mul(outer, g.slope),
    }
}
