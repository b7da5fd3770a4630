//! Divided differences of the elementary functions without cancellation.
//!
//! For every function `f` of the language there are two kernels,
//!
//! ```text
//! f_dd (a, b) = f[a,b]   = (f(b) − f(a))/(b − a) = ∫₀¹ f′(a + t(b − a)) dt
//! f_dd2(a, b) = f[a,b,b] = (f′(b) − f[a,b])/(b − a) = ∂f[a,b]/∂b
//! ```
//!
//! smooth functions of `(a, b)` that are evaluated as such: `f[a,a] = f′(a)`
//! and `f[a,a,a] = ½f″(a)` are regular values, and no distance between `a`
//! and `b` is too small or too large. The quotient on the left is never formed
//! for close ends.
//!
//! * First differences are right to 3 ulp (`cbrt_dd` 6, `powi_dd` ½|n| + 1), where
//!   1 ulp is a relative error of 2⁻⁵², for any distance of the ends, and are
//!   **bitwise symmetric**, `f_dd(a, b) == f_dd(b, a)`: a scheme built from them
//!   alone is self-adjoint in floating-point arithmetic. There is no threshold on the
//!   increment; the only comparison with zero catches 0/0. Both hold as long as
//!   the values of `f` at the ends are normal numbers.
//! * Second differences are right to 16 ulp of `∫₀¹ t|f″| dt`, hence
//!   relatively wherever `f″` keeps its sign between the ends. They are the exact
//!   tangent: `∂f[a,b]/∂b = f_dd2(a, b)` and `∂f[a,b]/∂a = f_dd2(b, a)`.
//!
//! Three rules make the formulas work. The distance `d = |b − a|` is a
//! difference of inputs, exact for close ends, never of values of `f`. A
//! formula is based at the end that dominates, so that the argument of each
//! building block is positive and its condition at most one. The terms of a sum
//! have the same sign, and a factor that vanishes exactly where `f[a,b]` does is explicit.
//!
//! The idea is that of Kahan & Fateman, *Symbolic computation of divided
//! differences*, SIGSAM Bull. 33 (1999); for `exp` see
//! *Accurate computation of divided differences of the exponential function*, Math.
//! Comp. 43 (1984) 501–528; as a program transformation of Reps & Rall,
//! Higher-Order and Symbolic Computation 16 (2003).

mod exponential;
mod hyperbolic;
mod inverse;
mod logarithm;
mod power;
mod primitives;
mod trigonometric;

pub use exponential::{exp_dd as exp_m1_dd, exp_dd2 as exp_m1_dd2};
pub use exponential::{exp_dd, exp_dd2, power_dd, power_dd2, power_dds};
pub use hyperbolic::{cosh_dd, cosh_dd2, sinh_dd, sinh_dd2, tanh_dd, tanh_dd2};
pub use inverse::{asinh_dd, asinh_dd2, atan_dd, atan_dd2, atanh_dd, atanh_dd2};
pub use logarithm::{
    ln_1p_dd, ln_1p_dd2, ln_1p_dds, ln_dd, ln_dd2, ln_dds, log2_dd, log2_dd2, log10_dd, log10_dd2,
};
pub use power::{
    cbrt_dd, cbrt_dd2, powf_dd, powf_dd2, powi_dd, powi_dd2, recip_dd, recip_dd2, sqrt_dd, sqrt_dd2,
};
pub use primitives::{Differences, two_sum};
pub use trigonometric::{cos_dd, cos_dd2, sin_dd, sin_dd2, tan_dd, tan_dd2};
