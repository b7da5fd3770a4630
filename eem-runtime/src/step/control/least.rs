//! The least scales of errors, from what a scene holds: no unknown is the reason for tiny steps because it starts at zero.

use core::f64::consts::TAU;

use crate::algebra::{length, norm};
use crate::element::conduction::{Conduction, Partner};

use crate::element::group::Stiffness;
use crate::element::masses::Masses;
use crate::element::state::State;
use crate::step::control::controller::{Accuracy, ROUNDINGS};
use eem_material::number::scalar::Scalar;

/// A momentum that grows counts for at most this multiple of itself.
const MOST_AHEAD: f64 = 8.0;

/// The least scales of the errors of momenta, and the first step.
///
/// A momentum that is zero is no scale for its own error. A vibration whose amplitude is `r² ℓ`, with the relative tolerance r
/// and the shortest length ℓ at a mass m, is far below what the tolerance of positions sees, and needs no accuracy of its
/// own. Its momentum is the scale of smaller ones:
///
/// ```text
/// m r² ℓ ω,     ω = √(k/m), or k/d if a damper d in parallel makes the mass creep back;     m r² ℓ/h where k = 0
/// ```
///
/// with the sum k of the stiffnesses at the mass. It is local, so that heavy parts at rest do not blind light ones.
///
/// Errors below the rounding of the impulse are none. Forces follow from lengths, which are differences of rounded positions:
///
/// ```text
/// 16 ε min(h, 2π/ω) (Σ |∂²ψ/∂λ²| λ + k |q| + m |g|)
/// ```
///
/// It is proportional to the step, as what the tolerance allows may be, so that no step would be short enough for it.
///
/// While |p|₂ grows beyond all that it has been, the scale is what it becomes in a period `2π/ω` if it goes on to grow like
/// this, at most 8 times as much: the errors of a period add up to the tolerance of what the momentum is at its end.
#[derive(Clone, Debug)]
pub(crate) struct LeastScales {
    /// |q|₂ at the start, m; 1 m if all nodes are at the origin, where the scene has no length.
    size: f64,
    /// The fastest of all vibrations, dampers and paths of heat, 1/s.
    rate: f64,
    nodes: Box<[AtNode]>,
    /// The largest entries of all nodes.
    most: AtNode,
    /// The sum of the stiffnesses between each moved anchor and a mass, N/m, in ascending order of both.
    links: Vec<Link>,
    /// The ends of springs with dashpots in series.
    viscous: Box<[[u32; 2]]>,
    /// The largest κ/c of the elements at each reservoir, 1/s.
    exchanges: Box<[f64]>,
}

/// A moved anchor and a mass that it pulls, with a stiffness between them, N/m.
type Link = ([u32; 2], f64);

/// What is around a node.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct AtNode {
    /// `2π/ω`, s; infinite where nothing holds the mass.
    period: f64,
    /// m ℓ ω, kg m/s.
    bound: f64,
    /// m ℓ where nothing holds the mass, else zero, kg m.
    free: f64,
    /// The terms of the forces, N.
    force: f64,
    /// The sum of the stiffnesses, N/m.
    stiffness: f64,
    /// Zero for an anchor, kg.
    mass: f64,
}

