//! `eem.Scene`: nodes, springs, reservoirs and loads.

use std::sync::{Mutex, MutexGuard, PoisonError};

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyType};

use crate::act::{Act, Course, Partner, Rest, Speed};
use crate::ensemble::Request;
use crate::handle::{
    Element, ElementArray, HeatPath, HeatPathArray, Kind, Lineage, Node, NodeArray, Reservoir,
    ReservoirArray, indices, one,
};
use crate::material::Material;
use crate::simulation::{Simulation, scheme, tolerance};
use crate::world::{World, dashpots};
use crate::{error, input};

/// A scene in one, two or three dimensions.
#[pyclass(frozen, name = "Scene", module = "eem")]
pub(crate) struct PyScene {
    world: Mutex<World>,
}

/// What a pickle contains.
type State = (usize, String, Vec<Py<Material>>, Vec<Py<PyAny>>, Lineage);

impl PyScene {
    pub(crate) fn of(world: World) -> Self {
        Self {
            world: Mutex::new(world),
        }
    }

    /// A panic while it was changed leaves acts and scene as they were before or after.
    fn world(&self) -> MutexGuard<'_, World> {
        self.world.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A copy of what is in it.
    pub(crate) fn copied(&self, py: Python<'_>) -> PyResult<World> {
        let world = self.world();
        Ok(world.copy(world.lineage.copy(py)?))
    }
}

impl World {
    fn masses(
        &mut self,
        (masses, positions): (Vec<f64>, Vec<f64>),
        [velocity, momentum]: [Option<Vec<f64>>; 2],
    ) -> PyResult<usize> {
        let first = self.lineage.counts[Kind::Node as usize];
        let speed = match (velocity, momentum) {
            (None, None) => Speed::Zero,
            (Some(velocities), None) => Speed::Velocities(velocities),
            (None, Some(momenta)) => Speed::Momenta(momenta),
            (Some(_), Some(_)) => {
                return Err(error::scene(
                    "velocity and momentum are given: give one of them",
                ));
            }
        };
        self.act(Act::Masses {
            masses,
            positions,
            speed,
        })?;
        Ok(first)
    }

    fn springs(
        &mut self,
        material: &Bound<'_, Material>,
        pairs: Vec<[usize; 2]>,
        temperature: Option<&Bound<'_, PyAny>>,
        viscous_stretch: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<usize> {
        let count = pairs.len();
        let first = self.lineage.counts[Kind::Element as usize];
        let temperatures = match temperature {
            Some(given) => input::numbers(given, count, "the temperature")?,
            None => Vec::new(),
        };
        let dashpots = dashpots(&material.get().law);
        let viscous_stretches = match viscous_stretch {
            Some(given) => input::vectors(given, [count, dashpots], "the viscous stretch")?,
            None => Vec::new(),
        };
        let material = self.material(material);
        self.act(Act::Springs {
            material,
            pairs,
            temperatures,
            viscous_stretches,
        })?;
        Ok(first)
    }

    /// A quantity that is a number or a function of time.
    fn course(&mut self, given: &Bound<'_, PyAny>, what: &str) -> PyResult<Course> {
        if given.is_callable() {
            return Ok(Course::Function(self.function(given)));
        }
        Ok(Course::Constant(vec![input::number(given, what)?]))
    }

    fn pair(&self, given: &Bound<'_, PyAny>) -> PyResult<[usize; 2]> {
        let (nodes, _) = indices::<Node>(given, &self.lineage)?;
        let count = nodes.len();
        <[usize; 2]>::try_from(nodes)
            .map_err(|_| error::scene(format!("a spring has two nodes, not {count}")))
    }
}

#[pymethods]
impl PyScene {
    #[new]
    #[pyo3(signature = (dim=3))]
    fn new(py: Python<'_>, dim: usize) -> PyResult<Self> {
        Ok(Self::of(World::new(dim, Lineage::new(py)?)?))
    }

    /// The number of dimensions.
    #[getter]
    fn dim(&self) -> usize {
        self.world().dim
    }

    /// All anchors and masses.
    #[getter]
    fn nodes(&self) -> NodeArray {
        let Lineage { own, counts, .. } = self.world().lineage;
        NodeArray::of(own, 0..counts[Kind::Node as usize])
    }

    /// All springs.
    #[getter]
    fn elements(&self) -> ElementArray {
        let Lineage { own, counts, .. } = self.world().lineage;
        ElementArray::of(own, 0..counts[Kind::Element as usize])
    }

