//! The parts of a scene: nodes, springs, initial temperatures, reservoirs and paths of heat.

use std::sync::Arc;

use super::Scene;
use crate::algebra::memory::MemoryLimit;
use crate::element::conduction::Conductor;
use crate::element::group::springs::{
    Damped, Elastic, ManyDashpots, NewGroup, Springs, Viscous, Warm, explicit, group_of,
};
use crate::element::group::{LooseElements, identity};
use crate::element::handle::{Element, HeatPartner, HeatPath, Kind, Node, Reservoir};
use crate::element::kinematics::Stretch;
use crate::scene::error::SceneError;
use eem_material::arrays::{Arrays, ArraysOf};
use eem_material::free_energy::Material;
use eem_material::tabled::Tabled;

/// The arrays of a spring with more variables than those that are compiled with this crate have room for.
type Own<M> = ArraysOf<M, [f64; 1], [f64; 32]>;

impl<const D: usize> Scene<D> {
    /// An empty scene.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }
}

/// # Nodes, springs and heat
impl<const D: usize> Scene<D> {
    /// A node that does not move; position in m.
    pub fn anchor(&mut self, position: [f64; D]) -> Node {
        self.plan.push_node(None, &position, &[0.0; D])
    }

    /// A point mass (kg) with its initial position (m) and velocity (m/s).
    pub fn mass(&mut self, mass: f64, position: [f64; D], velocity: [f64; D]) -> Node {
        self.plan.push_node(Some(mass), &position, &velocity)
    }

    /// A spring between two nodes, made of the material `model`.
    ///
    /// Springs of different materials can be mixed in a scene. A material with a temperature needs
    /// [`set_temperature`](Self::set_temperature). Viscous stretches are zero at first.
    pub fn spring<M: Material>(&mut self, model: M, nodes: [Node; 2]) -> Element {
        const {
            assert!(
                M::MEASURES == 1 && !M::PER_VOLUME,
                "a spring has one measure, its stretch"
            );
        }
        let element = self.plan.next_element(&model);
        for node in nodes {
            self.plan.expect_own(&node);
        }
        if nodes[0] == nodes[1] {
            let node = nodes[0];
            self.plan.refuse(SceneError::SelfSpring { element, node });
        }
        let groups = Springs::get();
        // A branch that a constant rules out is not compiled.
        let at = if const { Tabled::<Elastic>::is_for::<M>() } {
            let model = Tabled::new::<_, [f64; 1]>(model);
            self.push_spring::<M, Elastic>(element, model, groups.elastic)
        } else if const { Tabled::<Warm>::is_for::<M>() } {
            let model = Tabled::new::<_, [f64; 1]>(model);
            self.push_spring::<M, Warm>(element, model, groups.warm)
        } else if const { Tabled::<Viscous>::is_for::<M>() } {
            let model = Tabled::new::<_, [f64; 1]>(model);
            self.push_spring::<M, Viscous>(element, model, groups.viscous)
        } else if const { Tabled::<Damped>::has_room_for::<M>() } {
            let model = Tabled::with_room::<_, [f64; 1]>(model);
            self.push_spring::<M, Damped>(element, model, groups.damped)
        } else if const { Tabled::<ManyDashpots>::has_room_for::<M>() } {
            let model = Tabled::with_room::<_, [f64; 1]>(model);
            self.push_spring::<M, ManyDashpots>(element, model, group_of::<ManyDashpots, D>)
        } else {
            let model = Tabled::new::<_, [f64; 1]>(model);
            self.push_spring::<M, Own<M>>(element, model, group_of::<Own<M>, D>)
        };
        self.plan.push_element(&nodes, at);
        element
    }

    /// Adds a spring of the material `M` to its group; returns the indices of group and place.
    fn push_spring<M: Material, A: Arrays>(
        &mut self,
        element: Element,
        model: Tabled<A>,
        new: NewGroup<D>,
    ) -> [usize; 2] {
        let new = || new(explicit::<M, A, D>);
        let (group, set) = self.set_of::<LooseElements<Stretch<D>, D>>(identity(&model), new);
        [group, set.push((element, [Stretch]), [model])]
    }

    /// The initial temperature of an element, K. Every element with a temperature needs one, also if a thermostat
    /// [prescribes it](Self::prescribe_temperature). The last call counts.
    pub fn set_temperature(&mut self, element: Element, temperature: f64) {
        if self.plan.expect_own(&element) {
            self.plan.entries.elements[element.index()].temperature = Some(temperature);
        }
    }

