//! Derivatives of a program: the rules that the reverse and the forward sweep have in common.
//!
//! ```text
//! y = a b        ∂y/∂a = b                ∂y/∂b = a
//! y = a / b      ∂y/∂a = 1/b              ∂y/∂b = −y/b
//! y = aⁿ         ∂y/∂a = n aⁿ⁻¹
//! y = √a         ∂y/∂a = ½/y
//! y = aᵇ         ∂y/∂a = b aᵇ⁻¹           ∂y/∂b = y ln a
//! y = f(a)       ∂y/∂a = f′(a)
//! y = f[a, b]    ∂y/∂a = f[a, a, b]       ∂y/∂b = f[a, b, b]
//! y = xᵖ[a, b]   ∂y/∂p = ½ (y (ln a + ln b) + ln[a, b] (aᵖ + bᵖ))
//! ```
//!
//! Third divided differences are not part of the language: where the derivative of an `f[a, b, b]` would be needed, the
//! result is NaN, which [`Program::verify`] refuses.

use crate::composer::{Composer, Signed};
use crate::function::Function;
use crate::graph::Graph;
use crate::number::Number;
use crate::operation::{Operation, ProgramKernel, Value};
use crate::program::{Input, Program, Stage};
use crate::schedule::schedule;

/// A program, and instructions after it that compute derivatives of its values.
pub(crate) struct Sweep {
    pub(crate) composer: Composer,
    /// The operations of the program; value i is the result of operation i.
    operations: Vec<Operation>,
    /// The outputs of the program.
    pub(crate) outputs: Vec<Value>,
}

/// The derivative of an operation with respect to one of its operands: `± factor / divisor`.
struct Slope {
    operand: Value,
    negative: bool,
    factor: Option<Value>,
    divisor: Option<Value>,
}

impl Slope {
    fn one(operand: Value) -> Self {
        Self {
            operand,
            negative: false,
            factor: None,
            divisor: None,
        }
    }

    fn factor(operand: Value, factor: Value) -> Self {
        Self {
            factor: Some(factor),
            ..Self::one(operand)
        }
    }

    fn negated(self) -> Self {
        Self {
            negative: !self.negative,
            ..self
        }
    }

    fn over(self, divisor: Value) -> Self {
        Self {
            divisor: Some(divisor),
            ..self
        }
    }

    /// `x · slope`.
    fn times(&self, composer: &mut Composer, x: Signed) -> Signed {
        let mut value = x.value;
        if let Some(divisor) = self.divisor {
            value = composer.emit(Operation::Div(value, divisor));
        }
        if let Some(factor) = self.factor {
            value = composer.mul(value, factor);
        }
        Signed {
            negative: x.negative != self.negative,
            value,
        }
    }
}

impl Sweep {
    /// Starts with a verified program; the inputs `further` follow its own.
    pub(crate) fn new(program: &Program, further: &[Input]) -> Self {
        let alone = program.alone();
        let mut inputs = program.inputs.clone();
        inputs.extend_from_slice(further);
        let mut composer = Composer::new(inputs);
        let outputs = composer.inline(&alone, Composer::input);
        Self {
            operations: composer.operations().to_vec(),
            composer,
            outputs,
        }
    }

    /// `Σ weight ∂output/∂input` of the wanted inputs; `None` where no weighted output depends on the input.
    pub(crate) fn backward(
        &mut self,
        weights: &[Option<Signed>],
        wanted: &[usize],
    ) -> Vec<Option<Signed>> {
        let active = self.active(wanted);
        let mut adjoints: Vec<Option<Signed>> = vec![None; self.operations.len()];
        for (index, &weight) in weights.iter().enumerate() {
            if let Some(weight) = weight {
                self.accumulate(&mut adjoints[self.outputs[index].index()], weight);
            }
        }
        for index in (0..self.operations.len()).rev() {
            let Some(adjoint) = adjoints[index] else {
                continue;
            };
            for slope in self.slopes(index, &active) {
                let term = slope.times(&mut self.composer, adjoint);
                self.accumulate(&mut adjoints[slope.operand.index()], term);
            }
        }
        let of_input = |input| {
            let mut operations = self.operations.iter();
            let index = operations.position(|operation| *operation == Operation::Input(input));
            index.and_then(|index| adjoints[index])
        };
        wanted.iter().map(|&input| of_input(input)).collect()
    }

