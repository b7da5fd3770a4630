//! `Scene.ensemble`: the same scene with many values of parameters, on all cores.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;

use eem::typed::LawError;
use eem::{Ensemble, MemberFailure, RunEnd, Scene, Scheme, Simulation, Tolerance};
use eem_gradients::Gradients;
use eem_solids::Solids;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyMapping};

use crate::act::Act;
use crate::built::{Built, Context, Parts, Refusal};
use crate::error::Raised;
use crate::function::take_raised;
use crate::material::Material;
use crate::record::LEDGER;
pub(crate) use crate::record::Rows;
use crate::watch::{PATIENCE, check_signals};
use crate::world::World;
use crate::{error, input};

/// The values of a parameter of the law with this index, one for each member.
type Column = (usize, String, Vec<f64>);

/// What each member does.
struct Plan<'a> {
    acts: &'a [Act],
    context: &'a Context,
    columns: &'a [Column],
    members: &'a [usize],
    times: &'a [f64],
    scheme: Scheme,
    step: f64,
    tolerance: Option<Tolerance>,
    threads: usize,
    stop: &'a AtomicBool,
}

impl Plan<'_> {
    fn run_in(&self, dim: usize) -> Vec<Result<Rows, MemberFailure>> {
        match dim {
            1 => self.run::<1>(),
            2 => self.run::<2>(),
            _ => self.run::<3>(),
        }
    }

    fn run<const D: usize>(&self) -> Vec<Result<Rows, MemberFailure>>
    where
        Scene<D>: Solids<D>,
        Simulation<D>: Gradients<D>,
    {
        let ensemble = Ensemble::new(self.scheme, self.step).threads(self.threads);
        let ensemble = ensemble.watch(|_, _| {
            if self.stop.load(Ordering::Relaxed) {
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(())
        });
        let results = ensemble.run::<D, _, _, _>(
            self.members,
            |&member| {
                _ = take_raised();
                let built = member_context(self.context, self.columns, member);
                let built = built.map_err(Refusal::Law);
                match built.and_then(|context| Built::of(self.acts, &context)) {
                    Ok(Built { scene, parts }) => (scene, Ok(parts)),
                    Err(refusal) => (Scene::new(), Err(refusal)),
                }
            },
            |run, parts, _| {
                let raised = |refusal| MemberFailure::other(Raised(error::refusal(refusal)));
                let parts: Parts = parts.map_err(raised)?;
                if let Some(tolerance) = self.tolerance {
                    run.control_steps(tolerance)?;
                }
                let (mut rows, mut wrong) = (Rows::default(), None);
                let ended = run.sample_at(self.times, |run| {
                    if let Err(error) = rows.add(run, &parts, false) {
                        wrong = Some(error);
                    }
                    if wrong.is_some() || self.stop.load(Ordering::Relaxed) {
                        return ControlFlow::Break(());
                    }
                    ControlFlow::Continue(())
                });
                if let Some(error) = wrong {
                    return Err(error.into());
                }
                match ended {
                    Ok(RunEnd::Reached) => Ok(rows),
                    Ok(_) => Err(MemberFailure::Stopped),
                    Err(error) => match take_raised() {
                        Some(raised) => Err(MemberFailure::other(Raised(raised))),
                        None => Err(error.into()),
                    },
                }
            },
        );
        results
            .into_iter()
            .map(|result| result.map_err(|error| error.failure))
            .collect()
    }
}

/// What was asked for.
pub(crate) struct Request<'a> {
    world: &'a World,
    columns: Vec<Column>,
    members: Vec<usize>,
    times: Vec<f64>,
}

