//! `eem.Scene`: nodes, springs, reservoirs and loads.

use std::sync::{Mutex, MutexGuard, TryLockError};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyMapping, PyType};

use crate::act::{Act, Bulk, Course, Rest};
use crate::arguments::as_dict;
use crate::ensemble::Request;
use crate::handle::{
    Element, ElementArray, Kind, Lineage, Node, NodeArray, Reservoir, ReservoirArray, indices, one,
};
use crate::material::Material;
use crate::setting::{Pace, scheme, tolerance};
use crate::simulation::Simulation;
use crate::study::{Plan, settings};
use crate::world::{State, World};
use crate::{handle, input};

/// A scene in one, two or three dimensions: anchors, masses, springs, reservoirs and loads.
///
/// >>> import eem
/// >>> scene = eem.Scene(dim=2)
/// >>> scene.anchor([0, 0]), scene.mass(1.0, [3, 0], momentum=[0, 1])
/// (Node(0), Node(1))
#[pyclass(frozen, name = "Scene", module = "eem")]
pub(crate) struct PyScene {
    world: Mutex<World>,
}

impl PyScene {
    pub(crate) fn of(world: World) -> Self {
        Self {
            world: Mutex::new(world),
        }
    }

    /// An error while it is changed elsewhere: by another thread, or by a call that has called a function of its own.
    fn world(&self) -> PyResult<MutexGuard<'_, World>> {
        match self.world.try_lock() {
            Ok(world) => Ok(world),
            // A panic while it was changed has left its acts as they were.
            Err(TryLockError::Poisoned(world)) => Ok(world.into_inner()),
            Err(TryLockError::WouldBlock) => Err(PyRuntimeError::new_err(
                "the scene is in use, in another thread or in this call",
            )),
        }
    }

    /// A copy of what is in it. Its number is asked for before the lock, as another thread may go on meanwhile.
    pub(crate) fn copied(&self, py: Python<'_>) -> PyResult<World> {
        let own = handle::random(py)?;
        let world = self.world()?;
        Ok(world.copy(world.lineage.copy(own)))
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
    fn dim(&self) -> PyResult<usize> {
        Ok(self.world()?.dim)
    }

    /// All anchors and masses.
    #[getter]
    fn nodes(&self) -> PyResult<NodeArray> {
        let Lineage { own, counts, .. } = self.world()?.lineage;
        Ok(NodeArray::of(own, 0..counts[Kind::Node as usize]))
    }

    /// All springs, and points of solids.
    #[getter]
    fn elements(&self) -> PyResult<ElementArray> {
        let Lineage { own, counts, .. } = self.world()?.lineage;
        Ok(ElementArray::of(own, 0..counts[Kind::Element as usize]))
    }

    /// The materials of its springs and solids.
    #[getter]
    fn materials<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        PyList::new(py, self.world()?.materials.iter().map(|one| one.bind(py)))
    }

    /// A node that does not move, at a position of `dim` numbers, m.
    fn anchor(&self, position: &Bound<'_, PyAny>) -> PyResult<Node> {
        let mut world = self.world()?;
        let positions = input::vector(position, world.dim, "the position")?;
        let index = world.lineage.counts[Kind::Node as usize];
        world.act(Act::Anchors { positions })?;
        Ok(Node::of(world.lineage.own, index))
    }

    /// Many anchors, at positions of the shape (n, dim).
    fn anchors(&self, positions: &Bound<'_, PyAny>) -> PyResult<NodeArray> {
        let mut world = self.world()?;
        let positions = input::rows(positions, world.dim, "positions")?;
        let first = world.lineage.counts[Kind::Node as usize];
        world.act(Act::Anchors { positions })?;
        let Lineage { own, counts, .. } = world.lineage;
        Ok(NodeArray::of(own, first..counts[Kind::Node as usize]))
    }

    /// A mass, kg, at a position, m, with a velocity, m/s, or a momentum, kg m/s; at rest without both.
    #[pyo3(signature = (mass, position, velocity=None, *, momentum=None))]
    fn mass(
        &self,
        mass: &Bound<'_, PyAny>,
        position: &Bound<'_, PyAny>,
        velocity: Option<&Bound<'_, PyAny>>,
        momentum: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Node> {
        let mut world = self.world()?;
        let dim = world.dim;
        let place = vec![input::number(mass, "the mass")?];
        let place = (place, input::vector(position, dim, "the position")?);
        let velocity = velocity.map(|given| input::vector(given, dim, "the velocity"));
        let momentum = momentum.map(|given| input::vector(given, dim, "the momentum"));
        let index = world.masses(place, [velocity.transpose()?, momentum.transpose()?])?;
        Ok(Node::of(world.lineage.own, index))
    }

    /// Many masses at positions of the shape (n, dim); one mass for all, or n. Velocities or momenta likewise.
    #[pyo3(signature = (masses, positions, velocities=None, *, momenta=None))]
    fn masses(
        &self,
        masses: &Bound<'_, PyAny>,
        positions: &Bound<'_, PyAny>,
        velocities: Option<&Bound<'_, PyAny>>,
        momenta: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<NodeArray> {
        let mut world = self.world()?;
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

    /// A spring of a material between two nodes.
    ///
    /// A material with a temperature needs one at the start, K. The viscous stretches of its dashpots in series are zero
    /// unless they are given, m.
    ///
    /// >>> import eem
    /// >>> scene = eem.Scene(dim=1)
    /// >>> ends = scene.anchor([0.0]), scene.mass(1.0, [1.5])
    /// >>> spring = scene.spring(eem.Material("|x: Stretch| 2 * (x - 1).powi(2)"), ends)
    /// >>> scene.simulate("eem-entropy", step=0.1).force(spring)
    /// 2.0
    #[pyo3(signature = (material, nodes, *, temperature=None, viscous_stretch=None))]
    fn spring(
        &self,
        material: &Bound<'_, Material>,
        nodes: &Bound<'_, PyAny>,
        temperature: Option<&Bound<'_, PyAny>>,
        viscous_stretch: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Element> {
        let mut world = self.world()?;
        let pair = world.pair(nodes)?;
        let index = world.springs(material, vec![pair], temperature, viscous_stretch)?;
        Ok(Element::of(world.lineage.own, index))
    }

    /// Many springs of one material between pairs of nodes: handles, or an array of numbers of nodes of the shape (n, 2).
    ///
    /// Temperatures are one for all, or n; viscous stretches are of the shape (dashpots,) or (n, dashpots).
    #[pyo3(signature = (material, pairs, *, temperature=None, viscous_stretch=None))]
    fn springs(
        &self,
        material: &Bound<'_, Material>,
        pairs: &Bound<'_, PyAny>,
        temperature: Option<&Bound<'_, PyAny>>,
        viscous_stretch: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<ElementArray> {
        let mut world = self.world()?;
        let pairs = pairs.try_iter()?.map(|pair| world.pair(&pair?));
        let pairs: Vec<_> = pairs.collect::<PyResult<_>>()?;
        let count = pairs.len();
        let first = world.springs(material, pairs, temperature, viscous_stretch)?;
        Ok(ElementArray::of(world.lineage.own, first..first + count))
    }

    /// A solid of a material whose ψ is per volume, with a mesh: positions of its nodes, m, `(n, dim)`, and the nodes of its
    /// cells, `(m, 4)` in the plane, counterclockwise, or `(m, 8)` in space, the lower four counterclockwise seen from above,
    /// then the upper four.
    ///
    /// Density in kg/m³; thickness of a plane one in m; `conductivity` in W/(m K), without which its points are insulated; `fibres`
    /// are the directions of its fibre strains, `(fibres, dim)`; the mass is consistent unless it is `lumped`. The temperature at
    /// the start is one for all points, or `(points,)`; the velocity one for all nodes, or `(n, dim)`.
    ///
    /// It returns an `eem.Solid` with its `nodes`, its `points` with a temperature each, cell by cell, and its `cells` in numbers
    /// of nodes of the scene.
    #[pyo3(signature = (
        material, positions, cells, *, density, thickness=None, conductivity=None, fibres=None, lumped=false,
        allow_skew_cells=false, temperature=None, velocity=None
    ))]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn solid(
        &self,
        py: Python<'_>,
        material: &Bound<'_, Material>,
        positions: &Bound<'_, PyAny>,
        cells: &Bound<'_, PyAny>,
        density: &Bound<'_, PyAny>,
        thickness: Option<&Bound<'_, PyAny>>,
        conductivity: Option<&Bound<'_, PyAny>>,
        fibres: Option<&Bound<'_, PyAny>>,
        lumped: bool,
        allow_skew_cells: bool,
        temperature: Option<&Bound<'_, PyAny>>,
        velocity: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Py<PyAny>> {
        let mut world = self.world()?;
        let bulk = world.bulk([Some(density), thickness, conductivity, fibres])?;
        let bulk = Bulk {
            lumped,
            allow_skew_cells,
            ..bulk
        };
        let mesh = [positions, cells];
        world.solid(py, material, mesh, bulk, [temperature, velocity])
    }

    /// Holds nodes of solids where they are; `move_anchor` moves them then.
    fn fix(&self, nodes: &Bound<'_, PyAny>) -> PyResult<()> {
        let mut world = self.world()?;
        let (nodes, _) = indices::<Node>(nodes, &world.lineage)?;
        world.act(Act::Fixed { nodes })
    }

    /// The temperatures of springs and of points of solids at the start, K.
    fn set_temperature(
        &self,
        springs: &Bound<'_, PyAny>,
        temperature: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let mut world = self.world()?;
        let (elements, _) = indices::<Element>(springs, &world.lineage)?;
        let values = input::numbers(temperature, elements.len(), "the temperature")?;
        world.act(Act::Temperatures { elements, values })
    }

    /// A reservoir of heat with a temperature, K: a number, or a function of the time in s.
    fn reservoir(&self, temperature: &Bound<'_, PyAny>) -> PyResult<Reservoir> {
        let mut world = self.world()?;
        let index = world.lineage.counts[Kind::Reservoir as usize];
        let act = match world.course(temperature, "the temperature")? {
            Course::Function(function) => Act::Oven { function },
            Course::Constant(temperatures) => Act::Reservoirs { temperatures },
        };
        world.act(act)?;
        Ok(Reservoir::of(world.lineage.own, index))
    }

    /// Many reservoirs with constant temperatures, K.
    fn reservoirs(&self, temperatures: &Bound<'_, PyAny>) -> PyResult<ReservoirArray> {
        let mut world = self.world()?;
        let temperatures = input::list(Some(temperatures), "temperatures")?.unwrap_or_default();
        let first = world.lineage.counts[Kind::Reservoir as usize];
        world.act(Act::Reservoirs { temperatures })?;
        let Lineage { own, counts, .. } = world.lineage;
        Ok(ReservoirArray::of(
            own,
            first..counts[Kind::Reservoir as usize],
        ))
    }

    /// A path of heat from a spring to a reservoir or to another spring, with a conductance in W/K. Of many springs: to one
    /// partner, or to as many.
    fn conduct<'py>(
        &self,
        py: Python<'py>,
        springs: &Bound<'py, PyAny>,
        partners: &Bound<'py, PyAny>,
        conductance: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.world()?.paths(py, springs, partners, conductance)
    }

    /// The acceleration of all masses, m/s².
    fn set_gravity(&self, gravity: &Bound<'_, PyAny>) -> PyResult<()> {
        let mut world = self.world()?;
        let gravity = input::vector(gravity, world.dim, "gravity")?;
        world.act(Act::Gravity { gravity })
    }

    /// A force on masses, N: constant, or a function of the time in s.
    ///
    /// What such a function raises comes out of the step that calls it. It is called once or a few times in a step, which
    /// takes some microseconds; it must depend on the time only.
    fn force(&self, nodes: &Bound<'_, PyAny>, force: &Bound<'_, PyAny>) -> PyResult<()> {
        let mut world = self.world()?;
        let (nodes, _) = indices::<Node>(nodes, &world.lineage)?;
        let force = if force.is_callable() {
            Course::Function(world.function(force))
        } else {
            Course::Constant(input::vector(force, world.dim, "the force")?)
        };
        world.act(Act::Force { nodes, force })
    }

    /// A thrust on a node in the direction from the node `tail` to `head`, N: constant, or a function of the time in s.
    fn rocket(
        &self,
        node: &Bound<'_, PyAny>,
        tail: &Bound<'_, PyAny>,
        head: &Bound<'_, PyAny>,
        thrust: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let mut world = self.world()?;
        let nodes = [
            one::<Node>(node, &world.lineage)?,
            one::<Node>(tail, &world.lineage)?,
            one::<Node>(head, &world.lineage)?,
        ];
        let thrust = world.course(thrust, "the thrust")?;
        world.act(Act::Rocket { nodes, thrust })
    }

    /// Moves an anchor: its position, m, as a function of the time in s, which begins where it was put.
    fn move_anchor(&self, anchor: &Bound<'_, PyAny>, position: &Bound<'_, PyAny>) -> PyResult<()> {
        let mut world = self.world()?;
        let anchor = one::<Node>(anchor, &world.lineage)?;
        let function = world.function(position);
        world.act(Act::Motion { anchor, function })
    }

    /// A thermostat: the temperature of a spring, K, constant from the start on, or a function of the time in s.
    fn hold_temperature(
        &self,
        spring: &Bound<'_, PyAny>,
        temperature: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let mut world = self.world()?;
        let element = one::<Element>(spring, &world.lineage)?;
        let temperature = world.course(temperature, "the temperature")?;
        world.act(Act::Thermostat {
            element,
            temperature,
        })
    }

    /// Steps end at each of these times, s: where a load jumps.
    fn stop_at(&self, times: &Bound<'_, PyAny>) -> PyResult<()> {
        let times = input::list(Some(times), "times")?.unwrap_or_default();
        self.world()?.act(Act::Stops { times })
    }

    /// Says that nothing that a load does lasts less than this, s, so that no controlled step passes over it.
    fn shortest_load(&self, duration: f64) -> PyResult<()> {
        self.world()?.act(Act::ShortestLoad { duration })
    }

    /// The time at which runs begin, s.
    fn start_at(&self, time: f64) -> PyResult<()> {
        self.world()?.act(Act::Start { time })
    }

    /// Moves the scene into a stable state at rest under its loads at the start: dashpots relaxed, or held as they are;
    /// temperatures as they are, or in thermal balance. Returns how it was found: `residual` in N, `heat` in W, and the
    /// effort. On an error the scene is as it was.
    #[pyo3(signature = (*, held=false, thermal_balance=false, load_steps=4))]
    fn equilibrium<'py>(
        &self,
        py: Python<'py>,
        held: bool,
        thermal_balance: bool,
        load_steps: u32,
    ) -> PyResult<Bound<'py, PyDict>> {
        let rest = Rest {
            held,
            thermal_balance,
            load_steps,
        };
        as_dict(py, &self.world()?.find_rest(rest)?)
    }

    /// Starts a run with constant steps, s, or a relative tolerance that controls them; with both, the step is the first to try.
    /// The scene stays as it is, and can be changed and started again. Everything that is wrong with it is told at once.
    #[pyo3(signature = (scheme="auto", *, step=None, tolerance=None))]
    fn simulate(
        &self,
        scheme: &str,
        step: Option<f64>,
        tolerance: Option<f64>,
    ) -> PyResult<Simulation> {
        let scheme = self::scheme(scheme)?;
        let pace = Pace::new(step, tolerance)?;
        Simulation::new(self.world()?.twin(), scheme, pace)
    }

    /// Runs this scene once for each value of parameters, on all cores, or on so many threads.
    ///
    /// `vary` has a dictionary for each material: the names of parameters, with a list of values as long as the ensemble.
    /// States are recorded at the end `until`, or at `times`, without changing the steps.
    /// >>> import eem
    /// >>> scene, hooke = eem.Scene(dim=1), eem.Material("|x: Stretch| 0.5 * k * (x - 1).powi(2)", k=1.0)
    /// >>> ends = scene.anchor([0.0]), scene.mass(1.0, [1.1])
    /// >>> spring = scene.spring(hooke, ends)
    /// >>> found = scene.ensemble({hooke: {"k": [1.0, 4.0, 9.0]}}, "eem-entropy-6", step=0.05, until=1.0)
    /// >>> found.position(ends[1])[:, 0, 0].round(5).tolist()
    /// [1.05403, 0.95839, 0.901]
    #[pyo3(signature = (vary, scheme="auto", *, step, until=None, times=None, tolerance=None, threads=0))]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn ensemble(
        &self,
        py: Python<'_>,
        vary: &Bound<'_, PyMapping>,
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
        Request::new(&world, vary, until, times)?.run(py, (scheme, step), tolerance, threads)
    }

    /// Runs this scene for so many seconds with each of the schemes, with each of the steps, s, and with step control at each of the
    /// tolerances, and returns an `eem.StudyReport`: what each costs, and how far its end is from that of two independent references.
    /// Schemes with others each are a dictionary: `{"gauss-4": {"steps": [0.1, 0.05]}, "eem-explicit": {"tolerances": [1e-3]}}`.
    ///
    /// The report recommends a setting for each of `accuracies`, 1e-2, 1e-4 and 1e-6 if none are given. Each setting is timed `repeats`
    /// times; the references take steps up to `refinement` times smaller. Steps are constant, with `"auto"` too. Ctrl-C ends it.
    ///
    /// >>> import eem
    /// >>> hooke = eem.Material("|x: Stretch| 0.5 * k * (x - 1).powi(2)", k=20.0)
    /// >>> scene = eem.Scene(dim=2)
    /// >>> ends = scene.anchor([0.0, 0.0]), scene.mass(1.0, [1.1, 0.0], [0.0, 1.0])
    /// >>> spring = scene.spring(hooke, ends)
    /// >>> report = scene.study(2.0, ["eem-entropy", "variational-4"], steps=[0.1, 0.05, 0.025])
    /// >>> [round(report.order(scheme, "q")) for scheme in ("eem-entropy", "variational-4")]
    /// [2, 4]
    /// >>> report.recommend(1e-4).fastest.scheme
    /// 'variational-4'
    #[pyo3(
        signature = (duration, schemes, *, steps=None, tolerances=None, accuracies=None, repeats=3, refinement=32)
    )]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn study(
        &self,
        py: Python<'_>,
        duration: f64,
        schemes: &Bound<'_, PyAny>,
        steps: Option<&Bound<'_, PyAny>>,
        tolerances: Option<&Bound<'_, PyAny>>,
        accuracies: Option<&Bound<'_, PyAny>>,
        repeats: usize,
        refinement: u32,
    ) -> PyResult<Py<PyAny>> {
        let asked = settings(schemes, steps, tolerances)?;
        Plan::new(duration, asked, accuracies, (repeats, refinement))?
            .into_python(py, &self.copied(py)?)
    }

    #[classmethod]
    fn _restored(class: &Bound<'_, PyType>, state: State) -> PyResult<Self> {
        Ok(Self::of(World::restored(class.py(), state)?))
    }

    fn __reduce__(slf: &Bound<'_, Self>) -> PyResult<(Py<PyAny>, (State,))> {
        let state = slf.get().world()?.state(slf.py())?;
        Ok((slf.get_type().getattr("_restored")?.unbind(), (state,)))
    }

    fn __copy__(slf: &Bound<'_, Self>) -> PyResult<Self> {
        Ok(Self::of(slf.get().copied(slf.py())?))
    }

    fn __deepcopy__(slf: &Bound<'_, Self>, _memo: &Bound<'_, PyAny>) -> PyResult<Self> {
        Self::__copy__(slf)
    }

    fn __repr__(&self) -> PyResult<String> {
        Ok(self.world()?.shown())
    }
}
