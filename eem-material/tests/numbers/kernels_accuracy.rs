//! Every kernel against 704 bits: at most 3 ulp for first differences (6 for the cube
//! root, ½|n| + 1 for integer powers), 16 ulp for second differences.
//!
//! One ulp is a relative error of 2⁻⁵². First differences are relative to their value, second
//! differences to `∫₀¹ t|f″| dt`, which is their value unless `f″` changes sign.

pub(crate) mod oracle;
pub(crate) mod sample;

use self::oracle::{Function, arithmetic, differences, second_magnitude, to_f64, ulps};
use self::sample::{Domain, Random};
use eem_material::number::kernel::*;
use eem_symbolic::{Arithmetic as _, Function as Elementary};
use eem_testkit::length::at_length;
use eem_testkit::precise::{BigFloat, Precise};

/// Pairs per kernel.
fn pairs() -> u32 {
    at_length(2000, 300)
}

/// The bound on first differences.
const FIRST_LIMIT: f64 = 3.0;

/// The bound on second differences.
const SECOND_LIMIT: f64 = 16.0;

type Kernel = Box<dyn Fn(f64, f64) -> f64>;

/// What the error of a second difference is compared with.
enum Scale {
    /// The value itself.
    Value,
    /// `∫₀¹ t|f″| dt`, where `f″` changes sign at zero.
    OddCurvature,
    /// A given function of the ends.
    Given(Kernel),
}

struct Case {
    name: String,
    first: Kernel,
    second: Kernel,
    function: Function,
    domain: Domain,
    limit: f64,
    scale: Scale,
}

impl Case {
    fn new(
        name: &str,
        first: impl Fn(f64, f64) -> f64 + 'static,
        second: impl Fn(f64, f64) -> f64 + 'static,
        function: impl Fn(&Precise, &BigFloat) -> BigFloat + 'static,
    ) -> Self {
        Self {
            name: name.to_owned(),
            first: Box::new(first),
            second: Box::new(second),
            function: Box::new(function),
            domain: Domain {
                exponents: (-8.0, 8.0),
                signed: true,
                accept: |_| true,
            },
            limit: FIRST_LIMIT,
            scale: Scale::Value,
        }
    }

    fn positive(mut self) -> Self {
        self.domain.signed = false;
        self
    }

    fn exponents(mut self, smallest: f64, largest: f64) -> Self {
        self.domain.exponents = (smallest, largest);
        self
    }

    fn accept(mut self, accept: fn(f64) -> bool) -> Self {
        self.domain.accept = accept;
        self
    }

    fn limit(mut self, limit: f64) -> Self {
        self.limit = limit;
        self
    }

    fn scale(mut self, scale: Scale) -> Self {
        self.scale = scale;
        self
    }

    /// Measures, prints and checks both kernels and the symmetry of the first.
    fn check(&self) {
        let p = arithmetic();
        let mut random = Random::new(&self.name);
        let (mut worst_first, mut worst_second) = (Worst::default(), Worst::default());
        for _ in 0..pairs() {
            let (a, b) = self.domain.pair(&mut random);
            let computed = (self.first)(a, b);
            assert_eq!(
                computed.to_bits(),
                (self.first)(b, a).to_bits(),
                "{}[{a:e}, {b:e}] is not symmetric",
                self.name
            );
            let (exact, exact_second) = differences(&p, &self.function, a, b);
            worst_first.note(ulps(&p, computed, &exact, to_f64(&exact).abs()), a, b);

            let value = to_f64(&exact_second).abs();
            let scale = match &self.scale {
                Scale::Value => value,
                Scale::OddCurvature => second_magnitude(&p, &self.function, (a, b), &exact_second),
                Scale::Given(scale) => scale(a, b).max(value),
            };
            worst_second.note(ulps(&p, (self.second)(a, b), &exact_second, scale), a, b);
        }
        println!(
            "{:12} first {:6.2} ulp (rms {:.2})   second {:6.2} ulp (rms {:.2})",
            self.name,
            worst_first.error,
            worst_first.root_mean_square(),
            worst_second.error,
            worst_second.root_mean_square(),
        );
        worst_first.assert_within(self.limit, &self.name);
        worst_second.assert_within(SECOND_LIMIT, &self.name);
    }
}

