//! A model at the two states of a step, from which all discrete derivatives are built.

use crate::diff::diff;
use crate::divided_difference::divided_difference;
use crate::factor::Factoring;
use crate::graph::Graph;
use crate::model::Model;
use crate::node::{ExprId, Symbol};
use crate::number::Number;
use crate::program::{Input, Program, Stage};
use crate::schedule::{Locals, Schedule};
use crate::substitute::substitute;

/// A state: one symbol per variable.
pub(super) type Point = Vec<Symbol>;

/// Algorithmic quantities.
pub(crate) struct Form {
    /// `[f*_a …, g*_k …, θ*, Δs]`.
    pub(super) response: Vec<ExprId>,
    /// Derivatives with respect to x¹, by rows.
    pub(super) tangent: Vec<ExprId>,
}

/// A model at two states: the graph with the symbols of both, and the thermodynamic potentials.
pub(crate) struct Step {
    pub(super) graph: Graph,
    pub(super) locals: Locals,
    /// The variables of the model, temperature last.
    pub(super) variables: Vec<Symbol>,
    parameters: Vec<Symbol>,
    measures: usize,
    pub(super) old: Point,
    pub(super) new: Point,
    /// Corner temperatures, inputs of the entropy form only.
    pub(super) corners: Vec<Symbol>,
    pub(super) psi: ExprId,
    /// Number of variables without the temperature.
    pub(super) mechanical: usize,
    pub(super) entropy: ExprId,
    pub(super) energy: ExprId,
}

impl Step {
    /// `corners`: whether temperatures at the corners of the staircases are inputs.
    pub(crate) fn new(model: &Model, corners: bool) -> Self {
        let mut graph = model.graph.clone();
        let variables = model.variables();
        let (mut old, mut new) = (Point::new(), Point::new());
        for &variable in &variables {
            let name = graph.name(variable).to_owned();
            old.push(graph.version(variable, &format!("{name}⁰")));
            new.push(graph.version(variable, &format!("{name}¹")));
        }
        let mechanical = model.measures.len() + model.dashpots.len();
        let corners = match model.temperature {
            Some(theta) if corners => corner_symbols(&mut graph, theta, mechanical),
            Some(_) | None => Vec::new(),
        };
        let entropy = match model.temperature {
            Some(theta) => model.entropy(&mut graph, theta),
            None => graph.integer(0),
        };
        let energy = model.internal_energy(&mut graph);
        Self {
            graph,
            locals: Locals::default(),
            variables,
            parameters: model.parameters.clone(),
            measures: model.measures.len(),
            old,
            new,
            corners,
            psi: model.psi,
            mechanical,
            entropy,
            energy,
        }
    }

    /// Parameters, x⁰, x¹, corner temperatures.
    pub(super) fn inputs(&self) -> Vec<Input> {
        let old = self
            .parameters
            .iter()
            .chain(&self.old)
            .map(|&symbol| (symbol, Stage::Old));
        let new = self
            .new
            .iter()
            .chain(&self.corners)
            .map(|&symbol| (symbol, Stage::New));
        let input = |(symbol, stage)| Input {
            symbol,
            name: self.graph.name(symbol).to_owned(),
            stage,
        };
        old.chain(new).map(input).collect()
    }

    /// The program that computes a form.
    pub(crate) fn program(mut self, form: &Form) -> Program {
        let inputs = self.inputs();
        let mut factoring = Factoring::default();
        let mut outputs = [&form.response[..], &form.tangent].concat();
        for (logarithm, carried) in self.carried_logarithms(&outputs) {
            factoring.replace(logarithm, carried);
        }
        for output in &mut outputs {
            *output = factoring.of(&mut self.graph, *output);
        }
        self.locals
            .redefine(|value| factoring.of(&mut self.graph, value));
        self.schedule().program(inputs, &outputs)
    }

