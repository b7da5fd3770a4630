//! The number that formulas of the zoo are written for: an expression, a dual number, or many digits.
//!
//! A formula is Rust text. The derive reads it as tokens; as Rust it is a function of [`Num`],
//! whose operators and functions are those of the formula language.

use std::ops::{Add, Div, Mul, Neg, Sub};

use eem_symbolic::Function;

/// What a [`Num`] can consist of.
pub(crate) trait Value: Copy {
    /// The decimal number that was written.
    fn literal(value: f64) -> Self;
    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    fn div(self, other: Self) -> Self;
    fn powi(self, n: i32) -> Self;
    fn power(self, exponent: Self) -> Self;
    fn apply(self, function: Function) -> Self;

    fn sqrt(self) -> Self {
        self.power(Self::literal(0.5))
    }

    fn neg(self) -> Self {
        Self::literal(0.0).sub(self)
    }

    /// The partial derivative by a variable, which only an expression has.
    fn diff(self, _variable: Self) -> Self {
        panic!("a number has no derivative: the specimen needs a formula without `diff`")
    }
}

/// A number of some kind.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Num<V>(pub(crate) V);

impl<V: Value> From<f64> for Num<V> {
    fn from(value: f64) -> Self {
        Num(V::literal(value))
    }
}

impl<V: Value> Num<V> {
    pub(crate) fn powi(self, n: i32) -> Self {
        Num(self.0.powi(n))
    }

    pub(crate) fn powf(self, exponent: impl Into<Self>) -> Self {
        Num(self.0.power(exponent.into().0))
    }

    pub(crate) fn sqrt(self) -> Self {
        Num(self.0.sqrt())
    }

    pub(crate) fn recip(self) -> Self {
        Num(V::literal(1.0).div(self.0))
    }
}

/// The partial derivative of `e` by the variable `x`.
pub(crate) fn diff<V: Value>(e: Num<V>, x: Num<V>) -> Num<V> {
    Num(e.0.diff(x.0))
}

macro_rules! functions {
    ($($name:ident: $function:ident),* $(,)?) => {$(
        pub(crate) fn $name<V: Value>(x: Num<V>) -> Num<V> {
            Num(x.0.apply(Function::$function))
        }
    )*};
}

functions! {
    exp: Exp, exp_m1: ExpM1, ln: Ln, ln_1p: Ln1p, log2: Log2, log10: Log10, sin: Sin, cos: Cos, tan: Tan,
    sinh: Sinh, cosh: Cosh, tanh: Tanh, asinh: Asinh, atan: Atan, atanh: Atanh, cbrt: Cbrt, abs: Abs,
}

impl<V: Value> Neg for Num<V> {
    type Output = Self;

    fn neg(self) -> Self {
        Num(self.0.neg())
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident),* $(,)?) => {$(
        impl<V: Value, T: Into<Num<V>>> $operator<T> for Num<V> {
            type Output = Self;

            fn $method(self, other: T) -> Self {
                Num(self.0.$method(other.into().0))
            }
        }

        impl<V: Value> $operator<Num<V>> for f64 {
            type Output = Num<V>;

            fn $method(self, other: Num<V>) -> Num<V> {
                Num(V::literal(self).$method(other.0))
            }
        }
    )*};
}

operators! { Add add, Sub sub, Mul mul, Div div }
