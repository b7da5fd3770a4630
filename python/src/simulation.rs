//! Runs: `eem.Simulation`.

use std::sync::{Arc, Mutex, MutexGuard, TryLockError};

use eem::{Checkpoint, RunEnd, SceneError, Scheme, Tolerance};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyType};

use crate::built::Parts;
use crate::function::take_raised;
use crate::handle::{Element, Kind, Node};
use crate::record::{Rows, Wanted, ledger, record};
use crate::report::Report;
use crate::run::{AnyRun, Stop};
use crate::setting::scheme;
use crate::watch::Watch;
use crate::world::{State, World};
use crate::{error, input, setting};

/// A run of a scene, made by `Scene.simulate`. It is pickled and copied with all bits.
#[pyclass(frozen, module = "eem")]
pub(crate) struct Simulation {
    /// Empty only while the scheme is changed.
    run: Mutex<Option<Box<dyn AnyRun>>>,
    /// The scene as it was at the start.
    world: World,
    parts: Arc<Parts>,
    /// The step at the start, s.
    step: f64,
}

/// A run that nobody else steps.
struct Locked<'a>(MutexGuard<'a, Option<Box<dyn AnyRun>>>);

impl Locked<'_> {
    fn run(&mut self) -> PyResult<&mut Box<dyn AnyRun>> {
        self.0.as_mut().ok_or_else(interrupted)
    }
}

fn interrupted() -> PyErr {
    PyRuntimeError::new_err("a panic has interrupted this simulation: start it again")
}

impl Simulation {
    pub(crate) fn new(world: World, scheme: Scheme, step: f64) -> PyResult<Self> {
        let run = world.start(scheme, step)?;
        Ok(Self {
            run: Mutex::new(Some(run)),
            parts: Arc::new(world.scene.parts().clone()),
            world,
            step,
        })
    }

    /// Controls the steps.
    pub(crate) fn control(&self, tolerance: Tolerance<f64>) -> PyResult<()> {
        self.ask(|run| run.control_steps(tolerance))
    }

    /// An error while another thread steps it.
    fn lock(&self) -> PyResult<Locked<'_>> {
        match self.run.try_lock() {
            Ok(guard) => Ok(Locked(guard)),
            Err(TryLockError::WouldBlock) => Err(PyRuntimeError::new_err(
                "the simulation is running, in another thread or in this call",
            )),
            Err(TryLockError::Poisoned(_)) => Err(interrupted()),
        }
    }

    /// Asks the run for something.
    fn ask<T>(
        &self,
        question: impl FnOnce(&mut dyn AnyRun) -> Result<T, SceneError>,
    ) -> PyResult<T> {
        question(&mut **self.lock()?.run()?).map_err(error::of_scene)
    }

    fn ask_element(
        &self,
        element: &Element,
        question: impl FnOnce(&dyn AnyRun, eem::Element) -> Result<f64, SceneError>,
    ) -> PyResult<f64> {
        let element = self.element(element)?;
        self.ask(|run| question(run, element))
    }

    fn element(&self, element: &Element) -> PyResult<eem::Element> {
        let index = self.world.lineage.index(Kind::Element, element.id())?;
        Ok(self.parts.elements[index])
    }

    fn node(&self, node: &Node) -> PyResult<eem::Node> {
        let index = self.world.lineage.index(Kind::Node, node.id())?;
        Ok(self.parts.nodes[index])
    }

    fn vector<'py>(
        &self,
        py: Python<'py>,
        node: &Node,
        add: impl FnOnce(&dyn AnyRun, eem::Node, &mut Vec<f64>) -> Result<(), SceneError>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let node = self.node(node)?;
        let mut vector = Vec::with_capacity(self.world.dim);
        self.ask(|run| add(run, node, &mut vector))?;
        Ok(PyArray1::from_vec(py, vector))
    }

    fn vectors<'py>(
        &self,
        py: Python<'py>,
        add: impl Fn(&dyn AnyRun, eem::Node, &mut Vec<f64>) -> Result<(), SceneError>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let (dim, nodes) = (self.world.dim, &self.parts.nodes);
        let mut vectors = Vec::with_capacity(dim * nodes.len());
        self.ask(|run| {
            nodes
                .iter()
                .try_for_each(|&node| add(run, node, &mut vectors))
        })?;
        PyArray1::from_vec(py, vectors).reshape([nodes.len(), dim])
    }

    /// Runs without the interpreter, and says how it ended and what a signal raised.
    fn advance(
        &self,
        until: f64,
        wanted: Wanted,
        (rows, mut watch): (&mut Rows, Watch),
    ) -> PyResult<Ended> {
        let mut guard = self.lock()?;
        let run = guard.run()?;
        _ = take_raised();
        let parts = &*self.parts;
        rows.add(&**run, parts, wanted.forces)
            .map_err(error::of_scene)?;
        let mut steps = 0_usize;
        let mut is_recorded = true;
        let ended = run.run_until(until, &mut |run, report| {
            steps += 1;
            if let Some(every) = wanted.every {
                rows.add_report(report);
                is_recorded = steps.is_multiple_of(every);
                if is_recorded {
                    rows.add(run, parts, wanted.forces)?;
                }
            } else {
                is_recorded = false;
            }
            Ok(watch.look())
        });
        if !is_recorded {
            rows.add(&**run, parts, wanted.forces)
                .map_err(error::of_scene)?;
        }
        if let Some(signal) = watch.signal {
            return Ok(Ended::Signal(signal));
        }
        Ok(match ended {
            Ok(RunEnd::Reached) => Ended::Reached,
            Ok(RunEnd::Stopped | RunEnd::Event(_)) => return Err(interrupted()),
            Err(Stop::Scene(error)) => return Err(error::of_scene(error)),
            Err(Stop::Step(error)) => match take_raised() {
                Some(raised) => return Err(raised),
                None => Ended::Failed(Box::new(error)),
            },
        })
    }
}

