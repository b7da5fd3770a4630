//! Evaluation of a program on any arithmetic, instruction by instruction, nothing reordered.
//!
//! What generated code computes in `f64`, the interpreter computes with [`F64`], with error bounds
//! ([`RunningError`](crate::RunningError)) or with as many digits as a test asks for.

use crate::function::Function;
use crate::number::Number;
use crate::operation::{DifferencePart, Operation, ProgramKernel, Value};
use crate::program::Program;

/// A number system that programs can be evaluated on.
pub trait Arithmetic {
    /// Its numbers.
    type Number: Clone;

    /// The nearest number to a constant.
    fn constant(&self, number: &Number) -> Self::Number;
    /// `a + b`.
    fn add(&self, a: &Self::Number, b: &Self::Number) -> Self::Number;
    /// `a − b`.
    fn sub(&self, a: &Self::Number, b: &Self::Number) -> Self::Number;
    /// `a b`.
    fn mul(&self, a: &Self::Number, b: &Self::Number) -> Self::Number;
    /// `a / b`.
    fn div(&self, a: &Self::Number, b: &Self::Number) -> Self::Number;
    /// `−a`.
    fn neg(&self, a: &Self::Number) -> Self::Number;
    /// `aⁿ`, n ≥ 3.
    fn powi(&self, a: &Self::Number, n: i32) -> Self::Number;
    /// `√a`.
    fn sqrt(&self, a: &Self::Number) -> Self::Number;
    /// `aᵇ`.
    fn power(&self, a: &Self::Number, b: &Self::Number) -> Self::Number;
    /// `f(a)`.
    fn apply(&self, function: Function, a: &Self::Number) -> Self::Number;
    /// `f[a, b]`.
    fn divided_difference(
        &self,
        kernel: ProgramKernel<&Self::Number>,
        a: &Self::Number,
        b: &Self::Number,
    ) -> Self::Number;
    /// `f[a, b, b]`.
    fn second_divided_difference(
        &self,
        kernel: ProgramKernel<&Self::Number>,
        a: &Self::Number,
        b: &Self::Number,
    ) -> Self::Number;

    /// `f[a, b]`, `f[a, a, b]` and `f[a, b, b]`; computed one by one unless an arithmetic overrides this.
    fn joint_differences(
        &self,
        kernel: ProgramKernel<&Self::Number>,
        a: &Self::Number,
        b: &Self::Number,
    ) -> JointDifferences<Self::Number> {
        JointDifferences {
            first: self.divided_difference(kernel, a, b),
            second_a: self.second_divided_difference(kernel.mirrored(), b, a),
            second_b: self.second_divided_difference(kernel, a, b),
        }
    }
}

/// All divided differences of one function between two ends a and b.
#[derive(Clone, Debug, PartialEq)]
pub struct JointDifferences<N> {
    /// `f[a, b]`.
    pub first: N,
    /// `f[a, a, b]`.
    pub second_a: N,
    /// `f[a, b, b]`.
    pub second_b: N,
}

impl<N> JointDifferences<N> {
    /// One of the differences.
    pub fn part(&self, part: DifferencePart) -> &N {
        match part {
            DifferencePart::First => &self.first,
            DifferencePart::SecondA => &self.second_a,
            DifferencePart::SecondB => &self.second_b,
        }
    }
}

impl Program {
    /// The outputs for given inputs.
    ///
    /// # Panics
    ///
    /// If there are fewer inputs than the program has, or if the program is not valid
    /// ([`Program::verify`]).
    ///
    /// ```
    /// use eem_symbolic::{F64, Graph, Input, Stage, schedule};
    ///
    /// let mut graph = Graph::new();
    /// let symbol = graph.symbol("x");
    /// let x = graph.variable(symbol);
    /// let square = graph.powi(x, 2);
    /// let name = String::from("x");
    /// let input = Input { symbol, name, stage: Stage::New };
    /// let program = schedule(&graph, vec![input], &[square]);
    /// assert_eq!(program.interpret(&F64, &[3.0]), [9.0]);
    /// ```
    #[must_use]
    pub fn interpret<A: Arithmetic>(&self, arithmetic: &A, inputs: &[A::Number]) -> Vec<A::Number> {
        assert!(
            inputs.len() >= self.inputs.len(),
            "{} numbers for {} inputs",
            inputs.len(),
            self.inputs.len()
        );
        let mut values = Values(Vec::with_capacity(self.instructions.len()));
        for instruction in &self.instructions {
            let value = evaluate(&instruction.operation, arithmetic, inputs, &values);
            values.0.push(value);
        }
        let outputs = self.outputs.iter();
        outputs
            .map(|&output| values.number(output).clone())
            .collect()
    }
}

/// The result of one instruction.
enum Computed<N> {
    Number(N),
    Differences(JointDifferences<N>),
}

