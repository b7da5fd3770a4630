//! A scene drawn at random: masses on a random graph of springs of all kinds, with loads and heat.

mod driven;
mod fresh;

pub(crate) use fresh::Pace;

use core::f64::consts::PI;

use super::graph::{self, Node, Spring};
use super::random::Random;
use super::watched::Watched;
use super::world::World;

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Class {
    /// h ≤ ½ of the smallest linearised period, κh/c ≤ 10, lengths 0.2 … 5 of the natural ones.
    Ordinary,
    /// Ratios over many decades, huge steps, masses on top of anchors.
    Wild,
}

/// A temperature as a function of time: a line from the start until it stays.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Course {
    /// K, K/s and s.
    start: f64,
    rate: f64,
    until: f64,
}

/// Lengths of the ordinary class, over the natural ones.
const LENGTHS: [f64; 2] = [0.2, 5.0];

/// Iterations of the power method for the smallest period, and what they may miss of it.
const ITERATIONS: usize = 60;
const MISSED: f64 = 1.1;

/// A scene before it is built.
pub(crate) struct Drawing<const D: usize> {
    nodes: Vec<Node<D>>,
    springs: Vec<Spring<D>>,
    paths: Vec<([usize; 2], f64)>,
    /// The spring, `θ_r` and κ.
    air: Vec<(usize, f64, f64)>,
    gravity: [f64; D],
    /// The mass, the force and its angular frequency.
    forces: Vec<(usize, [f64; D], f64)>,
    /// The anchor, amplitude and angular frequency of its motion.
    shaken: Vec<(usize, [f64; D], f64)>,
    /// Springs at a prescribed temperature.
    kept: Vec<(usize, Course)>,
    /// The spring, the temperature of an oven around it and κ.
    ovens: Vec<(usize, Course, f64)>,
    /// s.
    pub(crate) step: f64,
    /// What it is made of, in words; empty where that does not matter.
    pub(crate) label: String,
    /// Whether a force in it ends in a singularity.
    pub(crate) is_singular: bool,
}

impl Course {
    fn held(start: f64) -> Self {
        Self {
            start,
            rate: 0.0,
            until: 0.0,
        }
    }

    fn is_held(self) -> bool {
        self.rate.abs() <= 0.0
    }

    fn at(self, time: f64) -> f64 {
        self.start + self.rate * time.min(self.until)
    }
}

impl<const D: usize> Drawing<D> {
    pub(crate) fn at_random(random: &mut Random, class: Class, most: usize) -> Self {
        let wild = class == Class::Wild;
        let nodes = graph::nodes::<D>(random, wild, most);
        let springs = graph::springs(random, wild, &nodes);
        let mut drawing = Self::of(nodes, springs);
        let period = drawing.smallest_period();
        let share = if wild {
            random.decades(1e-3, 1e3)
        } else {
            random.uniform(0.02, 0.5)
        };
        drawing.step = share * period;
        drawing.give_velocities(random, wild);
        drawing.add_heat(random, wild);
        drawing.prescribe_a_temperature(random);
        drawing.add_loads(random, wild);
        drawing
    }

    /// Nodes and springs, without anything else.
    fn of(nodes: Vec<Node<D>>, springs: Vec<Spring<D>>) -> Self {
        Self {
            nodes,
            springs,
            paths: Vec::new(),
            air: Vec::new(),
            gravity: [0.0; D],
            forces: Vec::new(),
            shaken: Vec::new(),
            kept: Vec::new(),
            ovens: Vec::new(),
            step: 0.0,
            label: String::new(),
            is_singular: false,
        }
    }

    /// At most the smallest period of the linearised scene, s.
    pub(crate) fn smallest_period(&self) -> f64 {
        2.0 * PI / (self.largest_frequency() * MISSED)
    }

    /// Speeds that stretch the softest spring of a mass by up to a third, if nothing else does.
    fn give_velocities(&mut self, random: &mut Random, wild: bool) {
        for (index, node) in self.nodes.iter_mut().enumerate() {
            let Some(mass) = node.mass else { continue };
            let own = self
                .springs
                .iter()
                .filter(|spring| spring.ends.contains(&index));
            let speed = own.map(|spring| spring.length * (spring.material.stiffness / mass).sqrt());
            let speed = speed.fold(f64::INFINITY, f64::min);
            let share = if wild {
                random.decades(1e-3, 10.0)
            } else {
                0.2
            };
            node.velocity = node
                .velocity
                .map(|_| share * speed * random.uniform(-1.0, 1.0));
        }
    }

