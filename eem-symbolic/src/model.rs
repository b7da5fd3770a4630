//! A free energy and its dashpots as expressions, and the quantities that follow directly.

use crate::diff::diff;
use crate::graph::Graph;
use crate::internal_energy::internal_energy;
use crate::lower_bound::LowerBound;
use crate::node::{ExprId, Node, Symbol};
use crate::number::Number;

/// A free energy ψ(x; parameters) and its dashpots, x = (measures …, dashpots …, temperature).
#[derive(Clone, Debug)]
pub struct Model {
    /// The graph that holds all expressions.
    pub graph: Graph,
    /// Kinematic measures `λ_a`, a = 1 … M.
    pub measures: Vec<Symbol>,
    /// Lower bounds of the strains of a solid; a measure without an entry may have any sign. Empty for a spring,
    /// whose measures are positive.
    pub strains: Vec<LowerBound>,
    /// Viscous stretches `γ_k`, k = 1 … K.
    pub dashpots: Vec<Symbol>,
    /// Absolute temperature θ, if the model has one.
    pub temperature: Option<Symbol>,
    /// The parameters that the expressions may mention.
    pub parameters: Vec<Symbol>,
    /// Free energy ψ.
    pub psi: ExprId,
    /// One viscosity `η_k` per dashpot, then those of flows that are not among the variables; functions of the
    /// parameters and θ.
    pub viscosities: Vec<ExprId>,
    /// The viscosity of the first measure, a function of the parameters and θ, if a dashpot acts in
    /// parallel with the spring (Kelvin–Voigt).
    pub drag: Option<ExprId>,
}

impl Model {
    /// x: measures, dashpots, temperature.
    #[must_use]
    pub fn variables(&self) -> Vec<Symbol> {
        let mechanical = self.measures.iter().chain(&self.dashpots);
        mechanical.chain(&self.temperature).copied().collect()
    }

    /// s = −∂ψ/∂θ.
    pub(crate) fn entropy(&self, graph: &mut Graph, theta: Symbol) -> ExprId {
        let slope = diff(graph, self.psi, theta);
        graph.neg(slope)
    }

    /// e = ψ + θ s, ψ itself without a temperature.
    pub(crate) fn internal_energy(&self, graph: &mut Graph) -> ExprId {
        match self.temperature {
            Some(theta) => internal_energy(graph, self.psi, theta),
            None => self.psi,
        }
    }

    /// Lower bounds of measures and temperature.
    pub(crate) fn bounds(&self) -> Vec<LowerBound> {
        let symbols = self.measures.iter().chain(&self.temperature);
        let bound = |&symbol: &Symbol| {
            let mut strains = self.strains.iter();
            let strain = strains.find(|strain| strain.symbol == symbol);
            let is_positive = self.strains.is_empty() || self.temperature == Some(symbol);
            strain
                .copied()
                .or_else(|| is_positive.then(|| LowerBound::positive(symbol)))
        };
        symbols.filter_map(bound).collect()
    }
}

/// `θ ∂s/∂θ`, multiplied out term by term: the heat capacity of `c ln θ` is c.
pub(crate) fn heat_capacity(graph: &mut Graph, entropy: ExprId, theta: Symbol) -> ExprId {
    let slope = diff(graph, entropy, theta);
    let theta = graph.variable(theta);
    let Node::Sum { constant, terms } = graph.node(slope).clone() else {
        return graph.mul(theta, slope);
    };
    let mut products = vec![(constant, theta)];
    for (coefficient, term) in terms {
        products.push((coefficient, graph.mul(theta, term)));
    }
    graph.weighted_sum(Number::ZERO, &products)
}
