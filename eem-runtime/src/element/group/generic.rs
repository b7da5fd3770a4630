//! What one element contributes to the GENERIC form of the equations.

use super::point::Point;
use super::view::ElementGeneric;
use crate::element::conjugates::{ElementScheme, Placement};
use crate::element::group::element_group::ElementGroup;
use crate::element::kinematics::{Arms, Kinematics};
use crate::element::state::State;
use crate::material::free_energy::{Array, FreeEnergy};
use crate::number::scalar::Real;

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
            let r = member.arms_in(state);
            for point in member.points.as_mut() {
                point.take_derivatives(&r, state);
                let force = point.force(Placement::End, [&r, &r]);
                elements.push(point.generic(&member.site.nodes, &force));
            }
        }
        elements
    }

    /// All elements during the last step, with discrete derivatives in the place of derivatives.
    pub(super) fn generic_of_step_all(&self, ends: [&State<S>; 2]) -> Vec<ElementGeneric<S>> {
        let members = self.members.iter().flat_map(|member| {
            let [r0, r1] = ends.map(|state| member.arms_in(state));
            let points = member.points.as_ref().iter();
            points.map(move |point| {
                let force = point.force(C::PLACEMENT, [&r0, &r1]);
                point.generic(&member.site.nodes, &force)
            })
        });
        members.collect()
    }
}

impl<S, M, K, C, const D: usize> Point<S, M, K, C, D>
where
    S: Real,
    M: FreeEnergy<S> + Send + Sync + 'static,
    K: Kinematics<S, D>,
    C: ElementScheme<S, M>,
{
    /// Derivatives in a state take the place of the response.
    fn take_derivatives(&mut self, r: &Arms<K, S, D>, state: &State<S>) {
        let x = self.variables_in(r, state);
        let gradient = self.model.gradient(&x);
        let theta = x[M::Variables::LEN - 1];
        self.viscosities = self.model.viscosity(theta);
        self.start.x0 = x;
        for index in 0..M::MEASURES + M::DASHPOTS {
            let is_force = index < M::MEASURES;
            let sign = if is_force { S::one() } else { -S::one() };
            self.response[index] = sign * gradient[index];
        }
        if M::THERMAL {
            self.response[M::MEASURES + M::DASHPOTS] = theta;
        }
    }

    /// The present response, with these forces on the nodes.
    fn generic(&self, nodes: &K::PerNode<u32>, force: &K::PerNode<[S; D]>) -> ElementGeneric<S> {
        let nodes = nodes.as_ref().iter().zip(force.as_ref());
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