impl<'a> Request<'a> {
    /// `{material: {"k": values}}` with as many values for each, and the times at which states are recorded.
    pub(crate) fn new(
        world: &'a World,
        vary: &Bound<'_, PyMapping>,
        until: Option<f64>,
        times: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let times = input::times(until, times)?;
        let mut columns = Vec::new();
        for item in vary.items()? {
            let (material, values): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
            let material = material.cast::<Material>()?;
            let index = world.law(material)?;
            for item in values.cast::<PyMapping>()?.items()? {
                let (name, values): (String, Bound<'_, PyAny>) = item.extract()?;
                let array = input::array(&values, &format!("parameter `{name}`"))?;
                if array.shape.len() != 1 {
                    return Err(error::scene(format!(
                        "parameter `{name}` is a list with a value for each member"
                    )));
                }
                columns.push((index, name, array.values));
            }
        }
        let Some((_, first, values)) = columns.first() else {
            return Err(error::scene(
                "nothing varies: give {material: {\"k\": values}}",
            ));
        };
        let count = values.len();
        if let Some((_, name, values)) = columns.iter().find(|(.., values)| values.len() != count) {
            let other = values.len();
            return Err(error::scene(format!(
                "parameter `{first}` has {count} values, `{name}` {other}"
            )));
        }
        // Names are wrong for all members or for none.
        if count > 0 {
            member_context(&world.context, &columns, 0).map_err(error::law)?;
        }
        Ok(Self {
            world,
            columns,
            members: (0..count).collect(),
            times,
        })
    }

    /// Runs all members without the interpreter and returns an `eem.EnsembleRecord`.
    pub(crate) fn run(
        self,
        py: Python<'_>,
        (scheme, step): (Scheme, f64),
        tolerance: Option<Tolerance>,
        threads: usize,
    ) -> PyResult<Py<PyAny>> {
        let stop = AtomicBool::new(false);
        let plan = Plan {
            acts: &self.world.acts,
            context: &self.world.context,
            columns: &self.columns,
            members: &self.members,
            times: &self.times,
            scheme,
            step,
            tolerance,
            threads,
            stop: &stop,
        };
        let dim = self.world.dim;
        let (results, signal) = py.detach(|| {
            thread::scope(|scope| {
                let (done, wait) = channel();
                scope.spawn(move || _ = done.send(plan.run_in(dim)));
                let mut signal = None;
                loop {
                    match wait.recv_timeout(PATIENCE) {
                        Ok(results) => return (results, signal),
                        Err(RecvTimeoutError::Disconnected) => return (Vec::new(), signal),
                        Err(RecvTimeoutError::Timeout) => {
                            if let Err(raised) = Python::attach(check_signals) {
                                stop.store(true, Ordering::Relaxed);
                                signal = Some(raised);
                            }
                        }
                    }
                }
            })
        });
        match signal {
            Some(signal) if !signal.is_instance_of::<PyKeyboardInterrupt>(py) => Err(signal),
            _ => self.record(py, results, scheme),
        }
    }

    fn record(
        &self,
        py: Python<'_>,
        results: Vec<Result<Rows, MemberFailure>>,
        scheme: Scheme,
    ) -> PyResult<Py<PyAny>> {
        let (dim, parts) = (self.world.dim, self.world.scene.parts());
        let (members, times) = (results.len(), self.times.len());
        let (nodes, springs) = (parts.nodes.len(), parts.elements.len());
        let dashpots: usize = parts.dashpots.iter().sum();
        let widths = [
            nodes * dim,
            nodes * dim,
            springs,
            dashpots,
            LEDGER.len() + dim + 3,
        ];
        let mut columns: [Vec<f64>; 5] =
            widths.map(|width| Vec::with_capacity(width * times * members));
        let errors = PyList::empty(py);
        for result in results {
            let (rows, error) = match result {
                Ok(rows) => (Some(rows), None),
                Err(failure) => (None, Some(error::member(failure))),
            };
            errors.append(error)?;
            let own = rows.map(|rows| {
                [
                    rows.positions,
                    rows.momenta,
                    rows.temperatures,
                    rows.viscous,
                    rows.ledger,
                ]
            });
            let own = own.unwrap_or_else(|| widths.map(|width| vec![f64::NAN; width * times]));
            for (column, own) in columns.iter_mut().zip(own) {
                column.extend(own);
            }
        }
        let arrays = PyDict::new(py);
        arrays.set_item("time", PyArray1::from_slice(py, &self.times))?;
        let names = ["q", "p", "theta", "gamma", "ledger"];
        for ((name, values), width) in names.into_iter().zip(columns).zip(widths) {
            let array = PyArray1::from_vec(py, values);
            let array = if width == nodes * dim && (name == "q" || name == "p") {
                array.reshape([members, times, nodes, dim])?.into_any()
            } else {
                array.reshape([members, times, width])?.into_any()
            };
            arrays.set_item(name, array)?;
        }
        let dashpots =
            PyArray1::from_iter(py, parts.dashpots.iter().map(|&n| n.cast_signed() as i64));
        let class = py.import("eem._record")?.getattr("EnsembleRecord")?;
        let lineage = self.world.lineage.clone();
        Ok(class
            .call1((arrays, lineage, dashpots, errors, scheme.name()))?
            .unbind())
    }
}

/// What acts refer to, with the laws of a member.
fn member_context(
    context: &Context,
    columns: &[Column],
    member: usize,
) -> Result<Context, LawError> {
    let mut own = context.clone();
    let mut indices: Vec<usize> = columns.iter().map(|(index, ..)| *index).collect();
    indices.dedup();
    for index in indices {
        let varied = columns.iter().filter(|(other, ..)| *other == index);
        let values: Vec<_> = varied
            .map(|(_, name, values)| (name.as_str(), values[member]))
            .collect();
        own.laws[index] = context.laws[index].with_values(&values)?;
    }
    Ok(own)
}
