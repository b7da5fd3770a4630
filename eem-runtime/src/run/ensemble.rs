//! Ensembles: many independent runs in one call, on all cores.

use core::error::Error;
use core::fmt;
use core::ops::ControlFlow;
use core::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use crate::run::simulation::Simulation;
use crate::scene::Scene;
use crate::scene::error::SceneError;
use crate::step::error::StepError;
use crate::step::newton::NewtonSettings;
use crate::step::scheme::Scheme;
use thiserror::Error;

/// Many independent runs: parameter sweeps, random initial states.
///
/// Each member is one scene, built from one input. With the feature `parallel` members run on all cores, otherwise
/// one after the other. The results have the same bits for any number of threads. A member with a few masses, without other loads
/// than gravity, is set up in the memory of the one before it on its thread, if their scenes differ in numbers only.
///
/// Stones thrown at different speeds, one of them by mistake:
///
/// ```
/// use eem::prelude::*;
/// use eem::MemberFailure;
///
/// let heights = Ensemble::new(Scheme::EemEntropy, 0.1).run(
///     &[5.0, f64::NAN, 20.0],
///     |&speed| {
///         let mut scene = Scene::<2>::new();
///         let stone = scene.mass(0.5, [0.0, 0.0], [0.0, speed]);
///         scene.set_gravity([0.0, -10.0]);
///         (scene, stone)
///     },
///     |run, stone, _| {
///         run.run_until(1.0)?;
///         Ok(run.position(stone)?.y)
///     },
/// );
/// // y = v t − g t²/2
/// assert!((heights[2].as_ref().unwrap() - 15.0).abs() < 1e-14);
/// let refused = heights[1].as_ref().unwrap_err();
/// assert!(matches!((refused.member, &refused.failure), (1, MemberFailure::Scene(_))));
/// ```
pub struct Ensemble<'w> {
    scheme: Scheme,
    step: f64,
    newton: NewtonSettings,
    threads: usize,
    watch: Option<Watch<'w>>,
}

impl fmt::Debug for Ensemble<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Ensemble")
            .field("scheme", &self.scheme)
            .field("step", &self.step)
            .field("newton", &self.newton)
            .field("threads", &self.threads)
            .finish_non_exhaustive()
    }
}

impl Ensemble<'_> {
    /// An ensemble with this scheme and step, s.
    #[must_use]
    pub fn new(scheme: Scheme, step: f64) -> Self {
        Self {
            scheme,
            step,
            newton: NewtonSettings::default(),
            threads: 0,
            watch: None,
        }
    }

    /// The number of threads; 1 is the calling thread. The default 0 means rayon's pool: one thread per core unless
    /// the program or `RAYON_NUM_THREADS` sets it. A large scene may use more threads of the pool for its own
    /// elimination.
    ///
    /// Results do not depend on it. Without the feature `parallel`, or if the system refuses threads, it is always
    /// one.
    #[must_use]
    pub fn threads(mut self, threads: usize) -> Self {
        self.threads = threads;
        self
    }

    /// The settings of Newton's method for all members. Invalid settings make every member fail.
    #[must_use]
    pub fn newton(mut self, settings: NewtonSettings) -> Self {
        self.newton = settings;
        self
    }

    /// Calls `watch` with the number of finished members and of all members whenever one has finished or failed: 1,
    /// 2, 3 … in order, one call at a time, from any thread.
    ///
    /// If it returns [`ControlFlow::Break`], members that have not begun fail with [`MemberFailure::Stopped`];
    /// running ones finish first. With several threads it is a matter of chance which these are.
    #[must_use]
    pub fn watch<'v>(
        self,
        watch: impl FnMut(usize, usize) -> ControlFlow<()> + Send + 'v,
    ) -> Ensemble<'v> {
        Ensemble {
            scheme: self.scheme,
            step: self.step,
            newton: self.newton,
            threads: self.threads,
            watch: Some(Box::new(watch)),
        }
    }

    /// Runs one member per input and returns the results in the order of the inputs.
    ///
    /// `build` makes the scene of an input and returns it with whatever `observe` needs, usually handles, or `()`.
    /// `observe` steps the simulation and returns a result. Its errors are [`MemberFailure`]s: `?` converts those
    /// of this crate, and [`MemberFailure::other`] any other error.
    ///
    /// # Errors
    ///
    /// [`MemberError`] for a member whose scene is rejected, whose run fails, or which never began. Other members
    /// are not affected.
    ///
    /// # Panics
    ///
    /// If a closure panics: the panic continues in the caller once all threads have finished their present members.
    /// Members that had not begun may be left out, and all results are lost.
    pub fn run<const D: usize, I: Sync, H, T: Send>(
        self,
        inputs: &[I],
        build: impl Fn(&I) -> (Scene<D>, H) + Sync,
        observe: impl Fn(&mut Simulation<D>, H, &I) -> Result<T, MemberFailure> + Sync,
    ) -> Vec<Result<T, MemberError>> {
        let member = |used: &mut Option<Simulation<D>>, input: &I| {
            let (scene, handles) = build(input);
            let run = Simulation::new_in(used, scene, self.scheme, self.step);
            let run = run.map_err(SceneError::from)?;
            run.set_newton_settings(self.newton)?;
            let result = observe(run, handles, input);
            if !run.is_reusable() {
                *used = None;
            }
            result
        };
        let stopped = AtomicBool::new(false);
        let done = self.watch.map(|watch| Mutex::new((0, watch)));
        map(self.threads, inputs, |used, index, input| {
            let failed = |failure| MemberError {
                member: index,
                failure,
            };
            if stopped.load(Ordering::Relaxed) {
                return Err(failed(MemberFailure::Stopped));
            }
            let result = member(used, input);
            if let Some(done) = &done {
                // A panic in `watch` ends the ensemble; until then the count is right.
                let mut done = done.lock().unwrap_or_else(PoisonError::into_inner);
                let (count, watch) = &mut *done;
                *count += 1;
                if watch(*count, inputs.len()).is_break() {
                    stopped.store(true, Ordering::Relaxed);
                }
            }
            result.map_err(failed)
        })
    }
}

