//! Divided differences of single functions as nodes, or as closed forms where there are any.

use crate::function::Function;
use crate::graph::Graph;
use crate::node::{ExprId, Kernel, Node};
use crate::number::{Number, Rational};
use crate::order::compare;

impl Graph {
    /// `f[a, b]` for the function `f` of a kernel; `f′(a)` when both ends are the same expression.
    ///
    /// ```text
    /// f[a, b] = (f(b) − f(a))/(b − a) = ∫₀¹ f′(a + t(b − a)) dt
    /// ```
    pub fn kernel_difference(&mut self, kernel: Kernel, a: ExprId, b: ExprId) -> ExprId {
        let kernel = match self.exponent(kernel) {
            Some(Rational::ZERO) => return self.number(Number::ZERO),
            Some(Rational::ONE) => return self.number(Number::ONE),
            Some(Rational::TWO) => return self.pair_sum(a, b),
            Some(exponent) => self.power_kernel(exponent),
            None => kernel,
        };
        if a == b {
            return self.kernel_derivative(kernel, a);
        }
        if kernel == Kernel::Function(Function::Abs) {
            return self.abs_difference(a, b);
        }
        let (first, second) = if compare(self, a, b).is_le() {
            (a, b)
        } else {
            (b, a)
        };
        self.intern(Node::DividedDifference(kernel, first, second))
    }

    /// `f[a, b, b]`, the derivative of `f[a, b]` with respect to `b`.
    ///
    /// ```text
    /// f[a, b, b] = (f′(b) − f[a, b])/(b − a) = ∫₀¹ t f″(a + t(b − a)) dt
    /// ```
    pub fn second_kernel_difference(&mut self, kernel: Kernel, a: ExprId, b: ExprId) -> ExprId {
        let kernel = match self.exponent(kernel) {
            Some(Rational::ZERO | Rational::ONE) => return self.number(Number::ZERO),
            Some(Rational::TWO) => return self.number(Number::ONE),
            Some(exponent) => self.power_kernel(exponent),
            None => kernel,
        };
        self.intern(Node::SecondDividedDifference(kernel, a, b))
    }

    /// `exp[X_a, X_b]` for `X = h·ln g`, given the values `g^h = exp X` at both ends.
    pub fn power_difference(&mut self, values: [ExprId; 2], logarithms: [ExprId; 2]) -> ExprId {
        let [x_a, x_b] = logarithms;
        if x_a == x_b {
            return values[0];
        }
        if compare(self, x_a, x_b).is_le() {
            return self.intern(Node::PowerDifference { values, logarithms });
        }
        let [value_a, value_b] = values;
        self.intern(Node::PowerDifference {
            values: [value_b, value_a],
            logarithms: [x_b, x_a],
        })
    }

    /// The kernel of `x^exponent`.
    pub(crate) fn power_kernel(&mut self, exponent: Rational) -> Kernel {
        match (exponent, exponent.to_i32()) {
            (Rational::MINUS_ONE, _) => Kernel::Recip,
            (Rational::HALF, _) => Kernel::Sqrt,
            (_, Some(integer)) => Kernel::Powi(integer),
            (_, None) => Kernel::Powf(self.number(exponent)),
        }
    }

    /// The exponent of a kernel that is a power with a rational exponent.
    fn exponent(&self, kernel: Kernel) -> Option<Rational> {
        match kernel {
            Kernel::Function(_) => None,
            Kernel::Sqrt => Some(Rational::HALF),
            Kernel::Recip => Some(Rational::MINUS_ONE),
            Kernel::Powi(exponent) => Some(Rational::integer(i64::from(exponent))),
            Kernel::Powf(exponent) => self.as_number(exponent)?.exact(),
        }
    }

    /// `f′(x)` for the function `f` of a kernel.
    fn kernel_derivative(&mut self, kernel: Kernel, x: ExprId) -> ExprId {
        match kernel {
            Kernel::Function(function) => function.derivative(self, x),
            Kernel::Sqrt => self.power_derivative(x, Rational::HALF),
            Kernel::Recip => self.power_derivative(x, Rational::MINUS_ONE),
            Kernel::Powi(n) => self.power_derivative(x, Rational::integer(i64::from(n))),
            Kernel::Powf(exponent) => {
                let one = self.number(Number::ONE);
                let reduced = self.sub(exponent, one);
                let power = self.power(x, reduced);
                self.mul(exponent, power)
            }
        }
    }

    /// `d(x^r)/dx = r·x^(r − 1)`.
    pub(crate) fn power_derivative(&mut self, x: ExprId, exponent: Rational) -> ExprId {
        let inverse = (x, Rational::MINUS_ONE);
        let power = self.power_product(&[(x, exponent), inverse]);
        self.scale(Number::Exact(exponent), power)
    }

    /// `(a + b)/(|a| + |b|)`, NaN when both vanish.
    fn abs_difference(&mut self, a: ExprId, b: ExprId) -> ExprId {
        let numerator = self.pair_sum(a, b);
        let (a, b) = (self.apply(Function::Abs, a), self.apply(Function::Abs, b));
        let denominator = self.pair_sum(a, b);
        self.div(numerator, denominator)
    }
}