    /// Paths of heat with κh/c up to 10, or up to 1e6.
    fn add_heat(&mut self, random: &mut Random, wild: bool) {
        let thermal: Vec<usize> = (0..self.springs.len())
            .filter(|&index| self.springs[index].material.capacity.is_some())
            .collect();
        let strongest = if wild { 1e6 } else { 10.0 };
        for (place, &a) in thermal.iter().enumerate() {
            let capacity = self.springs[a].material.capacity.unwrap_or(1.0);
            let largest = strongest * capacity / self.step;
            if place > 0 && random.chance(0.5) {
                let b = thermal[random.below(place)];
                let other = self.springs[b].material.capacity.unwrap_or(1.0);
                let most = largest * (other / capacity).min(1.0);
                self.paths.push(([a, b], random.decades(1e-6, 1.0) * most));
            }
            if random.chance(0.2) {
                let theta = self.springs[a].theta * random.uniform(0.8, 1.2);
                self.air
                    .push((a, theta, random.decades(1e-6, 1.0) * largest));
            }
        }
    }

    fn prescribe_a_temperature(&mut self, random: &mut Random) {
        let thermal = |spring: &Spring<D>| spring.material.capacity.is_some();
        if random.chance(0.1) {
            let springs = self.springs.iter().enumerate();
            let mut own = springs.filter(|(_, spring)| thermal(spring));
            let kept = own
                .next()
                .map(|(index, spring)| (index, Course::held(spring.theta)));
            self.kept.extend(kept);
        }
    }

    /// Weight and forces that stretch the softest spring by a tenth, a shaken anchor.
    fn add_loads(&mut self, random: &mut Random, wild: bool) {
        let softest = |index: usize, springs: &[Spring<D>]| {
            let own = springs.iter().filter(|spring| spring.ends.contains(&index));
            let force = own.map(|spring| spring.material.stiffness * spring.length);
            force.fold(f64::INFINITY, f64::min)
        };
        let share = if wild {
            random.decades(1e-3, 10.0)
        } else {
            0.1
        };
        let total: f64 = self.nodes.iter().filter_map(|node| node.mass).sum();
        let weakest = (0..self.nodes.len()).map(|index| softest(index, &self.springs));
        let weakest = weakest.fold(f64::INFINITY, f64::min);
        if random.chance(0.3) && self.nodes.iter().any(|node| node.mass.is_none()) {
            self.gravity[D - 1] = -share * weakest / total;
        }
        for index in 0..self.nodes.len() {
            if self.nodes[index].mass.is_none() || !random.chance(0.1) {
                continue;
            }
            let force = core::array::from_fn(|_| random.uniform(-1.0, 1.0) * share * weakest);
            self.forces
                .push((index, force, random.decades(0.01, 0.3) / self.step));
        }
        if let (None, true) = (self.nodes[0].mass, random.chance(0.15)) {
            let way = share * self.springs[0].length;
            let way = core::array::from_fn(|_| way * random.uniform(-0.5, 0.5));
            self.shaken
                .push((0, way, random.decades(0.01, 0.1) / self.step));
        }
    }

    /// The largest angular frequency of the linearised scene, by the power method, rad/s.
    fn largest_frequency(&self) -> f64 {
        let roots: Vec<f64> = self
            .nodes
            .iter()
            .map(|node| node.mass.map_or(0.0, |m| m.sqrt().recip()))
            .collect();
        let mut random = Random::new(0);
        let mut shape: Vec<[f64; D]> = roots
            .iter()
            .map(|_| core::array::from_fn(|_| random.uniform(-1.0, 1.0)))
            .collect();
        let mut square = 0.0;
        for _ in 0..ITERATIONS {
            let size = shape.iter().flatten().map(|x| x * x).sum::<f64>().sqrt();
            let mut next = vec![[0.0; D]; shape.len()];
            for spring in &self.springs {
                let [a, b] = spring.ends;
                let [along, across] = self.stiffness_of(spring);
                let direction = self.direction(spring);
                let gap: [f64; D] = core::array::from_fn(|i| {
                    (shape[b][i] * roots[b] - shape[a][i] * roots[a]) / size
                });
                let dot: f64 = (0..D).map(|i| gap[i] * direction[i]).sum();
                for i in 0..D {
                    let force = across * gap[i] + (along - across) * dot * direction[i];
                    next[a][i] -= force * roots[a];
                    next[b][i] += force * roots[b];
                }
            }
            square = next.iter().flatten().map(|x| x * x).sum::<f64>().sqrt();
            shape = next;
        }
        square.sqrt()
    }

