//! Tolerances of step control, and errors in units of them.

use crate::algebra::length;
use crate::element::state::State;
use crate::scene::error::SceneError;
use crate::step::control::controller::{Accuracy, ROUNDINGS};
use crate::step::control::least::{LeastScales, Step};
use crate::step::control::rounding::LoadRounding;
use crate::step::control::worst::{Unknown, UnknownError, see_worst};
use eem_material::number::scalar::{Scalar, is_positive};

/// The tolerance of step control.
///
/// Errors of positions are relative to `|q|₂`, of momenta to the largest `|p|₂` of the run so far, and of each
/// temperature to itself:
///
/// ```text
/// error = max(|δq|/(r |q|₂ + a_q), |δγ|/(r |λ|₂ + a_q), |δp|/(r max |p|₂ + a_p), |δθ|/(r θ + a_θ))
/// ```
///
/// |λ|₂ is over the springs with dashpots in series. Viscous strains of solids are dimensionless and compared with `r + a_q`. Momenta of prescribed nodes are ignored.
///
/// From rest |p|₂ is no scale: at each mass it counts as at least `m r² ℓ ω`, the momentum of a vibration whose amplitude is r²
/// times the shortest length ℓ there; and |q|₂ as at least r times that of the start. While |p|₂ grows beyond all that it has been,
/// the schemes with two halves take what it becomes in a period, at most 8 times as much.
///
/// Errors that rounding explains are none, and neither reject a step nor make it shorter: of a momentum `16 ε h Σ k (λ + |q|)`, as
/// lengths are differences of rounded positions, and `4 ε h |t| |ḟ|` of a load, as a function is evaluated at rounded times.
///
/// A `Study` measures errors in the same way, in units of `|q|₂`, the largest `|p|₂` and θ.
///
/// The relative tolerance r is what the errors of the steps add up to in the time scale of the motion, in which the state
/// changes by its own size, about a period of the fastest vibration. Errors are proportional to r: a scheme of order p
/// makes steps with an error of `r^(1 + 1/p)`, and `r^(−1/p)` of them make up that time (tolerance proportionality;
/// Söderlind & Wang 2006, *Adaptive time-stepping and computational stability*, §4). With [`over`](Self::over) r is what
/// they add up to in a time of your choice. The explicit scheme, whose estimate has a lower order than the scheme, uses r
/// directly.
///
/// A motion can damp the errors of its steps or amplify them; the page about choosing has an example of each.
///
/// Absolute tolerances are zero by default. They matter only for quantities that pass through zero and are small
/// compared with all others.
///
/// ```
/// use eem::Tolerance;
///
/// let tolerance = Tolerance::new(1e-6).with_temperature(1e-3);
/// assert_eq!((tolerance.relative, tolerance.temperature, tolerance.position), (1e-6, 1e-3, 0.0));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(deny_unknown_fields)
)]
#[non_exhaustive]
pub struct Tolerance {
    /// The relative tolerance r.
    pub relative: f64,
    /// The absolute tolerance `a_q` of positions and viscous stretches, m.
    pub position: f64,
    /// The absolute tolerance `a_p` of momenta, kg m/s.
    pub momentum: f64,
    /// The absolute tolerance `a_θ` of temperatures, K.
    pub temperature: f64,
    /// The time in which the errors of all steps may add up to the tolerance, s; without one, the time scale of the motion.
    pub over: Option<f64>,
}

/// A relative tolerance of 1e-6.
impl Default for Tolerance {
    fn default() -> Self {
        Self::new(1e-6)
    }
}

impl Tolerance {
    /// A relative tolerance, without absolute ones.
    #[must_use]
    pub fn new(relative: f64) -> Self {
        Self {
            relative,
            position: 0.0,
            momentum: 0.0,
            temperature: 0.0,
            over: None,
        }
    }