#[derive(Default)]
struct Worst {
    error: f64,
    ends: (f64, f64),
    squares: f64,
}

impl Worst {
    fn note(&mut self, error: f64, a: f64, b: f64) {
        self.squares += error * error;
        if error.is_nan() || error > self.error {
            self.error = error;
            self.ends = (a, b);
        }
    }

    fn root_mean_square(&self) -> f64 {
        (self.squares / f64::from(pairs())).sqrt()
    }

    fn assert_within(&self, limit: f64, name: &str) {
        let (a, b) = self.ends;
        assert!(
            self.error <= limit,
            "{name}: {} ulp at ({a:e}, {b:e}), limit {limit}",
            self.error
        );
    }
}

/// An elementary function of the oracle.
macro_rules! big {
    ($function:ident) => {
        |p: &Precise, x: &BigFloat| p.apply(Elementary::$function, x)
    };
}

#[test]
fn reciprocal_and_roots() {
    Case::new("recip", recip_dd, recip_dd2, |p, x| p.powi(x, -1)).check();
    Case::new("sqrt", sqrt_dd, sqrt_dd2, Precise::sqrt)
        .positive()
        .check();
    Case::new("cbrt", cbrt_dd, cbrt_dd2, big!(Cbrt))
        .limit(6.0)
        .scale(Scale::Given(Box::new(|a: f64, b: f64| {
            // −(x + 2y)/(3y²q²) without the cancellation in x + 2y.
            let (x, y) = (a.cbrt(), b.cbrt());
            let q = x * x + x * y + y * y;
            (x.abs() + 2.0 * y.abs()) / (3.0 * y * y * q * q)
        })))
        .check();
}

#[test]
fn integer_powers() {
    for n in [2_i32, 3, 4, 5, 7, 12, 20, -1, -2, -3, -4, -5, -8, -13] {
        let limit = 0.5 * f64::from(n.abs()) + 1.0;
        let case = Case::new(
            &format!("powi {n}"),
            move |a, b| powi_dd(a, b, n),
            move |a, b| powi_dd2(a, b, n),
            move |p, x| p.powi(x, n),
        );
        case.limit(limit)
            .scale(match n {
                // Across the pole the terms of the sum differ in sign.
                ..0 => Scale::Given(Box::new(move |a, b| powi_dd2(a.abs(), b.abs(), n))),
                _ if n % 2 == 0 => Scale::Value,
                _ => Scale::OddCurvature,
            })
            .check();
    }
}

#[test]
fn real_powers() {
    for p in [1.5, 1.0 / 3.0, 0.01, -2.7, 9.3, 0.999, 1.4, 1.6, -0.3] {
        Case::new(
            &format!("powf {p:.3}"),
            move |a, b| powf_dd(a, b, p),
            move |a, b| powf_dd2(a, b, p),
            move |precise, x| precise.power(x, &precise.from_f64(p)),
        )
        .positive()
        .check();
    }
}

#[test]
fn exponential() {
    let moderate = |x: f64| x.abs() < 700.0;
    for (name, first, second) in [
        (
            "exp",
            exp_dd as fn(f64, f64) -> f64,
            exp_dd2 as fn(f64, f64) -> f64,
        ),
        ("exp_m1", exp_m1_dd, exp_m1_dd2),
    ] {
        Case::new(name, first, second, big!(Exp))
            .exponents(-8.0, 2.8)
            .accept(moderate)
            .check();
    }
}

#[test]
fn logarithms() {
    let domain = (-12.0, 12.0);
    for case in [
        Case::new("ln", ln_dd, ln_dd2, big!(Ln)).positive(),
        Case::new("log2", log2_dd, log2_dd2, big!(Log2)).positive(),
        Case::new("log10", log10_dd, log10_dd2, big!(Log10)).positive(),
        Case::new("ln_1p", ln_1p_dd, ln_1p_dd2, big!(Ln1p)).accept(|x| x > -1.0),
    ] {
        case.exponents(domain.0, domain.1).check();
    }
}

