//! The value of an objective, and its derivatives by the states of a history.

use core::mem;

use super::way::{Way, Weighted, add, dot};
use crate::element::group::ElementGeneric;
use crate::element::handle::{Element, Node};
use crate::element::state::State;
use crate::run::gradient::error::GradientError;
use crate::run::gradient::objective::{Term, When};
use crate::run::gradient::result::Gradient;
use crate::run::gradient::snapshots::Record;
use crate::run::recorder::Quantity;
use crate::run::simulation::Simulation;
use crate::run::simulation::stepper::Stepper;
use crate::step::adjoint::Costate;
use eem_material::number::scalar::{Real, is_positive};
use nalgebra::SVector;

/// What objectives ask of the states, from the last one on.
pub(super) struct Seeds<'a, const D: usize, S: Real> {
    terms: Vec<Asked<'a, D, S>>,
    /// The factor of the time at the end.
    time: f64,
    /// The value of the first objective, of the states that were seen.
    pub(super) value: f64,
}

/// A quantity of an objective.
struct Asked<'a, const D: usize, S: Real> {
    term: &'a Term<D, S>,
    /// That of the objective.
    factor: f64,
    /// Whether it is the first one.
    counts: bool,
    moments: Vec<Moment>,
}

/// A state at which a quantity counts.
#[derive(Clone, Copy, Debug)]
struct Moment {
    /// The number of steps before it.
    steps: usize,
    /// A datum and its standard deviation.
    record: Option<[f64; 2]>,
}

impl<'a, const D: usize, S: Real> Seeds<'a, D, S> {
    pub(super) fn new(
        kept: &Record<S>,
        objectives: Weighted<'a, D, S>,
    ) -> Result<Self, GradientError> {
        let (mut terms, mut time, mut value) = (Vec::new(), 0.0, 0.0);
        for (place, &(factor, objective)) in objectives.iter().enumerate() {
            let counts = place == 0;
            for term in &objective.terms {
                terms.push(Asked {
                    term,
                    factor,
                    counts,
                    moments: moments(kept, &term.when)?,
                });
            }
            time += factor * objective.time;
            if counts && objective.time != 0.0 {
                value += objective.time * kept.time().to_f64();
            }
        }
        Ok(Self { terms, time, value })
    }
}

impl<const D: usize, S: Real> Simulation<D, S> {
    /// A quantity in a state of the history, whose energies are not known unless it is the present one.
    fn value_in(
        &mut self,
        (state, is_present): (&mut State<S>, bool),
        term: &Term<D, S>,
    ) -> Result<f64, GradientError> {
        if !is_present && matches!(term.quantity, Quantity::TotalEnergy) {
            self.find_energies(state)?;
        }
        mem::swap(&mut *self.state, state);
        let values = term.quantity.present(self);
        mem::swap(&mut *self.state, state);
        let values = values?;
        let component = term.component;
        values.get(component).copied().ok_or_else(|| {
            let quantity = term.quantity.kind();
            GradientError::Component {
                quantity,
                component,
                components: values.len(),
            }
        })
    }

    /// Finds entropies and energies of a state from its temperatures.
    fn find_energies(&mut self, state: &mut State<S>) -> Result<(), GradientError> {
        self.has_stepped = false;
        let Stepper::Newton(newton) = &mut self.stepper else {
            return Ok(());
        };
        let mut refused = None;
        for group in &mut newton.groups {
            let elements = group.elements_mut();
            elements.initialize(state, &mut |error| refused = Some(error));
        }
        refused.map_or(Ok(()), |error| Err(error.into()))
    }

