//! The arithmetic of generated code: the functions and kernels that it calls.

use eem::{Scalar, kernel};
use eem_symbolic::{
    Arithmetic, Bounded, Function, JointDifferences, Number, ProgramKernel, RunningError,
};

/// In double precision: what generated code computes, bit for bit.
pub(crate) struct Kernels;

/// The same, each number beside the bound that [`RunningError`] has for it.
pub(crate) struct BoundedKernels;

/// `f[a, b]`.
fn first(kernel: ProgramKernel<f64>, a: f64, b: f64) -> f64 {
    match kernel {
        ProgramKernel::Function(function) => of_function(function).1(a, b),
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
        ProgramKernel::Function(function) => of_function(function).2(a, b),
        ProgramKernel::Powi(-1) => kernel::recip_dd2(a, b),
        ProgramKernel::Powi(n) => kernel::powi_dd2(a, b, n),
        ProgramKernel::Sqrt => kernel::sqrt_dd2(a, b),
        ProgramKernel::Powf(p) => kernel::powf_dd2(a, b, p),
        ProgramKernel::Power(value_a, value_b) => kernel::power_dd2(value_a, value_b, a, b),
    }
}

type Kernel = fn(f64, f64) -> f64;

/// An elementary function, its first and its second divided difference.
fn of_function(function: Function) -> (fn(f64) -> f64, Kernel, Kernel) {
    match function {
        Function::Exp => (Scalar::exp, kernel::exp_dd, kernel::exp_dd2),
        Function::ExpM1 => (Scalar::exp_m1, kernel::exp_m1_dd, kernel::exp_m1_dd2),
        Function::Ln => (Scalar::ln, kernel::ln_dd, kernel::ln_dd2),
        Function::Ln1p => (Scalar::ln_1p, kernel::ln_1p_dd, kernel::ln_1p_dd2),
        Function::Log2 => (Scalar::log2, kernel::log2_dd, kernel::log2_dd2),
        Function::Log10 => (Scalar::log10, kernel::log10_dd, kernel::log10_dd2),
        Function::Sin => (Scalar::sin, kernel::sin_dd, kernel::sin_dd2),
        Function::Cos => (Scalar::cos, kernel::cos_dd, kernel::cos_dd2),
        Function::Tan => (Scalar::tan, kernel::tan_dd, kernel::tan_dd2),
        Function::Sinh => (Scalar::sinh, kernel::sinh_dd, kernel::sinh_dd2),
        Function::Cosh => (Scalar::cosh, kernel::cosh_dd, kernel::cosh_dd2),
        Function::Tanh => (Scalar::tanh, kernel::tanh_dd, kernel::tanh_dd2),
        Function::Asinh => (Scalar::asinh, kernel::asinh_dd, kernel::asinh_dd2),
        Function::Atan => (Scalar::atan, kernel::atan_dd, kernel::atan_dd2),
        Function::Atanh => (Scalar::atanh, kernel::atanh_dd, kernel::atanh_dd2),
        Function::Cbrt => (Scalar::cbrt, kernel::cbrt_dd, kernel::cbrt_dd2),
        Function::Abs => (Scalar::abs, no_kernel, no_kernel),
    }
}

/// Of |x|, which is not among the random functions.
fn no_kernel(_: f64, _: f64) -> f64 {
    unreachable!("|x| has no kernel")
}

impl Arithmetic for Kernels {
    type Number = f64;

    fn constant(&self, number: &Number) -> f64 {
        number.to_f64()
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
        of_function(function).0(*a)
    }

    fn divided_difference(&self, kernel: ProgramKernel<&f64>, a: &f64, b: &f64) -> f64 {
        first(kernel.map(|value| *value), *a, *b)
    }

    fn second_divided_difference(&self, kernel: ProgramKernel<&f64>, a: &f64, b: &f64) -> f64 {
        second(kernel.map(|value| *value), *a, *b)
    }

    fn joint_differences(
        &self,
        kernel: ProgramKernel<&f64>,
        a: &f64,
        b: &f64,
    ) -> JointDifferences<f64> {
        let (a, b) = (*a, *b);
        let differences = match kernel {
            ProgramKernel::Function(Function::Ln) => kernel::ln_dds(a, b),
            ProgramKernel::Function(Function::Ln1p) => kernel::ln_1p_dds(a, b),
            ProgramKernel::Power(value_a, value_b) => kernel::power_dds(*value_a, *value_b, a, b),
            ProgramKernel::Function(_)
            | ProgramKernel::Powi(_)
            | ProgramKernel::Sqrt
            | ProgramKernel::Powf(_) => unreachable!("it has no joint call"),
        };
        JointDifferences {
            first: differences.first,
            second_a: differences.second_a,
            second_b: differences.second_b,
        }
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