    pub(super) fn schedule(&self) -> Schedule<'_> {
        Schedule {
            graph: &self.graph,
            locals: &self.locals,
            parameters: self.parameters.len(),
        }
    }

    /// `F` at a state.
    pub(super) fn at(&mut self, f: ExprId, point: &[Symbol]) -> ExprId {
        let mut replacements = Vec::with_capacity(point.len());
        for (&x, &symbol) in self.variables.iter().zip(point) {
            replacements.push((x, self.graph.variable(symbol)));
        }
        substitute(&mut self.graph, f, &replacements)
    }

    /// `F[x_i: a, b]` with the other variables at a state, as a local.
    pub(super) fn along(
        &mut self,
        f: ExprId,
        i: usize,
        ends: [Symbol; 2],
        point: &[Symbol],
    ) -> ExprId {
        let f = self.at(f, &self.except(i, point));
        self.difference(f, i, ends)
    }

    /// The same, but at the temperature `theta`.
    pub(super) fn along_at(
        &mut self,
        f: ExprId,
        i: usize,
        ends: [Symbol; 2],
        point: &[Symbol],
        theta: ExprId,
    ) -> ExprId {
        let last = self.mechanical;
        let mut others = self.except(i, point);
        others[last] = self.variables[last];
        let f = self.at(f, &others);
        let f = substitute(&mut self.graph, f, &[(self.variables[last], theta)]);
        self.difference(f, i, ends)
    }

    /// The state `point`, but with the symbol of the model for variable `i`.
    pub(super) fn except(&self, i: usize, point: &[Symbol]) -> Point {
        let mut others = point.to_vec();
        others[i] = self.variables[i];
        others
    }

    /// Whether a divided difference depends on the temperature of a state.
    pub(super) fn feels_temperature(&self, difference: ExprId, point: &[Symbol]) -> bool {
        let value = self.locals.resolve(&self.graph, difference);
        self.graph.depends_on(value, point[self.mechanical])
    }

    pub(super) fn difference(&mut self, f: ExprId, i: usize, [a, b]: [Symbol; 2]) -> ExprId {
        let x = self.variables[i];
        let (a, b) = (self.graph.variable(a), self.graph.variable(b));
        let quotient = divided_difference(&mut self.graph, f, x, a, b);
        self.name(quotient)
    }

    pub(super) fn name(&mut self, value: ExprId) -> ExprId {
        self.locals.name(&mut self.graph, value)
    }

    /// `a / b` as a local. Common factors of products cancel: a constant heat capacity drops out.
    pub(super) fn quotient(&mut self, a: ExprId, b: ExprId) -> ExprId {
        let [a, b] = [a, b].map(|value| self.locals.resolve(&self.graph, value));
        let quotient = self.graph.div(a, b);
        self.name(quotient)
    }

    /// `1 / a` as a local.
    pub(super) fn reciprocal(&mut self, a: ExprId) -> ExprId {
        let one = self.graph.integer(1);
        self.quotient(one, a)
    }

    /// `∂/∂symbol` of a value; of its definition if it is a local.
    pub(super) fn partial(&mut self, value: ExprId, symbol: Symbol) -> ExprId {
        let value = self.locals.resolve(&self.graph, value);
        diff(&mut self.graph, value, symbol)
    }

    /// `∂F/∂x_i` at a state, as a local.
    pub(super) fn slope_at(&mut self, f: ExprId, i: usize, point: &[Symbol]) -> ExprId {
        let slope = diff(&mut self.graph, f, self.variables[i]);
        let slope = self.at(slope, point);
        self.name(slope)
    }

    /// `½ (a + b + …)`.
    pub(super) fn half(&mut self, terms: &[ExprId]) -> ExprId {
        if let [a, b] = terms
            && a == b
        {
            return *a;
        }
        let sum = self.graph.sum(terms);
        let (coefficient, term) = self.graph.as_scaled(sum).unwrap_or((Number::ONE, sum));
        let term = self.name(term);
        self.graph.scale(coefficient * Number::HALF, term)
    }

    /// The sum of differences along several edges as a local. It is formed from the definitions of
    /// their locals, because these have most terms in common.
    pub(super) fn sum_of(&mut self, values: &[ExprId]) -> ExprId {
        let values: Vec<_> = values
            .iter()
            .map(|&value| self.locals.resolve(&self.graph, value))
            .collect();
        let sum = self.graph.sum(&values);
        self.name(sum)
    }

    /// `x_i¹ − x_i⁰`.
    pub(super) fn increment(&mut self, i: usize) -> ExprId {
        let (old, new) = (
            self.graph.variable(self.old[i]),
            self.graph.variable(self.new[i]),
        );
        let increment = self.graph.sub(new, old);
        self.name(increment)
    }

    /// `D_λ e` of a measure is f*, `−D_γ e` of a dashpot is g*.
    pub(super) fn conjugate(&mut self, i: usize, derivative: ExprId) -> ExprId {
        if i < self.measures {
            derivative
        } else {
            self.graph.neg(derivative)
        }
    }
}

/// The first `i` variables of `before` and the others of `after`.
pub(super) fn mixed(i: usize, before: &[Symbol], after: &[Symbol]) -> Point {
    before[..i].iter().chain(&after[i..]).copied().collect()
}

/// Temperatures at the corners of the staircase from x⁰ to x¹ (`up`), then of the one back (`down`).
fn corner_symbols(graph: &mut Graph, theta: Symbol, mechanical: usize) -> Vec<Symbol> {
    let name = graph.name(theta).to_owned();
    let mut corners = Vec::new();
    for chain in ["up", "down"] {
        for k in 1..=mechanical {
            corners.push(graph.version(theta, &format!("{name}[{chain} {k}]")));
        }
    }
    corners
}
