//! The kinematic quantities of one element at a trial state.

use crate::free_energy::Array;
use crate::kinematics::{Blocks, Ends, Gradient, Kinematics, Measures, Points};
use crate::scalar::Real;
use crate::scheme::Placement;

/// Measures and gradients of an element as its scheme looks at them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose<K: Kinematics<S, D>, S: Real, const D: usize> {
    /// Where the gradients are taken; where the scheme looks at the middle, the mean takes the
    /// place of the new positions.
    ends: Ends<K, S, D>,
    /// The measures that the scheme looks at.
    pub(super) measures: Measures<K, S, D>,
    /// The gradient along which the forces act.
    pub(super) direction: Gradient<K, S, D>,
    /// The derivative of `measures` by the new positions.
    pub(super) sensitivity: Gradient<K, S, D>,
}

impl<K: Kinematics<S, D>, S: Real, const D: usize> Pose<K, S, D> {
    /// Between the old positions, whose measures are given, and the new ones.
    #[inline]
    pub(super) fn new(
        kinematics: K,
        at: Placement,
        [q0, q1]: [&Points<K, S, D>; 2],
        measures0: Measures<K, S, D>,
    ) -> Self {
        let q1 = match at {
            Placement::Middle => mean::<K, S, D>(q0, q1),
            Placement::Ends | Placement::End | Placement::Start => *q1,
        };
        let measures1 = kinematics.measure(&q1);
        let gradient = kinematics.gradient(&q1, &measures1);
        let ends = Ends {
            q0: *q0,
            q1,
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
                let old = kinematics.gradient(q0, &measures0);
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

    /// `Σ_a f_a ∂(direction_a)/∂q¹`.
    #[inline]
    pub(super) fn curvature(
        &self,
        kinematics: K,
        at: Placement,
        force: &Measures<K, S, D>,
    ) -> Blocks<K, S, D> {
        let Ends { q1, measures1, .. } = &self.ends;
        match at {
            Placement::Ends => kinematics.discrete_curvature(&self.ends, force),
            Placement::End => kinematics.curvature(q1, measures1, force),
            Placement::Middle => {
                let mut half = *force;
                for force in half.as_mut() {
                    *force *= S::from_f64(0.5);
                }
                kinematics.curvature(q1, measures1, &half)
            }
            Placement::Start => no_blocks::<K, S, D>(),
        }
    }

    /// The increments `Λ_a = direction_a · w` for a motion `w` of the nodes that changes one to one
    /// with their positions, and their derivatives.
    #[inline]
    pub(super) fn increase(
        &self,
        kinematics: K,
        at: Placement,
        motion: &Points<K, S, D>,
    ) -> (Measures<K, S, D>, Gradient<K, S, D>) {
        let mut increments = Measures::<K, S, D>::filled(S::zero());
        let mut by_position = self.direction;
        for a in 0..Measures::<K, S, D>::LEN {
            let mut unit = Measures::<K, S, D>::filled(S::zero());
            unit[a] = S::one();
            increments[a] = along::<K, S, D>(&self.direction[a], motion);
            let blocks = self.curvature(kinematics, at, &unit);
            for (entry, row) in by_position[a].as_mut().iter_mut().zip(blocks.as_ref()) {
                for (block, moved) in row.as_ref().iter().zip(motion.as_ref()) {
                    for (entry, row) in entry.iter_mut().zip(block) {
                        *entry += dot(row, moved);
                    }
                }
            }
        }
        (increments, by_position)
    }
}

/// `Σ_i g_i · w_i` over the nodes.
#[inline]
pub(super) fn along<K: Kinematics<S, D>, S: Real, const D: usize>(
    gradient: &Points<K, S, D>,
    motion: &Points<K, S, D>,
) -> S {
    let pairs = gradient.as_ref().iter().zip(motion.as_ref());
    pairs.fold(S::zero(), |sum, (g, w)| sum + dot(g, w))
}

#[inline]
fn dot<S: Real, const D: usize>(a: &[S; D], b: &[S; D]) -> S {
    a.iter().zip(b).fold(S::zero(), |sum, (&a, &b)| sum + a * b)
}

/// The positions of the nodes of an element.
#[inline]
pub(super) fn gather<K: Kinematics<S, D>, S: Real, const D: usize>(
    nodes: &K::PerNode<usize>,
    of: &[[S; D]],
) -> Points<K, S, D> {
    let mut points = Points::<K, S, D>::filled([S::zero(); D]);
    for (point, &node) in points.as_mut().iter_mut().zip(nodes.as_ref()) {
        *point = of[node];
    }
    points
}

/// Coordinates as points.
#[inline]
pub(crate) fn points<S, const D: usize>(coordinates: &[S]) -> &[[S; D]] {
    coordinates.as_chunks().0
}

#[inline]
fn mean<K: Kinematics<S, D>, S: Real, const D: usize>(
    q0: &Points<K, S, D>,
    q1: &Points<K, S, D>,
) -> Points<K, S, D> {
    let mut mean = *q1;
    for (mean, old) in mean.as_mut().iter_mut().zip(q0.as_ref()) {
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
        for point in row.as_mut() {
            for entry in point {
                *entry *= S::from_f64(0.5);
            }
        }
    }
    gradient
}

#[inline]
fn no_blocks<K: Kinematics<S, D>, S: Real, const D: usize>() -> Blocks<K, S, D> {
    Blocks::<K, S, D>::filled(K::PerNode::filled([[S::zero(); D]; D]))
}
