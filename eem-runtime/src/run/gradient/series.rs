//! Derivatives along a run: by the values of functions of time, and of quantities at all times.

use core::ops::Deref;

use crate::run::recorder::Column;
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
/// scene.force(stone, |t: f64| [3.0 * t.sin()]);
/// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.001)?;
/// run.keep_history(History::default());
/// run.run_until(1.0)?;
///
/// // m v = a (1 − cos t)
/// let gradient = run.gradient(&Objective::at_end(Quantity::Velocity(stone)))?;
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

/// The derivatives of quantities by inputs at every state of a history, see
/// [`Simulation::sensitivities`](crate::Simulation::sensitivities).
///
/// The columns are those of a [`Recorder`](crate::Recorder): the time, s, then for each quantity (each component of a vector) one per
/// input. Rows are states, from the first one on.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivities {
    pub(crate) columns: Vec<Column>,
    pub(crate) inputs: usize,
}

impl Sensitivities {
    /// The times, s.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        self.columns[0].values()
    }

    /// All columns, the time first.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The values of the column with this name, `z by stiffness of element 0 (Spring)`.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        Column::find(&self.columns, name)
    }

    /// The derivatives of a component by an input, both counted from 0: components in the order of the quantities that were asked for,
    /// all of one before those of the next. `None` without such a component or input.
    #[must_use]
    pub fn of(&self, component: usize, input: usize) -> Option<&[f64]> {
        let own = input < self.inputs;
        let place = component.checked_mul(self.inputs)?.checked_add(input + 1)?;
        self.columns.get(place).filter(|_| own).map(Column::values)
    }
}
