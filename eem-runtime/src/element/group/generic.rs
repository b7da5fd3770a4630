//! The contribution of one element to the GENERIC form of the equations.

use super::arms::{measures_in, spread};
use super::placed::PlacedPoint;
use super::point::Point;
use super::pose::Pose;
use super::view::{ElementGeneric, EntropySlopes};
use crate::element::conjugates::Placement;
use crate::element::kinematics::{Arms, Kinematics, Measures};
use crate::element::layout::Slots;
use crate::element::state::State;
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

impl<A: Arrays, K: Kinematics<D>, const D: usize> PlacedPoint<A, K, D> {
    /// Replaces the response by the derivatives of the energy in a state.
    pub(super) fn take_derivatives(&mut self, r: &Arms<K, D>, state: &State) {
        let x = self.variables_in(r, state);
        let gradient = self.point.model.gradient(&x);
        let theta = x[A::Variables::LEN - 1];
        self.point.viscosities = self.point.model.viscosity(theta);
        self.point.drag.viscosity = self.point.model.drag(theta);
        self.point.start.x0 = x;
        for index in 0..A::MEASURES + self.dashpots() {
            self.point.response[index] = Point::<A, K::Measures>::sign(index) * gradient[index];
        }
        if self.is_thermal() {
            self.point.response[A::MEASURES + A::DASHPOTS] = theta;
        }
    }

    /// The present response, along the gradients between two configurations.
    pub(super) fn generic(
        &self,
        nodes: &K::PerNode<u32>,
        (at, ends): (Placement, [&Arms<K, D>; 2]),
    ) -> ElementGeneric {
        let measures0 = self.old_measures();
        let pose = Pose::between(&self.kinematics, at, ends, measures0);
        let on_nodes = |forces: &Measures<K, D>| {
            let pulled = pose.pull(&self.kinematics, at, forces);
            by_coordinate(nodes.as_ref(), spread::<K, D>(&pulled).as_ref())
        };
        let (mut drags, mut dashpots) = (Vec::new(), Vec::new());
        for a in 0..self.drags() {
            let mut unit = Measures::<K, D>::filled(0.0);
            unit[a] = 1.0;
            drags.push((self.drag.viscosity.0[a], on_nodes(&unit)));
        }
        for k in 0..self.dashpots() {
            let g = self.response[A::MEASURES + k];
            dashpots.push((self.slots().viscous + k, g, self.viscosities.0[k]));
        }
        ElementGeneric {
            forces: on_nodes(&measures_in::<K::Measures>(&self.response)),
            dashpots,
            drags,
            temperature: self.slots().thermal.map(|slot| (slot, self.temperature())),
            entropy: None,
        }
    }

    /// The derivatives of the entropy in the state of [`take_derivatives`](Self::take_derivatives).
    pub(super) fn entropy_slopes(
        &self,
        nodes: &K::PerNode<u32>,
        (at, ends): (Placement, [&Arms<K, D>; 2]),
    ) -> Option<EntropySlopes> {
        let Slots { viscous, thermal } = self.slots();
        let x = self.start.x0;
        let (_, hessian) = self.model.hessian(&x);
        let theta = A::Variables::LEN - 1;
        let pose = Pose::between(&self.kinematics, at, ends, measures_in::<K::Measures>(&x));
        let mut by_measure = Measures::<K, D>::filled(0.0);
        for a in 0..A::MEASURES {
            by_measure[a] = -hessian[theta][a];
        }
        let pulled = pose.pull(&self.kinematics, at, &by_measure);
        let mut by_viscous = Vec::new();
        for k in 0..self.dashpots() {
            by_viscous.push((viscous + k, -hessian[theta][A::MEASURES + k]));
        }
        thermal.map(|slot| EntropySlopes {
            slot,
            by_position: by_coordinate(nodes.as_ref(), spread::<K, D>(&pulled).as_ref()),
            by_viscous,
            by_temperature: -hessian[theta][theta],
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