/// Calls a function with each point of all elements in a state.
type EachPoint<'a> = &'a dyn Fn(&State, &mut dyn FnMut(Stiffness<'_>));

impl LeastScales {
    /// Of elements in a state with this acceleration of free fall, m/s², and these anchors, in ascending order, that are moved by
    /// functions of time.
    pub(crate) fn new(
        elements: EachPoint<'_>,
        (masses, conduction): (&Masses, &Conduction),
        (state, gravity, moved): (&State, f64, &[usize]),
    ) -> Self {
        let mut found = Around::new(state, (masses, conduction), moved);
        elements(state, &mut |point| found.see(&point));
        found.scales(gravity)
    }

    /// The first step that is tried, s: in the time of the fastest motion, `1/ω`, the errors of `r^(−1/p)` steps add up to
    /// the tolerance. 1 s where nothing in the scene has a time of its own.
    pub(crate) fn first_step(&self, relative: f64, accuracy: Accuracy) -> f64 {
        let has_rate = self.rate > 0.0 && self.rate < f64::MAX;
        let time = if has_rate { self.rate.recip() } else { 1.0 };
        time * Scalar::powf(relative, accuracy.order().recip())
    }

    /// The error of a step of this size, in units of the tolerance, if all but the part `beyond` is explained by rounding. Steps up to
    /// the [first one](Self::first_step) grow on it. Longer ones keep their size: what rounding hides of their error is not known. It is
    /// no more than the motion, so that they grow where that [is rounding](Self::rests), too.
    pub(crate) fn hidden(
        &self,
        beyond: f64,
        size: f64,
        (relative, accuracy): (f64, Accuracy),
    ) -> f64 {
        if size < self.first_step(relative, accuracy) {
            return beyond;
        }
        Scalar::maximum(beyond, accuracy.settled())
    }

    /// Whether no mass moves between two states by more than the rounding of the forces on it, given the dimension of space.
    pub(crate) fn all_rest<'a>(&self, dimension: usize, [old, new]: [&'a State; 2]) -> bool {
        let positions = [old.positions.values(), new.positions.values()];
        let momenta = [old.momenta.values(), new.momenta.values()];
        (0..self.nodes.len()).all(|node| {
            let first = node * dimension;
            let of_node = |all: &'a [f64]| &all[first..first + dimension];
            let [old, new] = [of_node(positions[0]), of_node(positions[1])];
            self.is_at_rest(node, [old, new], [of_node(momenta[0]), of_node(momenta[1])])
        })
    }

    /// Whether a mass moves by no more than the rounding of the forces on it moves it in a period `2π/ω`, given its positions and momenta
    /// at two times: a momentum by the rounding of their impulse, a distance by that over m ω.
    pub(crate) fn is_at_rest(
        &self,
        node: usize,
        [old, new]: [&[f64]; 2],
        [before, after]: [&[f64]; 2],
    ) -> bool {
        let own @ AtNode { period, mass, .. } = self.nodes[node];
        let distance = Scalar::maximum(length(old), length(new));
        let rounding = own.rounding(period, distance);
        let way = norm(new.iter().zip(old).map(|(new, old)| new - old));
        let momentum = Scalar::maximum(length(before), length(after));
        let is_held = period < f64::MAX;
        mass <= 0.0 || (is_held && Scalar::maximum(momentum, mass * way * TAU / period) <= rounding)
    }

    /// The least scale of positions, `r |q|₂` of the start: they, too, may all be zero, m.
    pub(crate) fn position(&self, relative: f64) -> f64 {
        relative * self.size
    }

    /// The sizes that are multiplied by r for positions, m, and by r² for momenta, kg m/s.
    pub(crate) fn sizes(&self) -> [f64; 2] {
        [self.size, self.most.bound]
    }

    /// What is around a node.
    pub(crate) fn at(&self, node: usize) -> &AtNode {
        &self.nodes[node]
    }

    /// What is at least as large as around every node, for its scale and rounding.
    pub(crate) fn most(&self) -> &AtNode {
        &self.most
    }

    /// |λ|₂ of all springs with dashpots in series, m, given the dimension of space: the size of their viscous stretches, wherever the
    /// springs are.
    pub(crate) fn stretches(&self, dimension: usize, positions: &[f64]) -> f64 {
        norm((0..self.viscous.len() * dimension).map(|component| {
            let ([a, b], axis) = (self.viscous[component / dimension], component % dimension);
            let [a, b] = [a as usize * dimension, b as usize * dimension];
            positions[b + axis] - positions[a + axis]
        }))
    }

    /// The largest κ/c of the elements at a reservoir, 1/s.
    pub(crate) fn exchange(&self, reservoir: usize) -> f64 {
        self.exchanges[reservoir]
    }

    /// The masses that a moved anchor pulls, with the stiffness between them, N/m.
    pub(crate) fn pulled_by(&self, anchor: usize) -> impl Iterator<Item = (usize, f64)> {
        let first = (self.links).partition_point(|&([own, _], _)| (own as usize) < anchor);
        let own = self.links[first..].iter();
        let own = own.take_while(move |&&([own, _], _)| own as usize == anchor);
        own.map(|&([_, mass], stiffness)| (mass as usize, stiffness))
    }
}

/// What the elements of a scene tell about its nodes, and what else is in its [`LeastScales`].
struct Around<'a> {
    masses: &'a Masses,
    conduction: &'a Conduction,
    moved: &'a [usize],
    size: f64,
    rate: f64,
    nodes: Vec<AtNode>,
    /// The sum of the dampers, N s/m, and the shortest length, m, at each node.
    held: Vec<[f64; 2]>,
    /// One for each point of an element.
    links: Vec<Link>,
    viscous: Vec<[u32; 2]>,
    exchanges: Box<[f64]>,
}

impl<'a> Around<'a> {
    fn new(
        state: &State,
        (masses, conduction): (&'a Masses, &'a Conduction),
        moved: &'a [usize],
    ) -> Self {
        let size = length(state.positions.values());
        Self {
            masses,
            conduction,
            moved,
            size: if size > 0.0 { size } else { 1.0 },
            rate: 0.0,
            nodes: vec![AtNode::default(); masses.len()],
            held: vec![[0.0, f64::MAX]; masses.len()],
            links: Vec::new(),
            viscous: Vec::new(),
            exchanges: vec![0.0; conduction.reservoirs.len()].into(),
        }
    }

