//! Runs: `eem.Simulation`.

mod access;

use std::sync::{Arc, Mutex};

use eem::{Checkpoint, History};
use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyMapping, PyType};

use access::{Ended, interrupted};

use crate::built::Parts;
use crate::function::take_raised;
use crate::handle::{Element, Node, random};
use crate::record::{Rows, Wanted, ledger, record};
use crate::report::Report;
use crate::run::AnyRun;
use crate::sensitivities::Asked;
use crate::setting::{Pace, scheme};
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

/// What a pickle contains: the scene, the scheme, the step and a checkpoint.
type Resumed = (State, &'static str, f64, String);

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

    /// Cauchy's stress at points of solids, Pa, without that of dashpots beside: `(3, 3)` of one, `(n, 3, 3)` of several.
    fn stress<'py>(&self, points: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        self.tensors(points, |run, point| run.stress(point))
    }

    /// Green and Lagrange's strain `½ (FᵀF − 1)` at points of solids: `(3, 3)` of one, `(n, 3, 3)` of several.
    fn strain<'py>(&self, points: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        self.tensors(points, |run, point| run.strain(point))
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

    /// Why the result of the steps so far may mislead although every one has kept its laws; None if nothing speaks for it.
    /// `run` warns of it once, with a `UserWarning`.
    #[getter]
    fn warning(&self) -> PyResult<Option<String>> {
        self.ask(|run| Ok(run.warning()))
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
    /// or only of the last one with `every=None`; with the lengths and forces of springs if `forces` is set. With a list of
    /// `times` instead, steps end at each of them, and the record has the states there.
    ///
    /// Other threads of Python go on meanwhile. Ctrl-C ends it after a step and returns the record so far, whose `end` is
    /// then `"interrupted"`. A `StepError` has the record so far.
    #[pyo3(
        signature = (until=None, *, times=None, every=Some(1), forces=false),
        text_signature = "($self, until=None, *, times=None, every=1, forces=False)"
    )]
    fn run(
        &self,
        py: Python<'_>,
        until: Option<f64>,
        times: Option<&Bound<'_, PyAny>>,
        every: Option<usize>,
        forces: bool,
    ) -> PyResult<Py<PyAny>> {
        if every == Some(0) {
            let message = "every is 0, it must be a positive number of steps, or None";
            return Err(PyValueError::new_err(message));
        }
        let at_times = times.is_some();
        let times = input::times(until, times)?;
        let wanted = Wanted {
            every,
            forces,
            at_times,
        };
        let mut rows = Rows::default();
        let has_warned = self.warning()?.is_some();
        let watch = Watch::new(py)?;
        let ended = py.detach(|| self.advance(&times, wanted, (&mut rows, watch)))?;
        let end = match ended {
            Ended::Reached => "reached",
            Ended::Signal(_) => "interrupted",
            Ended::Failed(_) => "failed",
        };
        let scene = (self.world.dim, &self.parts, &self.world.lineage);
        let record = record(py, rows, scene, end, self.scheme()?)?;
        if !has_warned && let Some(warning) = self.warning()? {
            setting::warn(py, &warning)?;
        }
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

    /// Keeps the states of all further steps, for `gradient`. It changes no bit of the run.
    ///
    /// They take at most so many bytes, 2**30 if nothing is given. Of a longer history some states are kept, and the steps between
    /// them are made again when a gradient is asked for; `snapshots` says how many are kept. Copies and pickles of the
    /// simulation have no history.
    #[pyo3(signature = (*, bytes=None, snapshots=None))]
    fn keep_history(&self, bytes: Option<usize>, snapshots: Option<usize>) -> PyResult<()> {
        let history = match (bytes, snapshots) {
            (None, None) => History::default(),
            (Some(bytes), None) => History::bytes(bytes),
            (None, Some(snapshots)) => History::snapshots(snapshots),
            (Some(_), Some(_)) => {
                let message = "bytes and snapshots are given: give one of them";
                return Err(PyValueError::new_err(message));
            }
        };
        self.ask(|run| {
            run.keep_history(history);
            Ok(())
        })
    }

    /// The derivatives of an `Objective` by all inputs of the run since `keep_history`, as an `eem.Gradient`: exact to rounding,
    /// for less than the cost of the run. Schemes are `"eem-temperature"` and `"eem-entropy"`.
    ///
    /// >>> import eem
    /// >>> scene = eem.Scene(dim=1)
    /// >>> hooke = eem.Material("|x: Stretch| 0.5 * k * (x - 1).powi(2)", k=4.0)
    /// >>> mass = scene.mass(1.0, [1.1])
    /// >>> spring = scene.spring(hooke, [scene.anchor([0.0]), mass])
    /// >>> run = scene.simulate("eem-temperature", step=0.001)
    /// >>> run.keep_history()
    /// >>> record = run.run(until=1.0)
    /// >>> gradient = run.gradient(eem.Objective.at_end("position", mass))
    /// >>> round(gradient.by_parameter(spring, "k"), 6)  # -0.1 sin(2)/4
    /// -0.022732
    fn gradient(&self, py: Python<'_>, objective: &Bound<'_, PyAny>) -> PyResult<Py<PyAny>> {
        let terms = self.terms(objective)?;
        let (world, parts) = (&self.world, &*self.parts);
        let found =
            self.differentiate(py, |run| run.gradient(&terms, parts, &world.context.laws))?;
        found.into_python(py, world, parts)
    }

    /// Finds the gradient of an `Objective` once more and checks it by the tangents of the same steps, from the first to the last:
    /// along a direction in which all inputs but the sizes of steps change, the objective has to change by what the gradient says. A
    /// `GradientError` with the reason `"Disagrees"` says that the two differ by more than 1.5e-8 of the sum of the magnitudes of the
    /// terms: the motion is so sensitive that no digits are left, a formula has a kink, or a load is not a function of time only.
    ///
    /// >>> import eem
    /// >>> scene = eem.Scene(dim=1)
    /// >>> stone = scene.mass(2.0, [0.0], [3.0])
    /// >>> scene.set_gravity([-9.81])
    /// >>> run = scene.simulate("eem-entropy", step=0.01)
    /// >>> run.keep_history()
    /// >>> record = run.run(until=1.0)
    /// >>> run.check_gradient(eem.Objective.at_end("position", stone))
    fn check_gradient(&self, py: Python<'_>, objective: &Bound<'_, PyAny>) -> PyResult<()> {
        let terms = self.terms(objective)?;
        self.differentiate(py, |run| run.check_gradient(&terms))
    }

    /// The derivatives of quantities by some inputs at every state since `keep_history`, as an `eem.Sensitivities`: those of the
    /// steps that were made, as in a `gradient`. There one number is differentiated by all inputs, here any number of quantities
    /// at all times by a few inputs, of which each takes a part of the time of the run.
    ///
    /// Quantities have names of their own: `{"z": ("position", node), "E": "energy"}`, with those of an `Objective`; a third entry
    /// counts the dashpots of a `"viscous_stretch"` from 0.
    ///
    /// >>> import eem
    /// >>> scene = eem.Scene(dim=1)
    /// >>> stone = scene.mass(2.0, [0.0], [3.0])
    /// >>> scene.force(stone, lambda t: [4.0 * t])
    /// >>> run = scene.simulate("eem-entropy", step=0.01)
    /// >>> run.keep_history()
    /// >>> record = run.run(until=1.0)
    /// >>> slope = eem.Input.force(stone, lambda t: [t]).named("a", "N/s")
    /// >>> found = run.sensitivities([eem.Input.mass(stone), slope], {"q": ("position", stone)})
    /// >>> print(*found.names, sep=", ")
    /// q_x by mass of node 0, q_x by a
    /// >>> found.of("q", slope)[-1].round(4).tolist()  # q = 3 t + a t³/6m
    /// [0.0833]
    fn sensitivities(
        &self,
        py: Python<'_>,
        inputs: &Bound<'_, PyAny>,
        quantities: &Bound<'_, PyMapping>,
    ) -> PyResult<Py<PyAny>> {
        let inputs = &inputs.try_iter()?.collect::<PyResult<Vec<_>>>()?;
        let inputs = &PyList::new(py, inputs)?;
        let asked = Asked::of(inputs, quantities, (&self.world, &self.parts))?;
        let found = self.differentiate(py, |run| run.sensitivities(&asked))?;
        asked.into_python(py, inputs, &found, self.world.dim)
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
        let restored = Self::new(world, self::scheme(scheme)?, Pace::Constant(step))?;
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
        let world = own.world.copy(own.world.lineage.copy(random(slf.py())?));
        let copy = Self::new(world, scheme(own.scheme()?)?, Pace::Constant(own.step))?;
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
