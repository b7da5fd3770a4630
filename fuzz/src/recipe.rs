//! Bytes as the program of a stack machine that builds expressions.

use std::collections::BTreeSet;

use eem_symbolic::{ExprId, Function, Graph, Model, Node, Number, Symbol, diff};

/// Larger expressions say nothing new and take long.
const LARGEST: usize = 40;
/// Orders of magnitude of all numbers together, of which the second derivative of a product has three
/// times as many at most.
const DECADES: f64 = 60.0;
/// Expressions that are kept on the stack.
const DEEPEST: usize = 8;
const NAMES: [&str; 5] = ["lambda", "gamma", "theta", "k", "c"];

/// A free energy ψ(λ, γ, θ; k, c) that the bytes describe.
pub(crate) struct Recipe {
    pub(crate) graph: Graph,
    /// λ, γ, θ, k, c.
    pub(crate) symbols: [Symbol; 5],
    pub(crate) psi: ExprId,
}

struct Machine {
    graph: Graph,
    symbols: [Symbol; 5],
    stack: Vec<ExprId>,
}

impl Recipe {
    /// Every sequence of bytes describes something.
    pub(crate) fn read(data: &[u8]) -> Self {
        let mut graph = Graph::new();
        let symbols = NAMES.map(|name| graph.symbol(name));
        let mut machine = Machine {
            graph,
            symbols,
            stack: Vec::new(),
        };
        let mut bytes = data.iter().copied();
        while let Some(code) = bytes.next() {
            machine.step(code, &mut bytes);
        }
        let Machine {
            mut graph,
            symbols,
            stack,
        } = machine;
        let psi = graph.sum(&stack);
        Self {
            graph,
            symbols,
            psi,
        }
    }

    /// Whether its numbers are so far from overflow that no derivative contains an infinite one,
    /// which the front end refuses before there are programs.
    pub(crate) fn is_tame(&self) -> bool {
        let (mut pending, mut seen, mut decades) = (vec![self.psi], BTreeSet::new(), 0.0);
        let size = |number: f64| number.abs().log10().abs();
        while let Some(e) = pending.pop() {
            if !seen.insert(e) {
                continue;
            }
            match self.graph.node(e) {
                Node::Number(number) if *number == Number::ZERO => {}
                Node::Number(number) => decades += size(number.to_f64()),
                Node::Sum { constant, terms } => {
                    let numbers = terms.iter().map(|(number, _)| number).chain([constant]);
                    let numbers = numbers.filter(|&&number| number != Number::ZERO);
                    decades += numbers.map(|number| size(number.to_f64())).sum::<f64>();
                    pending.extend(terms.iter().map(|&(_, term)| term));
                }
                Node::Product(factors) => {
                    decades += factors
                        .iter()
                        .map(|(_, power)| size(power.to_f64()))
                        .sum::<f64>();
                    pending.extend(factors.iter().map(|&(base, _)| base));
                }
                &Node::Power(base, exponent) => pending.extend([base, exponent]),
                &Node::Apply(_, argument) => pending.push(argument),
                _ => {}
            }
        }
        decades <= DECADES
    }

    /// The same as a constitutive law, with the viscosity c.
    pub(crate) fn model(&self) -> Model {
        let [lambda, gamma, theta, k, c] = self.symbols;
        let mut graph = self.graph.clone();
        let viscosity = graph.variable(c);
        Model {
            graph,
            measures: vec![lambda],
            strains: vec![],
            dashpots: vec![gamma],
            temperature: Some(theta),
            parameters: vec![k, c],
            psi: self.psi,
            viscosities: vec![viscosity],
            drag: None,
        }
    }
}

impl Machine {
    fn step(&mut self, code: u8, bytes: &mut impl Iterator<Item = u8>) {
        let result = match code % 16 {
            index @ 0..=4 => Some(self.graph.variable(self.symbols[usize::from(index)])),
            5 => bytes.next().map(|byte| self.number(byte)),
            6 => self.binary(Graph::add),
            7 => self.binary(Graph::sub),
            8 => self.binary(Graph::mul),
            9 => self.binary(Graph::div),
            10 => self.binary(Graph::power),
            11 => self.unary(Graph::sqrt),
            12 => bytes.next().and_then(|byte| self.whole_power(byte)),
            13 => bytes.next().and_then(|byte| self.function(byte)),
            14 => bytes.next().and_then(|byte| self.derivative(byte)),
            _ => self.stack.last().copied(),
        };
        let Some(result) = result else { return };
        if self.graph.size(result) <= LARGEST && self.stack.len() < DEEPEST {
            self.stack.push(result);
        }
    }

    /// Eighths and powers of ten.
    fn number(&mut self, byte: u8) -> ExprId {
        let text = if byte < 192 {
            format!("{}", (f64::from(byte) - 64.0) / 8.0)
        } else {
            format!("1e{}", i32::from(byte) - 224)
        };
        let parsed = Number::parse_decimal(&text);
        let number = parsed.unwrap_or_else(|| Number::Float(text.parse().unwrap_or(f64::NAN)));
        self.graph.number(number)
    }

    fn binary(&mut self, build: fn(&mut Graph, ExprId, ExprId) -> ExprId) -> Option<ExprId> {
        let (b, a) = (self.stack.pop()?, self.stack.pop()?);
        Some(build(&mut self.graph, a, b))
    }

    fn unary(&mut self, build: fn(&mut Graph, ExprId) -> ExprId) -> Option<ExprId> {
        let a = self.stack.pop()?;
        Some(build(&mut self.graph, a))
    }

    fn whole_power(&mut self, byte: u8) -> Option<ExprId> {
        let base = self.stack.pop()?;
        Some(self.graph.powi(base, i32::from(byte) - 128))
    }

    /// All functions but |x|, which the state may not enter.
    fn function(&mut self, byte: u8) -> Option<ExprId> {
        let functions = || {
            Function::ALL
                .iter()
                .filter(|&&function| function != Function::Abs)
        };
        let function = functions().nth(usize::from(byte) % functions().count())?;
        let argument = self.stack.pop()?;
        Some(self.graph.apply(*function, argument))
    }

    fn derivative(&mut self, byte: u8) -> Option<ExprId> {
        let e = self.stack.pop()?;
        Some(diff(
            &mut self.graph,
            e,
            self.symbols[usize::from(byte % 3)],
        ))
    }
}
