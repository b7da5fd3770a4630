//! Arithmetics whose divided differences are the kernels that generated code calls.

use eem::{Scalar, kernel};
use eem_symbolic::{Arithmetic, Bounded, F64, Function, Number, ProgramKernel, RunningError};

/// Double precision: what generated code computes.
pub(crate) struct Kernels;

/// The same, each number beside the bound that [`RunningError`] has for it.
pub(crate) struct BoundedKernels;

/// `f[a, b]`.
fn first(kernel: ProgramKernel<f64>, a: f64, b: f64) -> f64 {
    match kernel {
        ProgramKernel::Function(function) => of_function(function).0(a, b),
        ProgramKernel::Powi(-1) => kernel::recip_dd(a, b),
        ProgramKernel::Powi(n) => kernel::powi_dd(a, b, n),
        ProgramKernel::Sqrt => kernel::sqrt_dd(a, b),
        ProgramKernel::Powf(p) => kernel::powf_dd(a, b, p),
        ProgramKernel::Power(value_a, value_b) => kernel::power_dd(value_a, value_b, a, b),
    }
}

/// `f[a, b, b]`.
fn second(kernel: ProgramKernel<f64>, a: f64, b: f64) -> f64 {
    match kernel {
        ProgramKernel::Function(function) => of_function(function).1(a, b),
        ProgramKernel::Powi(-1) => kernel::recip_dd2(a, b),
        ProgramKernel::Powi(n) => kernel::powi_dd2(a, b, n),
        ProgramKernel::Sqrt => kernel::sqrt_dd2(a, b),
        ProgramKernel::Powf(p) => kernel::powf_dd2(a, b, p),
        ProgramKernel::Power(value_a, value_b) => kernel::power_dd2(value_a, value_b, a, b),
    }
}

type Kernel = fn(f64, f64) -> f64;

/// First and second divided difference of an elementary function.
fn of_function(function: Function) -> (Kernel, Kernel) {
    match function {
        Function::Exp => (kernel::exp_dd, kernel::exp_dd2),
        Function::ExpM1 => (kernel::exp_m1_dd, kernel::exp_m1_dd2),
        Function::Ln => (kernel::ln_dd, kernel::ln_dd2),
        Function::Ln1p => (kernel::ln_1p_dd, kernel::ln_1p_dd2),
        Function::Log2 => (kernel::log2_dd, kernel::log2_dd2),
        Function::Log10 => (kernel::log10_dd, kernel::log10_dd2),
        Function::Sin => (kernel::sin_dd, kernel::sin_dd2),
        Function::Cos => (kernel::cos_dd, kernel::cos_dd2),
        Function::Tan => (kernel::tan_dd, kernel::tan_dd2),
        Function::Sinh => (kernel::sinh_dd, kernel::sinh_dd2),
        Function::Cosh => (kernel::cosh_dd, kernel::cosh_dd2),
        Function::Tanh => (kernel::tanh_dd, kernel::tanh_dd2),
        Function::Asinh => (kernel::asinh_dd, kernel::asinh_dd2),
        Function::Atan => (kernel::atan_dd, kernel::atan_dd2),
        Function::Atanh => (kernel::atanh_dd, kernel::atanh_dd2),
        Function::Cbrt => (kernel::cbrt_dd, kernel::cbrt_dd2),
        Function::Abs => unreachable!("|x| has no kernel and is not among the random functions"),
    }
}

impl Arithmetic for Kernels {
    type Number = f64;

    fn constant(&self, number: &Number) -> f64 {
        F64.constant(number)
    }

    fn add(&self, a: &f64, b: &f64) -> f64 {
        a + b
    }

    fn sub(&self, a: &f64, b: &f64) -> f64 {
        a - b
    }

    fn mul(&self, a: &f64, b: &f64) -> f64 {
        a * b
    }

    fn div(&self, a: &f64, b: &f64) -> f64 {
        a / b
    }

    fn neg(&self, a: &f64) -> f64 {
        -a
    }

    fn powi(&self, a: &f64, n: i32) -> f64 {
        Scalar::powi(*a, n)
    }

    fn sqrt(&self, a: &f64) -> f64 {
        Scalar::sqrt(*a)
    }

    fn power(&self, a: &f64, b: &f64) -> f64 {
        Scalar::powf(*a, *b)
    }

    fn apply(&self, function: Function, a: &f64) -> f64 {
        F64.apply(function, a)
    }

    fn divided_difference(&self, kernel: ProgramKernel<&f64>, a: &f64, b: &f64) -> f64 {
        first(kernel.map(|value| *value), *a, *b)
    }

    fn second_divided_difference(&self, kernel: ProgramKernel<&f64>, a: &f64, b: &f64) -> f64 {
        second(kernel.map(|value| *value), *a, *b)
    }
}

impl Arithmetic for BoundedKernels {
    type Number = Bounded;

    fn constant(&self, number: &Number) -> Bounded {
        RunningError.constant(number)
    }

    fn add(&self, a: &Bounded, b: &Bounded) -> Bounded {
        RunningError.add(a, b)
    }

    fn sub(&self, a: &Bounded, b: &Bounded) -> Bounded {
        RunningError.sub(a, b)
    }

    fn mul(&self, a: &Bounded, b: &Bounded) -> Bounded {
        RunningError.mul(a, b)
    }

    fn div(&self, a: &Bounded, b: &Bounded) -> Bounded {
        RunningError.div(a, b)
    }

    fn neg(&self, a: &Bounded) -> Bounded {
        RunningError.neg(a)
    }

    fn powi(&self, a: &Bounded, n: i32) -> Bounded {
        let Bounded { error, .. } = RunningError.powi(a, n);
        let value = Kernels.powi(&a.value, n);
        Bounded { value, error }
    }

    fn sqrt(&self, a: &Bounded) -> Bounded {
        RunningError.sqrt(a)
    }

    fn power(&self, a: &Bounded, b: &Bounded) -> Bounded {
        RunningError.power(a, b)
    }

    fn apply(&self, function: Function, a: &Bounded) -> Bounded {
        RunningError.apply(function, a)
    }

    fn divided_difference(
        &self,
        kernel: ProgramKernel<&Bounded>,
        a: &Bounded,
        b: &Bounded,
    ) -> Bounded {
        let Bounded { error, .. } = RunningError.divided_difference(kernel, a, b);
        let value = first(kernel.map(|operand| operand.value), a.value, b.value);
        Bounded { value, error }
    }

    fn second_divided_difference(
        &self,
        kernel: ProgramKernel<&Bounded>,
        a: &Bounded,
        b: &Bounded,
    ) -> Bounded {
        let Bounded { error, .. } = RunningError.second_divided_difference(kernel, a, b);
        let value = second(kernel.map(|operand| operand.value), a.value, b.value);
        Bounded { value, error }
    }
}