    /// Adds the values and the derivatives of the quantities in the state after so many steps.
    pub(super) fn add_seeds(
        &mut self,
        (steps, state): (usize, &mut State<S>),
        (kept, seeds): (&Record<S>, &mut Seeds<'_, D, S>),
        way: &mut Way<D, S>,
    ) -> Result<(), GradientError> {
        let place = |costate: &Costate<S>, node: usize| {
            SVector::<S, D>::from_fn(|axis, _| costate.positions[node * D + axis])
        };
        let motions = way.found.motions.iter();
        let before: Vec<_> = motions
            .map(|&(node, _)| place(&way.adjoint.costate, node))
            .collect();
        way.by_size = S::from_f64(seeds.time);
        let is_present = steps == kept.len();
        let mut sum = 0.0;
        for asked in &mut seeds.terms {
            let (term, factor) = (asked.term, asked.factor * asked.term.factor);
            let (mut weight, mut own, mut counts) = (0.0, 0.0, false);
            if matches!(term.when, When::Integral) {
                let value = self.value_in((state, is_present), term)?;
                counts = true;
                let half = 0.5 * term.factor;
                if let Some(before) = steps.checked_sub(1) {
                    let share = half * kept.size(before).to_f64();
                    (weight, own) = (weight + share, own + share * value);
                    way.by_size += S::from_f64(asked.factor * half * value);
                }
                if steps < kept.len() {
                    let share = half * kept.size(steps).to_f64();
                    (weight, own) = (weight + share, own + share * value);
                    if let Some((_, by_size)) = way.found.sizes.last_mut() {
                        *by_size += S::from_f64(asked.factor * half * value);
                    }
                }
                weight *= asked.factor;
            }
            while let Some(moment) = asked.moments.pop_if(|moment| moment.steps == steps) {
                let value = self.value_in((state, is_present), term)?;
                counts = true;
                if let Some([datum, deviation]) = moment.record {
                    let misfit = (value - datum) / deviation;
                    weight += factor * misfit / deviation;
                    own += 0.5 * term.factor * misfit * misfit;
                } else {
                    weight += factor;
                    own += term.factor * value;
                }
            }
            if asked.counts {
                sum += own;
            }
            // Also without weight: a quantity without derivatives is an error, whatever its value.
            if counts {
                self.add_seed((state, S::from_f64(weight)), term, way)?;
            }
        }
        seeds.value += sum;
        let time = state.time.value;
        let (costate, found) = (&way.adjoint.costate, &mut way.found);
        for ((node, series), before) in found.motions.iter_mut().zip(before) {
            let own = place(costate, *node) - before;
            match series.last_mut() {
                Some((_, last)) => *last += own,
                None => series.push((time, own)),
            }
        }
        Ok(())
    }

    /// The same of one quantity with a weight.
    fn add_seed(
        &mut self,
        (state, weight): (&State<S>, S),
        term: &Term<D, S>,
        way: &mut Way<D, S>,
    ) -> Result<(), GradientError> {
        let (layout, found) = (&way.layout, &mut way.found);
        let costate = &mut way.adjoint.costate;
        let at = |node: &Node| node.index * D + term.component;
        let velocities = |node: usize, mass: S| state.velocity::<D>(node, mass);
        let slots = |element: &Element| layout.elements[element.index()];
        match &term.quantity {
            Quantity::Position(node) => costate.positions[at(node)] += weight,
            Quantity::Velocity(node) if self.masses.get(node.index).is_some() => {
                costate.velocities[at(node)] += weight;
            }
            Quantity::Momentum(node) if !self.masses.are_coupled() => {
                if let Some(mass) = self.masses.get(node.index) {
                    costate.velocities[at(node)] += weight * mass;
                    found.masses[node.index] +=
                        weight * velocities(node.index, mass)[term.component];
                }
            }
            Quantity::Stretch(element) => {
                let [group, place] = self.places[element.index()].map(|index| index as usize);
                let &[a, b] = self.stepper.elements(group).nodes(place) else {
                    return Err(no_derivative(&term.quantity));
                };
                let positions = state.positions.values();
                let arm: SVector<S, D> = SVector::from_fn(|axis, _| {
                    positions[b as usize * D + axis] - positions[a as usize * D + axis]
                });
                let length = arm.iter().fold(S::zero(), |sum, &x| sum + x * x).sqrt();
                for axis in 0..D {
                    let entry = weight * arm[axis] / length;
                    costate.positions[b as usize * D + axis] += entry;
                    costate.positions[a as usize * D + axis] -= entry;
                }
            }
            Quantity::ViscousStretch(element, dashpot) => {
                costate.viscous[slots(element).viscous + dashpot] += weight;
            }
            Quantity::Temperature(element) => {
                if let Some(slot) = slots(element).thermal {
                    costate.temperatures[slot] += weight;
                }
            }
            Quantity::ReservoirEntropy(reservoir) => {
                costate.reservoirs[reservoir.index] += weight;
            }
            Quantity::ReservoirHeat(reservoir) => {
                let theta = self.conduction.reservoirs[reservoir.index];
                costate.reservoirs[reservoir.index] += weight * theta;
                let entropy = state.reservoir_entropies.values()[reservoir.index];
                found.reservoirs[reservoir.index] += weight * entropy;
            }
            Quantity::KineticEnergy => self.add_kinetic((state, weight), (costate, found)),
            Quantity::TotalEnergy => {
                self.add_kinetic((state, weight), (costate, found));
                self.add_potential((state, weight), &way.sums, (costate, found));
                self.add_internal((state, weight), (costate, found));
                for (index, &theta) in self.conduction.reservoirs.iter().enumerate() {
                    costate.reservoirs[index] += weight * theta;
                    found.reservoirs[index] += weight * state.reservoir_entropies.values()[index];
                }
            }
            other => return Err(no_derivative(other)),
        }
        Ok(())
    }

    /// `½ vᵀ M v`.
    fn add_kinetic(
        &self,
        (state, weight): (&State<S>, S),
        (costate, found): (&mut Costate<S>, &mut Gradient<D, S>),
    ) {
        let momenta = state.momenta.values();
        let half = S::from_f64(0.5);
        for (node, mass) in self.masses.iter().enumerate() {
            let Some(mass) = mass else { continue };
            let velocity = state.velocity::<D>(node, mass);
            for axis in 0..D {
                costate.velocities[node * D + axis] += weight * momenta[node * D + axis];
                found.masses[node] += weight * half * velocity[axis] * velocity[axis];
            }
        }
        if !self.masses.are_coupled() {
            return;
        }
        for (node, _) in &self.loads.motions {
            for at in (0..D).map(|axis| node.index * D + axis) {
                costate.velocities[at] += weight * momenta[at];
            }
        }
        let velocity = |node: usize| SVector::from(state.velocity::<D>(node, S::one()));
        for ([i, j], by) in &mut found.pairs {
            let share = if i == j { half } else { S::one() };
            *by += weight * share * dot(&velocity(*i), &velocity(*j));
        }
    }

    /// `−Σ m g·q`, with the sums of the rows of the mass matrix.
    fn add_potential(
        &self,
        (state, weight): (&State<S>, S),
        sums: &[S],
        (costate, found): (&mut Costate<S>, &mut Gradient<D, S>),
    ) {
        let positions = state.positions.values();
        let place = |node: usize| SVector::<S, D>::from_fn(|axis, _| positions[node * D + axis]);
        let gravity = self.loads.gravity;
        for (node, &sum) in sums.iter().enumerate() {
            for (axis, at) in (node * D..(node + 1) * D).enumerate() {
                costate.positions[at] -= weight * sum * gravity[axis];
            }
            found.gravity -= place(node) * (weight * sum);
            if self.masses.get(node).is_some() {
                found.masses[node] -= weight * dot(&gravity, &place(node));
            }
        }
        for ([i, j], by) in &mut found.pairs {
            let mut own = place(*i);
            if i != j {
                own += place(*j);
            }
            *by -= weight * dot(&gravity, &own);
        }
    }

    /// `Σ e` of all elements.
    fn add_internal(
        &mut self,
        (state, weight): (&State<S>, S),
        (costate, found): (&mut Costate<S>, &mut Gradient<D, S>),
    ) {
        // The elements are evaluated elsewhere than at the ends of their last step.
        self.has_stepped = false;
        let Stepper::Newton(newton) = &mut self.stepper else {
            return;
        };
        for group in &mut newton.groups {
            for slopes in group.elements_mut().generic_in(state) {
                add_energy(&slopes, weight, costate);
            }
            group.energy_by_parameters(state, &mut |element, values| {
                add(&mut found.elements[element.index()].values, weight, values);
            });
        }
    }
}

/// Adds the derivatives of an internal energy at fixed temperature: `∂e = f ∂π − g ∂γ + θ ∂s`.
fn add_energy<S: Real>(element: &ElementGeneric<S>, weight: S, costate: &mut Costate<S>) {
    for &(at, force) in &element.forces {
        costate.positions[at] += weight * force;
    }
    for &(slot, force, _) in &element.dashpots {
        costate.viscous[slot] -= weight * force;
    }
    let (Some((_, theta)), Some(entropy)) = (element.temperature, &element.entropy) else {
        return;
    };
    let weight = weight * theta;
    for &(at, slope) in &entropy.by_position {
        costate.positions[at] += weight * slope;
    }
    for &(slot, slope) in &entropy.by_viscous {
        costate.viscous[slot] += weight * slope;
    }
    costate.temperatures[entropy.slot] += weight * entropy.by_temperature;
}

#[cold]
fn no_derivative<const D: usize, S: Real>(quantity: &Quantity<D, S>) -> GradientError {
    let quantity = quantity.kind();
    GradientError::NoDerivative { quantity }
}

/// Roundings, in ε of the time, by which a time may differ from the end of its step: half a unit each of the number that was
/// given and of the time of the run, and what steps of rounded sizes add.
const ROUNDINGS: f64 = 4.0;

/// The states in which a quantity counts, the last one at the end.
fn moments<S: Real>(kept: &Record<S>, when: &When) -> Result<Vec<Moment>, GradientError> {
    let at = |steps: usize, record| Moment { steps, record };
    let mut asked: Vec<(f64, Option<[f64; 2]>)> = match when {
        When::End => return Ok(vec![at(kept.len(), None)]),
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
    let mut times = kept.times().map(Real::to_f64).enumerate().peekable();
    let (mut steps, mut near) = times.next().unwrap_or((0, f64::NAN));
    let mut found = Vec::with_capacity(asked.len());
    for (time, record) in asked {
        let nearer = |next: f64, near: f64| (next - time).abs() < (near - time).abs();
        while let Some(next) = times.next_if(|&(_, next)| nearer(next, near)) {
            (steps, near) = next;
        }
        let is_there = (near - time).abs() <= ROUNDINGS * S::EPSILON.to_f64() * time.abs();
        if !is_there {
            let nearest = near;
            return Err(GradientError::NotAnEndOfStep { time, nearest });
        }
        found.push(at(steps, record));
    }
    Ok(found)
}
