//! Loads, supports and thermostats of masses and solids.

use std::sync::Arc;

use super::Scene;
use super::entry::infinite;
use crate::element::handle::{Element, Node};
use crate::element::kinematics::Shape;
use crate::element::loads::PushLine;
use crate::scene::bulk::Body;
use crate::scene::error::{RocketError, SceneError};
use crate::scene::loads::{Course, OfTime, Rocket};
use crate::scene::solid_error::SolidError;
use eem_material::number::scalar::is_positive;
use eem_mesh::Face;

/// # Loads, supports and thermostats
impl<const D: usize> Scene<D> {
    /// Gravity: the acceleration of all masses, m/s²; zero by default. Its potential energy `−Σ m g·q` is part of
    /// the ledger.
    pub fn set_gravity(&mut self, gravity: [f64; D]) {
        self.plan.loads.gravity = Box::new(gravity);
    }

    /// A constant force on a mass, N. The ledger counts its work.
    pub fn dead_load(&mut self, node: Node, force: [f64; D]) {
        if let Some((axis, value)) = infinite(&force).next() {
            self.plan.refuse(SceneError::DeadLoad { node, axis, value });
        } else if self.plan.expect_kind(node, true, "a force") {
            let force = Box::new(force) as _;
            self.plan.loads.forces.push((node, Course::Constant(force)));
        }
    }

    /// A force on a mass as a function of time, N of s. The ledger counts its work.
    ///
    /// Several forces on one mass add up. A step uses the force at its middle. Schemes with stages also use it at
    /// the times of the stages.
    pub fn force(&mut self, node: Node, force: impl Fn(f64) -> [f64; D] + Send + Sync + 'static) {
        if self.plan.expect_kind(node, true, "a force") {
            let force = Course::Function(of_time(force));
            self.plan.loads.forces.push((node, force));
        }
    }