    fn direction(&self, spring: &Spring<D>) -> [f64; D] {
        let [a, b] = spring.ends.map(|end| self.nodes[end].position);
        let arm: [f64; D] = core::array::from_fn(|i| b[i] - a[i]);
        let length = arm.iter().map(|x| x * x).sum::<f64>().sqrt();
        arm.map(|x| x / length)
    }

    /// The stiffness along the spring, and across it.
    fn stiffness_of(&self, spring: &Spring<D>) -> [f64; 2] {
        let [a, b] = spring.ends.map(|end| self.nodes[end].position);
        let length = (0..D).map(|i| (b[i] - a[i]).powi(2)).sum::<f64>().sqrt();
        let (force, along) = spring.material.slope(length, spring.theta);
        [along.abs(), (force / length).abs()]
    }

    /// Whether all springs still have lengths of the ordinary class.
    pub(crate) fn is_within(&self, watched: &Watched<D>) -> bool {
        self.springs.iter().all(|spring| {
            let [a, b] = spring.ends.map(|end| watched.stored().position::<D>(end));
            let square: f64 = (0..D).map(|i| (b[i] - a[i]).value().powi(2)).sum();
            let ratio = square.sqrt() / spring.length;
            (LENGTHS[0]..=LENGTHS[1]).contains(&ratio)
        })
    }

    /// All velocities by a factor, and all masses by another.
    pub(crate) fn scale(&mut self, [velocities, masses]: [f64; 2]) {
        for node in &mut self.nodes {
            node.velocity = node.velocity.map(|speed| velocities * speed);
            node.mass = node.mass.map(|mass| masses * mass);
        }
    }

    /// Velocities and masses of all nodes; none of anchors.
    pub(crate) fn moving(&self) -> impl Iterator<Item = Option<([f64; D], f64)>> + '_ {
        let nodes = self.nodes.iter();
        nodes.map(|node| node.mass.map(|mass| (node.velocity, mass)))
    }

    /// The scene.
    pub(crate) fn world(&self) -> World<D> {
        let mut world = World::new();
        let nodes: Vec<eem::Node> = self
            .nodes
            .iter()
            .map(|node| match node.mass {
                Some(mass) => world.mass(mass, node.position, node.velocity),
                None => world.anchor(node.position),
            })
            .collect();
        let elements: Vec<eem::Element> = self
            .springs
            .iter()
            .map(|spring| {
                let ends = spring.ends.map(|end| nodes[end]);
                spring.material.put(&mut world, ends, spring.theta)
            })
            .collect();
        for &([a, b], conductance) in &self.paths {
            world.conduct([elements[a], elements[b]], conductance);
        }
        for &(spring, theta, conductance) in &self.air {
            let air = world.reservoir(theta);
            world.cool(elements[spring], air, conductance);
        }
        world.set_gravity(self.gravity);
        for &(node, force, frequency) in &self.forces {
            world.force(nodes[node], move |t| {
                force.map(|f| f * (frequency * t).cos())
            });
        }
        for &(node, way, frequency) in &self.shaken {
            let at = self.nodes[node].position;
            let motion = move |t: f64| {
                core::array::from_fn(|i| at[i] + way[i] * (1.0 - (frequency * t).cos()))
            };
            world.move_anchor(nodes[node], motion);
        }
        for &(spring, course) in &self.kept {
            if course.is_held() {
                world.hold_temperature(elements[spring], course.at(0.0));
            } else {
                world.prescribe_temperature(elements[spring], move |t| course.at(t));
            }
        }
        for &(spring, course, conductance) in &self.ovens {
            let oven = world.oven(move |t| course.at(t));
            world.cool(elements[spring], oven, conductance);
        }
        world
    }
}
