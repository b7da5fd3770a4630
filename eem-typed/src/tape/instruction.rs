//! One instruction of a tape, and what it does.

use core::array;

use eem_material::kernel::{self, Differences};
use eem_material::number::scalar::Scalar;
use eem_symbolic::{Function, ProgramKernel};

/// The number of a register.
pub(crate) type Register = u16;

/// An operation on values that are named by `V`.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Action<V> {
    Add(V, V),
    Sub(V, V),
    Mul(V, V),
    Div(V, V),
    Neg(V),
    Powi(V, i32),
    Sqrt(V),
    Power(V, V),
    Apply(Function, V),
    /// `a b + c`; here and below the product is rounded separately.
    MulAdd(V, V, V),
    /// `a b − c`.
    MulSub(V, V, V),
    /// `c − a b`.
    SubMul(V, V, V),
    /// `(a b) c`.
    MulMul(V, V, V),
    /// `f[a, b]`.
    First(ProgramKernel<V>, V, V),
    /// `f[a, b, b]`.
    Second(ProgramKernel<V>, V, V),
    /// `f[a, b]`, `f[a, a, b]`, `f[a, b, b]` in three registers one after the other.
    Joint(ProgramKernel<V>, V, V),
}

/// An action and the register of its (first) result.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Instruction {
    pub(crate) action: Action<Register>,
    pub(crate) to: Register,
}

impl<V: Copy> Action<V> {
    /// Calls `see` for every operand.
    pub(crate) fn operands(&self, mut see: impl FnMut(V)) {
        match *self {
            Self::Neg(a) | Self::Powi(a, _) | Self::Sqrt(a) | Self::Apply(_, a) => see(a),
            Self::Add(a, b)
            | Self::Sub(a, b)
            | Self::Mul(a, b)
            | Self::Div(a, b)
            | Self::Power(a, b) => [a, b].into_iter().for_each(see),
            Self::MulAdd(a, b, c)
            | Self::MulSub(a, b, c)
            | Self::SubMul(a, b, c)
            | Self::MulMul(a, b, c) => [a, b, c].into_iter().for_each(see),
            Self::First(f, a, b) | Self::Second(f, a, b) | Self::Joint(f, a, b) => {
                f.operands().into_iter().chain([a, b]).for_each(see);
            }
        }
    }

    /// The same action with other operands.
    pub(crate) fn map<W>(&self, of: impl Fn(V) -> W) -> Action<W> {
        match *self {
            Self::Add(a, b) => Action::Add(of(a), of(b)),
            Self::Sub(a, b) => Action::Sub(of(a), of(b)),
            Self::Mul(a, b) => Action::Mul(of(a), of(b)),
            Self::Div(a, b) => Action::Div(of(a), of(b)),
            Self::Neg(a) => Action::Neg(of(a)),
            Self::Powi(a, n) => Action::Powi(of(a), n),
            Self::Sqrt(a) => Action::Sqrt(of(a)),
            Self::Power(a, b) => Action::Power(of(a), of(b)),
            Self::Apply(function, a) => Action::Apply(function, of(a)),
            Self::MulAdd(a, b, c) => Action::MulAdd(of(a), of(b), of(c)),
            Self::MulSub(a, b, c) => Action::MulSub(of(a), of(b), of(c)),
            Self::SubMul(a, b, c) => Action::SubMul(of(a), of(b), of(c)),
            Self::MulMul(a, b, c) => Action::MulMul(of(a), of(b), of(c)),
            Self::First(f, a, b) => Action::First(f.map(&of), of(a), of(b)),
            Self::Second(f, a, b) => Action::Second(f.map(&of), of(a), of(b)),
            Self::Joint(f, a, b) => Action::Joint(f.map(&of), of(a), of(b)),
        }
    }
}

/// `P` registers, a power of two: each has `Q` blocks of `B` numbers, one number per element.
pub(crate) type File<const B: usize, const Q: usize, const P: usize> = [[[f64; B]; Q]; P];

