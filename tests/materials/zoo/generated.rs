//! The arithmetic of generated code: the functions and kernels that it calls, in double precision.

use eem::__private::{Scalar, kernel};
use eem_symbolic::{Arithmetic, Function, JointDifferences, Number, ProgramKernel};

/// Interprets a program as generated code computes it, bit for bit.
pub(crate) struct Generated;

macro_rules! functions {
    ($($function:ident: $name:ident, $first:ident, $second:ident;)*) => {
        fn apply(function: Function, a: f64) -> f64 {
            match function {
                $(Function::$function => Scalar::$name(a),)*
                Function::Abs => Scalar::abs(a),
            }
        }

        fn first(function: Function, a: f64, b: f64) -> f64 {
            match function {
                $(Function::$function => kernel::$first(a, b),)*
                Function::Abs => unreachable!("it has no kernel"),
            }
        }

        fn second(function: Function, a: f64, b: f64) -> f64 {
            match function {
                $(Function::$function => kernel::$second(a, b),)*
                Function::Abs => unreachable!("it has no kernel"),
            }
        }
    };
}

functions! {
    Exp: exp, exp_dd, exp_dd2;
    ExpM1: exp_m1, exp_m1_dd, exp_m1_dd2;
    Ln: ln, ln_dd, ln_dd2;
    Ln1p: ln_1p, ln_1p_dd, ln_1p_dd2;
    Log2: log2, log2_dd, log2_dd2;
    Log10: log10, log10_dd, log10_dd2;
    Sin: sin, sin_dd, sin_dd2;
    Cos: cos, cos_dd, cos_dd2;
    Tan: tan, tan_dd, tan_dd2;
    Sinh: sinh, sinh_dd, sinh_dd2;
    Cosh: cosh, cosh_dd, cosh_dd2;
    Tanh: tanh, tanh_dd, tanh_dd2;
    Asinh: asinh, asinh_dd, asinh_dd2;
    Atan: atan, atan_dd, atan_dd2;
    Atanh: atanh, atanh_dd, atanh_dd2;
    Cbrt: cbrt, cbrt_dd, cbrt_dd2;
}

impl Arithmetic for Generated {
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
        apply(function, *a)
    }

    fn divided_difference(&self, kernel: ProgramKernel<&f64>, a: &f64, b: &f64) -> f64 {
        let (a, b) = (*a, *b);
        match kernel {
            ProgramKernel::Function(function) => first(function, a, b),
            ProgramKernel::Powi(-1) => kernel::recip_dd(a, b),
            ProgramKernel::Powi(n) => kernel::powi_dd(a, b, n),
            ProgramKernel::Sqrt => kernel::sqrt_dd(a, b),
            ProgramKernel::Powf(p) => kernel::powf_dd(a, b, *p),
            ProgramKernel::Power(value_a, value_b) => kernel::power_dd(*value_a, *value_b, a, b),
        }
    }

    fn second_divided_difference(&self, kernel: ProgramKernel<&f64>, a: &f64, b: &f64) -> f64 {
        let (a, b) = (*a, *b);
        match kernel {
            ProgramKernel::Function(function) => second(function, a, b),
            ProgramKernel::Powi(-1) => kernel::recip_dd2(a, b),
            ProgramKernel::Powi(n) => kernel::powi_dd2(a, b, n),
            ProgramKernel::Sqrt => kernel::sqrt_dd2(a, b),
            ProgramKernel::Powf(p) => kernel::powf_dd2(a, b, *p),
            ProgramKernel::Power(value_a, value_b) => kernel::power_dd2(*value_a, *value_b, a, b),
        }
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
