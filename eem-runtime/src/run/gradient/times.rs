//! Derivatives by sizes of steps and by the time at the end, also where loads depend on time.

use super::error::GradientError;
use super::input::{Input, InputOf, Timed};
use super::result::Gradient;

impl<const D: usize> Gradient<D> {
    /// The derivatives by the sizes of the steps, with the times at their ends, s. Where a step ends at the jump of a load, the
    /// derivative by the time of the jump is that by the size of the step before it less that by the size of the one after it.
    ///
    /// # Errors
    ///
    /// [`GradientError::NoTimeDerivative`] if the scene has a function of time; [`by_step_size_with`](Self::by_step_size_with) takes its
    /// derivative.
    pub fn by_step_size(&self) -> Result<&[(f64, f64)], GradientError> {
        match self.timed.first() {
            None => Ok(&self.sizes),
            Some(load) => Err(no_derivative(*load)),
        }
    }

    /// The derivatives by the sizes of the steps, where each step keeps its values of functions of time. No term is missing if
    /// these are constant within steps.
    #[must_use]
    pub fn by_step_size_at_kept_loads(&self) -> &[(f64, f64)] {
        &self.sizes
    }

    /// The derivative by the time at the end, which is that by the size of the last step; zero without a step.
    ///
    /// # Errors
    ///
    /// As [`by_step_size`](Self::by_step_size).
    pub fn by_end_time(&self) -> Result<f64, GradientError> {
        let last = self.by_step_size()?.last();
        Ok(last.map_or(0.0, |&(_, by)| by))
    }

    /// The derivatives by the sizes of the steps where loads are functions of time: a longer step moves all later values of a load,
    /// and those in it by their share. Give the derivative of each function by the time in the form of a parameter:
    /// [`Input::force`], [`Input::thrust`], [`Input::motion`], [`Input::thermostat`] or [`Input::oven`]. The last entry is the
    /// derivative by the time at the end.
    ///
    /// # Errors
    ///
    /// [`GradientError::NoTimeDerivative`] if that of a function is missing; [`GradientError::NotFinite`] if it is not finite.
    ///
    /// ```
    /// use eem::prelude::*;
    /// use eem::{History, Input, Objective};
    ///
    /// let mut scene = Scene::<1>::new();
    /// let stone = scene.mass(2.0, [0.0], [0.0]);
    /// scene.force(stone, |t| [3.0 * t]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.25)?;
    /// run.keep_history(History::default());
    /// run.run_until(1.0)?;
    ///
    /// // m v = ½ 3 T², and so v' = 3 T/m
    /// let gradient = run.gradient(&Objective::at_end(Quantity::Velocity(stone)))?;
    /// let sizes = gradient.by_step_size_with(&[Input::force(stone, |_| [3.0])])?;
    /// assert_eq!(sizes.len(), 4);
    /// assert!(sizes.iter().all(|(_, by)| (by - 1.5).abs() < 1e-14));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn by_step_size_with(&self, rates: &[Input<D>]) -> Result<Vec<(f64, f64)>, GradientError> {
        let mut moved = Vec::new();
        for &load in &self.timed {
            let is_own = |own: Timed| own.key() == load.key();
            let rate = rates.iter().find(|rate| rate.load().is_some_and(is_own));
            match rate.map(|rate| &rate.of) {
                Some(InputOf::Vector(own, of)) => {
                    moved.extend(self.vectors_by(*own)?.products(&**of));
                }
                Some(InputOf::Number(own, of)) => {
                    moved.extend(self.numbers_by(*own)?.products(&**of));
                }
                _ => return Err(no_derivative(load)),
            }
        }
        moved.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        let mut found = self.sizes.clone();
        let mut later = 0.0;
        for at in (0..found.len()).rev() {
            let start = match at.checked_sub(1) {
                Some(before) => found[before].0,
                None => self.started,
            };
            let (end, by) = &mut found[at];
            while let Some((_, value)) = moved.pop_if(|(time, _)| *end <= *time) {
                later += value;
            }
            *by += later;
            let within = moved.iter().rev().take_while(|(time, _)| start < *time);
            for &(time, value) in within {
                *by += value * ((time - start) / (*end - start));
            }
        }
        match found.iter().find(|(_, by)| !by.is_finite()) {
            Some((end, _)) => Err(GradientError::NotFinite { time: *end }),
            None => Ok(found),
        }
    }
}

#[cold]
fn no_derivative(load: Timed) -> GradientError {
    let load = match load {
        Timed::Thrust(node, _) => format!("the thrust on {node}"),
        other => format!("the {}", other.name()),
    };
    GradientError::NoTimeDerivative { load }
}
