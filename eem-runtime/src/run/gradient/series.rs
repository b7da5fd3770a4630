//! Derivatives by the values of a function of time.

use core::ops::Deref;

use nalgebra::SVector;

use eem_material::number::scalar::Real;

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
pub struct Series<T, S = f64>(pub(crate) Vec<(S, T)>);

impl<T, S> Deref for Series<T, S> {
    type Target = [(S, T)];

    fn deref(&self) -> &[(S, T)] {
        &self.0
    }
}

impl<R: Real> Series<R, R> {
    /// The derivative by a parameter α of a function f(t), given `∂f/∂α`: `Σ dJ/df(t) ∂f/∂α(t)`.
    pub fn contract(&self, by: impl Fn(R) -> R) -> R {
        sum(self.products(by))
    }

    /// The terms of this sum, with their times.
    pub(crate) fn products(&self, by: impl Fn(R) -> R) -> impl Iterator<Item = (R, R)> {
        let terms = self.iter();
        terms.map(move |&(time, derivative)| (time, derivative * by(time)))
    }
}

impl<S: Real, const D: usize> Series<SVector<S, D>, S> {
    /// The derivative by a parameter α of a function f(t), given `∂f/∂α`: `Σ dJ/df(t)·∂f/∂α(t)`.
    pub fn contract<V: Into<SVector<S, D>>>(&self, by: impl Fn(S) -> V) -> S {
        sum(self.products(move |time| by(time).into()))
    }

    /// The terms of this sum, with their times.
    pub(crate) fn products(&self, by: impl Fn(S) -> SVector<S, D>) -> impl Iterator<Item = (S, S)> {
        self.iter().map(move |(time, derivative)| {
            let by = by(*time);
            let products = derivative.iter().zip(by.iter());
            let product = products.fold(S::zero(), |sum, (&a, &b)| sum + a * b);
            (*time, product)
        })
    }
}

fn sum<S: Real>(terms: impl Iterator<Item = (S, S)>) -> S {
    terms.fold(S::zero(), |sum, (_, term)| sum + term)
}
