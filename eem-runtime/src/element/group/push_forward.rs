//! The tangents of a step at its points: the changes of the local equations with the old state and the inputs, and their
//! elimination.
//!
//! Along a direction in which old state and inputs change, the new state changes by
//!
//! ```text
//! ∂R/∂x¹ dx¹ = −dR      dR = ∂R/∂x⁰ dx⁰ + ∂R/∂μ dμ
//! ```
//!
//! which is an iteration of Newton's method with dR in place of the residual. Matrix, elimination of the local unknowns and
//! assembly are those of a step; dR and the local unknowns are found for one direction after the other.

mod changes;

use super::arms::{along, dot};
use super::element_group::ElementGroup;
use super::member::Member;
use super::placed::PlacedPoint;
use super::point::temperature_in;
use super::point_step::{Direction, PastStep};
use super::pose::Pose;
use super::share::Share;
use super::site::{Contact, Site, paths_of};
use crate::algebra::system::LinearSystem;
use crate::element::conduction::InterfaceTemperatures;
use crate::element::conjugates::{Exact, Family};
use crate::element::error::StateError;
use crate::element::group::arms::{add_scaled, points, scale};
use crate::element::kinematics::{Arms, Blocks, Gradient, Kinematics};
use eem_material::arrays::Arrays;
use eem_material::free_energy::Array;

impl<A: Arrays, K: Kinematics<D>, const D: usize> ElementGroup<A, K, D> {
    /// Adds `∂R/∂x¹` of a step, local unknowns eliminated, to a system, and `−dR` to the right-hand side of each direction.
    /// In its new state, anchors and prescribed temperatures already have their changes, and masses those of the old state.
    pub(super) fn push_forward(
        &mut self,
        step: &PastStep<'_>,
        (interface, temperatures): (&InterfaceTemperatures, &mut [f64]),
        system: &mut LinearSystem<1>,
        directions: &mut [Direction],
    ) -> Result<(), StateError> {
        let (values, right) = system.parts();
        for member in &mut self.members {
            let mut share = Share::<K, D>::none();
            let mut by_old = None;
            let arms = member.past_arms(step);
            for (point, heat) in member.points.as_mut().iter_mut().zip(share.heat.as_mut()) {
                let contact = point.contact_in(&self.contacts);
                if contact.is_none() {
                    point.return_to(step, &arms)?;
                }
                let ends = point.ends(arms);
                let pose = Pose::new(&point.kinematics, Exact::placement(point.scheme), ends);
                let ends = point.ends_back(arms);
                let paths = paths_of(contact);
                point.sensitivity = pose.sensitivity;
                let by_old_arms = point.kinematics.new_gradient(&ends);
                let linear = point.linearize_past(step, interface, paths)?;
                *heat = contact.map(|_| point.heat::<Exact>(interface, &linear.form));
                let form = (&linear.form, None);
                point.add_momentum::<Exact>(step.view.step, &pose, form, heat, &mut share.momentum);
                point.add_old_curvature(step.view.step, &ends, &mut by_old);
                if let Some(slot) = point.slots().thermal {
                    temperatures[slot] = temperature_in::<A>(&linear.form.0);
                }
                for direction in &mut *directions {
                    let moved = member.site.changes_in(&direction.old.positions);
                    let moved = PlacedPoint::<A, K, D>::rates_along(&by_old_arms, &moved);
                    let change = point.change(step, (interface, paths), &moved, &linear, direction);
                    let unknown = contact.map(|contact| contact.unknown as usize);
                    let forces = point.push(&linear, &change, unknown, direction)?;
                    let mut pull =
                        pose.pull(&point.kinematics, Exact::placement(point.scheme), &forces);
                    scale::<K, D>(&mut pull, step.view.step);
                    let right = direction.right.as_flattened_mut();
                    member.site.subtract_arms(&pull, &member.site.rows, right);
                }
            }
            member.add_share(&share, &self.contacts, (&mut *values, &mut *right));
            for direction in &mut *directions {
                member.add_motion(&share, by_old.as_ref(), &self.contacts, direction);
            }
        }
        Ok(())
    }

    /// Finds the changes of the internal variables and of θ*.
    pub(super) fn follow(&self, directions: &mut [Direction]) {
        for member in &self.members {
            for direction in &mut *directions {
                let moved = member.site.changes_in(&direction.new.positions);
                for point in member.points.as_ref() {
                    let changes = PlacedPoint::<A, K, D>::rates_along(&point.sensitivity, &moved);
                    let heat = point.contact_in(&self.contacts).map(|contact| {
                        point.condensed.heat_factor * contact.heat(&direction.right)
                    });
                    point.follow(&changes, heat, direction);
                }
            }
        }
    }
}

impl<A: Arrays, K: Kinematics<D>, const D: usize> Member<A, K, D> {
    /// Adds the changes with the old arms through the gradients, and all changes with the new arms.
    fn add_motion(
        &self,
        share: &Share<K, D>,
        by_old: Option<&Blocks<K, D>>,
        contacts: &[Contact<K, D>],
        direction: &mut Direction,
    ) {
        let [old, new] =
            [&direction.old, &direction.new].map(|own| self.site.changes_in(&own.positions));
        let right = direction.right.as_flattened_mut();
        for (heat, point) in share.heat.as_ref().iter().zip(self.points.as_ref()) {
            if let (Some(heat), Some(contact)) = (heat, point.contact_in(contacts)) {
                right[contact.unknown as usize] += along::<K, D>(&heat.by_arm, &new);
            }
        }
        if let (Some(by_old), Some(momentum)) = (by_old, &share.momentum) {
            let mut pull = applied::<K, D>(by_old, &old);
            let by_new = applied::<K, D>(&momentum.blocks, &new);
            add_scaled::<K, D>(&mut pull, 1.0, &by_new);
            self.site.subtract_arms(&pull, &self.site.rows, right);
        }
    }
}

impl<K: Kinematics<D>, const D: usize> Site<K, D> {
    /// The changes of the arms, given those of all coordinates.
    #[inline]
    fn changes_in(&self, positions: &[f64]) -> Arms<K, D> {
        let at = points::<D>(positions);
        let nodes = self.nodes.as_ref();
        let first = at[nodes[0] as usize];
        let mut arms = Arms::<K, D>::filled(first);
        for (arm, &node) in arms.as_mut().iter_mut().zip(&nodes[1..]) {
            for (arm, other) in arm.iter_mut().zip(at[node as usize]) {
                *arm = other - *arm;
            }
        }
        arms
    }
}

/// The product of blocks with the changes of arms.
#[inline]
fn applied<K: Kinematics<D>, const D: usize>(
    blocks: &Blocks<K, D>,
    arms: &Arms<K, D>,
) -> Arms<K, D> {
    let mut product = Arms::<K, D>::filled([0.0; D]);
    for (product, row) in product.as_mut().iter_mut().zip(blocks.as_ref()) {
        for (block, arm) in row.as_ref().iter().zip(arms.as_ref()) {
            for (sum, row) in product.iter_mut().zip(block) {
                *sum += dot(row, arm);
            }
        }
    }
    product
}

/// Gradients of zeros.
fn still<K: Kinematics<D>, const D: usize>() -> Gradient<K, D> {
    Gradient::<K, D>::filled(Arms::<K, D>::filled([0.0; D]))
}
