//! Moved anchors and thermostats at the times of the stages.
//!
//! The motion of an anchor is taken as the polynomial through its positions at Chebyshev points of the step, whose
//! derivative is the velocity: of a function of time, only values are known. The degree is 10, so that the error is of an
//! order above that of the scheme.

use core::f64::consts::PI;
use std::collections::BTreeMap;

use crate::algebra::vector;
use crate::element::group::points;
use crate::element::handle::{Element, Node};
use crate::element::layout::Layout;
use crate::element::state::State;
use crate::scene::loads::{Loads, TemperatureCourse};
use crate::step::error::StepFailure;
use crate::step::explicit::components::Components;
use crate::step::explicit::tableau::{STAGES, TIMES};
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

/// The elements with thermostats.
pub(super) fn held(courses: &[(Element, TemperatureCourse)], layout: &Layout) -> Vec<Held> {
    let slots = courses.iter();
    let all = last_of_each(slots.map(|(of, _)| layout.elements[of.index()].thermal));
    let all = all.map(|(temperature, slot)| Held {
        element: courses[temperature].0,
        slot,
        temperature,
        temperatures: [1.0; STAGES],
    });
    all.collect()
}

/// All anchors that are moved in a scene.
#[derive(Clone, Debug)]
pub(super) struct Prescribed<const D: usize> {
    /// `None` if no anchor is moved.
    interpolation: Option<Interpolation>,
    pub(super) moved: Vec<Moved<D>>,
}

impl<const D: usize> Prescribed<D> {
    pub(super) fn new(loads: &Loads<D>, components: &Components) -> Self {
        let mut places: BTreeMap<_, Vec<_>> = BTreeMap::new();
        let anchors = components.masses..components.nodes.len();
        for place in anchors.filter(|_| !loads.motions.is_empty()) {
            places
                .entry(components.nodes[place])
                .or_default()
                .push(place);
        }
        let motions = loads.motions.iter();
        let moved = last_of_each(motions.map(|(node, _)| Some(node.index)));
        let moved = moved.map(|(motion, node)| Moved {
            node: loads.motions[motion].0,
            places: places.remove(&node).unwrap_or_default(),
            motion,
            positions: [[0.0; D]; STAGES],
            velocities: [[0.0; D]; STAGES],
        });
        let moved: Vec<_> = moved.collect();
        Self {
            interpolation: (!moved.is_empty()).then(Interpolation::new),
            moved,
        }
    }

    /// Evaluates all motions at the stages of a step of size `step` that begins at `time`.
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
        Ok(())
    }
}

/// The indices of loads with what they act on: of several that act on the same the last one counts, as in implicit schemes.
fn last_of_each(
    targets: impl Iterator<Item = Option<usize>> + Clone,
) -> impl Iterator<Item = (usize, usize)> {
    let of = targets
        .enumerate()
        .filter_map(|(load, target)| Some((load, target?)));
    let mut last = BTreeMap::new();
    for (load, target) in of.clone() {
        last.insert(target, load);
    }
    of.filter(move |(load, target)| last.get(target) == Some(load))
}

impl Held {
    /// Evaluates its temperature at the stages of a step of size `step` that begins at `time`, from the old temperature.
    pub(super) fn evaluate(
        &mut self,
        courses: &[(Element, TemperatureCourse)],
        [time, step]: [f64; 2],
        from: f64,
    ) -> Result<(), StepFailure> {
        let (_, course) = &courses[self.temperature];
        for (theta, &share) in self.temperatures.iter_mut().zip(&TIMES) {
            let at = time + share * step;
            let value = course.at(at, from, share);
            if !is_positive(value) {
                let load = TimedLoad::Temperature(self.element);
                return Err(StepFailure::of_load(load, 0, value, at));
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
                    let load = TimedLoad::Motion(self.node);
                    return Err(StepFailure::of_load(load, axis, found[axis], at));
                }
            }
        }
        let (start, end) = (positions[0], positions[POINTS - 1]);
        for stage in 0..STAGES {
            for axis in 0..D {
                // Differences do not lose digits to the distance from the origin.
                let from_start = |m: usize| positions[m][axis] - start[axis];
                let sum = |row: &[f64; POINTS]| {
                    (1..POINTS).fold(0.0, |sum, m| sum + row[m] * from_start(m))
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
