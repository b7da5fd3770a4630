//! The initial viscous strain of a solid.

use super::Scene;
use crate::element::handle::Element;
use crate::scene::solid_error::SolidError;
use eem_material::joint::components;
use eem_material::number::scalar::{Mask, Real};

/// # Viscous strains of solids
impl<const D: usize, S: Real> Scene<D, S> {
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
    pub fn set_viscous_strain(&mut self, point: Element, strain: [[S; 3]; 3]) {
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
fn invalid_shear<S: Real>(
    element: Element,
    strain: &[[S; 3]; 3],
    is_plane: bool,
) -> Option<SolidError> {
    [[0, 1], [0, 2], [1, 2]].into_iter().find_map(|[i, j]| {
        let values = [strain[i][j], strain[j][i]];
        let is_symmetric = values[0].equal(values[1]).all();
        let is_out_of_plane = is_plane && j == 2 && !values[0].equal(S::zero()).all();
        (!is_symmetric || is_out_of_plane).then(|| SolidError::ViscousShear {
            element,
            place: [i, j],
            values: values.map(Real::to_f64),
            is_plane,
        })
    })
}
