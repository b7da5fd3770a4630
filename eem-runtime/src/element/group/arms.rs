//! Arithmetic with the arms of an element, the edge vectors from node 0, and with quantities per arm.

use crate::element::group::view::Trial;
use crate::element::kinematics::{Arms, Gradient, Kinematics, MeasureSet, Measures, Numbers};
use eem_material::free_energy::Array;
use eem_material::number::compensated::Compensated;

/// `Σ_i g_i · w_i` over the arms.
#[inline]
pub(super) fn along<K: Kinematics<D>, const D: usize>(
    gradient: &Arms<K, D>,
    motion: &Arms<K, D>,
) -> f64 {
    let pairs = gradient.as_ref().iter().zip(motion.as_ref());
    pairs.fold(0.0, |sum, (g, w)| sum + dot(g, w))
}

#[inline]
pub(super) fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (&a, &b)| sum + a * b)
}

/// The arms of an element in a state, with an error of ε of the arms wherever the origin is: the compensations of the
/// positions are included.
#[inline]
pub(super) fn arms_in<K: Kinematics<D>, const D: usize>(
    nodes: &K::PerNode<u32>,
    positions: &Compensated,
) -> Arms<K, D> {
    let [first, first_carry] = positions.point::<D>(nodes[0] as usize);
    let mut arms = Arms::<K, D>::filled([0.0; D]);
    for (arm, &node) in arms.as_mut().iter_mut().zip(&nodes.as_ref()[1..]) {
        let [other, carry] = positions.point::<D>(node as usize);
        for axis in 0..D {
            arm[axis] = (other[axis] - first[axis]) + (carry[axis] - first_carry[axis]);
        }
    }
    arms
}

/// The change of the arms of an element at a trial, with an error of ε of the change, from displacements.
#[inline]
pub(super) fn change_in<K: Kinematics<D>, const D: usize>(
    nodes: &K::PerNode<u32>,
    trial: &Trial<D>,
) -> Arms<K, D> {
    change_of::<K, D>(nodes, [&trial.displacements, &trial.carries])
}

/// The same at the stage of a set of unknowns.
#[inline]
pub(super) fn change_in_set<K: Kinematics<D>, const D: usize>(
    nodes: &K::PerNode<u32>,
    trial: &Trial<D>,
    set: usize,
) -> Arms<K, D> {
    let first = trial.first_of_set(set);
    change_of::<K, D>(
        nodes,
        [&trial.displacements[first..], &trial.carries[first..]],
    )
}

#[inline]
fn change_of<K: Kinematics<D>, const D: usize>(
    nodes: &K::PerNode<u32>,
    [displacements, carries]: [&[[f64; D]]; 2],
) -> Arms<K, D> {
    let of = |node: u32| (&displacements[node as usize], &carries[node as usize]);
    let (first, first_rest) = of(nodes[0]);
    let mut change = Arms::<K, D>::filled([0.0; D]);
    for (arm, &node) in change.as_mut().iter_mut().zip(&nodes.as_ref()[1..]) {
        let (other, rest) = of(node);
        for axis in 0..D {
            arm[axis] = (other[axis] - first[axis]) + (rest[axis] - first_rest[axis]);
        }
    }
    change
}

/// Derivatives with respect to the positions of the nodes, from those with respect to the arms.
#[inline]
pub(super) fn spread<K: Kinematics<D>, const D: usize>(
    by_arm: &Arms<K, D>,
) -> K::PerNode<[f64; D]> {
    let mut by_node = K::PerNode::filled([0.0; D]);
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
pub(super) fn resultant<K: Kinematics<D>, const D: usize>(
    gradient: &Gradient<K, D>,
    force: &Measures<K, D>,
) -> K::PerNode<[f64; D]> {
    let mut sum = Arms::<K, D>::filled([0.0; D]);
    for (row, &magnitude) in gradient.as_ref().iter().zip(force.as_ref()) {
        add_scaled::<K, D>(&mut sum, magnitude, row);
    }
    spread::<K, D>(&sum)
}

/// The first entries of an array, one per measure.
#[inline]
pub(super) fn measures_in<Q: MeasureSet>(values: &impl Array<f64>) -> Numbers<Q> {
    let mut measures = Numbers::<Q>::filled(0.0);
    for (a, measure) in measures.as_mut().iter_mut().enumerate() {
        *measure = values[a];
    }
    measures
}

/// A list of coordinates as a list of points.
#[inline]
pub(crate) fn points<const D: usize>(coordinates: &[f64]) -> &[[f64; D]] {
    coordinates.as_chunks().0
}

#[inline]
pub(super) fn mean<K: Kinematics<D>, const D: usize>(
    r0: &Arms<K, D>,
    r1: &Arms<K, D>,
) -> Arms<K, D> {
    let mut mean = *r1;
    let old = r0.as_ref().as_flattened();
    for (mean, &old) in mean.as_mut().as_flattened_mut().iter_mut().zip(old) {
        *mean = 0.5 * (old + *mean);
    }
    mean
}

/// Multiplies all arms by a factor.
#[inline]
pub(super) fn scale<K: Kinematics<D>, const D: usize>(arms: &mut Arms<K, D>, factor: f64) {
    for entry in arms.as_mut().as_flattened_mut() {
        *entry *= factor;
    }
}

/// `sum += factor arms`.
#[inline]
pub(super) fn add_scaled<K: Kinematics<D>, const D: usize>(
    sum: &mut Arms<K, D>,
    factor: f64,
    arms: &Arms<K, D>,
) {
    let entries = arms.as_ref().as_flattened();
    for (sum, &entry) in sum.as_mut().as_flattened_mut().iter_mut().zip(entries) {
        *sum += factor * entry;
    }
}