    /// The materials of its springs.
    #[getter]
    fn materials<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        PyList::new(py, self.world().materials.iter().map(|one| one.bind(py)))
    }

    fn anchor(&self, position: &Bound<'_, PyAny>) -> PyResult<Node> {
        let mut world = self.world();
        let positions = input::vector(position, world.dim, "the position")?;
        let index = world.lineage.counts[Kind::Node as usize];
        world.act(Act::Anchors { positions })?;
        Ok(Node::of(world.lineage.own, index))
    }

    fn anchors(&self, positions: &Bound<'_, PyAny>) -> PyResult<NodeArray> {
        let mut world = self.world();
        let positions = input::rows(positions, world.dim, "positions")?;
        let first = world.lineage.counts[Kind::Node as usize];
        world.act(Act::Anchors { positions })?;
        let Lineage { own, counts, .. } = world.lineage;
        Ok(NodeArray::of(own, first..counts[Kind::Node as usize]))
    }

    #[pyo3(signature = (mass, position, velocity=None, *, momentum=None))]
    fn mass(
        &self,
        mass: &Bound<'_, PyAny>,
        position: &Bound<'_, PyAny>,
        velocity: Option<&Bound<'_, PyAny>>,
        momentum: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Node> {
        let mut world = self.world();
        let dim = world.dim;
        let place = vec![input::number(mass, "the mass")?];
        let place = (place, input::vector(position, dim, "the position")?);
        let velocity = velocity.map(|given| input::vector(given, dim, "the velocity"));
        let momentum = momentum.map(|given| input::vector(given, dim, "the momentum"));
        let index = world.masses(place, [velocity.transpose()?, momentum.transpose()?])?;
        Ok(Node::of(world.lineage.own, index))
    }

    #[pyo3(signature = (masses, positions, velocities=None, *, momenta=None))]
    fn masses(
        &self,
        masses: &Bound<'_, PyAny>,
        positions: &Bound<'_, PyAny>,
        velocities: Option<&Bound<'_, PyAny>>,
        momenta: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<NodeArray> {
        let mut world = self.world();
        let dim = world.dim;
        let positions = input::rows(positions, dim, "positions")?;
        let count = positions.len() / dim;
        let masses = input::numbers(masses, count, "masses")?;
        let speeds = |given: Option<&Bound<'_, PyAny>>, what: &str| {
            given
                .map(|given| input::vectors(given, [count, dim], what))
                .transpose()
        };
        let speeds = [
            speeds(velocities, "velocities")?,
            speeds(momenta, "momenta")?,
        ];
        let first = world.masses((masses, positions), speeds)?;
        Ok(NodeArray::of(world.lineage.own, first..first + count))
    }

    #[pyo3(signature = (material, nodes, *, temperature=None, viscous_stretch=None))]
    fn spring(
        &self,
        material: &Bound<'_, Material>,
        nodes: &Bound<'_, PyAny>,
        temperature: Option<&Bound<'_, PyAny>>,
        viscous_stretch: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Element> {
        let mut world = self.world();
        let pair = world.pair(nodes)?;
        let index = world.springs(material, vec![pair], temperature, viscous_stretch)?;
        Ok(Element::of(world.lineage.own, index))
    }

    #[pyo3(signature = (material, pairs, *, temperature=None, viscous_stretch=None))]
    fn springs(
        &self,
        material: &Bound<'_, Material>,
        pairs: &Bound<'_, PyAny>,
        temperature: Option<&Bound<'_, PyAny>>,
        viscous_stretch: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<ElementArray> {
        let mut world = self.world();
        let pairs = pairs.try_iter()?.map(|pair| world.pair(&pair?));
        let pairs: Vec<_> = pairs.collect::<PyResult<_>>()?;
        let count = pairs.len();
        let first = world.springs(material, pairs, temperature, viscous_stretch)?;
        Ok(ElementArray::of(world.lineage.own, first..first + count))
    }

    fn set_temperature(
        &self,
        springs: &Bound<'_, PyAny>,
        temperature: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let mut world = self.world();
        let (elements, _) = indices::<Element>(springs, &world.lineage)?;
        let values = input::numbers(temperature, elements.len(), "the temperature")?;
        world.act(Act::Temperatures { elements, values })
    }

    fn reservoir(&self, temperature: &Bound<'_, PyAny>) -> PyResult<Reservoir> {
        let mut world = self.world();
        let index = world.lineage.counts[Kind::Reservoir as usize];
        let act = match world.course(temperature, "the temperature")? {
            Course::Function(function) => Act::Oven { function },
            Course::Constant(temperatures) => Act::Reservoirs { temperatures },
        };
        world.act(act)?;
        Ok(Reservoir::of(world.lineage.own, index))
    }

    fn reservoirs(&self, temperatures: &Bound<'_, PyAny>) -> PyResult<ReservoirArray> {
        let mut world = self.world();
        let array = input::array(temperatures, "temperatures")?;
        if array.shape.len() != 1 {
            return Err(error::scene(
                "temperatures are a list with one for each reservoir",
            ));
        }
        let first = world.lineage.counts[Kind::Reservoir as usize];
        let temperatures = array.values;
        world.act(Act::Reservoirs { temperatures })?;
        let Lineage { own, counts, .. } = world.lineage;
        Ok(ReservoirArray::of(
            own,
            first..counts[Kind::Reservoir as usize],
        ))
    }

    fn conduct<'py>(
        &self,
        py: Python<'py>,
        springs: &Bound<'py, PyAny>,
        partners: &Bound<'py, PyAny>,
        conductance: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let mut world = self.world();
        let (elements, is_one) = indices::<Element>(springs, &world.lineage)?;
        let count = elements.len();
        let is_reservoir =
            partners.is_instance_of::<Reservoir>() || partners.is_instance_of::<ReservoirArray>();
        let (partners, is_common) = if is_reservoir {
            let (all, is_common) = indices::<Reservoir>(partners, &world.lineage)?;
            (all.into_iter().map(Partner::Reservoir).collect(), is_common)
        } else {
            let (all, is_common) = indices::<Element>(partners, &world.lineage)?;
            (
                all.into_iter().map(Partner::Element).collect::<Vec<_>>(),
                is_common,
            )
        };
        let partners = if is_common {
            vec![partners[0]; count]
        } else {
            partners
        };
        if partners.len() != count {
            let other = partners.len();
            return Err(error::scene(format!(
                "{count} springs have {other} partners: give one, or one for each"
            )));
        }
        let conductances = input::numbers(conductance, count, "the conductance")?;
        let first = world.lineage.counts[Kind::HeatPath as usize];
        world.act(Act::Paths {
            elements,
            partners,
            conductances,
        })?;
        let own = world.lineage.own;
        let all = HeatPathArray::of(own, first..first + count);
        Ok(if is_one {
            Bound::new(py, HeatPath::of(own, first))?.into_any()
        } else {
            Bound::new(py, all)?.into_any()
        })
    }

    fn set_gravity(&self, gravity: &Bound<'_, PyAny>) -> PyResult<()> {
        let mut world = self.world();
        let gravity = input::vector(gravity, world.dim, "gravity")?;
        world.act(Act::Gravity { gravity })
    }

    fn force(&self, nodes: &Bound<'_, PyAny>, force: &Bound<'_, PyAny>) -> PyResult<()> {
        let mut world = self.world();
        let (nodes, _) = indices::<Node>(nodes, &world.lineage)?;
        let force = if force.is_callable() {
            Course::Function(world.function(force))
        } else {
            Course::Constant(input::vector(force, world.dim, "the force")?)
        };
        world.act(Act::Force { nodes, force })
    }

    fn rocket(
        &self,
        node: &Bound<'_, PyAny>,
        tail: &Bound<'_, PyAny>,
        head: &Bound<'_, PyAny>,
        thrust: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let mut world = self.world();
        let nodes = [
            one::<Node>(node, &world.lineage)?,
            one::<Node>(tail, &world.lineage)?,
            one::<Node>(head, &world.lineage)?,
        ];
        let thrust = world.course(thrust, "the thrust")?;
        world.act(Act::Rocket { nodes, thrust })
    }

    fn move_anchor(&self, anchor: &Bound<'_, PyAny>, position: &Bound<'_, PyAny>) -> PyResult<()> {
        let mut world = self.world();
        let anchor = one::<Node>(anchor, &world.lineage)?;
        let function = world.function(position);
        world.act(Act::Motion { anchor, function })
    }

    fn hold_temperature(
        &self,
        spring: &Bound<'_, PyAny>,
        temperature: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let mut world = self.world();
        let element = one::<Element>(spring, &world.lineage)?;
        let temperature = world.course(temperature, "the temperature")?;
        world.act(Act::Thermostat {
            element,
            temperature,
        })
    }

    fn start_at(&self, time: f64) -> PyResult<()> {
        self.world().act(Act::Start { time })
    }

    #[pyo3(signature = (*, held=false, thermal_balance=false, load_steps=4))]
    fn equilibrium<'py>(
        &self,
        py: Python<'py>,
        held: bool,
        thermal_balance: bool,
        load_steps: u32,
    ) -> PyResult<Bound<'py, PyDict>> {
        let found = self.world().find_rest(Rest {
            held,
            thermal_balance,
            load_steps,
        })?;
        let report = PyDict::new(py);
        report.set_item("residual", found.residual)?;
        report.set_item("heat", found.heat)?;
        report.set_item("followed", found.followed)?;
        report.set_item("load_steps", found.load_steps)?;
        report.set_item("iterations", found.iterations)?;
        report.set_item("friction_steps", found.friction_steps)?;
        Ok(report)
    }

