//! Heat conduction in solids, between them, and through their surface.

use std::collections::BTreeMap;

use super::Scene;
use crate::element::handle::Reservoir;
use crate::element::kinematics::Shape;
use crate::scene::bulk::Body;
use crate::scene::error::SceneError;
use crate::scene::solid_error::SolidError;
use eem_material::number::scalar::is_positive;
use eem_mesh::{Face, facing};

/// # Heat of solids
impl<const D: usize> Scene<D> {
    /// Conducts heat between two solids across the cell faces they share, that is, faces with all nodes in common,
    /// as made by [`Bulk::joined_to`](crate::Bulk::joined_to). There is no contact resistance.
    ///
    /// ```text
    /// κ = t_a t_b/(t_a + t_b),   t = k |A·d|/d²     per pair of points, d from a point's centre to the face
    /// ```
    ///
    /// Both solids need a conductivity, W/(m K), and cells of the same shape. Calling this twice for the same two
    /// solids doubles the conductance.
    ///
    /// ```
    /// use eem::materials::ThermoelasticSolid;
    /// use eem::prelude::*;
    ///
    /// let solid = ThermoelasticSolid { softening: 0.0, expansion: 0.0, ..ThermoelasticSolid::RUBBER };
    /// let mut scene = Scene::<3>::new();
    /// let warm = Mesh::<Hex8, 3>::block([1; 3], [[0.0, 1.0]; 3])?;
    /// let cold = warm.translated([1.0, 0.0, 0.0])?;
    /// let warm = scene.solid(solid.clone(), &warm, &Bulk::new(10.0).conductivity(30.0));
    /// let bulk = Bulk::new(10.0).conductivity(10.0).joined_to(&warm, 1e-9);
    /// let cold = scene.solid(solid, &cold, &bulk);
    /// scene.conduct_between(&warm, &cold);
    /// scene.set_temperatures(&warm, 310.0);
    /// scene.set_temperatures(&cold, 290.0);
    ///
    /// let mut run = Simulation::new(scene, Scheme::EemTemperature, 1e-5)?;
    /// run.step()?;
    /// // Each quarter of the face has 0.25 m², and its points are 0.25 m away: t = k · 1 m, and
    /// // κ = 30 · 10/(30 + 10) W/K = 7.5 W/K. It passes 7.5 · 20 W, from 12.5 J/K each.
    /// let fall = 310.0 - run.temperature(warm.points()[1])?;
    /// assert!((fall - 150.0 * 1e-5 / 12.5).abs() < 1e-8);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Simulation::new`](crate::Simulation::new) returns [`SolidError::NoSharedFace`] or
    /// [`SolidError::NoConductivity`].
    pub fn conduct_between<H: Shape<D>>(&mut self, first: &Body<H, D>, second: &Body<H, D>) {
        let elements = [first.first(), second.first()];
        if !elements.iter().all(|element| self.plan.expect_own(element)) {
            return;
        }
        let [element, other] = elements;
        if element == other {
            return self.plan.refuse(SceneError::SelfConduction { element });
        }
        let (Some(one), Some(other)) = (first.conductivity, second.conductivity) else {
            let is_insulated = [first.conductivity.is_none(), second.conductivity.is_none()];
            for (element, is_insulated) in elements.into_iter().zip(is_insulated) {
                if is_insulated {
                    self.plan.refuse(SolidError::NoConductivity { element });
                }
            }
            return;
        };
        let sides = shared_sides(first, second);
        if sides.is_empty() {
            self.plan.refuse(SolidError::NoSharedFace { elements });
        }
        for [near, far] in sides {
            let near = first.mesh().sub_faces_of(near);
            for [a, b] in facing(near, &second.mesh().sub_faces_of(far)) {
                let t_a = one * first.thickness * a.shape_factor;
                let t_b = other * second.thickness * b.shape_factor;
                let [a, b] = [first.points()[a.point], second.points()[b.point]];
                self.conduct(a, b, t_a * t_b / (t_a + t_b));
            }
        }
    }

