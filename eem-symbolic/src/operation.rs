//! What one instruction of a program computes, and from which values.

use crate::function::Function;
use crate::number::Number;

/// The result of one instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Value(u32);

impl Value {
    /// The value of instruction `index`.
    ///
    /// # Panics
    ///
    /// If there are more than 2³² instructions.
    #[must_use]
    pub fn new(index: usize) -> Self {
        Self(u32::try_from(index).expect("a program has fewer than 2³² instructions"))
    }

    /// The position of the instruction that computes the value.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// What one instruction computes.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Operation {
    /// The input at this position.
    Input(usize),
    /// A number, exact if it was written so.
    Constant(Number),
    /// `a + b`.
    Add(Value, Value),
    /// `a − b`.
    Sub(Value, Value),
    /// `a b`.
    Mul(Value, Value),
    /// `a / b`.
    Div(Value, Value),
    /// `−a`.
    Neg(Value),
    /// `aⁿ` with n ≥ 3: squares and reciprocals are products and quotients.
    Powi(Value, i32),
    /// `√a`.
    Sqrt(Value),
    /// `aᵇ`.
    Power(Value, Value),
    /// `f(a)`.
    Apply(Function, Value),
    /// `f[a, b] = (f(b) − f(a)) / (b − a)`, which is f′(a) for a = b.
    DividedDifference(ProgramKernel, Value, Value),
    /// `f[a, b, b] = ∂f[a, b]/∂b`, which is ½ f″(a) for a = b.
    SecondDividedDifference(ProgramKernel, Value, Value),
    /// `f[a, b]`, `f[a, a, b]` and `f[a, b, b]` in one call. The result is not a number;
    /// [`Operation::Part`] reads one of the three. Only for a kernel that
    /// [has such a call](ProgramKernel::has_joint_call).
    JointDifferences(ProgramKernel, Value, Value),
    /// One of the differences that a [`Operation::JointDifferences`] has computed.
    Part(Value, DifferencePart),
}

/// One of the divided differences of a function between two ends a and b.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum DifferencePart {
    /// `f[a, b]`.
    First,
    /// `f[a, a, b] = ∂f[a, b]/∂a`.
    SecondA,
    /// `f[a, b, b] = ∂f[a, b]/∂b`.
    SecondB,
}

impl DifferencePart {
    /// The same difference after the ends have been exchanged.
    pub(crate) fn mirrored(self) -> Self {
        match self {
            Self::First => Self::First,
            Self::SecondA => Self::SecondB,
            Self::SecondB => Self::SecondA,
        }
    }
}

/// The function f of a divided difference; V is a [`Value`] in a program, a number in an interpreter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ProgramKernel<V = Value> {
    /// An elementary function.
    Function(Function),
    /// `xⁿ`, n ≠ 0, 1, 2; −1 is the reciprocal.
    Powi(i32),
    /// `√x`.
    Sqrt,
    /// `xᵖ` with p the given value, the same at both ends.
    Powf(V),
    /// `eˣ` between the logarithms a and b of two powers, with the powers themselves: they are more
    /// accurate than `exp(a)` and `exp(b)` of the rounded logarithms.
    Power(V, V),
}

impl Operation {
    /// The operands, in the order of the formula.
    #[must_use]
    pub fn operands(&self) -> Vec<Value> {
        match self {
            Self::Input(_) | Self::Constant(_) => Vec::new(),
            Self::Neg(a) | Self::Powi(a, _) | Self::Sqrt(a) | Self::Apply(_, a) => vec![*a],
            Self::Add(a, b)
            | Self::Sub(a, b)
            | Self::Mul(a, b)
            | Self::Div(a, b)
            | Self::Power(a, b) => vec![*a, *b],
            Self::Part(differences, _) => vec![*differences],
            Self::DividedDifference(kernel, a, b)
            | Self::SecondDividedDifference(kernel, a, b)
            | Self::JointDifferences(kernel, a, b) => {
                let mut operands = kernel.operands();
                operands.extend([*a, *b]);
                operands
            }
        }
    }

    /// The same operation with `of(operand)` in place of every operand.
    pub(crate) fn map(&self, of: impl Fn(Value) -> Value) -> Self {
        match *self {
            Self::Input(index) => Self::Input(index),
            Self::Constant(number) => Self::Constant(number),
            Self::Add(a, b) => Self::Add(of(a), of(b)),
            Self::Sub(a, b) => Self::Sub(of(a), of(b)),
            Self::Mul(a, b) => Self::Mul(of(a), of(b)),
            Self::Div(a, b) => Self::Div(of(a), of(b)),
            Self::Neg(a) => Self::Neg(of(a)),
            Self::Powi(a, n) => Self::Powi(of(a), n),
            Self::Sqrt(a) => Self::Sqrt(of(a)),
            Self::Power(a, b) => Self::Power(of(a), of(b)),
            Self::Apply(function, a) => Self::Apply(function, of(a)),
            Self::DividedDifference(kernel, a, b) => {
                Self::DividedDifference(kernel.map(&of), of(a), of(b))
            }
            Self::SecondDividedDifference(kernel, a, b) => {
                Self::SecondDividedDifference(kernel.map(&of), of(a), of(b))
            }
            Self::JointDifferences(kernel, a, b) => {
                Self::JointDifferences(kernel.map(&of), of(a), of(b))
            }
            Self::Part(differences, part) => Self::Part(of(differences), part),
        }
    }
}

impl<V: Copy> ProgramKernel<V> {
    /// The values that f itself depends on.
    #[must_use]
    pub fn operands(self) -> Vec<V> {
        match self {
            Self::Function(_) | Self::Powi(_) | Self::Sqrt => Vec::new(),
            Self::Powf(exponent) => vec![exponent],
            Self::Power(value_a, value_b) => vec![value_a, value_b],
        }
    }

    /// Whether one call of the runtime computes all differences of f between two ends. It costs less
    /// than two calls, because the differences share the logarithm, or the powers at the ends.
    #[must_use]
    pub fn has_joint_call(self) -> bool {
        match self {
            Self::Function(Function::Ln | Function::Ln1p) | Self::Power(..) => true,
            Self::Function(_) | Self::Powi(_) | Self::Sqrt | Self::Powf(_) => false,
        }
    }

    /// The same function with its ends exchanged.
    #[must_use]
    pub fn mirrored(self) -> Self {
        match self {
            Self::Power(value_a, value_b) => Self::Power(value_b, value_a),
            Self::Function(_) | Self::Powi(_) | Self::Sqrt | Self::Powf(_) => self,
        }
    }

    /// The same function with `of(operand)` in place of every operand.
    #[inline]
    pub fn map<W>(self, mut of: impl FnMut(V) -> W) -> ProgramKernel<W> {
        match self {
            Self::Function(function) => ProgramKernel::Function(function),
            Self::Powi(n) => ProgramKernel::Powi(n),
            Self::Sqrt => ProgramKernel::Sqrt,
            Self::Powf(exponent) => ProgramKernel::Powf(of(exponent)),
            Self::Power(value_a, value_b) => ProgramKernel::Power(of(value_a), of(value_b)),
        }
    }
}