/// The results so far.
struct Values<N>(Vec<Computed<N>>);

impl<N> Values<N> {
    fn number(&self, value: Value) -> &N {
        match &self.0[value.index()] {
            Computed::Number(number) => number,
            Computed::Differences(_) => panic!("joint differences are read by their parts"),
        }
    }

    fn differences(&self, value: Value) -> &JointDifferences<N> {
        match &self.0[value.index()] {
            Computed::Differences(differences) => differences,
            Computed::Number(_) => panic!("a number has no parts"),
        }
    }
}

fn evaluate<A: Arithmetic>(
    operation: &Operation,
    arithmetic: &A,
    inputs: &[A::Number],
    values: &Values<A::Number>,
) -> Computed<A::Number> {
    let of = |value: &Value| values.number(*value);
    let kernel = |kernel: &ProgramKernel| kernel.map(|value| values.number(value));
    Computed::Number(match operation {
        Operation::Input(index) => inputs[*index].clone(),
        Operation::Constant(number) => arithmetic.constant(number),
        Operation::Add(a, b) => arithmetic.add(of(a), of(b)),
        Operation::Sub(a, b) => arithmetic.sub(of(a), of(b)),
        Operation::Mul(a, b) => arithmetic.mul(of(a), of(b)),
        Operation::Div(a, b) => arithmetic.div(of(a), of(b)),
        Operation::Neg(a) => arithmetic.neg(of(a)),
        Operation::Powi(a, n) => arithmetic.powi(of(a), *n),
        Operation::Sqrt(a) => arithmetic.sqrt(of(a)),
        Operation::Power(a, b) => arithmetic.power(of(a), of(b)),
        Operation::Apply(function, a) => arithmetic.apply(*function, of(a)),
        Operation::DividedDifference(f, a, b) => {
            arithmetic.divided_difference(kernel(f), of(a), of(b))
        }
        Operation::SecondDividedDifference(f, a, b) => {
            arithmetic.second_divided_difference(kernel(f), of(a), of(b))
        }
        Operation::JointDifferences(f, a, b) => {
            let differences = arithmetic.joint_differences(kernel(f), of(a), of(b));
            return Computed::Differences(differences);
        }
        Operation::Part(differences, part) => values.differences(*differences).part(*part).clone(),
    })
}

/// Double precision, with the elementary functions of the platform.
///
/// Divided differences are integrals of f′ and t f″ by quadrature, which has no formula in common
/// with the kernels that generated code calls. It is slow, and accurate to about 1e-15 of ∫|f′| and
/// ∫t|f″| if the ends are of comparable size.
#[derive(Clone, Copy, Debug, Default)]
pub struct F64;

impl Arithmetic for F64 {
    type Number = f64;

    fn constant(&self, number: &Number) -> f64 {
        number.to_f64()
    }

    fn add(&self, a: &f64, b: &f64) -> f64 {
        a + b
    }

    fn sub(&self, a: &f64, b: &f64) -> f64 {
        a - b
    }

    fn mul(&self, a: &f64, b: &f64) -> f64 {
        a * b
    }

    fn div(&self, a: &f64, b: &f64) -> f64 {
        a / b
    }

    fn neg(&self, a: &f64) -> f64 {
        -a
    }

    fn powi(&self, a: &f64, n: i32) -> f64 {
        a.powi(n)
    }

    fn sqrt(&self, a: &f64) -> f64 {
        a.sqrt()
    }

    fn power(&self, a: &f64, b: &f64) -> f64 {
        a.powf(*b)
    }

    fn apply(&self, function: Function, a: &f64) -> f64 {
        match function {
            Function::Exp => a.exp(),
            Function::ExpM1 => a.exp_m1(),
            Function::Ln => a.ln(),
            Function::Ln1p => a.ln_1p(),
            Function::Log2 => a.log2(),
            Function::Log10 => a.log10(),
            Function::Sin => a.sin(),
            Function::Cos => a.cos(),
            Function::Tan => a.tan(),
            Function::Sinh => a.sinh(),
            Function::Cosh => a.cosh(),
            Function::Tanh => a.tanh(),
            Function::Asinh => a.asinh(),
            Function::Atan => a.atan(),
            Function::Atanh => a.atanh(),
            Function::Cbrt => a.cbrt(),
            Function::Abs => a.abs(),
        }
    }

    fn divided_difference(&self, kernel: ProgramKernel<&f64>, a: &f64, b: &f64) -> f64 {
        crate::quadrature::divided_difference(kernel.map(|value| *value), *a, *b)
    }

    fn second_divided_difference(&self, kernel: ProgramKernel<&f64>, a: &f64, b: &f64) -> f64 {
        crate::quadrature::second_divided_difference(kernel.map(|value| *value), *a, *b)
    }
}
