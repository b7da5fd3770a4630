//! A check of a gradient: by the tangents of the same steps, in a direction in which all inputs change.

use std::sync::Arc;

use super::derivatives::Passage;
use super::directions::{Change, Forward};
use super::seeds::Seeds;
use crate::element::state::State;
use crate::run::gradient::error::GradientError;
use crate::run::gradient::input::{Objective, Timed};
use crate::run::gradient::result::Gradient;
use crate::run::gradient::series::Series;
use crate::run::simulation::Simulation;
use crate::scene::error::SceneError;
use nalgebra::SVector;

/// A generator of random numbers, the same in every check, and the change of the objective if inputs change by them.
struct Draw {
    seed: u64,
    change: f64,
    /// The sum of the magnitudes of the terms of `change`.
    magnitude: f64,
}

impl Draw {
    /// A random change of an input, between −1 and 1 times its size; its effect, with the derivative `by`, is added to `change`.
    fn of(&mut self, by: f64, size: f64) -> f64 {
        // Steele, Lea & Flood (2014), splitmix64.
        self.seed = self.seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = self.seed;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        let half = u32::try_from((bits ^ (bits >> 31)) >> 32).unwrap_or(0);
        let unit = f64::from(half) / f64::from(u32::MAX);
        let change = (2.0 * unit - 1.0) * size;
        let term = by * change;
        self.change += term;
        self.magnitude += term.abs();
        change
    }

    /// Changes of as many numbers.
    fn all(&mut self, by: &[f64], size: f64) -> Vec<f64> {
        by.iter().map(|&by| self.of(by, size)).collect()
    }

    /// Changes of the values of a function of time, which are `none` at other times.
    fn course<T: Copy + Send + Sync + 'static>(
        &mut self,
        by: &Series<T>,
        none: T,
        of: impl Fn(&mut Self, T) -> T,
    ) -> Arc<dyn Fn(f64) -> T + Send + Sync> {
        let values = by.iter().map(|&(time, by)| (time, of(self, by)));
        let values: Vec<(f64, T)> = values.collect();
        Arc::new(move |time| {
            let found = values.binary_search_by(|(own, _)| own.total_cmp(&time));
            found.map_or(none, |place| values[place].1)
        })
    }
}

/// The largest magnitude, or one if all are zero.
fn size_of(values: impl IntoIterator<Item = f64>) -> f64 {
    let largest = values.into_iter().map(f64::abs);
    let largest = largest.fold(0.0, f64::max);
    if largest > 0.0 { largest } else { 1.0 }
}

