//! Why a step failed.
//!
//! Every error names the thing, the value and, once time runs, the time.

use thiserror::Error;

use crate::algebra::lu::Singular;
use crate::algebra::memory::TooLarge;
use crate::element::error::StateError;
use crate::element::handle::{Element, Node};
use crate::step::law::Law;
use crate::step::newton::NewtonIteration;
use crate::step::timed::TimedLoad;
use eem_material::number::readable::Readable;

/// Why a step failed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StepFailure {
    /// The motion of a mass is not finite.
    #[error("coordinate {axis} of the new {quantity} of node {node} is {value}, it must be finite", value = Readable(*value))]
    Unbounded {
        /// The index of the node.
        node: usize,
        /// The axis, from 0.
        axis: usize,
        /// Position or momentum.
        quantity: &'static str,
        /// The value, m or kg m/s.
        value: f64,
    },
    /// Newton's method used up its iterations.
    #[error(
        "Newton's method did not converge, its last scaled update was {update:.1e}; take a smaller step"
    )]
    NotConverged {
        /// The largest scaled update of the last iteration.
        update: f64,
    },
    /// The step violates a law of its scheme by more than rounding explains.
    #[error(
        "{law} at t = {time} s is off by {defect:.3e} {unit}, where rounding explains {bound:.3e} {unit}{}; a smaller step may do",
        element.map_or_else(String::new, |element| format!(" (most of it in {element})")),
        unit = law.unit(), time = Readable(*time))]
    LawNotKept {
        /// The law.
        law: Law,
        /// The violation, in the unit of the law.
        defect: f64,
        /// The bound for rounding, in the same unit.
        bound: f64,
        /// The element that contributes most, if the law holds element by element.
        element: Option<Element>,
        /// The time at the end of the step, s.
        time: f64,
    },
    /// The energy of the new state is infinite or NaN, in a scheme that proves no law.
    #[error("the energy at t = {} s is off by {value} J", Readable(*time))]
    Energy {
        /// The defect of the energy balance, J.
        value: f64,
        /// The time at the end of the step, s.
        time: f64,
    },
    /// The tangent is singular.
    #[error(
        "the tangent matrix is singular: in this step a force or a heat flow answers to no motion or temperature; take a smaller step"
    )]
    SingularTangent,
    /// A load is not finite.
    #[error(
        "component {axis} of the load on {node} is {value} N at t = {time} s, it must be finite", value = Readable(*value), time = Readable(*time))]
    Load {
        /// The node.
        node: Node,
        /// The axis, from 0.
        axis: usize,
        /// The component, N.
        value: f64,
        /// The time, s.
        time: f64,
    },
    /// The thrust of a rocket is not finite.
    #[error(
        "the thrust of the rocket at {node} is {value} N at t = {time} s, it must be finite", value = Readable(*value), time = Readable(*time))]
    Thrust {
        /// The node that it pushes.
        node: Node,
        /// The thrust, N.
        value: f64,
        /// The time, s.
        time: f64,
    },
    /// The prescribed position of an anchor is not finite.
    #[error(
        "coordinate {axis} of the motion of {node} is {value} m at t = {time} s, it must be finite", value = Readable(*value), time = Readable(*time))]
    Motion {
        /// The node.
        node: Node,
        /// The axis, from 0.
        axis: usize,
        /// The coordinate, m.
        value: f64,
        /// The time, s.
        time: f64,
    },
    /// The velocity of a prescribed motion is not finite.
    #[error(
        "the velocity of coordinate {axis} of the motion of {node} is {value} m/s at t = {time} s, it must be finite: its positions are too far apart", value = Readable(*value), time = Readable(*time))]
    MotionSpeed {
        /// The node.
        node: Node,
        /// The axis, from 0.
        axis: usize,
        /// The velocity, m/s.
        value: f64,
        /// The time, s.
        time: f64,
    },
    /// The temperature of an oven is not positive or not finite in a step.
    #[error("the temperature of reservoir {reservoir} is {value} K at t = {time} s, it must be positive and finite", value = Readable(*value), time = Readable(*time))]
    Oven {
        /// The reservoir, counted in the order of creation.
        reservoir: usize,
        /// The temperature, K.
        value: f64,
        /// The time, s.
        time: f64,
    },
    /// A prescribed temperature is not positive and finite.
    #[error(
        "the temperature prescribed on {element} is {value} K at t = {time} s, it must be positive and finite", value = Readable(*value), time = Readable(*time))]
    PrescribedTemperature {
        /// The element.
        element: Element,
        /// The temperature, K.
        value: f64,
        /// The time, s.
        time: f64,
    },
    /// The step is beyond the stability limit of the explicit scheme.
    #[error(
        "{rate} is {product:.1} in the explicit step to t = {time} s, it is stable up to {limit}; take a step of at most {longest:.1e} s, or the implicit scheme {scheme}", time = Readable(*time))]
    Unstable {
        /// The fastest process: `ωh` of a vibration, `κh/c` of conduction, `kh/η` of a dashpot.
        rate: &'static str,
        /// Its rate times the step.
        product: f64,
        /// The largest product for which the scheme is stable.
        limit: f64,
        /// The longest stable step, s.
        longest: f64,
        /// The name of a scheme that is stable.
        scheme: &'static str,
        /// The time at the end of the step, s.
        time: f64,
    },
    /// An element is too cold, or stores too little heat, for an explicit step.
    #[error(
        "{element} has the heat capacity {heat_capacity:.3e} J/K at {temperature} K, too little for the heat of the explicit step to t = {time} s; take a shorter step, or the implicit scheme {scheme}", temperature = Readable(*temperature), time = Readable(*time))]
    TooCold {
        /// The element.
        element: Element,
        /// Its heat capacity at the start of the step, J/K.
        heat_capacity: f64,
        /// Its temperature at the start of the step, K.
        temperature: f64,
        /// The name of a scheme that may work.
        scheme: &'static str,
        /// The time at the end of the step, s.
        time: f64,
    },
    /// The energy error of an explicit step is larger than its accuracy explains.
    #[error(
        "the explicit step to t = {time} s misses the energy by {correction:.1e} of its terms, {limit:.0e} is allowed; take a shorter step", time = Readable(*time))]
    Correction {
        /// The energy error, relative to the energy terms.
        correction: f64,
        /// The largest that is allowed.
        limit: f64,
        /// The time at the end of the step, s.
        time: f64,
    },
    /// A connected body has neither heat nor motion for the energy correction of an explicit step: it is at rest, rotates
    /// rigidly, or all its positions and temperatures are prescribed.
    #[error(
        "the explicit step to t = {time} s has {:.3e} J {}, which neither the heat nor the motion of this step can {}; take another step size, or an implicit scheme such as eem-temperature",
        defect.abs(), if *defect < 0.0 { "too much" } else { "too little" }, if *defect < 0.0 { "take" } else { "give" },
        time = Readable(*time))]
    NotClosed {
        /// The missing energy, J.
        defect: f64,
        /// The time at the end of the step, s.
        time: f64,
    },
    /// The time at the end of the step cannot be represented.
    #[error("the time at the end of the step is {value} s, it must be finite", value = Readable(*value))]
    Time {
        /// The time, s.
        value: f64,
    },
    /// The step is below 2⁻⁵¹¹ s, the square of which is no normal number.
    #[error("the time that is left, {value} s, is too short for a step, which takes at least 1.5e-154 s", value = Readable(*value))]
    TooShort {
        /// The step, s.
        value: f64,
    },
    /// Step control needs a smaller step than allowed.
    #[error("{}: {limit}{}", needed(*is_set, *smallest), too_large.map_or_else(String::new, |error| format!("; no other scheme could be tried: {error}")))]
    TooSmall {
        /// The smallest step that is allowed, s.
        smallest: f64,
        /// Whether [`limit_steps`](crate::Simulation::limit_steps) has set it; else it is 16 ε of the time or of the step.
        is_set: bool,
        /// Why the last one was rejected.
        limit: Box<StepLimit>,
        /// Memory needed by another scheme that [`Scheme::Auto`](crate::Scheme::Auto) could not try.
        too_large: Option<TooLarge>,
    },
    /// The end time of a run is invalid.
    #[error("the end time is {end} s, it must not lie before the present time, and be finite and in reach of the steps unless an observer or an event can end the run", end = Readable(*end))]
    End {
        /// The end time, s.
        end: f64,
    },
    /// The tolerance of an event is invalid.
    #[error("the tolerance of event {event} is {value} s, it must not be negative", value = Readable(*value))]
    EventTolerance {
        /// Its index in the list.
        event: usize,
        /// The tolerance, s.
        value: f64,
    },
    /// The function of an event is not a number.
    #[error(
        "the function of event {event} is not a number, it must be one in every state of the run"
    )]
    EventFunction {
        /// Its index in the list.
        event: usize,
    },
    /// The function of an event returned an error.
    #[error("the function of event {event} failed: {reason}")]
    EventError {
        /// Its index in the list.
        event: usize,
        /// The message of its error.
        reason: String,
    },
    /// A trial state has the wrong number of unknowns.
    #[error("{given} unknowns were given, the scene has {expected}")]
    Unknowns {
        /// How many were given.
        given: usize,
        /// How many there are.
        expected: usize,
    },
    /// Newton's method leads to an inadmissible state of an element.
    #[error(transparent)]
    State(#[from] StateError),
}

