//! The error of a step from its two halves, for schemes without an estimate of their own.
//!
//! A step of the size H is made whole, and in two halves. The halves are kept; their difference from the whole
//! step estimates their error,
//!
//! ```text
//! error = |y_H − y_{H/2, H/2}| max(1/(2ᵖ − 1), r₁)
//! ```
//!
//! with the tolerance r₁ of one step. The share is that of an expansion in H, which ends where the difference is as large as the quantity
//! itself, so that it is at most this. Else two steps that are both wrong, by a whole amplitude each, would pass a loose tolerance.
//!
//! Every part is a step of the scheme like any other, and proves its laws. The estimate needs only the order p of the
//! scheme, so that it stays right where the motion is stiff or conduction is fast.

use core::f64::consts::TAU;

use super::attempt::start;
use super::memory::{Control, Halves, or_restore};
use super::{Run, Stepped, Tried};
use crate::algebra::indices;
use crate::element::handle::Node;
use crate::element::layout::Slots;
use crate::element::state::State;
use crate::step::control::{Kinds, LoadRounding, Scales, Unknown, norm};
use crate::step::error::{StepError, WorstError};
use crate::step::explicit::Demand;
use eem_material::number::scalar::Scalar;

impl Run {
    /// Work arrays for a whole step and for its two halves.
    pub(super) fn new_halves(&self) -> Halves {
        let (past, _) = self.stepper.past(&self.state);
        let (mut slots, mut are_given) = (Vec::new(), Vec::new());
        for (node, _) in &self.loads.motions {
            are_given.resize(self.masses.len() * self.dimension, false);
            are_given[node.index * self.dimension..][..self.dimension].fill(true);
        }
        for (element, _) in &self.loads.temperatures {
            slots.push(self.thermal_slot(*element).ok());
        }
        let counts = [self.masses.len(), self.layout.thermal];
        Halves {
            before: State::clone(&self.state),
            past,
            whole: State::clone(&self.state),
            kinds: Kinds {
                are_strains: self.viscous_strains(),
                are_given,
            },
            rounding: LoadRounding::new(&self.loads, slots, counts),
        }
    }

    /// A step of this size and its error; the state is unchanged if the step fails or is rejected.
    pub(super) fn attempt(&mut self, control: &mut Control, size: f64) -> Result<Tried, StepError> {
        if let Some(load) = self.unseen_load(control, size)? {
            return Ok(Tried::Unseen(load));
        }
        let (memory, accuracy) = (&control.memory, control.accuracy);
        let Some(halves) = &mut control.halves else {
            return self.try_step(size, Demand::Within(memory.tolerance));
        };
        self.step_twice(halves, size)?;
        let ends = [&halves.before, &*self.state];
        let accurate = (accuracy, size);
        let least = (memory.largest_momentum, &self.least);
        let scales = Scales::new(self.dimension, &memory.tolerance, accurate, ends, least);
        if self.flies(size, &scales, accuracy.order()) {
            self.return_to(halves);
            return Ok(Tried::Rejected(f64::INFINITY));
        }
        let states = [&halves.whole, &*self.state];
        let mut error = scales.error(states, &halves.kinds, None);
        if accuracy.holds_back(error) {
            let span = [halves.before.time.value, size];
            halves.rounding.find(&self.loads, &self.least, span);
            let beyond = scales.error(states, &halves.kinds, Some(&halves.rounding));
            let accurate = (memory.tolerance.relative, accuracy);
            // After a step the next state is the one before it.
            let rests = |end| self.least.all_rest(self.dimension, [&halves.before, end]);
            let rests = rests(&self.next) && rests(&self.state);
            error = if rests {
                beyond
            } else {
                self.least.hidden(beyond, size, accurate)
            };
        }
        self.report.error = error;
        if accuracy.accepts(error) {
            return Ok(Tried::Made);
        }
        self.return_to(halves);
        Ok(Tried::Rejected(error))
    }

    /// A whole step, stored in `halves`, and one in two halves. If one fails, the state is that before both.
    pub(super) fn step_twice(&mut self, halves: &mut Halves, size: f64) -> Stepped {
        halves.before.copy_all_from(&self.state);
        self.stepper.save_past_to(&mut halves.past);
        self.step_by(size)?;
        let iterations = self.report.iterations;
        halves.whole.copy_from(&self.state);
        self.return_to(halves);
        self.step_in_halves(halves, size)?;
        self.report.iterations += iterations;
        Ok(())
    }

