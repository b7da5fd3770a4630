//! Many independent scenes in one call: on all cores, with the numbers of one after the other.

mod bundle;
mod error;
mod experiment;
mod progress;
mod threads;

use core::fmt;
use core::ops::ControlFlow;

use crate::number::scalar::Real;
use crate::run::simulation::Simulation;
use crate::scene::Scene;
use crate::scene::error::SceneError;
use crate::step::newton::NewtonSettings;
use crate::step::scheme::Scheme;

pub use error::{MemberError, MemberFailure};
pub use experiment::{Experiment, Members, Outputs};

use bundle::Bundles;
use progress::{Progress, Watch};

/// Runs of the same kind that know nothing of each other: parameter sweeps, random starts.
///
/// One member of the ensemble is one scene, built from one input. With the feature `parallel` the
/// members are spread over all cores, without it they run one by one; as no number passes from one
/// member to another, every bit of every result is the same, for any number of threads.
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
pub struct Ensemble<'w, S: Real = f64> {
    scheme: Scheme,
    step: S,
    newton: NewtonSettings<S>,
    threads: usize,
    watch: Option<Watch<'w>>,
}

impl<S: Real> fmt::Debug for Ensemble<'_, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Ensemble")
            .field("scheme", &self.scheme)
            .field("step", &self.step)
            .field("newton", &self.newton)
            .field("threads", &self.threads)
            .finish_non_exhaustive()
    }
}

impl<S: Real> Ensemble<'_, S> {
    /// An ensemble whose members are stepped by `scheme` with the time step `step`, s.
    #[must_use]
    pub fn new(scheme: Scheme, step: S) -> Self {
        Self {
            scheme,
            step,
            newton: NewtonSettings::default(),
            threads: 0,
            watch: None,
        }
    }

    /// How many threads work on members; with 1 it is the calling one. Default 0: those of rayon's
    /// pool, one for each core unless the program or `RAYON_NUM_THREADS` says otherwise. A large
    /// scene may ask the pool for help with its own elimination, whatever is chosen here.
    ///
    /// Results do not depend on it. Without the feature `parallel`, or where the system refuses the
    /// threads, it is always one.
    #[must_use]
    pub fn threads(mut self, threads: usize) -> Self {
        self.threads = threads;
        self
    }

    /// How hard the steps of all members try. Settings that cannot work are the failure of every
    /// member.
    #[must_use]
    pub fn newton(mut self, settings: NewtonSettings<S>) -> Self {
        self.newton = settings;
        self
    }

    /// Calls `watch` with the number of finished members and that of all members, each time one
    /// has finished or failed: 1, 2, 3 … in this order, one call at a time, but from any thread.
    ///
    /// It decides with [`ControlFlow`] whether members that have not begun still do; those that do
    /// not fail with [`MemberFailure::Stopped`], and those at work finish first. With several
    /// threads it depends on chance which these are.
    #[must_use]
    pub fn watch<'v>(
        self,
        watch: impl FnMut(usize, usize) -> ControlFlow<()> + Send + 'v,
    ) -> Ensemble<'v, S> {
        Ensemble {
            scheme: self.scheme,
            step: self.step,
            newton: self.newton,
            threads: self.threads,
            watch: Some(Box::new(watch)),
        }
    }

    /// Runs one member for each input and returns the results in the order of the inputs.
    ///
    /// `build` makes the scene of an input, and with it whatever `observe` needs to find its way
    /// in it: the handles, or `()`. `observe` steps the simulation and returns what is to be kept of
    /// it. Its errors are [`MemberFailure`]s, into which `?` turns those of this crate, and
    /// [`MemberFailure::other`] any error of the caller's own.
    ///
    /// # Errors
    ///
    /// [`MemberError`] in the place of a member whose scene is refused, whose run fails, or which
    /// never began. The others do not notice.
    ///
    /// # Panics
    ///
    /// When a closure does: the panic goes on in the caller as soon as all threads have left the
    /// members they were at. Members that had not begun may then be left out, and the other results
    /// are lost.
    pub fn run<const D: usize, I, H, T>(
        self,
        inputs: &[I],
        build: impl Fn(&I) -> (Scene<D, S>, H) + Sync,
        observe: impl Fn(&mut Simulation<D, S>, H, &I) -> Result<T, MemberFailure> + Sync,
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
            progress
                .follow(|| member(input))
                .map_err(|failure| MemberError {
                    member: index,
                    failure,
                })
        })
    }
}

impl Ensemble<'_> {
    /// Runs an experiment once for each input and returns the outputs in the order of the inputs.
    ///
    /// Its results and errors are those of [`run`](Self::run) with the same scenes, to the last bit. With
    /// the feature `lanes` four members move together, one per SIMD lane, which takes half the time as
    /// Cargo builds by default, and less with `-C target-cpu=native`.
    ///
    /// Members that move together may need different numbers of Newton iterations. But if one of them
    /// fails, if a correction leads it beyond the admissible states, if its elimination needs other
    /// pivots, or if the caller asks for a decision ([`Mask::decide`]) in which they differ, all four are
    /// run again one by one; that costs time and nothing else. Scenes of more than twelve unknowns,
    /// [`Scheme::Variational4`], recorders and events always run one by one.
    ///
    /// [`Mask::decide`]: crate::Mask::decide
    ///
    /// Pendulums on springs of different stiffness, which is a field of the material:
    ///
    /// ```
    /// use eem::prelude::*;
    /// use eem::{Experiment, MemberFailure, Members, Outputs, Real};
    ///
    /// #[derive(FreeEnergy)]
    /// #[free_energy(|lambda: Stretch| 0.5 * stiffness * (lambda - length).powi(2))]
    /// struct Spring<S> {
    ///     stiffness: S,
    ///     length: S,
    /// }
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
    ///         let number = S::from_f64;
    ///         let mut scene = Scene::default();
    ///         let hook = scene.anchor([number(0.0)]);
    ///         let mass = scene.mass(number(1.0), [number(-1.0)], [number(0.0)]);
    ///         let stiffness = members.number(|&stiffness| stiffness);
    ///         scene.spring(Spring { stiffness, length: number(1.0) }, [hook, mass]);
    ///         scene.set_gravity([number(-10.0)]);
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
        let bundles = Bundles::new(self.scheme, self.step, self.newton);
        let progress = Progress::new(self.watch, inputs.len());
        let chunks: Vec<_> = inputs.chunks(Bundles::size()).collect();
        let results = threads::map(self.threads, &chunks, |_, chunk| {
            progress.follow_all(chunk.len(), || bundles.run(experiment, chunk))
        });
        let numbered = results.into_iter().flatten().enumerate();
        numbered
            .map(|(member, result)| result.map_err(|failure| MemberError { member, failure }))
            .collect()
    }
}