    /// Adds a point of an element.
    fn see(&mut self, point: &Stiffness<'_>) {
        self.rate = Scalar::maximum(self.rate, point.relaxation);
        if point.has_viscous_stretch {
            self.viscous.push([point.nodes[0], point.nodes[1]]);
        }
        if let Some((slot, capacity)) = point.capacity {
            let mut flow = 0.0;
            for link in self.conduction.links(slot) {
                flow += link.conductance;
                if let Partner::Reservoir(index) = link.partner {
                    let exchange = &mut self.exchanges[index];
                    *exchange = Scalar::maximum(*exchange, link.conductance / capacity);
                }
            }
            self.rate = Scalar::maximum(self.rate, flow / capacity);
        }
        for &node in point.nodes {
            let at = &mut self.nodes[node as usize];
            at.stiffness += point.elastic;
            at.force += point.force;
            let [damping, length] = &mut self.held[node as usize];
            *damping += point.damping;
            *length = Scalar::minimum(*length, point.length);
        }
        for &anchor in point.nodes {
            if self.moved.binary_search(&(anchor as usize)).is_err() {
                continue;
            }
            for &node in point.nodes {
                if self.masses.get(node as usize).is_some() {
                    self.links.push(([anchor, node], point.elastic));
                }
            }
        }
    }

    /// The scales, given the acceleration of free fall, m/s².
    fn scales(mut self, gravity: f64) -> LeastScales {
        let mut most = AtNode {
            period: f64::MAX,
            ..AtNode::default()
        };
        // Anchors have momenta next to solids.
        let weights = self.masses.weights();
        for (node, at) in self.nodes.iter_mut().enumerate() {
            let (own, [damping, length]) = (self.masses.get(node), self.held[node]);
            let mass = own.unwrap_or(weights[node]);
            at.mass = own.unwrap_or(0.0);
            if at.mass > 0.0 {
                let fastest = Scalar::maximum((at.stiffness / mass).sqrt(), damping / mass);
                self.rate = Scalar::maximum(self.rate, fastest);
            }
            let length = if length < f64::MAX { length } else { self.size };
            // m ω = √(k m), times ω m/d at most.
            let root = (at.stiffness * mass).sqrt();
            let is_slow = root < damping;
            let bound = if is_slow {
                root * (root / damping)
            } else {
                root
            };
            let has_period = bound > 0.0 && mass > 0.0;
            at.period = if has_period {
                TAU * mass / bound
            } else {
                f64::MAX
            };
            at.bound = length * bound;
            at.free = if at.stiffness == 0.0 {
                mass * length
            } else {
                0.0
            };
            at.force += at.mass * gravity;
            most.bound = Scalar::maximum(most.bound, at.bound);
            most.free = Scalar::maximum(most.free, at.free);
            most.force = Scalar::maximum(most.force, at.force);
            most.stiffness = Scalar::maximum(most.stiffness, at.stiffness);
        }
        LeastScales {
            size: self.size,
            rate: self.rate,
            links: added_up(self.links),
            viscous: self.viscous.into(),
            exchanges: self.exchanges,
            most,
            nodes: self.nodes.into(),
        }
    }
}

/// The links in ascending order, with one for each pair: the sum in the order of the elements.
fn added_up(mut links: Vec<Link>) -> Vec<Link> {
    links.sort_by_key(|&(pair, _)| pair);
    links.dedup_by(|next, kept| {
        let is_same = next.0 == kept.0;
        if is_same {
            kept.1 += next.1;
        }
        is_same
    });
    links
}

/// A step and its tolerance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    /// h, s.
    pub(crate) size: f64,
    /// The relative tolerance r.
    pub(crate) relative: f64,
    /// The relative rate at which |p|₂ has grown in it beyond all that it has been, 1/s.
    pub(crate) growth: f64,
}

impl AtNode {
    /// The scale of the momentum in a step, given that of all, kg m/s: at least that of the smallest vibration.
    pub(crate) fn scale(&self, all: f64, step: Step) -> f64 {
        let part = step.relative * step.relative;
        let unseen = part * (self.bound + self.free / step.size);
        let ahead = Scalar::minimum(1.0 + step.growth * self.period, MOST_AHEAD);
        Scalar::maximum(all, unseen) * ahead
    }

    /// The time in which an error of the force changes the momentum in a step of the size h, s: beyond a period the springs
    /// balance it.
    pub(crate) fn time_of_impulse(&self, h: f64) -> f64 {
        Scalar::minimum(h, self.period)
    }

    /// The rounding of the impulse of a step of the size h at this distance from the origin, N s.
    pub(crate) fn rounding(&self, h: f64, distance: f64) -> f64 {
        let time = self.time_of_impulse(h);
        ROUNDINGS * f64::EPSILON * time * (self.force + self.stiffness * distance)
    }

    /// How far an impulse of 1 N s moves a mass in a step of the size h, m: `h/m`, or `1/kh` where a spring holds it back.
    pub(crate) fn mobility(&self, h: f64) -> f64 {
        let is_mass = self.mass > 0.0;
        if is_mass {
            h / (self.mass + self.stiffness * h * h)
        } else {
            0.0
        }
    }
}
