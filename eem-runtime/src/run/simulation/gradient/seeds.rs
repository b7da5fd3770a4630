//! The value of an objective, and its derivatives by the states of a history.

use core::mem;

use super::derivatives::Of;
use super::inputs::{Way, Weighted, add_to};
use crate::element::loads::point;
use crate::element::state::State;
use crate::run::gradient::error::GradientError;
use crate::run::gradient::input::{Term, Timed, When};
use crate::run::gradient::snapshots::Record;
use crate::run::recorder::Quantity;
use crate::run::simulation::Simulation;
use crate::step::adjoint::PerVariable;
use eem_material::number::scalar::is_positive;
use nalgebra::SVector;

/// The quantities of objectives, and the states at which they count, from the last one on.
pub(super) struct Seeds<'a, const D: usize> {
    pub(super) terms: Vec<Asked<'a, D>>,
    /// The factor of the time at the end.
    time: f64,
    /// The value of the first objective, as far as the states passed so far contribute.
    pub(super) value: f64,
}

/// How a quantity counts in a state: the derivative of the weighted sum of objectives by it, its contribution to its own
/// objective, and its value if the term is an integral.
pub(super) struct Weighed {
    pub(super) weight: f64,
    own: f64,
    integrand: Option<f64>,
}

/// A quantity of an objective.
pub(super) struct Asked<'a, const D: usize> {
    term: &'a Term<D>,
    /// The factor of the objective.
    factor: f64,
    /// Whether the objective is the first one, whose value counts.
    is_first: bool,
    /// From the last one on, on the way back.
    pub(super) moments: Vec<Moment>,
}

impl<'a, const D: usize> Asked<'a, D> {
    /// The quantity and its component.
    pub(super) const fn of(&self) -> (&'a Quantity<D>, usize) {
        (&self.term.quantity, self.term.component)
    }
}

/// A state at which a quantity counts: the number of steps before it, and a datum with its standard deviation.
type Moment = (usize, Option<[f64; 2]>);

impl<'a, const D: usize> Seeds<'a, D> {
    pub(super) fn new(kept: &Record, objectives: Weighted<'a, D>) -> Result<Self, GradientError> {
        let (mut terms, mut time, mut value) = (Vec::new(), 0.0, 0.0);
        for (place, &(factor, objective)) in objectives.iter().enumerate() {
            let is_first = place == 0;
            for term in &objective.terms {
                terms.push(Asked {
                    term,
                    factor,
                    is_first,
                    moments: moments(kept, &term.when)?,
                });
            }
            time += factor * objective.time;
            if is_first && objective.time != 0.0 {
                value += objective.time * kept.time();
            }
        }
        Ok(Self { terms, time, value })
    }
}

impl<const D: usize> Simulation<D> {
    /// The value of a quantity in a state of the history, whose energies are not kept.
    fn value_in(&mut self, state: &mut State, term: &Term<D>) -> Result<f64, GradientError> {
        if matches!(term.quantity, Quantity::TotalEnergy) {
            self.find_energies(state)?;
        }
        mem::swap(&mut *self.run.state, state);
        let values = term.quantity.present(self);
        mem::swap(&mut *self.run.state, state);
        let values = values?;
        let component = term.component;
        let quantity = || term.quantity.kind();
        GradientError::expect_component(quantity, component, values.len())?;
        Ok(values[component])
    }

    /// Finds entropies and energies of a state from its temperatures.
    fn find_energies(&mut self, state: &mut State) -> Result<(), GradientError> {
        self.run.has_stepped = false;
        let mut refused = None;
        self.run.stepper.of_mut::<D>().each_mut(|elements| {
            elements.initialize(state, &mut |error| refused = Some(error));
        });
        refused.map_or(Ok(()), |error| Err(error.into()))
    }

    /// How a quantity of an objective counts in the state after `steps` steps; `None` if it does not.
    pub(super) fn weigh(
        &mut self,
        (steps, state): (usize, &mut State),
        kept: &Record,
        asked: &mut Asked<'_, D>,
    ) -> Result<Option<Weighed>, GradientError> {
        let term = asked.term;
        let factor = asked.factor * term.factor;
        let mut found = Weighed {
            weight: 0.0,
            own: 0.0,
            integrand: None,
        };
        let mut counts = false;
        if matches!(term.when, When::Integral) {
            let value = self.value_in(state, term)?;
            (counts, found.integrand) = (true, Some(value));
            let after = (steps < kept.len()).then_some(steps);
            for step in [steps.checked_sub(1), after].into_iter().flatten() {
                let share = 0.5 * term.factor * kept.size(step);
                found.weight += asked.factor * share;
                found.own += share * value;
            }
        }
        while let Some((_, record)) = asked.moments.pop_if(|(at, _)| *at == steps) {
            let value = self.value_in(state, term)?;
            counts = true;
            if let Some([datum, deviation]) = record {
                let misfit = (value - datum) / deviation;
                found.weight += factor * misfit / deviation;
                found.own += 0.5 * term.factor * misfit * misfit;
            } else {
                found.weight += factor;
                found.own += term.factor * value;
            }
        }
        Ok(counts.then_some(found))
    }