    /// Two steps of half a size. If one fails, the state is that before both.
    pub(super) fn step_in_halves(&mut self, halves: &Halves, size: f64) -> Stepped {
        let half = 0.5 * size;
        self.step_by(half)?;
        let first = self.report;
        or_restore(self, |run| run.return_to(halves), |run| run.step_by(half))?;
        self.report = first.and(self.report);
        Ok(())
    }

    /// Goes back to the beginning of the step for which `halves` was filled.
    pub(super) fn return_to(&mut self, halves: &Halves) {
        self.has_stepped = false;
        self.state.copy_all_from(&halves.before);
        self.stepper.restore(&halves.past, None);
    }

    /// Which viscous variables are strains of solids.
    pub(super) fn viscous_strains(&self) -> Vec<bool> {
        let mut are_strains = vec![false; self.layout.viscous];
        for (place, shape) in self.all_places() {
            let first = self.stepper.slots(place).viscous;
            are_strains[first..first + shape.dashpots].fill(!shape.is_spring);
        }
        are_strains
    }

    /// The unknown with the largest error in a step of this size, which was rejected; the state is unchanged.
    #[cold]
    pub(super) fn worst_error(&mut self, control: &mut Control, size: f64) -> Option<WorstError> {
        let (unknown, [error, allowed]) = match &mut control.halves {
            None => {
                self.has_stepped = false;
                let (start, next) = (start!(self, size), &mut *self.next);
                let tolerance = &control.memory.tolerance;
                self.stepper.worst_error(&start, tolerance, next)?
            }
            Some(halves) => {
                self.step_twice(halves, size).ok()?;
                let tolerance = &control.memory.tolerance;
                let ends = [&halves.before, &*self.state];
                let least = (control.memory.largest_momentum, &self.least);
                let accuracy = control.accuracy;
                let scales = Scales::new(self.dimension, tolerance, (accuracy, size), ends, least);
                let states = [&halves.whole, &*self.state];
                let span = [halves.before.time.value, size];
                halves.rounding.find(&self.loads, &self.least, span);
                let worst = scales.worst(states, &halves.kinds, &halves.rounding);
                self.return_to(halves);
                worst?
            }
        };
        let (place, is_strain) = match unknown {
            Unknown::Position(index) | Unknown::Momentum(index) => {
                let place = along_axis(
                    self.scene.node(index / self.dimension),
                    index % self.dimension,
                );
                (place, false)
            }
            Unknown::Viscous(index) => {
                let place = self.element_with(&|own, dashpots| {
                    (own.viscous..own.viscous + dashpots).contains(&index)
                });
                (place?, self.viscous_strains()[index])
            }
            Unknown::Temperature(slot) => {
                let place = self.element_with(&|own, _| own.thermal == Some(slot));
                (place?, false)
            }
        };
        Some(worst_of(unknown, is_strain, &place, [error, allowed]))
    }

    /// The first element whose slots and number of dashpots satisfy a condition.
    fn element_with(&self, is_it: &dyn Fn(Slots, usize) -> bool) -> Option<String> {
        for (place, shape) in self.all_places() {
            if is_it(self.stepper.slots(place), shape.dashpots) {
                return Some(self.stepper.handle(place).to_string());
            }
        }
        None
    }
}

fn along_axis(node: Node, axis: usize) -> String {
    format!("{node} along axis {axis}")
}

/// The error of an unknown of the node or the element with this name.
fn worst_of(
    unknown: Unknown,
    is_strain: bool,
    place: &str,
    [error, allowed]: [f64; 2],
) -> WorstError {
    let (quantity, unit, setting) = match unknown {
        Unknown::Position(_) => ("position", "m", "`with_position`"),
        Unknown::Momentum(_) => ("momentum", "kg m/s", "`with_momentum`"),
        Unknown::Viscous(_) if is_strain => ("viscous strain", "", "`with_position`"),
        Unknown::Viscous(_) => ("viscous stretch", "m", "`with_position`"),
        Unknown::Temperature(_) => ("temperature", "K", "`with_temperature`"),
    };
    WorstError {
        of: format!("the {quantity} of {place}"),
        unit,
        error,
        allowed,
        setting,
    }
}

