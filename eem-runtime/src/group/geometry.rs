//! The kinematic quantities of the elements of a group, in contiguous arrays.

use core::ops::Range;

use crate::kinematics::{Ends, Kinematics};
use crate::scalar::Real;
use crate::scheme::Placement;

/// The most coordinates that an element can have: those of a hexahedron.
const MOST_COORDINATES: usize = 24;

/// The most measures that an element can have: the strains of a solid.
pub(crate) const MOST_MEASURES: usize = 6;

/// Node lists, measures and gradients of all elements of a group.
///
/// For element `i`, `measures` are those that its scheme looks at, `direction` the gradient along
/// which its force acts and `sensitivity` the derivative of `measures` by the new coordinates.
#[derive(Clone, Debug)]
pub(crate) struct Geometry<S> {
    /// Node indices, element after element.
    nodes: Vec<usize>,
    nodes_per_element: usize,
    dimension: usize,
    measures_per_element: usize,
    pub(crate) old_measures: Vec<S>,
    pub(crate) measures: Vec<S>,
    direction: Vec<S>,
    sensitivity: Vec<S>,
    /// For schemes in temperature: by how much the motion of the step changes the measures, and the
    /// derivative of that by the new coordinates.
    pub(crate) increments: Vec<S>,
    increment_sensitivity: Vec<S>,
    /// Coordinates of one element: old, new.
    coordinates: [Vec<S>; 2],
    /// A square matrix over the coordinates of one element.
    pub(crate) matrix: Vec<S>,
}

impl<S: Real> Geometry<S> {
    /// Memory for `count` elements with these nodes.
    pub(crate) fn new<K: Kinematics<S>, const D: usize>(nodes: Vec<usize>, count: usize) -> Self {
        let width = K::NODES * D;
        let zeros = |length: usize| vec![S::zero(); length];
        Self {
            nodes,
            nodes_per_element: K::NODES,
            dimension: D,
            measures_per_element: K::MEASURES,
            old_measures: zeros(count * K::MEASURES),
            measures: zeros(count * K::MEASURES),
            direction: zeros(count * K::MEASURES * width),
            sensitivity: zeros(count * K::MEASURES * width),
            increments: zeros(count * K::MEASURES),
            increment_sensitivity: zeros(count * K::MEASURES * width),
            coordinates: [zeros(width), zeros(width)],
            matrix: zeros(width * width),
        }
    }

    /// Number of coordinates of an element.
    pub(crate) fn width(&self) -> usize {
        self.nodes_per_element * self.dimension
    }

