//! What is run for a batch of members: inputs from rows, an ensemble, records from its outputs.

use std::any::Any;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use eem_runtime::{Ensemble, MemberError, NewtonSettings, Scheme};

use crate::inputs::{InputError, Row};
use crate::record::{Batch, Failure, FailureKind, Record};

/// How members are stepped.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stepping {
    pub(crate) scheme: Scheme,
    pub(crate) step: f64,
    pub(crate) newton: NewtonSettings,
}

/// Called with the number of members of the batch that are done.
pub(crate) type Tick<'t> = &'t mut (dyn FnMut(usize) + Send);

/// What is done with the members of a batch.
pub(crate) struct Job<'a> {
    /// Runs the members of a batch, which has their ids and inputs; the texts are the names of the input columns.
    pub(crate) run: Run<'a>,
    /// Whether an input can be made of a row.
    check: Check<'a>,
}

type Check<'a> = Box<dyn Fn(Row<'_>) -> Result<(), InputError> + Sync + 'a>;

type Run<'a> = Box<dyn Fn(&[String], &mut Batch, Tick<'_>) + Sync + 'a>;

impl Job<'_> {
    /// A row without a column that the job reads is an error of the sweep; other errors are of one member.
    pub(crate) fn check(&self, row: Row<'_>) -> Result<(), InputError> {
        match guarded(|| (self.check)(row)) {
            Ok(Err(error @ InputError::NoColumn { .. })) => Err(error),
            _ => Ok(()),
        }
    }
}

/// The results of an ensemble.
pub(crate) type Results<T> = Vec<Result<T, MemberError>>;

/// The job whose inputs `input` makes of rows, and which `run` gives to an ensemble.
pub(crate) fn job<'a, I, T: Record>(
    stepping: Stepping,
    input: impl Fn(Row<'_>) -> Result<I, InputError> + Send + Sync + 'a,
    run: impl Fn(Ensemble<'_>, &[I]) -> Results<T> + Sync + 'a,
) -> Job<'a> {
    let input = Arc::new(input);
    let check = input.clone();
    Job {
        run: Box::new(move |columns, batch, tick| {
            run_batch(columns, batch, &*input, tick, |inputs, tick| {
                run(ensemble(stepping, tick), inputs)
            });
        }),
        check: Box::new(move |row| check(row).map(drop)),
    }
}

/// The job that runs nothing, and reports all members as given up; `outputs` is the number of output columns.
pub(crate) fn giving_up(outputs: usize) -> Job<'static> {
    let failure = Failure::new(FailureKind::GivenUp, None, "the caller has given it up");
    Job {
        run: Box::new(move |_, batch, tick| {
            let members = batch.ids.len();
            batch.outputs = vec![0.0; members * outputs];
            batch.failures = vec![Some(failure.clone()); members];
            tick(members);
        }),
        check: Box::new(|_| Ok(())),
    }
}

/// An ensemble on the calling thread only: other threads have batches of their own.
fn ensemble(stepping: Stepping, tick: Tick<'_>) -> Ensemble<'_> {
    let ensemble = Ensemble::new(stepping.scheme, stepping.step);
    let ensemble = ensemble.newton(stepping.newton).threads(1);
    ensemble.watch(|done, _| {
        tick(done);
        ControlFlow::Continue(())
    })
}

/// Makes inputs of the rows, runs the members that have one, and fills in outputs and failures.
fn run_batch<I, T: Record>(
    columns: &[String],
    batch: &mut Batch,
    input: &impl Fn(Row<'_>) -> Result<I, InputError>,
    tick: Tick<'_>,
    run: impl Fn(&[I], Tick<'_>) -> Results<T>,
) {
    let members = batch.ids.len();
    batch.outputs.clear();
    batch.outputs.resize(members * T::COLUMNS.len(), 0.0);
    batch.failures.clear();
    batch.failures.resize(members, None);
    let (mut inputs, mut places) = (Vec::new(), Vec::new());
    for (place, &id) in batch.ids.iter().enumerate() {
        let values = &batch.inputs[place * columns.len()..(place + 1) * columns.len()];
        match guarded(|| input(Row::new(id, columns, values))) {
            Ok(Ok(input)) => {
                inputs.push(input);
                places.push(place);
            }
            Ok(Err(error)) => {
                let failure = Failure::new(FailureKind::Input, None, &error.to_string());
                batch.failures[place] = Some(failure);
            }
            Err(panic) => batch.failures[place] = Some(panic),
        }
    }
    // A panic ends the ensemble with all its results; then each member runs alone.
    let together = guarded(|| run(&inputs, tick)).ok();
    let mut together = together.map(Vec::into_iter);
    for (input, place) in inputs.iter().zip(places) {
        let alone = || run(std::slice::from_ref(input), &mut |_| {}).pop();
        let result = match &mut together {
            Some(results) => Ok(results.next()),
            None => guarded(alone),
        };
        let row = &mut batch.outputs[place * T::COLUMNS.len()..(place + 1) * T::COLUMNS.len()];
        batch.failures[place] = match result {
            Ok(Some(Ok(output))) => guarded(|| output.write(row)).err(),
            Ok(Some(Err(error))) => Some(Failure::from(&error.failure)),
            Ok(None) => Some(Failure::new(FailureKind::Other, None, "there is no output")),
            Err(panic) => Some(panic),
        };
    }
}

/// What a call returns, or its panic as a failure.
fn guarded<T>(call: impl FnOnce() -> T) -> Result<T, Failure> {
    // Nothing that a panic has left half done is used afterwards.
    catch_unwind(AssertUnwindSafe(call)).map_err(|panic| {
        let message = message(panic.as_ref());
        Failure::new(FailureKind::Panic, None, message)
    })
}

fn message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
    text.unwrap_or("a panic without a message")
}
