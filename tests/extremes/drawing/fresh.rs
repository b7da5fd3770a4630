//! Small scenes for fresh steps: pairs, triples and four masses, free or on an anchor, with springs of any family.

use super::super::families::Family;
use super::super::graph::{Node, Spring};
use super::super::material::{Data, Material, Ranges};
use super::super::random::Random;
use super::super::watched::Watched;
use super::Drawing;

/// How long the steps are, and how violent the motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pace {
    /// A thousandth to ten of the smallest period.
    Any,
    /// Up to what is stable in an explicit scheme, and a little beyond.
    Explicit,
    /// Up to half of that, with speeds that stretch springs by up to a fifth.
    Calm,
}

/// What DOP853 is stable for: ωh of vibrations, κh/c and kh/η.
const STABLE: [f64; 3] = [5.96, 6.39, 6.39];

/// The share of that up to which steps are calm.
const HALF: f64 = 0.5;

/// Places of masses and anchors, and the line on which they are or almost are.
pub(super) struct Places<const D: usize> {
    pub(super) at: Vec<[f64; D]>,
    pub(super) size: f64,
    line: Option<[f64; D]>,
}

fn direction<const D: usize>(random: &mut Random) -> [f64; D] {
    let any: [f64; D] = core::array::from_fn(|_| random.uniform(0.1, 1.0));
    let signed = any.map(|x| if random.chance(0.5) { x } else { -x });
    let length = signed.iter().map(|x| x * x).sum::<f64>().sqrt();
    signed.map(|x| x / length)
}

pub(super) fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    let squares = a.iter().zip(b).map(|(a, b)| (a - b).powi(2));
    squares.sum::<f64>().sqrt()
}

impl<const D: usize> Places<D> {
    /// In general position or in line, exactly or off by up to a millionth, near the origin or up to a million
    /// times its size away.
    pub(super) fn at_random(random: &mut Random, count: usize) -> Self {
        let size = random.decades(1e-2, 1e2);
        let line = (D == 1 || random.chance(0.4)).then(|| {
            let along_axis = core::array::from_fn(|axis| if axis == 0 { 1.0 } else { 0.0 });
            let any = direction(random);
            if D == 1 || random.chance(0.5) {
                along_axis
            } else {
                any
            }
        });
        let offset = [0.0, 1e-12, 1e-6][random.below(3)];
        let mut at: Vec<[f64; D]> = Vec::new();
        for place in 0..count {
            #[expect(clippy::cast_precision_loss, reason = "small numbers")]
            let along = place as f64 + random.uniform(-0.3, 0.3);
            at.push(match line {
                Some(line) => line.map(|x| x * along + offset * random.uniform(-1.0, 1.0)),
                None => loop {
                    let own = core::array::from_fn(|_| random.uniform(0.0, 1.5));
                    if at.iter().all(|other| distance(other, &own) > 0.3) {
                        break own;
                    }
                },
            });
        }
        if random.chance(0.3) {
            let (away, far) = (direction::<D>(random), random.decades(1.0, 1e6));
            for own in &mut at {
                *own = core::array::from_fn(|i| own[i] + far * away[i]);
            }
        }
        let at = at.into_iter().map(|own| own.map(|x| x * size)).collect();
        Self { at, size, line }
    }
}

impl<const D: usize> Drawing<D> {
    /// A scene without loads for a few steps.
    pub(crate) fn fresh(random: &mut Random, families: &[Family<D>], pace: Pace) -> Self {
        let is_calm = pace == Pace::Calm;
        let is_anchored = random.chance(0.4);
        let masses = 2 + random.below(3) - usize::from(is_anchored);
        let places = Places::<D>::at_random(random, masses + usize::from(is_anchored));
        let mass = random.decades(1e-3, 1e3);
        let nodes = (0..).zip(&places.at).map(|(index, &position)| Node {
            mass: (index > 0 || !is_anchored).then(|| mass * random.decades(0.03, 30.0)),
            position,
            velocity: [0.0; D],
        });
        let nodes: Vec<Node<D>> = nodes.collect();
        let mut drawing = Self::of(nodes, Vec::new());
        let is_chain = random.chance(0.3);
        let stiffness = random.decades(1e-2, 1e6);
        // A spring relaxes within 1e-4 to 1e4 of the time of a vibration; the calm ones not before it.
        let eta = (stiffness * mass).sqrt();
        let ranges = Ranges {
            stiffness: [0.1 * stiffness, 10.0 * stiffness],
            eta: if is_calm {
                [eta, 1e4 * eta]
            } else {
                [1e-4 * eta, 1e4 * eta]
            },
            capacity: if is_calm { [1.0, 1e3] } else { [1e-2, 1e3] },
        };
        drawing.add_springs(random, families, &ranges, (is_chain, [0.8, 1.25]));
        let period = drawing.smallest_period();
        drawing.step = period * random.decades(1e-3, 10.0);
        drawing.give_velocities(random, !is_calm);
        if let (Some(line), true) = (places.line, random.chance(0.3)) {
            // Nothing leaves the line.
            for node in &mut drawing.nodes {
                node.velocity = line.map(|x| x * node.velocity[0]);
            }
        }
        drawing.add_heat(random, !is_calm);
        let start = |spring: &Spring<D>| {
            let [a, b] = spring.ends.map(|end| &drawing.nodes[end].position);
            [distance(a, b), spring.theta]
        };
        let starts: Vec<_> = drawing.springs.iter().map(start).collect();
        let share = match pace {
            Pace::Any => None,
            Pace::Explicit => Some(random.decades(1e-3, 1.2)),
            Pace::Calm => Some(random.decades(1e-2, HALF)),
        };
        if let Some(share) = share {
            drawing.step *= share / drawing.stable_share_at(&starts);
        }
        let kind = if is_anchored { "anchored" } else { "free" };
        drawing.label = format!(
            "D = {D}, {masses} {kind} in {:.0e} m{}, {}",
            places.size,
            places.line.map_or("", |_| " in line"),
            drawing.label
        );
        drawing
    }

