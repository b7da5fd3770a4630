//! Programs of one state: potentials, their derivatives, caloric quantities, viscosities.

use std::collections::BTreeMap;

use crate::diff::diff;
use crate::function::Function;
use crate::graph::Graph;
use crate::model::{Model, heat_capacity};
use crate::node::{ExprId, Node, Symbol};
use crate::number::Rational;
use crate::program::{Input, Program, Stage};
use crate::schedule::{Locals, Schedule};

/// A model on a graph of its own.
pub(super) struct PointPrograms<'m> {
    model: &'m Model,
    graph: Graph,
    variables: Vec<Symbol>,
}

impl<'m> PointPrograms<'m> {
    pub(super) fn new(model: &'m Model) -> Self {
        Self {
            model,
            graph: model.graph.clone(),
            variables: model.variables(),
        }
    }

    pub(super) fn free_energy(&self) -> Program {
        self.program(&self.variables, &[self.model.psi])
    }

    pub(super) fn energy_magnitude(&mut self) -> Program {
        let bounds = self.model.bounds();
        let magnitude = crate::magnitude::magnitude(&mut self.graph, self.model.psi, &bounds);
        self.program(&self.variables, &[magnitude])
    }

    pub(super) fn gradient(&mut self) -> Program {
        let gradient = self.slopes(self.model.psi);
        self.program(&self.variables, &gradient)
    }

    pub(super) fn hessian(&mut self) -> Program {
        let gradient = self.slopes(self.model.psi);
        let hessian = gradient
            .iter()
            .flat_map(|&force| self.slopes(force))
            .collect::<Vec<_>>();
        self.program(&self.variables, &[gradient, hessian].concat())
    }

    pub(super) fn internal_energy(&mut self) -> Program {
        let energy = self.model.internal_energy(&mut self.graph);
        self.program(&self.variables, &[energy])
    }

    pub(super) fn caloric(&mut self, theta: Symbol) -> Program {
        let outputs = self.caloric_quantities(theta);
        self.program(&self.variables, &outputs)
    }

    /// The same and ψ, with all inputs but the temperature at the old stage.
    pub(super) fn caloric_at(&mut self, theta: Symbol) -> Program {
        let mut outputs = self.caloric_quantities(theta).to_vec();
        outputs.push(self.model.psi);
        let known = self.variables.iter().filter(|&&symbol| symbol != theta);
        let known = self.model.parameters.iter().chain(known);
        let known: Vec<_> = known.copied().collect();
        self.staged(&known, &[theta], &outputs)
    }

    pub(super) fn is_capacity_constant(&mut self, theta: Symbol) -> bool {
        let [_, capacity, _] = self.caloric_quantities(theta);
        !self.graph.depends_on(capacity, theta)
    }

    fn caloric_quantities(&mut self, theta: Symbol) -> [ExprId; 3] {
        let entropy = self.model.entropy(&mut self.graph, theta);
        let capacity = heat_capacity(&mut self.graph, entropy, theta);
        let magnitude = magnitude(&mut self.graph, entropy, theta);
        [entropy, capacity, magnitude]
    }

    pub(super) fn rates(&mut self) -> Program {
        let outputs = self.rate_quantities();
        self.program(&self.variables, &outputs)
    }

    /// The same, s and ψ, with all inputs but the temperature at the old stage.
    pub(super) fn rates_at(&mut self) -> Program {
        let mut outputs = self.rate_quantities();
        let theta = self.model.temperature;
        outputs.extend(theta.map(|theta| self.model.entropy(&mut self.graph, theta)));
        outputs.push(self.model.psi);
        let known = self.variables.iter();
        let known = known.filter(|&&symbol| Some(symbol) != theta);
        let known = self.model.parameters.iter().chain(known);
        let known: Vec<_> = known.copied().collect();
        self.staged(&known, theta.as_slice(), &outputs)
    }

    /// `f, g, c, ∂s/∂λ, ∂s/∂γ`.
    fn rate_quantities(&mut self) -> Vec<ExprId> {
        let mechanical = self.model.measures.iter().chain(&self.model.dashpots);
        let mechanical: Vec<_> = mechanical.copied().collect();
        let measures = self.model.measures.len();
        let mut outputs = Vec::new();
        for (index, &x) in mechanical.iter().enumerate() {
            let slope = diff(&mut self.graph, self.model.psi, x);
            let is_force = index < measures;
            outputs.push(if is_force {
                slope
            } else {
                self.graph.neg(slope)
            });
        }
        if let Some(theta) = self.model.temperature {
            let entropy = self.model.entropy(&mut self.graph, theta);
            outputs.push(heat_capacity(&mut self.graph, entropy, theta));
            let slopes = mechanical.iter();
            let slopes = slopes.map(|&x| diff(&mut self.graph, entropy, x));
            outputs.extend(slopes);
        }
        outputs
    }

