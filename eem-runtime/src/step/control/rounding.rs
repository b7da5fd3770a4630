//! The rounding of loads that are functions of time.

use core::mem;

use crate::algebra::{length, norm};
use crate::scene::loads::{Course, OfTime, SceneLoads, Written, inside, written_scalar};
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
    nodes: Vec<NodeRounding>,
    /// Of the temperature of each thermal slot, K.
    temperatures: Vec<f64>,
    /// The thermal slots of prescribed temperatures, in the order of the loads.
    slots: Vec<Option<usize>>,
    /// Memory for two values of a load.
    values: Vec<f64>,
}

/// What it explains at a node.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NodeRounding {
    /// Of the impulse, N s.
    pub(crate) impulse: f64,
    /// Of the position if the node is moved, m, and of those of the anchors that pull it.
    pub(crate) position: f64,
    pub(crate) pull: f64,
}

impl LoadRounding {
    /// Memory for the loads of a scene with so many nodes and thermal slots, given the slots of its prescribed temperatures; none where
    /// there are no loads.
    pub(crate) fn new(
        loads: &SceneLoads,
        slots: Vec<Option<usize>>,
        [nodes, thermal]: [usize; 2],
    ) -> Self {
        let moves = !loads.motions.is_empty();
        let pushes = moves || !loads.forces.is_empty() || !loads.rockets.is_empty();
        let (nodes, thermal) = (
            if pushes { nodes } else { 0 },
            if slots.is_empty() { 0 } else { thermal },
        );
        Self {
            nodes: vec![NodeRounding::default(); nodes],
            temperatures: vec![0.0; thermal],
            slots,
            values: vec![0.0; 2 * loads.dimension()],
        }
    }

    /// Whether there are no loads.
    pub(crate) fn is_none(&self) -> bool {
        self.nodes.is_empty() && self.temperatures.is_empty()
    }

    /// Finds it for a step of the size `span[1]` from the time `span[0]`.
    pub(crate) fn find(&mut self, loads: &SceneLoads, least: &LeastScales, span: [f64; 2]) {
        let [start, h] = span;
        let time = TIMES * f64::EPSILON * Scalar::maximum(start.abs(), (start + h).abs());
        let rounding = ROUNDINGS * f64::EPSILON;
        self.nodes.fill(NodeRounding::default());
        self.temperatures.fill(0.0);
        let values = &mut self.values;
        let mut of_vector = |of: &OfTime| terms(&loads.stops, span, &**of, values);
        let of_scalar = |of| terms(&loads.stops, span, &written_scalar(of), &mut [0.0; 2]);
        let nodes = &mut self.nodes;
        let mut push = |node: usize, [size, rate]: [f64; 2]| {
            let duration = least.at(node).time_of_impulse(h);
            nodes[node].impulse += duration * (rounding * size + time * rate);
        };
        for (node, force) in &loads.forces {
            let terms = match force {
                Course::Function(of) => of_vector(of),
                Course::Constant(force) | Course::Set(force) => [length(force), 0.0],
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
            self.nodes[anchor.index].position += height;
            for (mass, stiffness) in least.pulled_by(anchor.index) {
                let impulse = least.at(mass).time_of_impulse(h) * stiffness * height;
                self.nodes[mass].impulse += impulse;
                self.nodes[mass].pull += height;
            }
        }
        for ((_, course), slot) in loads.temperatures.iter().zip(&self.slots) {
            if let (Some(of), Some(slot)) = (course.function(), *slot) {
                let [_, rate] = of_scalar(of);
                self.temperatures[slot] += time * rate;
            }
        }
    }

    /// At a node.
    pub(crate) fn at(&self, node: usize) -> NodeRounding {
        self.nodes.get(node).copied().unwrap_or_default()
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