    /// `Σ ∂output/∂input · direction` of the outputs; `None` where an output depends on none of these inputs.
    pub(crate) fn forward(&mut self, directions: &[(usize, Signed)]) -> Vec<Option<Signed>> {
        let wanted: Vec<_> = directions.iter().map(|&(input, _)| input).collect();
        let active = self.active(&wanted);
        let mut tangents: Vec<Option<Signed>> = vec![None; self.operations.len()];
        for index in 0..self.operations.len() {
            if let Operation::Input(input) = self.operations[index] {
                let direction = directions.iter().find(|(wanted, _)| *wanted == input);
                tangents[index] = direction.map(|&(_, direction)| direction);
                continue;
            }
            for slope in self.slopes(index, &active) {
                if let Some(tangent) = tangents[slope.operand.index()] {
                    let term = slope.times(&mut self.composer, tangent);
                    self.accumulate(&mut tangents[index], term);
                }
            }
        }
        let outputs = self.outputs.iter();
        outputs.map(|output| tangents[output.index()]).collect()
    }

    /// The program of these outputs; `None` is zero.
    pub(crate) fn finish(self, outputs: &[Option<Signed>]) -> Program {
        self.composer.finish(outputs)
    }

    pub(crate) fn accumulate(&mut self, sum: &mut Option<Signed>, term: Signed) {
        *sum = Some(match *sum {
            Some(sum) => self.composer.add(sum, term),
            None => term,
        });
    }

    /// For each value, whether it depends on one of the inputs.
    fn active(&self, inputs: &[usize]) -> Vec<bool> {
        let mut active = Vec::with_capacity(self.operations.len());
        for operation in &self.operations {
            let depends = match operation {
                Operation::Input(input) => inputs.contains(input),
                operation => {
                    let operands = operation.operands();
                    operands.iter().any(|operand| active[operand.index()])
                }
            };
            active.push(depends);
        }
        active
    }

    /// The derivatives of a value with respect to its active operands.
    fn slopes(&mut self, index: usize, active: &[bool]) -> Vec<Slope> {
        if !active[index] {
            return Vec::new();
        }
        let y = Value::new(index);
        let is_active = |operand: Value| active[operand.index()];
        let mut slopes = match self.operations[index] {
            Operation::Input(_) | Operation::Constant(_) => Vec::new(),
            Operation::Add(a, b) => vec![Slope::one(a), Slope::one(b)],
            Operation::Sub(a, b) => vec![Slope::one(a), Slope::one(b).negated()],
            Operation::Mul(a, b) => vec![Slope::factor(a, b), Slope::factor(b, a)],
            Operation::Div(a, b) if self.composer.is_one(a) => {
                let square = self.composer.mul(y, y);
                vec![Slope::factor(b, square).negated()]
            }
            Operation::Div(a, b) => {
                vec![Slope::one(a).over(b), Slope::factor(b, y).over(b).negated()]
            }
            Operation::Neg(a) => vec![Slope::one(a).negated()],
            Operation::Powi(a, n) => vec![Slope::factor(a, self.whole_power(a, n))],
            Operation::Sqrt(a) => {
                let half = self.composer.number(Number::HALF);
                vec![Slope::factor(a, half).over(y)]
            }
            Operation::Power(a, b) => self.power([a, b], y, is_active),
            Operation::Apply(function, a) => vec![Slope::factor(a, self.function(function, a))],
            Operation::DividedDifference(kernel, a, b) => {
                self.difference(kernel, [a, b], y, is_active)
            }
            Operation::SecondDividedDifference(..) => {
                let refused = self.composer.number(f64::NAN.into());
                let operands = self.operations[index].operands().into_iter();
                operands
                    .map(|operand| Slope::factor(operand, refused))
                    .collect()
            }
            Operation::JointDifferences(..) | Operation::Part(..) => {
                unreachable!("every difference is computed alone")
            }
        };
        slopes.retain(|slope| is_active(slope.operand));
        slopes
    }

