//! The rounding of loads that are functions of time.

use core::mem;

use crate::algebra::{length, norm};
use crate::scene::loads::{Loads, Written, inside, written, written_scalar};
use crate::step::control::controller::ROUNDINGS;
use crate::step::control::least::LeastScales;
use eem_material::number::scalar::Scalar;

/// Roundings of the time in the estimate of an error, in ε: half of one at each stage, with weights whose magnitudes add up to 4.2 in
/// the explicit scheme, and to at most 3 in others, whose second half begins at a rounded time; twice that to be safe.
const TIMES: f64 = 4.0;

/// Parts of a step between the times at which functions are evaluated.
const PARTS: u8 = 4;

/// What the rounding of loads explains of the errors of a step.
///
/// A function is known at rounded times only. Its values differ by `ε |t| |ḟ|` from those at the times of the scheme, and impulses
/// by h times that, however short the step:
///
/// ```text
/// 16 ε h max|f| + 4 ε |t| h max|ḟ|
/// ```
///
/// with the period of the mass instead of h if that is shorter.
///
/// A moved anchor is off by `4 ε |t| max|ẋ|`, and the masses that it pulls by the impulse of the stiffness times that.
#[derive(Clone, Debug)]
pub(crate) struct LoadRounding {
    /// Of the impulse on each node, N s.
    impulses: Vec<f64>,
    /// Of the position of each node, m, and of those of the anchors that pull it.
    positions: Vec<f64>,
    pulls: Vec<f64>,
    /// Of the temperature of each thermal slot, K.
    temperatures: Vec<f64>,
    /// The thermal slots of prescribed temperatures, in the order of the loads.
    slots: Vec<Option<usize>>,
}

impl LoadRounding {
    /// Memory for the loads of a scene with so many nodes and thermal slots, given the slots of its prescribed temperatures; none where
    /// there are no loads.
    pub(crate) fn new<const D: usize>(
        loads: &Loads<D>,
        slots: Vec<Option<usize>>,
        [nodes, thermal]: [usize; 2],
    ) -> Self {
        let zeros = |needed: bool, count: usize| vec![0.0; if needed { count } else { 0 }];
        let moves = !loads.motions.is_empty();
        let pushes = moves || !loads.forces.is_empty() || !loads.rockets.is_empty();
        Self {
            impulses: zeros(pushes, nodes),
            positions: zeros(moves, nodes),
            pulls: zeros(moves, nodes),
            temperatures: zeros(!slots.is_empty(), thermal),
            slots,
        }
    }

    /// Whether there are no loads.
    pub(crate) fn is_none(&self) -> bool {
        self.impulses.is_empty() && self.temperatures.is_empty()
    }

    /// Finds it for a step of the size `span[1]` from the time `span[0]`.
    pub(crate) fn find<const D: usize>(
        &mut self,
        loads: &Loads<D>,
        least: &LeastScales,
        span: [f64; 2],
    ) {
        let [start, h] = span;
        let time = TIMES * f64::EPSILON * Scalar::maximum(start.abs(), (start + h).abs());
        let rounding = ROUNDINGS * f64::EPSILON;
        for all in [
            &mut self.impulses,
            &mut self.positions,
            &mut self.pulls,
            &mut self.temperatures,
        ] {
            all.fill(0.0);
        }
        let mut memory = [[0.0; D]; 2];
        let mut of_vector = |of| terms(&loads.stops, span, &written(of), memory.as_flattened_mut());
        let of_scalar = |of| terms(&loads.stops, span, &written_scalar(of), &mut [0.0; 2]);
        let impulses = &mut self.impulses;
        let mut push = |node: usize, [size, rate]: [f64; 2]| {
            let duration = least.at(node).time_of_impulse(h);
            impulses[node] += duration * (rounding * size + time * rate);
        };
        for (node, force) in &loads.forces {
            let terms = match force.function() {
                Some(of) => of_vector(of),
                None => [
                    length(force.position(start, &[0.0; D], 1.0).as_slice()),
                    0.0,
                ],
            };
            push(node.index, terms);
        }
        for rocket in &loads.rockets {
            push(rocket.line.node.index, of_scalar(&rocket.thrust));
        }
        for (anchor, motion) in &loads.motions {
            let Some(of) = motion.function() else {
                continue;
            };
            let [_, speed] = of_vector(of);
            let height = time * speed;
            self.positions[anchor.index] += height;
            for (mass, stiffness) in least.pulled_by(anchor.index) {
                self.impulses[mass] += least.at(mass).time_of_impulse(h) * stiffness * height;
                self.pulls[mass] += height;
            }
        }
        for ((_, course), slot) in loads.temperatures.iter().zip(&self.slots) {
            if let (Some(of), Some(slot)) = (course.function(), *slot) {
                let [_, rate] = of_scalar(of);
                self.temperatures[slot] += time * rate;
            }
        }
    }

    /// Of the impulse on a node, N s.
    pub(crate) fn impulse(&self, node: usize) -> f64 {
        self.impulses.get(node).copied().unwrap_or_default()
    }

    /// Of the position of a node that is moved, m.
    pub(crate) fn position(&self, node: usize) -> f64 {
        self.positions.get(node).copied().unwrap_or_default()
    }

    /// Of the positions of the anchors that pull a mass, m.
    pub(crate) fn pull(&self, node: usize) -> f64 {
        self.pulls.get(node).copied().unwrap_or_default()
    }

    /// Of a prescribed temperature, K.
    pub(crate) fn temperature(&self, slot: usize) -> f64 {
        self.temperatures.get(slot).copied().unwrap_or_default()
    }
}

/// The largest magnitude of a function in a step, and the largest one of its rate of change, 1/s, by differences. Zero unless they
/// are finite. There is memory for two of its values.
fn terms(stops: &[f64], [start, h]: [f64; 2], of: Written<'_>, memory: &mut [f64]) -> [f64; 2] {
    let parts = f64::from(PARTS);
    let (mut value, mut last) = memory.split_at_mut(memory.len() / 2);
    let [mut size, mut rate] = [0.0; 2];
    for part in 0..=PARTS {
        let time = start + f64::from(part) / parts * h;
        of(inside(stops, [start, h], time), value);
        size = Scalar::maximum(size, length(value));
        if part > 0 {
            let change = norm(value.iter().zip(&*last).map(|(value, last)| value - last));
            rate = Scalar::maximum(rate, change * (parts / h));
        }
        mem::swap(&mut value, &mut last);
    }
    let finite = |size: f64| if size.is_finite() { size } else { 0.0 };
    [finite(size), finite(rate)]
}
