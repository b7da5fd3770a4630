//! The contribution of one element to the GENERIC form of the equations.

use super::arms::{measures_in, spread};
use super::placed::PlacedPoint;
use super::point::Point;
use super::points::PointGeneric;
use super::pose::Pose;
use super::view::{ElementGeneric, EntropySlopes};
use crate::element::conjugates::Placement;
use crate::element::kinematics::{Arms, Kinematics, MeasureSet, Measures, Numbers};
use crate::element::layout::Slots;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

impl<A: Arrays, Q: MeasureSet> Point<A, Q> {
    /// Replaces the response by the derivatives of the energy at these variables.
    pub(super) fn take_derivatives(&mut self, x: &A::Variables) {
        let gradient = self.model.gradient(x);
        let theta = x[A::Variables::LEN - 1];
        self.viscosities = self.model.viscosity(theta);
        self.drag.viscosity = self.model.drag(theta);
        self.start.x0 = *x;
        for index in 0..A::MEASURES + self.dashpots() {
            self.response[index] = Self::sign(index) * gradient[index];
        }
        if self.is_thermal() {
            self.response[Self::TEMPERATURE] = theta;
        }
    }

    /// See [`PointsInState::generic`](super::points::PointsInState::generic).
    pub(super) fn generic(&self) -> PointGeneric<Q> {
        let mut dashpots = Vec::new();
        for k in 0..self.dashpots() {
            dashpots.push([self.response[A::MEASURES + k], self.viscosities.0[k]]);
        }
        PointGeneric {
            forces: measures_in::<Q>(&self.response),
            dashpots,
            drags: self.drag.viscosity.0.as_ref()[..self.drags()].to_vec(),
            temperature: self.temperature(),
        }
    }

    /// See [`PointsInState::entropy_slopes`](super::points::PointsInState::entropy_slopes).
    pub(super) fn entropy_slopes(&self) -> (Numbers<Q>, Vec<f64>, f64) {
        let (_, hessian) = self.model.hessian(&self.start.x0);
        let row = hessian[A::Variables::LEN - 1];
        let mut by_measure = Numbers::<Q>::filled(0.0);
        for a in 0..A::MEASURES {
            by_measure[a] = -row[a];
        }
        let mut by_viscous = Vec::new();
        for k in 0..self.dashpots() {
            by_viscous.push(-row[A::MEASURES + k]);
        }
        (by_measure, by_viscous, -row[A::Variables::LEN - 1])
    }
}

impl<K: Kinematics<D>, const D: usize> PlacedPoint<K, D> {
    /// The contribution of a point, along the gradients between two configurations, given the measures of the first.
    pub(super) fn generic(
        &self,
        nodes: &K::PerNode<u32>,
        (at, ends): (Placement, [&Arms<K, D>; 2]),
        (of_point, slots): (PointGeneric<K::Measures>, Slots),
    ) -> ElementGeneric {
        let measures0 = self.kinematics.measure(ends[0]);
        let pose = Pose::between(&self.kinematics, at, ends, measures0);
        let on_nodes = |forces: &Measures<K, D>| {
            let pulled = pose.pull(&self.kinematics, at, forces);
            by_coordinate(nodes.as_ref(), spread::<K, D>(&pulled).as_ref())
        };
        let (mut drags, mut dashpots) = (Vec::new(), Vec::new());
        for (a, &drag) in of_point.drags.iter().enumerate() {
            let mut unit = Measures::<K, D>::filled(0.0);
            unit[a] = 1.0;
            drags.push((drag, on_nodes(&unit)));
        }
        for (k, &[g, eta]) in of_point.dashpots.iter().enumerate() {
            dashpots.push((slots.viscous + k, g, eta));
        }
        ElementGeneric {
            forces: on_nodes(&of_point.forces),
            dashpots,
            drags,
            temperature: slots.thermal.map(|slot| (slot, of_point.temperature)),
            entropy: None,
        }
    }

    /// The derivatives of the entropy of a point in a state, given its arms there.
    pub(super) fn entropy_slopes(
        &self,
        nodes: &K::PerNode<u32>,
        r: &Arms<K, D>,
        (of_point, slots): ((Measures<K, D>, Vec<f64>, f64), Slots),
    ) -> Option<EntropySlopes> {
        let (by_measure, of_dashpots, by_temperature) = of_point;
        let slot = slots.thermal?;
        let (at, measures) = (Placement::End, self.kinematics.measure(r));
        let pose = Pose::between(&self.kinematics, at, [r, r], measures);
        let pulled = pose.pull(&self.kinematics, at, &by_measure);
        let mut by_viscous = Vec::new();
        for (k, &by) in of_dashpots.iter().enumerate() {
            by_viscous.push((slots.viscous + k, by));
        }
        Some(EntropySlopes {
            slot,
            by_position: by_coordinate(nodes.as_ref(), spread::<K, D>(&pulled).as_ref()),
            by_viscous,
            by_temperature,
        })
    }
}

/// The components of vectors on nodes, with their coordinates.
fn by_coordinate<const D: usize>(nodes: &[u32], by_node: &[[f64; D]]) -> Vec<(usize, f64)> {
    let mut entries = Vec::new();
    for (&node, vector) in nodes.iter().zip(by_node) {
        for (axis, &entry) in vector.iter().enumerate() {
            entries.push((node as usize * D + axis, entry));
        }
    }
    entries
}
