//! Calls of the library's transcendental functions: as many as the programs say, and no more than
//! the formulas ask for.

use core::cell::Cell;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use eem::{FreeEnergy, Scalar, kernel};
use eem_symbolic::{Function, Instruction, Operation, Program, ProgramKernel, Stage, Value};

use crate::support::ThermoViscoElastic;

thread_local! {
    static CALLS: Cell<usize> = const { Cell::new(0) };
}

/// How often `run` calls a transcendental function.
fn calls<T>(run: impl FnOnce() -> T) -> usize {
    CALLS.set(0);
    run();
    CALLS.get()
}

/// A number that counts.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct Counted(f64);

impl Neg for Counted {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0)
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident $assign:ident $method_assign:ident),*) => {
        $(
            impl $operator for Counted {
                type Output = Self;

                fn $method(self, other: Self) -> Self {
                    Self(self.0.$method(other.0))
                }
            }

            impl $assign for Counted {
                fn $method_assign(&mut self, other: Self) {
                    self.0.$method_assign(other.0);
                }
            }
        )*
    };
}

operators!(
    Add add AddAssign add_assign,
    Sub sub SubAssign sub_assign,
    Mul mul MulAssign mul_assign,
    Div div DivAssign div_assign
);

macro_rules! forward {
    ($count:literal: $($method:ident($($argument:ident)?)),*) => {
        $(
            fn $method(self $(, $argument: Self)?) -> Self {
                CALLS.set(CALLS.get() + $count);
                Self(<f64 as Scalar>::$method(self.0 $(, $argument.0)?))
            }
        )*
    };
}

impl Scalar for Counted {
    fn from_f64(value: f64) -> Self {
        Self(value)
    }

    forward!(0: abs(), minimum(other), maximum(other), sqrt(), cbrt(), hypot(other));
    forward!(1: exp(), exp_m1(), ln(), ln_1p(), log2(), log10(), sin(), cos(), tan(), sinh(),
        cosh(), tanh(), asinh(), atan(), atan2(x), atanh(), powf(exponent));
}

/// Close ends, in the domain of every function.
const ENDS: [Counted; 2] = [Counted(0.5), Counted(0.51)];

/// What programs count for the first and the second difference of a function.
fn said(kernel: ProgramKernel) -> [usize; 2] {
    let count = |operation| {
        let instructions = [Operation::Input(0), Operation::Input(1), operation];
        let instructions = instructions.map(|operation| Instruction {
            operation,
            stage: Stage::New,
        });
        let program = Program {
            inputs: Vec::new(),
            instructions: instructions.to_vec(),
            outputs: Vec::new(),
        };
        program.transcendental_count().calls
    };
    let [a, b] = [0, 1].map(Value::new);
    [
        count(Operation::DividedDifference(kernel, a, b)),
        count(Operation::SecondDividedDifference(kernel, a, b)),
    ]
}

macro_rules! check {
    ($($function:ident: $first:ident $second:ident),*) => {
        $({
            let [a, b] = ENDS;
            let counted = [calls(|| kernel::$first(a, b)), calls(|| kernel::$second(a, b))];
            let said = said(ProgramKernel::Function(Function::$function));
            assert_eq!(counted, said, stringify!($function));
        })*
    };
}

#[test]
fn differences_call_the_library_as_often_as_programs_count() {
    check!(
        Exp: exp_dd exp_dd2, ExpM1: exp_m1_dd exp_m1_dd2, Ln: ln_dd ln_dd2,
        Ln1p: ln_1p_dd ln_1p_dd2, Log2: log2_dd log2_dd2, Log10: log10_dd log10_dd2,
        Sin: sin_dd sin_dd2, Cos: cos_dd cos_dd2, Tan: tan_dd tan_dd2, Sinh: sinh_dd sinh_dd2,
        Cosh: cosh_dd cosh_dd2, Tanh: tanh_dd tanh_dd2, Asinh: asinh_dd asinh_dd2,
        Atan: atan_dd atan_dd2, Atanh: atanh_dd atanh_dd2, Cbrt: cbrt_dd cbrt_dd2
    );
    let ([a, b], p) = (ENDS, Counted(1.7));
    let powf = [
        calls(|| kernel::powf_dd(a, b, p)),
        calls(|| kernel::powf_dd2(a, b, p)),
    ];
    assert_eq!(powf, said(ProgramKernel::Powf(Value::new(0))));
    let power = calls(|| kernel::power_dds(a, b, a, b));
    assert_eq!(
        [power; 2],
        said(ProgramKernel::Power(Value::new(0), Value::new(1)))
    );
}

#[test]
fn the_pendulum_calls_no_function_in_an_iteration() {
    let law = ThermoViscoElastic::PENDULUM;
    let [x0, x1] = [[3.0, 0.2, 380.0], [2.95, 0.21, 379.8]].map(|x| x.map(Counted));
    let old = law.temperature_form_old(&x0);
    // ln λ¹ and ln θ¹ come from ln λ⁰, ln θ⁰ and divided differences.
    assert_eq!(calls(|| law.temperature_form(&old, &x1)), 0);
    assert_eq!(calls(|| law.temperature_form_response(&old, &x1)), 0);
    let old = law.entropy_form_old(&x0);
    let corners = [380.1, 380.2, 379.9, 380.0].map(Counted);
    assert_eq!(calls(|| law.entropy_form(&old, &x1, &corners)), 0);
    assert_eq!(calls(|| law.entropy_form_response(&old, &x1, &corners)), 0);
    assert_eq!(calls(|| law.temperature_form_old(&x0)), 1);
    // ln θ⁰ as well, from which the mixed states follow.
    assert_eq!(calls(|| law.entropy_form_old(&x0)), 2);
}
