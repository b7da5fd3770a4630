//! The record of a member: numbers in columns, or its failure.

use eem_runtime::{MemberFailure, StepFailure};
use serde::{Deserialize, Serialize};

/// The result of a member: numbers in named columns.
///
/// ```
/// use eem::sweep::Record;
///
/// struct Fall {
///     depth: f64,
///     duration: f64,
/// }
///
/// impl Record for Fall {
///     const COLUMNS: &'static [&'static str] = &["depth (m)", "duration (s)"];
///
///     fn write(&self, row: &mut [f64]) {
///         row.copy_from_slice(&[self.depth, self.duration]);
///     }
/// }
///
/// let mut row = [0.0; 2];
/// Fall { depth: 5.0, duration: 1.0 }.write(&mut row);
/// assert_eq!(row, [5.0, 1.0]);
/// ```
pub trait Record {
    /// The column names, with units in parentheses.
    const COLUMNS: &'static [&'static str];

    /// Fills a row with one number per column.
    fn write(&self, row: &mut [f64]);
}

/// One number, in the column `value`.
impl Record for f64 {
    const COLUMNS: &'static [&'static str] = &["value"];

    fn write(&self, row: &mut [f64]) {
        row[0] = *self;
    }
}

/// Why a member has no result, as stored in files.
///
/// ```
/// use eem::MemberFailure;
/// use eem::sweep::{Failure, FailureKind};
///
/// let failure = Failure::from(&MemberFailure::other("too hot"));
/// assert_eq!(failure.kind, FailureKind::Other);
/// assert_eq!((failure.time, failure.message.as_str()), (None, "too hot"));
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Failure {
    /// The kind of failure.
    pub kind: FailureKind,
    /// The time at which the failed step began, s; `None` if no step failed.
    pub time: Option<f64>,
    /// The error message, in one line.
    pub message: String,
}

macro_rules! kinds {
    ($($(#[doc = $doc:literal])+ $kind:ident = $name:literal,)+) => {
        /// Kinds of failures, with their names in tables.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
        #[serde(rename_all = "kebab-case")]
        #[non_exhaustive]
        pub enum FailureKind {
            $($(#[doc = $doc])+ $kind,)+
        }

        impl FailureKind {
            /// The name in tables.
            ///
            /// ```
            /// use eem::sweep::FailureKind;
            ///
            /// assert_eq!(FailureKind::NotConverged.name(), "not-converged");
            /// assert_eq!(FailureKind::from_name("scene"), Some(FailureKind::Scene));
            /// ```
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$kind => $name,)+
                }
            }

            /// The kind with this name.
            #[must_use]
            pub fn from_name(name: &str) -> Option<Self> {
                match name {
                    $($name => Some(Self::$kind),)+
                    _ => None,
                }
            }
        }
    };
}

kinds! {
    /// The row was refused by the function that makes an input of it.
    Input = "input",
    /// The scene was refused, or a query was for something that the scene does not have.
    Scene = "scene",
    /// Newton's method used up its iterations.
    NotConverged = "not-converged",
    /// The motion of a mass, or the energy, is not finite.
    Unbounded = "unbounded",
    /// A step breaks a law of its scheme.
    LawNotKept = "law-not-kept",
    /// An element has no admissible state.
    State = "state",
    /// The step of an explicit scheme is too long.
    Unstable = "unstable",
    /// Step control would need smaller steps than it may take.
    TooSmall = "too-small",
    /// A step failed in another way.
    Step = "step",
    /// The member panicked.
    Panic = "panic",
    /// The member was given up, because it ends its process.
    GivenUp = "given-up",
    /// An error of the caller's own.
    Other = "other",
}

impl From<&MemberFailure> for Failure {
    fn from(failure: &MemberFailure) -> Self {
        let (kind, time) = match failure {
            MemberFailure::Scene(_) => (FailureKind::Scene, None),
            MemberFailure::Step(error) => (FailureKind::of_step(&error.failure), Some(error.time)),
            _ => (FailureKind::Other, None),
        };
        Self::new(kind, time, &failure.to_string())
    }
}

impl FailureKind {
    fn of_step(failure: &StepFailure) -> Self {
        match failure {
            StepFailure::NotConverged { .. } | StepFailure::SingularTangent => Self::NotConverged,
            StepFailure::Unbounded { .. } | StepFailure::Energy { .. } => Self::Unbounded,
            StepFailure::LawNotKept { .. } => Self::LawNotKept,
            StepFailure::State(_) => Self::State,
            StepFailure::Unstable { .. } => Self::Unstable,
            StepFailure::TooSmall { .. } => Self::TooSmall,
            _ => Self::Step,
        }
    }
}

impl Failure {
    /// A failure with its message in one line, as a record is a line.
    pub(crate) fn new(kind: FailureKind, time: Option<f64>, message: &str) -> Self {
        let message = message.split(['\n', '\r']).map(str::trim);
        let message: Vec<&str> = message.filter(|line| !line.is_empty()).collect();
        Self {
            kind,
            time,
            message: message.join(" "),
        }
    }
}

/// Members that were run together: ids, inputs, outputs, failures.
#[derive(Clone, Debug, Default)]
pub(crate) struct Batch {
    pub(crate) ids: Vec<u64>,
    /// Row after row.
    pub(crate) inputs: Vec<f64>,
    /// Row after row; meaningless in rows with a failure.
    pub(crate) outputs: Vec<f64>,
    pub(crate) failures: Vec<Option<Failure>>,
}

impl Batch {
    /// How many members have failed.
    pub(crate) fn failed(&self) -> usize {
        self.failures.iter().flatten().count()
    }
}
