//! Numbers with two derivatives, by `num-dual`.

use eem_symbolic::Function;
use num_dual::{DualNum, HyperDual64};

use crate::zoo::number::{Num, Value};

impl Value for HyperDual64 {
    fn literal(value: f64) -> Self {
        value.into()
    }

    fn add(self, other: Self) -> Self {
        self + other
    }

    fn sub(self, other: Self) -> Self {
        self - other
    }

    fn mul(self, other: Self) -> Self {
        self * other
    }

    fn div(self, other: Self) -> Self {
        self / other
    }

    fn powi(self, n: i32) -> Self {
        DualNum::powi(&self, n)
    }

    fn power(self, exponent: Self) -> Self {
        self.powd(exponent)
    }

    fn apply(self, function: Function) -> Self {
        match function {
            Function::Exp => self.exp(),
            Function::ExpM1 => self.exp_m1(),
            Function::Ln => self.ln(),
            Function::Ln1p => self.ln_1p(),
            Function::Log2 => self.log2(),
            Function::Log10 => self.log10(),
            Function::Sin => self.sin(),
            Function::Cos => self.cos(),
            Function::Tan => self.tan(),
            Function::Sinh => self.sinh(),
            Function::Cosh => self.cosh(),
            // sinh x/cosh x, which `num-dual` takes, has derivatives that cancel.
            Function::Tanh => ((self + self).exp() + 1.0).recip() * -2.0 + 1.0,
            Function::Asinh => self.asinh(),
            Function::Atan => self.atan(),
            Function::Atanh => self.atanh(),
            Function::Cbrt => self.cbrt(),
            Function::Abs if self.re < 0.0 => -self,
            Function::Abs => self,
        }
    }

    fn sqrt(self) -> Self {
        DualNum::sqrt(&self)
    }

    fn neg(self) -> Self {
        -self
    }
}

/// The point `x`, to be differentiated by the variables `j` and `k`.
pub(crate) fn seeded(x: &[f64], j: usize, k: usize) -> Vec<Num<HyperDual64>> {
    let seed = |(i, &value): (usize, &f64)| {
        let unit = |index: usize| f64::from(u8::from(i == index));
        Num(HyperDual64::new(value, unit(j), unit(k), 0.0))
    };
    x.iter().enumerate().map(seed).collect()
}

/// Numbers without derivatives.
pub(crate) fn constants(values: &[f64]) -> Vec<Num<HyperDual64>> {
    values.iter().map(|&value| Num::from(value)).collect()
}