impl StepFailure {
    /// The error of an invalid value of a load, in the component `axis`, at a time in s.
    pub(crate) fn of_load(load: TimedLoad, axis: usize, value: f64, time: f64) -> Self {
        match load {
            TimedLoad::Force(node) => Self::Load {
                node,
                axis,
                value,
                time,
            },
            TimedLoad::Thrust(node) => Self::Thrust { node, value, time },
            TimedLoad::Motion(node) => Self::Motion {
                node,
                axis,
                value,
                time,
            },
            TimedLoad::Temperature(element) => Self::PrescribedTemperature {
                element,
                value,
                time,
            },
            TimedLoad::Oven(reservoir) => Self::Oven {
                reservoir,
                value,
                time,
            },
        }
    }

    /// Whether the step failed, and not an argument of the call.
    const fn is_of_a_step(&self) -> bool {
        !matches!(
            self,
            Self::End { .. }
                | Self::EventTolerance { .. }
                | Self::EventFunction { .. }
                | Self::EventError { .. }
                | Self::Unknowns { .. }
        )
    }

    /// Whether a step of another size from the same state may succeed.
    pub(crate) const fn depends_on_step(&self) -> bool {
        let is_final = matches!(
            self,
            Self::Time { .. } | Self::TooShort { .. } | Self::TooSmall { .. }
        );
        self.is_of_a_step() && !is_final
    }
}

