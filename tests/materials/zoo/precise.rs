//! Numbers of 320 bits.

use std::cell::RefCell;

use astro_float::{BigFloat, Consts, RoundingMode};
use eem_symbolic::{Function, Number};

use crate::zoo::number::Value;

/// Precision of everything, in bits: second differences with [`OFFSET`] keep half of them.
const BITS: usize = 320;
const ROUNDING: RoundingMode = RoundingMode::None;
/// Relative offset 2ⁿ of numerical derivatives, whose own error is its square.
const OFFSET: i32 = -80;
/// What the offset of quotients has more.
const COARSE: i32 = 20;

thread_local! {
    static NUMBERS: RefCell<Vec<BigFloat>> = const { RefCell::new(Vec::new()) };
    static CONSTANTS: RefCell<Consts> = RefCell::new(Consts::new().expect("memory for constants"));
}

/// A number with 96 digits; it lives until [`forget`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Precise(usize);

/// Frees all numbers of this thread; none of them may be used any more.
pub(crate) fn forget() {
    NUMBERS.with(|numbers| numbers.borrow_mut().clear());
}

fn store(number: BigFloat) -> Precise {
    NUMBERS.with(|numbers| {
        let mut numbers = numbers.borrow_mut();
        numbers.push(number);
        Precise(numbers.len() - 1)
    })
}

impl Precise {
    /// Exactly this number.
    pub(crate) fn of(value: f64) -> Self {
        store(BigFloat::from_f64(value, BITS))
    }

    /// `2ⁿ`.
    fn two_to(n: i32) -> Self {
        let mut power = BigFloat::from_f64(1.0, BITS);
        power.set_exponent(n + 1);
        store(power)
    }

    fn get(self) -> BigFloat {
        NUMBERS.with(|numbers| numbers.borrow()[self.0].clone())
    }

    pub(crate) fn is_zero(self) -> bool {
        self.get().is_zero()
    }

    /// `|self − value|`, in double precision.
    pub(crate) fn distance(self, value: f64) -> f64 {
        self.sub(Self::of(value)).to_f64().abs()
    }

    /// The nearest `f64`, to a unit in the last place.
    pub(crate) fn to_f64(self) -> f64 {
        let number = self.get();
        if number.is_zero() {
            return 0.0;
        }
        #[expect(
            clippy::cast_precision_loss,
            reason = "53 of 64 bits are what is asked for"
        )]
        let as_f64 = |word: u64| word as f64;
        let (Some(words), Some(exponent)) = (number.mantissa_digits(), number.exponent()) else {
            return f64::NAN;
        };
        let leading = words.iter().rev().take(2).rev();
        let mantissa = leading.fold(0.0, |rest, &word| (as_f64(word) + rest) * 2.0_f64.powi(-64));
        let half = exponent / 2;
        let magnitude = mantissa * 2.0_f64.powi(half) * 2.0_f64.powi(exponent - half);
        if number.is_negative() {
            -magnitude
        } else {
            magnitude
        }
    }

    fn function(self, function: Function) -> BigFloat {
        let (a, one) = (self.get(), BigFloat::from_f64(1.0, BITS));
        CONSTANTS.with(|constants| {
            let constants = &mut *constants.borrow_mut();
            match function {
                Function::Exp => a.exp(BITS, ROUNDING, constants),
                Function::ExpM1 => a.exp(BITS, ROUNDING, constants).sub(&one, BITS, ROUNDING),
                Function::Ln => a.ln(BITS, ROUNDING, constants),
                Function::Ln1p => a.add(&one, BITS, ROUNDING).ln(BITS, ROUNDING, constants),
                Function::Log2 => a.log2(BITS, ROUNDING, constants),
                Function::Log10 => a.log10(BITS, ROUNDING, constants),
                Function::Sin => a.sin(BITS, ROUNDING, constants),
                Function::Cos => a.cos(BITS, ROUNDING, constants),
                Function::Tan => a.tan(BITS, ROUNDING, constants),
                Function::Sinh => a.sinh(BITS, ROUNDING, constants),
                Function::Cosh => a.cosh(BITS, ROUNDING, constants),
                Function::Tanh => a.tanh(BITS, ROUNDING, constants),
                Function::Asinh => a.asinh(BITS, ROUNDING, constants),
                Function::Atan => a.atan(BITS, ROUNDING, constants),
                Function::Atanh => a.atanh(BITS, ROUNDING, constants),
                Function::Cbrt => a.cbrt(BITS, ROUNDING),
                Function::Abs => a.abs(),
            }
        })
    }
}

