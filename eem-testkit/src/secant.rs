//! Divided differences of random expressions.

use eem_symbolic::{
    Arithmetic, ExprId, Graph, Input, Instruction, Operation, Program, Stage, Symbol, Value, diff,
    divided_difference, schedule,
};

use crate::random::{Random, expression};

const DEPTH: usize = 6;
/// Expressions that grow beyond this say nothing about rounding.
const LARGE: f64 = 1e6;
/// The quadrature in error bounds, and where it stands for kernels, does not resolve sin between larger arguments.
const OSCILLATING: f64 = 50.0;

/// f(x), f\[a, b\] and f\[a, b, b\] = ∂f\[a, b\]/∂b of a random expression.
pub struct Secant {
    pub value: Program,
    pub difference: Program,
    pub slope: Program,
}

/// An expression as a function of symbols.
pub fn program(graph: &Graph, symbols: &[Symbol], output: ExprId) -> Program {
    let input = |&symbol: &Symbol| Input {
        symbol,
        name: graph.name(symbol).to_owned(),
        stage: Stage::New,
    };
    schedule(graph, symbols.iter().map(input).collect(), &[output])
}

/// The first output.
pub fn run<A: Arithmetic>(program: &Program, arithmetic: &A, inputs: &[A::Number]) -> A::Number {
    program.interpret(arithmetic, inputs).swap_remove(0)
}

/// The first end of a random expression.
pub fn start(seed: u64) -> f64 {
    0.3 + 1.5 * Random::new(seed ^ 0xabcd).unit()
}

impl Secant {
    pub fn new(seed: u64) -> Self {
        let mut random = Random::new(seed);
        let mut graph = Graph::new();
        let x = graph.symbol("x");
        let variable = graph.variable(x);
        let e = expression(&mut graph, &mut random, variable, DEPTH);
        let symbols = ["a", "b"].map(|end| graph.version(x, end));
        let [a, b] = symbols.map(|end| graph.variable(end));
        let difference = divided_difference(&mut graph, e, x, a, b);
        let slope = diff(&mut graph, difference, symbols[1]);
        Self {
            value: program(&graph, &[x], e),
            difference: program(&graph, &symbols, difference),
            slope: program(&graph, &symbols, slope),
        }
    }

    /// Whether value and difference are of moderate size at these ends, and the arguments of all divided differences small.
    pub fn is_moderate(&self, arithmetic: &impl Arithmetic<Number = f64>, ends: [f64; 2]) -> bool {
        let mut all = self.difference.clone();
        all.outputs = (0..all.instructions.len()).map(Value::new).collect();
        let values = all.interpret(arithmetic, &ends);
        let is_resolved = |instruction: &Instruction| match &instruction.operation {
            Operation::DividedDifference(_, a, b) => {
                let ends = [a, b].map(|end| values[end.index()]);
                ends.iter().all(|end| end.abs() < OSCILLATING)
            }
            _ => true,
        };
        let difference = values[self.difference.outputs[0].index()];
        let [at_a, at_b] = ends.map(|x| run(&self.value, arithmetic, &[x]));
        let sizes = [at_a, at_b, difference];
        sizes.iter().all(|size| size.abs() < LARGE) && all.instructions.iter().all(is_resolved)
    }
}
