//! Moved anchors and thermostats at the times of the stages.
//!
//! The motion of an anchor is taken as the polynomial through its positions at Chebyshev points of the step, whose
//! derivative is the velocity: of a function of time, only values are known. The degree is 10, so that the error is of an
//! order above that of the scheme.

use core::f64::consts::PI;

use crate::algebra::vector;
use crate::step::error::StepFailure;
use crate::step::explicit::bodies::Bodies;
use crate::step::explicit::components::Components;
use crate::step::explicit::tableau::{STAGES, TIMES};
use crate::step::explicit::view::View;
use crate::step::timed::TimedLoad;
use eem_material::number::scalar::{Scalar, is_positive};

/// Number of points of a step at which motions are evaluated, one more than the degree.
const POINTS: usize = 11;

/// The weights that give positions and velocities at the stages from positions at the points, which include both ends.
#[derive(Clone, Debug)]
struct Interpolation {
    /// The times of the points, as fractions of the step.
    points: [f64; POINTS],
    values: [[f64; POINTS]; STAGES],
    slopes: [[f64; POINTS]; STAGES],
}

impl Interpolation {
    fn new() -> Self {
        let index = |m: usize| f64::from(u8::try_from(m).unwrap_or(0));
        let degree = index(POINTS - 1);
        let at: [f64; POINTS] = vector(|m| 0.5 - 0.5 * Scalar::cos(PI * index(m) / degree));
        let mut values = [[0.0; POINTS]; STAGES];
        let mut slopes = values;
        for (stage, &time) in TIMES.iter().enumerate() {
            for m in 0..POINTS {
                // Lagrange's polynomial of a point, and its derivative by the product rule.
                let factor = |k: usize| (time - at[k]) / (at[m] - at[k]);
                let product = |but: usize| {
                    let others = (0..POINTS).filter(|&k| k != m && k != but);
                    others.map(factor).product::<f64>()
                };
                let others = (0..POINTS).filter(|&k| k != m);
                let slope: f64 = others.map(|k| product(k) / (at[m] - at[k])).sum();
                values[stage][m] = product(m);
                slopes[stage][m] = slope;
            }
        }
        Self {
            points: at,
            values,
            slopes,
        }
    }
}

/// An anchor that is moved.
#[derive(Clone, Debug)]
pub(super) struct Moved {
    pub(super) node: usize,
    /// Its places in the stage vector.
    pub(super) places: Vec<usize>,
    /// The index of its motion in the scene.
    motion: usize,
    /// At the stages, a vector each, m and m/s.
    pub(super) positions: Vec<f64>,
    pub(super) velocities: Vec<f64>,
}

/// An element with a thermostat.
#[derive(Clone, Debug)]
pub(super) struct Held {
    pub(super) slot: usize,
    /// The index of its temperature in the scene.
    temperature: usize,
    /// At the stages, K.
    pub(super) temperatures: [f64; STAGES],
}

/// All anchors that are moved in a scene, and all elements with thermostats.
#[derive(Clone, Debug)]
pub(super) struct Prescribed {
    /// `None` if no anchor is moved.
    interpolation: Option<Interpolation>,
    pub(super) moved: Vec<Moved>,
    pub(super) held: Vec<Held>,
    /// The positions of an anchor at the points, m.
    positions: Vec<f64>,
}

impl Prescribed {
    /// For motions of these nodes, and temperatures of these thermal slots.
    pub(super) fn new(
        [nodes, slots]: [&[Option<usize>]; 2],
        components: &Components,
        dimension: usize,
    ) -> Self {
        let (mut moved, mut at_node) = (Vec::new(), Vec::new());
        for (motion, node) in last_of_each(nodes) {
            at_node.resize(at_node.len().max(node + 1), None);
            at_node[node] = Some(moved.len());
            moved.push(Moved {
                node,
                places: Vec::new(),
                motion,
                positions: vec![0.0; STAGES * dimension],
                velocities: vec![0.0; STAGES * dimension],
            });
        }
        for place in components.masses..components.nodes.len() {
            if let Some(&Some(index)) = at_node.get(components.nodes[place]) {
                moved[index].places.push(place);
            }
        }
        let mut held = Vec::new();
        for (temperature, slot) in last_of_each(slots) {
            held.push(Held {
                slot,
                temperature,
                temperatures: [1.0; STAGES],
            });
        }
        Self {
            interpolation: (!moved.is_empty()).then(Interpolation::new),
            moved,
            held,
            positions: vec![0.0; POINTS * dimension],
        }
    }

    /// Evaluates all of them at the stages of a step.
    pub(super) fn evaluate(&mut self, bodies: &dyn Bodies) -> Result<(), StepFailure> {
        if let Some(interpolation) = &self.interpolation {
            for moved in &mut self.moved {
                moved.evaluate(interpolation, bodies, &mut self.positions)?;
            }
        }
        for held in &mut self.held {
            held.evaluate(bodies)?;
        }
        Ok(())
    }
}

