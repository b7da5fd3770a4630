//! Divided differences from their definition, in arithmetic of 704 bits.
//!
//! Independent of every kernel: only values of `f` are used, and derivatives
//! are differences over distances far below what double precision resolves.

use astro_float::{BigFloat, Consts, RoundingMode};

/// Precision in bits. The smallest increments cost 2 × 60 of them, a
/// second difference of equal ends 2 × 110, and a derivative 180.
const PRECISION: usize = 704;

/// The distance of a central difference, relative to the argument.
const DERIVATIVE_STEP: f64 = 1e-54;

/// The distance that stands for equal ends, relative to the argument.
const CONFLUENT_STEP: f64 = 1e-33;

const MODE: RoundingMode = RoundingMode::None;

/// A function in high precision.
pub(crate) type Function = Box<dyn Fn(&mut Oracle, &BigFloat) -> BigFloat>;

/// The arithmetic and its table of constants.
pub(crate) struct Oracle {
    constants: Consts,
}

impl Oracle {
    pub(crate) fn new() -> Self {
        Self {
            constants: Consts::new().expect("memory for constants"),
        }
    }

    pub(crate) fn number(value: f64) -> BigFloat {
        BigFloat::from_f64(value, PRECISION)
    }

    /// An elementary function of `astro-float` with its table of constants.
    pub(crate) fn apply(
        &mut self,
        function: impl Fn(&BigFloat, usize, RoundingMode, &mut Consts) -> BigFloat,
        x: &BigFloat,
    ) -> BigFloat {
        function(x, PRECISION, MODE, &mut self.constants)
    }

    pub(crate) fn power(&mut self, x: &BigFloat, exponent: f64) -> BigFloat {
        x.pow(
            &Self::number(exponent),
            PRECISION,
            MODE,
            &mut self.constants,
        )
    }

    /// `f[a,b]` and `f[a,b,b]`.
    pub(crate) fn differences(&mut self, f: &Function, a: f64, b: f64) -> (BigFloat, BigFloat) {
        let y = Self::number(b);
        let slope = self.slope(f, &y);
        let equal = a.to_bits() == b.to_bits();
        let x = if equal {
            add(&y, &mul(&y, &Self::number(CONFLUENT_STEP)))
        } else {
            Self::number(a)
        };
        let quotient = self.quotient(f, &x, &y);
        let second = div(&sub(&slope, &quotient), &sub(&y, &x));
        (if equal { slope } else { quotient }, second)
    }

    /// `∫₀¹ t|f″(a + t(b − a))| dt` for an `f″` that changes sign at zero only.
    ///
    /// `total` is `f[a,b,b]`.
    pub(crate) fn second_magnitude(
        &mut self,
        f: &Function,
        (a, b): (f64, f64),
        total: &BigFloat,
    ) -> f64 {
        if a * b >= 0.0 {
            return to_f64(total).abs();
        }
        // By parts on the side of b: ∫ t f″ dt = (f′(b) − t₀f′(0))/d − (f(b) − f(0))/d².
        let (x, y) = (Self::number(a), Self::number(b));
        let d = sub(&y, &x);
        let zero = mul(&x, &Self::number(1e-40));
        let start = div(&sub(&zero, &x), &d);
        let slopes = sub(&self.slope(f, &y), &mul(&start, &self.slope(f, &zero)));
        let values = sub(&f(self, &y), &f(self, &zero));
        let beside_b = sub(&div(&slopes, &d), &div(&div(&values, &d), &d));
        let beside_a = sub(total, &beside_b);
        to_f64(&beside_b).abs() + to_f64(&beside_a).abs()
    }

    fn slope(&mut self, f: &Function, x: &BigFloat) -> BigFloat {
        let step = mul(x, &Self::number(DERIVATIVE_STEP));
        let (low, high) = (sub(x, &step), add(x, &step));
        self.quotient(f, &low, &high)
    }

    fn quotient(&mut self, f: &Function, a: &BigFloat, b: &BigFloat) -> BigFloat {
        let difference = sub(&f(self, b), &f(self, a));
        div(&difference, &sub(b, a))
    }
}

/// The error of `computed` in units of 2⁻⁵² of `scale`.
pub(crate) fn ulps(computed: f64, exact: &BigFloat, scale: f64) -> f64 {
    let error = to_f64(&sub(&Oracle::number(computed), exact)).abs();
    if error == 0.0 {
        0.0
    } else {
        error / scale / f64::EPSILON
    }
}

/// The leading 64 bits.
#[expect(clippy::cast_precision_loss, reason = "the nearest double is wanted")]
pub(crate) fn to_f64(x: &BigFloat) -> f64 {
    if x.is_zero() {
        return 0.0;
    }
    let words = x.mantissa_digits().expect("finite");
    let leading = *words.last().expect("not empty") as f64 * 2.0_f64.powi(-64);
    let exponent = x.exponent().expect("finite");
    // Two factors, so that a subnormal scale does not underflow early.
    let value = leading * 2.0_f64.powi(exponent / 2) * 2.0_f64.powi(exponent - exponent / 2);
    if x.is_negative() { -value } else { value }
}

pub(crate) fn add(a: &BigFloat, b: &BigFloat) -> BigFloat {
    a.add(b, PRECISION, MODE)
}

pub(crate) fn sub(a: &BigFloat, b: &BigFloat) -> BigFloat {
    a.sub(b, PRECISION, MODE)
}

pub(crate) fn mul(a: &BigFloat, b: &BigFloat) -> BigFloat {
    a.mul(b, PRECISION, MODE)
}

pub(crate) fn div(a: &BigFloat, b: &BigFloat) -> BigFloat {
    a.div(b, PRECISION, MODE)
}

pub(crate) fn sqrt(x: &BigFloat) -> BigFloat {
    x.sqrt(PRECISION, MODE)
}

pub(crate) fn cbrt(x: &BigFloat) -> BigFloat {
    x.cbrt(PRECISION, MODE)
}

pub(crate) fn natural_power(x: &BigFloat, n: usize) -> BigFloat {
    x.powi(n, PRECISION, MODE)
}