    #[pyo3(signature = (scheme="auto", *, step, tolerance=None))]
    fn simulate(&self, scheme: &str, step: f64, tolerance: Option<f64>) -> PyResult<Simulation> {
        let scheme = self::scheme(scheme)?;
        let world = {
            let world = self.world();
            // With the same lineage: it knows all handles so far, and none that come later.
            world.copy(world.lineage.clone())
        };
        let run = Simulation::new(world, scheme, step)?;
        if let Some(relative) = tolerance {
            run.control(self::tolerance(relative, [0.0; 3], None))?;
        }
        Ok(run)
    }

    #[pyo3(signature = (vary, scheme="auto", *, step, until=None, times=None, tolerance=None, threads=0))]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn ensemble(
        &self,
        py: Python<'_>,
        vary: &Bound<'_, PyDict>,
        scheme: &str,
        step: f64,
        until: Option<f64>,
        times: Option<&Bound<'_, PyAny>>,
        tolerance: Option<f64>,
        threads: usize,
    ) -> PyResult<Py<PyAny>> {
        let world = self.copied(py)?;
        let tolerance = tolerance.map(|relative| self::tolerance(relative, [0.0; 3], None));
        let scheme = self::scheme(scheme)?;
        let request = Request::new(&world, vary, until, times)?;
        request.run(py, (scheme, step), tolerance, threads)
    }

    #[classmethod]
    fn _restored(
        class: &Bound<'_, PyType>,
        dim: usize,
        acts: &str,
        materials: Vec<Bound<'_, Material>>,
        functions: Vec<Bound<'_, PyAny>>,
        lineage: &Bound<'_, Lineage>,
    ) -> PyResult<Self> {
        let acts: Vec<Act> = serde_json::from_str(acts)
            .map_err(|error| error::checkpoint(format!("this is no pickled scene: {error}")))?;
        let mut world = World::new(dim, lineage.get().copy(class.py())?)?;
        for material in &materials {
            world.material(material);
        }
        for function in &functions {
            world.function(function);
        }
        world.acts = acts.into();
        world.rebuild()?;
        Ok(Self::of(world))
    }

    fn __reduce__(slf: &Bound<'_, Self>) -> PyResult<(Py<PyAny>, State)> {
        let py = slf.py();
        let world = slf.get().world();
        let acts = serde_json::to_string(&*world.acts);
        let acts = acts.map_err(|error| error::checkpoint(error.to_string()))?;
        let materials = world
            .materials
            .iter()
            .map(|one| one.clone_ref(py))
            .collect();
        let functions = world.context.functions.iter();
        let functions = functions.map(|function| function.0.clone_ref(py)).collect();
        let state = (world.dim, acts, materials, functions, world.lineage.clone());
        Ok((slf.get_type().getattr("_restored")?.unbind(), state))
    }

    fn __copy__(slf: &Bound<'_, Self>) -> PyResult<Self> {
        Ok(Self::of(slf.get().copied(slf.py())?))
    }

    fn __deepcopy__(slf: &Bound<'_, Self>, _memo: &Bound<'_, PyAny>) -> PyResult<Self> {
        Self::__copy__(slf)
    }

    fn __repr__(&self) -> String {
        let world = self.world();
        let [nodes, springs, reservoirs, paths] = world.lineage.counts;
        let dim = world.dim;
        format!(
            "Scene(dim={dim}, nodes={nodes}, springs={springs}, reservoirs={reservoirs}, paths={paths})"
        )
    }
}
