//! The least scales of errors, from what a scene holds: no unknown is the reason for tiny steps because it starts at zero.

use crate::element::conduction::Conduction;
use crate::element::group::Elements;
use crate::element::masses::Masses;
use crate::element::state::State;
use crate::step::control::controller::Accuracy;
use crate::step::control::norm::{ROUNDINGS, norm};
use eem_material::number::scalar::{Mask, Real};

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
/// with the sum k of the stiffnesses at the mass. It is local, so that heavy parts at rest do not blind light ones. Errors
/// below `16 ε h Σ |∂²ψ/∂λ²| λ`, the rounding of the impulse, are none.
///
/// While |p|₂ grows beyond all that it has been, the scale is what it becomes in a period `2π/ω` if it goes on to grow like
/// this, at most 8 times as much: the errors of a period add up to the tolerance of what the momentum is at its end.
#[derive(Clone, Debug)]
pub(crate) struct LeastScales<S> {
    /// |q|₂ at the start, m; 1 m if all nodes are at the origin, where the scene has no length.
    size: S,
    /// The fastest of all vibrations, dampers and paths of heat, 1/s.
    rate: S,
    nodes: Box<[AtNode<S>]>,
    /// The largest entries of all nodes.
    most: AtNode<S>,
}

/// What is around a mass.
#[derive(Clone, Copy, Debug)]
struct AtNode<S> {
    /// `2π/ω`, s; infinite where nothing holds the mass.
    period: S,
    /// m ℓ ω, kg m/s.
    bound: S,
    /// m ℓ where nothing holds the mass, else zero, kg m.
    free: S,
    /// The terms of the forces, N.
    force: S,
}

impl<S: Real> LeastScales<S> {
    /// Of elements in a state.
    pub(crate) fn new<'a, const D: usize>(
        groups: impl Iterator<Item = &'a dyn Elements<S, D>>,
        (masses, conduction): (&Masses<S>, &Conduction<S>),
        state: &State<S>,
    ) -> Self {
        let zero = S::zero();
        let size = norm(state.positions.values().iter().copied());
        let size = S::select(zero.less(size), size, S::one());
        // Stiffness, damping, shortest length and terms of forces at each node.
        let mut around = vec![([zero; 3], S::MAX); masses.len()];
        let mut rate = zero;
        for group in groups {
            group.stiffness(state, &mut |point| {
                rate = rate.maximum(point.relaxation);
                if let Some((slot, capacity)) = point.capacity {
                    let links = conduction.links(slot).iter();
                    let flow = links.fold(zero, |sum, link| sum + link.conductance);
                    rate = rate.maximum(flow / capacity);
                }
                for &node in point.nodes {
                    let (sums, length) = &mut around[node as usize];
                    let terms = [point.elastic, point.damping, point.force];
                    for (sum, term) in sums.iter_mut().zip(terms) {
                        *sum += term;
                    }
                    *length = length.minimum(point.length);
                }
            });
        }
        // Anchors have momenta next to solids.
        let nodes = masses.iter().zip(masses.weights()).zip(around);
        let nodes: Box<[_]> = nodes
            .map(|((own, held), ([stiffness, damping, force], length))| {
                let mass = own.unwrap_or(held);
                let is_mass = zero.less(own.unwrap_or(zero));
                let fastest = (stiffness / mass).sqrt().maximum(damping / mass);
                rate = rate.maximum(S::select(is_mass, fastest, zero));
                let length = S::select(length.less(S::MAX), length, size);
                // m ω = √(k m), times ω m/d at most.
                let root = (stiffness * mass).sqrt();
                let is_slow = root.less(damping);
                let bound = S::select(is_slow, root * (root / damping), root);
                let is_free = stiffness.equal(zero);
                let period = S::from_f64(core::f64::consts::TAU) * mass / bound;
                let has_period = zero.less(bound) & zero.less(mass);
                AtNode {
                    period: S::select(has_period, period, S::MAX),
                    bound: length * bound,
                    free: S::select(is_free, mass * length, zero),
                    force,
                }
            })
            .collect();
        let largest = |of: &dyn Fn(&AtNode<S>) -> S| {
            nodes.iter().fold(zero, |most, node| most.maximum(of(node)))
        };
        Self {
            size,
            rate,
            most: AtNode {
                period: zero,
                bound: largest(&|node| node.bound),
                free: largest(&|node| node.free),
                force: largest(&|node| node.force),
            },
            nodes,
        }
    }

    /// The first step that is tried, s: in the time of the fastest motion, `1/ω`, the errors of `r^(−1/p)` steps add up to
    /// the tolerance. 1 s where nothing in the scene has a time of its own.
    pub(crate) fn first_step(&self, relative: S, accuracy: Accuracy) -> S {
        let has_rate = S::zero().less(self.rate) & self.rate.less(S::MAX);
        let time = S::select(has_rate, self.rate.recip(), S::one());
        time * relative.powf(S::from_f64(accuracy.order().recip()))
    }

    /// The least scale of positions, `r |q|₂` of the start: they, too, may all be zero, m.
    pub(crate) fn position(&self, relative: S) -> S {
        relative * self.size
    }

    /// The sizes that are multiplied by r for positions, m, and by r² for momenta, kg m/s.
    pub(crate) fn sizes(&self) -> [S; 2] {
        [self.size, self.most.bound]
    }

    /// The scale of the momentum of a node in a step of this size, given that of all, kg m/s.
    pub(crate) fn momentum(&self, node: usize, all: S, step: Step<S>) -> S {
        self.nodes[node].scale(all, step)
    }

    /// Whether the scale of all momenta is that of every node.
    pub(crate) fn are_below(&self, all: S, step: Step<S>) -> bool {
        self.most.scale(all, step).at_most(all).all()
    }
}

/// A step and its tolerance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step<S> {
    /// h, s.
    pub(crate) size: S,
    /// The relative tolerance r.
    pub(crate) relative: S,
    /// The relative tolerance of this step alone.
    pub(crate) own: S,
    /// The relative rate at which |p|₂ has grown in it beyond all that it has been, 1/s.
    pub(crate) growth: S,
}

impl<S: Real> AtNode<S> {
    /// The scale of the momentum, given that of all: at least that of the smallest vibration, and so large that an error within
    /// the tolerance is no rounding.
    fn scale(&self, all: S, step: Step<S>) -> S {
        let part = step.relative * step.relative;
        let unseen = part * (self.bound + self.free / step.size);
        let rounding = S::from_f64(ROUNDINGS) * S::EPSILON * step.size * self.force;
        let ahead = (S::one() + step.growth * self.period).minimum(S::from_f64(MOST_AHEAD));
        (all.maximum(unseen) * ahead).maximum(rounding / step.own)
    }
}
