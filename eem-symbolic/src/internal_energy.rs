//! The internal energy of a free energy: `T = 1 − θ ∂_θ`, simplified term by term.

use std::collections::HashMap;

use crate::diff::Derivatives;
use crate::graph::Graph;
use crate::node::{ExprId, Node, Symbol};
use crate::number::{Number, Rational};

/// `E = T ψ = ψ − θ ∂ψ/∂θ = ψ + θ s` as a function of θ; A and p below do not depend on θ.
///
/// ```text
/// T A = A,   T(A·f) = A·T f,   T Σ = Σ T,   T(θ^p) = (1 − p) θ^p
/// T(θ^p g) = (1 − p) θ^p g − θ^(p + 1) g′,  distributed over g where g is a sum
/// ```
///
/// Terms linear in θ vanish before they are evaluated, so that an entropy offset, however large,
/// costs no digits of E; `T(θ ln θ) = −θ`.
///
/// ```
/// use eem_symbolic::{Function, Graph, format, internal_energy};
///
/// let mut graph = Graph::new();
/// let (c, theta) = (graph.symbol("c"), graph.symbol("theta"));
/// let (at_c, at) = (graph.variable(c), graph.variable(theta));
/// let logarithm = graph.apply(Function::Ln, at);
/// let psi = graph.product(&[at_c, at, logarithm]);
/// let energy = internal_energy(&mut graph, psi, theta);
/// assert_eq!(format(&graph, energy), "-c*theta");
/// ```
pub fn internal_energy(graph: &mut Graph, psi: ExprId, theta: Symbol) -> ExprId {
    let (at, one) = (graph.variable(theta), graph.number(Number::ONE));
    let derivatives = Derivatives::of(graph, psi, &[(theta, one)]);
    let mut operator = Operator {
        theta,
        at,
        derivatives,
        images: HashMap::new(),
    };
    for id in operator.distributed(graph, psi) {
        let image = operator.of_node(graph, id);
        operator.images.insert(id, image);
    }
    operator.image(psi)
}

/// The operator T, and its images of the subexpressions over which it distributes.
struct Operator {
    theta: Symbol,
    /// θ as an expression.
    at: ExprId,
    derivatives: Derivatives,
    images: HashMap<ExprId, ExprId>,
}

/// `constant · θ^power · Π rest`: the factors of a product by their dependence on θ.
struct Factors {
    constant: Vec<(ExprId, Rational)>,
    power: Rational,
    rest: Vec<(ExprId, Rational)>,
}

impl Operator {
    /// The subexpressions whose images make up the image of `psi`, operands before users.
    fn distributed(&self, graph: &Graph, psi: ExprId) -> Vec<ExprId> {
        let mut pending = vec![psi];
        let mut found = std::collections::BTreeSet::new();
        while let Some(id) = pending.pop() {
            if !graph.depends_on(id, self.theta) || !found.insert(id) {
                continue;
            }
            if let Node::Sum { terms, .. } = graph.node(id) {
                pending.extend(terms.iter().map(|&(_, term)| term));
            } else if let Node::Product(factors) = graph.node(id) {
                pending.extend(self.single_factor(graph, factors));
            } else if let Node::PairSum(a, b) = graph.node(id) {
                pending.extend([*a, *b]);
            }
        }
        found.into_iter().collect()
    }

    /// The only factor that depends on θ, if its exponent is 1.
    fn single_factor(&self, graph: &Graph, factors: &[(ExprId, Rational)]) -> Option<ExprId> {
        let mut varying = factors
            .iter()
            .filter(|(base, _)| graph.depends_on(*base, self.theta));
        match (varying.next(), varying.next()) {
            (Some(&(base, Rational::ONE)), None) => Some(base),
            _ => None,
        }
    }

    fn image(&self, e: ExprId) -> ExprId {
        self.images.get(&e).copied().unwrap_or(e)
    }

