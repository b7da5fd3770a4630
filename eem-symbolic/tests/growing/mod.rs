//! Families of free energies of any size.

#![allow(dead_code)] // Tests and benchmarks use a part each.

use eem_symbolic::{ExprId, Function, Graph, Model, Symbol, diff};

/// Free energies of one build.
pub(crate) struct Family {
    pub(crate) name: &'static str,
    /// The member with a number of repetitions.
    pub(crate) model: fn(usize) -> Model,
}

/// All of them.
pub(crate) const FAMILIES: [Family; 5] = [
    Family {
        name: "nested functions",
        model: nested,
    },
    Family {
        name: "chain",
        model: chain,
    },
    Family {
        name: "quotients",
        model: quotients,
    },
    Family {
        name: "sum",
        model: sum,
    },
    Family {
        name: "product",
        model: product,
    },
];

/// What formulas are written in.
struct Writer {
    graph: Graph,
    symbols: [Symbol; 2],
    lambda: ExprId,
    theta: ExprId,
}

impl Writer {
    fn new() -> Self {
        let mut graph = Graph::new();
        let symbols = ["lambda", "theta"].map(|name| graph.symbol(name));
        let [lambda, theta] = symbols.map(|symbol| graph.variable(symbol));
        Self {
            graph,
            symbols,
            lambda,
            theta,
        }
    }

    fn model(self, psi: ExprId) -> Model {
        Model {
            graph: self.graph,
            measures: vec![self.symbols[0]],
            strains: vec![],
            dashpots: Vec::new(),
            temperature: Some(self.symbols[1]),
            parameters: Vec::new(),
            psi,
            viscosities: Vec::new(),
            drag: None,
        }
    }

    /// e − θ ln θ.
    fn with_capacity(&mut self, e: ExprId) -> ExprId {
        let logarithm = self.graph.apply(Function::Ln, self.theta);
        let product = self.graph.mul(self.theta, logarithm);
        self.graph.sub(e, product)
    }
}

/// e ← ln(1 + exp(e θ)).
fn nested(count: usize) -> Model {
    let mut w = Writer::new();
    let one = w.graph.integer(1);
    let mut e = w.lambda;
    for _ in 0..count {
        let product = w.graph.mul(e, w.theta);
        let power = w.graph.apply(Function::Exp, product);
        let sum = w.graph.add(one, power);
        e = w.graph.apply(Function::Ln, sum);
    }
    w.model(e)
}

/// e ← θ sin e.
fn chain(count: usize) -> Model {
    let mut w = Writer::new();
    let mut e = w.lambda;
    for _ in 0..count {
        let sine = w.graph.apply(Function::Sin, e);
        e = w.graph.mul(sine, w.theta);
    }
    w.model(e)
}

/// e ← λ/(e + 1) + θ.
fn quotients(count: usize) -> Model {
    let mut w = Writer::new();
    let one = w.graph.integer(1);
    let mut e = w.graph.mul(w.lambda, w.theta);
    for _ in 0..count {
        let sum = w.graph.add(e, one);
        let quotient = w.graph.div(w.lambda, sum);
        e = w.graph.add(quotient, w.theta);
    }
    w.model(e)
}

/// Σ sin(k λ + θ) − θ ln θ.
fn sum(count: usize) -> Model {
    let mut w = Writer::new();
    let mut e = w.graph.integer(0);
    for k in (1..).take(count) {
        let factor = w.graph.integer(k);
        let product = w.graph.mul(factor, w.lambda);
        let argument = w.graph.add(product, w.theta);
        let sine = w.graph.apply(Function::Sin, argument);
        e = w.graph.add(e, sine);
    }
    let psi = w.with_capacity(e);
    w.model(psi)
}

/// Π (λ + k + θ).
fn product(count: usize) -> Model {
    let mut w = Writer::new();
    let mut e = w.theta;
    for k in (1..).take(count) {
        let constant = w.graph.integer(k);
        let factor = w.graph.sum(&[w.lambda, constant, w.theta]);
        e = w.graph.mul(e, factor);
    }
    w.model(e)
}

/// The mixed derivative of some order of sin(λθ) exp(λ), less θ ln θ.
pub(crate) fn derivative(order: usize) -> Model {
    let mut w = Writer::new();
    let product = w.graph.mul(w.lambda, w.theta);
    let sine = w.graph.apply(Function::Sin, product);
    let power = w.graph.apply(Function::Exp, w.lambda);
    let mut e = w.graph.mul(sine, power);
    for i in 0..order {
        e = diff(&mut w.graph, e, w.symbols[i % 2]);
    }
    let psi = w.with_capacity(e);
    w.model(psi)
}