    /// The errors of all steps in this time, s, may add up to the tolerance: a step of the size h may have the part
    /// `h/time` of it (error per unit step). The explicit scheme ignores it, since its estimate has a lower order than
    /// the scheme.
    ///
    /// ```
    /// use eem::Tolerance;
    /// use eem::materials::Hooke;
    /// use eem::prelude::*;
    ///
    /// // ω = 10/s: the error of the phase is the sum of those of 16 periods.
    /// let mut scene = Scene::<1>::new();
    /// let ends = [scene.anchor([0.0]), scene.mass(1.0, [1.1], [0.0])];
    /// let mass = ends[1];
    /// scene.spring(Hooke { stiffness: 100.0, natural_length: 1.0 }, ends);
    /// let mut run = Simulation::new(scene, Scheme::EemEntropy4, 0.01)?;
    /// run.control_steps(Tolerance::new(1e-6).over(10.0))?;
    /// run.run_until(10.0)?;
    ///
    /// let error = (run.position(mass)?[0] - (1.0 + 0.1 * 100.0_f64.cos())).abs();
    /// assert!(error < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn over(self, time: f64) -> Self {
        let over = Some(time);
        Self { over, ..self }
    }

    /// Sets the absolute tolerance of positions and viscous stretches, m.
    #[must_use]
    pub fn with_position(self, position: f64) -> Self {
        Self { position, ..self }
    }

    /// Sets the absolute tolerance of momenta, kg m/s.
    #[must_use]
    pub fn with_momentum(self, momentum: f64) -> Self {
        Self { momentum, ..self }
    }

    /// Sets the absolute tolerance of temperatures, K.
    #[must_use]
    pub fn with_temperature(self, temperature: f64) -> Self {
        Self {
            temperature,
            ..self
        }
    }

    /// An error unless a scheme of this accuracy can satisfy it.
    pub(crate) fn check(&self, accuracy: Accuracy) -> Result<(), SceneError> {
        let floor = accuracy.floor();
        let relative = self.relative;
        if !(relative >= floor && relative < 1.0) {
            return Err(SceneError::Tolerance { relative, floor });
        }
        let absolute = [
            ("positions", self.position, "m"),
            ("momenta", self.momentum, "kg m/s"),
            ("temperatures", self.temperature, "K"),
        ];
        if let Some(time) = self.over.filter(|&time| !is_positive(time)) {
            return Err(SceneError::ToleranceTime { time });
        }
        for (quantity, value, unit) in absolute {
            if !(is_positive(value) || value == 0.0) {
                return Err(SceneError::AbsoluteTolerance {
                    quantity,
                    value,
                    unit,
                });
            }
        }
        Ok(())
    }
}

/// The variables that are compared differently from others.
#[derive(Clone, Debug)]
pub(crate) struct Kinds {
    /// Which viscous variables are strains of solids.
    pub(crate) are_strains: Vec<bool>,
    /// Which momenta, by coordinate, follow from a prescribed motion, so that their errors do not add up: they are ignored.
    /// Empty without prescribed motions.
    pub(crate) are_given: Vec<bool>,
}

/// The scales of the errors of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scales<'a> {
    /// Of a coordinate, m, of a viscous stretch, m, and of a viscous strain.
    position: f64,
    stretch: f64,
    strain: f64,
    /// Relative and absolute tolerance of momenta, their size, and the least scales.
    momentum: [f64; 2],
    momenta: f64,
    least: &'a LeastScales,
    step: Step,
    /// The relative tolerance of this step alone.
    own: f64,
    /// The share of the difference of a whole step and two halves that is an error.
    share: f64,
    /// The relative and the absolute tolerance of temperatures.
    temperature: [f64; 2],
    /// Both states, and the dimension of space.
    states: [&'a State; 2],
    dimension: usize,
}

