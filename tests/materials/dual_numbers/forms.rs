//! The algorithmic forms from their definition: quotients of differences, in dual numbers.
//!
//! ```text
//! D_i F = ½((F(v¹₁ … v¹ᵢ, v⁰ …) − F(v¹₁ … v⁰ᵢ, v⁰ …))/Δvᵢ + the same with v⁰ and v¹ exchanged)
//! ```
//!
//! García Orden & Romero 2012, eq. 28; Conde Martín, Betsch & García Orden 2016, eqs. 37–39.

use eem::invert;
use num_dual::{Dual, Dual64};

use crate::dual_numbers::duals::{array, energy, energy_size, entropy};
use crate::dual_numbers::formulas::{Formula, Number};

/// Relative increments of the step: quotients keep their digits only if the ends are apart.
const INCREMENTS: [f64; 4] = [0.25, -0.2, 0.3, 0.3];
/// Two chains, weighted by a half, of quotients of two values with 8 ulp each, and the same again
/// for the entropies of the temperature form: 32 ulp of the size of e over the increment.
const ULPS: f64 = 32.0;

/// `D_i F` for all i.
fn partitioned<D: Number>(f: impl Fn(&[D]) -> D, v0: &[D], v1: &[D]) -> Vec<D> {
    let chain = |from: &[D], to: &[D], i: usize| {
        let at = |k: usize| f(&[&to[..k], &from[k..]].concat());
        (at(i + 1) - at(i)) / (to[i] - from[i])
    };
    let half = |i: usize| (chain(v0, v1, i) + chain(v1, v0, i)) * 0.5;
    (0..v0.len()).map(half).collect()
}

/// θ with S(y, θ) = s, in real numbers.
fn temperature<F: Formula>(law: &F, y: &[f64], s: f64, start: f64) -> f64 {
    let evaluate = |theta: f64| law.caloric(&array(&[y, &[theta]].concat()));
    invert(evaluate, s, start).unwrap().temperature
}

/// The same with derivatives: one step of Newton's method from the solution is exact to first order.
fn moving_temperature<F: Formula>(law: &F, y: &[Dual64], s: Dual64, start: f64) -> Dual64 {
    let real: Vec<f64> = y.iter().map(|value| value.re).collect();
    let theta = temperature(law, &real, s.re, start);
    let at = [y, &[Dual::from_re(theta)]].concat();
    let caloric = law.caloric(&array(&[&real[..], &[theta]].concat()));
    let slope = caloric.heat_capacity / theta;
    at[y.len()] - (entropy(law, &at) - s) / slope
}

/// The state at the end of the step, to be differentiated by variable `j`.
fn seeded(x1: &[f64], j: usize) -> Vec<Dual64> {
    let seed = |(i, &value): (usize, &f64)| Dual::new(value, f64::from(u8::from(i == j)));
    x1.iter().enumerate().map(seed).collect()
}

fn step<F: Formula>() -> [Vec<f64>; 2] {
    let x0 = F::state();
    let moved = x0.iter().zip(INCREMENTS);
    let x1 = moved.map(|(x, increment)| x * (1.0 + increment)).collect();
    [x0, x1]
}

/// `f* = D_λ e`, `g* = −D_γ e`.
fn signed<F: Formula>(mut derivatives: Vec<Dual64>) -> Vec<Dual64> {
    for derivative in &mut derivatives[F::MEASURES..F::MEASURES + F::DASHPOTS] {
        *derivative = -*derivative;
    }
    derivatives
}

