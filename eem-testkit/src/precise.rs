//! Arithmetic with any number of bits; divided differences are plain quotients.

use std::cell::RefCell;

pub use astro_float_num::BigFloat;
use astro_float_num::{Consts, RoundingMode};
use eem_symbolic::{Arithmetic, Function, Number, ProgramKernel};

/// The default precision, bits.
const BITS: usize = 512;
/// Offset of numerical derivatives: errors of 2⁻³⁰⁰ from the formula and 2⁻³⁶⁰ from rounding.
const OFFSET: i32 = -150;
/// Ends that are closer than this, relative to their size, are one point; the increments of the tests are larger, or zero.
const SAME: i32 = -200;
const ROUNDING: RoundingMode = RoundingMode::None;

/// Numbers of one precision.
#[derive(Debug)]
pub struct Precise {
    bits: usize,
    constants: RefCell<Consts>,
}

impl Default for Precise {
    fn default() -> Self {
        Self::new()
    }
}

// Every number has the precision of the arithmetic that makes it.
#[allow(clippy::wrong_self_convention)]
impl Precise {
    /// 512 bits.
    pub fn new() -> Self {
        Self::with_bits(BITS)
    }

    /// This many bits; divided differences of neighbours and derivatives need 512.
    pub fn with_bits(bits: usize) -> Self {
        let constants = RefCell::new(Consts::new().expect("memory for constants"));
        Self { bits, constants }
    }

    pub fn from_f64(&self, value: f64) -> BigFloat {
        BigFloat::from_f64(value, self.bits)
    }

    pub fn all(&self, values: &[f64]) -> Vec<BigFloat> {
        values.iter().map(|&value| self.from_f64(value)).collect()
    }

    /// `2ⁿ`.
    pub fn two_to(&self, n: i32) -> BigFloat {
        let mut power = self.from_f64(1.0);
        power.set_exponent(n + 1);
        power
    }

    fn value(&self, kernel: ProgramKernel<&BigFloat>, x: &BigFloat) -> BigFloat {
        match kernel {
            ProgramKernel::Function(function) => self.apply(function, x),
            ProgramKernel::Powi(n) => self.powi(x, n),
            ProgramKernel::Sqrt => self.sqrt(x),
            ProgramKernel::Powf(p) => self.power(x, p),
            ProgramKernel::Power(..) => self.apply(Function::Exp, x),
        }
    }

    fn offset(&self, kernel: ProgramKernel<&BigFloat>, x: &BigFloat) -> BigFloat {
        use Function::{Cbrt, Ln, Log2, Log10};
        let relative = match kernel {
            ProgramKernel::Function(function) => matches!(function, Ln | Log2 | Log10 | Cbrt),
            ProgramKernel::Powi(n) => n < 0,
            ProgramKernel::Sqrt | ProgramKernel::Powf(_) => true,
            ProgramKernel::Power(..) => false,
        };
        let scale = if relative {
            x.abs()
        } else {
            self.add(&x.abs(), &self.from_f64(1.0))
        };
        self.mul(&scale, &self.two_to(OFFSET))
    }

    /// `f(x − δ)`, `f(x)`, `f(x + δ)`.
    fn around(
        &self,
        kernel: ProgramKernel<&BigFloat>,
        x: &BigFloat,
        offset: &BigFloat,
    ) -> [BigFloat; 3] {
        let ends = [self.sub(x, offset), x.clone(), self.add(x, offset)];
        ends.map(|x| self.value(kernel, &x))
    }

    fn derivative(&self, kernel: ProgramKernel<&BigFloat>, x: &BigFloat) -> BigFloat {
        let offset = self.offset(kernel, x);
        let [below, _, above] = self.around(kernel, x, &offset);
        let width = self.add(&offset, &offset);
        self.div(&self.sub(&above, &below), &width)
    }

    fn half_curvature(&self, kernel: ProgramKernel<&BigFloat>, x: &BigFloat) -> BigFloat {
        let offset = self.offset(kernel, x);
        let [below, at, above] = self.around(kernel, x, &offset);
        let sum = self.sub(&self.add(&above, &below), &self.add(&at, &at));
        let square = self.mul(&offset, &offset);
        self.div(&sum, &self.add(&square, &square))
    }

    /// Whether two numbers are one point.
    fn same(&self, a: &BigFloat, b: &BigFloat) -> bool {
        let distance = self.sub(a, b).abs();
        let scale = self.mul(&self.add(&a.abs(), &b.abs()), &self.two_to(SAME));
        distance.is_zero() || distance < scale
    }
}

impl Arithmetic for Precise {
    type Number = BigFloat;

    fn constant(&self, number: &Number) -> BigFloat {
        match number {
            Number::Exact(exact) => {
                let numerator = BigFloat::from_i128(exact.numerator(), self.bits);
                let denominator = BigFloat::from_i128(exact.denominator(), self.bits);
                self.div(&numerator, &denominator)
            }
            Number::Float(value) => self.from_f64(*value),
        }
    }