// Flights: steps to another branch of solutions, which the estimate from two halves does not see.
//
// The equations of a step that is long beside a vibration have several solutions. Where all is at rest but for a velocity v that the
// tolerance does not see, and `h v` exceeds the way to a mirror image of the scene, such as r⁰ → −r⁰ of a spring, a flight to it is one:
// lengths and energies are the same, and forces along `r⁰ + r¹` do not stop it. The whole step and one of its halves may take it together,
// so that their ends agree.
//
// Then the other half moves next to nothing. A scheme of order p follows polynomials of the degree p, of which `1/(2ᵖ − 1)` of the way in
// the second half is made in the first, if they begin at rest; so less than that tells a flight from a motion. Under loads the mirror
// image is not at rest, and the other half may end the fall to it. What has flown along its own line has passed its other end, which
// tells, too. Where vibrations are resolved, the estimate sees it, and a mass may fly through its anchor.

/// The least way of one end of an element from the other that may be a flight, in units of their distance: that to a mirror image in a
/// line at 7° to a spring. A motion that turns round in the middle of one half makes no way there and `(h Ω)²/4` of its amplitude in
/// the other, with its angular frequency Ω: less than this in accurate steps of order 2.
const LEAST_WAY: f64 = 0.25;

/// A straight way at less than this share of its length from the other end is one along the line of an element: a turn by 151°. In accurate
/// steps order 6 turns by up to 2.6 rad in a half, at a tolerance of 1e-2.
const NEAREST: f64 = 0.25;

impl Run {
    /// Whether the last step, made in two halves by a scheme of this order, flies with an element that vibrates faster than a half lasts.
    pub(super) fn flies(&self, size: f64, scales: &Scales<'_>, order: f64) -> bool {
        // After a step the next state is the one before it.
        let states = [scales.before(), &*self.next, &*self.state];
        let (share, least) = ((order.exp2() - 1.0).recip(), scales.position());
        let flies = |arm| {
            let arms = states.map(|state| arm_in(state, arm, self.dimension));
            is_flight(&arms, share, least)
        };
        let mut all = self.places.iter();
        if !all.any(|&place| any_arm(self.stepper.nodes(indices(place)), &flies)) {
            return false;
        }
        let mobility = |node: usize| self.masses.get(node).map_or(0.0, f64::recip);
        let mut is_found = false;
        self.stepper.stiffness(scales.before(), &mut |_, point| {
            is_found |= any_arm(point.nodes, &|arm| {
                let rate = (point.elastic * (mobility(arm[0]) + mobility(arm[1]))).sqrt();
                0.5 * size * rate > TAU && flies(arm)
            });
        });
        is_found
    }
}

/// The components of an arm in a state.
fn arm_in(state: &State, arm: [usize; 2], dimension: usize) -> impl Iterator<Item = f64> + Clone {
    let at = state.positions.values();
    let [from, to] = arm.map(|node| node * dimension);
    (0..dimension).map(move |axis| at[to + axis] - at[from + axis])
}

/// Whether an arm flies, given it at the start, in the middle and at the end of a step: it makes less than a share of its way in one half
/// or passes its other end, and more than this way, m.
fn is_flight<A: Iterator<Item = f64> + Clone>(arms: &[A; 3], share: f64, least: f64) -> bool {
    let [start, middle, end] = arms;
    let way = |from: &A, to: &A| norm(to.clone().zip(from.clone()).map(|(to, from)| to - from));
    let (first, second) = (way(start, middle), way(middle, end));
    let most = Scalar::maximum(first, second);
    let least = Scalar::maximum(LEAST_WAY * norm(start.clone()), least);
    let stands = Scalar::minimum(first, second) < share * most;
    least < most && (stands || passes(start, middle) || passes(middle, end))
}

/// Whether the straight way of an arm passes its other end nearer than [`NEAREST`] of its lengths before and after.
fn passes<A: Iterator<Item = f64> + Clone>(from: &A, to: &A) -> bool {
    let sum = |of: &dyn Fn(f64, f64) -> f64| {
        let ends = from.clone().zip(to.clone());
        ends.map(|(from, to)| of(from, to)).sum::<f64>()
    };
    let way = sum(&|from, to| (to - from) * (to - from));
    let share = -sum(&|from, to| from * (to - from)) / way;
    let nearest = sum(&|from, to| (from + share * (to - from)) * (from + share * (to - from)));
    let least = Scalar::minimum(sum(&|from, _| from * from), sum(&|_, to| to * to));
    0.0 < share && share < 1.0 && nearest < NEAREST * NEAREST * least
}

/// Whether the first node of an element with one of the others satisfies a condition.
fn any_arm(nodes: &[u32], is_it: &dyn Fn([usize; 2]) -> bool) -> bool {
    let mut others = nodes.iter().skip(1);
    others.any(|&other| is_it([nodes[0] as usize, other as usize]))
}
