//! The kinematic quantities of one element at a trial state.

use crate::free_energy::Array;
use crate::kinematics::{Arms, Blocks, Ends, Gradient, Kinematics, Measures};
use crate::scalar::Real;
use crate::scheme::Placement;

/// Measures and gradients of an element as its scheme looks at them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose<K: Kinematics<S, D>, S: Real, const D: usize> {
    /// Where the gradients are taken; where the scheme looks at the middle, the mean takes the
    /// place of the new arms.
    ends: Ends<K, S, D>,
    /// The measures that the scheme looks at.
    pub(super) measures: Measures<K, S, D>,
    /// The gradient along which the forces act.
    pub(super) direction: Gradient<K, S, D>,
    /// The derivative of `measures` by the new arms.
    pub(super) sensitivity: Gradient<K, S, D>,
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> Pose<K, S, D> {
    /// Between the old arms, whose measures are given, and the new ones.
    #[inline]
    pub(super) fn new(
        kinematics: K,
        at: Placement,
        [r0, r1]: [&Arms<K, S, D>; 2],
        measures0: Measures<K, S, D>,
    ) -> Self {
        let r1 = match at {
            Placement::Middle => mean::<K, S, D>(r0, r1),
            Placement::Ends | Placement::End | Placement::Start => *r1,
        };
        let measures1 = kinematics.measure(&r1);
        let gradient = kinematics.gradient(&r1, &measures1);
        let ends = Ends {
            r0: *r0,
            r1,
            measures0,
            measures1,
        };
        let mut measures = measures1;
        let (direction, sensitivity) = match at {
            Placement::Ends => (kinematics.discrete_gradient(&ends), gradient),
            Placement::End => (gradient, gradient),
            Placement::Middle => (gradient, halved::<K, S, D>(gradient)),
            Placement::Start => {
                for (measure, &old) in measures.as_mut().iter_mut().zip(measures0.as_ref()) {
                    *measure = S::from_f64(0.5) * (old + *measure);
                }
                let old = kinematics.gradient(r0, &measures0);
                (old, halved::<K, S, D>(gradient))
            }
        };
        Self {
            ends,
            measures,
            direction,
            sensitivity,
        }
    }

    /// `Σ_a f_a ∂(direction_a)/∂r¹`.
    #[inline]
    pub(super) fn curvature(
        &self,
        kinematics: K,
        at: Placement,
        force: &Measures<K, S, D>,
    ) -> Blocks<K, S, D> {
        let Ends { r1, measures1, .. } = &self.ends;
        match at {
            Placement::Ends => kinematics.discrete_curvature(&self.ends, force),
            Placement::End => kinematics.curvature(r1, measures1, force),
            Placement::Middle => {
                let mut half = *force;
                for force in half.as_mut() {
                    *force *= S::from_f64(0.5);
                }
                kinematics.curvature(r1, measures1, &half)
            }
            Placement::Start => no_blocks::<K, S, D>(),
        }
    }

    /// The increments `Λ_a = direction_a · w` for a motion `w` of the arms that changes one to one
    /// with them, and their derivatives.
    #[inline]
    pub(super) fn increase(
        &self,
        kinematics: K,
        at: Placement,
        motion: &Arms<K, S, D>,
    ) -> (Measures<K, S, D>, Gradient<K, S, D>) {
        let mut increments = Measures::<K, S, D>::filled(S::zero());
        let mut by_arm = self.direction;
        for a in 0..Measures::<K, S, D>::LEN {
            let mut unit = Measures::<K, S, D>::filled(S::zero());
            unit[a] = S::one();
            increments[a] = along::<K, S, D>(&self.direction[a], motion);
            let blocks = self.curvature(kinematics, at, &unit);
            for (entry, row) in by_arm[a].as_mut().iter_mut().zip(blocks.as_ref()) {
                for (block, moved) in row.as_ref().iter().zip(motion.as_ref()) {
                    for (entry, row) in entry.iter_mut().zip(block) {
                        *entry += dot(row, moved);
                    }
                }
            }
        }
        (increments, by_arm)
    }
}

