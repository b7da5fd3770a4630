//! Solids of a scene: nodes, quadrilaterals, viscous strains.

use super::Scene;
use crate::element::handle::{Element, Node};
use crate::element::kinematics::{Quad4, StrainEnergy};
use crate::scene::cell::CellProperties;
use crate::scene::solid_error::SolidError;
use eem_material::free_energy::FreeEnergy;
use eem_material::joint::components;

/// The properties of a quadrilateral besides its material and corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// ρ, kg/m³.
    pub density: f64,
    /// Thickness out of the plane, m.
    pub thickness: f64,
}

/// # Nodes of solids
impl<const D: usize> Scene<D> {
    /// A node that moves and gets its mass from solids. Position in m, velocity in m/s.
    pub fn node(&mut self, position: [f64; D], velocity: [f64; D]) -> Node {
        self.push_node(Some(0.0), position, velocity)
    }

    /// Sets the initial position of a node, m. Solids keep their reference shape, so they start deformed.
    pub fn set_position(&mut self, node: Node, position: [f64; D]) {
        if self.expect_own(&node) {
            self.nodes[node.index].position = position.into();
        }
    }
}

/// # Solids in the plane
impl Scene<2> {
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
        section: Section,
    ) -> [Element; 4]
    where
        M: FreeEnergy<f64> + StrainEnergy<N> + Send + Sync + 'static,
    {
        let Section { density, thickness } = section;
        let properties = CellProperties {
            density,
            thickness,
            fibres: &[],
            lumped: false,
            is_invalid: false,
        };
        self.push_cell::<Quad4, M, N>(&model, &nodes, properties)
    }
}

/// # Viscous strains of solids
impl<const D: usize> Scene<D> {
    /// The initial viscous strain Γ at a point of a solid; zero by default. Only its symmetric part counts and,
    /// without a volumetric viscosity, only its deviator.
    ///
    /// The free energy needs an argument with the role `ViscousStrain`; otherwise the error is
    /// [`SolidError::NoViscousStrain`].
    ///
    /// ```
    /// use eem::kinematics::Hex8;
    /// use eem::prelude::*;
    ///
    /// #[derive(Clone, FreeEnergy)]
    /// #[free_energy(|e2: StrainSquare, m3: ViscousStrain, m2: ViscousSquare| 3.0 * (e2 - 2 * m3 + m2))]
    /// #[viscosity(m3 = 5.0)]
    /// struct Fluid;
    ///
    /// let mut scene = Scene::<3>::new();
    /// let mesh = Mesh::<Hex8, 3>::block([1; 3], [[0.0, 1.0]; 3])?;
    /// let block = scene.solid(Fluid, &mesh, &Bulk::new(10.0));
    /// let point = block.points()[0];
    /// scene.set_viscous_strain(point, [[0.4, 0.1, 0.0], [0.1, 0.2, 0.0], [0.0, 0.0, 0.0]]);
    /// let run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// let strain = run.viscous_strain(point)?;
    /// assert!((strain[(0, 0)] - 0.2_f64).abs() < 1e-15 && (strain[(2, 2)] + 0.2).abs() < 1e-15);
    /// assert!((strain[(1, 0)] - 0.1).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_viscous_strain(&mut self, point: Element, strain: [[f64; 3]; 3]) {
        if !self.expect_own(&point) {
            return;
        }
        let entry = &self.elements[point.index()];
        // An invalid solid is already an error.
        let Some(group) = self.groups.get(entry.group) else {
            return;
        };
        let shape = group.shape();
        if shape.viscous_strain == 0 {
            self.refuse(SolidError::NoViscousStrain { element: point });
        }
        if let Some(error) = invalid_shear(point, &strain, D == 2) {
            return self.refuse(error);
        }
        let components = components(&strain).into_iter().take(shape.viscous_strain);
        let entry = &mut self.elements[point.index()];
        entry
            .viscous_stretches
            .extend((shape.scalar_dashpots()..).zip(components));
    }
}

/// The error of a tensor that is not symmetric or, in plane strain, has shear out of the plane.
fn invalid_shear(element: Element, strain: &[[f64; 3]; 3], is_plane: bool) -> Option<SolidError> {
    [[0, 1], [0, 2], [1, 2]].into_iter().find_map(|[i, j]| {
        let values = [strain[i][j], strain[j][i]];
        #[expect(clippy::float_cmp, reason = "a tensor is symmetric to the last bit")]
        let is_symmetric = values[0] == values[1];
        let is_out_of_plane = is_plane && j == 2 && values[0] != 0.0;
        (!is_symmetric || is_out_of_plane).then_some(SolidError::ViscousShear {
            element,
            place: [i, j],
            values,
            is_plane,
        })
    })
}
