//! Elementary functions against 704 bits: wrong by less than 2⁻⁵² of their value, with the library of the platform as with
//! the feature `portable`.
//!
//! The table of `docs/reproducible.md` is what this prints for both:
//! `cargo test -p eem-runtime --all-features --test numbers elementary -- --nocapture`.

use crate::kernels_accuracy::oracle::{arithmetic, to_f64, ulps};
use crate::kernels_accuracy::sample::{Domain, Random};
use eem_material::number::scalar::Scalar;
use eem_symbolic::{Arithmetic as _, Function as Elementary};
use eem_testkit::precise::{BigFloat, Precise};

/// Arguments per function.
const ARGUMENTS: usize = 400;

/// What is allowed, in units of 2⁻⁵² of the value.
const LIMIT: f64 = 1.0;

type Function = fn(f64) -> f64;
type Exact = fn(&Precise, &BigFloat) -> BigFloat;

struct Case {
    name: &'static str,
    platform: Function,
    ours: Function,
    exact: Exact,
    /// Decimal exponents of the arguments, and whether there are negative ones.
    arguments: (f64, f64, bool),
}

/// An elementary function of the oracle.
macro_rules! exact {
    ($function:ident) => {
        |p, x| p.apply(Elementary::$function, x)
    };
}

fn cases() -> Vec<Case> {
    let case = |name, platform, ours, exact: Exact, arguments| Case {
        name,
        platform,
        ours,
        exact,
        arguments,
    };
    vec![
        case("exp", f64::exp, Scalar::exp, exact!(Exp), (-8.0, 2.0, true)),
        case(
            "exp_m1",
            f64::exp_m1,
            Scalar::exp_m1,
            exact!(ExpM1),
            (-8.0, 2.0, true),
        ),
        case("ln", f64::ln, Scalar::ln, exact!(Ln), (-8.0, 8.0, false)),
        case(
            "ln_1p",
            f64::ln_1p,
            Scalar::ln_1p,
            exact!(Ln1p),
            (-8.0, 8.0, false),
        ),
        case(
            "powf",
            |x| x.powf(1.7),
            |x| Scalar::powf(x, 1.7),
            |p, x| p.power(x, &p.from_f64(1.7)),
            (-8.0, 8.0, false),
        ),
        case("sin", f64::sin, Scalar::sin, exact!(Sin), (-8.0, 3.0, true)),
        case("cos", f64::cos, Scalar::cos, exact!(Cos), (-8.0, 3.0, true)),
        case(
            "tanh",
            f64::tanh,
            Scalar::tanh,
            exact!(Tanh),
            (-8.0, 1.0, true),
        ),
        case(
            "atan",
            f64::atan,
            Scalar::atan,
            exact!(Atan),
            (-8.0, 8.0, true),
        ),
    ]
}

#[test]
fn elementary_functions_are_as_good_as_the_schemes_assume() {
    let p = arithmetic();
    println!("{:>8} {:>10} {:>10}", "", "platform", "eem");
    for case in cases() {
        let (low, high, signed) = case.arguments;
        let domain = Domain {
            exponents: (low, high),
            signed,
            accept: |_| true,
        };
        let mut random = Random::new(case.name);
        let mut worst = [0.0_f64; 2];
        for _ in 0..ARGUMENTS {
            let x = domain.point(&mut random);
            let exact = (case.exact)(&p, &p.from_f64(x));
            let scale = to_f64(&exact).abs();
            for (worst, function) in worst.iter_mut().zip([case.platform, case.ours]) {
                *worst = worst.max(ulps(&p, function(x), &exact, scale));
            }
        }
        let [platform, ours] = worst;
        println!("{:>8} {platform:>10.3} {ours:>10.3}", case.name);
        assert!(ours <= LIMIT, "{}: {ours} ulp", case.name);
    }
}
