//! Numbers that are expressions: what the macro should have understood.

use std::cell::RefCell;

use eem_symbolic::{ExprId, Function, Graph, LowerBound, Model, Node, Number, Rational, Symbol};

use crate::zoo::number::{Num, Value};

thread_local! {
    static GRAPH: RefCell<Graph> = RefCell::new(Graph::new());
}

fn with<T>(use_graph: impl FnOnce(&mut Graph) -> T) -> T {
    GRAPH.with(|graph| use_graph(&mut graph.borrow_mut()))
}

fn symbol(e: ExprId) -> Symbol {
    with(|graph| match graph.node(e) {
        Node::Variable(symbol) => *symbol,
        other => panic!("{other:?} is not a variable"),
    })
}

impl Value for ExprId {
    fn literal(value: f64) -> Self {
        let number = Number::parse_decimal(&value.to_string()).expect("a literal is a number");
        with(|graph| graph.number(number))
    }

    fn add(self, other: Self) -> Self {
        with(|graph| graph.add(self, other))
    }

    fn sub(self, other: Self) -> Self {
        with(|graph| graph.sub(self, other))
    }

    fn mul(self, other: Self) -> Self {
        with(|graph| graph.mul(self, other))
    }

    fn div(self, other: Self) -> Self {
        with(|graph| graph.div(self, other))
    }

    fn powi(self, n: i32) -> Self {
        with(|graph| graph.powi(self, n))
    }

    fn power(self, exponent: Self) -> Self {
        with(|graph| graph.power(self, exponent))
    }

    fn apply(self, function: Function) -> Self {
        with(|graph| graph.apply(function, self))
    }

    fn sqrt(self) -> Self {
        with(|graph| graph.sqrt(self))
    }

    fn neg(self) -> Self {
        with(|graph| graph.neg(self))
    }

    fn diff(self, variable: Self) -> Self {
        let variable = symbol(variable);
        with(|graph| eem_symbolic::diff(graph, self, variable))
    }
}

/// The parts of a model that a formula consists of.
pub(crate) struct Written {
    pub(crate) psi: Num<ExprId>,
    pub(crate) viscosities: Vec<Num<ExprId>>,
}

/// From where on the strain of this role is.
fn bound(symbol: Symbol, role: &str) -> Option<LowerBound> {
    Some(match role {
        "StrainTrace" => LowerBound::above(symbol, Rational::new(-3, 2)?),
        "StrainSquare" | "ViscousSquare" => LowerBound::from(symbol, Rational::ZERO),
        "Dilatation" => LowerBound::above(symbol, Rational::MINUS_ONE),
        "FibreStrain" => LowerBound::above(symbol, Rational::new(-1, 2)?),
        _ => return None,
    })
}

/// The model that `write(variables, parameters)` writes down; the variables are in the order of
/// the state.
pub(crate) fn model(
    variables: &[&str],
    roles: &[&str],
    parameters: &[&str],
    write: impl FnOnce(&[Num<ExprId>], &[Num<ExprId>]) -> Written,
) -> Model {
    with(|graph| *graph = Graph::new());
    let variable = |name: &&str| {
        with(|graph| {
            let symbol = graph.symbol(name);
            Num(graph.variable(symbol))
        })
    };
    let x: Vec<_> = variables.iter().map(variable).collect();
    let p: Vec<_> = parameters.iter().map(variable).collect();
    let Written { psi, viscosities } = write(&x, &p);
    let x: Vec<Symbol> = x.iter().map(|x| symbol(x.0)).collect();
    let of_role = |wanted: &str| {
        let pairs = x.iter().zip(roles).filter(|(_, role)| **role == wanted);
        pairs.map(|(&symbol, _)| symbol).collect::<Vec<_>>()
    };
    let pairs = x.iter().zip(roles);
    let strains = pairs.filter_map(|(&symbol, role)| bound(symbol, role));
    let strains: Vec<_> = strains.collect();
    let pairs = x.iter().zip(roles);
    let measures = pairs.filter(|(_, role)| !["Viscous", "Temperature"].contains(role));
    Model {
        measures: measures.map(|(&symbol, _)| symbol).collect(),
        strains,
        dashpots: of_role("Viscous"),
        temperature: of_role("Temperature").pop(),
        parameters: p.iter().map(|p| symbol(p.0)).collect(),
        graph: with(|graph| graph.clone()),
        psi: psi.0,
        viscosities: viscosities.iter().map(|eta| eta.0).collect(),
        drag: None,
    }
}
