//! Divided differences from their definition, in arithmetic of 704 bits.
//!
//! Independent of every kernel: only values of `f` are used, and derivatives
//! are differences over distances far below what double precision resolves.

use eem_symbolic::Arithmetic as _;
pub(crate) use eem_testkit::precise::to_f64;
use eem_testkit::precise::{BigFloat, Precise, error};

/// Precision in bits. The smallest increments cost 2 × 60 of them, a
/// second difference of equal ends 2 × 110, and a derivative 180.
const PRECISION: usize = 704;

/// The distance of a central difference, relative to the argument.
const DERIVATIVE_STEP: f64 = 1e-54;

/// The distance that stands for equal ends, relative to the argument.
const CONFLUENT_STEP: f64 = 1e-33;

/// A function in high precision.
pub(crate) type Function = Box<dyn Fn(&Precise, &BigFloat) -> BigFloat>;

/// The arithmetic.
pub(crate) fn arithmetic() -> Precise {
    Precise::with_bits(PRECISION)
}

/// `f[a,b]` and `f[a,b,b]`.
pub(crate) fn differences(p: &Precise, f: &Function, a: f64, b: f64) -> (BigFloat, BigFloat) {
    let y = p.from_f64(b);
    let slope = slope(p, f, &y);
    let equal = a.to_bits() == b.to_bits();
    let x = if equal {
        p.add(&y, &p.mul(&y, &p.from_f64(CONFLUENT_STEP)))
    } else {
        p.from_f64(a)
    };
    let quotient = quotient(p, f, &x, &y);
    let second = p.div(&p.sub(&slope, &quotient), &p.sub(&y, &x));
    (if equal { slope } else { quotient }, second)
}

/// `∫₀¹ t|f″(a + t(b − a))| dt` for an `f″` that changes sign at zero only.
///
/// `total` is `f[a,b,b]`.
pub(crate) fn second_magnitude(
    p: &Precise,
    f: &Function,
    (a, b): (f64, f64),
    total: &BigFloat,
) -> f64 {
    if a * b >= 0.0 {
        return to_f64(total).abs();
    }
    // By parts on the side of b: ∫ t f″ dt = (f′(b) − t₀f′(0))/d − (f(b) − f(0))/d².
    let (x, y) = (p.from_f64(a), p.from_f64(b));
    let d = p.sub(&y, &x);
    let zero = p.mul(&x, &p.from_f64(1e-40));
    let start = p.div(&p.sub(&zero, &x), &d);
    let slopes = p.sub(&slope(p, f, &y), &p.mul(&start, &slope(p, f, &zero)));
    let values = p.sub(&f(p, &y), &f(p, &zero));
    let beside_b = p.sub(&p.div(&slopes, &d), &p.div(&p.div(&values, &d), &d));
    let beside_a = p.sub(total, &beside_b);
    to_f64(&beside_b).abs() + to_f64(&beside_a).abs()
}

fn slope(p: &Precise, f: &Function, x: &BigFloat) -> BigFloat {
    let step = p.mul(x, &p.from_f64(DERIVATIVE_STEP));
    let (low, high) = (p.sub(x, &step), p.add(x, &step));
    quotient(p, f, &low, &high)
}

fn quotient(p: &Precise, f: &Function, a: &BigFloat, b: &BigFloat) -> BigFloat {
    let difference = p.sub(&f(p, b), &f(p, a));
    p.div(&difference, &p.sub(b, a))
}

/// The error of `computed` in units of 2⁻⁵² of `scale`.
pub(crate) fn ulps(p: &Precise, computed: f64, exact: &BigFloat, scale: f64) -> f64 {
    let error = error(p, computed, exact);
    if error == 0.0 {
        0.0
    } else {
        error / scale / f64::EPSILON
    }
}
