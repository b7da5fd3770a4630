//! Partial and total derivatives: one rule per kind of node, each node differentiated once.

use std::collections::HashMap;

use crate::function::Function;
use crate::graph::Graph;
use crate::node::{ExprId, Kernel, Node, Symbol};
use crate::number::{Number, Rational};

/// `∂e/∂x`.
///
/// Divided differences are differentiated through second ones,
/// `d f[a, b] = f[b, a, a]·da + f[a, b, b]·db`. Third divided differences are not part of the
/// language: where the derivative of an `f[a, b, b]` would be needed, the result is the number NaN.
///
/// ```
/// use eem_symbolic::{Function, Graph, diff, format};
///
/// let mut graph = Graph::new();
/// let x = graph.symbol("x");
/// let at = graph.variable(x);
/// let sine = graph.apply(Function::Sin, at);
/// let square = graph.powi(sine, 2);
/// let slope = diff(&mut graph, square, x);
/// assert_eq!(format(&graph, slope), "2*sin(x)*cos(x)");
/// ```
pub fn diff(graph: &mut Graph, e: ExprId, x: Symbol) -> ExprId {
    diff_total(graph, e, x, &[])
}

/// `de/dx` when further symbols depend on `x`, each with the total derivative given.
///
/// ```text
/// de/dx = ∂e/∂x + Σ ∂e/∂y_i · dy_i/dx
/// ```
///
/// If `x` itself is in the list, the entry replaces its derivative of 1.
pub fn diff_total(
    graph: &mut Graph,
    e: ExprId,
    x: Symbol,
    implicit: &[(Symbol, ExprId)],
) -> ExprId {
    let one = graph.number(Number::ONE);
    let mut seeds = implicit.to_vec();
    seeds.push((x, one));
    Derivatives::of(graph, e, &seeds).get(e)
}

/// The derivatives of all subexpressions of an expression.
pub(crate) struct Derivatives {
    zero: ExprId,
    of: HashMap<ExprId, ExprId>,
}

impl Derivatives {
    /// Differentiates `e`, given the derivatives of symbols; those of other symbols vanish.
    pub(crate) fn of(graph: &mut Graph, e: ExprId, seeds: &[(Symbol, ExprId)]) -> Derivatives {
        let symbols: Vec<_> = seeds.iter().map(|&(symbol, _)| symbol).collect();
        let zero = graph.number(Number::ZERO);
        let mut derivatives = Derivatives {
            zero,
            of: HashMap::new(),
        };
        for id in graph.dependents(e, &symbols) {
            let derivative = if let Node::Variable(name) = *graph.node(id) {
                let seed = seeds.iter().find(|(symbol, _)| *symbol == name);
                seed.map_or(zero, |&(_, derivative)| derivative)
            } else {
                let node = graph.node(id).clone();
                derivatives.of_node(graph, &node)
            };
            derivatives.of.insert(id, derivative);
        }
        derivatives
    }

    /// The derivative of a subexpression of the expression given to [`Derivatives::of`].
    pub(crate) fn get(&self, e: ExprId) -> ExprId {
        self.of.get(&e).copied().unwrap_or(self.zero)
    }
}

/// The rules.
impl Derivatives {
    fn of_node(&self, graph: &mut Graph, node: &Node) -> ExprId {
        match *node {
            Node::Number(_) | Node::Variable(_) => self.zero,
            Node::Sum { ref terms, .. } => {
                let terms: Vec<_> = terms.iter().map(|&(c, term)| (c, self.get(term))).collect();
                graph.weighted_sum(Number::ZERO, &terms)
            }
            Node::Product(ref factors) => self.of_product(graph, factors),
            Node::Power(base, exponent) => self.of_power(graph, base, exponent),
            Node::Apply(function, argument) => {
                let outer = function.derivative(graph, argument);
                graph.mul(outer, self.get(argument))
            }
            Node::PairSum(a, b) => graph.add(self.get(a), self.get(b)),
            Node::DividedDifference(kernel, a, b) => self.of_difference(graph, kernel, a, b),
            Node::SecondDividedDifference(..) => {
                let mut constant = true;
                node.for_each_operand(|operand| constant &= self.get(operand) == self.zero);
                if constant {
                    self.zero
                } else {
                    graph.number(f64::NAN)
                }
            }
            Node::PowerDifference {
                logarithms: [a, b], ..
            } => self.of_ends(graph, Kernel::Function(Function::Exp), a, b),
        }
    }

