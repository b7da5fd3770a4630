//! Studies: the cost and the accuracy of each setting for a scene.

use core::fmt;
use core::ops::ControlFlow;

use crate::advice::check_accuracy;
use crate::course::{Build, Course, Finished, Watched, run};
use crate::error::StudyError;
use crate::progress::{Progress, Watch};
use crate::quantity::{EndState, StateQuantity};
use crate::reference::{ReferenceEnd, Search, StudyReference};
use crate::report::StudyReport;
use crate::row::StudyRow;
use crate::setting::Setting;
use eem_runtime::Scene;

/// The default of [`Study::repeats`].
const REPEATS: usize = 3;

/// The default of [`Study::refinement`].
const REFINEMENT: u32 = 32;

/// The default accuracies: visible in a picture, a good simulation, a reference.
const ACCURACIES: [f64; 3] = [1e-2, 1e-4, 1e-6];

/// Runs one scene with many settings, compares the states at the end time with two independent references, and
/// recommends a setting.
///
/// For your own scene:
///
/// ```
/// use eem::materials::Hooke;
/// use eem::prelude::*;
/// use eem::{Setting, StateQuantity, Study};
///
/// fn scene() -> Scene<2> {
///     let mut scene = Scene::new();
///     let ends = [scene.anchor([0.0, 0.0]), scene.mass(1.0, [1.1, 0.0], [0.0, 1.0])];
///     scene.spring(Hooke { stiffness: 20.0, natural_length: 1.0 }, ends);
///     scene
/// }
///
/// let report = Study::new(scene, 2.0)
///     .settings(Setting::halved(Scheme::EemEntropy, 0.1, 4))
///     .settings(Setting::halved(Scheme::Variational4, 0.1, 4))
///     .run()?;
/// println!("{report}");
///
/// let order = |scheme| report.order(scheme, StateQuantity::Positions);
/// assert!(order(Scheme::EemEntropy).is_some_and(|order| (order - 2.0).abs() < 0.1));
/// assert!(order(Scheme::Variational4).is_some_and(|order| (order - 4.0).abs() < 0.1));
/// assert!(report.rows[0].energy_defect < 1e-14 && report.rows[4].energy_defect > 1e-9);
/// # Ok::<(), eem::StudyError>(())
/// ```
///
/// Errors are relative, one per kind of quantity, measured from the first reference in the units of
/// [`Tolerance`](eem_runtime::Tolerance), with the largest momentum on the way to the end time:
///
/// ```text
/// max |Δq|/|q|₂,   max |Δp|/max |p|₂,   max |Δθ|/θ,   max |Δγ|/|q|₂
/// ```
///
/// An error is stated only if the references differ by at most a hundredth of it, see
/// [`Statement`](crate::Statement). Everything in the report except wall times has the same bits in every run.
pub struct Study<'a, const D: usize> {
    build: Box<Build<'a, D>>,
    settings: Vec<Setting>,
    end: f64,
    repeats: usize,
    refinement: u32,
    accuracies: Vec<f64>,
    reference: Option<[EndState; 2]>,
    watch: Option<Box<Watch<'a>>>,
}

impl<const D: usize> fmt::Debug for Study<'_, D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Study")
            .field("settings", &self.settings)
            .field("end", &self.end)
            .field("repeats", &self.repeats)
            .field("refinement", &self.refinement)
            .field("accuracies", &self.accuracies)
            .finish_non_exhaustive()
    }
}

impl<'a, const D: usize> Study<'a, D> {
    /// A study of the scene that `build` makes, over the time `end` from its start, s. Every run builds it again, so
    /// it must be the same each time.
    pub fn new(build: impl Fn() -> Scene<D> + 'a, end: f64) -> Self {
        Self {
            build: Box::new(build),
            settings: Vec::new(),
            end,
            repeats: REPEATS,
            refinement: REFINEMENT,
            accuracies: ACCURACIES.to_vec(),
            reference: None,
            watch: None,
        }
    }

    /// Adds a setting.
    #[must_use]
    pub fn setting(self, setting: Setting) -> Self {
        self.settings([setting])
    }

    /// Adds settings.
    #[must_use]
    pub fn settings(mut self, settings: impl IntoIterator<Item = Setting>) -> Self {
        self.settings.extend(settings);
        self
    }

    /// How often each setting is timed, in addition to the run that is compared; 0 counts as 1. The default is 3.
    #[must_use]
    pub const fn repeats(mut self, repeats: usize) -> Self {
        self.repeats = repeats;
        self
    }

    /// How many times smaller than the smallest step the steps of the references may become; 32 by default. They
    /// start 4 times smaller with schemes of order 4, and 16 times with schemes of order 2, which solids need; each
    /// refinement halves the step.
    #[must_use]
    pub const fn refinement(mut self, factor: u32) -> Self {
        self.refinement = factor;
        self
    }

    /// The accuracies for which to recommend settings, as relative errors. By default 10⁻², 10⁻⁴ and 10⁻⁶.
    #[must_use]
    pub fn accuracies(mut self, accuracies: impl IntoIterator<Item = f64>) -> Self {
        self.accuracies = accuracies.into_iter().collect();
        self
    }

    /// Uses two given states at the end time as references. They should come from independent methods, because
    /// their difference is all that is known about their errors.
    #[must_use]
    pub fn reference(mut self, states: [EndState; 2]) -> Self {
        self.reference = Some(states);
        self
    }

    /// Calls `watch` after every run, and about ten times per second during a run, with the numbers of steps made and planned.
    /// More are planned when the references must be refined. If `watch` returns [`ControlFlow::Break`], the study ends with
    /// [`StudyError::Stopped`].
    #[must_use]
    pub fn watch(mut self, watch: impl FnMut(u64, u64) -> ControlFlow<()> + 'a) -> Self {
        self.watch = Some(Box::new(watch));
        self
    }

