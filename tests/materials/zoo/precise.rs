//! Numbers of 320 bits that are copied, as formulas do.

use std::cell::RefCell;

use eem_symbolic::{Arithmetic as _, Function, Number};
use eem_testkit::precise::{self, BigFloat};

use crate::zoo::number::Value;

/// Precision of everything, in bits: second differences with [`OFFSET`] keep half of them.
const BITS: usize = 320;
/// Relative offset 2ⁿ of numerical derivatives, whose own error is its square.
const OFFSET: i32 = -80;
/// What the offset of quotients has more.
const COARSE: i32 = 20;

thread_local! {
    static NUMBERS: RefCell<Vec<BigFloat>> = const { RefCell::new(Vec::new()) };
    static ARITHMETIC: precise::Precise = precise::Precise::with_bits(BITS);
}

/// A number with 96 digits; it lives until [`forget`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Precise(usize);

/// Frees all numbers of this thread; none of them may be used any more.
pub(crate) fn forget() {
    NUMBERS.with(|numbers| numbers.borrow_mut().clear());
}

/// The number that is computed from those that are there.
fn compute(formula: impl FnOnce(&precise::Precise, &[BigFloat]) -> BigFloat) -> Precise {
    NUMBERS.with(|numbers| {
        let number = ARITHMETIC.with(|arithmetic| formula(arithmetic, &numbers.borrow()));
        let mut numbers = numbers.borrow_mut();
        numbers.push(number);
        Precise(numbers.len() - 1)
    })
}

impl Precise {
    /// Exactly this number.
    pub(crate) fn of(value: f64) -> Self {
        compute(|arithmetic, _| arithmetic.from_f64(value))
    }

    /// `2ⁿ`.
    fn two_to(n: i32) -> Self {
        compute(|arithmetic, _| arithmetic.two_to(n))
    }

    pub(crate) fn is_zero(self) -> bool {
        NUMBERS.with(|numbers| numbers.borrow()[self.0].is_zero())
    }

    /// `|self − value|`, in double precision.
    pub(crate) fn distance(self, value: f64) -> f64 {
        self.sub(Self::of(value)).to_f64().abs()
    }

    /// The nearest `f64`, to a unit in the last place.
    pub(crate) fn to_f64(self) -> f64 {
        NUMBERS.with(|numbers| precise::to_f64(&numbers.borrow()[self.0]))
    }
}

impl Value for Precise {
    fn literal(value: f64) -> Self {
        let number = Number::parse_decimal(&value.to_string()).unwrap_or(Number::Float(value));
        compute(|arithmetic, _| arithmetic.constant(&number))
    }

    fn add(self, other: Self) -> Self {
        compute(|arithmetic, at| arithmetic.add(&at[self.0], &at[other.0]))
    }

    fn sub(self, other: Self) -> Self {
        compute(|arithmetic, at| arithmetic.sub(&at[self.0], &at[other.0]))
    }

    fn mul(self, other: Self) -> Self {
        compute(|arithmetic, at| arithmetic.mul(&at[self.0], &at[other.0]))
    }

    fn div(self, other: Self) -> Self {
        compute(|arithmetic, at| arithmetic.div(&at[self.0], &at[other.0]))
    }

    fn powi(self, n: i32) -> Self {
        compute(|arithmetic, at| arithmetic.powi(&at[self.0], n))
    }

    fn power(self, exponent: Self) -> Self {
        compute(|arithmetic, at| arithmetic.power(&at[self.0], &at[exponent.0]))
    }

    fn apply(self, function: Function) -> Self {
        compute(|arithmetic, at| arithmetic.apply(function, &at[self.0]))
    }

    fn sqrt(self) -> Self {
        compute(|arithmetic, at| arithmetic.sqrt(&at[self.0]))
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