    /// `(Π gᵢ^rᵢ)′ = Σᵢ rᵢ gᵢ^(rᵢ − 1) gᵢ′ · Π_{j ≠ i} gⱼ^rⱼ`, constant factors in front.
    pub(crate) fn of_product(&self, graph: &mut Graph, factors: &[(ExprId, Rational)]) -> ExprId {
        let (varying, mut result): (Vec<_>, Vec<_>) = factors
            .iter()
            .partition(|(base, _)| self.get(*base) != self.zero);
        let mut terms = Vec::with_capacity(varying.len());
        for &(base, exponent) in &varying {
            let mut term = varying.clone();
            term.push((base, Rational::MINUS_ONE));
            term.push((self.get(base), Rational::ONE));
            terms.push((Number::Exact(exponent), graph.power_product(&term)));
        }
        result.push((graph.weighted_sum(Number::ZERO, &terms), Rational::ONE));
        graph.power_product(&result)
    }

    /// `(g^h)′ = h g^(h − 1) g′ + g^h ln g · h′`.
    fn of_power(&self, graph: &mut Graph, base: ExprId, exponent: ExprId) -> ExprId {
        let mut terms = Vec::new();
        if self.get(base) != self.zero {
            let one = graph.number(Number::ONE);
            let reduced = graph.sub(exponent, one);
            let power = graph.power(base, reduced);
            terms.push(graph.product(&[exponent, power, self.get(base)]));
        }
        if self.get(exponent) != self.zero {
            let power = graph.power(base, exponent);
            let logarithm = graph.apply(Function::Ln, base);
            terms.push(graph.product(&[power, logarithm, self.get(exponent)]));
        }
        graph.sum(&terms)
    }

    /// `d f[a, b]`, including the derivative with respect to the exponent of a power.
    fn of_difference(&self, graph: &mut Graph, kernel: Kernel, a: ExprId, b: ExprId) -> ExprId {
        let ends = self.of_ends(graph, kernel, a, b);
        match kernel {
            Kernel::Function(_) | Kernel::Sqrt | Kernel::Recip | Kernel::Powi(_) => ends,
            Kernel::Powf(exponent) if self.get(exponent) == self.zero => ends,
            Kernel::Powf(exponent) => {
                let inner = power_times_logarithm(graph, exponent, a, b);
                let inner = graph.mul(inner, self.get(exponent));
                graph.add(ends, inner)
            }
        }
    }

    /// `f[b, a, a]·a′ + f[a, b, b]·b′`.
    fn of_ends(&self, graph: &mut Graph, kernel: Kernel, a: ExprId, b: ExprId) -> ExprId {
        let mut terms = Vec::new();
        for (from, to) in [(b, a), (a, b)] {
            if self.get(to) != self.zero {
                let second = graph.second_kernel_difference(kernel, from, to);
                terms.push(graph.mul(second, self.get(to)));
            }
        }
        graph.sum(&terms)
    }
}

/// `(x^p ln x)[a, b]`, the derivative of `(x^p)[a, b]` with respect to p, by the product rule of differences.
fn power_times_logarithm(graph: &mut Graph, p: ExprId, a: ExprId, b: ExprId) -> ExprId {
    let logarithm = graph.kernel_difference(Kernel::Function(Function::Ln), a, b);
    let power = graph.kernel_difference(Kernel::Powf(p), a, b);
    let (power_a, power_b) = (graph.power(a, p), graph.power(b, p));
    let (ln_a, ln_b) = (graph.apply(Function::Ln, a), graph.apply(Function::Ln, b));
    let (powers, logarithms) = (graph.pair_sum(power_a, power_b), graph.pair_sum(ln_a, ln_b));
    let (first, second) = (graph.mul(power, logarithms), graph.mul(logarithm, powers));
    graph.weighted_sum(
        Number::ZERO,
        &[(Number::HALF, first), (Number::HALF, second)],
    )
}
