//! Linear momentum, and angular momentum in every plane.

use eem::Law;

use super::super::digits::Digits;
use super::super::element::Ends;
use super::super::rounding::{ROUNDINGS, worse};
use super::super::stored::Stored;
use super::super::world::Facts;

/// A law of momentum.
pub(super) struct Momentum {
    pub(super) law: Law,
    pub(super) defect: f64,
    pub(super) bound: f64,
    /// `Σ |p|` or `Σ |q − o| |p|`, of both ends.
    pub(super) terms: f64,
}

/// The laws of momentum that the scene has.
pub(super) fn momenta<const D: usize>(
    facts: &Facts<D>,
    states: [&Stored; 2],
    elements: &[Ends<'_>],
    step: f64,
) -> Vec<Momentum> {
    let anchors: Vec<usize> = (0..facts.masses.len())
        .filter(|&node| facts.masses[node].is_none())
        .collect();
    if anchors.len() > 1 || !facts.motions.is_empty() || !facts.has_known_impulses() {
        return Vec::new();
    }
    let impulses = impulses(facts, states[0].time, step);
    let forces: f64 = elements.iter().map(|ends| ends.force(step)).sum();
    let moments: f64 = elements
        .iter()
        .map(|ends| ends.force(step) * ends.length())
        .sum();
    let origin = anchors
        .first()
        .map_or([Digits::ZERO; D], |&node| states[0].position(node));
    let sums = Sums::of(facts, states, &impulses, origin);
    let law = |law, parts: &[Digits], terms: f64, impulses: f64| Momentum {
        law,
        defect: largest(parts),
        bound: ROUNDINGS * f64::EPSILON * (terms + impulses),
        terms,
    };
    let linear = anchors.is_empty().then(|| {
        let impulses = sums.impulses + step * forces;
        law(Law::LinearMomentum, &sums.linear, sums.momenta, impulses)
    });
    let impulses = sums.turns + step * moments;
    let planes = sums.angular.as_flattened();
    let angular = law(Law::AngularMomentum, planes, sums.spins, impulses);
    linear.into_iter().chain([angular]).collect()
}

/// Sums over all masses.
struct Sums<const D: usize> {
    /// ΔL − Σ h F, and ΔJ − Σ h (q − o) ∧ F in the planes i < j.
    linear: [Digits; D],
    angular: [[Digits; D]; D],
    /// Of both ends, |p| and |q| |p|; q from the point of the law or from the origin, whichever is farther.
    momenta: f64,
    spins: f64,
    /// |h F| and |q − o| |h F|.
    impulses: f64,
    turns: f64,
}

impl<const D: usize> Sums<D> {
    fn of(
        facts: &Facts<D>,
        states: [&Stored; 2],
        impulses: &[[f64; D]],
        origin: [Digits; D],
    ) -> Self {
        let mut sums = Self {
            linear: [Digits::ZERO; D],
            angular: [[Digits::ZERO; D]; D],
            momenta: 0.0,
            spins: 0.0,
            impulses: 0.0,
            turns: 0.0,
        };
        let masses = impulses.iter().enumerate();
        for (node, impulse) in masses.filter(|&(node, _)| facts.masses[node].is_some()) {
            let [p0, p1] = states.map(|state| state.momentum::<D>(node));
            let [r0, r1] = states.map(|state| {
                let q = state.position::<D>(node);
                core::array::from_fn(|axis| q[axis] - origin[axis])
            });
            let impulse: [Digits; D] = impulse.map(Digits::from);
            let middle: [Digits; D] = core::array::from_fn(|axis| (r0[axis] + r1[axis]) * 0.5);
            for i in 0..D {
                sums.linear[i] = sums.linear[i] + p1[i] - p0[i] - impulse[i];
                for (j, plane) in sums.angular[i].iter_mut().enumerate().skip(i + 1) {
                    let change = wedge(&r1, &p1, [i, j]) - wedge(&r0, &p0, [i, j]);
                    *plane = *plane + change - wedge(&middle, &impulse, [i, j]);
                }
            }
            let size = |v: &[Digits; D]| Digits::norm(v).value();
            let (own, given) = (size(&p0) + size(&p1), size(&impulse));
            let [q0, q1] = states.map(|state| size(&state.position::<D>(node)));
            // The explicit scheme keeps positions to ε of their coordinates.
            let arm = size(&r0).max(size(&r1)).max(q0).max(q1);
            sums.momenta += own;
            sums.spins += own * arm;
            sums.impulses += given;
            sums.turns += given * arm;
        }
        sums
    }
}

/// `ΔL − Σ h F` along an axis, and `Σ |p| + |h F|` of both ends.
pub(super) struct Impulse {
    pub(super) change: Digits,
    pub(super) terms: f64,
}

/// The impulse of the supports along each axis.
pub(super) fn linear<const D: usize>(
    facts: &Facts<D>,
    states: [&Stored; 2],
    impulses: &[[f64; D]],
) -> [Impulse; D] {
    core::array::from_fn(|axis| {
        let (mut change, mut terms) = (Digits::ZERO, 0.0);
        let masses = impulses.iter().enumerate();
        for (node, impulse) in masses.filter(|&(node, _)| facts.masses[node].is_some()) {
            let [p0, p1] = states.map(|state| state.momentum::<D>(node)[axis]);
            change = change + p1 - p0 - Digits::from(impulse[axis]);
            terms += p0.value().abs() + p1.value().abs() + impulse[axis].abs();
        }
        Impulse { change, terms }
    })
}

/// `h F` of every node: loads in the middle of the step, and weight.
pub(super) fn impulses<const D: usize>(facts: &Facts<D>, time: f64, step: f64) -> Vec<[f64; D]> {
    let weight = |mass: &Option<f64>| {
        let mass = mass.unwrap_or(0.0);
        facts.gravity.map(|component| step * mass * component)
    };
    let mut impulses: Vec<[f64; D]> = facts.masses.iter().map(weight).collect();
    for (node, force) in &facts.forces {
        let force = force(time + 0.5 * step);
        for axis in 0..D {
            impulses[*node][axis] += step * force[axis];
        }
    }
    impulses
}

/// The component of `r ∧ p` in the plane of two axes.
fn wedge<const D: usize>(r: &[Digits; D], p: &[Digits; D], [i, j]: [usize; 2]) -> Digits {
    r[i] * p[j] - r[j] * p[i]
}

fn largest(parts: &[Digits]) -> f64 {
    parts.iter().map(|x| x.value().abs()).fold(0.0, worse)
}