    /// A rocket: a force on a mass or a node of a solid along the line from one node to another, N as a function of
    /// time in s. It turns with the line. The ledger counts its work.
    ///
    /// ```text
    /// f = F(t_m) n,   n = r_m/|r_m|,   r_m = mean of q_head − q_tail over the step
    /// ```
    ///
    /// A step uses the thrust at its middle. Schemes: [`EemEntropy`](crate::Scheme::EemEntropy),
    /// [`EemTemperature`](crate::Scheme::EemTemperature), [`Staggered`](crate::Scheme::Staggered) and the midpoint
    /// and trapezoidal rules.
    ///
    /// ```
    /// use eem::materials::Hooke;
    /// use eem::prelude::*;
    ///
    /// // A rod of 2 m that is pushed at its end, along itself.
    /// let mut scene = Scene::<2>::new();
    /// let ends = [[0.0, 0.0], [0.0, 2.0]].map(|place| scene.mass(1.0, place, [0.0, 0.0]));
    /// scene.spring(Hooke { stiffness: 1e4, natural_length: 2.0 }, ends);
    /// scene.rocket(ends[0], ends, |_| 3.0);
    ///
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// run.run_until(1.0)?;
    /// assert!((run.ledger().linear_momentum[1] - 3.0).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn rocket(
        &mut self,
        node: Node,
        [tail, head]: [Node; 2],
        thrust: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) {
        let own = self.plan.expect_kind(node, true, "a rocket")
            & self.plan.expect_own(&tail)
            & self.plan.expect_own(&head);
        if own && tail == head {
            self.plan.refuse(RocketError::NoLine { node, end: tail });
        } else if own {
            let line = PushLine { node, tail, head };
            let thrust = Arc::new(thrust);
            self.plan.loads.rockets.push(Rocket { line, thrust });
        }
    }

    /// The position of an anchor as a function of time, m of s, for example of a shaking table. The ledger counts
    /// the work of the support.
    ///
    /// The function is evaluated at the end of each step. At the start it must return the initial position of the
    /// anchor, to rounding; otherwise the error is [`SceneError::AnchorJump`].
    ///
    /// Next to a solid with consistent mass an anchor also has a velocity, which accelerates neighbouring nodes. It
    /// is the derivative of the cubic through the positions before and after a step and at its thirds; its error is
    /// `O(h³)`, plus 15ε|x|/h of rounding. The initial velocity is the derivative at the start, or
    /// [`SolidError::AnchorSpeed`](crate::SolidError::AnchorSpeed) if there is none. After a jump within a step the
    /// velocity depends on the position of the jump in the step, so resolve fast motions by several steps.
    pub fn move_anchor(
        &mut self,
        anchor: Node,
        position: impl Fn(f64) -> [f64; D] + Send + Sync + 'static,
    ) {
        if self.plan.expect_kind(anchor, false, "a prescribed motion") {
            let position = Course::Function(of_time(position));
            self.plan.loads.motions.push((anchor, position));
        }
    }

    /// Makes a step end at each of these times, s: where a load jumps or has a kink. Times before the start, and those given before,
    /// do no harm.
    ///
    /// A step that would go beyond such a time is shortened and ends there to the last bit; later steps have their usual size
    /// again, and step control starts afresh. A force may jump: steps before that time do not see it from then on, and steps
    /// behind it do not see it before.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<1>::new();
    /// let mass = scene.mass(2.0, [1.0], [0.0]);
    /// scene.force(mass, |t: f64| [if t < 0.7 { 0.0 } else { 10.0 }]);
    /// scene.stop_at([0.7]);
    /// let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.5)?;
    /// run.run_until(1.7)?;
    /// // 10 N in 1 s.
    /// assert!((run.momentum(mass)?[0] - 10.0).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn stop_at(&mut self, times: impl IntoIterator<Item = f64>) {
        for time in times {
            if !time.is_finite() {
                self.plan.refuse(SceneError::StopTime { time });
                return;
            }
            self.plan.loads.stops.push(time);
        }
        let stops = &mut self.plan.loads.stops;
        stops.sort_by(f64::total_cmp);
        stops.dedup();
    }

    /// Says that nothing which a load does lasts less than this, s, so that a step under control does not pass over it.
    ///
    /// Forces, thrusts, motions and temperatures that are functions of time are then sampled three times in this duration, or more
    /// often, before a step is made. Without it they are sampled 256 times from the present to the end of
    /// [`run_until`](crate::Simulation::run_until), and 16 times in a step for which no end is known. The last call counts.
    ///
    /// ```
    /// use eem::prelude::*;
    ///
    /// // A blow of 1 ms on a mass at rest, within 10 s.
    /// let mut scene = Scene::<1>::new();
    /// let mass = scene.mass(2.0, [1.0], [0.0]);
    /// let blow = |t: f64| (1e6 * (t - 4.0) * (4.001 - t)).max(0.0);
    /// scene.force(mass, move |t| [blow(t)]);
    /// scene.shortest_load(1e-3);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy6, 0.1)?;
    /// run.control_steps(Tolerance::new(1e-4))?;
    /// run.run_until(10.0)?;
    /// // ∫ a t (d − t) dt = a d³/6
    /// assert!((run.momentum(mass)?[0] / (1e-3 / 6.0) - 1.0).abs() < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn shortest_load(&mut self, duration: f64) {
        if is_positive(duration) {
            self.plan.loads.shortest = Some(duration);
        } else {
            self.plan.refuse(SceneError::ShortestLoad { duration });
        }
    }

    /// The initial temperature of all points of a solid, K; the last call for a point counts.
    ///
    /// ```
    /// use eem::materials::ThermoelasticSolid;
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<2>::new();
    /// let mesh = Mesh::<Quad4, 2>::block([2, 1], [[0.0, 2.0], [0.0, 1.0]])?;
    /// let plate = scene.solid(ThermoelasticSolid::RUBBER, &mesh, &Bulk::new(10.0));
    /// scene.set_temperatures(&plate, 310.0);
    /// let run = Simulation::new(scene, Scheme::EemEntropy, 0.1)?;
    /// assert_eq!(run.temperature(plate.points()[7])?, 310.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_temperatures<H: Shape<D>>(&mut self, body: &Body<H, D>, temperature: f64) {
        for &point in body.points() {
            self.set_temperature(point, temperature);
        }
    }

    /// Sets the initial momentum of a mass, kg m/s, instead of its velocity.
    pub fn set_momentum(&mut self, node: Node, momentum: [f64; D]) {
        if self.plan.expect_kind(node, true, "a momentum") {
            self.plan.entries.nodes[node.index].momentum = Some(Box::new(momentum));
        }
    }

    /// Prescribes the temperature of an element as a function of time, K of s (a thermostat). The ledger counts the
    /// heat and the entropy that the thermostat supplies: in [exact](crate::Scheme::is_exact) schemes `∫ θ ds` to their order. In
    /// those of order 2, the heat of a step is given at one temperature between those of both ends.
    ///
    /// The initial temperature must be set as well, and must equal the prescribed one at the start to rounding;
    /// otherwise the error is [`SceneError::TemperatureJump`].
    pub fn prescribe_temperature(
        &mut self,
        element: Element,
        temperature: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) {
        if self.plan.expect_own(&element) {
            let temperature = Course::Function(Arc::new(temperature) as _);
            self.plan.loads.temperatures.push((element, temperature));
        }
    }

    /// Sets the initial temperature of an element, K, and holds it there (a thermostat), unless a controller
    /// [sets](crate::Simulation::set_temperature_of) another one. The ledger counts the heat and the entropy that the
    /// thermostat supplies. In [exact](crate::Scheme::is_exact) schemes the heat is the temperature times the entropy, so that
    /// the sum of kinetic and free energy grows by the work at most.
    ///
    /// ```
    /// use eem::materials::ThermoelasticSpring;
    /// use eem::prelude::*;
    ///
    /// let wire = ThermoelasticSpring {
    ///     stiffness: 5.0, coupling: 1.0, capacity: 2.0, natural_length: 1.0, theta_ref: 300.0,
    /// };
    /// let mut scene = Scene::<1>::new();
    /// let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.1], [0.0])];
    /// let wire = scene.spring(wire, ends);
    /// scene.hold_temperature(wire, 310.0);
    /// let mut run = Simulation::new(scene, Scheme::EemTemperature, 0.01)?;
    /// run.run_until(1.0)?;
    /// assert!((run.temperature(wire)? - 310.0).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn hold_temperature(&mut self, element: Element, temperature: f64) {
        self.set_temperature(element, temperature);
        if self.plan.expect_own(&element) {
            let temperature = Course::Set(temperature);
            self.plan.loads.temperatures.push((element, temperature));
        }
    }
}

