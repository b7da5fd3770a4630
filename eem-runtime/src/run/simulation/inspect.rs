//! Queries of the present state.

use nalgebra::{SMatrix, SVector};

use super::Simulation;
use super::stepper::Stepper;
use crate::element::conduction::Partner;
use crate::element::group::ElementView;
use crate::element::handle::{Element, Node, Reservoir, SceneId};
use crate::element::kinematics::SolidState;
use crate::element::loads::point;
use crate::run::ledger::Ledger;
use crate::scene::error::SceneError;
use crate::scene::solid_error::SolidError;
use crate::step::control::length;
use crate::step::newton::StepReport;
use crate::step::outcome::Corrections;
use crate::step::scheme::Scheme;
use eem_material::joint::{COMPONENTS, tensor};
use eem_material::number::compensated::Compensated;
use eem_material::number::scalar::Scalar;

/// # The present state
///
/// All functions return [`SceneError::ForeignHandle`] for a handle of another scene.
impl<const D: usize> Simulation<D> {
    /// The time, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.run.state.time.value
    }

    /// The scheme.
    #[must_use]
    pub const fn scheme(&self) -> Scheme {
        self.run.scheme
    }

    /// The scheme of the next step; it differs from [`scheme`](Self::scheme) for [`Scheme::Auto`].
    #[must_use]
    pub const fn scheme_in_use(&self) -> Scheme {
        self.run.in_use
    }

    /// Number of unknowns of the linear system in a Newton iteration; 0 for the explicit scheme.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        match self.stepper() {
            Stepper::Newton(newton) => newton.solver.sets() * self.run.layout.unknowns,
            Stepper::Explicit(_) => 0,
        }
    }

    /// The step so far with the largest `|defect|/bound`. `None` before the first step and after
    /// [`restore`](Self::restore).
    #[must_use]
    pub const fn worst_step(&self) -> Option<&StepReport> {
        self.run.worst.as_ref()
    }

    /// The energy corrections of all steps so far; zero unless the scheme is explicit. [`restore`](Self::restore)
    /// resets them.
    #[must_use]
    pub const fn corrections(&self) -> &Corrections {
        &self.run.corrections
    }

    /// The position of a node, m.
    ///
    /// # Errors
    ///
    /// For a foreign handle.
    pub fn position(&self, node: Node) -> Result<SVector<f64, D>, SceneError> {
        self.run.expect_own(&node)?;
        Ok(point(self.run.state.positions.values(), node.index).into())
    }

    /// The momentum of a node, kg m/s. Zero for an anchor, unless it is a node of a solid.
    ///
    /// # Errors
    ///
    /// For a foreign handle.
    pub fn momentum(&self, node: Node) -> Result<SVector<f64, D>, SceneError> {
        self.run.expect_own(&node)?;
        Ok(point(self.run.state.momenta.values(), node.index).into())
    }

    /// The velocity of a node, m/s. Zero for an anchor, unless it is moved in a scene that has solids with
    /// consistent mass.
    ///
    /// # Errors
    ///
    /// For a foreign handle.
    pub fn velocity(&self, node: Node) -> Result<SVector<f64, D>, SceneError> {
        self.run.expect_own(&node)?;
        Ok(self.velocity_at(node.index).into())
    }

    fn velocity_at(&self, node: usize) -> [f64; D] {
        match self.run.masses.get(node) {
            Some(mass) => self.run.state.velocity(node, mass),
            None => point(self.run.state.velocities.values(), node),
        }
    }

    /// The stretch of an element, m.
    ///
    /// # Errors
    ///
    /// For a foreign handle; [`SceneError::NotASpring`] for a point of a solid.
    pub fn stretch(&self, element: Element) -> Result<f64, SceneError> {
        self.run.expect_spring(element, "stretch")?;
        Ok(self.view(element)?.measure)
    }

    /// The force of an element, `∂ψ/∂λ`, N; positive in tension.
    ///
    /// # Errors
    ///
    /// As [`stretch`](Self::stretch).
    pub fn force(&self, element: Element) -> Result<f64, SceneError> {
        self.run.expect_spring(element, "force")?;
        Ok(self.view(element)?.force)
    }

    /// Stress and strain at an integration point of a solid.
    ///
    /// # Errors
    ///
    /// For a foreign handle; [`SolidError::NotASolid`] for a spring.
    ///
    /// ```
    /// use eem::materials::SaintVenantKirchhoff;
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<2>::new();
    /// let mesh = Mesh::<Quad4, 2>::block([1, 1], [[0.0, 1.0], [0.0, 1.0]])?;
    /// let steel = SaintVenantKirchhoff { lame: 2000.0, shear: 1000.0 };
    /// let plate = scene.solid(steel, &mesh, &Bulk::new(10.0));
    /// // Twice as long: E₁₁ = 3/2, S₁₁ = (λ + 2μ) E₁₁, σ₁₁ = F₁₁ S₁₁ F₁₁/J = 2 S₁₁.
    /// for (&node, [x, y]) in plate.nodes().iter().zip(mesh.nodes()) {
    ///     scene.set_position(node, [2.0 * x, *y]);
    /// }
    /// let run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// let state = run.solid_state(plate.points()[0])?;
    /// assert!((state.strain[(0, 0)] - 1.5).abs() < 1e-14);
    /// assert!((state.stress[(0, 0)] - 12_000.0).abs() < 1e-10);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn solid_state(&self, point: Element) -> Result<SolidState, SceneError> {
        self.run.expect_own(&point)?;
        let [group, place] = self.run.place(point);
        let elements = self.run.stepper.elements(group);
        let state = elements.solid_state(place, &self.run.state);
        state.ok_or(SolidError::NotASolid { element: point }.into())
    }

    /// The internal energy of an element, `ψ + θ s`, J; ψ if it has no temperature.
    ///
    /// # Errors
    ///
    /// For a foreign handle.
    pub fn internal_energy(&self, element: Element) -> Result<f64, SceneError> {
        Ok(self.view(element)?.internal_energy)
    }

    /// The temperature of an element, K.
    ///
    /// # Errors
    ///
    /// For a foreign handle; [`SceneError::NotThermal`] if the element has none.
    pub fn temperature(&self, element: Element) -> Result<f64, SceneError> {
        Ok(self.run.state.temperatures[self.run.thermal_slot(element)?])
    }

    /// The entropy of an element, J/K.
    ///
    /// # Errors
    ///
    /// For a foreign handle; [`SceneError::NotThermal`] if the element has none.
    pub fn entropy(&self, element: Element) -> Result<f64, SceneError> {
        Ok(self.run.state.entropies.values()[self.run.thermal_slot(element)?])
    }

    /// The present entropy production of an element, W/K: `g²/(η θ)` of its dashpots, and `κ (θ' − θ)²/(θ θ')` of
    /// the heat it conducts; half of the latter if the partner is another element, which counts the other half.
    ///
    /// For a dashpot in parallel with a spring, moved anchors count as resting.
    ///
    /// # Errors
    ///
    /// For a foreign handle; [`SceneError::NotThermal`] if the element has no temperature.
    ///
    /// ```
    /// use eem::materials::ThermoelasticSpring;
    /// use eem::prelude::*;
    ///
    /// let wire = ThermoelasticSpring {
    ///     stiffness: 5.0, coupling: 0.0, capacity: 2.0, natural_length: 1.0, theta_ref: 300.0,
    /// };
    /// let mut scene = Scene::<1>::new();
    /// let ends = [scene.anchor([0.0]), scene.anchor([1.0])];
    /// let wire = scene.spring(wire, ends);
    /// scene.set_temperature(wire, 400.0);
    /// let air = scene.reservoir(300.0);
    /// scene.conduct(wire, air, 12.0);
    /// let run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// assert!((run.entropy_production(wire)? - 1.0).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn entropy_production(&self, element: Element) -> Result<f64, SceneError> {
        let slot = self.run.thermal_slot(element)?;
        let theta = self.run.state.temperatures[slot];
        let velocity = |node, to: &mut [f64]| to.copy_from_slice(self.velocity_at(node).as_ref());
        let [group, place] = self.run.place(element);
        let elements = self.run.stepper.elements(group);
        let mut production = elements.dissipation(place, &self.run.state, &velocity) / theta;
        for link in self.run.conduction.links(slot) {
            let (other, share) = match link.partner {
                Partner::Slot(far) => (self.run.state.temperatures[far], 0.5),
                Partner::Reservoir(far) => (self.run.reservoir_now(far), 1.0),
            };
            let difference = other - theta;
            production += share * link.conductance * difference * difference / (theta * other);
        }
        Ok(production)
    }

    /// The viscous stretch of a dashpot (from 0) of an element, m. Components of a
    /// [viscous strain](Self::viscous_strain) follow after the dashpots.
    ///
    /// # Errors
    ///
    /// For a foreign handle; [`SceneError::NoSuchDashpot`].
    pub fn viscous_stretch(&self, element: Element, dashpot: usize) -> Result<f64, SceneError> {
        self.run.expect_own(&element)?;
        let dashpots = self.run.shape(element).scalar_dashpots();
        SceneError::expect_dashpot(element, dashpot, dashpots)?;
        let first = self.run.slots(element).viscous;
        Ok(self.run.state.viscous.values()[first + dashpot])
    }

    /// The viscous strain Γ at a point of a solid. It has three dimensions also in plane strain, where Γ₃₃ flows
    /// too.
    ///
    /// # Errors
    ///
    /// For a foreign handle; [`SolidError::NoViscousStrain`] unless an argument of the free energy has the role
    /// `ViscousStrain`.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// #[derive(Clone, FreeEnergy)]
    /// #[free_energy(|e2: StrainSquare, m3: ViscousStrain, m2: ViscousSquare| 2.0 * (e2 - 2 * m3 + m2))]
    /// #[viscosity(m3 = 4.0)]
    /// struct Fluid;
    ///
    /// let mut scene = Scene::<2>::new();
    /// let mesh = Mesh::<Quad4, 2>::block([1, 1], [[0.0, 1.0], [0.0, 1.0]])?;
    /// let plate = scene.solid(Fluid, &mesh, &Bulk::new(10.0));
    /// // Held at E₁₁ = 3/2, with dev E = (1, −½, −½): Γ follows it with the time 4/(2 · 2) = 1 s.
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
    pub fn viscous_strain(&self, point: Element) -> Result<SMatrix<f64, 3, 3>, SceneError> {
        self.run.expect_own(&point)?;
        let shape = self.run.shape(point);
        if shape.viscous_strain == 0 {
            return Err(SolidError::NoViscousStrain { element: point }.into());
        }
        let first = self.run.slots(point).viscous + shape.scalar_dashpots();
        let values = &self.run.state.viscous.values()[first..];
        let mut components = [0.0; COMPONENTS];
        components[..shape.viscous_strain].copy_from_slice(&values[..shape.viscous_strain]);
        let strain = tensor(&components);
        Ok(SMatrix::from_fn(|row, column| strain[row][column]))
    }

    /// The entropy that a reservoir has received since the start, J/K.
    ///
    /// # Errors
    ///
    /// For a foreign handle; [`SceneError::Oven`] for an [oven](crate::Scene::oven), which stores none.
    pub fn reservoir_entropy(&self, reservoir: Reservoir) -> Result<f64, SceneError> {
        self.run.expect_own(&reservoir)?;
        if self.run.is_oven(reservoir.index) {
            return Err(SceneError::Oven { reservoir });
        }
        Ok(self.run.state.reservoir_entropies.values()[reservoir.index])
    }

    /// The heat that a reservoir has received since the start, `θ_r σ_r`, J.
    ///
    /// # Errors
    ///
    /// As [`reservoir_entropy`](Self::reservoir_entropy).
    pub fn reservoir_heat(&self, reservoir: Reservoir) -> Result<f64, SceneError> {
        let entropy = self.reservoir_entropy(reservoir)?;
        Ok(self.run.conduction.reservoirs[reservoir.index] * entropy)
    }

    /// q (m) and p (kg m/s) of the masses, θ (K) and γ (m) of the elements, each in the order of creation.
    #[doc(hidden)]
    #[must_use]
    pub fn values(&self) -> [Vec<f64>; 4] {
        let state = &self.run.state;
        [
            self.of_masses(&state.positions),
            self.of_masses(&state.momenta),
            state.temperatures.clone(),
            state.viscous.values().to_vec(),
        ]
    }

    /// The components at all masses, node after node.
    pub(super) fn of_masses(&self, all: &Compensated) -> Vec<f64> {
        let mut own = Vec::new();
        for (mass, values) in self.run.masses.iter().zip(all.values().chunks_exact(D)) {
            if mass.is_some() {
                own.extend_from_slice(values);
            }
        }
        own
    }

    /// `|q|₂` of all nodes, anchors included, as errors of positions are relative to, m.
    #[doc(hidden)]
    #[must_use]
    pub fn size_of_positions(&self) -> f64 {
        length(self.run.state.positions.values())
    }

    /// `|p|₂` of the masses, the largest so far if steps are controlled, kg m/s.
    #[doc(hidden)]
    #[must_use]
    pub fn largest_momentum(&self) -> f64 {
        let own = length(self.run.state.momenta.values());
        let control = self.run.control.as_ref();
        let before = control.map_or(0.0, |control| control.memory.largest_momentum);
        Scalar::maximum(own, before)
    }

    /// |q|₂ of all nodes at the start, m, and the largest `m ℓ ω`, kg m/s: what errors of nothing are compared with.
    #[doc(hidden)]
    #[must_use]
    pub fn least_sizes(&self) -> [f64; 2] {
        self.run.least.sizes()
    }

    /// How often the forces of all elements have been evaluated since the simulation was made, once for each
    /// stage of a scheme with several.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<1>::new();
    /// scene.mass(1.0, [1.0], [1.0]);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// run.step()?;
    /// assert!(run.evaluations() >= 1);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.run.automatic.evaluations + self.run.stepper.evaluations()
    }

    /// Energies, entropies and momenta, computed from the state by their definitions.
    #[must_use]
    pub fn ledger(&self) -> Ledger<D> {
        let ledger = Ledger {
            unresolved: self.run.unresolved.points,
            ..self.run.ledger_in(&self.run.state)
        };
        ledger.with_momentum(&self.run.state)
    }

    /// Which viscous variables are strains of solids.
    #[doc(hidden)]
    #[must_use]
    pub fn viscous_strains(&self) -> Vec<bool> {
        self.run.viscous_strains()
    }

    /// The elements and their solver.
    pub(super) fn stepper(&self) -> &Stepper<D> {
        self.run.stepper.of()
    }

    fn view(&self, element: Element) -> Result<ElementView, SceneError> {
        self.run.expect_own(&element)?;
        let [group, place] = self.run.place(element);
        let elements = self.run.stepper.elements(group);
        Ok(elements.inspect(place, &self.run.state))
    }

    /// All elements of the model with this name, the last part of its path, in the order of creation: springs, and points of
    /// solids.
    ///
    /// ```
    /// use eem::materials::Hooke;
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<1>::new();
    /// let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.2], [0.0])];
    /// let spring = scene.spring(Hooke { stiffness: 4.0, natural_length: 1.0 }, ends);
    /// let run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// assert!(run.elements_of("Hooke").eq([spring]));
    /// assert_eq!(run.elements_of("Gent").count(), 0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn elements_of(&self, model: &str) -> impl Iterator<Item = Element> {
        let all = self.run.all_places();
        let all = all.map(|(place, _)| self.run.stepper.handle(place));
        all.filter(move |element| element.model() == model)
    }

    /// The numbers of nodes and elements.
    #[cfg(feature = "vtk")]
    pub(crate) fn counts(&self) -> [usize; 2] {
        [
            self.run.state.positions.values().len() / D,
            self.run.places.len(),
        ]
    }

    /// The scene from which the simulation was made.
    pub(crate) const fn scene(&self) -> SceneId {
        self.run.scene.scene()
    }
}