impl core::fmt::Display for StepError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let (failure, time) = (&self.failure, Readable(self.time));
        if !failure.is_of_a_step() {
            return write!(f, "at t = {time} s: {failure}");
        }
        let (step, iterations) = (Readable(self.step), self.history.len());
        write!(
            f,
            "step from t = {time} s by {step} s failed after {iterations} iterations in all attempts: {failure}"
        )?;
        match self.shorter {
            Some(shorter) => write!(f, " (a step of {} s would do)", Readable(shorter)),
            None => Ok(()),
        }
    }
}

impl core::error::Error for StepError {}

impl Law {
    /// The error of a step to `time` that violates the law, most of all in one element.
    pub(crate) fn not_kept(
        self,
        [defect, bound]: [f64; 2],
        element: Option<Element>,
        time: f64,
    ) -> StepFailure {
        StepFailure::LawNotKept {
            law: self,
            defect,
            bound,
            element,
            time,
        }
    }
}

impl From<Singular> for StepFailure {
    fn from(_: Singular) -> Self {
        Self::SingularTangent
    }
}

/// What a smaller step would be needed for.
fn needed(is_set: bool, smallest: f64) -> String {
    if is_set {
        let smallest = Readable(smallest);
        format!("steps of less than {smallest} s would be needed")
    } else {
        "no step is short enough".to_owned()
    }
}

/// The unknown that limits a step.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct WorstError {
    /// The unknown, such as `the momentum of node 2 along axis 0`.
    pub of: String,
    /// Its unit.
    pub unit: &'static str,
    /// Its error in the last step.
    pub error: f64,
    /// The error that the tolerance allows in that step.
    pub allowed: f64,
    /// The setting of a [`Tolerance`](crate::Tolerance) that allows more.
    pub setting: &'static str,
}

impl core::fmt::Display for WorstError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self {
            of,
            unit,
            error,
            allowed,
            setting,
        } = self;
        let unit = if unit.is_empty() {
            String::new()
        } else {
            format!(" {unit}")
        };
        write!(
            f,
            "{of}: {error:.1e}{unit}, where {allowed:.1e}{unit} is allowed; a larger tolerance or {setting} allows more"
        )
    }
}

/// Why step control rejected a step.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum StepLimit {
    /// The step was not accurate.
    #[error("the error of the last one was {error:.1e} of the tolerance{}", worst.as_ref().map_or_else(String::new, |worst| format!(", most of it in {worst}")))]
    Error {
        /// In units of the tolerance.
        error: f64,
        /// The unknown with the largest error.
        worst: Option<WorstError>,
    },
    /// A load that is a function of time changes within a step in a way that the step would pass over.
    #[error(
        "{load} changes so much within the last one that the step would pass over it; let steps end where it jumps (`stop_at`), or set a larger smallest step"
    )]
    Load {
        /// The load.
        load: TimedLoad,
    },
    /// There was no new state, or the step did not prove its laws.
    #[error("{0}")]
    Failure(Box<StepFailure>),
}

/// A failed step. The simulation is unchanged.
#[derive(Clone, Debug, PartialEq)]
pub struct StepError {
    /// The time at which the step began, s.
    pub time: f64,
    /// The time step, s.
    pub step: f64,
    /// Why it failed. It is part of the message, so it is not the `source`.
    pub failure: StepFailure,
    /// A shorter step, s, that was tried and works; `None` with step control, if no step failed, or if
    /// halving the step down to a thousandth does not help.
    pub shorter: Option<f64>,
    /// The iterations of all attempts. [`NewtonSettings::max_iterations`](crate::NewtonSettings) is the limit of
    /// one attempt.
    pub history: Box<[NewtonIteration]>,
}
