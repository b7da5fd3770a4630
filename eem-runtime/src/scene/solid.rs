//! Solids of a scene.

use super::Scene;
use crate::element::handle::{Element, Node};
use crate::element::kinematics::{Quad4, StrainEnergy};
use crate::material::free_energy::FreeEnergy;
use crate::number::scalar::Real;
use crate::scene::cell::Stuff;

/// What a solid in the plane is besides its material and its corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section<S = f64> {
    /// ρ, kg/m³.
    pub density: S,
    /// Out of the plane, m.
    pub thickness: S,
}

/// # Nodes of solids
impl<const D: usize, S: Real> Scene<D, S> {
    /// A node that moves and has no mass of its own: solids give it theirs. Position in m, velocity in m/s.
    pub fn node(&mut self, position: [S; D], velocity: [S; D]) -> Node {
        self.push_node(Some(S::zero()), position, velocity)
    }

    /// Replaces the initial position of a node, m. Solids keep the shape that they were created with,
    /// so that they start deformed.
    pub fn set_position(&mut self, node: Node, position: [S; D]) {
        if self.expect_own(&node) {
            self.nodes[node.index].position = position.into();
        }
    }
}

/// # Solids in the plane
impl<S: Real> Scene<2, S> {
    /// A quadrilateral of a solid in plane strain, whose corners are nodes, against the clock; returns its
    /// points, at each of which the free energy per volume is evaluated, the first coordinate fastest.
    ///
    /// Where the nodes are now it is free of strain. A point has a temperature and viscous strains of its
    /// own, and handles of points are what [`conduct`](Self::conduct) and
    /// [`set_temperature`](Self::set_temperature) take. Its mass is consistent, `∫ ρ N_a N_b dV`: it
    /// couples nodes, so that [`Scheme::EemEntropy`](crate::Scheme::EemEntropy),
    /// [`EemTemperature`](crate::Scheme::EemTemperature),
    /// [`Staggered`](crate::Scheme::Staggered) and the midpoint and trapezoidal rules can step it.
    /// Corners may be anchors; those stay where they are.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// /// Saint-Venant and Kirchhoff.
    /// #[derive(Clone, FreeEnergy)]
    /// #[free_energy(|e1: StrainTrace, e2: StrainSquare| 0.5 * lame * e1.powi(2) + shear * e2)]
    /// struct Elastic {
    ///     lame: f64,
    ///     shear: f64,
    /// }
    ///
    /// let mut scene = Scene::<2>::new();
    /// let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
    /// let nodes = corners.map(|corner| scene.node(corner, [-corner[1], corner[0]]));
    /// let steel = Elastic { lame: 2000.0, shear: 1000.0 };
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
