//! What the kernels do at the edges: equal ends, the smallest increments, the ends of
//! the range of the number type, zero, NaN.

use eem_material::number::kernel::*;
use eem_material::number::scalar::Scalar;

type Kernel = fn(f64, f64) -> f64;

/// Every kernel of two arguments, `f_dd` and `f_dd2`, and `f′` and `½f″` as written in a textbook.
struct Row {
    name: &'static str,
    first: Kernel,
    second: Kernel,
    slope: fn(f64) -> f64,
    half_curvature: fn(f64) -> f64,
}

macro_rules! row {
    ($name:literal, $first:ident, $second:ident, $slope:expr, $half_curvature:expr) => {
        Row {
            name: $name,
            first: $first::<f64>,
            second: $second::<f64>,
            slope: $slope,
            half_curvature: $half_curvature,
        }
    };
}

#[rustfmt::skip]
fn rows() -> Vec<Row> {
    use core::f64::consts::{LOG2_E, LOG10_E};
    vec![
        row!("recip", recip_dd, recip_dd2, |x| -1.0 / (x * x), |x| 1.0 / (x * x * x)),
        row!("sqrt", sqrt_dd, sqrt_dd2, |x| 0.5 / x.sqrt(), |x| -0.125 / (x * x.sqrt())),
        row!("cbrt", cbrt_dd, cbrt_dd2, |x| 1.0 / (3.0 * x.cbrt().powi(2)), |x| -1.0 / (9.0 * x.cbrt().powi(5))),
        row!("exp", exp_dd, exp_dd2, f64::exp, |x| 0.5 * x.exp()),
        row!("exp_m1", exp_m1_dd, exp_m1_dd2, f64::exp, |x| 0.5 * x.exp()),
        row!("ln", ln_dd, ln_dd2, |x| 1.0 / x, |x| -0.5 / (x * x)),
        row!("ln_1p", ln_1p_dd, ln_1p_dd2, |x| 1.0 / (1.0 + x), |x| -0.5 / (1.0 + x).powi(2)),
        row!("log2", log2_dd, log2_dd2, |x| LOG2_E / x, |x| -0.5 * LOG2_E / (x * x)),
        row!("log10", log10_dd, log10_dd2, |x| LOG10_E / x, |x| -0.5 * LOG10_E / (x * x)),
        row!("sin", sin_dd, sin_dd2, f64::cos, |x| -0.5 * x.sin()),
        row!("cos", cos_dd, cos_dd2, |x| -x.sin(), |x| -0.5 * x.cos()),
        row!("tan", tan_dd, tan_dd2, |x| 1.0 / x.cos().powi(2), |x| x.tan() / x.cos().powi(2)),
        row!("sinh", sinh_dd, sinh_dd2, f64::cosh, |x| 0.5 * x.sinh()),
        row!("cosh", cosh_dd, cosh_dd2, f64::sinh, |x| 0.5 * x.cosh()),
        row!("tanh", tanh_dd, tanh_dd2, |x| 1.0 / x.cosh().powi(2), |x| -x.tanh() / x.cosh().powi(2)),
        row!("asinh", asinh_dd, asinh_dd2, |x| 1.0 / x.hypot(1.0), |x| -0.5 * x / x.hypot(1.0).powi(3)),
        row!("atan", atan_dd, atan_dd2, |x| 1.0 / (1.0 + x * x), |x| -x / (1.0 + x * x).powi(2)),
        row!("atanh", atanh_dd, atanh_dd2, |x| 1.0 / (1.0 - x * x), |x| x / (1.0 - x * x).powi(2)),
        row!("powi 5", powi5, powi5_second, |x| 5.0 * x.powi(4), |x| 10.0 * x.powi(3)),
        row!("powi -3", powi3, powi3_second, |x| -3.0 / x.powi(4), |x| 6.0 / x.powi(5)),
        row!("powf 1.3", powf, powf_second, |x| 1.3 * x.powf(0.3), |x| 0.195 * x.powf(-0.7)),
    ]
}

