//! Moved anchors and thermostats at the times of the stages.
//!
//! The motion of an anchor is taken as the polynomial through its positions at Chebyshev points of the step, whose
//! derivative is the velocity: of a function of time, only values are known. The degree is 10, so that the error is of an
//! order above that of the scheme.

use core::f64::consts::PI;

use crate::algebra::vector;
use crate::element::group::points;
use crate::element::handle::{Element, Node};
use crate::element::layout::Layout;
use crate::element::state::State;
use crate::scene::loads::{Loads, TemperatureCourse};
use crate::step::error::StepFailure;
use crate::step::explicit::components::Components;
use crate::step::explicit::tableau::{STAGES, TIMES};
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
pub(super) struct Moved<const D: usize> {
    pub(super) node: Node,
    /// Its places in the stage vector.
    pub(super) places: Vec<usize>,
    /// The index of its motion in the scene.
    motion: usize,
    /// At the stages, m and m/s.
    pub(super) positions: [[f64; D]; STAGES],
    pub(super) velocities: [[f64; D]; STAGES],
}

/// An element with a thermostat.
#[derive(Clone, Debug)]
pub(super) struct Held {
    element: Element,
    pub(super) slot: usize,
    /// The index of its temperature in the scene.
    temperature: usize,
    /// At the stages, K.
    pub(super) temperatures: [f64; STAGES],
}

/// All that is prescribed in a scene.
#[derive(Clone, Debug)]
pub(super) struct Prescribed<const D: usize> {
    /// `None` if no anchor is moved.
    interpolation: Option<Interpolation>,
    pub(super) moved: Vec<Moved<D>>,
    pub(super) held: Vec<Held>,
}

impl<const D: usize> Prescribed<D> {
    pub(super) fn new(loads: &Loads<D>, layout: &Layout, components: &Components) -> Self {
        // Of several motions of one anchor the last one counts, as in the implicit schemes.
        let mut moved: Vec<Moved<D>> = Vec::new();
        for (motion, (node, _)) in loads.motions.iter().enumerate() {
            let mut later = loads.motions[motion + 1..].iter();
            if later.all(|(later, _)| later != node) {
                moved.push(Moved {
                    node: *node,
                    places: components.anchors_of(node.index),
                    motion,
                    positions: [[0.0; D]; STAGES],
                    velocities: [[0.0; D]; STAGES],
                });
            }
        }
        let has_moved = !moved.is_empty();
        Self {
            interpolation: has_moved.then(Interpolation::new),
            moved,
            held: held(&loads.temperatures, layout),
        }
    }

    /// Evaluates all motions and temperatures at the stages of a step of size `step` that begins at `time`.
    pub(super) fn evaluate(
        &mut self,
        loads: &Loads<D>,
        [time, step]: [f64; 2],
        old: &State,
    ) -> Result<(), StepFailure> {
        if let Some(interpolation) = &self.interpolation {
            for moved in &mut self.moved {
                let from = points::<D>(old.positions.values())[moved.node.index];
                moved.evaluate(interpolation, loads, ([time, step], &from))?;
            }
        }
        for held in &mut self.held {
            let (_, course) = &loads.temperatures[held.temperature];
            held.evaluate(course, [time, step], old.temperatures[held.slot])?;
        }
        Ok(())
    }
}

/// The thermostats of a scene. Of several at one element the last one counts.
fn held(temperatures: &[(Element, TemperatureCourse)], layout: &Layout) -> Vec<Held> {
    let mut held = Vec::new();
    let slot_of = |element: Element| layout.elements[element.index()].thermal;
    for (temperature, (element, _)) in temperatures.iter().enumerate() {
        let Some(slot) = slot_of(*element) else {
            continue;
        };
        let mut later = temperatures[temperature + 1..].iter();
        if later.all(|(later, _)| slot_of(*later) != Some(slot)) {
            held.push(Held {
                element: *element,
                slot,
                temperature,
                temperatures: [1.0; STAGES],
            });
        }
    }
    held
}

impl Held {
    fn evaluate(
        &mut self,
        course: &TemperatureCourse,
        [time, step]: [f64; 2],
        from: f64,
    ) -> Result<(), StepFailure> {
        for (theta, &share) in self.temperatures.iter_mut().zip(&TIMES) {
            let at = time + share * step;
            let value = course.at(at, from, share);
            if !is_positive(value) {
                return Err(StepFailure::PrescribedTemperature {
                    element: self.element,
                    value,
                    time: at,
                });
            }
            *theta = value;
        }
        Ok(())
    }
}

impl<const D: usize> Moved<D> {
    fn evaluate(
        &mut self,
        interpolation: &Interpolation,
        loads: &Loads<D>,
        ([time, step], from): ([f64; 2], &[f64; D]),
    ) -> Result<(), StepFailure> {
        let mut positions = [[0.0; D]; POINTS];
        for (position, &share) in positions.iter_mut().zip(&interpolation.points) {
            let at = time + share * step;
            let found = loads.motions[self.motion]
                .1
                .position(at, from, share * step);
            for axis in 0..D {
                position[axis] = found[axis];
                if !found[axis].is_finite() {
                    return Err(StepFailure::Motion {
                        node: self.node,
                        axis,
                        value: found[axis],
                        time: at,
                    });
                }
            }
        }
        let (start, end) = (positions[0], positions[POINTS - 1]);
        for stage in 0..STAGES {
            for axis in 0..D {
                // Differences do not lose digits to the distance from the origin.
                let from_start = |m: usize| positions[m][axis] - start[axis];
                let sum = |row: &[f64; POINTS]| {
                    let mut sum = 0.0;
                    for (m, weight) in row.iter().enumerate().skip(1) {
                        sum += weight * from_start(m);
                    }
                    sum
                };
                self.positions[stage][axis] = start[axis] + sum(&interpolation.values[stage]);
                self.velocities[stage][axis] = sum(&interpolation.slopes[stage]) / step;
            }
        }
        self.positions[0] = start;
        self.positions[STAGES - 1] = end;
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