    /// Runs everything, one run after the other.
    ///
    /// A failed step is not an error of the study: its setting has no error at the end time.
    ///
    /// # Errors
    ///
    /// [`StudyError`] if there are no settings, a step or the end time is not positive and finite, no whole number
    /// of steps ends at the end time, or the scene is rejected. Nothing has run then, unless a scheme rejects the
    /// scene. [`StudyError::Stopped`] if [`watch`](Self::watch) ends it.
    pub fn run(mut self) -> Result<StudyReport, StudyError> {
        let courses = self.check()?;
        let mut progress = Progress::new(self.watch.take());
        let repeats = u64::try_from(self.repeats.max(1)).unwrap_or(u64::MAX);
        let runs = repeats.saturating_add(1);
        for course in &courses {
            progress.plan(runs.saturating_mul(u64::from(course.planned)));
        }
        let mut rows: Vec<_> = self.settings.iter().copied().map(StudyRow::new).collect();
        let mut ends = Vec::with_capacity(rows.len());
        for (row, course) in rows.iter_mut().zip(&courses) {
            let watched = Watched::Laws(row);
            let finished = self.run_setting(course, watched, &mut progress)?;
            ends.push(finished.end.ok());
        }
        self.time(&courses, &mut rows, &mut progress)?;
        let reference = self.find_reference(&rows, &ends, &mut progress)?;
        for (row, end) in rows.iter_mut().zip(&ends) {
            row.doubts = reference.doubts();
            if let Some(end) = end {
                row.differences = reference.differences(end);
            }
        }
        Ok(StudyReport {
            end: self.end,
            rows,
            reference,
            accuracies: self.accuracies,
        })
    }

    /// The courses of all settings, if the study is valid.
    fn check(&self) -> Result<Vec<Course>, StudyError> {
        let end = self.end;
        if !(end > 0.0 && end.is_finite()) {
            return Err(StudyError::End { end });
        }
        let Some(&first) = self.settings.first() else {
            return Err(StudyError::NoSettings);
        };
        self.accuracies
            .iter()
            .copied()
            .try_for_each(check_accuracy)?;
        let settings = self.settings.iter();
        let courses = settings.map(|&setting| Course::of(setting, end));
        let courses = courses.collect::<Result<Vec<_>, _>>()?;
        if let Some(states) = &self.reference {
            self.check_reference(states, first, &courses[0])?;
        }
        Ok(courses)
    }

    /// An error unless given references are states of this scene.
    fn check_reference(
        &self,
        states: &[EndState; 2],
        setting: Setting,
        course: &Course,
    ) -> Result<(), StudyError> {
        let start = course.start(&*self.build);
        let start = start.map_err(|source| StudyError::Scene { setting, source })?;
        let start = EndState::of(&start);
        for (index, state) in states.iter().enumerate() {
            for quantity in StateQuantity::ALL {
                let values = state.values(quantity);
                let (got, expected) = (values.len(), start.values(quantity).len());
                if got != expected {
                    return Err(StudyError::Reference {
                        index,
                        quantity,
                        got,
                        expected,
                    });
                }
                if values.iter().any(|value| !value.is_finite()) {
                    return Err(StudyError::ReferenceNotFinite { index, quantity });
                }
            }
        }
        Ok(())
    }

    /// One run of a setting, see [`run`].
    fn run_setting(
        &self,
        course: &Course,
        watched: Watched<'_>,
        progress: &mut Progress<'_>,
    ) -> Result<Finished, StudyError> {
        let setting = course.setting;
        let finished = run(&*self.build, course, watched, progress);
        finished.map_err(|error| error.of(setting))
    }

    /// Measures the times of all settings. Each repeat runs all of them, so that a busy machine does not slow all
    /// repeats of one setting.
    fn time(
        &self,
        courses: &[Course],
        rows: &mut [StudyRow],
        progress: &mut Progress<'_>,
    ) -> Result<(), StudyError> {
        let mut repeats = vec![(Vec::new(), Vec::new()); rows.len()];
        for _ in 0..self.repeats.max(1) {
            for (course, (setups, times)) in courses.iter().zip(&mut repeats) {
                // The end is the same as that of the watched run.
                let finished = self.run_setting(course, Watched::Nothing, progress)?;
                setups.push(finished.setup);
                times.push(finished.seconds);
            }
        }
        for (row, (mut setups, mut times)) in rows.iter_mut().zip(repeats) {
            setups.sort_by(f64::total_cmp);
            times.sort_by(f64::total_cmp);
            let count = times.len();
            (row.setup_seconds, row.seconds) = (setups[0], times[0]);
            row.median_seconds = f64::midpoint(times[(count - 1) / 2], times[count / 2]);
        }
        Ok(())
    }

    /// The given references, or new ones.
    fn find_reference(
        &self,
        rows: &[StudyRow],
        ends: &[Option<EndState>],
        progress: &mut Progress<'_>,
    ) -> Result<StudyReference, StudyError> {
        if let Some(states) = &self.reference {
            return Ok(StudyReference {
                states: Some(states.clone()),
                schemes: None,
                step: None,
                end: ReferenceEnd::Given,
            });
        }
        let ends: Vec<EndState> = ends.iter().flatten().cloned().collect();
        let search = Search {
            end_time: self.end,
            finest: rows.iter().fold(1, |most, row| most.max(row.steps)),
            refinement: self.refinement,
            ends: &ends,
        };
        let found = search.run(&*self.build, progress);
        found.map_err(|error| error.of(self.settings[0]))
    }
}
