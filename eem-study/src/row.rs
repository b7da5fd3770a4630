//! The results of one setting, and statements about its errors, which need a sufficiently accurate reference.

use crate::quantity::{DOUBT, PerQuantity, StateQuantity, larger};
use crate::setting::Setting;
use eem_runtime::StepError;

/// The results and costs of one setting.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct StudyRow {
    /// The setting.
    pub setting: Setting,
    /// Why the run did not reach the end time; the other numbers then cover the steps before.
    pub failure: Option<StepError>,
    /// The largest `|B − B₀|` of the run, with the balance `B = E − work − heat`, over the largest of `|E₀|`, the kinetic
    /// energy, the work and the heat in it: a scene that starts from rest may have no energy.
    pub energy_defect: f64,
    /// The bound for rounding in a single step: the largest [`StepReport::bound`](eem_runtime::StepReport::bound) divided
    /// by the same.
    pub step_bound: f64,
    /// The smallest ΔS of a step, J/K. By the second law it is not negative, except for rounding. Infinite without
    /// steps.
    pub least_entropy_change: f64,
    /// Accepted steps.
    pub steps: u32,
    /// Rejected steps. Zero with constant steps.
    pub rejected: u32,
    /// Newton iterations.
    pub iterations: usize,
    /// Evaluations of the forces of all elements, one per stage.
    pub evaluations: u64,
    /// Wall time of the steps alone, the minimum of all repeats, s.
    pub seconds: f64,
    /// The median of the repeats, s.
    pub median_seconds: f64,
    /// Wall time of building the scene and the simulation, the minimum of all repeats, s.
    pub setup_seconds: f64,
    pub(crate) differences: PerQuantity,
    pub(crate) doubts: PerQuantity,
}

impl StudyRow {
    /// A row without steps.
    pub(crate) const fn new(setting: Setting) -> Self {
        Self {
            setting,
            failure: None,
            energy_defect: 0.0,
            step_bound: 0.0,
            least_entropy_change: f64::INFINITY,
            steps: 0,
            rejected: 0,
            iterations: 0,
            evaluations: 0,
            seconds: f64::NAN,
            median_seconds: f64::NAN,
            setup_seconds: f64::NAN,
            differences: [None; 4],
            doubts: [None; 4],
        }
    }

    /// The statement about the error of one kind of quantity at the end time, see
    /// [`EndState::difference`](crate::EndState::difference).
    #[must_use]
    pub fn statement(&self, quantity: StateQuantity) -> Statement {
        let index = quantity.index();
        match (self.differences[index], self.doubts[index]) {
            (Some(difference), Some(doubt)) => Statement::of(difference, doubt),
            _ => Statement::Absent,
        }
    }

    /// The error of one kind of quantity at the end time, if it is stated.
    #[must_use]
    pub fn error(&self, quantity: StateQuantity) -> Option<f64> {
        self.statement(quantity).stated()
    }

    /// The statement about the largest error of all kinds. It can be stated even if a much smaller one is not.
    #[must_use]
    pub fn largest_error(&self) -> Statement {
        let all = [&self.differences, &self.doubts];
        match all.map(|numbers| largest(numbers, &StateQuantity::ALL)) {
            [Some(difference), Some(doubt)] => Statement::of(difference, doubt),
            _ => Statement::Absent,
        }
    }
}

/// The statement of a study about one error at the end time.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Statement {
    /// The relative error: the two references differ by at most a hundredth of it.
    Stated(f64),
    /// No error is stated. The references differ by `doubt`, more than a hundredth of the difference between the
    /// run and one of them: the motion is chaotic, or only rounding is left.
    Refused {
        /// The difference between the run and the first reference; NaN without references.
        difference: f64,
        /// The difference between the references; infinite without references.
        doubt: f64,
    },
    /// The scene has no such quantity, or the run did not reach the end.
    Absent,
}

impl Statement {
    /// The statement about a difference from the first of two references, which differ by `doubt`.
    pub(crate) fn of(difference: f64, doubt: f64) -> Self {
        if doubt <= DOUBT * difference {
            Self::Stated(difference)
        } else {
            Self::Refused { difference, doubt }
        }
    }

    /// The error, if it is stated.
    ///
    /// ```
    /// use eem::Statement;
    ///
    /// assert_eq!(Statement::Stated(1e-3).stated(), Some(1e-3));
    /// assert_eq!(Statement::Refused { difference: 1e-3, doubt: 1e-4 }.stated(), None);
    /// ```
    #[must_use]
    pub const fn stated(self) -> Option<f64> {
        match self {
            Self::Stated(error) => Some(error),
            Self::Refused { .. } | Self::Absent => None,
        }
    }
}

/// The largest number of these kinds; NaN if one of them is NaN.
pub(crate) fn largest(numbers: &PerQuantity, quantities: &[StateQuantity]) -> Option<f64> {
    let there = quantities
        .iter()
        .filter_map(|quantity| numbers[quantity.index()]);
    there.reduce(larger)
}