/// The indices of loads with what they act on: of several that act on the same the last one counts, as in implicit schemes.
fn last_of_each(targets: &[Option<usize>]) -> Vec<(usize, usize)> {
    let (mut last, mut all) = (Vec::new(), Vec::new());
    for (load, target) in targets.iter().enumerate() {
        if let &Some(target) = target {
            last.resize(last.len().max(target + 1), 0);
            last[target] = load;
            all.push((load, target));
        }
    }
    all.retain(|&(load, target)| last[target] == load);
    all
}

impl Held {
    /// Evaluates its temperature at the stages of a step, from the old temperature.
    fn evaluate(&mut self, bodies: &dyn Bodies) -> Result<(), StepFailure> {
        let (element, course) = &bodies.temperatures()[self.temperature];
        let View { step, state, .. } = *bodies.view();
        let (time, from) = (state.time.value, state.temperatures[self.slot]);
        for (theta, &share) in self.temperatures.iter_mut().zip(&TIMES) {
            let at = time + share * step;
            let value = course.at(at, from, share);
            if !is_positive(value) {
                let load = TimedLoad::Temperature(*element);
                return Err(StepFailure::of_load(load, 0, value, at));
            }
            *theta = value;
        }
        Ok(())
    }
}

impl Moved {
    /// There is memory for its positions at the points.
    fn evaluate(
        &mut self,
        interpolation: &Interpolation,
        bodies: &dyn Bodies,
        positions: &mut [f64],
    ) -> Result<(), StepFailure> {
        let View { step, state, .. } = *bodies.view();
        let time = state.time.value;
        let dimension = positions.len() / POINTS;
        for (found, &share) in positions
            .chunks_exact_mut(dimension)
            .zip(&interpolation.points)
        {
            let at = time + share * step;
            let node = bodies.find_position(self.motion, [at, share * step], found);
            if let Some(axis) = found.iter().position(|value| !value.is_finite()) {
                let load = TimedLoad::Motion(node);
                return Err(StepFailure::of_load(load, axis, found[axis], at));
            }
        }
        for (index, (position, velocity)) in self
            .positions
            .iter_mut()
            .zip(&mut self.velocities)
            .enumerate()
        {
            let (stage, axis) = (index / dimension, index % dimension);
            let start = positions[axis];
            let (mut value, mut slope) = (0.0, 0.0);
            for m in 1..POINTS {
                // Differences do not lose digits to the distance from the origin.
                let from_start = positions[m * dimension + axis] - start;
                value += interpolation.values[stage][m] * from_start;
                slope += interpolation.slopes[stage][m] * from_start;
            }
            *position = match stage {
                0 => start,
                _ if stage == STAGES - 1 => positions[(POINTS - 1) * dimension + axis],
                _ => start + value,
            };
            *velocity = slope / step;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::step::explicit::tableau::{MOTION_SLOPES, WEIGHTED};
    use crate::step::explicit::{load_rule, motion_rule};

    #[test]
    fn the_integral_of_a_motion_is_that_of_the_polynomial_at_the_stages() {
        let interpolation = Interpolation::new();
        let ((times, weights), (points, of_motion)) = (load_rule(), motion_rule());
        for (m, &of_motion) in of_motion.iter().enumerate() {
            assert!((interpolation.points[m] - points[m]).abs() < 1e-15, "{m}");
            let terms = times.iter().zip(weights).map(|(time, weight)| {
                let stage = TIMES.iter().position(|own| own.to_bits() == time.to_bits());
                weight * interpolation.values[stage.unwrap()][m]
            });
            assert!((terms.sum::<f64>() - of_motion).abs() < 1e-14, "{m}");
        }
        for (stage, expected) in WEIGHTED.into_iter().zip(MOTION_SLOPES) {
            let slopes = interpolation.slopes[stage].iter();
            let sum: f64 = slopes.map(|slope| slope.abs()).sum();
            assert!((sum - expected).abs() < 1e-11, "{stage}: {sum}");
        }
    }

    #[test]
    fn polynomials_of_the_degree_are_exact() {
        let interpolation = Interpolation::new();
        let points = interpolation.points;
        for power in 0..=10 {
            for (stage, &time) in TIMES.iter().enumerate() {
                let sum = |row: [f64; POINTS]| -> f64 {
                    let terms = row.iter().zip(points);
                    terms.map(|(w, at)| w * at.powi(power)).sum()
                };
                let slope = if power == 0 {
                    0.0
                } else {
                    f64::from(power) * time.powi(power - 1)
                };
                let value = sum(interpolation.values[stage]) - time.powi(power);
                assert!(value.abs() < 1e-14, "{stage} {power} {value:e}");
                let slope = sum(interpolation.slopes[stage]) - slope;
                assert!(slope.abs() < 1e-12, "{stage} {power} {slope:e}");
            }
        }
    }
}
