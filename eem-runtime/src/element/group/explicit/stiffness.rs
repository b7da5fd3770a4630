//! Stiffness, heat capacity and relaxation rates of elements, which limit an explicit step.

use crate::element::conjugates::PointRule;
use crate::element::group::explicit::group::ExplicitElements;
use crate::element::group::explicit::view::NodeStiffness;
use crate::element::group::point::Point;
use crate::element::kinematics::Kinematics;
use crate::element::state::State;
use eem_material::free_energy::Material;
use eem_material::number::scalar::Scalar;

impl<M: Material, K: Kinematics<D>, const D: usize> ExplicitElements<M, K, D> {
    /// See [`ExplicitGroup::stiffness`](super::ExplicitGroup::stiffness).
    #[cold]
    pub(super) fn stiffness_of_all(&self, state: &State, see: &mut dyn FnMut(NodeStiffness)) {
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

impl<M: Material, K: Kinematics<D>, const D: usize> Point<M, K, PointRule, D> {
    /// The larger of `∂²e/∂λ² = ψ_λλ − ψ_λθ²/ψ_θθ`, along the element at constant entropy, and `f/λ`, across it.
    fn stiffness_at(&self, x: &M::Variables, nodes: [usize; 2]) -> NodeStiffness {
        let (gradient, hessian) = self.model.hessian(x);
        let mut stiffness = hessian[0][0];
        let mut capacity = None;
        let mut theta = 0.0;
        if let Some(slot) = self.slots().thermal {
            let last = Self::TEMPERATURE;
            theta = x[last];
            let by_theta = hessian[last][0];
            stiffness -= by_theta * by_theta / hessian[last][last];
            capacity = Some((slot, -theta * hessian[last][last]));
        }
        let across = (gradient[0] / x[0]).abs();
        let (viscosities, _) = self.model.viscosity(theta);
        let mut relaxation = 0.0;
        for k in 0..M::DASHPOTS {
            let index = M::MEASURES + k;
            relaxation = Scalar::maximum(relaxation, hessian[index][index].abs() / viscosities[k]);
        }
        NodeStiffness {
            nodes,
            stiffness: Scalar::maximum(stiffness.abs(), across),
            capacity,
            relaxation,
        }
    }
}
