//! The loads of a scene: forces, moved anchors, prescribed temperatures.

use std::sync::Arc;

use nalgebra::SVector;

use crate::element::handle::{Element, Node};
use crate::element::loads::PushLine;
use eem_material::number::scalar::{Mask, Real};

/// The largest difference, in ε of its size, between a prescribed function and a state that follows it: a formula
/// `c + a f(t)` rounds function, product and sum, each by at most ε of the size of the result or of the scene; a fourth ε
/// is for the rounded state.
///
/// In a step, `q⁰ + (x(t) − q⁰)` differs from `x(t)` by less: half an ε for each of the two sums, of at most twice the
/// size, and half an ε for the compensation.
pub(crate) const MOTION_ROUNDINGS: f64 = 4.0;

/// From an end of a step to a time that is certainly inside, in ε of the times: one for the rounding of the end, one for that of the
/// time at which steps end, and twice that to be safe.
const INSIDE_ROUNDINGS: f64 = 4.0;

/// The largest magnitude of coordinates, m.
///
/// Errors of motions are measured in this unit, not in that of their own coordinates: elements depend on differences of
/// positions, which have the rounding of the largest ones.
pub(crate) fn extent<'a, S: Real>(coordinates: impl Iterator<Item = &'a S>) -> S {
    coordinates.fold(S::zero(), |most, coordinate| most.maximum(coordinate.abs()))
}

/// A vector (force in N, position in m) as a function of time in s.
pub(crate) type OfTime<S, const D: usize> = Arc<dyn Fn(S) -> SVector<S, D> + Send + Sync>;

/// A scalar (temperature in K, thrust in N) as a function of time in s.
pub(crate) type ScalarOfTime<S> = Arc<dyn Fn(S) -> S + Send + Sync>;

/// The values of a load in the course of time; `F` is the type of a function of time in s.
#[derive(Clone)]
pub(crate) enum Course<F, T> {
    /// A function of the user.
    Function(F),
    /// The same value at all times.
    Constant(T),
    /// A value that holds until another one is set: a force, the velocity of an anchor, or a temperature that is reached at
    /// the end of a step.
    Set(T),
}

/// The value between one at the beginning and one at the end of a step, at a share of it.
fn between<S: Real>(from: S, to: S, share: S) -> S {
    S::branch(share.equal(S::one()), || to, || from + share * (to - from))
}

impl<F, T> Course<F, T> {
    /// The function of the user, if it is one.
    pub(crate) const fn function(&self) -> Option<&F> {
        match self {
            Self::Function(of) => Some(of),
            Self::Constant(_) | Self::Set(_) => None,
        }
    }
}

impl<S: Real, const D: usize> Course<OfTime<S, D>, SVector<S, D>> {
    /// The position of an anchor at a time, m, `elapsed` seconds after it was at `from`.
    pub(crate) fn position(&self, time: S, from: &[S; D], elapsed: S) -> SVector<S, D> {
        match self {
            Self::Function(of) => of(time),
            Self::Constant(position) => *position,
            Self::Set(velocity) => {
                SVector::from_fn(|axis, _| from[axis] + elapsed * velocity[axis])
            }
        }
    }
}

impl<S: Real> Course<ScalarOfTime<S>, S> {
    /// The value at a time, at this share of a step that begins with the value `from`.
    pub(crate) fn at(&self, time: S, from: S, share: S) -> S {
        match self {
            Self::Function(of) => of(time),
            Self::Constant(value) => *value,
            Self::Set(to) => between(from, *to, share),
        }
    }
}

/// The course of a force or of an anchor.
pub(crate) type VectorCourse<S, const D: usize> = Course<OfTime<S, D>, SVector<S, D>>;

/// The course of a temperature.
pub(crate) type TemperatureCourse<S> = Course<ScalarOfTime<S>, S>;

/// A force of a given size in N as a function of time in s, along a line that turns with two nodes.
#[derive(Clone)]
pub(crate) struct Rocket<S> {
    pub(crate) line: PushLine,
    pub(crate) thrust: Arc<dyn Fn(S) -> S + Send + Sync>,
}

/// All loads of a scene, as given.
#[derive(Clone)]
pub(crate) struct Loads<S: Real, const D: usize> {
    /// Acceleration of free fall, m/s².
    pub(crate) gravity: SVector<S, D>,
    pub(crate) forces: Vec<(Node, VectorCourse<S, D>)>,
    pub(crate) rockets: Vec<Rocket<S>>,
    pub(crate) motions: Vec<(Node, VectorCourse<S, D>)>,
    pub(crate) temperatures: Vec<(Element, TemperatureCourse<S>)>,
    /// Indices of reservoirs whose temperature is a function of time.
    pub(crate) ovens: Vec<(usize, ScalarOfTime<S>)>,
    /// Times at which steps end, s, in ascending order.
    pub(crate) stops: Vec<S>,
    /// No load lasts less than this, s.
    pub(crate) shortest: Option<S>,
}

impl<S: Real, const D: usize> Loads<S, D> {
    /// No loads.
    pub(crate) fn none() -> Self {
        Self {
            gravity: SVector::from_element(S::zero()),
            forces: Vec::new(),
            rockets: Vec::new(),
            motions: Vec::new(),
            temperatures: Vec::new(),
            ovens: Vec::new(),
            stops: Vec::new(),
            shortest: None,
        }
    }

    pub(crate) fn are_none(&self) -> bool {
        let has_force = self.have_weight() || !self.forces.is_empty() || !self.rockets.is_empty();
        let has_heat = !self.temperatures.is_empty() || !self.ovens.is_empty();
        !has_force && !has_heat && self.motions.is_empty()
    }

    /// A time in a step at which a force is evaluated: some roundings inside the step if there are times at which steps end. The
    /// function may jump at such a time; one step sees it before, and the next one behind.
    #[inline]
    pub(crate) fn inside(&self, [start, step]: [S; 2], time: S) -> S {
        if self.stops.is_empty() {
            return time;
        }
        let inside = S::from_f64(INSIDE_ROUNDINGS) * S::EPSILON * (start.abs() + step);
        let (first, last) = (start + inside, (start + step) - inside);
        time.maximum(first).minimum(last)
    }

    /// The lines of all rockets.
    pub(crate) fn rocket_lines(&self) -> Vec<PushLine> {
        self.rockets.iter().map(|rocket| rocket.line).collect()
    }

    pub(crate) fn have_weight(&self) -> bool {
        self.has_weight().any()
    }

    /// Whether gravity is not zero, per lane.
    pub(crate) fn has_weight(&self) -> S::Mask {
        let none = S::Mask::none();
        let components = self.gravity.iter();
        components.fold(none, |any, &component| any | !component.equal(S::zero()))
    }
}

impl<S: Real, const D: usize> core::fmt::Debug for Loads<S, D> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Loads")
            .field("gravity", &self.gravity)
            .field("forces", &self.forces.len())
            .field("rockets", &self.rockets.len())
            .field("motions", &self.motions.len())
            .field("temperatures", &self.temperatures.len())
            .field("ovens", &self.ovens.len())
            .field("stops", &self.stops)
            .field("shortest", &self.shortest)
            .finish()
    }
}
