//! Random expressions, the same in every run.

use eem_symbolic::{ExprId, Function, Graph, Number};

/// xorshift64*, Vigna 2016.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    pub fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    pub fn below(&mut self, bound: usize) -> usize {
        ((self.next() >> 33) as usize) % bound
    }

    /// Uniform in \[0, 1).
    pub fn unit(&mut self) -> f64 {
        #[allow(clippy::cast_precision_loss)] // An integer of 53 bits.
        let mantissa = (self.next() >> 11) as f64;
        mantissa * 2.0_f64.powi(-53)
    }
}

/// A random expression of x with all functions of the table but |x|, defined for every x > 0.
pub fn expression(graph: &mut Graph, random: &mut Random, x: ExprId, depth: usize) -> ExprId {
    if depth == 0 || random.below(12) == 0 {
        return leaf(graph, random, x);
    }
    let inner = expression(graph, random, x, depth - 1);
    match random.below(16) {
        0..=2 => {
            let other = expression(graph, random, x, depth - 1);
            graph.add(inner, other)
        }
        3 => {
            let other = expression(graph, random, x, depth - 1);
            graph.sub(inner, other)
        }
        4..=6 => {
            let other = expression(graph, random, x, depth - 1);
            graph.mul(inner, other)
        }
        7 | 8 => {
            let other = expression(graph, random, x, depth - 1);
            let other = positive(graph, other);
            graph.div(inner, other)
        }
        9 => {
            let exponent = [-3, -2, 2, 3, 4, 5][random.below(6)];
            let base = if exponent < 0 {
                positive(graph, inner)
            } else {
                inner
            };
            graph.powi(base, exponent)
        }
        10 => {
            let base = positive(graph, inner);
            let exponent = decimal(graph, ["0.5", "1.5", "0.3", "-0.7", "2.5"][random.below(5)]);
            graph.power(base, exponent)
        }
        11 => {
            let base = positive(graph, inner);
            let exponent = expression(graph, random, x, depth - 1);
            let exponent = graph.apply(Function::Tanh, exponent);
            graph.power(base, exponent)
        }
        _ => function(graph, random, inner),
    }
}

fn leaf(graph: &mut Graph, random: &mut Random, x: ExprId) -> ExprId {
    if random.below(3) > 0 {
        return x;
    }
    let decimals = ["0.1", "0.7", "1.3", "2", "3.25"];
    decimal(graph, decimals[random.below(5)])
}

fn decimal(graph: &mut Graph, text: &str) -> ExprId {
    let number = Number::parse_decimal(text).expect("a decimal number");
    graph.number(number)
}

/// `e² + ½`.
fn positive(graph: &mut Graph, e: ExprId) -> ExprId {
    let square = graph.powi(e, 2);
    let half = graph.number(Number::HALF);
    graph.add(square, half)
}

/// `½ sin e`.
fn small(graph: &mut Graph, e: ExprId) -> ExprId {
    let sine = graph.apply(Function::Sin, e);
    graph.scale(Number::HALF, sine)
}

fn function(graph: &mut Graph, random: &mut Random, e: ExprId) -> ExprId {
    let functions = &Function::ALL[..Function::ALL.len() - 1];
    let function = functions[random.below(functions.len())];
    let argument = match function {
        Function::Ln | Function::Log2 | Function::Log10 | Function::Ln1p | Function::Cbrt => {
            positive(graph, e)
        }
        Function::Exp
        | Function::ExpM1
        | Function::Tan
        | Function::Sinh
        | Function::Cosh
        | Function::Atanh => small(graph, e),
        Function::Sin
        | Function::Cos
        | Function::Tanh
        | Function::Asinh
        | Function::Atan
        | Function::Abs => e,
    };
    graph.apply(function, argument)
}