    /// The initial viscous stretch of a dashpot (from 0) of an element, m; zero by default. For a viscous strain
    /// tensor use [`set_viscous_strain`](Self::set_viscous_strain).
    pub fn set_viscous_stretch(&mut self, element: Element, dashpot: usize, stretch: f64) {
        if self.plan.expect_own(&element) {
            let entry = &mut self.plan.entries.elements[element.index()];
            let shape = self.groups.get(entry.group).map(|group| group.shape());
            let shape = shape.filter(|shape| shape.viscous_strain > 0);
            let dashpots = shape.map_or(usize::MAX, |shape| shape.scalar_dashpots());
            match SceneError::expect_dashpot(element, dashpot, dashpots) {
                Ok(()) => entry.viscous_stretches.push((dashpot, stretch)),
                Err(error) => self.plan.refuse(error),
            }
        }
    }

    /// A heat reservoir at a constant temperature, K.
    pub fn reservoir(&mut self, temperature: f64) -> Reservoir {
        self.plan.reservoirs.push(temperature);
        self.plan.reservoir_at(self.plan.reservoirs.len() - 1)
    }

    /// A heat reservoir whose temperature is a function of time, K of s: an oven, or the weather. The ledger
    /// counts the heat that it gives like that of thermostats, instead of storing its entropy.
    ///
    /// A step of every scheme uses the temperature at its middle: the laws hold exactly, and the error of the oven is of
    /// order 2 in the step.
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
    /// scene.set_temperature(wire, 300.0);
    /// let oven = scene.oven(|t: f64| 300.0 + 10.0 * t);
    /// scene.conduct(wire, oven, 4.0);
    /// let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.01)?;
    /// run.run_until(1.0)?;
    /// // θ̇ = (4/2) (θ_oven − θ), so that θ − 300 = 10 t − 5 (1 − e⁻²ᵗ)
    /// let exact = 310.0 - 5.0 * (1.0 - (-2.0_f64).exp());
    /// assert!((run.temperature(wire)? - exact).abs() < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn oven(&mut self, temperature: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Reservoir {
        let oven = self.reservoir(1.0);
        self.plan
            .loads
            .ovens
            .push((oven.index, Arc::new(temperature)));
        oven
    }

    /// Fourier conduction with conductance κ (W/K) from an element to another or to a reservoir:
    /// the element receives the heat flow `κ (θ_partner − θ_element)`.
    ///
    /// Conductances of several calls for the same two partners add, in either order of the partners.
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
    /// scene.set_temperature(wire, 350.0);
    /// let air = scene.reservoir(300.0);
    /// for conductance in [1.5, 0.5] {
    ///     scene.conduct(wire, air, conductance);
    /// }
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 1e-4)?;
    /// run.step()?;
    /// // 2 W/K at 50 K
    /// assert!((run.reservoir_heat(air)? - 0.01).abs() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn conduct(
        &mut self,
        element: Element,
        partner: impl Into<HeatPartner>,
        conductance: f64,
    ) -> HeatPath {
        let partner = partner.into();
        let is_own = self.plan.expect_own(&element);
        let is_partner_own = match partner {
            HeatPartner::Element(other) => self.plan.expect_own(&other),
            HeatPartner::Reservoir(other) => self.plan.expect_own(&other),
        };
        if is_own && is_partner_own {
            self.plan.conductors.push(Conductor {
                element,
                partner,
                conductance,
            });
        }
        let index = self.plan.conductors.len().saturating_sub(1);
        HeatPath {
            scene: self.plan.lineage.giver(Kind::HeatPath, index),
            index,
        }
    }

    /// The time at which a run begins, s; zero by default. It may be negative. Loads, motions and thermostats are functions of
    /// this time.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<1>::new();
    /// let mass = scene.mass(2.0, [0.0], [0.0]);
    /// scene.force(mass, |t: f64| [if t < 0.0 { 1.0 } else { 0.0 }]);
    /// scene.start_at(-0.5);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.25)?;
    /// assert_eq!(run.time(), -0.5);
    /// run.run_until(1.0)?;
    /// assert_eq!(run.momentum(mass)?[0], 0.5);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn start_at(&mut self, time: f64) {
        self.plan.start = time;
    }

    /// Limits the memory of the matrix of Newton's method and its factors, bytes. Without a limit it is the memory
    /// available when the simulation begins.
    ///
    /// The factors of solids in space need most: about 16 GB for a block of 50³ cells with eight nodes. A scene
    /// that does not fit is rejected before memory is reserved, with
    /// [`SceneError::TooLarge`](crate::SceneError::TooLarge).
    ///
    /// ```
    /// use eem::TooLarge;
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<2>::new();
    /// for index in 1..=100 {
    ///     scene.mass(1.0, [f64::from(index), 0.0], [0.0, 0.0]);
    /// }
    /// scene.limit_memory(1_000);
    /// let refused = Simulation::new(scene, Scheme::EemEntropy, 0.1).unwrap_err();
    /// assert!(matches!(
    ///     refused.errors(),
    ///     [SceneError::TooLarge(TooLarge { unknowns: 200, available: Some(1_000), .. })]
    /// ));
    /// ```
    pub fn limit_memory(&mut self, bytes: u64) {
        self.plan.memory_limit = MemoryLimit::new(Some(bytes));
    }
}
