//! Stiffness, heat capacity and relaxation rates of elements, which limit an explicit step.

use crate::element::conjugates::PointRule;
use crate::element::group::explicit::group::ExplicitElements;
use crate::element::group::explicit::view::NodeStiffness;
use crate::element::group::point::Point;
use crate::element::kinematics::Kinematics;
use crate::element::state::State;
use eem_material::free_energy::Material;
use eem_material::number::scalar::Real;

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, const D: usize> ExplicitElements<S, M, K, D> {
    /// See [`ExplicitGroup::stiffness`](super::ExplicitGroup::stiffness).
    #[cold]
    pub(super) fn stiffness_of_all(&self, state: &State<S>, see: &mut dyn FnMut(NodeStiffness<S>)) {
        for member in &self.elements.members {
            let nodes = member.site.nodes.as_ref();
            let r = member.arms_in(state);
            let point = member.only();
            let x = point.variables_in(&r, state);
            let ends = [nodes[0], nodes[nodes.len() - 1]].map(|node| node as usize);
            see(point.stiffness_at(&x, ends));
        }
    }
}

impl<S: Real, M: Material<S>, K: Kinematics<S, D>, const D: usize> Point<S, M, K, PointRule, D> {
    /// The larger of `∂²e/∂λ² = ψ_λλ − ψ_λθ²/ψ_θθ`, along the element at constant entropy, and `f/λ`, across it.
    fn stiffness_at(&self, x: &M::Variables, nodes: [usize; 2]) -> NodeStiffness<S> {
        let (gradient, hessian) = self.model.hessian(x);
        let mut stiffness = hessian[0][0];
        let mut capacity = None;
        let mut theta = S::zero();
        if let Some(slot) = self.slots().thermal {
            let last = Self::TEMPERATURE;
            theta = x[last];
            let by_theta = hessian[last][0];
            stiffness -= by_theta * by_theta / hessian[last][last];
            capacity = Some((slot, -theta * hessian[last][last]));
        }
        let across = (gradient[0] / x[0]).abs();
        let (viscosities, _) = self.model.viscosity(theta);
        let mut relaxation = S::zero();
        for k in 0..M::DASHPOTS {
            let index = M::MEASURES + k;
            relaxation = relaxation.maximum(hessian[index][index].abs() / viscosities[k]);
        }
        NodeStiffness {
            nodes,
            stiffness: stiffness.abs().maximum(across),
            capacity,
            relaxation,
        }
    }
}
