//! Ensembles: many independent runs in one call, on all cores.

mod error;
mod progress;
mod threads;

use core::fmt;
use core::ops::ControlFlow;

use crate::run::simulation::Simulation;
use crate::scene::Scene;
use crate::scene::error::SceneError;
use crate::step::newton::NewtonSettings;
use crate::step::scheme::Scheme;

pub use error::{MemberError, MemberFailure};

use progress::{Progress, Watch};

/// Many independent runs: parameter sweeps, random initial states.
///
/// Each member is one scene, built from one input. With the feature `parallel` members run on all cores, otherwise
/// one after the other. The results have the same bits for any number of threads. A member with a few masses, without other loads
/// than gravity, is set up in the memory of the one before it on its thread, if their scenes differ in numbers only.
///
/// Stones thrown at different speeds, one of them by mistake:
///
/// ```
/// use eem::{Ensemble, MemberFailure, Scene, Scheme};
///
/// let speeds = [5.0, 10.0, f64::NAN, 20.0];
/// let heights = Ensemble::new(Scheme::EemEntropy, 0.1).run(
///     &speeds,
///     |&speed| {
///         let mut scene = Scene::<2>::new();
///         let stone = scene.mass(0.5, [0.0, 0.0], [0.0, speed]);
///         scene.set_gravity([0.0, -10.0]);
///         (scene, stone)
///     },
///     |run, stone, _| {
///         for _ in 0..10 {
///             run.step()?;
///         }
///         Ok(run.position(stone)?.y)
///     },
/// );
///
/// // y = v t − g t²/2 at t = 1 s.
/// for (speed, height) in [(5.0, &heights[0]), (10.0, &heights[1]), (20.0, &heights[3])] {
///     assert!((height.as_ref().unwrap() - (speed - 5.0)).abs() < 1e-14);
/// }
/// let refused = heights[2].as_ref().unwrap_err();
/// assert_eq!(refused.member, 2);
/// assert!(matches!(refused.failure, MemberFailure::Scene(_)));
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
    pub fn run<const D: usize, I, H, T>(
        self,
        inputs: &[I],
        build: impl Fn(&I) -> (Scene<D>, H) + Sync,
        observe: impl Fn(&mut Simulation<D>, H, &I) -> Result<T, MemberFailure> + Sync,
    ) -> Vec<Result<T, MemberError>>
    where
        I: Sync,
        T: Send,
    {
        let member = |used: &mut Option<Simulation<D>>, input: &I| {
            let (scene, handles) = build(input);
            let run = Simulation::in_memory_of(used.take(), scene, self.scheme, self.step);
            let mut run = run.map_err(SceneError::from)?;
            run.set_newton_settings(self.newton)?;
            let result = observe(&mut run, handles, input);
            *used = run.is_reusable().then_some(run);
            result
        };
        let progress = Progress::new(self.watch, inputs.len());
        threads::map(self.threads, inputs, |used, index, input| {
            let result = progress.follow(1, || member(used, input));
            let result = result.unwrap_or(Err(MemberFailure::Stopped));
            let member = index;
            result.map_err(|failure| MemberError { member, failure })
        })
    }
}
