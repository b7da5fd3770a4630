//! Divided differences of random expressions with the kernels of the runtime: right to their
//! running error bound at any increment, and the same bits for exchanged ends.
//!
//! The rules come from `eem-symbolic`, the kernels from `eem-runtime`; the truth is a quotient of
//! values of the expression itself with 512 bits, which needs neither.

mod kernels;

use eem_symbolic::{Arithmetic, Bounded, Program};
use eem_testkit::length::at_length;
use eem_testkit::precise::{BigFloat, Precise, error, to_f64};
use eem_testkit::secant::{Secant, run, start};
use kernels::{BoundedKernels, Kernels};

/// Random expressions, of which at least 10 of 17 are of moderate size.
fn expressions() -> u32 {
    at_length(1700, 340)
}
/// |b − a|/a: nothing, less than b can resolve, a few bits of b, … , as much as a.
const INCREMENTS: [f64; 9] = [0.0, 1e-18, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1e-1, 1.0];
/// Offset of the numerical derivatives of the truth: errors of 2⁻³⁰⁰ from the formula and 2⁻³⁶⁰
/// from rounding.
const OFFSET: i32 = -150;
/// Error of the truth: the larger of those, times third derivatives, over an increment of 1e-15.
const TRUTH: f64 = 1e-60;

/// An expression with 512 bits, and its value at the first end.
struct Truth<'a> {
    precise: &'a Precise,
    value: &'a Program,
    a: f64,
    at_a: BigFloat,
}

impl<'a> Truth<'a> {
    fn new(precise: &'a Precise, value: &'a Program, a: f64) -> Self {
        let at_a = run(value, precise, &[precise.from_f64(a)]);
        Self {
            precise,
            value,
            a,
            at_a,
        }
    }

    /// f\[a, b\], a quotient of values.
    fn difference(&self, b: f64) -> BigFloat {
        let p = self.precise;
        if self.a.to_bits() == b.to_bits() {
            let [derivative, _] = self.derivatives(b);
            return derivative;
        }
        let at_b = run(self.value, p, &[p.from_f64(b)]);
        p.div(&p.sub(&at_b, &self.at_a), &self.increment(b))
    }

    /// f\[a, b, b\], a quotient of those.
    fn slope(&self, b: f64) -> BigFloat {
        let p = self.precise;
        let [derivative, half_curvature] = self.derivatives(b);
        if self.a.to_bits() == b.to_bits() {
            return half_curvature;
        }
        let rise = p.sub(&derivative, &self.difference(b));
        p.div(&rise, &self.increment(b))
    }

    fn increment(&self, b: f64) -> BigFloat {
        let p = self.precise;
        p.sub(&p.from_f64(b), &p.from_f64(self.a))
    }

    /// f′(x) and ½f″(x), from f(x − δ), f(x), f(x + δ).
    fn derivatives(&self, x: f64) -> [BigFloat; 2] {
        let p = self.precise;
        let x = p.from_f64(x);
        let offset = p.mul(&x, &p.two_to(OFFSET));
        let points = [p.sub(&x, &offset), x.clone(), p.add(&x, &offset)];
        let [below, at, above] = points.map(|x| run(self.value, p, &[x]));
        let width = p.add(&offset, &offset);
        let bend = p.sub(&p.add(&above, &below), &p.add(&at, &at));
        [
            p.div(&p.sub(&above, &below), &width),
            p.div(&bend, &p.mul(&offset, &width)),
        ]
    }
}

/// The largest error in units of its bound, and all errors in ulp.
#[derive(Default)]
struct Statistics {
    worst: f64,
    ulps: Vec<f64>,
}

impl Statistics {
    fn add(&mut self, precise: &Precise, computed: Bounded, exact: &BigFloat, what: &str) {
        let error = error(precise, computed.value, exact);
        assert!(
            error <= computed.error + TRUTH,
            "{what}: error {error:e}, bound {:e}",
            computed.error
        );
        if error > TRUTH {
            self.worst = self.worst.max(error / computed.error);
            self.ulps.push(error / to_f64(exact).abs() / f64::EPSILON);
        }
    }

    fn print(&mut self, what: &str) {
        self.ulps.sort_by(f64::total_cmp);
        let median = self.ulps[self.ulps.len() / 2];
        let worst = self.worst;
        println!("{what}: largest error / bound {worst:.2}, median error {median:.2} ulp");
    }
}

/// Second differences are looked at for one of the increments per expression, each in its turn.
fn in_turn(seed: u64, increment: usize) -> bool {
    seed % INCREMENTS.len() as u64 == increment as u64
}

#[test]
fn differences_are_within_their_bound() {
    let precise = Precise::new();
    let (mut first, mut second) = (Statistics::default(), Statistics::default());
    let mut checked = 0;
    for seed in 0..u64::from(expressions()) {
        let (secant, a) = (Secant::new(seed), start(seed));
        let ends = INCREMENTS.map(|increment| [a, a * (1.0 + increment)]);
        if !ends
            .iter()
            .rev()
            .all(|&ends| secant.is_moderate(&Kernels, ends))
        {
            continue;
        }
        checked += 1;
        let truth = Truth::new(&precise, &secant.value, a);
        for (i, ends) in ends.into_iter().enumerate() {
            if i > 0 && ends[1].to_bits() == a.to_bits() {
                continue; // What b cannot resolve has been looked at as nothing.
            }
            let what = format!("expression {seed} at {:e}", INCREMENTS[i]);
            let inputs = ends.map(Bounded::exact);
            let difference = run(&secant.difference, &BoundedKernels, &inputs);
            first.add(&precise, difference, &truth.difference(ends[1]), &what);
            if in_turn(seed, i) {
                let slope = run(&secant.slope, &BoundedKernels, &inputs);
                second.add(&precise, slope, &truth.slope(ends[1]), &what);
            }
        }
    }
    println!("{checked} expressions");
    first.print("f[a, b]");
    second.print("f[a, b, b]");
    assert!(
        17 * checked >= 10 * expressions(),
        "only {checked} expressions are moderate"
    );
}

#[test]
fn exchanged_ends_give_the_same_bits() {
    let mut checked = 0;
    for seed in 0..u64::from(expressions()) {
        let (secant, a) = (Secant::new(seed), start(seed));
        for increment in INCREMENTS {
            let b = a * (1.0 + increment);
            let forward = run(&secant.difference, &Kernels, &[a, b]);
            let backward = run(&secant.difference, &Kernels, &[b, a]);
            assert_eq!(
                forward.to_bits(),
                backward.to_bits(),
                "expression {seed} at {increment:e}: {forward:e} and {backward:e}"
            );
            checked += usize::from(forward.is_finite());
        }
    }
    println!("{checked} pairs of ends");
}