    /// Adds the values and the derivatives of the quantities in the state after `steps` steps.
    pub(super) fn add_seeds(
        &mut self,
        (steps, state): (usize, &mut State),
        (kept, seeds): (&Record, &mut Seeds<'_, D>),
        way: &mut Way<D>,
    ) -> Result<(), GradientError> {
        let place = |costate: &PerVariable, load: &Timed| match load {
            Timed::Motion(anchor) => Some(point::<D>(&costate.positions, anchor.index)),
            _ => None,
        };
        let vectors = way.found.vectors.iter();
        let before: Vec<_> = vectors
            .map(|(load, _)| place(&way.adjoint.costate, load))
            .collect();
        way.by_size = seeds.time;
        let mut sum = 0.0;
        for asked in &mut seeds.terms {
            let at = (steps, &mut *state);
            let Some(weighed) = self.weigh(at, kept, asked)? else {
                continue;
            };
            if let Some(value) = weighed.integrand {
                let share = asked.factor * 0.5 * asked.term.factor * value;
                if steps > 0 {
                    way.by_size += share;
                }
                if let Some((_, by_size)) = way.found.sizes.last_mut()
                    && steps < kept.len()
                {
                    *by_size += share;
                }
            }
            if asked.is_first {
                sum += weighed.own;
            }
            let (adjoint, found) = (&mut way.adjoint, &mut way.found);
            let see = &mut (|of: Of<'_>, by| add_to((&mut *adjoint, found), of, by));
            // Also with weight zero: a quantity without derivatives is an error, whatever its value.
            let weight = weighed.weight;
            self.see_derivatives((state, weight), asked.of(), &way.passage, see)?;
        }
        seeds.value += sum;
        let time = state.time.value;
        let (costate, found) = (&way.adjoint.costate, &mut way.found);
        for ((load, series), before) in found.vectors.iter_mut().zip(before) {
            let (Some(before), Some(after)) = (before, place(costate, load)) else {
                continue;
            };
            let own = SVector::from(after) - SVector::from(before);
            match series.0.last_mut() {
                Some((_, last)) => *last += own,
                None => series.0.push((time, own)),
            }
        }
        Ok(())
    }
}

/// Roundings, in ε of the time, by which a time may differ from the end of its step: half a unit each of the number that was
/// given and of the time of the run, and what steps of rounded sizes add.
const ROUNDINGS: f64 = 4.0;

/// The states in which a quantity counts, the last one at the end.
fn moments(kept: &Record, when: &When) -> Result<Vec<Moment>, GradientError> {
    let mut asked: Vec<(f64, Option<[f64; 2]>)> = match when {
        When::End => return Ok(vec![(kept.len(), None)]),
        When::Integral => return Ok(Vec::new()),
        When::At(time) => vec![(*time, None)],
        When::Misfit(records) => {
            let mut asked = Vec::with_capacity(records.len());
            for &[time, datum, deviation] in records {
                if !is_positive(deviation) {
                    let value = deviation;
                    return Err(GradientError::Deviation { time, value });
                }
                asked.push((time, Some([datum, deviation])));
            }
            asked
        }
    };
    asked.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    let mut times = kept.times().enumerate().peekable();
    let (mut steps, mut near) = times.next().unwrap_or((0, f64::NAN));
    let mut found = Vec::with_capacity(asked.len());
    for (time, record) in asked {
        let nearer = |next: f64, near: f64| (next - time).abs() < (near - time).abs();
        while let Some(next) = times.next_if(|&(_, next)| nearer(next, near)) {
            (steps, near) = next;
        }
        let is_there =
            time.is_finite() && (near - time).abs() <= ROUNDINGS * f64::EPSILON * time.abs();
        if !is_there {
            let nearest = near;
            return Err(GradientError::NotAnEndOfStep { time, nearest });
        }
        found.push((steps, record));
    }
    Ok(found)
}