/// A member of an ensemble without a result.
#[derive(Debug, Error)]
#[error("member {member}: {failure}")]
pub struct MemberError {
    /// The index of its input, from 0.
    pub member: usize,
    /// Why it has no result. It is part of the message, so it is not the `source`.
    pub failure: MemberFailure,
}

/// Why a member of an ensemble has no result.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MemberFailure {
    /// The scene, the step or the settings are rejected, or a requested quantity does not exist.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A step failed.
    #[error(transparent)]
    Step(Box<StepError>),
    /// The ensemble was stopped before the member began.
    #[error("the ensemble was stopped before it began")]
    Stopped,
    /// An error of the caller.
    #[error(transparent)]
    Other(Box<dyn Error + Send + Sync>),
}

impl From<StepError> for MemberFailure {
    fn from(error: StepError) -> Self {
        Self::Step(Box::new(error))
    }
}

impl MemberFailure {
    /// A failure from any error or text of the caller.
    ///
    /// ```
    /// use eem::MemberFailure;
    ///
    /// assert_eq!(MemberFailure::other("too hot").to_string(), "too hot");
    /// ```
    pub fn other(error: impl Into<Box<dyn Error + Send + Sync>>) -> Self {
        Self::Other(error.into())
    }
}

/// Called with the numbers of finished and of all members.
type Watch<'w> = Box<dyn FnMut(usize, usize) -> ControlFlow<()> + Send + 'w>;

/// `f(w, i, &inputs[i])` for all `i`, on this number of threads, each of which keeps a `w` of its own; 0 means those of the
/// present pool.
///
/// If the system refuses the threads, the calling one does all the work.
fn map<I: Sync, W: Default, T: Send>(
    threads: usize,
    inputs: &[I],
    f: impl Fn(&mut W, usize, &I) -> T + Sync,
) -> Vec<T> {
    let next = AtomicUsize::new(0);
    // Each thread takes one input after the other: one may take a thousand times as long as another.
    let work = || {
        let mut own = W::default();
        let indices = core::iter::repeat_with(|| next.fetch_add(1, Ordering::Relaxed));
        let taken = indices.map_while(|index| Some((index, inputs.get(index)?)));
        let found = taken.map(|(index, input)| (index, f(&mut own, index, input)));
        found.collect::<Vec<_>>()
    };
    let mut results = Vec::new();
    results.resize_with(inputs.len(), || None);
    for (index, result) in on_each(threads, inputs.len(), work) {
        results[index] = Some(result);
    }
    results.into_iter().flatten().collect()
}

/// What `work` returns on each of these threads; it is called at most `most` times.
#[cfg(feature = "parallel")]
fn on_each<T: Send>(threads: usize, most: usize, work: impl Fn() -> Vec<T> + Sync) -> Vec<T> {
    use rayon::iter::{IndexedParallelIterator, ParallelIterator, repeat_n};

    let on_pool = || {
        let threads = rayon::current_num_threads().min(most);
        let each = repeat_n((), threads).with_max_len(1);
        each.flat_map_iter(|()| work()).collect()
    };
    match threads {
        0 => on_pool(),
        1 => work(),
        _ => match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
            Ok(pool) => pool.install(on_pool),
            Err(_) => work(),
        },
    }
}

/// Without threads.
#[cfg(not(feature = "parallel"))]
fn on_each<T>(_threads: usize, _most: usize, work: impl Fn() -> Vec<T>) -> Vec<T> {
    work()
}