fn powi5<S: Scalar>(a: S, b: S) -> S {
    powi_dd(a, b, 5)
}

fn powi5_second<S: Scalar>(a: S, b: S) -> S {
    powi_dd2(a, b, 5)
}

fn powi3<S: Scalar>(a: S, b: S) -> S {
    powi_dd(a, b, -3)
}

fn powi3_second<S: Scalar>(a: S, b: S) -> S {
    powi_dd2(a, b, -3)
}

fn powf<S: Scalar>(a: S, b: S) -> S {
    powf_dd(a, b, S::from_f64(1.3))
}

fn powf_second<S: Scalar>(a: S, b: S) -> S {
    powf_dd2(a, b, S::from_f64(1.3))
}

/// Arguments inside every domain.
const ENDS: [f64; 6] = [1e-6, 0.03, 0.2, 0.4, 0.7, 0.95];

/// A textbook derivative in double precision is itself right to some ulp only.
const TEXTBOOK: f64 = 32.0 * f64::EPSILON;

fn assert_close(computed: f64, expected: f64, tolerance: f64, what: &str) {
    let error = (computed - expected).abs();
    assert!(
        error <= tolerance * expected.abs(),
        "{what}: {computed:e} instead of {expected:e}"
    );
}

#[test]
fn equal_ends_give_derivatives() {
    for row in rows() {
        for x in ENDS {
            let name = row.name;
            assert_close((row.first)(x, x), (row.slope)(x), TEXTBOOK, name);
            assert_close((row.second)(x, x), (row.half_curvature)(x), TEXTBOOK, name);
        }
    }
}

#[test]
fn neighbours_differ_from_derivatives_by_nothing() {
    for row in rows() {
        for x in ENDS {
            let next = f64::from_bits(x.to_bits() + 1);
            let (name, slope) = (row.name, (row.slope)(x));
            assert_close((row.first)(x, next), slope, TEXTBOOK, name);
            assert_close(
                (row.second)(next, x),
                (row.half_curvature)(x),
                TEXTBOOK,
                name,
            );
        }
    }
}

#[test]
fn subnormal_increments_at_zero() {
    let least = f64::from_bits(1);
    for (a, b) in [
        (0.0, least),
        (least, least),
        (-least, least),
        (0.0, 1e-310),
        (0.0, 0.0),
    ] {
        for first in [
            exp_dd, exp_m1_dd, ln_1p_dd, sin_dd, tan_dd, sinh_dd, tanh_dd, asinh_dd, atan_dd,
            atanh_dd,
        ] {
            assert_eq!(first(a, b).to_bits(), 1.0_f64.to_bits());
        }
        assert_eq!(cosh_dd(-least, least).to_bits(), 0.0_f64.to_bits());
        let mean = 0.5 * (a + b);
        assert_eq!(cos_dd(a, b).abs().to_bits(), mean.abs().to_bits());
        assert_eq!(exp_dd2(a, b).to_bits(), 0.5_f64.to_bits());
        assert_eq!(ln_1p_dd2(a, b).to_bits(), (-0.5_f64).to_bits());
    }
}

#[test]
fn first_differences_are_symmetric_to_the_last_bit_everywhere() {
    let sizes = [
        1e-300, 1e-160, 1e-20, 1e-3, 0.5, 0.99, 1.0, 7.0, 1e3, 1e20, 1e160, 1e300,
    ];
    let ends: Vec<f64> = sizes.iter().flat_map(|&x| [x, -x]).collect();
    for row in rows() {
        for &a in &ends {
            for &b in &ends {
                let (there, back) = ((row.first)(a, b), (row.first)(b, a));
                let same = there.to_bits() == back.to_bits() || (there.is_nan() && back.is_nan());
                assert!(same, "{}[{a:e}, {b:e}]", row.name);
            }
        }
    }
}