impl<'a> Scales<'a> {
    /// For a step of this size between two states in space of a dimension, given the largest momentum so far, kg m/s.
    pub(crate) fn new(
        dimension: usize,
        tolerance: &Tolerance,
        (accuracy, step): (Accuracy, f64),
        [old, new]: [&'a State; 2],
        (largest_momentum, least): (f64, &'a LeastScales),
    ) -> Self {
        let part = tolerance.over.map_or(1.0, |time| step / time);
        let relative = accuracy.of_step(tolerance.relative, part);
        let relative = Scalar::maximum(relative, ROUNDINGS * f64::EPSILON);
        let share = relative / tolerance.relative;
        let of = |size: f64, absolute: f64| relative * size + share * absolute;
        let [first, last] = [old.positions.values(), new.positions.values()];
        let positions = Scalar::maximum(length(first), length(last));
        let positions = Scalar::maximum(positions, least.position(tolerance.relative));
        let stretch = |positions| least.stretches(dimension, positions);
        let stretches = Scalar::maximum(stretch(first), stretch(last));
        let [start, end] = [length(old.momenta.values()), length(new.momenta.values())];
        let before = Scalar::maximum(start, largest_momentum);
        let momenta = Scalar::maximum(end, before);
        let growth = (end - start) / (step * end);
        let growth = if before < end { growth } else { 0.0 };
        Self {
            position: of(positions, tolerance.position),
            stretch: of(stretches, tolerance.position),
            strain: of(1.0, tolerance.position),
            momentum: [relative, share * tolerance.momentum],
            momenta,
            least,
            step: Step {
                size: step,
                relative: tolerance.relative,
                growth,
            },
            own: relative,
            share: accuracy.share_of_difference(relative),
            temperature: [relative, share * tolerance.temperature],
            states: [old, new],
            dimension,
        }
    }

    /// What the tolerance allows a momentum of this node, kg m/s: at least its rounding.
    pub(crate) fn momentum(&self, node: usize) -> f64 {
        Scalar::maximum(self.allowed_momentum(node), self.rounding(node))
    }

    fn allowed_momentum(&self, node: usize) -> f64 {
        let [relative, absolute] = self.momentum;
        let momentum = self.least.at(node).scale(self.momenta, self.step);
        relative * momentum + absolute
    }

    /// The rounding of the impulse on a node by that of positions, N s.
    fn rounding(&self, node: usize) -> f64 {
        let distance = |state: &State| {
            length(&state.positions.values()[node * self.dimension..][..self.dimension])
        };
        let [start, end] = self.states;
        let distance = Scalar::maximum(distance(start), distance(end));
        self.least.at(node).rounding(self.step.size, distance)
    }

    /// What the tolerance allows the integral of the displacement of a moved anchor, m s: multiplied by the stiffness, it is an
    /// impulse on the mass at the other end.
    pub(crate) fn displacement(&self, anchor: usize) -> f64 {
        let pulled = self.least.pulled_by(anchor);
        pulled.fold(f64::MAX, |least, (mass, stiffness)| {
            Scalar::minimum(least, self.momentum(mass) / stiffness)
        })
    }

    /// The state before the step.
    pub(crate) const fn before(&self) -> &'a State {
        self.states[0]
    }

    /// What the tolerance of this step allows a position, m.
    pub(crate) const fn position(&self) -> f64 {
        self.position
    }

    /// What the tolerance of the state, not of this step, allows a position, m.
    pub(crate) fn height(&self) -> f64 {
        self.position * (self.step.relative / self.own)
    }

    /// The largest error, in units of the tolerance, found from the states after a whole step and two halves. With the rounding of
    /// loads, what rounding explains is none.
    pub(crate) fn error(
        &self,
        states: [&State; 2],
        kinds: &Kinds,
        rounding: Option<&LoadRounding>,
    ) -> f64 {
        let mut largest = 0.0;
        let mut see = |_, difference: f64, [scale, rounding]: [f64; 2]| {
            let error = Scalar::maximum(self.share * difference - rounding, 0.0);
            // No difference is no error, even at scale zero.
            if error != 0.0 {
                largest = Scalar::maximum(largest, error / Scalar::maximum(scale, rounding));
            }
        };
        self.each_difference(states, kinds, rounding, &mut see);
        largest
    }

    /// The unknown with the largest error, with the error and what the tolerance and rounding allow.
    #[cold]
    pub(crate) fn worst(
        &self,
        states: [&State; 2],
        kinds: &Kinds,
        rounding: &LoadRounding,
    ) -> Option<UnknownError> {
        let mut worst = None;
        let mut see = |unknown, difference: f64, [scale, rounding]: [f64; 2]| {
            let allowed = Scalar::maximum(scale, rounding) + rounding;
            see_worst(&mut worst, unknown, [self.share * difference, allowed]);
        };
        self.each_difference(states, kinds, Some(rounding), &mut see);
        worst
    }

    /// Calls `see` with each difference, its scale and, if that of loads is known, its rounding.
    fn each_difference(
        &self,
        [a, b]: [&State; 2],
        kinds: &Kinds,
        loads: Option<&LoadRounding>,
        see: &mut dyn FnMut(Unknown, f64, [f64; 2]),
    ) {
        let (positions, momenta) = (&a.positions, &a.momenta);
        let loads = loads.map(|loads| (loads, length(b.positions.values())));
        let unknowns: [fn(usize) -> Unknown; 4] = [
            Unknown::Position,
            Unknown::Momentum,
            Unknown::Viscous,
            Unknown::Temperature,
        ];
        let values = [
            [positions.values(), b.positions.values()],
            [momenta.values(), b.momenta.values()],
            [a.viscous.values(), b.viscous.values()],
            [&a.temperatures, &b.temperatures],
        ];
        for (unknown, [a, b]) in unknowns.into_iter().zip(values) {
            for (at, (&a, &b)) in a.iter().zip(b).enumerate() {
                let unknown = unknown(at);
                see(unknown, (a - b).abs(), self.scale(unknown, b, kinds, loads));
            }
        }
    }

    /// The scale of an unknown of this value and, given the rounding of loads and |q|₂, its rounding.
    fn scale(
        &self,
        unknown: Unknown,
        value: f64,
        kinds: &Kinds,
        known: Option<(&LoadRounding, f64)>,
    ) -> [f64; 2] {
        let rounding =
            |of: &dyn Fn(&LoadRounding) -> f64| known.map_or(0.0, |(loads, _)| of(loads));
        let impulse = |node: usize| rounding(&|loads| self.rounding(node) + loads.at(node).impulse);
        match unknown {
            Unknown::Position(at) => {
                let node = at / self.dimension;
                let moved = rounding(&|loads| {
                    let mobility = self.least.at(node).mobility(self.step.size);
                    mobility * impulse(node) + loads.at(node).position
                });
                [self.position, moved]
            }
            Unknown::Momentum(at) if kinds.are_given.get(at) == Some(&true) => [f64::MAX, 0.0],
            Unknown::Momentum(at) => {
                let node = at / self.dimension;
                [self.allowed_momentum(node), impulse(node)]
            }
            Unknown::Viscous(at) if kinds.are_strains[at] => [self.strain, 0.0],
            Unknown::Viscous(_) => {
                let positions = known.map_or(0.0, |(_, positions)| positions);
                [self.stretch, ROUNDINGS * f64::EPSILON * positions]
            }
            Unknown::Temperature(slot) => {
                let [relative, absolute] = self.temperature;
                let rounding = rounding(&|loads| loads.temperature(slot));
                [relative * value + absolute, rounding]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::step::control::controller::Estimate;

    #[test]
    fn tolerances_of_steps_make_errors_of_the_state_proportional() {
        let accuracy = |order| Accuracy {
            order,
            least_order: order,
            estimate: Estimate::Halves,
        };
        let step: f64 = accuracy(2).of_step(1e-6, 0.5);
        assert!((step / 1e-9 - 1.0).abs() < 1e-12);
        let step: f64 = accuracy(2).over_time().of_step(1e-6, 0.5);
        assert_eq!(step.to_bits(), 5e-7_f64.to_bits());
        assert!(accuracy(4).floor() < accuracy(2).floor());
    }

    #[test]
    fn tolerances_below_the_floor_are_errors() {
        let accuracy = Accuracy {
            order: 2,
            least_order: 2,
            estimate: Estimate::Halves,
        };
        for relative in [0.0, -1.0, f64::NAN, 1.0, 1e-12] {
            let refused = Tolerance::new(relative).check(accuracy);
            assert!(
                matches!(refused, Err(SceneError::Tolerance { .. })),
                "{relative}"
            );
        }
        let absolute = Tolerance::new(1e-3).with_momentum(-1.0).check(accuracy);
        assert!(matches!(
            absolute,
            Err(SceneError::AbsoluteTolerance { .. })
        ));
        assert_eq!(Tolerance::new(1e-8).check(accuracy), Ok(()));
    }
}