impl Instruction {
    /// Reads and writes registers.
    #[inline]
    pub(crate) fn execute<const B: usize, const Q: usize, const P: usize>(
        &self,
        file: &mut File<B, Q, P>,
    ) {
        let to = self.to;
        match self.action {
            Action::Add(a, b) => each(file, to, [a, b], |[a, b]| a + b),
            Action::Sub(a, b) => each(file, to, [a, b], |[a, b]| a - b),
            Action::Mul(a, b) => each(file, to, [a, b], |[a, b]| a * b),
            Action::Div(a, b) => each(file, to, [a, b], |[a, b]| a / b),
            Action::Neg(a) => each(file, to, [a], |[a]| -a),
            Action::Powi(a, n) => each(file, to, [a], |[a]| Scalar::powi(a, n)),
            Action::Sqrt(a) => each(file, to, [a], |[a]| a.sqrt()),
            Action::Power(a, b) => each(file, to, [a, b], |[a, b]| Scalar::powf(a, b)),
            Action::Apply(function, a) => each(file, to, [a], |[a]| apply(function, a)),
            Action::MulAdd(a, b, c) => each(file, to, [a, b, c], |[a, b, c]| a * b + c),
            Action::MulSub(a, b, c) => each(file, to, [a, b, c], |[a, b, c]| a * b - c),
            Action::SubMul(a, b, c) => each(file, to, [a, b, c], |[a, b, c]| c - a * b),
            Action::MulMul(a, b, c) => each(file, to, [a, b, c], |[a, b, c]| a * b * c),
            Action::First(f, a, b) => {
                differences(file, to, (f, a, b), |f, a, b| [first(f, a, b)]);
            }
            Action::Second(f, a, b) => {
                differences(file, to, (f, a, b), |f, a, b| [second(f, a, b)]);
            }
            Action::Joint(f, a, b) => differences(file, to, (f, a, b), |f, a, b| {
                let all = joint(f, a, b);
                [all.first, all.second_a, all.second_b]
            }),
        }
    }
}

/// Computes a register from others, a block at a time.
#[inline]
#[expect(
    clippy::needless_range_loop,
    reason = "the same blocks of several registers"
)]
fn each<const B: usize, const Q: usize, const P: usize, const N: usize>(
    file: &mut File<B, Q, P>,
    to: Register,
    from: [Register; N],
    of: impl Fn([f64; N]) -> f64,
) {
    for block in 0..Q {
        let operands = from.map(|register| file[usize::from(register) & (P - 1)][block]);
        let result = array::from_fn(|index| of(operands.map(|operand| operand[index])));
        file[usize::from(to) & (P - 1)][block] = result;
    }
}

/// Computes consecutive registers: the differences of a function.
#[inline]
#[expect(
    clippy::needless_range_loop,
    reason = "the same blocks of several registers"
)]
fn differences<const B: usize, const Q: usize, const P: usize, const N: usize>(
    file: &mut File<B, Q, P>,
    to: Register,
    (f, a, b): (ProgramKernel<Register>, Register, Register),
    of: impl Fn(ProgramKernel<f64>, f64, f64) -> [f64; N],
) {
    let place = |register: usize| register & (P - 1);
    for block in 0..Q {
        for index in 0..B {
            let at = |register: Register| file[place(register.into())][block][index];
            let results = of(f.map(at), at(a), at(b));
            for (next, result) in results.into_iter().enumerate() {
                file[place(usize::from(to) + next)][block][index] = result;
            }
        }
    }
}

/// `f(a)`.
#[inline(never)]
pub(super) fn apply(function: Function, a: f64) -> f64 {
    match function {
        Function::Exp => Scalar::exp(a),
        Function::ExpM1 => Scalar::exp_m1(a),
        Function::Ln => Scalar::ln(a),
        Function::Ln1p => Scalar::ln_1p(a),
        Function::Log2 => Scalar::log2(a),
        Function::Log10 => Scalar::log10(a),
        Function::Sin => Scalar::sin(a),
        Function::Cos => Scalar::cos(a),
        Function::Tan => Scalar::tan(a),
        Function::Sinh => Scalar::sinh(a),
        Function::Cosh => Scalar::cosh(a),
        Function::Tanh => Scalar::tanh(a),
        Function::Asinh => Scalar::asinh(a),
        Function::Atan => Scalar::atan(a),
        Function::Atanh => Scalar::atanh(a),
        Function::Cbrt => Scalar::cbrt(a),
        Function::Abs => a.abs(),
    }
}

