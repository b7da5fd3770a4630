//! Loads of solids: tractions and body forces.

use std::sync::Arc;

use super::Scene;
use crate::element::handle::Node;
use crate::element::kinematics::Shape;
use crate::scene::body::Body;
use crate::scene::mesh::Face;
use crate::scene::solid_error::SolidError;
use eem_material::number::scalar::Real;

/// A force per area or volume as a function of time.
type Density<S, const D: usize> = Arc<dyn Fn(S) -> [S; D] + Send + Sync>;

/// # Loads of solids
impl<const D: usize, S: Real> Scene<D, S> {
    /// A traction on some faces of a solid, N/m² of the reference configuration, as a function of time. Its
    /// direction does not follow the body. The ledger counts its work. It has no effect on fixed nodes.
    ///
    /// ```
    /// use eem::kinematics::Hex8;
    /// use eem::materials::SaintVenantKirchhoff;
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<3>::new();
    /// let steel = SaintVenantKirchhoff { lame: 2000.0, shear: 1000.0 };
    /// let mesh = Mesh::<Hex8, 3>::block([2, 1, 1], [[0.0, 2.0], [0.0, 1.0], [0.0, 1.0]])?;
    /// let beam = scene.solid(steel, &mesh, &Bulk::new(10.0));
    /// let end = mesh.face(|[x, ..]| x >= 2.0)?;
    /// scene.traction(&beam, &end, |t| [0.0, 0.0, 5.0 * t]);
    ///
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// run.step()?;
    /// // 0.25 N in the middle of the step, on 1 m², for 0.1 s.
    /// assert!((run.ledger().linear_momentum[2] - 0.025).abs() < 1e-16);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn traction<H: Shape<D>>(
        &mut self,
        body: &Body<H, D>,
        face: &Face,
        traction: impl Fn(S) -> [S; D] + Send + Sync + 'static,
    ) {
        if !body.mesh().has(face) {
            let element = body.first();
            return self.refuse(SolidError::ForeignFace { element });
        }
        let shares = body.mesh().areas(face).into_iter();
        let shares = shares.map(|(node, area)| (body.nodes()[node], body.thickness * area));
        self.distribute(shares.collect(), &(Arc::new(traction) as _));
    }

    /// A force per reference volume, N/m³, as a function of time. The ledger counts its work. It has no effect on
    /// fixed nodes. For weight use [`set_gravity`](Self::set_gravity).
    ///
    /// ```
    /// use eem::kinematics::Quad8;
    /// use eem::materials::SaintVenantKirchhoff;
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<2>::new();
    /// let steel = SaintVenantKirchhoff { lame: 2000.0, shear: 1000.0 };
    /// let mesh = Mesh::<Quad8, 2>::block([1, 1], [[0.0, 2.0], [0.0, 1.0]])?;
    /// let plate = scene.solid(steel, &mesh, &Bulk::new(10.0).thickness(0.5));
    /// scene.body_force(&plate, |_| [3.0, 0.0]);
    ///
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// run.step()?;
    /// // 3 N on 1 m³ for 0.1 s, on all of its 10 kg alike.
    /// assert!((run.ledger().linear_momentum[0] - 0.3).abs() < 1e-15);
    /// assert!((run.velocity(plate.nodes()[0])?[0] - 0.03).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn body_force<H: Shape<D>>(
        &mut self,
        body: &Body<H, D>,
        force: impl Fn(S) -> [S; D] + Send + Sync + 'static,
    ) {
        let shares = body.nodes().iter().zip(body.mesh().volumes());
        let shares = shares.map(|(&node, volume)| (node, body.thickness * volume));
        self.distribute(shares.collect(), &(Arc::new(force) as _));
    }

    /// Loads the nodes, except anchors, with their shares of the area or volume.
    fn distribute(&mut self, shares: Vec<(Node, f64)>, density: &Density<S, D>) {
        for (node, share) in shares {
            let own = self.expect_own(&node);
            if own && self.nodes[node.index].mass.is_some() {
                let (density, share) = (Arc::clone(density), S::from_f64(share));
                self.force(node, move |time| density(time).map(|force| share * force));
            }
        }
    }
}
