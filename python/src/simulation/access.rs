//! How calls of Python reach a run: one at a time, and without the interpreter while it steps.

use std::sync::{Arc, Mutex, MutexGuard, TryLockError};

use eem::{GradientError, RunEnd, SceneError, Scheme, Tolerance};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError};
use pyo3::prelude::*;

use super::Simulation;
use crate::function::take_raised;
use crate::gradient::Term;
use crate::handle::{Element, Kind, Node, indices};
use crate::record::{Rows, Wanted};
use crate::run::{AnyRun, Stop};
use crate::setting::Pace;
use crate::watch::Watch;
use crate::world::World;
use crate::{error, gradient};

/// A run that nobody else steps.
pub(super) struct Locked<'a>(pub(super) MutexGuard<'a, Option<Box<dyn AnyRun>>>);

impl Locked<'_> {
    pub(super) fn run(&mut self) -> PyResult<&mut Box<dyn AnyRun>> {
        self.0.as_mut().ok_or_else(interrupted)
    }
}

pub(super) fn interrupted() -> PyErr {
    PyRuntimeError::new_err("a panic has interrupted this simulation: start it again")
}

impl Simulation {
    pub(crate) fn new(world: World, scheme: Scheme, pace: Pace) -> PyResult<Self> {
        let run = world.start(scheme, pace)?;
        Ok(Self {
            step: run.step_size(),
            run: Mutex::new(Some(run)),
            parts: Arc::new(world.scene.parts().clone()),
            world,
        })
    }

    /// Controls the steps.
    pub(crate) fn control(&self, tolerance: Tolerance) -> PyResult<()> {
        self.ask(|run| run.control_steps(tolerance))
    }

    /// An error while another thread steps it.
    pub(super) fn lock(&self) -> PyResult<Locked<'_>> {
        match self.run.try_lock() {
            Ok(guard) => Ok(Locked(guard)),
            Err(TryLockError::WouldBlock) => Err(PyRuntimeError::new_err(
                "the simulation is running, in another thread or in this call",
            )),
            Err(TryLockError::Poisoned(_)) => Err(interrupted()),
        }
    }

    /// Asks the run for something.
    pub(super) fn ask<T>(
        &self,
        question: impl FnOnce(&mut dyn AnyRun) -> Result<T, SceneError>,
    ) -> PyResult<T> {
        question(&mut **self.lock()?.run()?).map_err(error::of_scene)
    }

    /// The terms of an objective.
    pub(super) fn terms(&self, objective: &Bound<'_, PyAny>) -> PyResult<Vec<Term>> {
        let world = &self.world;
        gradient::terms(objective, (&world.lineage, &self.parts, world.dim))
    }

    /// Asks for derivatives, without the interpreter, and looks for signals in their steps.
    pub(super) fn differentiate<T: Send>(
        &self,
        py: Python<'_>,
        question: impl FnOnce(&mut dyn AnyRun) -> Result<T, GradientError> + Send,
    ) -> PyResult<T> {
        let watch = Arc::new(Mutex::new(Watch::new(py)?));
        py.detach(|| {
            let mut guard = self.lock()?;
            let run = guard.run()?;
            _ = take_raised();
            run.watch_gradients(Arc::clone(&watch));
            let found = question(&mut **run);
            let signal = watch.lock().ok().and_then(|mut watch| watch.signal.take());
            match signal.or_else(take_raised) {
                Some(raised) => Err(raised),
                None => found.map_err(error::gradient),
            }
        })
    }

    pub(super) fn ask_element(
        &self,
        element: &Element,
        question: impl FnOnce(&dyn AnyRun, eem::Element) -> Result<f64, SceneError>,
    ) -> PyResult<f64> {
        let element = self.element(element)?;
        self.ask(|run| question(run, element))
    }

    pub(super) fn element(&self, element: &Element) -> PyResult<eem::Element> {
        let index = self.world.lineage.index(Kind::Element, element.id())?;
        Ok(self.parts.elements[index])
    }

    pub(super) fn node(&self, node: &Node) -> PyResult<eem::Node> {
        let index = self.world.lineage.index(Kind::Node, node.id())?;
        Ok(self.parts.nodes[index])
    }

    pub(super) fn vector<'py>(
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

    pub(super) fn vectors<'py>(
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

    pub(super) fn tensors<'py>(
        &self,
        given: &Bound<'py, PyAny>,
        of_point: impl Fn(&dyn AnyRun, eem::Element) -> Result<[f64; 9], SceneError>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (indices, is_one) = indices::<Element>(given, &self.world.lineage)?;
        let points = indices.iter().map(|&index| self.parts.elements[index]);
        let count = points.len();
        let mut entries = Vec::with_capacity(9 * count);
        self.ask(|run| {
            for point in points {
                entries.extend(of_point(run, point)?);
            }
            Ok(())
        })?;
        let array = PyArray1::from_vec(given.py(), entries);
        Ok(if is_one {
            array.reshape([3, 3])?.into_any()
        } else {
            array.reshape([count, 3, 3])?.into_any()
        })
    }

    /// Runs to these times without the interpreter, and says how it ended and what a signal raised.
    pub(super) fn advance(
        &self,
        times: &[f64],
        wanted: Wanted,
        (rows, mut watch): (&mut Rows, Watch),
    ) -> PyResult<Ended> {
        let mut guard = self.lock()?;
        let run = guard.run()?;
        _ = take_raised();
        let parts = &*self.parts;
        let mut is_recorded = !wanted.at_times;
        if is_recorded {
            rows.add(&**run, parts, wanted.forces)
                .map_err(error::of_scene)?;
        }
        let (mut steps, mut ended) = (0_usize, Ok(RunEnd::Reached));
        for &time in times {
            ended = run.run_until(time, &mut |run, report| {
                steps += 1;
                if let Some(every) = wanted.every {
                    rows.add_report(report);
                    is_recorded = !wanted.at_times && steps.is_multiple_of(every);
                    if is_recorded {
                        rows.add(run, parts, wanted.forces)?;
                    }
                } else {
                    is_recorded = false;
                }
                Ok(watch.look())
            });
            if !matches!(ended, Ok(RunEnd::Reached)) {
                break;
            }
            if !is_recorded {
                rows.add(&**run, parts, wanted.forces)
                    .map_err(error::of_scene)?;
            }
            is_recorded = !wanted.at_times;
        }
        if !is_recorded && !matches!(ended, Ok(RunEnd::Reached)) {
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
                // While a function of time was called, which takes most of the time of such a run.
                Some(raised)
                    if Python::attach(|py| raised.is_instance_of::<PyKeyboardInterrupt>(py)) =>
                {
                    Ended::Signal(raised)
                }
                Some(raised) => return Err(raised),
                None => Ended::Failed(Box::new(error)),
            },
        })
    }
}

/// How a run ended.
pub(super) enum Ended {
    Reached,
    /// With what the handler of a signal raised.
    Signal(PyErr),
    Failed(Box<eem::StepError>),
}