    /// `n aⁿ⁻¹`, n ≥ 3.
    fn whole_power(&mut self, a: Value, n: i32) -> Value {
        let lower = if n == 3 {
            self.composer.mul(a, a)
        } else {
            self.composer.emit(Operation::Powi(a, n - 1))
        };
        let exponent = self.composer.number(i64::from(n).into());
        self.composer.mul(exponent, lower)
    }

    fn power(
        &mut self,
        [a, b]: [Value; 2],
        y: Value,
        is_active: impl Fn(Value) -> bool,
    ) -> Vec<Slope> {
        let mut slopes = Vec::new();
        if is_active(a) {
            let one = self.composer.number(Number::ONE);
            let reduced = self.composer.emit(Operation::Sub(b, one));
            let lower = self.composer.emit(Operation::Power(a, reduced));
            slopes.push(Slope::factor(a, self.composer.mul(b, lower)));
        }
        if is_active(b) {
            let logarithm = self.composer.emit(Operation::Apply(Function::Ln, a));
            slopes.push(Slope::factor(b, self.composer.mul(y, logarithm)));
        }
        slopes
    }

    /// `f′(a)`, as [`diff`](crate::diff) writes it.
    fn function(&mut self, function: Function, a: Value) -> Value {
        let mut graph = Graph::new();
        let symbol = graph.symbol("x");
        let x = graph.variable(symbol);
        let derivative = function.derivative(&mut graph, x);
        let input = Input {
            symbol,
            name: String::from("x"),
            stage: Stage::New,
        };
        let program = schedule(&graph, vec![input], &[derivative]);
        self.composer.inline(&program, |_, _| a)[0]
    }

    /// The derivatives of a difference with respect to its ends, and to the exponent of a power. The values
    /// that a [`ProgramKernel::Power`] carries are functions of its ends, not further operands.
    fn difference(
        &mut self,
        kernel: ProgramKernel,
        [a, b]: [Value; 2],
        y: Value,
        is_active: impl Fn(Value) -> bool,
    ) -> Vec<Slope> {
        let mut slopes = Vec::new();
        for (kernel, from, to) in [(kernel.mirrored(), b, a), (kernel, a, b)] {
            if is_active(to) {
                let second = Operation::SecondDividedDifference(kernel, from, to);
                slopes.push(Slope::factor(to, self.composer.emit(second)));
            }
        }
        match kernel {
            ProgramKernel::Powf(p) if is_active(p) => {
                slopes.push(Slope::factor(p, self.exponent(p, [a, b], y)));
            }
            ProgramKernel::Function(_)
            | ProgramKernel::Powi(_)
            | ProgramKernel::Sqrt
            | ProgramKernel::Powf(_)
            | ProgramKernel::Power(..) => {}
        }
        slopes
    }

    /// `(xᵖ ln x)[a, b]`, the derivative of `xᵖ[a, b]` with respect to p.
    fn exponent(&mut self, p: Value, ends: [Value; 2], difference: Value) -> Value {
        let composer = &mut self.composer;
        let mut both = |of: fn(Value, Value) -> Operation| {
            let [a, b] = ends.map(|x| composer.emit(of(x, p)));
            composer.emit(Operation::Add(a, b))
        };
        let logarithms = both(|x, _| Operation::Apply(Function::Ln, x));
        let powers = both(Operation::Power);
        let [a, b] = ends;
        let logarithm = ProgramKernel::Function(Function::Ln);
        let slope = composer.emit(Operation::DividedDifference(logarithm, a, b));
        let first = composer.mul(difference, logarithms);
        let second = composer.mul(slope, powers);
        let sum = composer.emit(Operation::Add(first, second));
        let half = composer.number(Number::HALF);
        composer.mul(half, sum)
    }
}