impl Value for Precise {
    fn literal(value: f64) -> Self {
        let decimal = Number::parse_decimal(&value.to_string());
        let Some(Number::Exact(exact)) = decimal else {
            return Self::of(value);
        };
        let numerator = BigFloat::from_i128(exact.numerator(), BITS);
        let denominator = BigFloat::from_i128(exact.denominator(), BITS);
        store(numerator.div(&denominator, BITS, ROUNDING))
    }

    fn add(self, other: Self) -> Self {
        store(self.get().add(&other.get(), BITS, ROUNDING))
    }

    fn sub(self, other: Self) -> Self {
        store(self.get().sub(&other.get(), BITS, ROUNDING))
    }

    fn mul(self, other: Self) -> Self {
        store(self.get().mul(&other.get(), BITS, ROUNDING))
    }

    fn div(self, other: Self) -> Self {
        store(self.get().div(&other.get(), BITS, ROUNDING))
    }

    fn powi(self, n: i32) -> Self {
        let power = self.get().powi(n.unsigned_abs() as usize, BITS, ROUNDING);
        let power = store(power);
        if n < 0 {
            Self::of(1.0).div(power)
        } else {
            power
        }
    }

    fn power(self, exponent: Self) -> Self {
        exponent.mul(self.apply(Function::Ln)).apply(Function::Exp)
    }

    fn apply(self, function: Function) -> Self {
        store(self.function(function))
    }

    fn sqrt(self) -> Self {
        store(self.get().sqrt(BITS, ROUNDING))
    }
}

/// The change that derivatives of quotients are taken with: more than that of derivatives, on which
/// they depend.
pub(crate) fn coarse_offset(x: Precise) -> Precise {
    offset(x).mul(Precise::two_to(COARSE))
}

/// The change that numerical derivatives by `x` are taken with.
pub(crate) fn offset(x: Precise) -> Precise {
    let scale = if x.is_zero() { Precise::of(1.0) } else { x };
    scale.mul(Precise::two_to(OFFSET))
}

/// `∂f/∂x_j` by a central difference.
pub(crate) fn slope(f: &dyn Fn(&[Precise]) -> Precise, x: &[Precise], j: usize) -> Precise {
    let step = offset(x[j]);
    let above = f(&moved(x, j, step));
    let below = f(&moved(x, j, step.neg()));
    above.sub(below).div(step.add(step))
}

/// `∂²f/∂x_j∂x_k` by a central difference.
pub(crate) fn curvature(
    f: &dyn Fn(&[Precise]) -> Precise,
    x: &[Precise],
    [j, k]: [usize; 2],
) -> Precise {
    let step = offset(x[k]);
    if j == k {
        let ends = f(&moved(x, j, step)).add(f(&moved(x, j, step.neg())));
        let middle = f(x);
        return ends.sub(middle.add(middle)).div(step.mul(step));
    }
    let above = slope(f, &moved(x, k, step), j);
    let below = slope(f, &moved(x, k, step.neg()), j);
    above.sub(below).div(step.add(step))
}

fn moved(x: &[Precise], j: usize, step: Precise) -> Vec<Precise> {
    let mut x = x.to_vec();
    x[j] = x[j].add(step);
    x
}
