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

pub(super) mod changes;

use super::arms::{along, dot};
use super::element_group::ElementGroup;
use super::member::{Block, Member};
use super::placed::{OfGroup, PlacedPoint};
use super::point_step::{Direction, PastStep};
use super::points::PointSet;
use super::pose::Pose;
use super::share::{Contacts, Share};
use super::site::Site;
use crate::algebra::system::LinearSystem;
use crate::element::conduction::InterfaceTemperatures;
use crate::element::conjugates::{Exact, Family, Placement};
use crate::element::error::StateError;
use crate::element::group::arms::{add_scaled, points as points_of, scale};
use crate::element::kinematics::{
    Arms, Blocks, Ends, Gradient, Kinematics, Measures, QuadraticStrain,
};
use crate::element::layout::Slots;
use eem_material::free_energy::Array;

impl<K, P, C, const D: usize> ElementGroup<K, P, C, D>
where
    K: QuadraticStrain<D>,
    P: ?Sized + PointSet<K::Measures>,
    C: Family,
{
    /// Adds `∂R/∂x¹` of a step, local unknowns eliminated, to a system, and `−dR` to the right-hand side of each direction.
    /// In its new state, anchors and prescribed temperatures already have their changes, and masses those of the old state.
    pub(super) fn push_forward(
        &mut self,
        step: &PastStep<'_>,
        temperatures: (&InterfaceTemperatures, &mut [f64]),
        system: &mut LinearSystem<1>,
        directions: &mut [Direction],
    ) -> Result<(), StateError> {
        let (values, right) = system.parts();
        let ((interface, temperatures), contacts) = (temperatures, &self.contacts);
        for Block { members, points } in &mut self.elements.blocks {
            for (index, member) in members.iter_mut().enumerate() {
                let (points, temperatures) =
                    ((index, &mut **points), (interface, &mut *temperatures));
                let (share, by_old) = member.push_forward(
                    points,
                    (step, self.of),
                    contacts,
                    temperatures,
                    directions,
                )?;
                member.add_share(&share, contacts, (&mut *values, &mut *right));
                for direction in &mut *directions {
                    member.add_motion(&share, by_old.as_ref(), contacts, direction);
                }
            }
        }
        Ok(())
    }

    /// Finds the changes of the internal variables and of θ*.
    pub(super) fn follow(&self, directions: &mut [Direction]) {
        for block in &self.elements.blocks {
            for (first, member) in block.elements() {
                for direction in &mut *directions {
                    let moved = member.site.changes_in(&direction.new.positions);
                    for (index, point) in (first..).zip(member.points.as_ref()) {
                        let changes = PlacedPoint::<K, D>::rates_along(&point.sensitivity, &moved);
                        let contact = self.contacts.heat.get(block.points.contact(index));
                        block.points.follow(index, &changes, contact, direction);
                    }
                }
            }
        }
    }
}

impl<K: Kinematics<D>, const D: usize> Member<K, D> {
    /// The contribution of the element to the tangent, and the derivatives of its impulses with respect to the old arms at given forces; adds
    /// the changes with the old state to the directions.
    fn push_forward<P: ?Sized + PointSet<K::Measures>>(
        &mut self,
        (index, points): (usize, &mut P),
        (step, of): (&PastStep<'_>, OfGroup),
        contacts: &Contacts<K, D>,
        (interface, temperatures): (&InterfaceTemperatures, &mut [f64]),
        directions: &mut [Direction],
    ) -> Result<(Share<K, D>, Option<Blocks<K, D>>), StateError> {
        let mut share = Share::<K, D>::none();
        let mut by_old = None;
        let (h, arms) = (step.view.step, self.past_arms(step));
        let first = index * Self::POINTS;
        let own = self.points.as_mut().iter_mut().zip(share.heat.as_mut());
        for (index, (point, heat)) in (first..).zip(own) {
            let contact = contacts.heat.get(points.contact(index));
            let past = point.past_ends(arms);
            let (ends, back) = (
                past.forward(&point.kinematics),
                past.back(&point.kinematics),
            );
            let pose = Pose::new(&point.kinematics, Placement::Ends, ends);
            point.sensitivity = pose.sensitivity;
            let by_old_arms = point.kinematics.new_gradient(&back);
            let around = (interface, contact);
            let measures = past.measures.each_ref();
            let (exchange, theta) = points.linearize_past(index, step, around, measures)?;
            *heat = contact.map(|_| point.heat::<Exact>(&exchange));
            let momentum = &mut share.momentum;
            point.add_momentum::<Exact>((of, h), (&pose, None), &exchange, heat, momentum);
            point.add_old_curvature(h, &back, exchange.forces, &mut by_old);
            if let (
                _,
                Slots {
                    thermal: Some(slot),
                    ..
                },
            ) = points.place(index)
            {
                temperatures[slot] = theta;
            }
            for direction in &mut *directions {
                let moved = self.site.changes_in(&direction.old.positions);
                let moved = PlacedPoint::<K, D>::rates_along(&by_old_arms, &moved);
                let forces = points.push(index, step, around, &moved, direction)?;
                let mut pull = pose.pull(&point.kinematics, Placement::Ends, &forces);
                scale::<K, D>(&mut pull, h);
                let right = direction.right.as_flattened_mut();
                self.site.subtract_arms(&pull, &self.site.rows, right);
            }
        }
        Ok((share, by_old))
    }

    /// Adds the changes with the old arms through the gradients, and all changes with the new arms.
    fn add_motion(
        &self,
        share: &Share<K, D>,
        by_old: Option<&Blocks<K, D>>,
        contacts: &Contacts<K, D>,
        direction: &mut Direction,
    ) {
        let [old, new] =
            [&direction.old, &direction.new].map(|own| self.site.changes_in(&own.positions));
        let right = direction.right.as_flattened_mut();
        for heat in share.heat.as_ref().iter().flatten() {
            let (contact, _) = contacts.at(heat.contact);
            right[contact.unknown as usize] += along::<K, D>(&heat.by_arm, &new);
        }
        if let (Some(by_old), Some(momentum)) = (by_old, &share.momentum) {
            let mut pull = applied::<K, D>(by_old, &old);
            let by_new = applied::<K, D>(&momentum.blocks, &new);
            add_scaled::<K, D>(&mut pull, 1.0, &by_new);
            self.site.subtract_arms(&pull, &self.site.rows, right);
        }
    }
}

impl<K: Kinematics<D>, const D: usize> PlacedPoint<K, D> {
    /// Adds the derivative of its impulses with respect to the old arms at given forces.
    #[inline]
    fn add_old_curvature(
        &self,
        step: f64,
        back: &Ends<K, D>,
        mut forces: Measures<K, D>,
        sum: &mut Option<Blocks<K, D>>,
    ) {
        for force in forces.as_mut() {
            *force *= step;
        }
        let (kinematics, still) = (&self.kinematics, still::<K, D>());
        match sum {
            None => *sum = Some(kinematics.discrete_tangent(back, &forces, &still)),
            Some(sum) => kinematics.add_discrete_tangent(back, &forces, &still, sum),
        }
    }
}

impl<K: Kinematics<D>, const D: usize> Site<K, D> {
    /// The changes of the arms, given those of all coordinates.
    #[inline]
    fn changes_in(&self, positions: &[f64]) -> Arms<K, D> {
        let at = points_of::<D>(positions);
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
