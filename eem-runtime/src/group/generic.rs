//! What one element contributes to the GENERIC form of the equations.

use super::arms::arms_in;
use super::member::Member;
use super::view::ElementGeneric;
use crate::free_energy::{Array, FreeEnergy};
use crate::group::element_group::{ElementGroup, variables};
use crate::kinematics::Kinematics;
use crate::scalar::Real;
use crate::scheme::{ElementScheme, Placement};
use crate::state::State;

impl<S, M, K, C, const D: usize> ElementGroup<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// All elements in a state.
    pub(super) fn generic_in_all(&mut self, state: &State<S>) -> Vec<ElementGeneric<S>> {
        let mut elements = Vec::with_capacity(self.members.len());
        for member in &mut self.members {
            let r = arms_in::<K, S, D>(&member.site.nodes, &state.positions);
            let measures = self.kinematics.measure(&r);
            let x = variables::<S, M>(measures.as_ref(), member.slots(), state);
            let gradient = member.model.gradient(&x);
            let theta = x[M::Variables::LEN - 1];
            member.viscosities = member.model.viscosity(theta);
            member.start.x0 = x;
            for index in 0..M::MEASURES + M::DASHPOTS {
                let is_force = index < M::MEASURES;
                let sign = if is_force { S::one() } else { -S::one() };
                member.response[index] = sign * gradient[index];
            }
            if M::THERMAL {
                member.response[M::MEASURES + M::DASHPOTS] = theta;
            }
            let force = member.force(self.kinematics, Placement::End, [&r, &r]);
            elements.push(member.generic(&force));
        }
        elements
    }

    /// All elements during the last step, with discrete derivatives in the place of derivatives.
    pub(super) fn generic_of_step_all(&self, ends: [&State<S>; 2]) -> Vec<ElementGeneric<S>> {
        let members = self.members.iter().map(|member| {
            let [r0, r1] =
                ends.map(|state| arms_in::<K, S, D>(&member.site.nodes, &state.positions));
            member.generic(&member.force(self.kinematics, C::PLACEMENT, [&r0, &r1]))
        });
        members.collect()
    }
}

impl<S, M, K, C, const D: usize> Member<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// The present response, with these forces on the nodes.
    fn generic(&self, force: &K::PerNode<[S; D]>) -> ElementGeneric<S> {
        let nodes = self.site.nodes.as_ref().iter().zip(force.as_ref());
        let forces = nodes.flat_map(|(&node, force)| {
            let axes = force.iter().enumerate();
            axes.map(move |(axis, &entry)| (node as usize * D + axis, entry))
        });
        let dashpots = (0..M::DASHPOTS).map(|k| {
            let g = self.response[M::MEASURES + k];
            (self.slots().viscous + k, g, self.viscosities.0[k])
        });
        ElementGeneric {
            forces: forces.collect(),
            dashpots: dashpots.collect(),
            temperature: self.slots().thermal.map(|slot| (slot, self.temperature())),
        }
    }
}