/// Compares response and tangent with `expected(j)`, the response and its derivative
/// by variable `j` of x¹.
fn compare<F: Formula>(
    (response, tangent): &(F::Response, F::Tangent),
    expected: impl Fn(usize) -> Vec<Dual64>,
) {
    let [x0, x1] = step::<F>();
    let law = F::example();
    let increment = |i: usize| (x1[i] - x0[i]).abs();
    let size = energy_size(&law, &x0).max(energy_size(&law, &x1));
    // The conjugate of a row: λ and γ for forces, s for θ*; Δs is itself a difference of
    // entropies, of size e/θ.
    let theta = x1[x1.len() - 1];
    let row_size = |i: usize, values: &[Dual64]| match i.checked_sub(F::MEASURES + F::DASHPOTS) {
        None => size / increment(i),
        Some(0) => size / values[i + 1].re.abs(),
        Some(_) => size / theta,
    };
    let mut worst = 0.0_f64;
    for j in 0..x1.len() {
        let expected = expected(j);
        assert_eq!(expected.len(), response.as_ref().len());
        for (i, value) in expected.iter().enumerate() {
            let unit = f64::EPSILON * row_size(i, &expected);
            let error = (response.as_ref()[i] - value.re).abs() / unit;
            let slope = tangent.as_ref()[i].as_ref()[j];
            let slope_error = (slope - value.eps).abs() / unit * increment(j);
            worst = worst.max(error).max(slope_error);
            assert!(error <= ULPS, "quantity {i}: {error} ulp");
            assert!(
                slope_error <= ULPS,
                "quantity {i} by {j}: {slope_error} ulp"
            );
        }
    }
    println!("largest error {worst:.1} ulp");
}

/// e(y, s) with its corners.
pub(crate) fn entropy_form<F: Formula>() {
    let (law, [x0, x1]) = (F::example(), step::<F>());
    let n = F::MEASURES + F::DASHPOTS;
    let corners = corners(&law, &x0, &x1);
    let old = law.entropy_form_old(&array(&x0));
    let found = law.entropy_form(&old, &array(&x1), &array(&corners));
    let constant: Vec<Dual64> = x0.iter().map(|&value| Dual::from_re(value)).collect();
    compare::<F>(&found, |j| {
        let x1 = seeded(&x1, j);
        if !F::THERMAL {
            return signed::<F>(partitioned(|x| energy(&law, x), &constant, &x1));
        }
        let with_entropy = |x: &[Dual64]| [&x[..n], &[entropy(&law, x)]].concat();
        let of_entropy = |v: &[Dual64]| {
            let theta = moving_temperature(&law, &v[..n], v[n], x0[n]);
            energy(&law, &[&v[..n], &[theta]].concat())
        };
        let (v0, v1) = (with_entropy(&constant), with_entropy(&x1));
        let mut response = signed::<F>(partitioned(of_entropy, &v0, &v1));
        response.push(v1[n] - v0[n]);
        response
    });
}

/// The corner temperatures that the generated form takes.
fn corners<F: Formula>(law: &F, x0: &[f64], x1: &[f64]) -> Vec<f64> {
    if !F::THERMAL {
        return Vec::new();
    }
    let n = x0.len() - 1;
    let chain = |from: &[f64], to: &[f64]| {
        let s = law.caloric(&array(from)).entropy;
        let corner = |k: usize| temperature(law, &[&to[..k], &from[k..n]].concat(), s, from[n]);
        (1..=n).map(corner).collect::<Vec<f64>>()
    };
    [chain(x0, x1), chain(x1, x0)].concat()
}

/// e(y, θ) and S(y, θ); without temperature the same as the entropy form.
pub(crate) fn temperature_form<F: Formula>() {
    let (law, [x0, x1]) = (F::example(), step::<F>());
    let n = F::MEASURES + F::DASHPOTS;
    let old = law.temperature_form_old(&array(&x0));
    let found = law.temperature_form(&old, &array(&x1));
    let constant: Vec<Dual64> = x0.iter().map(|&value| Dual::from_re(value)).collect();
    compare::<F>(&found, |j| {
        let x1 = seeded(&x1, j);
        let energies = partitioned(|x| energy(&law, x), &constant, &x1);
        if !F::THERMAL {
            return signed::<F>(energies);
        }
        let entropies = partitioned(|x| entropy(&law, x), &constant, &x1);
        let theta = energies[n] / entropies[n];
        let pairs = energies.iter().zip(&entropies).take(n);
        let mut response: Vec<_> = pairs.map(|(e, s)| e - theta * s).collect();
        response.push(theta);
        let mut response = signed::<F>(response);
        response.push(entropy(&law, &x1) - entropy(&law, &constant));
        response
    });
}