    /// A chain, or springs between all nodes, with their natural lengths over the present ones.
    pub(super) fn add_springs(
        &mut self,
        random: &mut Random,
        families: &[Family<D>],
        ranges: &Ranges,
        (is_chain, [shortest, longest]): (bool, [f64; 2]),
    ) {
        let nodes = self.nodes.len();
        let theta = random.decades(50.0, 2000.0);
        for b in 1..nodes {
            for a in if is_chain { b - 1..b } else { 0..b } {
                let lambda = distance(&self.nodes[a].position, &self.nodes[b].position);
                let theta = theta * random.uniform(0.8, 1.2);
                let length = lambda * random.uniform(shortest, longest);
                let data = Data::at_random(random, ranges, length, theta);
                let family = &families[random.below(families.len())];
                let law = (family.make)(random, &data, [lambda, theta]);
                self.is_singular |= family.is_singular;
                if !self.label.contains(family.name) {
                    self.label.push_str(family.name);
                    self.label.push(' ');
                }
                self.springs.push(Spring {
                    ends: [a, b],
                    material: Material::new(law, &data, theta),
                    theta,
                    length,
                });
            }
        }
    }

    /// The step as a share of the longest one that is stable in an explicit scheme, now.
    pub(crate) fn stable_share(&self, watched: &Watched<D>) -> f64 {
        let state = watched.stored();
        let mut temperatures = state.temperatures.iter();
        let now = |spring: &Spring<D>| {
            let at = spring.ends.map(|end| state.position::<D>(end));
            let arm = core::array::from_fn(|axis| (at[1][axis] - at[0][axis]).value());
            let theta = spring.material.capacity.and_then(|_| temperatures.next());
            [
                distance(&arm, &[0.0; D]),
                theta.copied().unwrap_or(spring.theta),
            ]
        };
        let now: Vec<_> = self.springs.iter().map(now).collect();
        self.stable_share_at(&now)
    }

    /// The same for (λ, θ) of every spring, by sums of rows as the scheme itself bounds it.
    pub(super) fn stable_share_at(&self, states: &[[f64; 2]]) -> f64 {
        let root = |node: &Node<D>| node.mass.map_or(0.0, |mass| mass.sqrt().recip());
        let roots: Vec<f64> = self.nodes.iter().map(root).collect();
        let mut squares = vec![0.0; roots.len()];
        let mut relaxation = 0.0_f64;
        for (spring, &[lambda, theta]) in self.springs.iter().zip(states) {
            let (force, along) = spring.material.slope(lambda, theta);
            let stiffness = along.max((force / lambda).abs());
            let both: f64 = spring.ends.iter().map(|&end| roots[end]).sum();
            for end in spring.ends {
                squares[end] += stiffness * roots[end] * both;
            }
            relaxation = relaxation.max(spring.material.relaxation(lambda, theta));
        }
        let mut flows = vec![0.0; self.springs.len()];
        let per_root = |spring: usize| {
            let [lambda, theta] = states[spring];
            self.springs[spring]
                .material
                .capacity_at(lambda, theta)
                .sqrt()
                .recip()
        };
        for &([a, b], conductance) in &self.paths {
            let both = per_root(a) + per_root(b);
            flows[a] += conductance * per_root(a) * both;
            flows[b] += conductance * per_root(b) * both;
        }
        for &(spring, _, conductance) in &self.air {
            flows[spring] += conductance * per_root(spring).powi(2);
        }
        let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        let rates = [largest(&squares).sqrt(), largest(&flows), relaxation];
        let shares = rates.iter().zip(STABLE).map(|(rate, stable)| rate / stable);
        self.step * shares.fold(0.0, f64::max)
    }

    /// Whether a step is below half of what is stable and all springs have ordinary lengths.
    pub(crate) fn is_calm(&self, watched: &Watched<D>) -> bool {
        self.stable_share(watched) <= HALF && self.is_within(watched)
    }
}