    /// The global coordinate of each coordinate of element `i`.
    pub(crate) fn coordinates_of(&self, i: usize) -> impl Iterator<Item = usize> + '_ {
        let dimension = self.dimension;
        let nodes = &self.nodes[i * self.nodes_per_element..][..self.nodes_per_element];
        nodes
            .iter()
            .flat_map(move |&node| (0..dimension).map(move |axis| node * dimension + axis))
    }

    /// The node of each node of element `i`.
    pub(crate) fn nodes_of(&self, i: usize) -> &[usize] {
        &self.nodes[i * self.nodes_per_element..][..self.nodes_per_element]
    }

    /// Dimension of space.
    pub(crate) fn dimension(&self) -> usize {
        self.dimension
    }

    pub(crate) fn measures_range(&self, i: usize) -> Range<usize> {
        i * self.measures_per_element..(i + 1) * self.measures_per_element
    }

    fn gradient_range(&self, i: usize) -> Range<usize> {
        let length = self.measures_per_element * self.width();
        i * length..(i + 1) * length
    }

    /// The gradient along which the force of element `i` acts, a row per measure.
    pub(crate) fn direction(&self, i: usize) -> &[S] {
        &self.direction[self.gradient_range(i)]
    }

    /// The derivative of the measures of element `i` by its new coordinates, a row per measure.
    pub(crate) fn sensitivity(&self, i: usize) -> &[S] {
        &self.sensitivity[self.gradient_range(i)]
    }

    /// The derivative of the increments of element `i` by its new coordinates, a row per measure.
    pub(crate) fn increment_sensitivity(&self, i: usize) -> &[S] {
        &self.increment_sensitivity[self.gradient_range(i)]
    }

    /// The increments `Λ_a = direction_a · w` of element `i` for a motion `w` of its coordinates
    /// that changes one to one with them, and their derivatives.
    pub(crate) fn increase<K: Kinematics<S>>(
        &mut self,
        kinematics: K,
        i: usize,
        at: Placement,
        motion: impl Fn(usize) -> S,
    ) {
        let width = self.width();
        let (own, rows) = (self.measures_range(i), self.gradient_range(i));
        let mut w = [S::zero(); MOST_COORDINATES];
        for (entry, coordinate) in w.iter_mut().zip(self.coordinates_of(i)) {
            *entry = motion(coordinate);
        }
        for a in 0..K::MEASURES {
            let mut unit = [S::zero(); MOST_MEASURES];
            unit[a] = S::one();
            self.curve(kinematics, i, at, &unit[..K::MEASURES]);
            let mut sum = S::zero();
            for q in 0..width {
                let direction = self.direction[rows.start + a * width + q];
                sum += direction * w[q];
                let curvature = &self.matrix[q * width..(q + 1) * width];
                let turn = curvature
                    .iter()
                    .zip(&w)
                    .fold(S::zero(), |t, (&k, &w)| t + k * w);
                self.increment_sensitivity[rows.start + a * width + q] = direction + turn;
            }
            self.increments[own.start + a] = sum;
        }
    }

    /// Coordinates of element `i` in the old and in the new positions; where the scheme looks at
    /// the middle, the mean takes the place of the new ones.
    pub(crate) fn gather(&mut self, i: usize, at: Placement, old: &[S], new: &[S]) {
        let nodes = &self.nodes[i * self.nodes_per_element..][..self.nodes_per_element];
        let [q0, q1] = &mut self.coordinates;
        for (local, &node) in nodes.iter().enumerate() {
            let to = local * self.dimension..(local + 1) * self.dimension;
            let from = node * self.dimension..(node + 1) * self.dimension;
            q0[to.clone()].copy_from_slice(&old[from.clone()]);
            q1[to].copy_from_slice(&new[from]);
        }
        if at == Placement::Middle {
            let half = S::from_f64(0.5);
            for (old, new) in q0.iter().zip(q1) {
                *new = half * (*old + *new);
            }
        }
    }

    /// The measures of element `i` at one set of positions, into `old_measures`.
    pub(crate) fn measure_at<K: Kinematics<S>>(&mut self, kinematics: K, i: usize, q: &[S]) {
        self.gather(i, Placement::End, q, q);
        let range = self.measures_range(i);
        kinematics.measure(&self.coordinates[0], &mut self.old_measures[range]);
    }

    /// The measures of element `i` at one set of positions, into `measures`.
    pub(crate) fn measure_into<K: Kinematics<S>>(
        &self,
        kinematics: K,
        i: usize,
        q: &[S],
        measures: &mut [S],
    ) {
        let mut coordinates = [S::zero(); MOST_COORDINATES];
        for (own, global) in coordinates.iter_mut().zip(self.coordinates_of(i)) {
            *own = q[global];
        }
        kinematics.measure(&coordinates[..self.width()], measures);
    }

    /// Measures, direction and sensitivity of element `i` for the gathered coordinates, from
    /// `old_measures`.
    pub(crate) fn place<K: Kinematics<S>>(&mut self, kinematics: K, i: usize, at: Placement) {
        let (own, rows) = (self.measures_range(i), self.gradient_range(i));
        let [q0, q1] = &self.coordinates;
        let measures = &mut self.measures[own.clone()];
        kinematics.measure(q1, measures);
        let sensitivity = &mut self.sensitivity[rows.clone()];
        kinematics.gradient(q1, measures, sensitivity);
        let direction = &mut self.direction[rows];
        match at {
            Placement::Ends => kinematics.discrete_gradient(
                Ends {
                    q0,
                    q1,
                    measures0: &self.old_measures[own],
                    measures1: measures,
                },
                direction,
            ),
            Placement::End => direction.copy_from_slice(sensitivity),
            Placement::Middle => {
                direction.copy_from_slice(sensitivity);
                halve(sensitivity);
            }
            Placement::Start => {
                let old = &self.old_measures[own];
                kinematics.gradient(q0, old, direction);
                for (measure, &old) in measures.iter_mut().zip(old) {
                    *measure = S::from_f64(0.5) * (old + *measure);
                }
                halve(sensitivity);
            }
        }
    }

    /// The direction of element `i` at one set of positions.
    pub(crate) fn aim<K: Kinematics<S>>(&mut self, kinematics: K, i: usize, q: &[S]) {
        self.gather(i, Placement::End, q, q);
        self.place(kinematics, i, Placement::End);
    }

    /// `Σ_a f_a ∂(direction_a)/∂q¹` of element `i` into `matrix`; from the gathered
    /// coordinates.
    pub(crate) fn curve<K: Kinematics<S>>(
        &mut self,
        kinematics: K,
        i: usize,
        at: Placement,
        force: &[S],
    ) {
        self.matrix.fill(S::zero());
        let own = self.measures_range(i);
        let [q0, q1] = &self.coordinates;
        let measures = &self.measures[own.clone()];
        match at {
            Placement::Ends => kinematics.add_discrete_curvature(
                Ends {
                    q0,
                    q1,
                    measures0: &self.old_measures[own],
                    measures1: measures,
                },
                force,
                &mut self.matrix,
            ),
            Placement::End => {
                kinematics.add_curvature(q1, measures, force, &mut self.matrix);
            }
            Placement::Middle => {
                kinematics.add_curvature(q1, measures, force, &mut self.matrix);
                halve(&mut self.matrix);
            }
            Placement::Start => {}
        }
    }

    /// A of the nodal force `A q_m` of element `i` into `matrix`; `false` if there is none.
    pub(crate) fn secant<K: Kinematics<S>>(
        &mut self,
        kinematics: K,
        i: usize,
        at: Placement,
        force: &[S],
    ) -> bool {
        self.matrix.fill(S::zero());
        let own = self.measures_range(i);
        let measures = &self.measures[own.clone()];
        let old = match at {
            Placement::Ends => &self.old_measures[own],
            Placement::Middle => measures,
            Placement::End | Placement::Start => return false,
        };
        kinematics.add_secant(old, measures, force, &mut self.matrix);
        true
    }
}

/// Multiplies everything by ½, exactly.
fn halve<S: Real>(values: &mut [S]) {
    for value in values {
        *value *= S::from_f64(0.5);
    }
}
