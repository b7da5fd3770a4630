//! The loads of a scene: forces, moved anchors, prescribed temperatures.

use std::sync::Arc;

use crate::algebra::ascending;
use crate::element::handle::{Element, Node};
use crate::element::loads::PushLine;
use eem_material::number::scalar::Scalar;

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
pub(crate) fn extent(coordinates: &[f64]) -> f64 {
    coordinates.iter().fold(0.0, |most, coordinate| {
        Scalar::maximum(most, coordinate.abs())
    })
}

/// A vector (force in N, position in m) as a function of time in s, which writes its components.
pub(crate) type OfTime = Arc<dyn Fn(f64, &mut [f64]) + Send + Sync>;

/// A scalar (temperature in K, thrust in N) as a function of time in s.
pub(crate) type ScalarOfTime = Arc<dyn Fn(f64) -> f64 + Send + Sync>;

/// A vector or a scalar as a function of time in s, which writes its components.
pub(crate) type Written<'a> = &'a dyn Fn(f64, &mut [f64]);

/// A scalar as a function that writes one component.
pub(crate) fn written_scalar(of: &ScalarOfTime) -> impl Fn(f64, &mut [f64]) {
    |time, components| components[0] = of(time)
}

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
fn between(from: f64, to: f64, share: f64) -> f64 {
    #[expect(clippy::float_cmp, reason = "the end itself")]
    if share == 1.0 {
        to
    } else {
        from + share * (to - from)
    }
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

impl VectorCourse {
    /// Finds the position of an anchor at a time, m, `elapsed` seconds after it was at `from`.
    pub(crate) fn find_position(&self, time: f64, from: &[f64], elapsed: f64, place: &mut [f64]) {
        match self {
            Self::Function(of) => of(time, place),
            Self::Constant(position) => place.copy_from_slice(position),
            Self::Set(velocity) => {
                for (axis, place) in place.iter_mut().enumerate() {
                    *place = from[axis] + elapsed * velocity[axis];
                }
            }
        }
    }

    /// The same in a space of known dimension.
    pub(crate) fn position<const D: usize>(
        &self,
        time: f64,
        from: &[f64; D],
        elapsed: f64,
    ) -> [f64; D] {
        let mut place = [0.0; D];
        self.find_position(time, from, elapsed, &mut place);
        place
    }
}

impl TemperatureCourse {
    /// The value at a time, at this share of a step that begins with the value `from`.
    pub(crate) fn at(&self, time: f64, from: f64, share: f64) -> f64 {
        match self {
            Self::Function(of) => of(time),
            Self::Constant(value) => *value,
            Self::Set(to) => between(from, *to, share),
        }
    }
}

/// The course of a force or of an anchor.
pub(crate) type VectorCourse = Course<OfTime, Box<[f64]>>;

/// The course of a temperature.
pub(crate) type TemperatureCourse = Course<ScalarOfTime, f64>;

/// A force of a given size in N as a function of time in s, along a line that turns with two nodes.
#[derive(Clone)]
pub(crate) struct Rocket {
    pub(crate) line: PushLine,
    pub(crate) thrust: ScalarOfTime,
}

/// All loads of a scene, as given.
#[derive(Clone)]
pub(crate) struct SceneLoads {
    /// Acceleration of free fall, m/s².
    pub(crate) gravity: Box<[f64]>,
    pub(crate) forces: Vec<(Node, VectorCourse)>,
    pub(crate) rockets: Vec<Rocket>,
    pub(crate) motions: Vec<(Node, VectorCourse)>,
    pub(crate) temperatures: Vec<(Element, TemperatureCourse)>,
    /// Indices of reservoirs whose temperature is a function of time.
    pub(crate) ovens: Vec<(usize, ScalarOfTime)>,
    /// Times at which steps end, s, in ascending order.
    pub(crate) stops: Vec<f64>,
    /// No load lasts less than this, s.
    pub(crate) shortest: Option<f64>,
}

impl SceneLoads {
    /// No loads in a space of this dimension.
    pub(crate) fn none(dimension: usize) -> Self {
        Self {
            gravity: vec![0.0; dimension].into(),
            forces: Vec::new(),
            rockets: Vec::new(),
            motions: Vec::new(),
            temperatures: Vec::new(),
            ovens: Vec::new(),
            stops: Vec::new(),
            shortest: None,
        }
    }

    pub(crate) fn dimension(&self) -> usize {
        self.gravity.len()
    }

    pub(crate) fn are_none(&self) -> bool {
        !self.have_weight() && self.are_at_most_weight()
    }

    /// Whether there are no loads but gravity.
    pub(crate) fn are_at_most_weight(&self) -> bool {
        let has_force = !self.forces.is_empty() || !self.rockets.is_empty();
        let has_heat = !self.temperatures.is_empty() || !self.ovens.is_empty();
        !has_force && !has_heat && self.motions.is_empty()
    }

    /// A time in a step at which a force is evaluated, see [`inside`].
    #[inline]
    pub(crate) fn inside(&self, span: [f64; 2], time: f64) -> f64 {
        inside(&self.stops, span, time)
    }

    /// The anchors that functions of time move, in ascending order.
    pub(crate) fn moved_in_time(&self) -> Vec<usize> {
        let mut moved = Vec::new();
        for (node, motion) in &self.motions {
            if motion.function().is_some() {
                moved.push(node.index);
            }
        }
        ascending(moved)
    }

    /// The lines of all rockets.
    pub(crate) fn rocket_lines(&self) -> Vec<PushLine> {
        let mut lines = Vec::with_capacity(self.rockets.len());
        for rocket in &self.rockets {
            lines.push(rocket.line);
        }
        lines
    }

    /// Whether forces are functions of time.
    pub(crate) fn have_forces_of_time(&self) -> bool {
        let mut forces = self.forces.iter();
        forces.any(|(_, force)| force.function().is_some())
    }

    /// Whether gravity is not zero.
    pub(crate) fn have_weight(&self) -> bool {
        self.gravity.iter().any(|&component| component != 0.0)
    }
}

/// A time in a step at which a force is evaluated: some roundings inside the step if there are times at which steps end. The
/// function may jump at such a time; one step sees it before, and the next one behind.
#[inline]
pub(crate) fn inside(stops: &[f64], [start, step]: [f64; 2], time: f64) -> f64 {
    if stops.is_empty() {
        return time;
    }
    let inside = INSIDE_ROUNDINGS * f64::EPSILON * (start.abs() + step);
    let (first, last) = (start + inside, (start + step) - inside);
    Scalar::minimum(Scalar::maximum(time, first), last)
}

impl core::fmt::Debug for SceneLoads {
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
