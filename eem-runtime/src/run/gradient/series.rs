//! Derivatives by the values of a function of time.

use core::ops::Deref;

use nalgebra::SVector;

/// The derivatives of an objective by the values of a function of time in the steps of a run: pairs of time, s, and derivative, as a
/// slice.
///
/// ```
/// use eem::prelude::*;
/// use eem::{History, Objective};
///
/// let mut scene = Scene::<1>::new();
/// let stone = scene.mass(2.0, [0.0], [0.0]);
/// let amplitude = 3.0;
/// scene.force(stone, move |t| [amplitude * t.sin()]);
/// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.001)?;
/// run.keep_history(History::default());
/// run.run_until(1.0)?;
///
/// // m v = a (1 − cos t)
/// let speed = Objective::at_end(Quantity::Velocity(stone));
/// let gradient = run.gradient(&speed)?;
/// let by_amplitude = gradient.by_force(stone)?.contract(|t| [t.sin()]);
/// assert!((by_amplitude - (1.0 - 1.0_f64.cos()) / 2.0).abs() < 1e-7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Series<T>(pub(crate) Vec<(f64, T)>);

impl<T> Deref for Series<T> {
    type Target = [(f64, T)];

    fn deref(&self) -> &[(f64, T)] {
        &self.0
    }
}

impl Series<f64> {
    /// The derivative by a parameter α of a function f(t), given `∂f/∂α`: `Σ dJ/df(t) ∂f/∂α(t)`.
    pub fn contract(&self, by: impl Fn(f64) -> f64) -> f64 {
        sum(self.products(by))
    }

    /// The terms of this sum, with their times.
    pub(crate) fn products(&self, by: impl Fn(f64) -> f64) -> impl Iterator<Item = (f64, f64)> {
        let terms = self.iter();
        terms.map(move |&(time, derivative)| (time, derivative * by(time)))
    }
}

impl<const D: usize> Series<SVector<f64, D>> {
    /// The derivative by a parameter α of a function f(t), given `∂f/∂α`: `Σ dJ/df(t)·∂f/∂α(t)`.
    pub fn contract<V: Into<SVector<f64, D>>>(&self, by: impl Fn(f64) -> V) -> f64 {
        sum(self.products(move |time| by(time).into()))
    }

    /// The terms of this sum, with their times.
    pub(crate) fn products(
        &self,
        by: impl Fn(f64) -> SVector<f64, D>,
    ) -> impl Iterator<Item = (f64, f64)> {
        let terms = self.iter();
        terms.map(move |(time, derivative)| (*time, dot(derivative, &by(*time))))
    }
}

/// The product of two vectors.
pub(crate) fn dot<const D: usize>(one: &SVector<f64, D>, other: &SVector<f64, D>) -> f64 {
    let pairs = one.iter().zip(other);
    pairs.fold(0.0, |sum, (&a, &b)| sum + a * b)
}

fn sum(terms: impl Iterator<Item = (f64, f64)>) -> f64 {
    terms.fold(0.0, |sum, (_, term)| sum + term)
}