/// # Gradients
impl<const D: usize> Simulation<D> {
    /// Checks a gradient of an objective by the tangents of the same steps, from the first to the last. All inputs but the sizes of steps
    /// change at once; the objective has to change by what the gradient says.
    ///
    /// # Errors
    ///
    /// As [`gradient`](Self::gradient); [`GradientError::Disagrees`] if the two changes differ by more than `√ε`, 1.5·10⁻⁸, of the sum
    /// of the magnitudes of the terms.
    ///
    /// ```
    /// use eem::prelude::*;
    /// use eem::{GradientError, History, Objective};
    ///
    /// let mut scene = Scene::<1>::new();
    /// let stone = scene.mass(2.0, [0.0], [3.0]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.01)?;
    /// run.keep_history(History::default());
    /// run.run_until(1.0)?;
    ///
    /// let height = Objective::at_end(Quantity::Position(stone));
    /// let gradient = run.gradient(&height)?;
    /// run.check_gradient(&gradient, &height)?;
    /// let other = run.check_gradient(&gradient, &height.times(2.0));
    /// assert!(matches!(other, Err(GradientError::Disagrees { .. })));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn check_gradient(
        &mut self,
        gradient: &Gradient<D>,
        objective: &Objective<D>,
    ) -> Result<(), GradientError> {
        let [adjoint, tangent, magnitude] = self.changes_along(gradient, objective)?;
        if (adjoint - tangent).abs() <= f64::EPSILON.sqrt() * magnitude {
            return Ok(());
        }
        Err(GradientError::Disagrees { adjoint, tangent })
    }

    /// The change of the objective according to the gradient and that along the run, and the sum of the magnitudes of the terms
    /// of the former.
    #[doc(hidden)]
    pub fn changes_along(
        &mut self,
        gradient: &Gradient<D>,
        objective: &Objective<D>,
    ) -> Result<[f64; 3], GradientError> {
        self.on_history(|run, kept| {
            let passage = run.passage();
            let (change, draw) = run.any_change(gradient, &passage)?;
            let objectives = [(1.0, objective)];
            let mut seeds = Seeds::new(kept, &objectives)?;
            for asked in &mut seeds.terms {
                asked.moments.reverse();
            }
            let mut tangent = [0.0];
            let see =
                &mut (|run: &mut Self, (steps, state): (usize, &mut State), way: &Forward<D>| {
                    for asked in &mut seeds.terms {
                        if let Some(weighed) = run.weigh((steps, &mut *state), kept, asked)? {
                            let weighted = (&*state, weighed.weight);
                            run.add_rates(weighted, asked.of(), way, &mut tangent)?;
                        }
                    }
                    Ok(())
                });
            run.go_forward(kept, (passage, vec![change]), see)?;
            Ok([draw.change, tangent[0], draw.magnitude])
        })
    }

    /// Random changes of all inputs, by parts of their sizes, and the change of the objective according to its gradient.
    fn any_change(
        &self,
        gradient: &Gradient<D>,
        passage: &Passage<D>,
    ) -> Result<(Change<D>, Draw), GradientError> {
        if gradient.elements.len() != self.run.places.len()
            || gradient.masses.len() != self.run.masses.len()
        {
            let handle = "the gradient".to_owned();
            return Err(SceneError::ForeignHandle { handle }.into());
        }
        let mut draw = Draw {
            seed: 1,
            change: 0.0,
            magnitude: 0.0,
        };
        let mut change = self.no_change(passage);
        let state = &self.run.state;
        let length = size_of(state.positions.values().iter().copied());
        let speed = size_of(self.velocities_in(state));
        let theta = size_of(state.temperatures.iter().copied());
        let entropy = size_of(state.reservoir_entropies.values().iter().copied());
        let (start, by) = (&mut change.start, &gradient.start);
        start.positions = draw.all(&by.positions, length);
        start.velocities = draw.all(&by.velocities, speed);
        start.viscous = draw.all(&by.viscous, length);
        start.temperatures = draw.all(&by.temperatures, theta);
        start.reservoirs = draw.all(&by.reservoirs, entropy);
        self.drop_velocities(&mut change);
        let mass = size_of(self.run.masses.iter().flatten());
        change.masses = draw.all(&gradient.masses, mass);
        let pairs: Vec<f64> = gradient.pairs.iter().map(|&(_, by)| by).collect();
        change.pairs = draw.all(&pairs, mass);
        let gravity = size_of(self.run.loads.gravity.iter().copied());
        change.gravity = gradient.gravity.map(|by| draw.of(by, gravity));
        change.heat.conductances = draw.all(&gradient.conductances, 1.0);
        change.heat.reservoirs = draw.all(&gradient.reservoirs, theta);
        for (own, (_, group, place)) in gradient.elements.iter().zip(self.all_elements()) {
            let mut values = Vec::new();
            if group.has_parameter_derivatives() {
                let all = own.values.iter().enumerate();
                values.extend(all.map(|(index, &by)| {
                    let size = size_of([group.parameter(place, index)]);
                    draw.of(by, size)
                }));
            }
            change.parameters.push(values);
        }
        let size_of_load = |load: Timed| match load {
            Timed::Force(_) | Timed::Thrust(..) => 1.0,
            Timed::Motion(_) => length,
            Timed::Thermostat(_) | Timed::Oven(_) => theta,
        };
        for (load, by) in &gradient.vectors {
            let (size, still) = (size_of_load(*load), SVector::from_element(0.0));
            let values = draw.course(by, still, |draw, by| by.map(|by| draw.of(by, size)));
            change.vectors.push((*load, values));
        }
        for (load, by) in &gradient.numbers {
            let size = size_of_load(*load);
            let values = draw.course(by, 0.0, |draw, by| draw.of(by, size));
            change.numbers.push((*load, values));
        }
        Ok((change, draw))
    }
}