/// A force per area or volume as a function of time.
type Density<const D: usize> = Arc<dyn Fn(f64) -> [f64; D] + Send + Sync>;

/// # Loads of solids
impl<const D: usize> Scene<D> {
    /// A traction on some faces of a solid, N/m² of the reference configuration, as a function of time. Its
    /// direction does not follow the body. The ledger counts its work. It has no effect on fixed nodes.
    ///
    /// ```
    /// use eem::materials::SaintVenantKirchhoff;
    /// use eem::prelude::*;
    ///
    /// let mut scene = Scene::<3>::new();
    /// let steel = SaintVenantKirchhoff { lame: 2000.0, shear: 1000.0 };
    /// let mesh = Mesh::<Hex8, 3>::block([2, 1, 1], [[0.0, 2.0], [0.0, 1.0], [0.0, 1.0]])?;
    /// let beam = scene.solid(steel, &mesh, &Bulk::new(10.0));
    /// scene.traction(&beam, &mesh.face(|[x, ..]| x >= 2.0)?, |t| [0.0, 0.0, 5.0 * t]);
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
        traction: impl Fn(f64) -> [f64; D] + Send + Sync + 'static,
    ) {
        if !body.mesh().has(face) {
            let element = body.first();
            return self.plan.refuse(SolidError::ForeignFace { element });
        }
        let shares = body.mesh().areas(face).into_iter();
        let shares = shares.map(|(node, area)| (body.nodes()[node], body.thickness * area));
        self.distribute(shares.collect(), &(Arc::new(traction) as _));
    }

    /// A force per reference volume, N/m³, as a function of time. The ledger counts its work. It has no effect on
    /// fixed nodes. For weight use [`set_gravity`](Self::set_gravity).
    ///
    /// ```
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
    /// // 3 N on 1 m³ for 0.1 s.
    /// assert!((run.ledger().linear_momentum[0] - 0.3).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn body_force<H: Shape<D>>(
        &mut self,
        body: &Body<H, D>,
        force: impl Fn(f64) -> [f64; D] + Send + Sync + 'static,
    ) {
        let shares = body.nodes().iter().zip(body.mesh().volumes());
        let shares = shares.map(|(&node, volume)| (node, body.thickness * volume));
        self.distribute(shares.collect(), &(Arc::new(force) as _));
    }

    /// Loads the nodes, except anchors, with their shares of the area or volume.
    fn distribute(&mut self, shares: Vec<(Node, f64)>, density: &Density<D>) {
        for (node, share) in shares {
            let own = self.plan.expect_own(&node);
            if own && self.plan.entries.nodes[node.index].mass.is_some() {
                let density = Arc::clone(density);
                self.force(node, move |time| density(time).map(|force| share * force));
            }
        }
    }
}

/// A function of time that writes its components.
fn of_time<const D: usize>(of: impl Fn(f64) -> [f64; D] + Send + Sync + 'static) -> OfTime {
    Arc::new(move |time, components| components.copy_from_slice(&of(time)))
}
