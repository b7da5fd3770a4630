//! Nodal areas and volumes, `∫ N_a dA` and `∫ N_a dV`.

use super::Mesh;
use super::face::Face;
use crate::element::kinematics::{Shape, Symmetric, integrals};
use eem_material::number::scalar::Scalar;

impl<H: Shape<D>, const D: usize> Mesh<H, D> {
    /// The area of each node of a face; m², m in the plane.
    pub(crate) fn areas(&self, face: &Face) -> Vec<(usize, f64)> {
        let mut areas = vec![0.0; self.nodes.len()];
        for &[cell, side] in &face.sides {
            let (axis, end) = (side / 2, if side % 2 == 0 { -1.0 } else { 1.0 });
            // The rule of the cell with its points moved to the face, where the weights across sum to 2.
            for (mut place, weight) in integrals::rule::<H, D>() {
                place[axis] = end;
                let (jacobian, functions) = self.jacobian(cell, place);
                let cofactor = H::Tensor::<f64>::cofactor(&jacobian);
                let size = cofactor
                    .iter()
                    .fold(0.0, |size: f64, row| Scalar::hypot(size, row[axis]));
                for (&node, (share, _)) in self.cells[cell].as_ref().iter().zip(&functions) {
                    areas[node] += share * (0.5 * weight * size);
                }
            }
        }
        let of = |&node: &usize| (node, areas[node]);
        face.nodes().iter().map(of).collect()
    }

    /// The volume of each node; m³, m² in the plane.
    pub(crate) fn volumes(&self) -> Vec<f64> {
        let mut volumes = vec![0.0; self.nodes.len()];
        for cell in 0..self.cells.len() {
            for (place, weight) in integrals::rule::<H, D>() {
                let (jacobian, functions) = self.jacobian(cell, place);
                let size = weight * H::Tensor::<f64>::determinant(&jacobian);
                for (&node, (share, _)) in self.cells[cell].as_ref().iter().zip(&functions) {
                    volumes[node] += share * size;
                }
            }
        }
        volumes
    }

    /// `∂X/∂ξ` at a point of the parent cell, with the shape functions.
    fn jacobian(
        &self,
        cell: usize,
        place: [f64; D],
    ) -> ([[f64; D]; D], integrals::Functions<f64, D>) {
        let nodes = self.cells[cell].as_ref().iter();
        let reference: Vec<_> = nodes.map(|&node| self.nodes[node]).collect();
        let functions = integrals::functions::<H, f64, D>(place);
        (integrals::jacobian(&reference, &functions), functions)
    }
}
