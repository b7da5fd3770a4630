//! Kernels on two lanes at once: every lane has the bits that it has alone, although
//! both arms of every branch are evaluated.

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use eem_material::number::kernel::*;
use eem_material::number::scalar::Scalar;

/// Two numbers that always move together.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Lanes([f64; 2]);

impl Lanes {
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self([f(self.0[0], other.0[0]), f(self.0[1], other.0[1])])
    }
}

impl Neg for Lanes {
    type Output = Self;

    fn neg(self) -> Self {
        Self(self.0.map(|x| -x))
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident $assign:ident $method_assign:ident),*) => {
        $(
            impl $operator for Lanes {
                type Output = Self;

                fn $method(self, other: Self) -> Self {
                    self.zip(other, $operator::$method)
                }
            }

            impl $assign for Lanes {
                fn $method_assign(&mut self, other: Self) {
                    *self = $operator::$method(*self, other);
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

macro_rules! lanewise {
    ($($method:ident($($argument:ident)?)),*) => {
        $(
            fn $method(self $(, $argument: Self)?) -> Self {
                lanewise!(@call self $method $($argument)?)
            }
        )*
    };
    (@call $self:ident $method:ident) => {
        Self($self.0.map(<f64 as Scalar>::$method))
    };
    (@call $self:ident $method:ident $argument:ident) => {
        $self.zip($argument, <f64 as Scalar>::$method)
    };
}

impl Scalar for Lanes {
    type Mask = [bool; 2];

    fn from_f64(value: f64) -> Self {
        Self([value; 2])
    }

    fn equal(self, other: Self) -> [bool; 2] {
        [self.0[0].equal(other.0[0]), self.0[1].equal(other.0[1])]
    }

    fn less(self, other: Self) -> [bool; 2] {
        [self.0[0].less(other.0[0]), self.0[1].less(other.0[1])]
    }

    fn branch(
        mask: [bool; 2],
        then: impl FnOnce() -> Self,
        otherwise: impl FnOnce() -> Self,
    ) -> Self {
        let (then, otherwise) = (then().0, otherwise().0);
        Self([0, 1].map(|i| if mask[i] { then[i] } else { otherwise[i] }))
    }

    lanewise!(
        abs(),
        sqrt(),
        cbrt(),
        exp(),
        exp_m1(),
        ln(),
        ln_1p(),
        log2(),
        log10(),
        sin(),
        cos(),
        tan(),
        sinh(),
        cosh(),
        tanh(),
        asinh(),
        atan(),
        atanh(),
        minimum(other),
        maximum(other),
        atan2(other),
        hypot(other),
        powf(other)
    );
}

/// One kernel on lanes and on single numbers.
struct Kernel {
    name: &'static str,
    lanes: fn(Lanes, Lanes) -> Lanes,
    single: fn(f64, f64) -> f64,
}

macro_rules! kernels {
    ($($name:ident),*) => {
        vec![$(Kernel { name: stringify!($name), lanes: $name, single: $name }),*]
    };
}

fn power<S: Scalar>(a: S, b: S) -> S {
    powf_dd(a, b, S::from_f64(1.3)) + powf_dd2(a, b, S::from_f64(0.8))
}

fn integer_power<S: Scalar>(a: S, b: S) -> S {
    powi_dd(a, b, 7) + powi_dd2(a, b, -2)
}

#[test]
fn lanes_do_not_disturb_each_other() {
    let kernels = kernels![
        recip_dd,
        recip_dd2,
        sqrt_dd,
        sqrt_dd2,
        cbrt_dd,
        cbrt_dd2,
        exp_dd,
        exp_dd2,
        ln_dd,
        ln_dd2,
        ln_1p_dd,
        ln_1p_dd2,
        log2_dd,
        log2_dd2,
        log10_dd,
        log10_dd2,
        sin_dd,
        sin_dd2,
        cos_dd,
        cos_dd2,
        tan_dd,
        tan_dd2,
        sinh_dd,
        sinh_dd2,
        cosh_dd,
        cosh_dd2,
        tanh_dd,
        tanh_dd2,
        asinh_dd,
        asinh_dd2,
        atan_dd,
        atan_dd2,
        atanh_dd,
        atanh_dd2,
        power,
        integer_power
    ];
    let pairs = [
        (0.3, 0.3),
        (0.3, 0.3 + 1e-15),
        (0.01, 0.9),
        (0.9, 0.01),
        (0.5, 0.51),
        (1e-9, 0.99),
    ];
    for kernel in kernels {
        for (a0, b0) in pairs {
            for (a1, b1) in pairs {
                let Lanes(both) = (kernel.lanes)(Lanes([a0, a1]), Lanes([b0, b1]));
                let alone = [(kernel.single)(a0, b0), (kernel.single)(a1, b1)];
                let same = both.map(f64::to_bits) == alone.map(f64::to_bits);
                assert!(same, "{}: {both:?} instead of {alone:?}", kernel.name);
            }
        }
    }
}
