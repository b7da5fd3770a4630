//! Rust arithmetic that builds expressions.

use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use eem_symbolic::{ExprId, Function, Graph, Model, Node, Number, Symbol};

thread_local! {
    static GRAPH: RefCell<Graph> = RefCell::new(Graph::new());
}

/// An expression of the current graph.
#[derive(Clone, Copy)]
pub(crate) struct E(ExprId);

/// What an argument stands for.
pub(crate) enum Role {
    Stretch,
    Viscous,
    Temperature,
}

fn with(build: impl FnOnce(&mut Graph) -> ExprId) -> E {
    GRAPH.with(|graph| E(build(&mut graph.borrow_mut())))
}

/// Starts a new graph.
pub(crate) fn begin() {
    GRAPH.with(|graph| *graph.borrow_mut() = Graph::new());
}

/// The variable of that name.
pub(crate) fn variable(name: &str) -> E {
    with(|graph| {
        let symbol = graph.symbol(name);
        graph.variable(symbol)
    })
}

fn symbol(e: E) -> Symbol {
    GRAPH.with(|graph| match graph.borrow().node(e.0) {
        Node::Variable(symbol) => *symbol,
        other => panic!("{other:?} is not a variable"),
    })
}

/// The model of the current graph.
pub(crate) fn model(arguments: &[(Role, E)], parameters: &[E], psi: E, viscosities: &[E]) -> Model {
    let of_role = |wanted: fn(&Role) -> bool| {
        let arguments = arguments.iter().filter(move |(role, _)| wanted(role));
        arguments.map(|&(_, e)| symbol(e)).collect::<Vec<Symbol>>()
    };
    Model {
        measures: of_role(|role| matches!(role, Role::Stretch)),
        strains: vec![],
        dashpots: of_role(|role| matches!(role, Role::Viscous)),
        temperature: of_role(|role| matches!(role, Role::Temperature))
            .first()
            .copied(),
        parameters: parameters.iter().map(|&e| symbol(e)).collect(),
        graph: GRAPH.with(|graph| graph.borrow().clone()),
        psi: psi.0,
        viscosities: viscosities.iter().map(|e| e.0).collect(),
        drag: None,
    }
}

impl From<f64> for E {
    /// The decimal number that was written, not the float.
    fn from(value: f64) -> E {
        let number = Number::parse_decimal(&value.to_string()).expect("a literal is a number");
        with(|graph| graph.number(number))
    }
}

/// The partial derivative with respect to a variable.
pub(crate) fn diff(e: E, x: E) -> E {
    let x = symbol(x);
    with(|graph| eem_symbolic::diff(graph, e.0, x))
}

impl E {
    pub(crate) fn powi(self, n: i32) -> E {
        with(|graph| graph.powi(self.0, n))
    }

    pub(crate) fn powf(self, exponent: impl Into<E>) -> E {
        let exponent = exponent.into();
        with(|graph| graph.power(self.0, exponent.0))
    }

    pub(crate) fn recip(self) -> E {
        with(|graph| graph.recip(self.0))
    }

    pub(crate) fn sqrt(self) -> E {
        with(|graph| graph.sqrt(self.0))
    }
}

macro_rules! functions {
    ($($name:ident: $function:ident),* $(,)?) => {
        impl E {
            $(pub(crate) fn $name(self) -> E {
                with(|graph| graph.apply(Function::$function, self.0))
            })*
        }
        // Not every law writes every function in both forms.
        $(#[allow(dead_code)]
        pub(crate) fn $name(x: E) -> E {
            x.$name()
        })*
    };
}

functions! {
    exp: Exp, exp_m1: ExpM1, ln: Ln, ln_1p: Ln1p, log2: Log2, log10: Log10, sin: Sin, cos: Cos,
    tan: Tan, sinh: Sinh, cosh: Cosh, tanh: Tanh, asinh: Asinh, atan: Atan, atanh: Atanh,
    cbrt: Cbrt, abs: Abs,
}

impl Neg for E {
    type Output = E;

    fn neg(self) -> E {
        with(|graph| graph.neg(self.0))
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident),* $(,)?) => {$(
        impl<T: Into<E>> $operator<T> for E {
            type Output = E;

            fn $method(self, other: T) -> E {
                let other = other.into();
                with(|graph| graph.$method(self.0, other.0))
            }
        }

        impl $operator<E> for f64 {
            type Output = E;

            fn $method(self, other: E) -> E {
                $operator::$method(E::from(self), other)
            }
        }
    )*};
}

operators! { Add add, Sub sub, Mul mul, Div div }
