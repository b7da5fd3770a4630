//! Double precision in which every number carries a bound of its rounding error, to first order.
//!
//! ```text
//! a + b :  e = e_a + e_b + u|a + b|         a b :  e = |b| e_a + |a| e_b + u|a b|
//! f(a)  :  e = |f′(a)| e_a + u_f |f(a)|     f[a, b] :  e = |f[b, a, a]| e_a + |f[a, b, b]| e_b + u_f ∫(|f′| + |x f″|)
//! ```
//!
//! No bound contains 1/|b − a|: divided differences keep their digits at any increment.
//! Wilkinson 1986, *Error analysis revisited*, calls such a bound a running error analysis.

use crate::function::Function;
use crate::interpret::{Arithmetic, F64};
use crate::number::Number;
use crate::operation::ProgramKernel;
use crate::quadrature::rounding_scale;

/// Unit roundoff of `f64`, the bound of the relative error of one operation.
const UNIT: f64 = f64::EPSILON / 2.0;
/// Bound of the relative error of an elementary function of the platform, in units of roundoff.
const FUNCTION: f64 = 2.0;
/// Bound of the error of a first divided difference by quadrature, in units of roundoff of
/// ∫(|f′| + |x f″|).
const FIRST: f64 = 4.0;
/// Bound of the relative error of a second divided difference by quadrature, in units of roundoff.
const SECOND: f64 = 40.0;

/// Evaluates in double precision and bounds the error.
#[derive(Clone, Copy, Debug, Default)]
pub struct RunningError;

/// A double-precision number and a bound of its error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounded {
    /// The computed number.
    pub value: f64,
    /// Bound of |computed − exact|, to first order in the unit roundoff.
    pub error: f64,
}

impl Bounded {
    /// A number without error.
    #[must_use]
    pub fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    fn rounded(value: f64, inherited: f64, units: f64) -> Self {
        let error = inherited + units * UNIT * value.abs();
        Self { value, error }
    }
}

impl Arithmetic for RunningError {
    type Number = Bounded;

    fn constant(&self, number: &Number) -> Bounded {
        Bounded::rounded(number.to_f64(), 0.0, 1.0)
    }

    fn add(&self, a: &Bounded, b: &Bounded) -> Bounded {
        Bounded::rounded(a.value + b.value, a.error + b.error, 1.0)
    }

    fn sub(&self, a: &Bounded, b: &Bounded) -> Bounded {
        Bounded::rounded(a.value - b.value, a.error + b.error, 1.0)
    }

    fn mul(&self, a: &Bounded, b: &Bounded) -> Bounded {
        let inherited = a.error * b.value.abs() + a.value.abs() * b.error;
        Bounded::rounded(a.value * b.value, inherited, 1.0)
    }

    fn div(&self, a: &Bounded, b: &Bounded) -> Bounded {
        let value = a.value / b.value;
        let inherited = (a.error + value.abs() * b.error) / b.value.abs();
        Bounded::rounded(value, inherited, 1.0)
    }

    fn neg(&self, a: &Bounded) -> Bounded {
        Bounded {
            value: -a.value,
            ..*a
        }
    }

    fn powi(&self, a: &Bounded, n: i32) -> Bounded {
        let units = f64::from(n.unsigned_abs());
        let slope = f64::from(n) * a.value.powi(n - 1);
        Bounded::rounded(a.value.powi(n), slope.abs() * a.error, units)
    }

    fn sqrt(&self, a: &Bounded) -> Bounded {
        let value = a.value.sqrt();
        Bounded::rounded(value, 0.5 * a.error / value, 1.0)
    }

    fn power(&self, a: &Bounded, b: &Bounded) -> Bounded {
        let value = a.value.powf(b.value);
        let base = (b.value / a.value).abs() * a.error;
        let inherited = value * (base + a.value.ln().abs() * b.error);
        Bounded::rounded(value, inherited, FUNCTION)
    }

    fn apply(&self, function: Function, a: &Bounded) -> Bounded {
        let value = F64.apply(function, &a.value);
        // |a| has no derivative at zero, and passes errors on as they are.
        let slope = if function == Function::Abs {
            1.0
        } else {
            F64.divided_difference(ProgramKernel::Function(function), &a.value, &a.value)
        };
        Bounded::rounded(value, slope.abs() * a.error, FUNCTION)
    }

    fn divided_difference(
        &self,
        kernel: ProgramKernel<&Bounded>,
        a: &Bounded,
        b: &Bounded,
    ) -> Bounded {
        let values = kernel.map(|operand| &operand.value);
        let value = F64.divided_difference(values, &a.value, &b.value);
        let to_a = F64.second_divided_difference(values.mirrored(), &b.value, &a.value);
        let to_b = F64.second_divided_difference(values, &a.value, &b.value);
        let ends = to_a.abs() * a.error + to_b.abs() * b.error;
        let scale = rounding_scale(values.map(|value| *value), a.value, b.value);
        let error = ends + of_kernel(kernel, value, a, b) + FIRST * UNIT * scale;
        Bounded { value, error }
    }

    fn second_divided_difference(
        &self,
        kernel: ProgramKernel<&Bounded>,
        a: &Bounded,
        b: &Bounded,
    ) -> Bounded {
        let values = kernel.map(|operand| &operand.value);
        let second = |a: &f64, b: &f64| F64.second_divided_difference(values, a, b);
        let value = second(&a.value, &b.value);
        // Third derivatives are not available: each end is moved by its error instead.
        let moved = |end: &Bounded| end.value + end.error;
        let ends = (second(&moved(a), &b.value) - value).abs()
            + (second(&a.value, &moved(b)) - value).abs();
        Bounded::rounded(value, ends + of_kernel(kernel, value, a, b), SECOND)
    }
}

/// The error that comes from the values that f itself depends on.
fn of_kernel(kernel: ProgramKernel<&Bounded>, value: f64, a: &Bounded, b: &Bounded) -> f64 {
    match kernel {
        ProgramKernel::Function(_) | ProgramKernel::Powi(_) | ProgramKernel::Sqrt => 0.0,
        // ∂/∂p of p xᵖ⁻¹ is xᵖ⁻¹ (1 + p ln x).
        ProgramKernel::Powf(p) => {
            let logarithm = a.value.ln().abs().max(b.value.ln().abs());
            value.abs() * p.error * (p.value.recip().abs() + logarithm)
        }
        ProgramKernel::Power(value_a, value_b) => {
            let relative = |value: &Bounded| value.error / value.value.abs();
            value.abs() * relative(value_a).max(relative(value_b))
        }
    }
}