/// `∫₀¹ t|g(a + t(b − a))| dt` by the midpoint rule: enough for a scale.
fn weighted_mean(a: f64, b: f64, g: fn(f64) -> f64) -> f64 {
    let steps = 64;
    (0..steps)
        .map(|i| {
            let t = (f64::from(i) + 0.5) / f64::from(steps);
            t * g(a + t * (b - a)).abs() / f64::from(steps)
        })
        .sum()
}

#[test]
fn trigonometric() {
    for case in [
        Case::new("sin", sin_dd, sin_dd2, big!(Sin))
            .scale(Scale::Given(Box::new(|a, b| weighted_mean(a, b, f64::sin)))),
        Case::new("cos", cos_dd, cos_dd2, big!(Cos))
            .scale(Scale::Given(Box::new(|a, b| weighted_mean(a, b, f64::cos)))),
    ] {
        case.exponents(-8.0, 4.0).check();
    }
    Case::new("tan", tan_dd, tan_dd2, big!(Tan))
        .exponents(-8.0, 0.19)
        .accept(|x| x.abs() < 1.57)
        .scale(Scale::OddCurvature)
        .check();
}

#[test]
fn hyperbolic() {
    let moderate = |x: f64| x.abs() < 700.0;
    for case in [
        Case::new("sinh", sinh_dd, sinh_dd2, big!(Sinh)).scale(Scale::OddCurvature),
        Case::new("cosh", cosh_dd, cosh_dd2, big!(Cosh)),
    ] {
        case.exponents(-8.0, 2.8).accept(moderate).check();
    }
    Case::new("tanh", tanh_dd, tanh_dd2, big!(Tanh))
        .exponents(-8.0, 2.0)
        .accept(|x| x.abs() < 150.0)
        .scale(Scale::OddCurvature)
        .check();
}

#[test]
fn inverse_functions() {
    for case in [
        Case::new("asinh", asinh_dd, asinh_dd2, big!(Asinh)),
        Case::new("atan", atan_dd, atan_dd2, big!(Atan)),
        Case::new("atanh", atanh_dd, atanh_dd2, big!(Atanh))
            .exponents(-8.0, 0.0)
            .accept(|x| x.abs() < 1.0),
    ] {
        case.scale(Scale::OddCurvature).check();
    }
}

#[test]
fn known_values_of_the_exponential() {
    Case::new(
        "power",
        |a, b| power_dd(a.exp(), b.exp(), a, b),
        |a, b| power_dd2(a.exp(), b.exp(), a, b),
        big!(Exp),
    )
    .exponents(-8.0, 2.8)
    .accept(|x| x.abs() < 700.0)
    .check();
}

/// `gʰ` with `g` and `h` varying: at most 4·max(1, |h ln g|) ulp.
#[test]
fn general_power_loses_no_more_than_its_condition() {
    let p = arithmetic();
    let mut random = Random::new("general power");
    let domain = Domain {
        exponents: (-3.0, 2.0),
        signed: false,
        accept: |_| true,
    };
    // g = x, h = x/3: X = ⅓x ln x.
    let third = 1.0 / 3.0;
    let function: Function = Box::new(move |p, x| p.power(x, &p.mul(x, &p.from_f64(third))));
    let inner: Function = Box::new(move |p, x| {
        let logarithm = p.apply(Elementary::Ln, x);
        p.mul(&p.mul(x, &p.from_f64(third)), &logarithm)
    });
    let mut worst = 0.0_f64;
    for _ in 0..pairs() {
        let (a, b) = domain.pair(&mut random);
        if a.max(b) > 200.0 {
            continue;
        }
        let x = |x: f64| third * x * x.ln();
        // The difference of X exactly, so that only this kernel is measured.
        let (exact_inner, _) = differences(&p, &inner, a, b);
        let computed = power_dd(a.powf(third * a), b.powf(third * b), x(a), x(b));
        let exact = p.div(&differences(&p, &function, a, b).0, &exact_inner);
        let condition = x(a).abs().max(x(b).abs()).max(1.0);
        worst = worst.max(ulps(&p, computed, &exact, to_f64(&exact).abs()) / condition);
    }
    println!("power x^(x/3) first {worst:6.2} ulp per max(1, |h ln g|)");
    assert!(worst <= 4.0);
}
