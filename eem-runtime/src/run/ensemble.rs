//! Ensembles: many independent runs in one call, on all cores.

mod bundle;
mod error;
mod experiment;
mod progress;
mod threads;

use core::fmt;
use core::ops::ControlFlow;
use core::sync::atomic::AtomicBool;

use crate::run::simulation::Simulation;
use crate::scene::Scene;
use crate::scene::error::SceneError;
use crate::step::newton::NewtonSettings;
use crate::step::scheme::Scheme;

pub use error::{MemberError, MemberFailure};
pub use experiment::{Experiment, Members, Outputs};

use bundle::Bundles;
use progress::{Progress, Watch};

/// Many independent runs: parameter sweeps, random initial states.
///
/// Each member is one scene, built from one input. With the feature `parallel` members run on all cores, otherwise
/// one after the other. The results have the same bits for any number of threads.
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
        let member = |input: &I| {
            let (scene, handles) = build(input);
            let simulation = Simulation::new(scene, self.scheme, self.step);
            let mut simulation = simulation.map_err(SceneError::from)?;
            simulation.set_newton_settings(self.newton)?;
            observe(&mut simulation, handles, input)
        };
        let progress = Progress::new(self.watch, inputs.len());
        threads::map(self.threads, inputs, |index, input| {
            let result = progress.follow(1, || member(input));
            let result = result.unwrap_or(Err(MemberFailure::Stopped));
            let member = index;
            result.map_err(|failure| MemberError { member, failure })
        })
    }
}

impl Ensemble<'_> {
    /// Runs an experiment once per input and returns the outputs in the order of the inputs.
    ///
    /// Results and errors are the same as those of [`run`](Self::run), to the last bit. With the feature `lanes`
    /// four members run together in SIMD lanes, in half the time with default compiler settings, and less with `-C
    /// target-cpu=native`.
    ///
    /// Members in lanes may need different numbers of Newton iterations. If one of them fails, needs another order
    /// of elimination, leaves the admissible states in a correction, or takes another branch ([`Mask::decide`]),
    /// all four are run again one by one, which costs only time. Scenes with more than twelve unknowns,
    /// [`Scheme::Variational4`], recorders and events always run one by one.
    ///
    /// [`Mask::decide`]: crate::Mask::decide
    ///
    /// Pendulums on springs whose stiffness, a field of the material, differs:
    ///
    /// ```
    /// use eem::prelude::*;
    /// use eem::{Experiment, MemberFailure, Members, Outputs, Real};
    ///
    /// #[derive(FreeEnergy)]
    /// #[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - length).powi(2))]
    /// struct Spring<S> { stiffness: S, length: S }
    ///
    /// /// Hangs a mass on a spring and looks how far it falls within a tenth of a second.
    /// struct Fall;
    ///
    /// impl Experiment<1> for Fall {
    ///     type Input = f64;
    ///     type Handles = Node;
    ///     type Output = f64;
    ///
    ///     fn build<S: Real>(&self, members: Members<'_, f64, S>) -> (Scene<1, S>, Node) {
    ///         let mut scene = Scene::default();
    ///         let hook = scene.anchor([S::zero()]);
    ///         let mass = scene.mass(S::one(), [-S::one()], [S::zero()]);
    ///         let stiffness = members.number(|&stiffness| stiffness);
    ///         scene.spring(Spring { stiffness, length: S::one() }, [hook, mass]);
    ///         scene.set_gravity([S::from_f64(-10.0)]);
    ///         (scene, mass)
    ///     }
    ///
    ///     fn observe<S: Real>(
    ///         &self,
    ///         run: &mut Simulation<1, S>,
    ///         mass: Node,
    ///         members: Members<'_, f64, S>,
    ///     ) -> Result<Outputs<f64>, MemberFailure> {
    ///         for _ in 0..100 {
    ///             run.step()?;
    ///         }
    ///         let depth = -run.position(mass)?.x - S::one();
    ///         Ok(members.outputs(|_, of| of(depth)))
    ///     }
    /// }
    ///
    /// let stiffnesses = [100.0, 400.0, 900.0];
    /// let depths = Ensemble::new(Scheme::EemEntropy, 1e-3).run_experiment(&Fall, &stiffnesses);
    ///
    /// // u = (g/ω²)(1 − cos ωt) with ω² = k/m; the scheme has an error of (ωh)²ωt/12 in ωt.
    /// for (stiffness, depth) in stiffnesses.iter().zip(&depths) {
    ///     let omega = stiffness.sqrt();
    ///     let exact = 10.0 / stiffness * (1.0 - (0.1 * omega).cos());
    ///     assert!((depth.as_ref().unwrap() / exact - 1.0).abs() < 1e-3);
    /// }
    /// ```
    ///
    /// # Errors
    ///
    /// As for [`run`](Self::run).
    ///
    /// # Panics
    ///
    /// When the experiment does, as for [`run`](Self::run).
    pub fn run_experiment<const D: usize, E: Experiment<D>>(
        self,
        experiment: &E,
        inputs: &[E::Input],
    ) -> Vec<Result<E::Output, MemberError>> {
        let bundles = Bundles {
            scheme: self.scheme,
            step: self.step,
            newton: self.newton,
            is_unsuited: AtomicBool::new(false),
        };
        let progress = Progress::new(self.watch, inputs.len());
        let chunks: Vec<_> = inputs.chunks(bundle::SIZE).collect();
        let results = threads::map(self.threads, &chunks, |_, chunk| {
            let results = progress.follow(chunk.len(), || bundles.run(experiment, chunk));
            let stopped = || chunk.iter().map(|_| Err(MemberFailure::Stopped)).collect();
            results.unwrap_or_else(stopped)
        });
        let numbered = results.into_iter().flatten().enumerate();
        numbered
            .map(|(member, result)| result.map_err(|failure| MemberError { member, failure }))
            .collect()
    }
}
