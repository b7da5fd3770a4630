//! Small scenes that are driven or held: anchors in motion, elements between anchors, thermostats and ovens, constant or
//! functions of time, dashpots from a millionth to a million of their time of relaxation in a step, often from rest.

use super::super::families::Family;
use super::super::graph::{Node, Spring};
use super::super::material::Ranges;
use super::super::random::Random;
use super::fresh::{Places, distance};
use super::{Course, Drawing, Pace};

/// The relaxation of dashpots over the step.
const RELAXATION: [f64; 2] = [1e-6, 1e6];

/// The share of what is stable in an explicit scheme.
const EXPLICIT: [f64; 2] = [1e-3, 20.0];

impl<const D: usize> Drawing<D> {
    /// One to three anchors and up to two masses.
    pub(crate) fn driven(random: &mut Random, families: &[Family<D>], pace: Pace) -> Self {
        let masses = random.below(3);
        let anchors = (1 + random.below(3)).max(2 - masses.min(1));
        let places = Places::<D>::at_random(random, anchors + masses);
        let mass = random.decades(1e-3, 1e3);
        let nodes = (0..).zip(&places.at).map(|(index, &position)| Node {
            mass: (index >= anchors).then(|| mass * random.decades(0.03, 30.0)),
            position,
            velocity: [0.0; D],
        });
        let nodes: Vec<Node<D>> = nodes.collect();
        let mut drawing = Self::of(nodes, Vec::new());
        let stiffness = random.decades(1e-3, 1e9);
        drawing.step = (mass / stiffness).sqrt() * random.decades(1e-3, 1e2);
        let eta = RELAXATION.map(|share| share * stiffness * drawing.step);
        let ranges = Ranges {
            stiffness: [stiffness, 10.0 * stiffness],
            eta,
            capacity: [1e-2, 1e3],
        };
        // Some springs begin without force.
        let slack = if random.chance(0.3) {
            0.0
        } else {
            random.decades(1e-6, 0.2)
        };
        let lengths = [1.0 - slack, 1.0 + slack];
        let is_chain = random.chance(0.5);
        drawing.add_springs(random, families, &ranges, (is_chain, lengths));
        let start = |spring: &Spring<D>| {
            let [a, b] = spring.ends.map(|end| &drawing.nodes[end].position);
            [distance(a, b), spring.theta]
        };
        let starts: Vec<_> = drawing.springs.iter().map(start).collect();
        let share = drawing.stable_share_at(&starts);
        if pace == Pace::Explicit && share > 0.0 {
            drawing.step *= random.decades(EXPLICIT[0], EXPLICIT[1]) / share;
        }
        if masses > 0 && random.chance(0.6) {
            drawing.give_velocities(random, true);
        }
        drawing.hold_temperatures(random);
        drawing.add_heat(random, pace != Pace::Explicit);
        if masses > 0 {
            drawing.add_loads(random, true);
        }
        drawing.move_anchors(random, anchors, places.size);
        let held = drawing.kept.len();
        let moved = drawing.shaken.len();
        drawing.label = format!(
            "D = {D}, {anchors} anchors, {moved} moved, {masses} masses, {held} held, {} ovens, h = {:.1e}, {}",
            drawing.ovens.len(),
            drawing.step,
            drawing.label
        );
        drawing
    }

    /// Thermostats and ovens, most of them at one temperature.
    fn hold_temperatures(&mut self, random: &mut Random) {
        let is_one = random.chance(0.8);
        let chance = [0.0, 0.3, 1.0][random.below(3)];
        let moves = random.chance(0.4);
        let course = |random: &mut Random, start: f64, step: f64| {
            if moves {
                let until = step * random.uniform(0.5, 6.0);
                let rate = start * random.uniform(-0.2, 0.2) / until;
                Course { start, rate, until }
            } else {
                Course::held(start)
            }
        };
        let first = self.springs.first().map_or(300.0, |spring| spring.theta);
        let common = course(random, first, self.step);
        for index in 0..self.springs.len() {
            let Some(capacity) = self.springs[index].material.capacity else {
                continue;
            };
            if !random.chance(chance) {
                continue;
            }
            let own = if is_one {
                common
            } else {
                course(random, self.springs[index].theta, self.step)
            };
            if random.chance(0.2) {
                let most = 1e3 * capacity / self.step;
                let conductance = most * random.decades(1e-6, 1.0);
                self.ovens.push((index, own, conductance));
            } else {
                self.springs[index].theta = own.start;
                self.kept.push((index, own));
            }
        }
    }

    /// Anchors that swing, or travel.
    fn move_anchors(&mut self, random: &mut Random, anchors: usize, size: f64) {
        self.shaken.clear();
        for anchor in 0..anchors {
            if !random.chance(0.4) {
                continue;
            }
            // Far and slowly, or near and within a step.
            let way = size * random.decades(1e-6, 0.1);
            let way = core::array::from_fn(|_| way * random.uniform(-1.0, 1.0));
            let frequency = random.decades(1e-3, 1.0) / self.step;
            self.shaken.push((anchor, way, frequency));
        }
    }
}