/// `f[a, b]`.
#[inline(never)]
pub(super) fn first(f: ProgramKernel<f64>, a: f64, b: f64) -> f64 {
    match f {
        ProgramKernel::Function(function) => match function {
            Function::Exp => kernel::exp_dd(a, b),
            Function::ExpM1 => kernel::exp_m1_dd(a, b),
            Function::Ln => kernel::ln_dd(a, b),
            Function::Ln1p => kernel::ln_1p_dd(a, b),
            Function::Log2 => kernel::log2_dd(a, b),
            Function::Log10 => kernel::log10_dd(a, b),
            Function::Sin => kernel::sin_dd(a, b),
            Function::Cos => kernel::cos_dd(a, b),
            Function::Tan => kernel::tan_dd(a, b),
            Function::Sinh => kernel::sinh_dd(a, b),
            Function::Cosh => kernel::cosh_dd(a, b),
            Function::Tanh => kernel::tanh_dd(a, b),
            Function::Asinh => kernel::asinh_dd(a, b),
            Function::Atan => kernel::atan_dd(a, b),
            Function::Atanh => kernel::atanh_dd(a, b),
            Function::Cbrt => kernel::cbrt_dd(a, b),
            Function::Abs => no_kernel(),
        },
        ProgramKernel::Powi(-1) => kernel::recip_dd(a, b),
        ProgramKernel::Powi(n) => kernel::powi_dd(a, b, n),
        ProgramKernel::Sqrt => kernel::sqrt_dd(a, b),
        ProgramKernel::Powf(exponent) => kernel::powf_dd(a, b, exponent),
        ProgramKernel::Power(value_a, value_b) => kernel::power_dd(value_a, value_b, a, b),
    }
}

/// `f[a, b, b]`.
#[inline(never)]
pub(super) fn second(f: ProgramKernel<f64>, a: f64, b: f64) -> f64 {
    match f {
        ProgramKernel::Function(function) => match function {
            Function::Exp => kernel::exp_dd2(a, b),
            Function::ExpM1 => kernel::exp_m1_dd2(a, b),
            Function::Ln => kernel::ln_dd2(a, b),
            Function::Ln1p => kernel::ln_1p_dd2(a, b),
            Function::Log2 => kernel::log2_dd2(a, b),
            Function::Log10 => kernel::log10_dd2(a, b),
            Function::Sin => kernel::sin_dd2(a, b),
            Function::Cos => kernel::cos_dd2(a, b),
            Function::Tan => kernel::tan_dd2(a, b),
            Function::Sinh => kernel::sinh_dd2(a, b),
            Function::Cosh => kernel::cosh_dd2(a, b),
            Function::Tanh => kernel::tanh_dd2(a, b),
            Function::Asinh => kernel::asinh_dd2(a, b),
            Function::Atan => kernel::atan_dd2(a, b),
            Function::Atanh => kernel::atanh_dd2(a, b),
            Function::Cbrt => kernel::cbrt_dd2(a, b),
            Function::Abs => no_kernel(),
        },
        ProgramKernel::Powi(-1) => kernel::recip_dd2(a, b),
        ProgramKernel::Powi(n) => kernel::powi_dd2(a, b, n),
        ProgramKernel::Sqrt => kernel::sqrt_dd2(a, b),
        ProgramKernel::Powf(exponent) => kernel::powf_dd2(a, b, exponent),
        ProgramKernel::Power(value_a, value_b) => kernel::power_dd2(value_a, value_b, a, b),
    }
}

/// All three differences: of functions without a joint kernel one by one, with the same bits.
#[inline(never)]
pub(super) fn joint(f: ProgramKernel<f64>, a: f64, b: f64) -> Differences<f64> {
    match f {
        ProgramKernel::Function(Function::Ln) => kernel::ln_dds(a, b),
        ProgramKernel::Function(Function::Ln1p) => kernel::ln_1p_dds(a, b),
        ProgramKernel::Power(value_a, value_b) => kernel::power_dds(value_a, value_b, a, b),
        ProgramKernel::Function(_)
        | ProgramKernel::Powi(_)
        | ProgramKernel::Sqrt
        | ProgramKernel::Powf(_) => Differences {
            first: first(f, a, b),
            second_a: second(f.mirrored(), b, a),
            second_b: second(f, a, b),
        },
    }
}

/// `|x|` has no kernel: programs write its differences with quotients.
fn no_kernel() -> f64 {
    f64::NAN
}
