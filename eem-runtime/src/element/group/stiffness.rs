//! Stiffness, damping, heat capacity and relaxation rates of a point: what limits an explicit step, and from what the scales
//! of small errors follow.

use core::ops::Range;

use crate::element::kinematics::{MeasureSet, Numbers};
use crate::element::layout::Slots;
use eem_material::arrays::Arrays;
use eem_material::number::scalar::Scalar;
use eem_material::tabled::Tabled;

/// Stiffness and rates of a point.
#[derive(Clone, Debug)]
pub(crate) struct Stiffness<'a> {
    /// The nodes of its element.
    pub(crate) nodes: &'a [u32],
    /// The stiffness between them at constant entropy and viscous stretch, N/m.
    pub(crate) elastic: f64,
    /// The same at constant temperature.
    pub(crate) isothermal: f64,
    /// The viscosity of its dashpots in parallel, N s/m.
    pub(crate) damping: f64,
    /// The displacement that changes its gradients by their own size: the length of a spring, m.
    pub(crate) length: f64,
    /// The terms of its force, `|∂²ψ/∂π²||π|`: times ε, their rounding, N.
    pub(crate) force: f64,
    /// The thermal slot and its heat capacity, J/K.
    pub(crate) capacity: Option<(usize, f64)>,
    /// Its dashpots among those of all elements.
    pub(crate) dashpots: Range<usize>,
    /// How much the force of one of them changes with a displacement of a node, per length, and the terms `Σ |∂²ψ/∂γ²||γ|` of it.
    pub(crate) pull: [f64; 2],
    /// The largest rate of relaxation of a dashpot, 1/s.
    pub(crate) relaxation: f64,
    /// Whether it is a spring with dashpots in series, whose unknowns are lengths.
    pub(crate) has_viscous_stretch: bool,
}

impl Stiffness<'_> {
    /// The first and the last node, both of a spring.
    pub(crate) fn ends(&self) -> [usize; 2] {
        [self.nodes[0], self.nodes[self.nodes.len() - 1]].map(|node| node as usize)
    }
}

/// The larger of `Σ |∂π_a/∂r| |∂²e/∂π_a∂π_b| |∂π_b/∂r|`, along the measures at constant entropy, and `Σ |f_a||∂π_a/∂r|/l`, across
/// them; `∂²e/∂π_a∂π_b = ψ_ab − ψ_aθ ψ_bθ/ψ_θθ`. Of the measures, length, slopes and sizes are given.
pub(super) fn stiffness_of<'a, A: Arrays, Q: MeasureSet>(
    (model, nodes, slots): (&Tabled<A>, &'a [u32], Slots),
    x: &A::Variables,
    (length, slopes, sizes): (f64, &Numbers<Q>, &Numbers<Q>),
) -> Stiffness<'a> {
    let (gradient, hessian) = model.hessian(x);
    let last = A::MEASURES + A::DASHPOTS;
    let [mut along, mut isothermal, mut across, mut force] = [0.0; 4];
    for a in 0..A::MEASURES {
        for b in 0..A::MEASURES {
            let mut entry = hessian[a][b];
            force += slopes[a] * (entry.abs() * sizes[b]);
            isothermal += slopes[a] * entry.abs() * slopes[b];
            if model.is_thermal() {
                entry -= hessian[last][a] * hessian[last][b] / hessian[last][last];
            }
            along += slopes[a] * entry.abs() * slopes[b];
        }
        across += (gradient[a] / length).abs() * slopes[a];
    }
    let mut pull = [0.0; 2];
    for row in (A::MEASURES..last).map(|row| &hessian[row]) {
        let by_nodes = (0..A::MEASURES).fold(0.0, |sum, a| sum + row[a].abs() * slopes[a]);
        let own = (A::MEASURES..last).fold(0.0, |sum, k| sum + (row[k] * x[k]).abs());
        pull[0] = Scalar::maximum(pull[0], by_nodes);
        pull[1] = Scalar::maximum(pull[1], own);
    }
    let theta = if model.is_thermal() { x[last] } else { 0.0 };
    let capacity = slots
        .thermal
        .map(|slot| (slot, -theta * hessian[last][last]));
    let (viscosities, _) = model.viscosity(theta);
    let relaxation = (0..model.dashpots()).fold(0.0, |most, k| {
        let index = A::MEASURES + k;
        Scalar::maximum(most, hessian[index][index].abs() / viscosities[k])
    });
    let (drags, _) = model.drag(theta);
    let drags = drags.as_ref().iter().enumerate();
    Stiffness {
        nodes,
        elastic: Scalar::maximum(along, across),
        isothermal: Scalar::maximum(isothermal, across),
        damping: drags.fold(0.0, |sum, (a, &drag)| sum + drag * slopes[a] * slopes[a]),
        length,
        force,
        capacity,
        dashpots: slots.viscous..slots.viscous + model.dashpots(),
        pull,
        relaxation,
        has_viscous_stretch: Q::IS_SPRING && model.dashpots() > 0,
    }
}