    pub(super) fn entropy_hessian(&mut self, theta: Symbol) -> Program {
        let entropy = self.model.entropy(&mut self.graph, theta);
        let gradient = self.slopes(entropy);
        let hessian = gradient
            .iter()
            .flat_map(|&slope| self.slopes(slope))
            .collect::<Vec<_>>();
        self.program(&self.variables, &hessian)
    }

    /// Viscosity laws and their derivatives with respect to θ.
    pub(super) fn viscosity(&mut self, laws: &[ExprId]) -> Program {
        let theta = self.model.temperature;
        let mut slopes = Vec::new();
        for &law in laws {
            slopes.push(match theta {
                Some(theta) => diff(&mut self.graph, law, theta),
                None => self.graph.integer(0),
            });
        }
        self.program(theta.as_slice(), &[laws, &slopes].concat())
    }

    fn slopes(&mut self, e: ExprId) -> Vec<ExprId> {
        let variables = self.variables.iter();
        variables.map(|&x| diff(&mut self.graph, e, x)).collect()
    }

    fn program(&self, variables: &[Symbol], outputs: &[ExprId]) -> Program {
        self.staged(&self.model.parameters, variables, outputs)
    }

    /// A program in which values that depend on `known` alone are of the old stage.
    fn staged(&self, known: &[Symbol], unknown: &[Symbol], outputs: &[ExprId]) -> Program {
        let old = known.iter().map(|&symbol| (symbol, Stage::Old));
        let new = unknown.iter().map(|&symbol| (symbol, Stage::New));
        let inputs = old.chain(new).map(|(symbol, stage)| Input {
            symbol,
            name: self.graph.name(symbol).to_owned(),
            stage,
        });
        let schedule = Schedule {
            graph: &self.graph,
            locals: &Locals::default(),
            parameters: known.len(),
        };
        schedule.program(inputs.collect(), outputs)
    }
}

/// The sum of the magnitudes of the terms of a sum; the rounding error of the sum is proportional to it.
///
/// A sum among the factors of a term is replaced by the magnitudes of its own terms. The temperature is positive.
fn magnitude(graph: &mut Graph, e: ExprId, theta: Symbol) -> ExprId {
    let theta = graph.variable(theta);
    let composed = |graph: &Graph, e| matches!(graph.node(e), Node::Sum { .. } | Node::Product(_));
    let mut magnitudes = BTreeMap::from([(theta, theta)]);
    for id in graph.reachable(e, |id| composed(graph, id)) {
        let magnitude = match graph.node(id).clone() {
            Node::Sum { constant, terms } => {
                let terms = terms.into_iter().map(|(coefficient, term)| {
                    (coefficient.abs(), magnitude_of(graph, &magnitudes, term))
                });
                let terms: Vec<_> = terms.collect();
                graph.weighted_sum(constant.abs(), &terms)
            }
            Node::Product(factors) => {
                let factors = factors.into_iter().map(|(base, exponent)| {
                    let plain = exponent == Rational::ONE;
                    let even = exponent.to_i32().is_some_and(|n| n % 2 == 0);
                    let magnitude = match base {
                        base if even || base == theta => base,
                        base if plain => magnitude_of(graph, &magnitudes, base),
                        base => graph.apply(Function::Abs, base),
                    };
                    (magnitude, exponent)
                });
                let factors: Vec<_> = factors.collect();
                graph.power_product(&factors)
            }
            Node::Number(_)
            | Node::Variable(_)
            | Node::Power(..)
            | Node::Apply(..)
            | Node::PairSum(..)
            | Node::DividedDifference(..)
            | Node::SecondDividedDifference(..)
            | Node::PowerDifference { .. } => unreachable!("only sums and products are composed"),
        };
        magnitudes.insert(id, magnitude);
    }
    magnitude_of(graph, &magnitudes, e)
}

fn magnitude_of(graph: &mut Graph, magnitudes: &BTreeMap<ExprId, ExprId>, e: ExprId) -> ExprId {
    let magnitude = magnitudes.get(&e).copied();
    magnitude.unwrap_or_else(|| graph.apply(Function::Abs, e))
}