    /// Conducts heat between some faces of a solid and a reservoir, through a film with the coefficient α, W/(m²
    /// K), and half of the cell behind it.
    ///
    /// ```text
    /// 1/κ = 1/(α |A|) + 1/t,   t = k |A·d|/d²     per point, d from its centre to the surface
    /// ```
    ///
    /// The solid needs a conductivity, [`Bulk::conductivity`](crate::Bulk::conductivity).
    ///
    /// ```
    /// use eem::materials::ThermoelasticSolid;
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<3>::new();
    /// let mesh = Mesh::<Hex8, 3>::block([1; 3], [[0.0, 1.0]; 3])?;
    /// let body = scene.solid(ThermoelasticSolid::RUBBER, &mesh, &Bulk::new(10.0).conductivity(10.0));
    /// scene.set_temperatures(&body, 300.0);
    /// let (air, water) = (scene.reservoir(320.0), scene.reservoir(320.0));
    /// scene.exchange(&body, &mesh.face(|[x, ..]| x >= 1.0)?, air, 5.0);
    /// scene.wall(&body, &mesh.face(|[x, ..]| x <= 0.0)?, water);
    ///
    /// let mut run = Simulation::new(scene, Scheme::EemTemperature, 1e-5)?;
    /// run.step()?;
    /// // Four points, each with t = 10 W/K behind a film of 5 · 0.25 W/K, and 20 K; no film at the wall.
    /// let film = 4.0 * 20.0 / (1.0 / 1.25 + 1.0 / 10.0);
    /// assert!((-run.reservoir_heat(air)? / 1e-5 - film).abs() < 1e-4 * film);
    /// assert!((-run.reservoir_heat(water)? / 1e-5 - 800.0).abs() < 1e-4 * 800.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Simulation::new`](crate::Simulation::new) returns [`SolidError::NoConductivity`],
    /// [`SolidError::ForeignFace`], or [`SolidError::Section`] if α is not positive.
    pub fn exchange<H: Shape<D>>(
        &mut self,
        body: &Body<H, D>,
        face: &Face,
        reservoir: Reservoir,
        film: f64,
    ) {
        if !is_positive(film) {
            let error = SolidError::section(body.first(), "film coefficient", film, "W/(m^2 K)");
            return self.plan.refuse(error);
        }
        self.connect(body, face, reservoir, |area, t| {
            (film * area * t) / (film * area + t)
        });
    }

    /// Conducts heat between some faces of a solid and a wall with the temperature of a reservoir.
    ///
    /// ```text
    /// κ = t = k |A·d|/d²     per point, d from its centre to the surface
    /// ```
    ///
    /// The solid needs a conductivity, [`Bulk::conductivity`](crate::Bulk::conductivity). For an example see
    /// [`exchange`](Self::exchange).
    ///
    /// # Errors
    ///
    /// [`Simulation::new`](crate::Simulation::new) returns [`SolidError::NoConductivity`],
    /// [`SolidError::ForeignFace`].
    pub fn wall<H: Shape<D>>(&mut self, body: &Body<H, D>, face: &Face, reservoir: Reservoir) {
        self.connect(body, face, reservoir, |_, t| t);
    }

    /// Conducts heat between a face and a reservoir, with the conductance of each point from its area and `t`.
    fn connect<H: Shape<D>>(
        &mut self,
        body: &Body<H, D>,
        face: &Face,
        reservoir: Reservoir,
        conductance: impl Fn(f64, f64) -> f64,
    ) {
        let element = body.first();
        let Some(conductivity) = body.conductivity else {
            return self.plan.refuse(SolidError::NoConductivity { element });
        };
        if !body.mesh().has(face) {
            return self.plan.refuse(SolidError::ForeignFace { element });
        }
        for face in body.mesh().outside(face) {
            let area = body.thickness * face.area;
            let t = conductivity * (body.thickness * face.shape_factor);
            let conductance = conductance(area, t);
            self.conduct(body.points()[face.point], reservoir, conductance);
        }
    }

    /// Conducts heat between the points of a solid; an error if its cells are too skew.
    pub(super) fn conduct_in<H: Shape<D>>(&mut self, body: &Body<H, D>, allow_skew_cells: bool) {
        let element = body.first();
        let Some(conductivity) = body.conductivity else {
            return;
        };
        if !is_positive(conductivity) {
            let error = SolidError::section(element, "conductivity", conductivity, "W/(m K)");
            return self.plan.refuse(error);
        }
        let (links, skewness) = body.mesh().network();
        if skewness.is_too_much() && !allow_skew_cells {
            self.plan.refuse(SolidError::SkewCells {
                element,
                skew: skewness.skew,
                faces: skewness.faces,
                cosine: skewness.cosine,
                cell: skewness.cell,
            });
        }
        for (pair, shape_factor) in links {
            let [first, second] = pair.map(|point| body.points()[point]);
            let conductance = conductivity * body.thickness * shape_factor;
            self.conduct(first, second, conductance);
        }
    }
}

/// The faces of the surfaces of two solids that have the same nodes.
fn shared_sides<H: Shape<D>, const D: usize>(
    first: &Body<H, D>,
    second: &Body<H, D>,
) -> Vec<[[usize; 2]; 2]> {
    let key = |body: &Body<H, D>, side| {
        let nodes = body.mesh().nodes_of(side);
        let mut nodes: Vec<_> = nodes.map(|node| body.nodes()[node].index).collect();
        nodes.sort_unstable();
        nodes
    };
    let far = second.mesh().surface().into_iter();
    let far: BTreeMap<Vec<usize>, [usize; 2]> = far.map(|side| (key(second, side), side)).collect();
    let near = first.mesh().surface().into_iter();
    let pairs = near.filter_map(|side| Some([side, *far.get(&key(first, side))?]));
    pairs.collect()
}
