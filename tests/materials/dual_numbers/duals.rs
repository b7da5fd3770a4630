//! Derivatives of a formula by dual numbers, each with the size of its terms.

use eem::Array;
use num_dual::{Dual, HyperDual};

use crate::dual_numbers::formulas::{Formula, Number};

/// A sum and the sum of the magnitudes of its terms, which is what its rounding errors scale with.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sum {
    pub(crate) value: f64,
    pub(crate) size: f64,
}

impl Sum {
    /// A number of one term.
    pub(crate) fn of(value: f64) -> Self {
        Self {
            value,
            size: value.abs(),
        }
    }

    pub(crate) fn all(terms: impl IntoIterator<Item = f64>) -> Self {
        let add = |sum: Self, term: f64| Self {
            value: sum.value + term,
            size: sum.size + term.abs(),
        };
        terms.into_iter().fold(Self::default(), add)
    }

    pub(crate) fn scaled(self, factor: f64) -> Self {
        Self {
            value: self.value * factor,
            size: self.size * factor.abs(),
        }
    }

    /// Asserts that `found` is this number to `ulps` ulp of the size; returns its error in them.
    pub(crate) fn assert(self, found: f64, ulps: f64, what: &str) -> f64 {
        let Self { value, size } = self;
        let error = (found - value).abs();
        assert!(
            error <= ulps * f64::EPSILON * size,
            "{what}: {found:e} instead of {value:e}, {} ulp of {size:e}",
            error / (f64::EPSILON * size)
        );
        if size > 0.0 {
            error / (f64::EPSILON * size)
        } else {
            0.0
        }
    }
}

/// The array with these elements.
pub(crate) fn array<A: Array<f64>>(elements: &[f64]) -> A {
    let mut array = A::filled(0.0);
    array.as_mut().copy_from_slice(elements);
    array
}

/// ψ, `∂ψ/∂x_j`, `∂²ψ/∂x_j∂x_k`.
pub(crate) fn second<F: Formula>(law: &F, x: &[f64], j: usize, k: usize) -> [Sum; 3] {
    let seed = |(i, &value): (usize, &f64)| {
        let unit = |index: usize| f64::from(u8::from(i == index));
        HyperDual::new(value, unit(j), unit(k), 0.0)
    };
    let point: Vec<_> = x.iter().enumerate().map(seed).collect();
    let terms = law.terms(&point);
    [
        Sum::all(terms.iter().map(|term| term.re)),
        Sum::all(terms.iter().map(|term| term.eps1)),
        Sum::all(terms.iter().map(|term| term.eps1eps2)),
    ]
}

/// `∂/∂θ` of the terms of ψ.
fn thermal_slopes<F: Formula, D: Number>(law: &F, x: &[D]) -> Vec<Dual<D>> {
    let mut point: Vec<_> = x.iter().map(|&value| Dual::from_re(value)).collect();
    let theta = point.last_mut().unwrap();
    *theta = theta.derivative();
    law.terms(&point)
}

/// `S = −∂ψ/∂θ`.
pub(crate) fn entropy<F: Formula, D: Number>(law: &F, x: &[D]) -> D {
    -thermal_slopes(law, x)
        .iter()
        .map(|term| term.eps)
        .sum::<D>()
}

/// `e = ψ − θ ∂ψ/∂θ`, or ψ without temperature.
pub(crate) fn energy<F: Formula, D: Number>(law: &F, x: &[D]) -> D {
    if !F::THERMAL {
        return law.terms(x).into_iter().sum();
    }
    let theta = *x.last().unwrap();
    let terms = thermal_slopes(law, x);
    terms.iter().map(|term| term.re - theta * term.eps).sum()
}

/// Σ(|terms of ψ| + |θ ∂/∂θ of them|): the size of e, and of θ S.
pub(crate) fn energy_size<F: Formula>(law: &F, x: &[f64]) -> f64 {
    if !F::THERMAL {
        return Sum::all(law.terms(x)).size;
    }
    let theta = x.last().unwrap();
    let terms = thermal_slopes(law, x);
    let sizes = terms
        .iter()
        .map(|term| term.re.abs() + (theta * term.eps).abs());
    sizes.sum()
}