    fn of_node(&self, graph: &mut Graph, id: ExprId) -> ExprId {
        let node = graph.node(id).clone();
        match node {
            Node::Variable(symbol) if symbol == self.theta => graph.number(Number::ZERO),
            Node::Number(_) | Node::Variable(_) => id,
            Node::Sum { constant, terms } => {
                let images: Vec<_> = terms
                    .iter()
                    .map(|&(c, term)| (c, self.image(term)))
                    .collect();
                graph.weighted_sum(constant, &images)
            }
            Node::PairSum(a, b) => graph.pair_sum(self.image(a), self.image(b)),
            Node::Product(factors) => self.of_product(graph, &factors),
            Node::Power(base, exponent) => self.of_power(graph, id, base, exponent),
            Node::Apply(..)
            | Node::DividedDifference(..)
            | Node::SecondDividedDifference(..)
            | Node::PowerDifference { .. } => {
                self.of_rest(graph, Rational::ZERO, &[(id, Rational::ONE)])
            }
        }
    }

    /// `T(θ^h) = (1 − h) θ^h` for an exponent without θ.
    fn of_power(&self, graph: &mut Graph, id: ExprId, base: ExprId, exponent: ExprId) -> ExprId {
        if base != self.at || graph.depends_on(exponent, self.theta) {
            return self.of_rest(graph, Rational::ZERO, &[(id, Rational::ONE)]);
        }
        let one = graph.number(Number::ONE);
        let factor = graph.sub(one, exponent);
        graph.mul(factor, id)
    }

    fn of_product(&self, graph: &mut Graph, factors: &[(ExprId, Rational)]) -> ExprId {
        let mut split = self.split(graph, factors);
        let varying = match split.rest[..] {
            [(factor, Rational::ONE)] if split.power.is_zero() => self.image(factor),
            [(factor, Rational::ONE)] => self.of_power_times(graph, split.power, factor),
            _ => self.of_rest(graph, split.power, &split.rest),
        };
        split.constant.push((varying, Rational::ONE));
        graph.power_product(&split.constant)
    }

    /// `T(θ^p g)`, term by term if g is a sum.
    fn of_power_times(&self, graph: &mut Graph, power: Rational, factor: ExprId) -> ExprId {
        let Node::Sum { constant, terms } = graph.node(factor).clone() else {
            return self.of_rest(graph, power, &[(factor, Rational::ONE)]);
        };
        let mut images = vec![(constant, self.of_rest(graph, power, &[]))];
        for (coefficient, term) in terms {
            let mut factors = vec![(term, Rational::ONE)];
            if let Node::Product(inner) = graph.node(term) {
                factors.clone_from(inner);
            }
            factors.push((self.at, power));
            let mut split = self.split(graph, &factors);
            split
                .constant
                .push((self.of_rest(graph, split.power, &split.rest), Rational::ONE));
            images.push((coefficient, graph.power_product(&split.constant)));
        }
        graph.weighted_sum(Number::ZERO, &images)
    }

    /// `T(θ^p g) = (1 − p) θ^p g − θ^(p + 1) g′` for the product g of `rest`.
    fn of_rest(&self, graph: &mut Graph, power: Rational, rest: &[(ExprId, Rational)]) -> ExprId {
        let theta_to_p = (self.at, power);
        let mut undifferentiated = rest.to_vec();
        undifferentiated.push(theta_to_p);
        let undifferentiated = graph.power_product(&undifferentiated);
        let slope = self.derivatives.of_product(graph, rest);
        let factors = [theta_to_p, (self.at, Rational::ONE), (slope, Rational::ONE)];
        let differentiated = graph.power_product(&factors);
        let coefficient = Number::ONE - Number::Exact(power);
        let terms = [
            (coefficient, undifferentiated),
            (Number::MINUS_ONE, differentiated),
        ];
        graph.weighted_sum(Number::ZERO, &terms)
    }

    fn split(&self, graph: &Graph, factors: &[(ExprId, Rational)]) -> Factors {
        let mut split = Factors {
            constant: Vec::new(),
            power: Rational::ZERO,
            rest: Vec::new(),
        };
        for &(base, exponent) in factors {
            if base == self.at {
                // If the sum of two exponents does not fit, the second power is an ordinary factor.
                match split.power.checked_add(exponent) {
                    Some(power) => split.power = power,
                    None => split.rest.push((base, exponent)),
                }
            } else if graph.depends_on(base, self.theta) {
                split.rest.push((base, exponent));
            } else {
                split.constant.push((base, exponent));
            }
        }
        split
    }
}
