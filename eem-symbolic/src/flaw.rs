//! Flaws that make a free energy or a viscosity unphysical, whatever the parameters are.

use crate::diff::diff;
use crate::graph::Graph;
use crate::model::Model;
use crate::node::{ExprId, Symbol};
use crate::number::Number;
use crate::sign::sign;

/// A reason why a model cannot be integrated.
///
/// Flaws are certain: they follow from the formulas and from λ > 0, the bounds of strains and θ > 0, for every value of
/// the parameters. A model without flaws may still be wrong for some values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flaw {
    /// ψ does not depend on this measure, stretch of a dashpot or temperature.
    Independent(Symbol),
    /// ψ is linear in θ: c = −θ ∂²ψ/∂θ² is zero, and an entropy determines no temperature.
    NoHeatCapacity,
    /// c = −θ ∂²ψ/∂θ² is nowhere positive: entropy does not grow with temperature.
    NegativeHeatCapacity,
    /// The viscosity of this dashpot, counted from 0, is nowhere positive.
    NoViscosity(usize),
    /// The viscosity of the first measure is nowhere positive.
    NoDrag,
}

impl Model {
    /// Everything that is certainly wrong with the model.
    ///
    /// ```
    /// use eem_symbolic::{Flaw, Graph, Model};
    ///
    /// let mut graph = Graph::new();
    /// let (lambda, theta) = (graph.symbol("lambda"), graph.symbol("theta"));
    /// let (stretch, temperature) = (graph.variable(lambda), graph.variable(theta));
    /// let psi = graph.mul(stretch, temperature);
    /// let model = Model {
    ///     graph,
    ///     measures: vec![lambda],
    ///     strains: vec![],
    ///     dashpots: vec![],
    ///     temperature: Some(theta),
    ///     parameters: vec![],
    ///     psi,
    ///     viscosities: vec![],
    ///     drag: None,
    /// };
    /// assert_eq!(model.flaws(), [Flaw::NoHeatCapacity]);
    /// ```
    #[must_use]
    pub fn flaws(&self) -> Vec<Flaw> {
        let mut graph = self.graph.clone();
        let mut flaws = Vec::new();
        for x in self.variables() {
            let slope = diff(&mut graph, self.psi, x);
            if is_zero(&graph, slope) {
                flaws.push(Flaw::Independent(x));
            } else if self.temperature == Some(x) {
                flaws.extend(self.caloric_flaw(&mut graph, slope, x));
            }
        }
        for (dashpot, &law) in self.viscosities.iter().enumerate() {
            if !sign(&graph, law, &self.bounds()).positive {
                flaws.push(Flaw::NoViscosity(dashpot));
            }
        }
        let never_positive = |law| !sign(&graph, law, &self.bounds()).positive;
        if self.drag.is_some_and(never_positive) {
            flaws.push(Flaw::NoDrag);
        }
        flaws
    }

    /// c has the sign of −∂²ψ/∂θ², because θ is positive.
    fn caloric_flaw(&self, graph: &mut Graph, slope: ExprId, theta: Symbol) -> Option<Flaw> {
        let curvature = diff(graph, slope, theta);
        if is_zero(graph, curvature) {
            return Some(Flaw::NoHeatCapacity);
        }
        let possible = sign(graph, curvature, &self.bounds()).negative;
        (!possible).then_some(Flaw::NegativeHeatCapacity)
    }
}

fn is_zero(graph: &Graph, e: ExprId) -> bool {
    graph.as_number(e).is_some_and(Number::is_zero)
}