/// What a pickle contains: the scene, the scheme, the step and a checkpoint.
type Resumed = (State, &'static str, f64, String);

/// How a run ended.
enum Ended {
    Reached,
    /// With what the handler of a signal raised.
    Signal(PyErr),
    Failed(Box<eem::StepError>),
}

#[pymethods]
impl Simulation {
    /// The time, s.
    #[getter]
    fn time(&self) -> PyResult<f64> {
        self.ask(|run| Ok(run.time()))
    }

    /// The name of the scheme.
    #[getter]
    fn scheme(&self) -> PyResult<&'static str> {
        self.ask(|run| Ok(run.scheme().name()))
    }

    /// The name of the scheme of the present steps, if the scheme is `auto`.
    #[getter]
    fn scheme_in_use(&self) -> PyResult<&'static str> {
        self.ask(|run| Ok(run.scheme_in_use().name()))
    }

    /// The size of the next step, s.
    #[getter]
    fn step_size(&self) -> PyResult<f64> {
        self.ask(|run| Ok(run.step_size()))
    }

    #[setter]
    fn set_step_size(&self, step: f64) -> PyResult<()> {
        self.ask(|run| run.set_step_size(step))
    }

    /// Positions of all nodes, m.
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.vectors(py, |run, node, to| run.add_position(node, to))
    }

    /// Momenta of all nodes, kg m/s.
    #[getter]
    fn p<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        self.vectors(py, |run, node, to| run.add_momentum(node, to))
    }

    /// Where a node is, m.
    fn position<'py>(
        &self,
        py: Python<'py>,
        node: &Bound<'py, Node>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.vector(py, node.get(), |run, node, to| run.add_position(node, to))
    }

    /// The momentum of a node, kg m/s.
    fn momentum<'py>(
        &self,
        py: Python<'py>,
        node: &Bound<'py, Node>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        self.vector(py, node.get(), |run, node, to| run.add_momentum(node, to))
    }

    /// The temperature of a spring, K.
    fn temperature(&self, spring: &Bound<'_, Element>) -> PyResult<f64> {
        self.ask_element(spring.get(), |run, element| run.temperature(element))
    }

    /// The entropy of a spring, J/K.
    fn entropy(&self, spring: &Bound<'_, Element>) -> PyResult<f64> {
        self.ask_element(spring.get(), |run, element| run.entropy(element))
    }

    /// The internal energy of a spring, J.
    fn internal_energy(&self, spring: &Bound<'_, Element>) -> PyResult<f64> {
        self.ask_element(spring.get(), |run, element| run.internal_energy(element))
    }

    /// The length of a spring, m.
    fn stretch(&self, spring: &Bound<'_, Element>) -> PyResult<f64> {
        self.ask_element(spring.get(), |run, element| run.stretch(element))
    }

    /// The force of a spring, N, positive in tension.
    fn force(&self, spring: &Bound<'_, Element>) -> PyResult<f64> {
        self.ask_element(spring.get(), |run, element| run.force(element))
    }

    /// The viscous stretch of a dashpot in series of a spring, m.
    #[pyo3(signature = (spring, dashpot=0))]
    fn viscous_stretch(&self, spring: &Bound<'_, Element>, dashpot: usize) -> PyResult<f64> {
        self.ask_element(spring.get(), |run, element| {
            run.viscous_stretch(element, dashpot)
        })
    }

    /// Energies, entropies and momenta of the present state, by name.
    fn ledger(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        ledger(py, &**self.lock()?.run()?)
    }

    /// The step with the largest defect relative to its bound.
    #[getter]
    fn worst_step(&self) -> PyResult<Option<Report>> {
        self.ask(|run| Ok(run.worst_step().map(Report::from)))
    }

    /// Makes one step and returns what it proves. After an error the simulation is as it was.
    fn step(&self) -> PyResult<Report> {
        let mut guard = self.lock()?;
        let run = guard.run()?;
        _ = take_raised();
        match run.step() {
            Ok(report) => Ok(Report::from(&report)),
            Err(error) => Err(take_raised().unwrap_or_else(|| error::step(&error, None))),
        }
    }

    /// Steps until a time, s, which is met exactly, and returns a record with the present state and that of every k-th step,
    /// or only of the last one with `every=None`; with the lengths and forces of springs if `forces` is set.
    ///
    /// Other threads of Python go on meanwhile. Ctrl-C ends it after a step and returns the record so far, whose `end` is
    /// then `"interrupted"`. A `StepError` has the record so far.
    #[pyo3(signature = (until, *, every=Some(1), forces=false), text_signature = "($self, until, *, every=1, forces=False)")]
    fn run(
        &self,
        py: Python<'_>,
        until: f64,
        every: Option<usize>,
        forces: bool,
    ) -> PyResult<Py<PyAny>> {
        if every == Some(0) {
            let message = "every is 0, it must be a positive number of steps, or None";
            return Err(PyValueError::new_err(message));
        }
        let mut rows = Rows::default();
        let wanted = Wanted { every, forces };
        let watch = Watch::new(py)?;
        let ended = py.detach(|| self.advance(until, wanted, (&mut rows, watch)))?;
        let end = match ended {
            Ended::Reached => "reached",
            Ended::Signal(_) => "interrupted",
            Ended::Failed(_) => "failed",
        };
        let scene = (self.world.dim, &self.parts, &self.world.lineage);
        let record = record(py, rows, scene, end, self.scheme()?)?;
        match ended {
            Ended::Failed(error) => Err(error::step(&error, Some(record))),
            Ended::Signal(signal) if !signal.is_instance_of::<PyKeyboardInterrupt>(py) => {
                Err(signal)
            }
            _ => Ok(record),
        }
    }

    /// Adapts the steps to a relative tolerance, and absolute ones in m, kg m/s and K; with `over` for the errors of all steps
    /// in so many seconds, instead of those in a period of the vibration.
    #[pyo3(signature = (tolerance, *, position=0.0, momentum=0.0, temperature=0.0, over=None))]
    fn control_steps(
        &self,
        tolerance: f64,
        position: f64,
        momentum: f64,
        temperature: f64,
        over: Option<f64>,
    ) -> PyResult<()> {
        self.control(setting::tolerance(
            tolerance,
            [position, momentum, temperature],
            over,
        ))
    }

    /// Returns to constant steps.
    fn fix_steps(&self) -> PyResult<()> {
        self.ask(|run| {
            run.fix_steps();
            Ok(())
        })
    }

    /// Limits the size of controlled steps, s.
    fn limit_steps(&self, smallest: f64, largest: f64) -> PyResult<()> {
        self.ask(|run| run.limit_steps([smallest, largest]))
    }

    /// Accepted and rejected steps by cause; None without step control.
    #[getter]
    fn step_statistics<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(statistics) = self.ask(|run| Ok(run.step_statistics()))? else {
            return Ok(None);
        };
        let counts = PyDict::new(py);
        counts.set_item("accepted", statistics.accepted)?;
        counts.set_item("rejected_by_error", statistics.rejected_by_error)?;
        counts.set_item("rejected_by_newton", statistics.rejected_by_newton)?;
        counts.set_item("rejected_by_domain", statistics.rejected_by_domain)?;
        counts.set_item("rejected_by_law", statistics.rejected_by_law)?;
        counts.set_item("changes_of_scheme", statistics.changes_of_scheme)?;
        Ok(Some(counts))
    }

    /// The force on a mass, N, from now on.
    fn set_force(&self, node: &Bound<'_, Node>, force: &Bound<'_, PyAny>) -> PyResult<()> {
        let force = input::vector(force, self.world.dim, "the force")?;
        let node = self.node(node.get())?;
        self.ask(|run| run.set_force(node, &force))
    }

    /// The velocity of an anchor, m/s, from now on.
    fn set_motion(&self, anchor: &Bound<'_, Node>, velocity: &Bound<'_, PyAny>) -> PyResult<()> {
        let velocity = input::vector(velocity, self.world.dim, "the velocity")?;
        let anchor = self.node(anchor.get())?;
        self.ask(|run| run.set_motion(anchor, &velocity))
    }

    /// The temperature of a thermostat at the end of the next step, K.
    fn set_temperature(&self, spring: &Bound<'_, Element>, temperature: f64) -> PyResult<()> {
        let element = self.element(spring.get())?;
        self.ask(|run| run.set_temperature(element, temperature))
    }

    /// Goes on with another scheme: time, state and balances stay.
    fn change_scheme(&self, scheme: &str) -> PyResult<()> {
        let scheme = self::scheme(scheme)?;
        let mut guard = self.lock()?;
        let run = guard.0.take().ok_or_else(interrupted)?;
        let (run, result) = match run.with_scheme(scheme) {
            Ok(run) => (run, Ok(())),
            Err((run, error)) => (run, Err(error::of_scene(error))),
        };
        *guard.0 = Some(run);
        result
    }

    /// Everything that further steps depend on, as text. A restored run has the same bits.
    fn checkpoint(&self) -> PyResult<String> {
        let checkpoint = self.ask(|run| Ok(run.checkpoint()))?;
        let text = serde_json::to_string(&checkpoint);
        text.map_err(|error| error::checkpoint(error.to_string()))
    }

    /// Goes back, or on, to a checkpoint of a run of the same scene with the same scheme.
    fn restore(&self, checkpoint: &str) -> PyResult<()> {
        let checkpoint: Checkpoint = serde_json::from_str(checkpoint)
            .map_err(|error| error::checkpoint(format!("this is no checkpoint: {error}")))?;
        let mut guard = self.lock()?;
        let restored = guard.run()?.restore(&checkpoint);
        restored.map_err(|error| error::checkpoint(error.to_string()))
    }

    #[classmethod]
    fn _restored(
        class: &Bound<'_, PyType>,
        state: State,
        scheme: &str,
        step: f64,
        checkpoint: &str,
    ) -> PyResult<Self> {
        let world = World::restored(class.py(), state)?;
        let restored = Self::new(world, self::scheme(scheme)?, step)?;
        restored.restore(checkpoint)?;
        Ok(restored)
    }

    fn __reduce__(slf: &Bound<'_, Self>) -> PyResult<(Py<PyAny>, Resumed)> {
        let own = slf.get();
        let state = own.world.state(slf.py())?;
        let make = slf.get_type().getattr("_restored")?.unbind();
        Ok((make, (state, own.scheme()?, own.step, own.checkpoint()?)))
    }

    fn __copy__(slf: &Bound<'_, Self>) -> PyResult<Self> {
        let own = slf.get();
        let world = own.world.copy(own.world.lineage.copy(slf.py())?);
        let copy = Self::new(world, scheme(own.scheme()?)?, own.step)?;
        copy.restore(&own.checkpoint()?)?;
        Ok(copy)
    }

    fn __deepcopy__(slf: &Bound<'_, Self>, _memo: &Bound<'_, PyAny>) -> PyResult<Self> {
        Self::__copy__(slf)
    }

    fn __repr__(&self) -> PyResult<String> {
        let [nodes, springs, ..] = self.parts.counts();
        self.ask(|run| {
            Ok(format!(
                "Simulation('{}', time={:?}, step_size={:?}, nodes={nodes}, springs={springs})",
                run.scheme().name(),
                run.time(),
                run.step_size(),
            ))
        })
    }
}
