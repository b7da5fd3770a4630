//! Divided differences of functions in `f64`, from integrals instead of the formulas of the kernels.
//!
//! ```text
//! f[a, b]    = ∫₀¹ f′(a + t (b − a)) dt
//! f[a, b, b] = ∫₀¹ t f″(a + t (b − a)) dt
//! ```
//!
//! by composite Gauss–Legendre quadrature: no difference of values is ever formed, so nothing
//! cancels however close the ends are. Only derivatives are written down here.

use crate::function::Function;
use crate::operation::ProgramKernel;

/// The panels of \[0, ½\] end at 2⁻¹, 2⁻², … 2⁻ⁿ and 0, those of \[½, 1\] mirror them. If the ratio of
/// the ends is below 2ⁿ, a pole beyond an end, as that of ln x, is at least as far from each panel as
/// the panel is wide, and 16 nodes leave an error below 10⁻²⁰.
const HALVINGS: i32 = 10;

/// Positive nodes and weights of the Gauss–Legendre rule with 16 points on \[−1, 1\], Abramowitz &
/// Stegun 1964, table 25.4.
const NODES: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_58),
    (0.458_016_777_657_227_4, 0.169_156_519_395_002_54),
    (0.617_876_244_402_643_8, 0.149_595_988_816_576_74),
    (0.755_404_408_355_003, 0.124_628_971_255_533_88),
    (0.865_631_202_387_831_8, 0.095_158_511_682_492_79),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_894),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_096),
];

/// `f[a, b]`.
pub(crate) fn divided_difference(kernel: ProgramKernel<f64>, a: f64, b: f64) -> f64 {
    if let Some(value) = kernel.closed_form(a, b) {
        return value;
    }
    let (kernel, a, b) = kernel.based(a, b);
    integral(a, b, |_, x| kernel.derivatives(x).0)
}

/// `f[a, b, b]`.
pub(crate) fn second_divided_difference(kernel: ProgramKernel<f64>, a: f64, b: f64) -> f64 {
    let (kernel, a, b) = kernel.based(a, b);
    integral(a, b, |t, x| t * kernel.derivatives(x).1)
}

/// `∫₀¹ (|f′| + |x f″|) dt`: times the unit roundoff, the scale of the error of `f[a, b]` due to
/// rounding of the nodes and of f′.
pub(crate) fn rounding_scale(kernel: ProgramKernel<f64>, a: f64, b: f64) -> f64 {
    let (kernel, a, b) = kernel.based(a, b);
    integral(a, b, |_, x| {
        let (first, second) = kernel.derivatives(x);
        first.abs() + (x * second).abs()
    })
}

/// `∫₀¹ g(t, a + t (b − a)) dt`.
fn integral(a: f64, b: f64, g: impl Fn(f64, f64) -> f64) -> f64 {
    let rising = |t: f64| g(t, (1.0 - t) * a + t * b);
    let falling = |t: f64| g(1.0 - t, t * a + (1.0 - t) * b);
    let smallest = 0.5_f64.powi(HALVINGS);
    let mut sum = panel(rising, 0.0, smallest) + panel(falling, 0.0, smallest);
    for k in (1..HALVINGS).rev() {
        let low = 0.5_f64.powi(k + 1);
        sum += panel(rising, low, 2.0 * low) + panel(falling, low, 2.0 * low);
    }
    sum
}

/// The integral of g from `low` to `high`.
fn panel(g: impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
    let pair =
        |&(node, weight): &(f64, f64)| weight * (g(centre - half * node) + g(centre + half * node));
    half * NODES.iter().rev().map(pair).sum::<f64>()
}

impl ProgramKernel<f64> {
    /// `f[a, b]` of |x|, which is not differentiable.
    fn closed_form(self, a: f64, b: f64) -> Option<f64> {
        match self {
            Self::Function(Function::Abs) => Some((a + b) / (a.abs() + b.abs())),
            Self::Function(_) | Self::Powi(_) | Self::Sqrt | Self::Powf(_) | Self::Power(..) => {
                None
            }
        }
    }

    /// Writes a general power as `value · e^(x − X)`, with the larger value and its logarithm X: the ends become x − X.
    fn based(self, a: f64, b: f64) -> (Self, f64, f64) {
        match self {
            Self::Power(value_a, value_b) => {
                let (value, top) = if a < b { (value_b, b) } else { (value_a, a) };
                (Self::Power(value, value), a - top, b - top)
            }
            Self::Function(_) | Self::Powi(_) | Self::Sqrt | Self::Powf(_) => (self, a, b),
        }
    }

    /// `f′(x)` and `f″(x)`.
    fn derivatives(self, x: f64) -> (f64, f64) {
        match self {
            Self::Function(function) => elementary(function, x),
            Self::Powi(n) => {
                let factor = f64::from(n);
                (
                    factor * x.powi(n - 1),
                    factor * (factor - 1.0) * x.powi(n - 2),
                )
            }
            Self::Sqrt => (0.5 / x.sqrt(), -0.25 / (x * x.sqrt())),
            Self::Powf(p) => (p * x.powf(p - 1.0), p * (p - 1.0) * x.powf(p - 2.0)),
            Self::Power(value, _) => (value * x.exp(), value * x.exp()),
        }
    }
}

/// `f′(x)` and `f″(x)` of an elementary function.
fn elementary(function: Function, x: f64) -> (f64, f64) {
    use std::f64::consts::{LN_2, LN_10};
    match function {
        Function::Exp | Function::ExpM1 => (x.exp(), x.exp()),
        Function::Ln => (x.recip(), -(x * x).recip()),
        Function::Ln1p => ((1.0 + x).recip(), -((1.0 + x) * (1.0 + x)).recip()),
        Function::Log2 => ((x * LN_2).recip(), -(x * x * LN_2).recip()),
        Function::Log10 => ((x * LN_10).recip(), -(x * x * LN_10).recip()),
        Function::Sin => (x.cos(), -x.sin()),
        Function::Cos => (-x.sin(), -x.cos()),
        Function::Tan => {
            let square = x.cos().powi(-2);
            (square, 2.0 * x.tan() * square)
        }
        Function::Sinh => (x.cosh(), x.sinh()),
        Function::Cosh => (x.sinh(), x.cosh()),
        Function::Tanh => {
            let square = x.cosh().powi(-2);
            (square, -2.0 * x.tanh() * square)
        }
        Function::Asinh => {
            let root = (1.0 + x * x).sqrt();
            (root.recip(), -x / (root * root * root))
        }
        Function::Atan => {
            let square = 1.0 + x * x;
            (square.recip(), -2.0 * x / (square * square))
        }
        Function::Atanh => {
            let square = (1.0 - x) * (1.0 + x);
            (square.recip(), 2.0 * x / (square * square))
        }
        Function::Cbrt => {
            let root = x.cbrt();
            ((3.0 * root * root).recip(), -2.0 / (9.0 * root.powi(5)))
        }
        Function::Abs => (x.signum(), 0.0),
    }
}