    fn add(&self, a: &BigFloat, b: &BigFloat) -> BigFloat {
        a.add(b, self.bits, ROUNDING)
    }

    fn sub(&self, a: &BigFloat, b: &BigFloat) -> BigFloat {
        a.sub(b, self.bits, ROUNDING)
    }

    fn mul(&self, a: &BigFloat, b: &BigFloat) -> BigFloat {
        a.mul(b, self.bits, ROUNDING)
    }

    fn div(&self, a: &BigFloat, b: &BigFloat) -> BigFloat {
        a.div(b, self.bits, ROUNDING)
    }

    fn neg(&self, a: &BigFloat) -> BigFloat {
        a.neg()
    }

    fn powi(&self, a: &BigFloat, n: i32) -> BigFloat {
        let power = a.powi(n.unsigned_abs() as usize, self.bits, ROUNDING);
        if n < 0 {
            self.div(&self.from_f64(1.0), &power)
        } else {
            power
        }
    }

    fn sqrt(&self, a: &BigFloat) -> BigFloat {
        a.sqrt(self.bits, ROUNDING)
    }

    fn power(&self, a: &BigFloat, b: &BigFloat) -> BigFloat {
        let logarithm = self.apply(Function::Ln, a);
        self.apply(Function::Exp, &self.mul(b, &logarithm))
    }

    fn apply(&self, function: Function, a: &BigFloat) -> BigFloat {
        let (bits, one) = (self.bits, self.from_f64(1.0));
        let constants = &mut *self.constants.borrow_mut();
        match function {
            Function::Exp => a.exp(bits, ROUNDING, constants),
            Function::ExpM1 => self.sub(&a.exp(bits, ROUNDING, constants), &one),
            Function::Ln => a.ln(bits, ROUNDING, constants),
            Function::Ln1p => self.add(a, &one).ln(bits, ROUNDING, constants),
            Function::Log2 => a.log2(bits, ROUNDING, constants),
            Function::Log10 => a.log10(bits, ROUNDING, constants),
            Function::Sin => a.sin(bits, ROUNDING, constants),
            Function::Cos => a.cos(bits, ROUNDING, constants),
            Function::Tan => a.tan(bits, ROUNDING, constants),
            Function::Sinh => a.sinh(bits, ROUNDING, constants),
            Function::Cosh => a.cosh(bits, ROUNDING, constants),
            Function::Tanh => a.tanh(bits, ROUNDING, constants),
            Function::Asinh => a.asinh(bits, ROUNDING, constants),
            Function::Atan => a.atan(bits, ROUNDING, constants),
            Function::Atanh => a.atanh(bits, ROUNDING, constants),
            Function::Cbrt => a.cbrt(bits, ROUNDING),
            Function::Abs => a.abs(),
        }
    }

    fn divided_difference(
        &self,
        kernel: ProgramKernel<&BigFloat>,
        a: &BigFloat,
        b: &BigFloat,
    ) -> BigFloat {
        if self.same(a, b) {
            return self.derivative(kernel, a);
        }
        let rise = self.sub(&self.value(kernel, b), &self.value(kernel, a));
        self.div(&rise, &self.sub(b, a))
    }

    fn second_divided_difference(
        &self,
        kernel: ProgramKernel<&BigFloat>,
        a: &BigFloat,
        b: &BigFloat,
    ) -> BigFloat {
        if self.same(a, b) {
            return self.half_curvature(kernel, a);
        }
        let secant = self.divided_difference(kernel, a, b);
        let rise = self.sub(&self.derivative(kernel, b), &secant);
        self.div(&rise, &self.sub(b, a))
    }
}

/// The nearest `f64`, to a unit in the last place.
pub fn to_f64(x: &BigFloat) -> f64 {
    if x.is_zero() {
        return 0.0;
    }
    #[allow(
        clippy::cast_precision_loss,
        reason = "53 of 64 bits are what is asked for"
    )]
    let as_f64 = |word: u64| word as f64;
    let (Some(words), Some(exponent)) = (x.mantissa_digits(), x.exponent()) else {
        return f64::NAN;
    };
    let scale = 2.0_f64.powi(-64);
    let mantissa = words.iter().rev().take(2).rev();
    let mantissa = mantissa.fold(0.0, |rest, &word| (as_f64(word) + rest) * scale);
    let magnitude = mantissa * 2.0_f64.powi(exponent / 2) * 2.0_f64.powi(exponent - exponent / 2);
    if x.is_negative() {
        -magnitude
    } else {
        magnitude
    }
}

/// `|computed − exact|`.
pub fn error(precise: &Precise, computed: f64, exact: &BigFloat) -> f64 {
    to_f64(&precise.sub(&precise.from_f64(computed), exact)).abs()
}