#[test]
fn intermediate_overflow_does_not_reach_the_result() {
    // ab underflows or overflows, d/m overflows, xⁿ overflows.
    assert_close(recip_dd(1e-200, 1e-100), -1e300, TEXTBOOK, "recip");
    assert_close(recip_dd(1e-154, 1e154), -1.0, TEXTBOOK, "recip");
    assert_close(recip_dd2(1e-200, 1e200), 1e-200, TEXTBOOK, "recip");
    assert_close(powi_dd(1e-200, 1e150, -2), -1e250, TEXTBOOK, "powi -2");
    assert_close(powi_dd2(1e-120, 1e110, -3), 1e140, TEXTBOOK, "powi -3");
    let wide = 600.0 * 10.0_f64.ln();
    assert_close(ln_dd(1e-300, 1e300), wide / 1e300, TEXTBOOK, "ln");
    assert_close(
        ln_dd2(1e-300, 1e300),
        (1.0 - wide) / 1e300 / 1e300,
        TEXTBOOK,
        "ln",
    );
    assert_close(ln_dd2(1e300, 1e-300), -1.0, TEXTBOOK, "ln");
    assert_close(powf_dd(1e-300, 1e300, 0.5), 1e-150, TEXTBOOK, "powf");
    assert_close(powf_dd(1e-200, 1e-200, 2.0), 2e-200, TEXTBOOK, "powf");
    assert_close(
        asinh_dd(-1e300, 1e300),
        2.0 * 1e300_f64.asinh() / 2e300,
        TEXTBOOK,
        "asinh",
    );
    assert_close(tanh_dd(-400.0, 400.0), 1.0 / 400.0, TEXTBOOK, "tanh");
    assert_close(
        atan_dd(-1e300, 1e300),
        core::f64::consts::PI / 2e300,
        TEXTBOOK,
        "atan",
    );
}

#[test]
fn powers_start_at_zero() {
    for p in [0.5, 0.9, 1.0, 1.2, 1.5, 2.0, 2.5] {
        assert_close(
            powf_dd(0.0, 2.0, p),
            2.0_f64.powf(p - 1.0),
            TEXTBOOK,
            "powf",
        );
        let exact = (p - 1.0) * 2.0_f64.powf(p - 2.0);
        assert_close(powf_dd2(0.0, 2.0, p), exact, TEXTBOOK, "powf");
    }
    for p in [1.2, 1.5, 2.0, 2.5] {
        assert_close(
            powf_dd2(2.0, 0.0, p),
            2.0_f64.powf(p - 2.0),
            TEXTBOOK,
            "powf",
        );
    }
    assert_eq!(powf_dd(0.0_f64, 0.0, 1.0).to_bits(), 1.0_f64.to_bits());
    assert_eq!(powf_dd2(0.0_f64, 0.0, 2.0).to_bits(), 1.0_f64.to_bits());
    assert_eq!(powf_dd(0.0_f64, 0.0, 1.5).to_bits(), 0.0_f64.to_bits());
}

#[test]
fn second_differences_are_derivatives_of_the_first() {
    // ∂f[a,b]/∂b by a central difference: good to about ε^(2/3).
    let tolerance = 1e-8;
    for row in rows() {
        for (a, b) in [(0.3, 0.31), (0.3, 0.6), (0.9, 0.2), (0.05, 0.9), (0.4, 0.4)] {
            let step = 1e-5 * b;
            let expected = ((row.first)(a, b + step) - (row.first)(a, b - step)) / (2.0 * step);
            assert_close((row.second)(a, b), expected, tolerance, row.name);
        }
    }
}

#[test]
fn not_a_number_stays_visible() {
    for row in rows() {
        for (a, b) in [(f64::NAN, 0.5), (0.5, f64::NAN), (f64::NAN, f64::NAN)] {
            assert!((row.first)(a, b).is_nan(), "{}", row.name);
            assert!((row.second)(a, b).is_nan(), "{}", row.name);
        }
    }
}