/// `Σ_i g_i · w_i` over the arms.
#[inline]
pub(super) fn along<K: Kinematics<S, D>, S: Real, const D: usize>(
    gradient: &Arms<K, S, D>,
    motion: &Arms<K, S, D>,
) -> S {
    let pairs = gradient.as_ref().iter().zip(motion.as_ref());
    pairs.fold(S::zero(), |sum, (g, w)| sum + dot(g, w))
}

#[inline]
fn dot<S: Real, const D: usize>(a: &[S; D], b: &[S; D]) -> S {
    a.iter().zip(b).fold(S::zero(), |sum, (&a, &b)| sum + a * b)
}

/// The arms of an element, given something per node of the scene.
#[inline]
pub(super) fn arms<K: Kinematics<S, D>, S: Real, const D: usize>(
    nodes: &K::PerNode<usize>,
    of: &[[S; D]],
) -> Arms<K, S, D> {
    let first = &of[nodes[0]];
    let mut arms = Arms::<K, S, D>::filled([S::zero(); D]);
    for (arm, &node) in arms.as_mut().iter_mut().zip(&nodes.as_ref()[1..]) {
        let other = &of[node];
        for axis in 0..D {
            arm[axis] = other[axis] - first[axis];
        }
    }
    arms
}

/// Derivatives by arms as derivatives by positions.
#[inline]
pub(super) fn spread<K: Kinematics<S, D>, S: Real, const D: usize>(
    by_arm: &Arms<K, S, D>,
) -> K::PerNode<[S; D]> {
    let mut by_node = K::PerNode::filled([S::zero(); D]);
    for (i, by) in by_arm.as_ref().iter().enumerate() {
        by_node[i + 1] = *by;
        for (sum, &entry) in by_node[0].iter_mut().zip(by) {
            *sum -= entry;
        }
    }
    by_node
}

/// The nodal forces `Σ_a f_a g_a` along a gradient.
#[inline]
pub(super) fn resultant<K: Kinematics<S, D>, S: Real, const D: usize>(
    gradient: &Gradient<K, S, D>,
    force: &Measures<K, S, D>,
) -> K::PerNode<[S; D]> {
    let mut sum = Arms::<K, S, D>::filled([S::zero(); D]);
    for (row, &magnitude) in gradient.as_ref().iter().zip(force.as_ref()) {
        for (sum, entry) in sum.as_mut().iter_mut().zip(row.as_ref()) {
            for (sum, &entry) in sum.iter_mut().zip(entry) {
                *sum += magnitude * entry;
            }
        }
    }
    spread::<K, S, D>(&sum)
}

/// Numbers per measure, the first of an array.
#[inline]
pub(super) fn measures_in<K: Kinematics<S, D>, S: Real, const D: usize>(
    values: &impl Array<S>,
) -> Measures<K, S, D> {
    let mut measures = Measures::<K, S, D>::filled(S::zero());
    for (a, measure) in measures.as_mut().iter_mut().enumerate() {
        *measure = values[a];
    }
    measures
}

/// Coordinates as points.
#[inline]
pub(crate) fn points<S, const D: usize>(coordinates: &[S]) -> &[[S; D]] {
    coordinates.as_chunks().0
}

#[inline]
fn mean<K: Kinematics<S, D>, S: Real, const D: usize>(
    r0: &Arms<K, S, D>,
    r1: &Arms<K, S, D>,
) -> Arms<K, S, D> {
    let mut mean = *r1;
    for (mean, old) in mean.as_mut().iter_mut().zip(r0.as_ref()) {
        for (mean, &old) in mean.iter_mut().zip(old) {
            *mean = S::from_f64(0.5) * (old + *mean);
        }
    }
    mean
}

/// Multiplies everything by ½, exactly.
#[inline]
fn halved<K: Kinematics<S, D>, S: Real, const D: usize>(
    mut gradient: Gradient<K, S, D>,
) -> Gradient<K, S, D> {
    for row in gradient.as_mut() {
        for arm in row.as_mut() {
            for entry in arm {
                *entry *= S::from_f64(0.5);
            }
        }
    }
    gradient
}

#[inline]
fn no_blocks<K: Kinematics<S, D>, S: Real, const D: usize>() -> Blocks<K, S, D> {
    Blocks::<K, S, D>::filled(K::PerArm::filled([[S::zero(); D]; D]))
}
