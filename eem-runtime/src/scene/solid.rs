//! Solids of a scene.

use super::Scene;
use crate::element::handle::{Element, Node};
use crate::element::kinematics::{Quad4, StrainEnergy};
use crate::scene::cell::Stuff;
use eem_material::free_energy::FreeEnergy;
use eem_material::number::scalar::Real;

/// The properties of a quadrilateral besides its material and corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section<S = f64> {
    /// ρ, kg/m³.
    pub density: S,
    /// Thickness out of the plane, m.
    pub thickness: S,
}

/// # Nodes of solids
impl<const D: usize, S: Real> Scene<D, S> {
    /// A node that moves and gets its mass from solids. Position in m, velocity in m/s.
    pub fn node(&mut self, position: [S; D], velocity: [S; D]) -> Node {
        self.push_node(Some(S::zero()), position, velocity)
    }

    /// Sets the initial position of a node, m. Solids keep their reference shape, so they start deformed.
    pub fn set_position(&mut self, node: Node, position: [S; D]) {
        if self.expect_own(&node) {
            self.nodes[node.index].position = position.into();
        }
    }
}

/// # Solids in the plane
impl<S: Real> Scene<2, S> {
    /// A quadrilateral of a solid in plane strain with four nodes as corners, counterclockwise. Returns its
    /// integration points; the first coordinate varies fastest.
    ///
    /// The present positions of the nodes are the strain-free shape. Each point has its own temperature and viscous
    /// strains; its handle is for [`conduct`](Self::conduct), [`set_temperature`](Self::set_temperature) and
    /// others. The mass is consistent, `∫ ρ N_a N_b dV`, so it couples nodes:
    /// [`Scheme::EemEntropy`](crate::Scheme::EemEntropy), [`EemTemperature`](crate::Scheme::EemTemperature),
    /// [`Staggered`](crate::Scheme::Staggered) and the midpoint and trapezoidal rules can step it. Corners may be
    /// anchors.
    ///
    /// ```
    /// use eem::materials::SaintVenantKirchhoff;
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<2>::new();
    /// let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
    /// let nodes = corners.map(|corner| scene.node(corner, [-corner[1], corner[0]]));
    /// let steel = SaintVenantKirchhoff { lame: 2000.0, shear: 1000.0 };
    /// let section = Section { density: 10.0, thickness: 1.0 };
    /// scene.quadrilateral(steel, nodes, section);
    ///
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// let before = run.ledger();
    /// assert!((before.kinetic_energy - 0.5 * 20.0 * 5.0 / 3.0).abs() < 1e-12);
    /// for _ in 0..10 {
    ///     run.step()?;
    /// }
    /// let after = run.ledger();
    /// assert!((after.balance - before.balance).abs() < 1e-13 * before.energy);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[expect(clippy::needless_pass_by_value, reason = "as for a spring")]
    pub fn quadrilateral<M, const N: usize>(
        &mut self,
        model: M,
        nodes: [Node; 4],
        section: Section<S>,
    ) -> [Element; 4]
    where
        M: FreeEnergy<S> + StrainEnergy<N> + Send + Sync + 'static,
    {
        let Section { density, thickness } = section;
        let stuff = Stuff {
            density,
            thickness,
            fibres: &[],
            lumped: false,
            is_refused: false,
        };
        self.push_cell::<Quad4, M, N>(&model, &nodes, stuff)
    }
}
