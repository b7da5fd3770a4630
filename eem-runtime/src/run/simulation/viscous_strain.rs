//! The viscous strain of a solid.

use core::array;

use nalgebra::SMatrix;

use super::Simulation;
use crate::element::handle::Element;
use crate::scene::error::SceneError;
use crate::scene::solid_error::SolidError;
use eem_material::joint::{COMPONENTS, tensor};
use eem_material::number::scalar::Real;

impl<const D: usize, S: Real> Simulation<D, S> {
    /// The viscous strain Γ at a point of a solid. It has three dimensions also in plane strain, where Γ₃₃ flows
    /// too.
    ///
    /// # Errors
    ///
    /// For a foreign handle; [`SolidError::NoViscousStrain`] unless an argument of the free energy has the role
    /// `ViscousStrain`.
    ///
    /// ```
    /// use eem::kinematics::Quad4;
    /// use eem::prelude::*;
    ///
    /// #[derive(Clone, FreeEnergy)]
    /// #[free_energy(|e2: StrainSquare, m3: ViscousStrain, m2: ViscousSquare| {
    ///     shear * e2 + branch * (e2 - 2 * m3 + m2)
    /// })]
    /// #[viscosity(m3 = eta)]
    /// struct Relaxing { shear: f64, branch: f64, eta: f64 }
    ///
    /// let mut scene = Scene::<2>::new();
    /// let mesh = Mesh::<Quad4, 2>::block([1, 1], [[0.0, 1.0], [0.0, 1.0]])?;
    /// let material = Relaxing { shear: 1.0, branch: 2.0, eta: 4.0 };
    /// let plate = scene.solid(material, &mesh, &Bulk::new(10.0));
    /// // Held at E₁₁ = 3/2, with dev E = (1, −½, −½): Γ follows it with the time η/(2 branch) = 1 s.
    /// for (&node, [x, y]) in plate.nodes().iter().zip(mesh.nodes()) {
    ///     scene.set_position(node, [2.0 * x, *y]);
    ///     scene.fix(node);
    /// }
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 40.0)?;
    /// run.step()?;
    /// // Γ¹ = h (dev E − ½Γ¹)
    /// let strain = run.viscous_strain(plate.points()[0])?;
    /// assert!((strain[(0, 0)] - 40.0 / 21.0).abs() < 1e-14);
    /// assert!((strain[(2, 2)] + 20.0 / 21.0).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn viscous_strain(&self, point: Element) -> Result<SMatrix<S, 3, 3>, SceneError> {
        self.expect_own(&point)?;
        let [group, _] = self.place(point);
        let shape = self.shapes[group];
        if shape.viscous_strain == 0 {
            return Err(SolidError::NoViscousStrain { element: point }.into());
        }
        let first = self.slots(point).viscous + shape.scalar_dashpots();
        let values = &self.state.viscous.values()[first..];
        let components: [S; COMPONENTS] = array::from_fn(|k| {
            if k < shape.viscous_strain {
                values[k]
            } else {
                S::zero()
            }
        });
        let strain = tensor(&components);
        Ok(SMatrix::from_fn(|row, column| strain[row][column]))
    }
}
